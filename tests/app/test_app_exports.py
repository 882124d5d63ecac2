"""Files: a run that loads, a map that map_server reads, a page in one small file; and what a saved run or log shows."""

import base64
import io
import re
import zipfile
import zlib
from dataclasses import replace

import numpy as np
import pytest
from acted import Heard, shown
from building_log import room_run, write_room_log

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.exports import build_recording
from bayesmap.app.protocol.actions import Export, ShowScan
from bayesmap.app.protocol.document import Source
from bayesmap.app.protocol.notices import DrawCount, View
from bayesmap.app.protocol.wire import decode_frame
from bayesmap.app.sources import open_file, open_run
from bayesmap.io.ros.maps import read_map


@pytest.fixture(scope="module")
def heard():
    engine = Heard()
    engine.infer(tutorial_document(), "run")
    return engine


def exported(heard, what):
    header, buffers = heard.answer(Export(what))
    return header, buffers.get("data")


def saved_map(heard, folder):
    zipfile.ZipFile(io.BytesIO(exported(heard, "map")[1])).extractall(folder)
    return read_map(folder / "map.yaml")


def test_a_saved_run_holds_the_draws_and_is_shown_with_them_and_its_scans(heard, tmp_path):
    run = heard.saved_run(tmp_path)
    assert exported(heard, "run")[0]["name"] == "run.nc"
    assert run.draws.shape == (2, 900, 21, 21)  # without the burn-in
    assert np.array_equal(np.rint(255 * run.occupancy), heard.answer(View("mean"))[1]["p"])
    opened = open_file(str(tmp_path / "run.nc"))
    assert opened.document.source == Source("run", "run.nc", 1)
    again = Heard(opened)
    header, buffers = again.infer(opened.document)
    assert header["draws"] == {"chains": 2, "count": 900}
    assert np.array_equal(buffers["p"], np.rint(255 * run.occupancy))
    assert np.array_equal(again.answer(View("draw", 1, 3))[1]["p"] > 0, run.draws[1, 3])
    assert again.last("scan")[1]["exact"].size == 0
    assert len(exported(again, "html")[1]) < 200_000


@pytest.mark.parametrize(("method", "level"), [("propagate", None), ("importance", "bad")])
def test_methods_without_chains_are_saved_too_and_not_judged_as_chains(method, level, tmp_path):
    app = Heard()
    app.infer(replace(tutorial_document(), method=method), "run")
    assert getattr(open_run(app.saved_run(tmp_path), "").result.estimate.progress(True).verdict, "level", None) == level


def test_an_export_needs_draws_and_waits_for_the_first_picture():
    heard = Heard()
    assert "nothing to export" in exported(heard, "run")[0]["text"]
    heard.infer(tutorial_document(), "clear")
    assert "run inference first" in exported(heard, "run")[0]["text"]
    heard.reports.clear()
    heard.infer(tutorial_document(), steps=0)
    assert heard.ask(Export("map")) == []
    while not heard.all("field"):
        assert heard.all("download") == []
        heard.engine.advance()
    assert len(heard.all("download")) == 1


def test_the_page_in_one_file_is_small_and_loads_nothing(heard):
    """The page holds every number of the live one: see the twins in test_page_build.py."""
    header, data = exported(heard, "html")
    html = data.decode()
    assert len(data) < 200_000
    assert header["note"] == "with 500 of the 1,000 draws of each chain; at most 1,000 draws and 16 MB fit"
    recording, buffers = build_recording(heard.engine._result)
    draws = np.unpackbits(buffers["draws"], axis=-1, count=441).reshape(2, 500, 21, 21)
    assert np.array_equal(draws[1, -1] * 255, heard.answer(View("draw", 1, 999))[1]["p"])
    assert [len(chain) for chain in recording.log_joint] == [500, 500]
    packed = re.search(r"data-module>(.*?)</script>", html, re.DOTALL)[1]
    assert re.search(rb"export\{[^}]* as mount\b", zlib.decompress(base64.b64decode(packed), -15))
    assert "http" not in re.sub(r">[^<]{1000,}<", "><", html)


@pytest.mark.parametrize(("prior", "kind", "mean"), [
    (bm.Independent(0.2), "binary", None), (bm.Beta(), "reflectivity", "mean reflectivity"),
    (bm.Surface(), "surface", "chance that a cell stops a beam"),
])  # fmt: skip
def test_a_run_names_its_quantity_and_has_intervals_where_it_is_a_number(prior, kind, mean):
    run = room_run(prior)
    heard = shown(run)
    header, _ = heard.last("field")
    assert (header["quantity"]["kind"], header["quantity"]["interval"]) == (kind, kind != "binary")
    assert mean is None or header["quantity"]["mean"] == mean
    document = heard.engine._opened.document
    assert (document.cells, document.order) == (kind, "radial")  # in share links and exported documents, too
    header, buffers = heard.answer(View("width"))
    assert header["layer"] == ("mean" if kind == "binary" else "width")
    if kind != "binary":
        np.testing.assert_allclose(buffers["p"], 255 * run.posterior.prior.width(run.posterior.draws, 0.9), atol=0.51)


def test_surfaces_are_strokes_two_deviations_to_either_side_and_a_simulation_has_none():
    run = room_run(bm.Surface())
    _, over = shown(run).last("overlay")
    mean, covariance, reflectivity = run.surfaces()
    drawn = reflectivity >= 0.1
    strokes = over["strokes"]
    assert len(strokes) == drawn.sum() > 0
    np.testing.assert_allclose(0.5 * (strokes[:, :2] + strokes[:, 2:4]), mean[drawn], atol=1e-5)
    length = np.hypot(*(strokes[:, 2:4] - strokes[:, :2]).T)
    np.testing.assert_allclose(length, 4 * np.sqrt(np.linalg.eigvalsh(covariance[drawn])[:, 1]), rtol=1e-4)
    np.testing.assert_allclose(over["trajectory"], run.posterior.scans.poses[:, :2], atol=1e-6)
    heard = Heard()
    heard.infer(tutorial_document(), "preview")
    assert heard.all("overlay") == []


def test_a_run_of_reflectivities_is_exported_too(tmp_path):
    run = room_run(bm.Beta())
    heard = shown(run)
    header, buffers = heard.last("field")
    assert header["draws"] == {"chains": 2, "count": 10}
    assert np.array_equal(buffers["p"], np.rint(255 * run.occupancy))
    assert np.abs(heard.answer(View("draw", 1, 2))[1]["p"] / 255.0 - run.map_of(1, 2)).max() < 0.005
    kept, _ = decode_frame(exported(heard, "recording")[1])  # what the page keeps beside the next result
    assert kept["draws"] == {"chains": 2, "count": 10, "kept": 10, "bits": False}
    occupancy, grid = saved_map(heard, tmp_path)
    run.export(tmp_path / "own.yaml")
    assert grid == run.grid
    assert np.array_equal(occupancy, read_map(tmp_path / "own.yaml")[0], equal_nan=True)
    assert np.array_equal(heard.saved_run(tmp_path).occupancy, run.occupancy)


def test_the_map_of_chains_calls_free_what_four_beams_passed_as_that_of_a_run(tmp_path):
    heard = Heard()
    heard.infer(replace(tutorial_document(), cells="reflectivity", sweeps=12, noise=0.1, angles=40, burn_in=0.0), "run")
    heard.saved_run(tmp_path).export(tmp_path / "own.yaml")
    occupancy, _ = saved_map(heard, tmp_path)
    assert np.array_equal(occupancy, read_map(tmp_path / "own.yaml")[0], equal_nan=True)
    found = heard.engine._result.estimate
    thin = found.observed() & (found.mean() < found.prior.thresholds[1]) & np.isnan(occupancy)
    assert thin.any()  # few beams passed there


def test_a_log_is_inferred_from_with_the_defaults_for_logs(tmp_path):
    opened = open_file(str(write_room_log(tmp_path / "office.log")))
    source, document = opened.document.source, opened.document
    assert (source.kind, source.name, source.scans) == ("log", "office.log", 12)
    assert document.grid == bm.Grid.over(*source.bounds, 0.1)
    assert (document.prior, document.grid.resolution) == (0.2, 0.1)
    heard = Heard(opened)
    header, _ = heard.infer(replace(document, sweeps=4), scan=1)
    assert ((header["method"], header["sweeps"]), heard.last("scan")[0]["index"]) == (("gibbs", 4), 1)
    (scan,) = heard.ask(ShowScan(2))
    assert (scan.header["index"], scan.buffers["pose"].shape) == (2, (1, 3))
    heard.infer(replace(document, sweeps=4, prior=0.4), "run")
    assert heard.all("finished")[-1]["draws"] == DrawCount(2, 4)
