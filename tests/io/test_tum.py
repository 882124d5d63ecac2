import numpy as np
import pytest
from map_case import scans
from scipy.spatial.transform import Rotation

from bayesmap.errors import BadInput
from bayesmap.io.text.tum import write_trajectory


def test_numpy_reads_stamps_and_scipy_reads_turns(tmp_path):
    poses, stamps = scans().poses, [1421098765.123456, 1421098765.25, 1421098766.0]
    path = write_trajectory(tmp_path / "poses.tum", poses, stamps)
    rows = np.loadtxt(path)  # leaves out what follows #
    assert rows.shape == (3, 8)
    np.testing.assert_allclose(rows[:, 0], stamps, rtol=0, atol=1e-6)
    np.testing.assert_allclose(rows[:, 1:4], np.column_stack([poses[:, :2], np.zeros(3)]), atol=1e-9)
    turns = Rotation.from_quat(rows[:, 4:])  # x, y, z, w
    np.testing.assert_allclose(np.linalg.norm(rows[:, 4:], axis=1), 1.0, atol=1e-11)
    np.testing.assert_allclose(turns.as_euler("xyz"), np.column_stack([np.zeros((3, 2)), poses[:, 2]]), atol=1e-9)


def test_without_stamps_poses_are_numbered_and_the_file_says_so(tmp_path):
    path = write_trajectory(tmp_path / "poses.tum", scans().poses)
    np.testing.assert_array_equal(np.loadtxt(path)[:, 0], [0, 1, 2])
    assert path.read_text().startswith("# scan number (the scans have no stamps) tx ty tz qx qy qz qw\n")


@pytest.mark.parametrize(
    ("poses", "stamps", "says"),
    [
        (np.zeros((0, 3)), None, "no pose"),
        (np.zeros((2, 3)), [1.0], r"one finite stamp a pose, \(2,\), got shape \(1,\)"),
        (np.zeros((1, 3)), [np.nan], "one finite stamp"),
        (np.zeros((1, 2)), None, r"expected \(S, 3\)"),
    ],
)
def test_what_is_no_trajectory_leaves_no_file(tmp_path, poses, stamps, says):
    with pytest.raises(BadInput, match=says):
        write_trajectory(tmp_path / "poses.tum", poses, stamps)
    assert list(tmp_path.iterdir()) == []
