"""What the page writes: a run that loads, a map that map_server reads, a page in one small file."""

import base64
import io
import json
import re
import zipfile
import zlib
from dataclasses import replace

import numpy as np
import pytest
from acted_engine import PAGE, Heard

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.exports import to_html
from bayesmap.app.protocol.actions import Export, ShowScan
from bayesmap.app.protocol.document import Source
from bayesmap.app.protocol.notices import DrawCount, View
from bayesmap.app.sources import open_file, opened_run
from bayesmap.io.ros.maps import read_map


@pytest.fixture(scope="module")
def heard():
    found = Heard()
    found.infer(tutorial_document(), "run")
    return found


def exported(heard, what):
    (report,) = heard.ask(Export(what))
    assert report.client == PAGE
    return report.header, report.buffers.get("data")


def test_a_saved_run_holds_the_draws(heard, tmp_path):
    header, data = exported(heard, "run")
    (tmp_path / "run.nc").write_bytes(data)
    run = bm.load(tmp_path / "run.nc")
    assert header["name"] == "run.nc"
    assert run.draws.shape == (2, 1000, 21, 21)
    shown = heard.ask(View("mean"))[0].buffers["p"]
    assert np.array_equal(np.rint(255 * run.occupancy), shown)


@pytest.mark.parametrize("method", ["propagate", "importance"])
def test_methods_without_chains_are_saved_too(method, tmp_path):
    heard = Heard()
    heard.infer(replace(tutorial_document(), method=method), "run")
    (tmp_path / "run.nc").write_bytes(exported(heard, "run")[1])
    assert bm.load(tmp_path / "run.nc").posterior.settings["method"] == method


def test_without_draws_there_is_no_run_to_save():
    heard = Heard()
    assert "nothing to export" in exported_text(heard)
    heard.infer(replace(tutorial_document(), sweeps=5))
    assert "run inference first" in exported_text(heard)


def exported_text(heard):
    return exported(heard, "run")[0]["text"]


def test_an_export_waits_for_the_first_picture():
    heard = Heard()
    heard.infer(tutorial_document(), steps=0)
    assert heard.ask(Export("map")) == []
    while not heard.all("field"):
        assert heard.all("download") == []
        heard.engine.advance()
    assert len(heard.all("download")) == 1


def test_the_map_is_one_that_map_server_reads(heard, tmp_path):
    zipfile.ZipFile(io.BytesIO(exported(heard, "map")[1])).extractall(tmp_path)
    occupancy, grid = read_map(tmp_path / "map.yaml")
    assert grid == tutorial_document().grid
    assert {0.0, 1.0} <= set(np.unique(occupancy[~np.isnan(occupancy)]))


def recording_of(html):
    return json.loads(re.search(r"data-recording>(.*?)</script>", html, re.DOTALL)[1])


def test_the_page_in_one_file_is_small_and_whole(heard):
    html = exported(heard, "html")[1].decode()
    assert len(html.encode()) < 200_000
    recording = recording_of(html)
    assert recording["draws"] == {"chains": 2, "count": 500, "data": recording["draws"]["data"]}
    bits = np.unpackbits(np.frombuffer(zlib.decompress(base64.b64decode(recording["draws"]["data"]), -15), np.uint8))
    draws = bits[: 1000 * 441].reshape(2, 500, 21, 21)
    assert np.array_equal(draws[1, -1] * 255, heard.ask(View("draw", 1, 999))[0].buffers["p"])
    assert [len(chain) for chain in recording["log_joint"]] == [500, 500]
    mean = np.frombuffer(base64.b64decode(recording["mean"]), np.uint8)
    assert np.array_equal(mean.reshape(21, 21), heard.ask(View("mean"))[0].buffers["p"])
    assert np.abs(draws.mean(axis=(0, 1)) - mean.reshape(21, 21) / 255).max() < 0.1


def test_the_page_in_one_file_holds_the_module(heard):
    html = exported(heard, "html")[1].decode()
    packed = re.search(r"data-module>(.*?)</script>", html, re.DOTALL)[1]
    assert re.search(rb"export\{[^}]* as mount\b", zlib.decompress(base64.b64decode(packed), -15))
    assert "http" not in re.sub(r">[^<]{1000,}<", "><", html)


def test_a_saved_run_is_shown_with_its_draws_and_scans(heard, tmp_path):
    (tmp_path / "a.nc").write_bytes(exported(heard, "run")[1])
    run = bm.load(tmp_path / "a.nc")
    opened = open_file(str(tmp_path / "a.nc"))
    assert opened.document.source == Source("run", "a.nc", 1)
    shown = Heard(opened)
    header, buffers = shown.infer(opened.document)
    assert header["draws"] == {"chains": 2, "count": 1000}
    assert np.array_equal(buffers["p"], np.rint(255 * run.occupancy))
    (draw,) = shown.ask(View("draw", 1, 3))
    assert np.array_equal(draw.buffers["p"] > 0, run.draws[1, 3])
    assert shown.last("scan")[1]["exact"].size == 0
    assert len(to_html(opened_run(run, "run").result)) < 200_000


def test_a_run_of_reflectivities_is_shown_too(tmp_path):
    walls, pose = bm.worlds.tutorial()
    angles = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    noise = bm.Gaussian(0.2)
    scans = bm.simulate(walls, bm.worlds.TUTORIAL_GRID, pose, angles, sensor=noise, max_range_m=42.0)
    run = bm.infer(
        scans,
        bm.worlds.TUTORIAL_GRID,
        prior=bm.Beta(1, 1),
        sensor=bm.BeamMixture(noise),
        schedule=bm.Schedule(chains=2, warmup=3, draws=6),
    )
    run.save(tmp_path / "field.nc")
    opened = open_file(str(tmp_path / "field.nc"))
    shown = Heard(opened)
    header, buffers = shown.infer(opened.document)
    assert header["draws"] == {"chains": 2, "count": 6}
    assert np.array_equal(buffers["p"], np.rint(255 * run.occupancy))
    (draw,) = shown.ask(View("draw", 1, 2))
    assert np.abs(draw.buffers["p"] / 255.0 - run.map_of(1, 2)).max() < 0.005
    recording = recording_of(exported(shown, "html")[1].decode())
    assert recording["draws"]["count"] == 0  # a recording holds walls alone
    assert opened.document.order == "radial"  # the page's control has to show something
    zipfile.ZipFile(io.BytesIO(exported(shown, "map")[1])).extractall(tmp_path)
    occupancy, _ = read_map(tmp_path / "map.yaml")
    assert np.array_equal(occupancy == 1, run.observed & (run.occupancy > 0.3))
    (tmp_path / "again.nc").write_bytes(exported(shown, "run")[1])
    assert np.array_equal(bm.load(tmp_path / "again.nc").occupancy, run.occupancy)


def small_log(path):
    world = bm.worlds.building(0, (12.0, 8.0), 0.25)
    poses = np.array([[6.0, 4.5, 0.1 * i] for i in range(6)])
    poses = poses[[not world.walls[world.grid.cell_at(x, y)] for x, y, _ in poses]]
    angles = np.radians(np.arange(-90, 90, 3.0))
    scans = bm.simulate(world.walls, world.grid, poses, angles, sensor=bm.Gaussian(0.03), max_range_m=20.0)
    from bayesmap.io.text.carmen import write_carmen

    write_carmen(path, scans)
    return len(scans)


def test_a_log_is_inferred_from_with_the_defaults_for_logs(tmp_path):
    count = small_log(tmp_path / "office.log")
    opened = open_file(str(tmp_path / "office.log"))
    source = opened.document.source
    assert (source.kind, source.name, source.scans) == ("log", "office.log", count)
    low, high = source.bounds
    assert opened.document.grid == bm.Grid.over(low, high, 0.1)
    assert (opened.document.prior, opened.document.grid.resolution) == (0.2, 0.1)
    heard = Heard(opened)
    header, _ = heard.infer(replace(opened.document, sweeps=4), scan=1)
    assert (header["method"], header["sweeps"]) == ("gibbs", 4)
    assert heard.last("scan")[0]["index"] == 1
    (scan,) = heard.ask(ShowScan(2))
    assert scan.header["index"] == 2
    assert scan.buffers["pose"].shape == (1, 3)
    heard.infer(replace(opened.document, sweeps=4, prior=0.4), "run")
    assert heard.all("finished")[-1]["draws"] == DrawCount(2, 4)


@pytest.mark.parametrize("name", ["none.nc", "none.log"])
def test_a_file_that_is_not_there_is_bad_input(name, tmp_path):
    with pytest.raises(bm.BadInput, match="no such file"):
        open_file(str(tmp_path / name))
