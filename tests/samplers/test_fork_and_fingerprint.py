import multiprocessing
import sys

import numpy as np
import pytest
from scipy.stats import laplace

import bayesmap as bm
from bayesmap.sensors.model import SensorModel

GRID = bm.Grid((5, 4))
SCANS = bm.Scans([2.5, 1.5, 0.0], np.linspace(0, 6, 30), np.linspace(1, 2, 30)[None], max_range_m=6.0)


class Sonar(SensorModel):
    """A sensor of the user's own making, known to us by name alone."""

    def __init__(self, scale_m):
        self.scale_m = scale_m

    def log_likelihood(self, range_m, distance_m, limits):
        return laplace.logpdf(range_m, np.minimum(distance_m, limits.max_m), self.scale_m)

    def reach_m(self, range_m, limits):
        return np.full(np.shape(range_m), np.inf)

    def sample(self, rng, distance_m, limits):
        return rng.laplace(np.minimum(distance_m, limits.max_m), self.scale_m)


def infer(sensor=None, **options):
    sensor = sensor or bm.Gaussian(0.5)
    return bm.infer(SCANS, GRID, prior=bm.Independent(0.3), sensor=sensor, warmup=5, draws=5, **options)


def test_a_run_is_not_resumed_with_another_sensor_of_the_same_name():
    saved = []
    infer(Sonar(0.2), on_checkpoint=saved.append)
    assert infer(Sonar(0.2), resume=saved[0]).finished
    with pytest.raises(bm.BadInput, match="sensor"):
        infer(Sonar(3.0), resume=saved[0])


def test_a_loaded_run_with_a_sensor_of_the_user_s_own_is_scored_when_given_that_sensor(tmp_path):
    run = infer(Sonar(0.2))
    run.save(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    with pytest.raises(bm.BadInput, match="sensor="):
        loaded.log_score(SCANS)
    assert loaded.log_score(SCANS, sensor=Sonar(0.2)) == run.log_score(SCANS)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="fork is the way of Linux")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning", "ignore:.*fork.*:RuntimeWarning")
def test_a_forked_child_infers_what_its_parent_does():
    here = infer(threads=2).occupancy
    with multiprocessing.get_context("fork").Pool(1) as pool:
        there = pool.apply_async(infer_in_child).get(timeout=60)
    np.testing.assert_array_equal(there, here)


def infer_in_child():
    return infer(threads=2).occupancy
