"""A saved run holds the approximation of the trajectory that it was made with."""

import dataclasses

import netCDF4
import numpy as np
import pytest
from oracle.trajectories import round_way
from oracle.worlds import make_case

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.io.saved_trajectory import arrays_of, numbers_of
from bayesmap.poses.trajectory import Alternatives
from bayesmap.space.planar import between, compose


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


def test_alternatives_come_back_and_covariances_hold_them(run, tmp_path):
    plain = round_way(force=3.0)
    there = compose(plain.gaussian.poses[None], np.array([[[0.0, 0.0, 0.0]] * 8 + [[0.0, 2.0, 0.1]] * 8]))
    steps = between(plain.gaussian.poses[None], there) * np.sqrt(0.2)
    other = Alternatives(np.array([2], np.intp), np.array([12], np.intp), np.array([0.2]), there)
    gaussian = dataclasses.replace(plain.gaussian, elsewhere=steps)
    found = dataclasses.replace(plain, gaussian=gaussian, alternatives=other)
    dataclasses.replace(run, trajectory=found).save(tmp_path / "run.nc")
    back = bm.load(tmp_path / "run.nc").trajectory
    assert len(back.alternatives) == 1
    for name in ("first", "last", "probabilities", "poses"):
        np.testing.assert_array_equal(getattr(back.alternatives, name), getattr(other, name))
    np.testing.assert_array_equal(back.alternative_poses(0), found.alternative_poses(0))
    pair = np.array([1]), np.array([14])
    np.testing.assert_array_equal(back.relative_covariances(*pair), found.relative_covariances(*pair))
    added = back.relative_covariances(*pair)[0] - plain.relative_covariances(*pair)[0]
    assert added[0, 0] + added[1, 1] > 0.5, "probability 0.2 times 2 m squared, and Student's scale"
    np.testing.assert_array_equal(back.draw(2, seed=3), found.draw(2, seed=3))


def test_a_run_without_one_has_none(run, tmp_path):
    run.save(tmp_path / "run.nc")
    assert bm.load(tmp_path / "run.nc").trajectory is None


@pytest.mark.parametrize("name", ["poses", "gaussian_curvature", "own_covariance", "closures_weights"])
def test_one_number_changed_is_noticed(run, name, tmp_path):
    path = tmp_path / "run.nc"
    dataclasses.replace(run, trajectory=round_way()).save(path)
    with netCDF4.Dataset(path, "a") as file:
        values = file["trajectory"][name]
        values[(0,) * values.ndim] += 1e-9
    with pytest.raises(BadInput, match="checksum"):
        bm.load(path)
