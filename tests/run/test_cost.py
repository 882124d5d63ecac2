"""A run's cost is estimated, too much is refused with a remedy, and it ends when the mean map is known well enough."""

import signal
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import scipy
from flat_options import infer

import bayesmap as bm
from bayesmap.api import ChosenLaws, Inference, estimate_slam
from bayesmap.run import cost
from bayesmap.run.chains import ERROR_QUANTILE, MIN_BATCHES, StoppingRule, SweepPlan, map_error
from bayesmap.run.cost import ProblemSize, Sampling, size_of

SCANS = bm.Scans([[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [3.0, 1.0, 0.0]], [0.0], [[0.5], [0.5], [0.5]], max_range_m=5.0)
FAR = bm.Scans([*SCANS.poses[:2], [900.0, 1.0, 0.0]], [0.0], SCANS.ranges_m, max_range_m=5.0)
SENSOR = bm.BeamMixture(bm.Gaussian(0.03), p_random=0.05)
SHORT = bm.Schedule(chains=1, warmup=1, draws=1)


def room(spacing_m=0.5, beams=90, width_m=10.0):
    """Scans on the way through a room of 8 m depth, without noise; no beam goes through a wall."""
    x = np.arange(1.0, width_m - 1.0, spacing_m)
    poses = np.stack([x, np.full_like(x, 3.0), np.zeros_like(x)], axis=-1)
    angles = np.linspace(-np.pi, np.pi, beams, endpoint=False)
    across = np.where(np.cos(angles) > 0, (width_m - x[:, None]), x[:, None]) / np.maximum(np.abs(np.cos(angles)), 1e-9)
    along = np.where(np.sin(angles) > 0, 5.0, 3.0) / np.maximum(np.abs(np.sin(angles)), 1e-9)
    return bm.Scans(poses, angles, np.minimum(across, along), max_range_m=20.0)


def inference(scans, grid=None, schedule=SHORT, prior=None, **where):
    grid = bm.Grid.covering(scans, 0.1) if grid is None else grid
    return Inference.of(scans, grid, ChosenLaws(prior, SENSOR, None, 0.5), None, schedule, 0, bm.Where(**where))


@pytest.mark.parametrize("prior", [bm.Surface(), bm.Beta(), bm.Independent(0.2)], ids=["surfaces", "betas", "walls"])
def test_incidences_and_the_size_of_a_draw_are_foreseen(prior):
    scans = room()
    grid = bm.Grid.covering(scans, 0.1)
    run = bm.infer(scans, grid, prior=prior, sensor=SENSOR, schedule=SHORT)
    size, draws = size_of(scans, grid), run.posterior.draws
    assert size.incidences == pytest.approx(run.posterior.counts["incidences"], rel=0.15)
    asked = Sampling("stop-gibbs", draws.specs, False, 1, SweepPlan(1, 1), False, False, 1)
    assert asked.draw_bytes(size) == pytest.approx(sum(array.nbytes for array in draws.arrays.values()), rel=0.3)
    silent = replace(SCANS, ranges_m=np.full((3, 1), np.inf), max_range_m=1e4)  # beams end at the edge of the grid
    expected = pytest.approx(cost.CELLS_PER_CELL_LENGTH * (30 + 20 + 10))
    assert size_of(silent, bm.Grid((40, 20), 0.1)).incidences == expected


INTEL = ProblemSize(147_420, 6_423_475, 147_287, 100_704, 10_844, 147_420)
FIVE = ProblemSize(151_200, 5_881_192, 144_270, 90_000, 29_000, 2_160_000, 3000)


@pytest.mark.parametrize(("size", "plan", "seconds", "memory_mb"), [
    (INTEL, SweepPlan(30, 50), 75.0, None), (INTEL, SweepPlan(30, 10, 3), None, 614.0),
    (FIVE, SweepPlan(30, 50), 124.0, 900.0), (FIVE, SweepPlan(30, 72, 3), 254.0, 1052.0),
])  # fmt: skip
def test_measured_runs_are_within_a_third_of_their_estimates(size, plan, seconds, memory_mb):
    """Processor times and peaks as docs/scale.md has them; the twin of another unit or a lost term is far outside."""
    sampling = Sampling("stop-gibbs", bm.Surface().arrays, True, 4, plan, True, False, 1)
    if seconds is not None:
        assert sampling.processor_s(size, plan.draws) == pytest.approx(seconds, rel=1 / 3)
    if memory_mb is not None:
        assert sampling.peak_bytes(size, plan.draws) / 1e6 == pytest.approx(memory_mb, rel=0.15)
    few = ProblemSize(1440, 55_052, 69_856, 15_280, 635, 432_000)  # two scans: their cells take longer than their beams
    many, one = (replace(sampling, plan=SweepPlan(30, 5, thin)).processor_s(few, 5) for thin in (16, 1))
    assert many - one == pytest.approx(300 * 7.2e-3, rel=1 / 3)


def test_chains_that_may_end_early_have_two_estimates_and_a_limit_of_time_bounds_both():
    found = inference(room(), schedule=bm.Schedule()).estimate()
    assert found.peak_bytes[0] < found.peak_bytes[1]
    assert found.seconds[0] < found.seconds[1]
    assert found.processor_s[1] == pytest.approx(found.seconds[1] * found.cores)
    many = room(0.02, 360)
    free, limited = (inference(many, schedule=bm.Schedule(seconds=s)).estimate().seconds[1] for s in (None, 3.0))
    assert limited < 0.5 * free
    assert inference(room(), device="cuda:0").estimate() is None
    grid = bm.Grid.covering(SCANS, 0.1)  # samplers whose time is unknown
    exact = Inference.of(SCANS, grid, ChosenLaws(bm.Independent(0.2), SENSOR), "propagate", SHORT, 0, bm.Where())
    assert exact.estimate().seconds is None
    assert "GB of memory" in exact.estimate().words()


def test_the_remedy_fits_the_cause_and_makes_it_fit_and_a_long_run_is_shorter_with_fewer_scans_or_a_limit(monkeypatch):
    """Scans that are close together are thinned, small cells enlarged, and few hits far away cut off."""
    for scans, grid, option in (
        (room(0.05, 360), None, "--thin-scans 0.1"), (room(2.0, 4), bm.Grid((2000, 2000), 0.01), "--resolution 0.02"),
    ):  # fmt: skip
        monkeypatch.setattr(cost, "memory_bytes", lambda: None)
        most = inference(scans, grid).estimate().peak_bytes[1]
        assert inference(scans, grid).estimate().remedy == ""
        monkeypatch.setattr(cost, "memory_bytes", lambda most=most: int(most / cost.LARGE_MEMORY_SHARE) - 1)
        assert inference(scans, grid).estimate().remedy == option
    ranges = room().ranges_m.copy()
    ranges[0, :3] = 300.0
    monkeypatch.setattr(cost, "memory_bytes", lambda: int(9e8))
    assert inference(replace(room(), ranges_m=ranges, max_range_m=400.0)).estimate().remedy == "--max-range 10"
    monkeypatch.setattr(cost, "LONG_S", 1e-3)
    monkeypatch.setattr(cost, "memory_bytes", lambda: None)
    assert "; less with --thin-scans 0.1" in inference(room(0.02)).estimate().words()
    assert inference(room(1.0)).estimate().remedy == "--seconds 0.001"
    assert inference(room(1.0), schedule=bm.Schedule(seconds=1.0)).estimate().remedy == ""


def test_slam_is_estimated_from_as_many_scans_as_will_be_keys():
    few, many = (
        estimate_slam(room(step, width_m=60.0), 0.1, ChosenLaws(None, SENSOR), None, False, SHORT, bm.Where())
        for step in (0.45, 0.05)
    )
    log, more = 130, 1160
    assert many.processor_s[0] - few.processor_s[0] == pytest.approx(cost.MATCHING_S_PER_SCAN * (more - log), rel=0.3)


@pytest.mark.parametrize("prior", [bm.Surface(), bm.Beta(), bm.Independent(0.2)], ids=["surfaces", "betas", "walls"])
def test_runs_that_cannot_fit_are_refused_unless_they_are_asked_for(monkeypatch, prior):
    grid = bm.Grid((40, 50), 0.1)

    def infer(**where):
        return bm.infer(SCANS, grid, prior=prior, sensor=SENSOR, schedule=SHORT, where=bm.Where(**where))

    least = inference(SCANS, grid, prior=prior).estimate().peak_bytes[0]
    monkeypatch.setattr(cost, "memory_bytes", lambda: int(least) + 1)
    infer()
    monkeypatch.setattr(cost, "memory_bytes", lambda: int(least) - 1)
    with pytest.raises(bm.BadInput, match=r"takes at least 0.4 GB, .* smaller with --.*any_size=True"):
        infer()
    infer(any_size=True)
    monkeypatch.setattr(cost, "memory_bytes", lambda: None)
    infer()
    monkeypatch.setattr(cost, "memory_bytes", lambda: 1 << 20)
    with pytest.raises(bm.BadInput, match=r"scan 2 was taken at \(900, 1\) m, far from all others; correct its pose"):
        bm.infer(FAR, bm.Grid.covering(FAR, 0.5), prior=prior, sensor=SENSOR)
    monkeypatch.setattr("bayesmap.poses.slam.infer_trajectory", None)  # slam is refused before the trajectory
    with pytest.raises(bm.BadInput, match="at least"):
        bm.slam(room())


def test_containers_may_take_less_than_the_machine_has(monkeypatch, tmp_path):
    limit, none = tmp_path / "limit", tmp_path / "none"
    limit.write_text("12345\n")
    none.write_text("max\n")
    assert cost.memory_bytes() is None or cost.memory_bytes() > 1 << 28
    monkeypatch.setattr(cost, "CONTAINER_LIMIT_FILES", (str(none), str(tmp_path / "missing")))
    assert cost.memory_bytes() != 12345
    monkeypatch.setattr(cost, "CONTAINER_LIMIT_FILES", (str(none), str(limit)))
    assert cost.memory_bytes() == 12345


CELLS, CHAINS, DRAWS, STICKY = 4000, 4, 400, 0.8


class Traces:
    """Stands for cells and their draws: what each draw expects of each cell, (chains, draws, cells)."""

    def __init__(self, values):
        self.values, (self.chains, self.count, _) = values, values.shape

    def expected_traces(self, draws, cells):
        return self.values[:, :, cells]


def error(values):
    return map_error(Traces(values), Traces(values), np.ones((1, values.shape[-1]), dtype=bool))


@cache
def sticky_chains():
    """Draw autoregressive chains of standard normal values: each is 0.8 of the one before it, and noise."""
    values = np.random.default_rng(4).standard_normal((CHAINS, DRAWS, CELLS))
    for i in range(1, DRAWS):
        values[:, i] = STICKY * values[:, i - 1] + np.sqrt(1 - STICKY**2) * values[:, i]
    return values


def expected_error(sd):
    """The 99 % quantile of an estimate from eight batches whose mean has a standard deviation."""
    degrees = MIN_BATCHES - 1
    return sd * np.sqrt(scipy.stats.chi2(degrees).ppf(ERROR_QUANTILE) / degrees)


def test_the_error_is_that_of_the_mean_of_chains_that_mix_slowly():
    """A quantile over 4000 cells has a relative error of 1 %; neighbouring batches are alike by 5 %."""
    values = sticky_chains()
    true = np.sqrt((1 + STICKY) / (1 - STICKY) / (CHAINS * DRAWS))
    assert values.mean(axis=(0, 1)).std() == pytest.approx(true, rel=0.05)
    assert error(values) == pytest.approx(expected_error(true), rel=0.1)
    shuffled = np.random.default_rng(5).permuted(values.reshape(-1, CELLS), axis=0).reshape(values.shape)
    assert error(shuffled) < 0.5 * expected_error(true)  # the twin: draws taken as independent


def test_chains_that_disagree_or_have_too_few_draws_do_not_know_the_map():
    """Nothing changes within a chain: each alone would be sure."""
    assert error(np.broadcast_to(np.array([0.0, 1.0, 0.0, 1.0])[:, None, None], (4, 50, 10))) > 0.15
    assert error(np.zeros((4, 50, 10))) == 0.0
    for chains, draws in ((4, 3), (1, 15), (8, 1)):
        assert error(np.zeros((chains, draws, 3))) == float("inf")
        assert error(np.zeros((chains, draws + 1, 3))) == 0.0


WALLS, POSE = bm.worlds.tutorial()
GRID = bm.worlds.TUTORIAL_GRID
ASKED = {"prior": bm.Independent(0.3), "sensor": bm.Gaussian(0.2), "warmup": 20, "draws": 400, "seed": 3}


@cache
def scans():
    angles = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    return bm.simulate(WALLS, GRID, POSE, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=0)


@cache
def stopped_early(threads=2):
    return infer(scans(), GRID, precision=0.04, threads=threads, **ASKED)


def test_chains_stop_at_the_first_mark_at_which_the_map_is_known_with_the_draws_of_longer_ones():
    run, marks = stopped_early(), SweepPlan(20, 400, 1, 0.04).marks
    at = marks.index(run.posterior.sweep)
    assert run.finished
    assert run.summary().map_error <= 0.04
    assert run.summary().problems() == []
    assert infer(scans(), GRID, **ASKED | {"draws": marks[at - 1] - 20}).summary().map_error > 0.04

    longer = infer(scans(), GRID, **ASKED)
    assert longer.n_draws == 400
    np.testing.assert_array_equal(longer.draws[:, : run.n_draws], run.draws)
    np.testing.assert_array_equal(stopped_early(threads=1).draws, run.draws)


@pytest.mark.parametrize("after", [10, 20, 30, 41, 60])
def test_a_run_that_is_stopped_and_goes_on_ends_where_it_would_have(after):
    """Ctrl-C during warm-up, at its end, at a mark, and between two."""

    def stop(event):
        if event.stage in ("warm-up", "draws") and event.done >= after:
            signal.raise_signal(signal.SIGINT)

    stopped = infer(scans(), GRID, precision=0.04, on_progress=stop, **ASKED)
    assert not stopped.finished
    run = infer(scans(), GRID, precision=0.04, resume=stopped, **ASKED)
    assert run.finished
    np.testing.assert_array_equal(run.draws, stopped_early().draws)


def test_a_default_run_stops_early_a_number_of_draws_is_kept_to_and_a_limit_that_comes_first_is_said():
    run = infer(scans(), GRID, precision=0.001, **ASKED | {"draws": 40})
    assert run.n_draws == 40
    [problem] = run.summary().problems()
    assert "good up to 0.0015: infer more draws" in problem
    cells = {"prior": bm.Independent(0.3), "sensor": bm.Gaussian(0.2), "seed": 3}
    assert bm.infer(scans(), GRID, **cells).n_draws < 1000
    assert bm.infer(scans(), GRID, schedule=bm.Schedule(draws=70), **cells).n_draws == 70
    for precision in (0.0, -1.0, float("nan")):
        with pytest.raises(bm.BadInput, match="precision must be a positive probability"):
            bm.Schedule(precision=precision)


def test_marks_are_fixed_and_progress_expects_the_first_and_then_what_the_error_asks_for():
    assert SweepPlan(50, 60, 3, 0.03).marks == (80, 95, 110, 125, 143, 164, 191, 224)
    assert SweepPlan(50, 60, 3).marks == ()
    rule = StoppingRule(SweepPlan(50, 60, 3, 0.03), lambda: 0.06)
    rule.check(20)
    assert (rule.expected_sweeps(20), rule.error, rule.is_met, rule.end_is_open) == (80, None, False, True)
    rule.check(80)
    assert (rule.expected_sweeps(80), rule.error, rule.is_met, rule.end_is_open) == (50 + 4 * 30, 0.06, False, False)
    assert StoppingRule(SweepPlan(50, 60, 3), lambda: 0.0).expected_sweeps(20) == 230
