"""A saved run holds the approximation of the trajectory that it was made with."""

import dataclasses

import numpy as np
import pytest
from oracle.trajectories import round_way
from oracle.worlds import make_case

import bayesmap as bm
from bayesmap.io.saved_trajectory import arrays_of, numbers_of


@pytest.fixture(scope="module")
def run():
    case = make_case(31, prior=0.3, sensor=bm.BeamMixture(bm.StudentT(0.2, 3.0)), n_poses=2, shape=(5, 3))
    return bm.infer(case.scans, case.grid, prior=case.prior, sensor=case.sensor, draws=4)


@pytest.mark.parametrize("options", [{"force": 3.0}, {"odometry": False, "closure": False}], ids=["all", "least"])
def test_the_approximation_comes_back_and_says_the_same(run, options, tmp_path):
    found = round_way(**options)
    dataclasses.replace(run, trajectory=found).save(tmp_path / "run.nc")
    back = bm.load(tmp_path / "run.nc").trajectory
    assert numbers_of(back) == numbers_of(found)
    theirs = arrays_of(back)
    assert list(theirs) == list(arrays_of(found))
    for name, (dims, values) in arrays_of(found).items():
        assert theirs[name][0] == dims
        np.testing.assert_array_equal(theirs[name][1], values, err_msg=name)
    first, second = np.array([0, 1, 5]), np.array([9, 4, 6])
    np.testing.assert_array_equal(back.relative_covariances(first, second), found.relative_covariances(first, second))
    np.testing.assert_array_equal(back.draw(2, seed=3), found.draw(2, seed=3))
    assert back.flagged.dtype == bool


def test_a_run_without_one_has_none(run, tmp_path):
    run.save(tmp_path / "run.nc")
    assert bm.load(tmp_path / "run.nc").trajectory is None
