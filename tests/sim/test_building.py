"""Maps to simulate in: drawn as text, read from pictures, or built at random; a robot's round, odometry and scans."""

import numpy as np
import pytest
import scipy
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from oracle.enumeration import beams, distances
from PIL import Image
from tiers import full_but

import bayesmap as bm
from bayesmap.sim.drawing import DRAWING, TUTORIAL_GRID, from_text, to_text, tutorial
from bayesmap.sim.robot import RELATED_M, OdometryNoise, related_pairs, simulate_odometry, travel_times_s
from bayesmap.space.planar import between, wrap_angle
from bayesmap.worlds import building, from_image, from_map_image, from_occupancy, patrol

CASES = [
    (0, (30.0, 20.0), 0.1), (1, (30.0, 20.0), 0.1), (2, (12.0, 8.0), 0.1), (3, (14.0, 37.0), 0.15),
    (4, (45.0, 33.0), 0.25), (5, (16.0, 12.0), 0.05),
]  # fmt: skip


def cells_of(room, made):
    x0, x1, y0, y1 = (round(v / made.grid.resolution) for v in room.extent_m)
    return np.s_[x0:x1, y0:y1]


def flooded(free, start):
    labels, _ = scipy.ndimage.label(free)
    return labels == labels[start]


@pytest.mark.parametrize("case", CASES, ids=str)
def test_a_building_is_closed_has_its_size_and_rooms_apart_that_can_all_be_reached(case):
    _, size_m, resolution = case
    made = building(*case)
    corridor = next(room for room in made.rooms if room.kind == "corridor")
    floor = np.zeros(made.walls.shape, dtype=bool)
    floor[cells_of(corridor, made)] = True
    reached = flooded(~made.walls, tuple(np.argwhere(floor & ~made.walls)[0]))
    for room in made.rooms:
        free = ~made.walls[cells_of(room, made)]
        assert free.any(), room
        # Pockets behind furniture may be closed off, but not more than that.
        assert reached[cells_of(room, made)].sum() > 0.85 * free.sum(), room
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
    np.testing.assert_array_equal(made.opacity > 0, made.walls)
    assert made.opacity.max() == 1
    assert made.glass.any()
    assert made.walls[made.glass].all()
    np.testing.assert_allclose(made.opacity[made.glass], 1 - made.glass_pass)
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
    with pytest.raises(bm.BadInput, match=says):
        building(**arguments)


ROUNDS = [(0, (30.0, 20.0), 0.1), (1, (20.0, 34.0), 0.25), (2, (14.0, 9.0), 0.05)]


@pytest.mark.parametrize("case", ROUNDS, ids=str)
def test_the_robot_enters_every_room_looks_where_it_goes_and_keeps_a_quarter_of_a_metre_from_walls(case):
    toured = building(*case)
    poses = patrol(toured, 500, seed=3)
    low = np.asarray(toured.grid.origin) + np.argwhere(toured.walls) * toured.grid.resolution
    for point in poses[:, :2]:  # to closed squares, by the definition, without a transform
        outside = np.maximum(np.maximum(low - point, point - low - toured.grid.resolution), 0)
        assert np.sqrt((outside**2).sum(axis=1).min()) >= 0.25
    x, y = poses[:, 0], poses[:, 1]
    for room in toured.rooms:
        x0, x1, y0, y1 = room.extent_m
        assert ((x > x0) & (x < x1) & (y > y0) & (y < y1)).any(), room
    step = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    assert step.max() < 1.5 * np.median(step)
    for a, b in zip(poses[:-1, :2], poses[1:, :2], strict=True):
        for share in np.linspace(0, 1, 20):
            assert not toured.walls[toured.grid.cell_at(*(a + share * (b - a)))]
    travel = np.diff(poses[:, :2], axis=0)
    ahead = np.stack([np.cos(poses[:-1, 2]), np.sin(poses[:-1, 2])], axis=1)
    along = (travel * ahead).sum(axis=1) / np.hypot(*travel.T)
    assert np.median(along) > 0.98
    assert (along > 0.5).mean() > 0.9  # it turns on the spot at the end of a room
    np.testing.assert_array_equal(patrol(toured, 500, seed=3), poses)
    assert not np.array_equal(patrol(toured, 500, seed=4), poses)
    assert (patrol(toured, 1).shape, patrol(toured, 7).shape) == ((1, 3), (7, 3))
    with pytest.raises(bm.BadInput, match="n_scans"):
        patrol(toured, 0)


maps = hnp.arrays(bool, hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=12))


@given(maps, st.integers(0, 4), st.integers(0, 3), st.sampled_from(["\n", "\r\n"]))
def test_drawings_are_read_back_whatever_their_blanks_and_line_ends(walls, indent, blank, newline):
    np.testing.assert_array_equal(from_text(to_text(walls)), walls)
    lines = [" " * indent + line + "  " for line in to_text(walls).splitlines()]
    np.testing.assert_array_equal(from_text(newline.join([""] * blank + lines + [" "] * blank)), walls)


@pytest.mark.parametrize(("text", "place"), [
    ("...\n..\n", "line 2 has 2 cells, but line 1 has 3"), ("...\n\n...\n", "line 2 has 0 cells"),
    ("..\n.o\n", "line 2, column 2: unknown character 'o'"), (" \n\n", "no lines"),
    ("\n\n  .X\n  ?.", "line 4, column 3: unknown character '?'"), ("", "no lines"),
])  # fmt: skip
def test_a_bad_drawing_is_refused_with_its_place(text, place):
    with pytest.raises(bm.BadInput) as error:
        from_text(text)
    assert place in str(error.value)
    with pytest.raises(bm.BadInput, match="shape"):
        to_text(np.zeros((2, 2, 2)))


def test_the_tutorial_s_walls_are_indexed_as_it_indexes_them():
    assert np.argwhere(from_text("..X\n#..\n")).tolist() == [[0, 2], [1, 0]]
    walls, pose = tutorial()
    lines = DRAWING.strip().split("\n")
    assert walls.tolist() == [[character == "X" for character in line] for line in lines]  # the tutorial's own reading
    assert walls[2, 14]  # in the drawing: third line, fifteenth column
    assert not walls[14, 2]
    assert (pose.tolist(), TUTORIAL_GRID.cell_at(10.2, 9.8)) == ([10.0, 10.0, 0.0], (10, 10))
    walls[:] = True
    assert not tutorial()[0].all()  # each call gives arrays of its own


pictures = hnp.arrays(np.uint8, hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=9))


def test_the_top_left_of_a_picture_is_low_x_high_y_and_row_zero_of_an_occupancy_grid_the_bottom():
    image = np.full((3, 5), 255, dtype=np.uint8)  # 3 rows, 5 columns
    image[0, 0] = 0
    walls = from_image(image)
    assert (walls.shape, np.argwhere(walls).tolist()) == ((5, 3), [[0, 2]])
    for unknown_is_wall in (False, True):
        walls, _ = from_occupancy([[-1, 0, 100, 50, 51]], 0.1, unknown_is_wall=unknown_is_wall)
        np.testing.assert_array_equal(walls[:, 0], [unknown_is_wall, False, True, False, True])
    cells = np.zeros((3, 5), dtype=np.int8)
    cells[0, 4] = 100
    walls, grid = from_occupancy(cells, 0.05, origin=(-1.0, 2.0))
    assert np.argwhere(walls).tolist() == [[4, 0]]
    assert (grid.shape, grid.resolution, grid.origin) == ((5, 3), 0.05, (-1.0, 2.0))


@given(pictures)
def test_files_pil_images_and_arrays_agree(tmp_path_factory, picture):
    path = tmp_path_factory.mktemp("image") / "map.png"
    Image.fromarray(picture).save(path)
    walls = from_image(picture)
    np.testing.assert_array_equal(from_image(path), walls)
    np.testing.assert_array_equal(from_image(str(path)), walls)
    np.testing.assert_array_equal(from_image(Image.fromarray(picture)), walls)
    np.testing.assert_array_equal(from_image(picture / 255.0), walls)
    np.testing.assert_array_equal(from_image(np.dstack([picture] * 3)), walls)


def test_dark_pixels_are_walls_transparent_ones_free_and_map_server_greys_occupied_unknown_free():
    greys = np.array([[0.0, 0.29, 0.31, 1.0]])
    np.testing.assert_array_equal(from_image(greys, threshold=0.3)[:, 0], [True, True, False, False])
    black_but_clear = np.zeros((1, 2, 4), dtype=np.uint8)
    black_but_clear[0, 1, 3] = 255
    np.testing.assert_array_equal(from_image(black_but_clear)[:, 0], [False, True])
    bits = Image.fromarray(np.array([[True, False]]))
    assert bits.mode == "1"
    np.testing.assert_array_equal(from_image(bits)[:, 0], [False, True])
    image = np.array([[0, 130, 205, 254]], dtype=np.uint8)  # darkness 1, .49, .196, .004
    walls, _ = from_map_image(image, 0.1, free_thresh=0.196)
    np.testing.assert_array_equal(walls[:, 0], [True, False, False, False])
    walls, _ = from_map_image(image, 0.1, free_thresh=0.19, unknown_is_wall=True)
    np.testing.assert_array_equal(walls[:, 0], [True, True, True, False])


@given(pictures)
def test_negate_swaps_black_and_white(picture):
    plain, _ = from_map_image(picture, 0.1)
    negated, _ = from_map_image(255 - picture, 0.1, negate=True)
    np.testing.assert_array_equal(plain, negated)


@pytest.mark.parametrize(("cells", "says"), [
    ([[0, 101]], "row 0, column 1 is 101"), ([[0], [-2]], "row 1, column 0 is -2"),
    ([[float("nan")]], "row 0, column 0 is nan"), ([0, 100], "info.height and info.width"),
    ([["wall"]], "array of numbers"),
])  # fmt: skip
def test_a_bad_occupancy_grid_is_refused_with_its_place(cells, says):
    with pytest.raises(bm.BadInput) as error:
        from_occupancy(cells, 0.1)
    assert says in str(error.value)


def test_arrays_and_files_that_are_no_pictures_and_thresholds_out_of_order_are_refused(tmp_path):
    for image in (0.0, np.zeros((2, 2, 2)), np.full((2, 2), 1.5), np.full((2, 2), np.nan), np.zeros((0, 3))):
        with pytest.raises(bm.BadInput, match="image:"):
            from_image(np.atleast_1d(image))
    (tmp_path / "map.png").write_text("no picture")
    for name, says in (("map.png", r"map\.png: cannot be read as an image"), ("absent.png", r"absent\.png")):
        with pytest.raises(bm.BadInput, match=says):
            from_image(tmp_path / name)
    with pytest.raises(bm.BadInput, match="free_thresh < occupied_thresh"):
        from_map_image(np.zeros((2, 2)), 0.1, occupied_thresh=0.2, free_thresh=0.3)
    with pytest.raises(bm.BadInput, match="threshold"):
        from_image(np.zeros((2, 2)), threshold=1.0)


ANGLES = np.linspace(0, 2 * np.pi, 36, endpoint=False)


def random_map(seed, shape=(9, 7)):
    return np.random.default_rng(seed).random(shape) < 0.25


COORDINATE = st.floats(-50, 50)


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.05, 0.1, 0.5, 1.0, 3.0]), st.tuples(COORDINATE, COORDINATE))
def test_ranges_in_metres_from_several_poses_are_the_formula_s(seed, resolution, origin):
    rng = np.random.default_rng(seed)
    walls, grid = random_map(seed), bm.Grid((9, 7), resolution, origin)
    xy = np.array(grid.origin) + rng.uniform(-0.2, 1.2, (3, 2)) * np.array([9, 7]) * resolution
    poses = np.column_stack([xy, rng.uniform(-7, 7, 3)])
    expected, slack = (distances(walls, *beams(poses, ANGLES, grid), longest=8, slack=s) for s in (1e-11, 1e-7))
    found, sure = bm.ranges(walls, grid, poses, ANGLES, 8 * resolution), expected == slack
    assert found.shape == (3, 36)
    assert sure.mean() > 0.95
    np.testing.assert_allclose(found.ravel()[sure] / resolution, expected[sure], atol=1e-9, rtol=0)
    np.testing.assert_array_equal(bm.ranges(walls, grid, poses[1], ANGLES, 8 * resolution), found[1])


@pytest.mark.parametrize("away", [2.0**10, 2.0**20, -(2.0**24)])
def test_ranges_do_not_depend_on_where_in_the_world_the_grid_lies(away):
    """Shifts by powers of two of a map whose coordinates are multiples of 1/256 are free of rounding."""
    rng = np.random.default_rng(3)
    walls = random_map(3)
    poses = np.column_stack([rng.integers(0, 7 * 64, (4, 2)) / 64, rng.uniform(-3, 3, 4)])
    here = bm.ranges(walls, bm.Grid((9, 7)), poses, ANGLES, 20.0)
    poses[:, :2] += away
    np.testing.assert_array_equal(bm.ranges(walls, bm.Grid((9, 7), origin=(away, away)), poses, ANGLES, 20.0), here)


def test_simulated_scans_are_distances_plus_noise():
    """Mean and spread of 40 000 standardised readings, within 5 standard errors."""
    walls, pose = bm.worlds.tutorial()
    grid, angles = bm.worlds.TUTORIAL_GRID, np.linspace(0, 2 * np.pi, 400, endpoint=False)
    poses = np.tile(pose, (100, 1))
    scans = bm.simulate(walls, grid, poses, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=1)
    standard = (scans.ranges_m - bm.ranges(walls, grid, poses, angles, 42.0)) / 0.2
    assert abs(standard.mean()) < 5 / 200
    assert abs(standard.std() - 1) < 5 / np.sqrt(2 * 40_000)


def test_simulate_repeats_itself_by_its_seed_alone_and_not_from_inside_a_wall():
    walls, pose = bm.worlds.tutorial()
    grid, options = bm.worlds.TUTORIAL_GRID, {"sensor": bm.BeamMixture(), "max_range_m": 20.0}
    first, again, other = (bm.simulate(walls, grid, pose, ANGLES, seed=s, **options).ranges_m for s in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()
    walls = np.ones((2, 2), dtype=bool)
    with pytest.raises(bm.BadInput, match=r"pose 1 at \(1\.5, 0\.5\) m stands in the occupied cell \(1, 0\)"):
        bm.simulate(walls, bm.Grid((2, 2)), [[5, 5, 0], [1.5, 0.5, 0]], [0.0], sensor=bm.Gaussian(0.1), max_range_m=5.0)


def test_glass_lets_through_as_many_beams_as_its_opacity_says():
    """A pane of opacity 0.3 before a wall: binomial, 2000 scans, within 5 standard errors."""
    walls = np.zeros((6, 1), dtype=bool)
    walls[3] = walls[5] = True
    opacity = np.ones((6, 1))
    opacity[3] = 0.3
    poses, options = np.tile([0.5, 0.5, 0.0], (2000, 1)), {"max_range_m": 9.0, "opacity": opacity, "seed": 3}
    scans = bm.simulate(walls, bm.Grid((6, 1)), poses, [0.0], sensor=bm.Gaussian(1e-3), **options)
    assert abs((scans.ranges_m < 3.5).mean() - 0.3) < 5 * np.sqrt(0.3 * 0.7 / 2000)


PERFECT = dict.fromkeys(OdometryNoise.__dataclass_fields__, 0.0)


def odometry(**numbers):
    return OdometryNoise(**{**PERFECT, **numbers})


def straight(metres, steps):
    return np.column_stack([np.linspace(0, metres, steps + 1), np.zeros((steps + 1, 2))])


def circle(turns, steps):
    angle = np.linspace(0, 2 * np.pi * turns, steps + 1)
    return np.column_stack([np.sin(angle), 1 - np.cos(angle), wrap_angle(angle)])


def ends(path, noise, runs):
    return np.array([between(path[0], simulate_odometry(path, noise, seed=seed)[-1]) for seed in range(runs)])


def test_odometry_is_the_truth_but_for_its_errors_and_bias_adds_up_along_the_way():
    for path in (straight(5.0, 10), circle(1.3, 40), circle(1.0, 9)[::-1]):
        np.testing.assert_allclose(between(path, simulate_odometry(path, odometry())), 0.0, atol=1e-9)
    path = straight(3.0, 6)[::-1]
    np.testing.assert_allclose(simulate_odometry(path, odometry(distance_scale=0.1))[-1], [-0.3, 0.0, 0.0], atol=1e-9)
    assert simulate_odometry(straight(10.0, 50), odometry(drift_rad_per_m=0.02))[-1, 2] == pytest.approx(0.2)
    turned = simulate_odometry(circle(0.5, 50), odometry(turn_scale=0.1))[-1, 2]
    assert wrap_angle(turned - 1.1 * np.pi) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("steps", full_but([4, 64], 4))
def test_noise_has_the_stated_size_whatever_the_steps(steps):
    """Standard deviations of 2000 runs lie within 8 % (4.5 standard errors: chance fails one run in 10^5)."""
    metres = 9.0
    along = ends(straight(metres, steps), odometry(distance_per_m=0.02), 2000)
    assert np.std(along[:, 0]) == pytest.approx(0.02 * np.sqrt(metres), rel=0.08)
    yaw = ends(straight(metres, steps), odometry(turn_per_m=0.01), 2000)[:, 2]
    assert np.std(yaw) == pytest.approx(0.01 * np.sqrt(metres), rel=0.08)
    turns = 0.5
    spot = np.column_stack([np.zeros((steps + 1, 2)), wrap_angle(np.linspace(0, 2 * np.pi * turns, steps + 1))])
    yaw = wrap_angle(ends(spot, odometry(turn_per_rad=0.02), 2000)[:, 2] - np.pi)
    assert np.std(yaw) == pytest.approx(0.02 * np.sqrt(2 * np.pi * turns), rel=0.08)


def test_slips_come_as_often_as_said_and_only_lengthen_the_way():
    path = straight(1000.0, 1000)
    extra = np.diff(simulate_odometry(path, odometry(slips_per_m=0.1, slip_m=0.05))[:, 0]) - 1.0
    assert (extra > -1e-9).all()
    # Binomial with mean 95 and standard deviation 9.3; the mean of as many exponentials has 10 % of error.
    assert 55 < (extra > 1e-6).sum() < 135
    assert extra.sum() / (extra > 1e-6).sum() == pytest.approx(0.05, rel=0.45)
    assert np.abs(simulate_odometry(path, odometry(slips_per_m=0.1, slip_rad=0.2))[:, 2]).max() > 0.2


def test_odometry_lags_its_beginning_does_not_depend_on_its_end_and_stamps_follow_way_and_turn():
    path = straight(4.0, 40)
    stamps = travel_times_s(path, 0.5, 1.0)
    late = simulate_odometry(path, odometry(lag_s=0.4), stamps_s=stamps)
    np.testing.assert_allclose(late[10:, 0], path[10:, 0] - 0.4 * 0.5, atol=1e-9)
    np.testing.assert_allclose(late[0], path[0])
    with pytest.raises(bm.BadInput, match="a lag needs stamps_s"):
        simulate_odometry(path, odometry(lag_s=0.4))
    with pytest.raises(bm.BadInput, match="must ascend"):
        simulate_odometry(path, odometry(lag_s=0.4), stamps_s=stamps[::-1])
    path = circle(2.0, 50)
    np.testing.assert_array_equal(simulate_odometry(path[:20], seed=3), simulate_odometry(path, seed=3)[:20])
    assert not np.array_equal(simulate_odometry(path, seed=3), simulate_odometry(path, seed=4))
    path = np.array([[0, 0, 0], [1.0, 0, 0], [1.0, 0, np.pi / 2], [1.0, 0, np.pi / 2]])
    np.testing.assert_allclose(np.diff(travel_times_s(path, 0.5, np.pi)), [2.0, 0.5, 0.001])


@pytest.mark.parametrize(("numbers", "message"), [
    ({"turn_per_m": -0.1}, "turn_per_m must be a finite number of 0 or more"),
    ({"lag_s": np.nan}, "lag_s must be a finite number, got nan"),
])  # fmt: skip
def test_numbers_that_make_no_sense(numbers, message):
    with pytest.raises(bm.BadInput, match=message):
        OdometryNoise(**numbers)


def test_pairs_are_near_different_and_from_near_and_far_in_time():
    angle = np.linspace(0, 6 * np.pi, 300)  # three rounds of a circle
    path = np.column_stack([5 * np.cos(angle), 5 * np.sin(angle), angle])
    start, end = related_pairs(path, seed=1)
    assert (end > start).all()
    assert len(np.unique(np.stack([start, end]), axis=1).T) == len(start)
    assert np.hypot(*(path[start, :2] - path[end, :2]).T).max() <= RELATED_M
    assert set(zip(range(299), range(1, 300), strict=True)) <= set(zip(start.tolist(), end.tolist(), strict=True))
    assert (end - start > 80).sum() > 20  # a round later
    assert len(related_pairs(path[:1])[0]) == 0
