import numpy as np
import pytest
import scipy

from bayesmap.errors import BadInput
from bayesmap.worlds import building

CASES = [
    (0, (30.0, 20.0), 0.1),
    (1, (30.0, 20.0), 0.1),
    (2, (12.0, 8.0), 0.1),
    (3, (14.0, 37.0), 0.15),
    (4, (45.0, 33.0), 0.25),
    (5, (16.0, 12.0), 0.05),
]


@pytest.fixture(params=CASES, ids=str, scope="module")
def made(request):
    seed, size_m, resolution = request.param
    return building(seed, size_m, resolution)


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


def test_the_outer_wall_is_closed(made):
    outside = flooded(~made.walls, (0, 0))
    for room in made.rooms:
        assert not outside[cells_of(room, made)].any(), room


def test_rooms_share_no_floor(made):
    times = np.zeros(made.walls.shape, dtype=int)
    for room in made.rooms:
        times[cells_of(room, made)] += 1
    for room in made.rooms:
        if room.kind != "corridor":  # a cross corridor runs through the long ones
            assert times[cells_of(room, made)].max() == 1, room


def test_a_building_has_corridors_rooms_and_one_lobby(made):
    kinds = [room.kind for room in made.rooms]
    assert kinds.count("corridor") >= 1
    assert kinds.count("lobby") == 1
    assert len(kinds) >= 4


def test_opacity_says_what_the_walls_and_the_glass_are(made):
    np.testing.assert_array_equal(made.opacity > 0, made.walls)
    assert made.opacity.max() == 1
    assert made.glass.any()
    assert made.walls[made.glass].all()
    np.testing.assert_allclose(made.opacity[made.glass], 1 - made.glass_pass)


@pytest.mark.parametrize(("seed", "size_m", "resolution"), CASES)
def test_the_outer_walls_are_as_far_apart_as_was_asked_for(seed, size_m, resolution):
    made = building(seed, size_m, resolution)
    solid = np.argwhere(made.walls)
    size = (solid.max(axis=0) - solid.min(axis=0) + 1) * resolution
    np.testing.assert_allclose(size, size_m, atol=resolution / 2 + 1e-9)
    assert made.grid.shape == made.walls.shape == made.glass.shape == made.opacity.shape


def test_the_same_seed_gives_the_same_building_and_another_seed_another():
    first, again, other = building(7), building(7), building(8)
    np.testing.assert_array_equal(first.opacity, again.opacity)
    assert first.rooms == again.rooms
    assert not np.array_equal(first.opacity, other.opacity)


def test_without_clutter_rooms_hold_only_walls_and_doors():
    empty, usual = building(3, clutter=0.0), building(3)
    assert empty.walls.sum() < usual.walls.sum()
    assert set(np.unique(empty.opacity[~empty.glass])) <= {0.0, 1.0}


def test_opaque_glass_and_clear_glass_are_possible():
    assert building(0, glass_pass=0.0).opacity[building(0).glass].min() == 1
    clear = building(0, glass_pass=0.95)
    np.testing.assert_allclose(clear.opacity[clear.glass], 0.05)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"resolution": 0.5}, "resolution"),
        ({"size_m": (5.0, 5.0)}, "size_m"),
        ({"size_m": (30.0, float("nan"))}, "size_m"),
        ({"size_m": (5000.0, 5000.0)}, "too many cells"),
        ({"glass_pass": 1.2}, "glass_pass"),
        ({"clutter": -1.0}, "clutter"),
    ],
)
def test_arguments_out_of_range_are_refused(arguments, says):
    with pytest.raises(BadInput, match=says):
        building(**arguments)
