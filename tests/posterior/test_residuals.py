"""Residuals of held-out readings, places with respect to a surface, and shares of work that are reported."""

import numpy as np
import pytest
from oracle.stop_worlds import scans_of_all_kinds

import bayesmap as bm
from bayesmap.cells.arrays import Draws, pack
from bayesmap.cells.binary import Independent
from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior
from bayesmap.posterior.prediction import compare, predictor_of, residuals_of, surface_offset
from bayesmap.posterior.scores import beam_log_scores
from bayesmap.samplers.sampler import Snapshot
from bayesmap.sensors.model import BeamMixture, Gaussian
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

CORRIDOR = Grid((10, 1))
PRIOR = Independent(0.5)
SENSOR = BeamMixture(Gaussian(0.05), p_random=0.01, p_no_return=0.01, p_short=0.0)


def along(*ranges, max_range_m=9.0):
    """Beams from the middle of the corridor's first cell, along it."""
    poses = np.tile([0.5, 0.5, 0.0], (len(ranges), 1))
    return Scans(poses, np.zeros(1), np.array(ranges, dtype=float)[:, None], max_range_m)


def run(*draws, grid=CORRIDOR):
    """A posterior of given draws, each a list of walls, of beams that stop in the middle of cells."""
    walls = np.zeros((len(draws), grid.n_cells), dtype=np.uint8)
    for row, cells in zip(walls, draws, strict=True):
        row[list(cells)] = 1
    packed = pack(walls.reshape(-1, *grid.shape) != 0)
    none = np.zeros((1, len(draws)))
    return Posterior(
        scans=along(1.0), sensor=SENSOR, prior=PRIOR, settings={"hit_depth": 0.5, "method": "gibbs"},
        draws=Draws(grid, PRIOR.arrays, {"walls": packed[None]}), occupancy=walls.mean(axis=0).reshape(grid.shape),
        observed=np.ones(grid.shape, dtype=bool), log_likelihood=none, log_prior=none, warmup_log_joint=none,
        snapshot=Snapshot(1), finished=True, seconds={}, counts={},
    )  # fmt: skip


def test_a_wall_is_where_readings_are_measured_from_by_the_median_over_draws():
    told = []
    found = residuals_of(predictor_of(run([6])), along(6.0, 5.5, 6.5), on_progress=told.append)
    assert told == pytest.approx([1 / 3, 1.0])
    np.testing.assert_allclose(found.residual_m, [0.0, -0.5, 0.5], atol=2e-3)  # the wall's middle is 6 m away
    np.testing.assert_allclose(found.ends_world, [[6.5, 0.5], [6.0, 0.5], [7.0, 0.5]])
    np.testing.assert_array_equal(found.beams, [0, 1, 2])
    assert found.surprise_nats[0] < found.surprise_nats[1] - 3
    for draws, expected in (([[4], [4], [8]], 4), ([[4], [8], [8]], 8), ([[], [], [4]], 9)):
        found = residuals_of(predictor_of(run(*draws)), along(5.0))
        np.testing.assert_allclose(found.residual_m, [5.0 - expected], atol=0.1)  # noise moves a median a little


def test_no_return_lies_at_the_median_moved_beams_end_where_each_began_and_scans_without_any_are_refused():
    scans = along(np.inf, np.inf, 4.0, np.nan, -np.inf)
    found = compare(scans, np.array([6.0, np.inf, np.inf, 6.0, 6.0]), np.arange(5.0))
    np.testing.assert_array_equal(found.beams, [0, 1, 2])
    np.testing.assert_allclose(found.residual_m, [3.0, 0.0, -5.0])
    np.testing.assert_allclose(found.ends_world[:, 0], [6.5, 9.5, 4.5])
    np.testing.assert_array_equal(found.surprise_nats, [0, -1, -2])
    beam_poses = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, np.pi / 2]]])
    scans = Scans([[0.0, 0.0, 0.0]], [0.0, np.pi / 2], [[2.0, 3.0]], 9.0, beam_poses=beam_poses)
    found = compare(scans, np.full(2, 1.0), np.zeros(2))
    np.testing.assert_allclose(found.ends_world, [[2.0, 0.0], [-2.0, 0.0]], atol=1e-12)
    with pytest.raises(BadInput, match="none of the scans has a hit or a no-return"):
        residuals_of(predictor_of(run([6])), along(np.nan, -np.inf))


THICK_M, LONG_M = 0.01, 0.2


def wall(direction_rad):
    """Covariance of a wall that runs in a direction."""
    t = np.array([np.cos(direction_rad), np.sin(direction_rad)])
    n = np.array([-t[1], t[0]])
    return LONG_M**2 * np.outer(t, t) + THICK_M**2 * np.outer(n, n)


@pytest.mark.parametrize("turn_rad", [0.0, 0.7, 2.5, -1.2])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_point_has_its_parts_across_and_along(turn_rad, side):
    """A wall along x at the origin, a sensor above or below it, all turned about the origin."""
    turn = np.array([[np.cos(turn_rad), -np.sin(turn_rad)], [np.sin(turn_rad), np.cos(turn_rad)]])
    sensor, point = turn @ [0.5, side * 2.0], turn @ [0.3, side * 0.04]
    found = surface_offset(np.zeros(2), wall(turn_rad), point, sensor)
    assert found.across_m == pytest.approx(0.04)  # in front of it, on whichever side the sensor stands
    # the sensor above looks down, so that larger x is on its left; from below it is on its right
    assert found.along_m == pytest.approx(side * 0.3)
    assert (found.thickness_m, found.length_m) == pytest.approx((THICK_M, LONG_M))
    assert found.incidence_rad == pytest.approx(np.arctan2(0.5, 2.0))
    behind = surface_offset(np.zeros(2), wall(turn_rad), turn @ [0.0, -side * 0.05], turn @ [0.0, side * 3.0])
    assert (behind.across_m, behind.incidence_rad) == pytest.approx((-0.05, 0.0), abs=1e-6)


CELL_KINDS = [bm.Independent(0.2), bm.Beta(0.5, 1.0), bm.Surface(0.5, 1.0)]


@pytest.mark.parametrize("prior", CELL_KINDS, ids=lambda prior: prior.words.kind)
def test_all_scores_give_equal_densities_bit_for_bit(prior):
    """The log score, the whole score, and the surprise of residuals are one kernel's, for every kind of cells."""
    grid, sensor = bm.Grid((4, 3), 0.5, (-1.0, 2.0)), bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_no_return=0.1)
    train, held = scans_of_all_kinds(5, grid, poses=20), scans_of_all_kinds(6, grid, poses=7)
    run = bm.infer(train, grid, prior=prior, sensor=sensor, schedule=bm.Schedule(chains=2, warmup=5, draws=8))
    for other in (None, bm.BeamMixture(bm.StudentT(0.1)), bm.Gaussian(0.2)):
        assert run.log_score(held, sensor=other) == bm.score(run, held, sensor=other).nats_per_beam
    predictor = predictor_of(run.posterior)
    found = residuals_of(predictor, held)
    np.testing.assert_array_equal(found.surprise_nats, -beam_log_scores(predictor, held)[found.beams])
