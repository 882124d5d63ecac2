"""The page's one file is what its sources build, and its own tests pass (npm test) on what the library says."""

import base64
import json
import os
import re
import runpy
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from acted import Heard, shown
from building_log import room_run, room_scans
from msgspec import to_builtins
from page_driver import document, fragment

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import Export, Inspect, ShowScan
from bayesmap.app.protocol.document import Sensor, pack_walls
from bayesmap.app.protocol.notices import LIMITS, View
from bayesmap.app.protocol.tasks import TrajectoryState
from bayesmap.app.protocol.wire import encode_frame
from bayesmap.app.scene import simulated_scene
from bayesmap.app.sources import open_log
from bayesmap.posterior.summary import bulk_ess, rhat
from bayesmap.samplers.walls import WallBlocks, WallGibbs
from bayesmap.samplers.without_chains import sample_importance


def text_of(said):
    framed = encode_frame(said.report.message, said.report.buffers)
    return {"text": framed} if isinstance(framed, str) else {"frame": base64.b64encode(framed).decode()}


def drawn(**settings):
    heard = Heard()
    heard.infer(replace(tutorial_document(), **{"sweeps": 40, **settings}), "run")
    return heard


def of_log(cells, mode, poses="logged"):
    scans = room_scans()
    opened = open_log(scans, "room.log")
    heard = Heard(opened)
    if poses == "odometry":  # as a worker that is told what an earlier one has inferred
        heard.engine.take(TrajectoryState(scans.poses + np.array([0.2, 0.1, 0.02]), scans.angles_rad))
    heard.infer(replace(opened.document, cells=cells, sweeps=6, poses=poses), mode)
    return heard


def slam_run():
    model = {"prior": bm.Independent(0.2), "poses": bm.UncertainPoses(0.05, 0.01)}
    return bm.infer(room_scans(4), bm.Grid((40, 30), 0.2), **model, schedule=bm.Schedule(chains=2, warmup=2, draws=6))


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
    """Export a result as a page, and collect what a live session says of it at first, and after some actions."""
    heard = make()
    document = heard.engine._result.document
    first = [[said for said in heard.reports if said.header["type"] == kind][-1:] for kind in ("scan", "overlay")]
    (folder / f"{name}.html").write_bytes(heard.ask(Export("html"))[0].buffers["data"])
    draws = heard.last("field")[0]["draws"]
    cells = [Inspect(*map(int, cell)) for cell in np.random.default_rng(0).integers(0, document.grid.shape, (12, 2))]
    views = [View("width"), View("entropy"), View("mean")]
    views += [View("draw", c, d) for c in range(draws["chains"]) for d in (0, draws["count"] - 1)]
    scans = [] if document.simulated else [ShowScan(3), ShowScan(1)]
    asked = [(action, heard.ask(action)[-1]) for action in [View("mean"), *views, *scans, *cells]]
    steps = [{"action": message_of(action), **text_of(said)} for action, said in asked]
    said_first = [text_of(said) for last in first for said in last]
    return {"name": name, "html": str(folder / f"{name}.html"), "first": said_first, "steps": steps}


def message_of(action):
    fields = {name: getattr(action, name) for name in action.__struct_fields__ if name not in ("seq", "each")}
    return {"type": {View: "view", ShowScan: "scan", Inspect: "inspect"}[type(action)], **fields}


def twins(folder):
    return [twin(make, folder, name) for name, make in CASES.items()]


DRAWS, PARTICLES = 12, 300


def small_document(**settings):
    """A world whose cells are not metres, with two sensors, of which one stands on a grid line and sees half a turn."""
    walls = np.random.default_rng(3).random((14, 9)) < 0.2
    walls[[3, 10], [4, 6]] = False
    sensors = (Sensor(1, -0.125, 1.5, 0.3), Sensor(2, 1.6, 2.0, 2.0))
    changes = {"walls": pack_walls(walls), "sensors": sensors, "angles": 25, "fov": 3.0, "noise": 0.1, "max_range": 1.8}
    return replace(tutorial_document(), grid=bm.Grid((14, 9), 0.25, (-1.0, 0.4)), **{**changes, **settings})


def chains_of(document):
    """Draws of the document's method and order, from an empty map, and their log-likelihoods."""
    scene = simulated_scene(document)
    method = {"gibbs": bm.Gibbs, "block": bm.Block}[document.method](order=document.order, start="zeros")
    run = bm.infer(
        scene.scans, document.grid, prior=bm.Independent(document.prior), sensor=scene.sensor, method=method,
        schedule=bm.Schedule(chains=2, warmup=0, draws=DRAWS), seed=document.seed,
    )  # fmt: skip
    draws = run.posterior.draws.arrays["walls"]
    assert draws.shape[1] == DRAWS
    sites = {"gibbs": WallGibbs, "block": WallBlocks}[document.method](order=document.order).sites(scene.problem)
    return {
        **scene_of(document, scene), "sites": sites.tolist(),
        "draws": [[base64.b64encode(draw.tobytes()).decode() for draw in chain] for chain in draws],
        "log_likelihood": run.posterior.log_likelihood.tolist(), "log_prior": run.posterior.log_prior.tolist(),
        "rhat": None if document.prior == 0 else rhat(run.log_joint),
        "ess": None if document.prior == 0 else bulk_ess(run.log_joint),
    }  # fmt: skip


def scene_of(document, scene):
    table = scene.problem.table
    return {
        "document": document.to_json(), "readings": scene.scans.ranges_m.ravel().tolist(),
        "exact": scene.exact_m.ravel().tolist(), "offsets": table.offsets.tolist(), "cells": table.cells.tolist(),
        "loglik": table.loglik.tolist(), "no_hit": table.no_hit.tolist(),
    }  # fmt: skip


def particles_of(document):
    scene = simulated_scene(document)
    particles = sample_importance(scene.problem, PARTICLES, document.seed)
    return {
        **scene_of(document, scene), "log_weights": particles.log_weights.tolist(),
        "log_evidence": particles.log_evidence, "effective_sample_size": particles.effective_sample_size,
        "heaviest": base64.b64encode(pack_walls(particles.maps(particles.log_weights.argmax(keepdims=True)))).decode(),
    }  # fmt: skip


def figure_cases():
    tutorial = replace(tutorial_document(), prior=0.3)
    return {
        "chains": [
            chains_of(replace(document, method=method, order=order, seed=i))
            for document in (tutorial, small_document(prior=0.1), small_document(prior=0.5, readings="exact"))
            for method in ("gibbs", "block")
            for i, order in enumerate(("raster", "radial", "random"))
        ] + [chains_of(small_document(prior=0.0, method=method)) for method in ("gibbs", "block")],
        "particles": [particles_of(small_document(prior=0.3, seed=2**31 - 1)), particles_of(tutorial)],
    }  # fmt: skip


ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "page"
BUILT = ROOT / "src/bayesmap/app/static/mapview.js"

pytestmark = pytest.mark.skipif(not SOURCES.is_dir(), reason="the page's sources are not in this copy")


@pytest.fixture(scope="module")
def npm():
    """Run a script of npm, with the versions of the lock file installed."""
    npm_path = shutil.which("npm")
    if npm_path is None:
        pytest.skip("no npm on this machine: install node 20 or later")
    if not (SOURCES / "node_modules").is_dir():
        done = subprocess.run([npm_path, "ci", "--silent"], cwd=SOURCES, capture_output=True, text=True, check=False)
        if done.returncode:
            pytest.skip(f"npm cannot install the page's tools here: {done.stderr.strip()[-200:]}")

    def run(script, *arguments, **variables):
        command = [npm_path, "run", "--silent", script, "--", *map(str, arguments)]
        environment = {**os.environ, **variables}
        return subprocess.run(command, cwd=SOURCES, env=environment, capture_output=True, text=True, check=False)

    return run


def test_the_committed_file_is_what_the_sources_build(npm):
    done = npm("fresh")
    assert done.returncode == 0, done.stderr


@pytest.mark.full
def test_a_stale_file_is_found_and_types_hold(npm, tmp_path):
    stale = tmp_path / "mapview.js"
    stale.write_text(BUILT.read_text() + "// stale\n")
    done = npm("fresh", stale)
    assert done.returncode == 1
    assert "make page" in done.stderr
    done = npm("check")
    assert done.returncode == 0, done.stdout


def test_the_built_file_imports_nothing_and_the_lock_file_names_no_registry():
    assert not re.search(r"(^|[;}\s])import(\s+\w|\s*[{*\"'(])", BUILT.read_text())
    assert "http" not in (SOURCES / "package-lock.json").read_text()


def test_the_types_of_messages_are_those_that_the_library_declares():
    """Both ends of a message are checked against one declaration: the library's by msgspec, the page's by tsc."""
    written = runpy.run_path(str(SOURCES / "write_messages.py"))["messages"]()
    assert (SOURCES / "src/messages.ts").read_text() == written, "run make page"


def test_the_logic_of_the_page(npm, tmp_path):
    buffers = {
        "p": np.array([[0, 1, 255]], dtype=np.uint8), "pose": np.array([[0.1, -2.0, 3.0]]),
        "ranges": np.array([1.5, 0.25], dtype=np.float32),
    }  # fmt: skip
    library = {
        "limits": to_builtins(LIMITS),
        "frame": base64.b64encode(encode_frame({"type": "field", "generation": 3}, buffers)).decode(),
        "buffers": {name: values.ravel().tolist() for name, values in buffers.items()},
        "document": document(prior=0.375),
        "fragment": fragment(document(prior=0.375)),
        "tutorial": str(ROOT / "docs/tutorial/interactive.html"),
        "twins": twins(tmp_path),
        "samplers": figure_cases(),
    }
    (tmp_path / "library.json").write_text(json.dumps(library))
    done = npm("test", BAYESMAP_LIBRARY=str(tmp_path / "library.json"), NO_COLOR="1")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "skipped 0" in done.stdout, done.stdout
