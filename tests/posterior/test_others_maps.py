"""Maps of other programs: what occupied, free and unknown mean is fitted, cell by cell of the map that was given."""

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.posterior.baselines import Baseline, fit_baseline, fit_external_map, stop_probabilities
from bayesmap.posterior.scores import score_prediction


@pytest.fixture(scope="module")
def seen():
    """A room in the middle of a grid of which beams touch less than a half: its map, and scans in it."""
    grid = bm.Grid((64, 48), 0.125)
    occupancy = np.full(grid.shape, np.nan)
    occupancy[20:52, 12:36] = 1.0
    occupancy[21:51, 13:35] = 0.0
    occupancy[34:36, 22:25] = 1.0
    rng = np.random.default_rng(5)
    poses = np.column_stack([rng.uniform(2.8, 4.0, 40), rng.uniform(1.8, 4.2, 40), rng.uniform(-4, 4, 40)])
    sensor = bm.BeamMixture(bm.Gaussian(0.03, 0.005), 0.02, 0.01, 0.02, 0.5)
    scans = bm.simulate(
        occupancy == 1.0, grid, poses, np.linspace(0, 6.2, 60), sensor=sensor, max_range_m=6.0, seed=2
    )  # fmt: skip
    return occupancy, grid, *scans.holdout(5)


@pytest.fixture(scope="module")
def fit(seen):
    occupancy, grid, train, _ = seen
    return fit_external_map("true.yaml", occupancy, grid, train)


def test_the_true_map_is_understood_and_predicts(seen, fit):
    """It was not, while cells that beams touch were given the values of the first ones of the grid."""
    held = seen[-1]
    assert fit.values["stop_occupied"] > 0.3
    assert fit.values["stop_free"] < 0.01
    found = score_prediction(fit.predictor, held).nats_per_beam
    assert found > 1.0
    assert found == pytest.approx(fit.inner_nats_per_beam, abs=0.2)  # what was fitted is what is scored


@pytest.mark.full
def test_a_map_of_another_place_predicts_far_worse(seen, fit):
    occupancy, grid, train, held = seen
    found = score_prediction(fit.predictor, held).nats_per_beam
    shuffled = np.random.default_rng(1).permutation(occupancy.ravel()).reshape(grid.shape)
    wrong = fit_external_map("shuffled.yaml", shuffled, grid, train)
    assert score_prediction(wrong.predictor, held).nats_per_beam < found - 1.5


def test_what_was_fitted_is_the_predictor_s_map(seen, fit):
    occupancy, grid, _, _ = seen
    (stop,) = fit.predictor.batches(np.arange(grid.n_cells))
    np.testing.assert_allclose(stop[0], stop_probabilities(occupancy.ravel(), fit.values), rtol=1e-6)


def test_a_map_of_another_number_of_cells_is_an_error(seen):
    _, grid, train, _ = seen
    short = Baseline("short", lambda hits, passes, values: np.full(hits.size - 1, 0.1))
    with pytest.raises(ValueError, match="short: stop gave an array of shape"):
        fit_baseline(short, train, grid)


def test_a_map_of_another_shape_is_refused(seen):
    occupancy, grid, train, _ = seen
    with pytest.raises(bm.BadInput, match="must be probabilities of shape"):
        fit_external_map("turned.yaml", occupancy.T, grid, train)
