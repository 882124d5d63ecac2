"""The cost of a run is estimated before it begins, and what cannot fit into memory is refused with a remedy."""

from dataclasses import replace

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.api import Inference, estimate_slam
from bayesmap.run import cost
from bayesmap.run.chains import SweepPlan
from bayesmap.run.cost import Sampling, Size, size_of

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
    return Inference.of(scans, grid, prior, SENSOR, None, schedule, 0, None, 0.5, bm.Where(**where))


@pytest.mark.parametrize("prior", [bm.Surface(), bm.Beta(), bm.Independent(0.2)], ids=["surfaces", "betas", "walls"])
def test_incidences_and_the_size_of_a_draw_are_foreseen(prior):
    scans = room()
    grid = bm.Grid.covering(scans, 0.1)
    run = bm.infer(scans, grid, prior=prior, sensor=SENSOR, schedule=SHORT)
    size, draws = size_of(scans, grid), run.posterior.draws
    assert size.incidences == pytest.approx(run.posterior.counts["incidences"], rel=0.15)
    asked = Sampling("stop-gibbs", draws.specs, False, 1, SweepPlan(1, 1), False, False, 1)
    assert asked.draw_bytes(size) == pytest.approx(sum(array.nbytes for array in draws.arrays.values()), rel=0.3)


def test_a_beam_without_return_ends_at_the_edge_of_the_grid():
    scans = replace(SCANS, ranges_m=np.full((3, 1), np.inf), max_range_m=1e4)
    size = size_of(scans, bm.Grid((40, 20), 0.1))
    assert size.incidences == pytest.approx(cost.CELLS_A_CELL_LENGTH * (30 + 20 + 10))


INTEL = Size(147_420, 6_423_475, 147_287, 100_704, 10_844, 147_420)
FIVE = Size(151_200, 5_881_192, 144_270, 90_000, 29_000, 2_160_000, 3000)


@pytest.mark.parametrize(
    ("size", "plan", "seconds", "memory_mb"),
    [
        (INTEL, SweepPlan(30, 50), 75.0, None),
        (INTEL, SweepPlan(30, 10, 3), None, 614.0),
        (FIVE, SweepPlan(30, 50), 124.0, 900.0),
        (FIVE, SweepPlan(30, 72, 3), 254.0, 1052.0),
    ],
)
def test_measured_runs_are_within_a_third_of_their_estimates(size, plan, seconds, memory_mb):
    """Processor times and peaks as docs/scale.md has them; the twin of another unit or a lost term is far outside."""
    sampling = Sampling("stop-gibbs", bm.Surface().arrays, True, 4, plan, True, False, 1)
    if seconds is not None:
        assert sampling.processor_s(size, plan.draws) == pytest.approx(seconds, rel=1 / 3)
    if memory_mb is not None:
        assert sampling.memory(size, plan.draws) / 1e6 == pytest.approx(memory_mb, rel=0.15)


def test_chains_that_may_end_early_have_two_estimates_and_a_limit_of_time_bounds_both():
    found = inference(room(), schedule=bm.Schedule()).estimate()
    assert found.memory[0] < found.memory[1]
    assert found.seconds[0] < found.seconds[1]
    assert found.processor_s[1] == pytest.approx(found.seconds[1] * found.cores)
    many = room(0.02, 360)
    free, limited = (inference(many, schedule=bm.Schedule(seconds=s)).estimate().seconds[1] for s in (None, 3.0))
    assert limited < 0.5 * free


def test_on_a_gpu_and_for_other_samplers_nothing_is_said_of_time():
    assert inference(room(), device="cuda:0").estimate() is None
    grid = bm.Grid.covering(SCANS, 0.1)
    exact = Inference.of(SCANS, grid, bm.Independent(0.2), SENSOR, "propagate", SHORT, 0, None, 0.5, bm.Where())
    assert exact.estimate().seconds is None
    assert "GB of memory" in exact.estimate().words()


@pytest.mark.parametrize(
    ("scans", "grid", "option"),
    [
        (room(0.05, 360), None, "--thin-scans 0.1"),
        (room(2.0, 4), bm.Grid((2000, 2000), 0.01), "--resolution 0.02"),
    ],
    ids=["scans that are close together", "small cells"],
)
def test_the_remedy_fits_the_cause_and_makes_it_fit(monkeypatch, scans, grid, option):
    monkeypatch.setattr(cost, "memory_bytes", lambda: None)
    most = inference(scans, grid).estimate().memory[1]
    assert inference(scans, grid).estimate().remedy == ""
    monkeypatch.setattr(cost, "memory_bytes", lambda: int(most / cost.MUCH_MEMORY) - 1)
    assert inference(scans, grid).estimate().remedy == option


def test_few_hits_far_away_are_cut_off(monkeypatch):
    scans = room()
    ranges = scans.ranges_m.copy()
    ranges[0, :3] = 300.0
    far = replace(scans, ranges_m=ranges, max_range_m=400.0)
    monkeypatch.setattr(cost, "memory_bytes", lambda: int(9e8))
    assert inference(far).estimate().remedy == "--max-range 10"


def test_a_long_run_is_shorter_with_fewer_scans_else_with_a_limit(monkeypatch):
    monkeypatch.setattr(cost, "LONG_S", 1e-3)
    monkeypatch.setattr(cost, "memory_bytes", lambda: None)
    assert "; less with --thin-scans 0.1" in inference(room(0.02)).estimate().words()
    assert inference(room(1.0)).estimate().remedy == "--seconds 0.001"
    assert inference(room(1.0), schedule=bm.Schedule(seconds=1.0)).estimate().remedy == ""


def test_slam_is_estimated_from_as_many_scans_as_will_be_keys():
    few, many = (
        estimate_slam(room(step, width_m=60.0), 0.1, None, SENSOR, None, False, SHORT, bm.Where())
        for step in (0.45, 0.05)
    )
    log, more = 130, 1160
    assert many.processor_s[0] - few.processor_s[0] == pytest.approx(cost.MATCH_S_A_SCAN * (more - log), rel=0.3)


@pytest.mark.parametrize("prior", [bm.Surface(), bm.Beta(), bm.Independent(0.2)], ids=["surfaces", "betas", "walls"])
def test_what_cannot_fit_is_refused_unless_it_is_asked_for(monkeypatch, prior):
    grid = bm.Grid((40, 50), 0.1)

    def infer(**where):
        return bm.infer(SCANS, grid, prior=prior, sensor=SENSOR, schedule=SHORT, where=bm.Where(**where))

    least = inference(SCANS, grid, prior=prior).estimate().memory[0]
    monkeypatch.setattr(cost, "memory_bytes", lambda: int(least) + 1)
    infer()
    monkeypatch.setattr(cost, "memory_bytes", lambda: int(least) - 1)
    with pytest.raises(bm.BadInput, match=r"takes at least 0.4 GB, .* smaller with --.*any_size=True"):
        infer()
    infer(any_size=True)
    monkeypatch.setattr(cost, "memory_bytes", lambda: None)
    infer()


def test_slam_is_refused_before_the_trajectory(monkeypatch):
    monkeypatch.setattr(cost, "memory_bytes", lambda: 1 << 20)
    monkeypatch.setattr("bayesmap.poses.slam.infer_trajectory", None)
    with pytest.raises(bm.BadInput, match="at least"):
        bm.slam(room())


def test_a_scan_that_is_far_from_all_others_is_named(monkeypatch):
    monkeypatch.setattr(cost, "memory_bytes", lambda: 1 << 20)
    with pytest.raises(bm.BadInput, match=r"scan 2 was taken at \(900, 1\) m, far from all others; correct its pose"):
        bm.infer(FAR, bm.Grid.covering(FAR, 0.5), prior=bm.Surface(), sensor=SENSOR)


def test_containers_may_take_less_than_the_machine_has(monkeypatch, tmp_path):
    limit, none = tmp_path / "limit", tmp_path / "none"
    limit.write_text("12345\n")
    none.write_text("max\n")
    assert cost.memory_bytes() is None or cost.memory_bytes() > 1 << 28
    monkeypatch.setattr(cost, "GROUP_LIMITS", (str(none), str(tmp_path / "missing")))
    assert cost.memory_bytes() != 12345
    monkeypatch.setattr(cost, "GROUP_LIMITS", (str(none), str(limit)))
    assert cost.memory_bytes() == 12345
