"""Kernels on a GPU: that all of them compile for it, and, where there is one, that it draws what the CPU draws."""

import importlib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from flat_options import infer

import bayesmap as bm
import bayesmap.kernels

ROOM = Path(bayesmap.kernels.__file__).parent
MODULES = sorted(
    ".".join(("bayesmap", "kernels", *path.relative_to(ROOM).with_suffix("").parts)) for path in ROOM.rglob("[!_]*.py")
)


def compile_for_cpu(names):
    """Fill Warp's cache: all tests load these modules from it."""
    import warp as wp

    from bayesmap.kernels import device

    device.start()
    for name in names:
        importlib.import_module(name)
        wp.get_module(name).load(wp.get_device("cpu"), 1)  # blocks of one as in `load_kernels`


@pytest.mark.full
@pytest.mark.parametrize("name", MODULES)
def test_every_kernel_compiles_for_cuda(name, tmp_path):
    """No GPU is needed: Warp brings the compiler. A module without kernels is compiled with those that call it."""
    import warp as wp

    from bayesmap.kernels import device

    device.start()
    importlib.import_module(name)
    if not wp.get_module(name).kernels:
        assert "@wp.kernel" not in Path(importlib.import_module(name).__file__).read_text()
        return
    made = wp.compile_aot_module(wp.get_module(name), device=None, arch=90, module_dir=tmp_path, use_ptx=True)
    assert [path for path in map(Path, made) if path.suffix == ".ptx" and ".target sm_90" in path.read_text()]


@pytest.fixture(scope="module")
def gpu():
    import warp as wp

    from bayesmap.kernels import device

    device.start()
    if not wp.is_cuda_available():
        pytest.skip("no CUDA device on this machine")
    return "cuda:0"


@cache
def room():
    """Scans in a room of 12 x 10 cells with a pillar, with two places of the robot."""
    walls = np.zeros((12, 10), dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = walls[5, 4] = True
    grid = bm.Grid(walls.shape, resolution=0.5)
    angles_rad = np.linspace(-np.pi, np.pi, 60, endpoint=False)
    sensor = bm.BeamMixture(bm.Gaussian(0.1), p_random=0.02, p_no_return=0.02)
    poses = [[1.8, 1.4, 0.1], [4.3, 3.3, 2.0]]
    return bm.simulate(walls, grid, poses, angles_rad, sensor=sensor, max_range_m=8.0, seed=3), grid, sensor


METHODS = {
    **{f"gibbs, {order}": (bm.Independent(0.2), {"order": order}) for order in ("raster", "radial", "random")},
    "block": (bm.Independent(0.2), {"method": "block"}), "coupled cells": (bm.Ising(0.2, 0.5), {}),
    "coupled cells, block": (bm.Ising(0.2, 0.5), {"method": "block"}),
    "importance": (bm.Independent(0.2), {"method": "importance", "particles": 1000}),
    "propagation": (bm.Independent(0.2), {"method": "propagate"}), "reflectivity": (bm.Beta(), {}),
    "surfaces": (bm.Surface(), {}), "coupled surfaces": (bm.Surface(coupling=0.5), {}),
    "uncertain poses": (bm.Independent(0.2), {"poses": bm.UncertainPoses(0.05, 0.02)}),
    "uncertain poses, surfaces": (bm.Surface(), {"poses": bm.UncertainPoses(0.05, 0.02)}),
}  # fmt: skip
SHORT = {"chains": 8, "warmup": 2, "draws": 4, "thin": 1, "seed": 5}


def inferred(device, prior, options):
    scans, grid, sensor = room()
    short = {} if options.get("method") in ("propagate",) else SHORT
    return infer(scans, grid, prior=prior, sensor=sensor, device=device, **short, **options)


@pytest.mark.parametrize("name", METHODS)
def test_a_gpu_draws_what_the_cpu_draws(name, gpu):
    """Random numbers are the same; rounding differs in the last bits, and now and then decides a draw."""
    here, there = (inferred(device, *METHODS[name]) for device in ("cpu", gpu))
    if METHODS[name][1].get("method") == "propagate":
        np.testing.assert_allclose(there.occupancy, here.occupancy, atol=1e-4)
        return
    apart = np.abs(np.asarray(here.draws, float) - np.asarray(there.draws, float))
    assert np.isfinite(apart).all()
    assert np.mean(apart > 1e-3) < 0.02, f"{np.mean(apart > 1e-3):.2%} of the draws' cells differ"


@pytest.mark.parametrize("name", ["gibbs, radial", "reflectivity", "surfaces"])
def test_a_gpu_scores_as_the_cpu_does(name, gpu):
    scans, *_ = room()
    run = inferred("cpu", *METHODS[name])
    assert run.log_score(scans, device=gpu) == pytest.approx(run.log_score(scans), abs=1e-4)
    where = [bm.localize(run, scans, device=device, seed=2) for device in ("cpu", gpu)]
    np.testing.assert_allclose(where[1].mean, where[0].mean, atol=0.01)


def test_a_gpu_traces_the_beams_that_the_cpu_traces(gpu):
    from bayesmap.kernels.walls.table import trace

    scans, grid, sensor = room()
    here, there = (trace(scans, grid, sensor, device=device) for device in ("cpu", gpu))
    np.testing.assert_array_equal(there.offsets, here.offsets)
    np.testing.assert_array_equal(there.cells, here.cells)
    np.testing.assert_allclose(there.loglik, here.loglik, rtol=1e-4, atol=1e-5)
