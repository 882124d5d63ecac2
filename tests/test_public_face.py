"""The names that users rely on (DESIGN section 5), and what they are told when their input cannot be used."""

import inspect
import subprocess
import sys
import types

import numpy as np
import pytest
from flat_options import grouped

import bayesmap as bm
from bayesmap.poses import trajectory as poses
from bayesmap.space import trajectory as space

WALLS, POSE = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 1]], dtype=bool), [0.5, 0.5, 0.3]
GRID = bm.Grid((3, 3))
ANGLES = np.linspace(0, 2 * np.pi, 8, endpoint=False)
SENSOR, PRIOR = bm.Gaussian(0.2), bm.Independent(0.3)


@pytest.fixture(scope="module")
def scans():
    return bm.simulate(WALLS, GRID, POSE, ANGLES, sensor=SENSOR, max_range_m=6.0, seed=0)


@pytest.fixture(scope="module")
def run(scans):
    return bm.infer(scans, GRID, prior=PRIOR, sensor=SENSOR, schedule=bm.Schedule(chains=2, warmup=20, draws=30))


def test_every_public_name_is_there_and_listed():
    for name in bm.__all__:
        assert getattr(bm, name) is not None
    assert set(dir(bm)) >= set(bm.__all__)
    with pytest.raises(AttributeError, match="module 'bayesmap' has no attribute 'nonsense'"):
        bm.nonsense  # noqa: B018
    assert issubclass(bm.BadInput, ValueError)  # so that code which knows nothing of bayesmap can catch it


MOST_ARGUMENTS = 12
NOT_FOR_USERS = {"KnownMap", "BadInput"}  # users do not make them by their own constructors: not counted


METHOD_KINDS = (types.FunctionType, classmethod, staticmethod)


def public_functions():
    """The public functions, constructors and methods, by name."""
    for name in bm.__all__:
        thing = getattr(bm, name)
        if inspect.isclass(thing):
            members = inspect.getmembers_static(thing, lambda member: isinstance(member, METHOD_KINDS))
            yield from ((f"{name}.{inner}", getattr(thing, inner)) for inner, _ in members if inner[0] != "_")
        if callable(thing) and name not in NOT_FOR_USERS:
            yield name, thing


def arguments_of(function):
    return [name for name in inspect.signature(function).parameters if name not in ("self", "cls")]


def test_public_functions_take_at_most_a_dozen_arguments():
    counts = {name: len(arguments_of(function)) for name, function in public_functions()}
    assert {"infer", "slam", "Scans", "Run.plan"} <= set(counts)
    assert {name: count for name, count in counts.items() if count > MOST_ARGUMENTS} == {}
    assert len(arguments_of(lambda a, *, b, **others: None)) == 3  # power of this test


def test_the_plain_call_needs_scans_and_a_grid_alone(scans):
    """With the default prior, sensor and method it is the call that says them."""
    short = bm.Schedule(chains=1, warmup=3, draws=2)
    said = bm.infer(scans, GRID, prior=bm.Surface(), sensor="fit", method=bm.Gibbs(), seed=1, schedule=short)
    np.testing.assert_array_equal(bm.infer(scans, GRID, seed=1, schedule=short).draws, said.draws)


@pytest.mark.parametrize(("make", "message"), [
    (lambda scans: bm.infer(scans, GRID, schedule=100), r"schedule must be one such as bm.Schedule\(\), got 100"),
    (lambda scans: bm.infer(scans, GRID, where="cuda:0"), r"where must be one such as bm.Where\(\), got 'cuda:0'"),
    (lambda scans: bm.infer(scans, GRID, checkpoints="run.nc"), r"checkpoints must be one such as bm.Checkpoints"),
    (lambda scans: bm.slam(scans, where=8), r"slam: where must be one such as bm.Where\(\), got 8"),
    (lambda scans: bm.slam(scans, resolution=0.0), "grid: resolution must be a positive number of metres, got 0.0"),
    (lambda scans: bm.slam(scans, resolution=1e-5), "cells is over the limit of 100,000,000; use a coarser"),
    (lambda scans: bm.infer(scans, GRID, method=bm.Block()), r"Surface has one method, 'gibbs', got Block\("),
    (lambda scans: bm.infer(scans, GRID, method=bm.Gibbs), "Surface has one method, 'gibbs', got <class"),
    (lambda scans: bm.Where(executor="ray"), r"executor must be one such as bm.RayExecutor\(\), .*got 'ray'"),
    (lambda scans: bm.Where(executor=bm.RayExecutor), "executor must be one such as"),
    (lambda scans: bm.Where(device=0), "device must be a name such as 'cpu' or 'cuda:0', got 0"),
    (lambda scans: bm.Checkpoints(resume="run.nc"), r"resume must be a run, such as bm.load\('run.nc'\)"),
    (lambda scans: bm.Checkpoints(save="run.nc"), "save must be a function that takes a run, got 'run.nc'"),
    (lambda scans: bm.Checkpoints(every_s=-1), "every_s must be 0 or a positive number of seconds, got -1"),
])  # fmt: skip
def test_values_that_group_arguments_are_checked(scans, make, message):
    with pytest.raises(bm.BadInput, match=message):
        make(scans)


@pytest.mark.parametrize("function", [bm.infer, bm.slam, bm.read_log, bm.simulate, bm.localize, bm.score])
def test_an_unknown_keyword_is_answered_with_the_nearest(function):
    name = next(reversed(inspect.signature(function).parameters))
    with pytest.raises(TypeError, match=rf"got an unexpected keyword argument '{name}x'. Did you mean '{name}'\?"):
        function(**{f"{name}x": 1})


def test_importance_has_weights_and_other_methods_say_that_they_have_none(scans, run):
    method, schedule = bm.Importance(particles=500), bm.Schedule(draws=5)
    weighted = bm.infer(scans, GRID, prior=PRIOR, sensor=SENSOR, method=method, schedule=schedule)
    assert np.exp(weighted.log_weights).sum() == pytest.approx(1.0)
    with pytest.raises(bm.BadInput, match="method 'gibbs' has no importance weights"):
        run.log_weights  # noqa: B018


def infer(scans, **change):
    flat = {"prior": PRIOR, "sensor": SENSOR, "draws": 2, "warmup": 0} | change
    return bm.infer(scans, flat.pop("grid", GRID), **grouped(**flat))


BAD = {
    "no such method": ({"method": "gibs"}, "Independent has the methods gibbs, block, .*, got 'gibs'"),
    "no such order": ({"order": "spiral"}, "order must be one of raster, radial, random, got 'spiral'"),
    "no such order of blocks": ({"method": "block", "order": "spiral"}, "order must be one of raster, radial, random"),
    "no such start": ({"start": "there"}, "start must be one of prior, zeros, ones, propagate or a map, got 'there'"),
    "a start of another shape": ({"start": np.zeros((2, 2))}, r"start has shape \(2, 2\), expected one map, \(3, 3\)"),
    "no chains": ({"chains": 0}, "chains must be a whole number of 1 or more, got 0"),
    "half a chain": ({"chains": 1.5}, "chains must be a whole number"),
    "true chains": ({"chains": True}, "chains must be a whole number"),
    "negative warm-up": ({"warmup": -1}, "warmup must be a whole number of 0 or more, got -1"),
    "endless draws": ({"draws": float("inf")}, "draws must be a whole number"),
    "draws in words": ({"draws": "many"}, "draws must be a whole number"),
    "no thinning": ({"thin": 0}, "thin must be a whole number of 1 or more, got 0"),
    "negative threads": ({"threads": -1}, "threads must be"),
    "half a thread": ({"threads": 1.5}, "threads must be"),
    "a negative seed": ({"seed": -1}, "seed must be"),
    "half a seed": ({"seed": 0.5}, "seed must be"),
    "no particles": ({"method": "importance", "particles": 0}, "particles must be a whole number of 1 or more, got 0"),
    "no rounds": ({"method": "propagate", "rounds": 0}, "rounds must be a whole number of 1 or more, got 0"),
    "hits behind cells": ({"hit_depth": 1.5}, r"hit_depth must lie in \[0, 1\], got 1.5"),
    "no such device": ({"device": "tpu:7"}, "'tpu:7' is not on this machine; there is: cpu"),
    "poses in a word": ({"poses": "odometry"}, r"poses must say what is believed of them, such as .*got 'odometry'"),
    "a kind of poses": ({"poses": bm.Odometry}, "poses must say what is believed of them"),
    "a prior of another shape": (
        {"prior": bm.Independent(np.full((2, 2), 0.5))}, r"p_wall has shape \(2, 2\), but the grid is \(3, 3\)",
    ),
    "too many cells to enumerate": (
        {"method": "exact", "grid": bm.Grid((30, 30), 0.1)}, "cells are unknown, and enumeration takes at most 16",
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", BAD)
def test_arguments_that_make_no_sense_are_refused_with_place_and_remedy(scans, what):
    change, message = BAD[what]
    with pytest.raises(bm.BadInput, match=message):
        infer(scans, **change)


def simulated(**change):
    return bm.simulate(WALLS, GRID, POSE, ANGLES, **{"sensor": SENSOR, "max_range_m": 5.0} | change)


@pytest.mark.parametrize(("make", "message"), [
    (lambda: bm.Independent(1.5), r"p_wall must lie in \[0, 1\], got 1.5"),
    (lambda: bm.Independent(np.nan), "p_wall must lie in"),
    (lambda: bm.Independent(np.array([[0.5, -0.1]])), "p_wall must lie in .*got -0.1"),
    (lambda: bm.Independent(np.array([0.5])), r"a number or an \(nx, ny\) array, got shape \(1,\)"),
    (lambda: bm.ranges(WALLS[:2], GRID, POSE, ANGLES, 5.0), r"walls have shape \(2, 3\), but the grid is \(3, 3\)"),
    (lambda: bm.ranges(WALLS, GRID, POSE, ANGLES, 0.0), "max_range_m must be a positive number of metres, got 0.0"),
    (lambda: bm.ranges(WALLS, GRID, POSE, ANGLES, np.nan), "max_range_m must be a positive"),
    (lambda: bm.ranges(WALLS, GRID, [0.5, 0.5], ANGLES, 5.0), r"poses has shape \(1, 2\), expected \(S, 3\)"),
    (lambda: bm.ranges(WALLS, GRID, [0.5, np.nan, 0], ANGLES, 5.0), "pose of scan 0 is not finite"),
    (lambda: bm.ranges(WALLS, GRID, POSE, [], 5.0), "at least one beam"),
    (lambda: bm.ranges(WALLS, GRID, POSE, [0.0, np.inf], 5.0), "angle of beam 1 is not finite: inf"),
    (lambda: simulated(max_range_m=np.inf), "max_range_m must be a positive"),
    (lambda: simulated(opacity=np.ones((2, 2))), "opacity"), (lambda: simulated(seed=-1), "seed"),
    (lambda: bm.load("nowhere.nc"), "nowhere.nc: no such file"), (lambda: bm.read_log("nowhere.log"), "nowhere.log"),
])  # fmt: skip
def test_bad_input_is_refused_before_anything_is_done(make, message):
    with pytest.raises(bm.BadInput, match=message):
        make()


def test_numpy_s_numbers_are_numbers_and_walls_of_any_number_type_are_walls(scans):
    """Seeds from np.arange and noise levels from np.linspace are what loops over settings hand in."""
    expected = bm.ranges(WALLS, GRID, POSE, ANGLES, 5.0)
    for dtype in (np.uint8, np.int64, np.float64):
        np.testing.assert_array_equal(bm.ranges(WALLS.astype(dtype), GRID, POSE, ANGLES, 5.0), expected)
    plain = infer(scans, seed=3, chains=2, draws=4, prior=bm.Independent(0.25), sensor=bm.Gaussian(0.5))
    numpy = infer(
        scans, seed=np.int64(3), chains=np.int32(2), draws=np.int64(4), prior=bm.Independent(np.float32(0.25)),
        sensor=bm.Gaussian(np.float32(0.5)), hit_depth=np.float32(0.0),
    )  # fmt: skip
    np.testing.assert_array_equal(numpy.draws, plain.draws)


def test_infer_does_not_touch_its_arguments(scans):
    before = scans.ranges_m.copy(), scans.poses.copy()
    p = np.full((3, 3), 0.3)
    infer(scans, prior=bm.Independent(p), method="block", draws=20)
    np.testing.assert_array_equal(scans.ranges_m, before[0])
    np.testing.assert_array_equal(scans.poses, before[1])
    assert (p == 0.3).all()


def test_nothing_is_printed():
    """Not by Warp either: standard output belongs to the user."""
    code = "import bayesmap as bm; w, p = bm.worlds.tutorial(); bm.ranges(w, bm.worlds.TUTORIAL_GRID, p, [0.0], 5.0)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")


def test_results_print_as_a_few_short_lines(run, scans):
    """An array in a repr fills a screen: 900 poses make the arrays of a trajectory long."""
    many, own = np.zeros((900, 3)), np.array([np.eye(3)] * 900)
    none, index = np.empty(0), np.empty(0, int)
    results = [
        run, bm.KnownMap.of_run(run), scans, scans.select(slice(0, 0)), run.pose_summary(), bm.score(run, scans),
        bm.localize(run, scans, prior=bm.InitialPose(POSE, 0.1, 0.1)), bm.localize(run, scans).last,
        run.plan([0.5, 0.5], [1.5, 0.5], 0.05, 0.9), run.information_gain([POSE], ANGLES),
        space.Trajectory(many, np.arange(900.0), own, many[None], known_by="wheels"), space.Trajectory(many),
        poses.InferredTrajectory(
            many, None, index, None, index, own, many[:, 0], many[:, 0] > 0, index,
            poses.LoopClosures(index, index, none, none, none), None, index,
        ),
    ]  # fmt: skip
    for result in results:
        title, *lines = repr(result).splitlines()
        assert title.startswith(f"{type(result).__name__}: ")
        assert len(lines) <= 5
        assert max(map(len, (title, *lines))) <= 120
        assert "array(" not in repr(result)
    assert "900 scans" in repr(results[-1])
    assert "899.0 s" in repr(results[-3])
    assert "0.5" in repr(results[6])


def test_without_jax_programs_say_how_to_install_it():
    """In a process of its own, in which JAX cannot be imported."""
    for use in ("import bayesmap.gen", "import bayesmap as bm; bm.mapping_model"):
        code = f"import sys; sys.modules['jax'] = None\n{use}"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=300)
        assert done.stderr.splitlines()[-1] == "ImportError: bayesmap.gen needs JAX: pip install 'bayesmap[gen]'"
