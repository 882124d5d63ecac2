"""Simulated buildings, and a robot's round through them."""

import numpy as np
import pytest
import scipy

from bayesmap.errors import BadInput
from bayesmap.worlds import building, patrol

CASES = [
    (0, (30.0, 20.0), 0.1), (1, (30.0, 20.0), 0.1), (2, (12.0, 8.0), 0.1), (3, (14.0, 37.0), 0.15),
    (4, (45.0, 33.0), 0.25), (5, (16.0, 12.0), 0.05),
]  # fmt: skip


@pytest.fixture(params=CASES, ids=str, scope="module")
def made(request):
    return building(*request.param)


def cells_of(room, made):
    x0, x1, y0, y1 = (round(v / made.grid.resolution) for v in room.extent_m)
    return np.s_[x0:x1, y0:y1]


def flooded(free, start):
    labels, _ = scipy.ndimage.label(free)
    return labels == labels[start]


def test_every_room_can_be_reached_from_the_first_corridor(made):
    corridor = next(room for room in made.rooms if room.kind == "corridor")
    floor = np.zeros(made.walls.shape, dtype=bool)
    floor[cells_of(corridor, made)] = True
    start = tuple(np.argwhere(floor & ~made.walls)[0])
    reached = flooded(~made.walls, start)
    for room in made.rooms:
        free = ~made.walls[cells_of(room, made)]
        assert free.any(), room
        # Pockets behind furniture may be closed off, but not more than that.
        assert reached[cells_of(room, made)].sum() > 0.85 * free.sum(), room


def test_the_outer_wall_is_closed_and_rooms_share_no_floor(made):
    kinds = [room.kind for room in made.rooms]
    assert (kinds.count("corridor") >= 1, kinds.count("lobby"), len(kinds) >= 4) == (True, 1, True)
    outside = flooded(~made.walls, (0, 0))
    times = np.zeros(made.walls.shape, dtype=int)
    for room in made.rooms:
        assert not outside[cells_of(room, made)].any(), room
        times[cells_of(room, made)] += 1
    for room in made.rooms:
        if room.kind != "corridor":  # a cross corridor runs through the long ones
            assert times[cells_of(room, made)].max() == 1, room


def test_opacity_shows_walls_and_glass_and_the_size_is_the_one_asked_for(made, request):
    np.testing.assert_array_equal(made.opacity > 0, made.walls)
    assert made.opacity.max() == 1
    assert made.glass.any()
    assert made.walls[made.glass].all()
    np.testing.assert_allclose(made.opacity[made.glass], 1 - made.glass_pass)
    _, size_m, resolution = request.node.callspec.params["made"]
    solid = np.argwhere(made.walls)
    size = (solid.max(axis=0) - solid.min(axis=0) + 1) * resolution
    np.testing.assert_allclose(size, size_m, atol=resolution / 2 + 1e-9)
    assert made.grid.shape == made.walls.shape == made.glass.shape == made.opacity.shape


def test_a_seed_gives_one_building_and_clutter_and_clear_glass_can_be_chosen():
    first, again, other = building(7), building(7), building(8)
    np.testing.assert_array_equal(first.opacity, again.opacity)
    assert first.rooms == again.rooms
    assert not np.array_equal(first.opacity, other.opacity)
    empty, usual = building(3, clutter=0.0), building(3)
    assert empty.walls.sum() < usual.walls.sum()
    assert set(np.unique(empty.opacity[~empty.glass])) <= {0.0, 1.0}
    for glass_pass in (0.0, 0.95):
        made = building(0, glass_pass=glass_pass)
        np.testing.assert_allclose(made.opacity[made.glass], 1 - glass_pass)


@pytest.mark.parametrize(("arguments", "says"), [
    ({"resolution": 0.5}, "resolution"), ({"size_m": (5.0, 5.0)}, "size_m"), ({"glass_pass": 1.2}, "glass_pass"),
    ({"size_m": (30.0, float("nan"))}, "size_m"), ({"size_m": (5000.0, 5000.0)}, "too many cells"),
    ({"clutter": -1.0}, "clutter"),
])  # fmt: skip
def test_arguments_out_of_range_are_refused(arguments, says):
    with pytest.raises(BadInput, match=says):
        building(**arguments)


ROUNDS = [(0, (30.0, 20.0), 0.1), (1, (20.0, 34.0), 0.25), (2, (14.0, 9.0), 0.05)]


@pytest.fixture(params=ROUNDS, ids=str, scope="module")
def toured(request):
    return building(*request.param)


@pytest.fixture(scope="module")
def poses(toured):
    return patrol(toured, 500, seed=3)


def distance_to_walls(points, toured):
    """Distance from points to the nearest closed wall square: the definition, without a transform."""
    low = np.asarray(toured.grid.origin) + np.argwhere(toured.walls) * toured.grid.resolution
    result = []
    for point in points:
        outside = np.maximum(np.maximum(low - point, point - low - toured.grid.resolution), 0)
        result.append(np.sqrt((outside**2).sum(axis=1).min()))
    return np.array(result)


def test_no_pose_is_within_a_quarter_of_a_metre_of_a_wall(toured, poses):
    assert distance_to_walls(poses[:, :2], toured).min() >= 0.25


def test_the_robot_enters_every_room_and_passes_no_wall(toured, poses):
    x, y = poses[:, 0], poses[:, 1]
    for room in toured.rooms:
        x0, x1, y0, y1 = room.extent_m
        assert ((x > x0) & (x < x1) & (y > y0) & (y < y1)).any(), room
    step = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    assert step.max() < 1.5 * np.median(step)
    for a, b in zip(poses[:-1, :2], poses[1:, :2], strict=True):
        for share in np.linspace(0, 1, 20):
            assert not toured.walls[toured.grid.cell_at(*(a + share * (b - a)))]


def test_the_robot_looks_where_it_goes_any_number_of_scans_covers_the_round_and_a_seed_repeats_it(toured, poses):
    travel = np.diff(poses[:, :2], axis=0)
    ahead = np.stack([np.cos(poses[:-1, 2]), np.sin(poses[:-1, 2])], axis=1)
    along = (travel * ahead).sum(axis=1) / np.hypot(*travel.T)
    assert np.median(along) > 0.98
    assert (along > 0.5).mean() > 0.9  # it turns on the spot at the end of a room
    np.testing.assert_array_equal(patrol(toured, 500, seed=3), poses)
    assert not np.array_equal(patrol(toured, 500, seed=4), poses)
    assert (patrol(toured, 1).shape, patrol(toured, 7).shape) == ((1, 3), (7, 3))
    with pytest.raises(BadInput, match="n_scans"):
        patrol(toured, 0)
