import numpy as np
import pytest

from bayesmap.cells.arrays import Draws, pack
from bayesmap.cells.binary import Independent
from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior
from bayesmap.posterior.predictor import compare, predictor_of, residuals_of
from bayesmap.posterior.scores import beam_log_scores
from bayesmap.samplers.sampler import Snapshot
from bayesmap.sensors.builtin import BeamMixture, Gaussian
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


def test_a_wall_is_where_readings_are_measured_from():
    told = []
    found = residuals_of(predictor_of(run([6])), along(6.0, 5.5, 6.5), on_progress=told.append)
    assert told == pytest.approx([1 / 3, 1.0])
    np.testing.assert_allclose(found.residual_m, [0.0, -0.5, 0.5], atol=2e-3)  # the wall's middle is 6 m away
    np.testing.assert_allclose(found.ends_world, [[6.5, 0.5], [6.0, 0.5], [7.0, 0.5]])
    np.testing.assert_array_equal(found.beams, [0, 1, 2])
    assert found.surprise_nats[0] < found.surprise_nats[1] - 3


def test_surprise_is_minus_the_log_score():
    posterior, scans = run([6], [6], [3]), along(6.1, np.inf, 2.0)
    np.testing.assert_array_equal(
        residuals_of(predictor_of(posterior), scans).surprise_nats, -beam_log_scores(predictor_of(posterior), scans)
    )


def test_half_of_the_draws_decide():
    for draws, expected in (([[4], [4], [8]], 4), ([[4], [8], [8]], 8), ([[], [], [4]], 9)):
        found = residuals_of(predictor_of(run(*draws)), along(5.0))
        np.testing.assert_allclose(found.residual_m, [5.0 - expected], atol=0.1)  # noise moves a median a little


def test_no_return_counts_as_the_largest_range_and_is_drawn_where_the_median_is():
    scans = along(np.inf, np.inf, 4.0, np.nan, -np.inf)
    found = compare(scans, np.array([6.0, np.inf, np.inf, 6.0, 6.0]), np.arange(5.0))
    np.testing.assert_array_equal(found.beams, [0, 1, 2])
    np.testing.assert_allclose(found.residual_m, [3.0, 0.0, -5.0])
    np.testing.assert_allclose(found.ends_world[:, 0], [6.5, 9.5, 4.5])
    np.testing.assert_array_equal(found.surprise_nats, [0, -1, -2])


def test_beams_of_a_sensor_that_moved_end_where_each_began():
    beam_poses = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, np.pi / 2]]])
    scans = Scans([[0.0, 0.0, 0.0]], [0.0, np.pi / 2], [[2.0, 3.0]], 9.0, beam_poses=beam_poses)
    found = compare(scans, np.full(2, 1.0), np.zeros(2))
    np.testing.assert_allclose(found.ends_world, [[2.0, 0.0], [-2.0, 0.0]], atol=1e-12)


def test_scans_that_say_nothing_are_refused():
    with pytest.raises(BadInput, match="none of the scans has a hit or a no-return"):
        residuals_of(predictor_of(run([6])), along(np.nan, -np.inf))
