import numpy as np
import pytest

from bayesmap.errors import BadInput
from bayesmap.worlds import building, patrol

CASES = [(0, (30.0, 20.0), 0.1), (1, (20.0, 34.0), 0.25), (2, (14.0, 9.0), 0.05)]


@pytest.fixture(params=CASES, ids=str, scope="module")
def made(request):
    return building(*request.param)


@pytest.fixture(scope="module")
def poses(made):
    return patrol(made, 500, seed=3)


def distance_to_walls(points, made):
    """Distance from points to the nearest closed wall square: the definition, without a transform."""
    low = np.asarray(made.grid.origin) + np.argwhere(made.walls) * made.grid.resolution
    result = []
    for point in points:
        outside = np.maximum(np.maximum(low - point, point - low - made.grid.resolution), 0)
        result.append(np.sqrt((outside**2).sum(axis=1).min()))
    return np.array(result)


def test_no_pose_is_within_a_quarter_of_a_metre_of_a_wall(made, poses):
    assert distance_to_walls(poses[:, :2], made).min() >= 0.25


def test_the_robot_enters_every_room(made, poses):
    x, y = poses[:, 0], poses[:, 1]
    for room in made.rooms:
        x0, x1, y0, y1 = room.extent_m
        assert ((x > x0) & (x < x1) & (y > y0) & (y < y1)).any(), room


def test_the_robot_passes_no_wall(made, poses):
    step = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    assert step.max() < 1.5 * np.median(step)
    for a, b in zip(poses[:-1, :2], poses[1:, :2], strict=True):
        for share in np.linspace(0, 1, 20):
            assert not made.walls[made.grid.cell_at(*(a + share * (b - a)))]


def test_the_robot_looks_where_it_goes(poses):
    travel = np.diff(poses[:, :2], axis=0)
    ahead = np.stack([np.cos(poses[:-1, 2]), np.sin(poses[:-1, 2])], axis=1)
    along = (travel * ahead).sum(axis=1) / np.hypot(*travel.T)
    assert np.median(along) > 0.98
    assert (along > 0.5).mean() > 0.9  # it turns on the spot at the end of a room


def test_the_same_seed_gives_the_same_round(made, poses):
    np.testing.assert_array_equal(patrol(made, 500, seed=3), poses)
    assert not np.array_equal(patrol(made, 500, seed=4), poses)


def test_any_number_of_scans_covers_the_round(made):
    assert patrol(made, 1).shape == (1, 3)
    assert patrol(made, 7).shape == (7, 3)
    with pytest.raises(BadInput, match="n_scans"):
        patrol(made, 0)
