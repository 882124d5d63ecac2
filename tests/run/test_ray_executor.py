"""Chains on a real Ray cluster of two nodes: the draws of threads, bit for bit, whatever dies."""

import numpy as np
import pytest

import bayesmap as bm

pytestmark = [pytest.mark.xdist_group("ray"), pytest.mark.filterwarnings("ignore::ResourceWarning")]

ANGLES = np.linspace(0, 2 * np.pi, 60, endpoint=False)
WALLS, POSE = bm.worlds.tutorial()
GRID = bm.worlds.TUTORIAL_GRID
SHORT = {"chains": 3, "warmup": 20, "draws": 30, "seed": 5}


@pytest.fixture(scope="module")
def scans():
    return bm.simulate(WALLS, GRID, POSE, ANGLES, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=0)


KINDS = {
    "walls": {"prior": bm.Independent(0.3), "sensor": bm.Gaussian(0.2)},
    "blocks of walls from belief propagation": {
        "prior": bm.Independent(0.3), "sensor": bm.Gaussian(0.2), "method": "block", "start": "propagate",
    },
    "reflectivities": {"prior": bm.Beta(), "sensor": bm.BeamMixture(bm.Gaussian(0.2))},
    "surfaces and a fitted sensor": {"prior": bm.Surface(), "sensor": "fit"},
}  # fmt: skip


def quick(**change):
    """An executor whose segments are so short that a small run has many."""
    return bm.RayExecutor(**{"segment_s": 0.01} | change)


def arrays_of(run):
    """All that the chains of a run have found."""
    posterior = run.posterior
    found = {f"draws {name}": values for name, values in posterior.draws.arrays.items()}
    found |= {f"snapshot {name}": values for name, values in posterior.snapshot.arrays.items()}
    found |= {f"statistics {name}": values for name, values in posterior.statistics.items()}
    found |= {"log joint": run.log_joint, "warm-up": posterior.warmup_log_joint, "observed": posterior.observed}
    return found


def assert_same(run, expected):
    assert run.finished == expected.finished
    assert run.posterior.sweep == expected.posterior.sweep
    got, want = arrays_of(run), arrays_of(expected)
    assert got.keys() == want.keys()
    for name, values in want.items():
        assert values.dtype == got[name].dtype
        np.testing.assert_array_equal(got[name], values, err_msg=name)


@pytest.mark.parametrize("kind", KINDS)
def test_the_draws_are_those_of_threads(cluster, scans, kind):
    arguments = {**SHORT, **KINDS[kind]}
    assert_same(bm.infer(scans, GRID, executor=quick(), **arguments), bm.infer(scans, GRID, **arguments))


def test_two_seeds_would_not_pass_for_one(scans):
    """Power of all that compares runs here."""
    one, other = (bm.infer(scans, GRID, **{**SHORT, **KINDS["walls"], "seed": seed}) for seed in (5, 6))
    with pytest.raises(AssertionError):
        assert_same(one, other)


@pytest.mark.parametrize("chains_per_task", [1, 2, 3])
def test_how_chains_are_divided_makes_no_difference(cluster, scans, chains_per_task):
    arguments = {**SHORT, **KINDS["walls"], "thin": 2}
    run = bm.infer(scans, GRID, executor=quick(chains_per_task=chains_per_task), **arguments)
    assert_same(run, bm.infer(scans, GRID, **arguments))


@pytest.mark.parametrize("kind", ["walls", "surfaces and a fitted sensor"])
def test_a_node_that_dies_costs_nothing_but_time(cluster, scans, kind):
    arguments = {**SHORT, **KINDS[kind], "warmup": 100, "draws": 200}
    killed = []

    def on_progress(event):
        if event.stage == "warm-up" and not killed:
            assert event.done < event.total
            cluster.kill()
            killed.append(event.done)

    run = bm.infer(scans, GRID, executor=quick(), on_progress=on_progress, **arguments)
    assert killed
    assert_same(run, bm.infer(scans, GRID, **arguments))
