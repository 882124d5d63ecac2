"""Scans whose beams leave from poses of their own, as those of a sensor that moves while it turns."""

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.io.saved import load_saved, save
from bayesmap.kernels.walls.table import trace

GRID = bm.Grid(shape=(20, 20), resolution=0.5)
ANGLES = np.array([0.0, 0.5, 1.0])
SENSOR = bm.Gaussian(0.1)


def moving_scans():
    rng = np.random.default_rng(0)
    beam_poses = rng.uniform([2, 2, -3], [8, 8, 3], (4, 3, 3))
    ranges = rng.uniform(0.5, 4, (4, 3))
    return bm.Scans(beam_poses[:, 0], ANGLES, ranges, 10.0, beam_poses=beam_poses)


def one_beam_scans(scans):
    """The same beams, each as a scan of its own."""
    poses = scans.beam_poses.reshape(-1, 3) + [0, 0, 1] * np.tile(scans.angles_rad, len(scans))[:, None]
    return bm.Scans(poses, [0.0], scans.ranges_m.reshape(-1, 1), scans.max_range_m)


def test_beams_with_poses_of_their_own_are_as_many_scans_of_one_beam():
    scans = moving_scans()
    single = one_beam_scans(scans)
    np.testing.assert_allclose(scans.hit_points_world(), single.hit_points_world(), atol=1e-12)
    a, b = trace(scans, GRID, SENSOR), trace(single, GRID, SENSOR)
    np.testing.assert_array_equal(a.cells, b.cells)
    np.testing.assert_array_equal(a.loglik, b.loglik)


def test_beam_poses_that_all_equal_the_scans_change_nothing():
    still = moving_scans()
    same = np.repeat(still.poses[:, None], 3, axis=1)
    a = trace(bm.Scans(still.poses, ANGLES, still.ranges_m, 10.0), GRID, SENSOR)
    b = trace(bm.Scans(still.poses, ANGLES, still.ranges_m, 10.0, beam_poses=same), GRID, SENSOR)
    np.testing.assert_array_equal(a.cells, b.cells)
    np.testing.assert_array_equal(a.loglik, b.loglik)


def test_selecting_and_holding_out_keep_each_scans_beam_poses():
    scans = moving_scans()
    train, held = scans.holdout(3)
    np.testing.assert_array_equal(held.beam_poses, scans.beam_poses[1:2])
    np.testing.assert_array_equal(train.beam_poses, scans.beam_poses[[0, 2, 3]])


@pytest.mark.parametrize(
    ("beam_poses", "message"),
    [
        (np.zeros((4, 2, 3)), r"beam_poses has shape \(4, 2, 3\), expected \(4, 3, 3\)"),
        (np.full((4, 3, 3), np.nan), "pose of beam 0 of scan 0 is not finite"),
    ],
)
def test_beam_poses_that_do_not_fit_are_refused(beam_poses, message):
    with pytest.raises(bm.BadInput, match=message):
        bm.Scans(np.zeros((4, 3)), ANGLES, np.ones((4, 3)), 10.0, beam_poses=beam_poses)


def test_a_saved_run_keeps_its_beam_poses(tmp_path):
    run = bm.infer(
        moving_scans(),
        GRID,
        prior=bm.Independent(0.2),
        sensor=SENSOR,
        schedule=bm.Schedule(chains=1, warmup=1, draws=2),
    )
    save(run.posterior, tmp_path / "run.nc")
    np.testing.assert_array_equal(load_saved(tmp_path / "run.nc")[0].scans.beam_poses, moving_scans().beam_poses)
