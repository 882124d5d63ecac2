"""Forked processes, and sensors that are known by name alone."""

import os
import subprocess
import sys

import numpy as np
import pytest
import scipy
from flat_options import grouped

import bayesmap as bm
from bayesmap.sensors.model import SensorModel

GRID = bm.Grid((5, 4))
SCANS = bm.Scans([2.5, 1.5, 0.0], np.linspace(0, 6, 30), np.linspace(1, 2, 30)[None], max_range_m=6.0)


class Sonar(SensorModel):
    """A sensor of the user's own making, known to us by name alone."""

    def __init__(self, scale_m):
        self.scale_m = scale_m

    def log_likelihood(self, range_m, distance_m, limits):
        return scipy.stats.laplace.logpdf(range_m, np.minimum(distance_m, limits.max_m), self.scale_m)

    def reach_m(self, range_m, limits):
        return np.full(np.shape(range_m), np.inf)

    def sample(self, rng, distance_m, limits):
        return rng.laplace(np.minimum(distance_m, limits.max_m), self.scale_m)


def infer(sensor=None, **options):
    sensor = sensor or bm.Gaussian(0.5)
    return bm.infer(SCANS, GRID, prior=bm.Independent(0.3), sensor=sensor, **grouped(warmup=5, draws=5, **options))


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


IN_CHILD = """
import multiprocessing, warnings
import numpy as np
from test_fork_and_fingerprint import infer

def occupancy(_=None):
    return infer(threads=2).occupancy

here = occupancy()
warnings.simplefilter("ignore")  # of threads and forks
with multiprocessing.get_context("fork").Pool(1) as pool:
    np.testing.assert_array_equal(pool.apply_async(occupancy).get(timeout=60), here)
print("the same")
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="fork is the way of Linux")
def test_a_forked_child_infers_what_its_parent_does():
    """In a process of its own: what other tests have loaded here, such as Ray, does not survive a fork."""
    folder = os.pathsep.join([os.path.dirname(__file__), *sys.path])
    done = subprocess.run(
        [sys.executable, "-c", IN_CHILD], env=os.environ | {"PYTHONPATH": folder}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.stdout == "the same\n", done.stderr
