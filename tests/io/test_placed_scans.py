"""Scans of a log at the poses of somebody else's trajectory, of the robot's base or of its laser."""

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.io.logs import describe_log, read_log
from bayesmap.io.text.trajectories import read_trajectory, write_trajectory
from bayesmap.space.planar import compose
from bayesmap.space.trajectory import Trajectory

STAMPS = np.linspace(10.0, 12.0, 11)
MOUNT = (0.3, -0.1, 0.5)
BASE = np.column_stack([STAMPS - 10.0, 0.1 * (STAMPS - 10.0), 0.3 * (STAMPS - 10.0)])


@pytest.fixture
def log(tmp_path):
    """Scans with stamps and without poses; where the laser sits is known only from an option."""
    ranges = np.random.default_rng(0).uniform(1.0, 3.0, (len(STAMPS), 5))
    np.savez(tmp_path / "log.npz", angles_rad=np.linspace(-1, 1, 5), ranges_m=ranges, stamps_s=STAMPS)
    return tmp_path / "log.npz"


def tum(path, poses, stamps_s, frame=None):
    return write_trajectory(path / "theirs.tum", poses, stamps_s, frame)


@pytest.mark.parametrize("named", ["base", "laser", None])
@pytest.mark.parametrize("laser", [MOUNT, None])
def test_the_frame_is_what_the_file_says_or_the_base_if_it_is_known(log, tmp_path, named, laser):
    theirs = tum(tmp_path, BASE, STAMPS, named)
    assert read_trajectory(theirs).frame == named
    if named == "base" and laser is None:
        with pytest.raises(bm.BadInput, match="it has poses of the base; those of the laser need to know where"):
            read_log(log, trajectory=theirs)
        return
    reading = describe_log(log, trajectory=theirs, laser=laser)
    of_base = named == "base" or (named is None and laser is not None)
    expected = compose(BASE, np.array(MOUNT)) if of_base else BASE
    np.testing.assert_allclose(reading.scans.poses, expected, atol=1e-8)
    assert f"taken as those of the {'base' if of_base else 'laser'}" in reading.notes[0]
    scans = read_log(log, trajectory=read_trajectory(theirs, frame="laser"), laser=laser)
    np.testing.assert_allclose(scans.poses, BASE, atol=1e-8)


def test_poses_between_are_interpolated_and_scans_outside_or_in_gaps_are_left_out(log, tmp_path):
    stamps = np.array([10.1, 10.3, 10.5, 11.0, 11.2, 11.5])  # none at 10; a gap of 0.5 s; ends at 11.5
    theirs = tum(tmp_path, np.column_stack([stamps, 0 * stamps, 0 * stamps]), stamps)
    reading = describe_log(log, trajectory=theirs)
    np.testing.assert_allclose(reading.scans.stamps_s, [10.2, 10.4, 11.0, 11.2, 11.4])
    np.testing.assert_allclose(reading.scans.poses[:, 0], reading.scans.stamps_s, atol=1e-9)
    assert "4 scans were left out: the trajectory reaches from 10.1 s to 11.5 s" in reading.notes
    assert "2 scans were left out: its poses are over 0.3 s apart there" in reading.notes
    assert len(read_log(log, trajectory=theirs, thin_m=0.5)) == 2


@pytest.mark.parametrize(("stamps", "message"), [
    (STAMPS + 1e6, "its scans are from 10.0 s to 12.0 s, and the trajectory reaches from 1000010.0 s to"),
    (np.linspace(0.5, 20.5, 11), "with poses more than 0.3 s apart around each scan; are both of one clock"),
])  # fmt: skip
def test_a_trajectory_of_another_time_is_refused(log, tmp_path, stamps, message):
    with pytest.raises(bm.BadInput, match=message):
        read_log(log, trajectory=tum(tmp_path, BASE, stamps))


def test_scans_or_poses_without_stamps_are_refused(log, tmp_path):
    np.savez(tmp_path / "bare.npz", angles_rad=np.zeros(1), ranges_m=np.ones((11, 1)))
    for path, trajectory in ((tmp_path / "bare.npz", tum(tmp_path, BASE, STAMPS)), (log, Trajectory(BASE))):
        with pytest.raises(bm.BadInput, match="a trajectory places scans by their time"):
            read_log(path, trajectory=trajectory)


def test_a_trajectory_changes_its_frame_and_back():
    laser = Trajectory(BASE, STAMPS, np.tile(np.diag([0.01, 0.02, 0.03]), (11, 1, 1)), frame="laser")
    back = laser.of(None, np.array(MOUNT)).of("laser", np.array(MOUNT))
    np.testing.assert_allclose(back.covariances, laser.covariances, atol=1e-12)
    with pytest.raises(bm.BadInput, match="frame must be one of base, laser, got 'bse'"):
        laser.of("bse", np.array(MOUNT))
