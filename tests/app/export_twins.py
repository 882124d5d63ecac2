"""Results of all kinds, each as an exported page and as the messages of a live session, for page/test/twins.test.ts."""

import base64
from dataclasses import replace

import numpy as np
from acted_engine import Heard, shown
from building_log import room_run, room_scans

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import Export, Inspect, ShowScan
from bayesmap.app.protocol.notices import View
from bayesmap.app.protocol.tasks import Remember
from bayesmap.app.protocol.wire import frame
from bayesmap.app.sources import opened_log


def text_of(said):
    framed = frame(said.report.message, said.report.buffers)
    return {"text": framed} if isinstance(framed, str) else {"frame": base64.b64encode(framed).decode()}


def drawn(**settings):
    heard = Heard()
    heard.infer(replace(tutorial_document(), **{"sweeps": 40, **settings}), "run")
    return heard


def of_log(cells, mode, poses="logged"):
    scans = room_scans()
    opened = opened_log(scans, "room.log")
    heard = Heard(opened)
    if poses == "odometry":  # as a worker that is told what an earlier one has inferred
        heard.engine.take(Remember(scans.poses + np.array([0.2, 0.1, 0.02]), scans.angles_rad))
    heard.infer(replace(opened.document, cells=cells, sweeps=6, poses=poses), mode)
    return heard


def slam_run():
    """A run whose poses were inferred."""
    scans = room_scans(4)
    schedule = bm.Schedule(chains=2, warmup=2, draws=6)
    return bm.infer(
        scans, bm.Grid((40, 30), 0.2), prior=bm.Independent(0.2), poses=bm.UncertainPoses(0.05, 0.01), schedule=schedule
    )


CASES = {
    "drawn, Gibbs": drawn,
    "drawn, uncertain poses": lambda: drawn(pose_sigma=0.3),
    "drawn, importance": lambda: drawn(method="importance", sweeps=300),
    "drawn, propagation": lambda: drawn(method="propagate"),
    "run of walls": lambda: shown(room_run(bm.Independent(0.2))),
    "run of reflectivities": lambda: shown(room_run(bm.Beta())),
    "run of surfaces": lambda: shown(room_run(bm.Surface())),
    "slam": lambda: shown(slam_run()),
    "log of walls, live": lambda: of_log("binary", "live"),
    "log of reflectivities": lambda: of_log("reflectivity", "run"),
    "log of surfaces": lambda: of_log("surface", "run"),
    "log along an inferred trajectory": lambda: of_log("binary", "run", "odometry"),
}


def twin(make, folder, name):
    """The exported page of a result, and what a live session says of it: at first, and after each of some actions."""
    heard = make()
    document = heard.engine._result.document
    first = [said for kind in ("scan", "overlay") for said in heard.reports if said.header["type"] == kind]
    first = [kind[-1] for kind in ([s for s in first if s.header["type"] == t] for t in ("scan", "overlay")) if kind]
    html = heard.ask(Export("html"))[0].buffers["data"]
    (folder / f"{name}.html").write_bytes(html)
    draws = heard.last("field")[0]["draws"]
    rng = np.random.default_rng(0)
    cells = [Inspect(*map(int, cell)) for cell in rng.integers(0, document.grid.shape, (12, 2))]
    views = [View("width"), View("entropy"), View("mean")]
    views += [View("draw", c, d) for c in range(draws["chains"]) for d in (0, draws["count"] - 1)]
    scans = [] if document.simulated else [ShowScan(3), ShowScan(1)]
    asked = [(action, heard.ask(action)[-1]) for action in [View("mean"), *views, *scans, *cells]]
    steps = [{"action": said_of(action), **text_of(said)} for action, said in asked]
    return {
        "name": name,
        "html": str(folder / f"{name}.html"),
        "first": [text_of(said) for said in first],
        "steps": steps,
    }


def said_of(action):
    kind = {View: "view", ShowScan: "scan", Inspect: "inspect"}[type(action)]
    return {
        "type": kind,
        **{name: getattr(action, name) for name in action.__struct_fields__ if name not in ("seq", "each")},
    }


def twins(folder):
    return [twin(make, folder, name) for name, make in CASES.items()]
