"""A log and a saved run in the page: scans and draws to look through, nothing to draw on."""

import subprocess
import sys

import numpy as np
import pytest
from page_driver import served, snapshot, until

import bayesmap as bm


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """A dozen scans of a small building."""
    path = tmp_path_factory.mktemp("page") / "office.log"
    size = ["--size", "12x8", "--resolution", "0.25", "--scans", "12", "--angles", "60", "--max-range", "12"]
    command = [
        sys.executable,
        "-m",
        "bayesmap",
        "simulate",
        "--world",
        "building",
        *size,
        "-o",
        path,
        "--set",
        "fov=180",
    ]
    subprocess.run(command, check=True, capture_output=True)
    return path


def test_a_log_is_inferred_while_its_scans_are_looked_through(open_page, log):
    with served(log) as (address, _):
        page = open_page(address)
        until(page, "s.painted && s.painted.sweeps > 0")
        first = snapshot(page)
        assert first["document"]["source"] == {"kind": "log", "name": log.name, "scans": 12}
        assert first["observed"].any()
        page.get_by_role("slider", name="Scan number").fill("7")
        until(page, "s.scan.index === 7")
        assert not np.array_equal(snapshot(page)["scan"]["pose"], first["scan"]["pose"])
        assert not page.get_by_role("radio", name="Draw", exact=True).is_visible()
        assert not page.get_by_role("slider", name="Noise").is_visible()
        assert page.get_by_role("slider", name="Prior").is_visible()
        before = snapshot(page)["generation"]
        page.mouse.click(480, 400)  # a press on the map pans, and draws nothing
        assert snapshot(page)["generation"] == before


def test_a_saved_run_shows_its_mean_and_its_draws(open_page, tmp_path):
    walls, pose = bm.worlds.tutorial()
    grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
    angles = np.arange(60) / 60 * 2 * np.pi
    scans = bm.simulate(walls, grid, pose, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=0)
    run = bm.infer(scans, grid, prior=bm.Independent(0.5), sensor=bm.Gaussian(0.2), chains=2, warmup=10, draws=15)
    run.save(tmp_path / "run.nc")
    with served(tmp_path / "run.nc") as (address, _):
        page = open_page(address)
        until(page, "s.draws.count === 15")
        shown = snapshot(page)
        assert np.abs(shown["probability"] / 255 - run.occupancy).max() <= 0.5 / 255 + 1e-6
        page.get_by_role("radio", name="One draw").check()
        page.get_by_label("Chain").select_option("1")
        page.get_by_role("slider", name="Draw number").fill("14")
        until(page, "s.painted.layer === 'draw' && s.painted.draw === 14 && s.painted.chain === 1")
        assert np.array_equal(snapshot(page)["probability"] > 0, run.draws[1, 14])
        assert not page.get_by_role("button", name="Run", exact=True).is_visible()
