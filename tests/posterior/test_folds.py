"""Training scans that are left out of a map and predicted: each once, and all in one go as one by one."""

import dataclasses

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.kernels.counts import count_hits
from bayesmap.kernels.predict.density import log_densities
from bayesmap.posterior.baselines import hit_ratio
from bayesmap.posterior.heldout import FOLDS, make_folds, one_fold, together

GRID = bm.Grid((20, 30), 0.2)


@pytest.fixture(scope="module")
def train():
    """Forty scans in a room with a pillar."""
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[12:14, 10:12] = True
    rng = np.random.default_rng(5)
    poses = np.column_stack([rng.uniform(1, 2.2, 40), rng.uniform(1, 5, 40), rng.uniform(-4, 4, 40)])
    sensor = bm.BeamMixture(bm.Gaussian(0.04, 0.01), 0.04, 0.05, 0.1, 0.5)
    return bm.simulate(walls, GRID, poses, np.linspace(0, 6.2, 60), sensor=sensor, max_range_m=6.0, seed=2)


def test_folds_leave_each_scan_out_of_its_own_counts(train):
    folds = make_folds(train, GRID)
    assert len(folds) == FOLDS  # so few beams that all ways are taken
    assert sum(len(fold.scans) for fold in folds) == len(train)
    for fold in folds:
        own = {pose.tobytes() for pose in fold.scans.poses}
        others = train.select(np.array([pose.tobytes() not in own for pose in train.poses]))
        hits, passes = count_hits(others, GRID)
        np.testing.assert_array_equal(fold.hits, hits)
        np.testing.assert_array_equal(fold.passes, passes)


def test_together_they_are_predicted_as_each_alone(train):
    """Each under its own counts: the same bits, and other ones under another's."""
    sensor = bm.BeamMixture(bm.Gaussian(0.05))
    folds = make_folds(train, GRID)[:3]

    def maps(fold, of):
        return hit_ratio(of.hits, of.passes, {"a": 0.5, "b": 0.5})[fold.rays.touched][None].astype(np.float32)

    alone = [log_densities(fold.rays, [maps(fold, fold)], sensor, 0.5) for fold in folds]
    joined = together(folds)
    of_all = np.concatenate([maps(fold, fold) for fold in folds], axis=1)
    found = log_densities(joined.rays, [of_all], sensor, 0.5, columns=joined.columns)
    np.testing.assert_array_equal(found, np.concatenate(alone))
    swapped = np.concatenate([maps(fold, of) for fold, of in zip(folds, folds[::-1], strict=True)], axis=1)
    other = log_densities(joined.rays, [swapped], sensor, 0.5, columns=joined.columns)
    assert (other != found).any()


def test_too_few_scans_are_refused(train):
    with pytest.raises(bm.BadInput, match="takes two scans or more"):
        make_folds(train.select(slice(0, 1)), GRID)
    blind = dataclasses.replace(train, ranges_m=np.full(train.ranges_m.shape, np.nan))
    with pytest.raises(bm.BadInput, match="none of the training scans has a valid reading"):
        make_folds(blind, GRID)
    with pytest.raises(bm.BadInput, match="to fit a sensor on"):
        one_fold(blind, GRID)
