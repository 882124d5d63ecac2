"""Rays hold the cells that the tutorial's formula finds, in order, and ray casting gives its distances.

Distances jump where a beam grazes a corner, so a cast beam is judged only where the formula itself is sure: where it
gives the same with edges that are 1e-11 and 1e-7 cells longer than the cell's side. It is sure of beams that touch a
corner exactly: rounding moves them by less than 1e-11. The beam table holds the sensor's likelihood at the oracle's
distances; its index is the table turned round.
"""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle.enumeration import all_maps, beams, distances, touches
from oracle.stop_worlds import scans_of_all_kinds
from oracle.worlds import OwnSensor, make_case

import bayesmap as bm
from bayesmap.beams.rays import Rays, around_readings
from bayesmap.kernels import device as devices
from bayesmap.kernels.rays import count_hits, stop_distances, trace_rays
from bayesmap.kernels.walk import cast_beams
from bayesmap.kernels.walls import table as tracing
from bayesmap.kernels.walls.table import index_by_cell, trace
from bayesmap.sensors.model import FLAT_NATS, RangeLimits

GRID = bm.Grid((13, 9), 0.25, (3.0, -1.0))
MARGIN_M = 0.3
KINDS = {"anywhere": False, "on lines and corners": True}
EVERYWHERE = pytest.mark.parametrize("kind", KINDS)


def random_scans(seed, *, lattice=False, poses=10):
    return scans_of_all_kinds(seed, GRID, poses=poses, limits=(0.1, 4.0), lattice=lattice)


def near_readings(scans, margin_m):
    reach_m, near_m = around_readings(scans, margin_m, GRID.resolution)
    return trace_rays(scans, GRID, reach_m=reach_m, near_m=near_m)


def of_beam(array, rays, b):
    return array[rays.offsets[b] : rays.offsets[b + 1]]


def assert_equal(a: Rays, b: Rays):
    for field in dataclasses.fields(Rays):
        mine, theirs = getattr(a, field.name), getattr(b, field.name)
        if isinstance(mine, np.ndarray):
            np.testing.assert_array_equal(mine, theirs)


@EVERYWHERE
def test_cells_and_where_they_are_entered_are_the_formula_s(kind):
    for seed in range(2, 6):
        scans = random_scans(seed, lattice=KINDS[kind])
        rays = trace_rays(scans, GRID)
        met = touches(*beams(scans.poses, scans.angles_rad, GRID), GRID.shape) * GRID.resolution
        met[np.isnan(scans.ranges_m.ravel())] = np.inf
        enter, _ = rays.chords()
        for b in range(rays.n_beams):
            cells = of_beam(rays.cells, rays, b)
            reached, at_most = (set(np.flatnonzero(met[b] <= scans.max_range_m + by)) for by in (-1e-8, 1e-8))
            assert reached <= set(cells.tolist()) <= at_most
            assert len(set(cells.tolist())) == len(cells)
            np.testing.assert_allclose(of_beam(enter, rays, b), met[b, cells], atol=1e-9)


@EVERYWHERE
def test_a_chord_begins_and_ends_on_its_cell_s_border_and_the_next_begins_no_earlier(kind):
    """Compiled stops lie at the given part of the chord."""
    for seed, depth in enumerate((0.0, 0.25, 0.5, 1.0)):
        rays = trace_rays(random_scans(seed, lattice=KINDS[kind]), GRID)
        enter, leave = rays.chords()
        np.testing.assert_allclose(stop_distances(rays, depth), enter + depth * (leave - enter), rtol=1e-6, atol=1e-8)
    edge, beam = GRID.resolution, rays.beam_of_entry()
    low = np.stack([rays.cells // GRID.shape[1], rays.cells % GRID.shape[1]], -1)
    for distance, on_border in ((enter, True), ((enter + leave) / 2, False), (leave, True)):
        at = (rays.start_m[beam] + distance[:, None] * rays.direction[beam]) / edge - low
        assert ((at > -1e-8) & (at < 1 + 1e-8)).all()
        assert not on_border or (np.minimum(np.abs(at), np.abs(1 - at)).min(axis=1) < 1e-8).all()
    assert (leave >= enter).all()
    for b in range(rays.n_beams):
        assert (np.diff(of_beam(enter, rays, b)) > -1e-9).all()


def test_a_start_next_to_a_grid_line_counts_as_on_it_in_the_walk_and_in_the_chords():
    """Within a billionth of a cell the walk takes a start for one on the line; so must what follows from the cells."""
    for off in (-2e-9, -5e-10, 0.0, 5e-10, 2e-9):
        for angle in (np.arange(8) * np.pi / 4 + np.array([[0.0], [1e-3]])).ravel():
            scans = bm.Scans([4.0 + off * 0.25, -0.5 + off * 0.25, angle], [0.0], [[np.inf]], max_range_m=4.0)
            rays = trace_rays(scans, GRID)
            enter, leave = rays.chords()
            assert (np.diff(enter) > -1e-8).all()
            assert (leave - enter <= np.sqrt(2) * 0.25 + 1e-9).all()
            np.testing.assert_allclose(stop_distances(rays, 0.5), (enter + leave) / 2, rtol=1e-6, atol=1e-9)


def test_a_table_s_cells_are_its_rays_and_selected_beams_are_those_beams():
    scans = random_scans(3)
    rays, table = trace_rays(scans, GRID), trace(scans, GRID, bm.Gaussian(0.1))
    np.testing.assert_array_equal(rays.offsets, table.offsets)
    np.testing.assert_array_equal(rays.cells, table.cells)
    np.testing.assert_array_equal(rays.touched, np.unique(rays.cells))
    np.testing.assert_array_equal(rays.touched[rays.columns], rays.cells)
    rays, beams = near_readings(random_scans(3), MARGIN_M), np.array([4, 0, 4])
    selected = rays.select(beams)
    for mine, whole in enumerate(beams):
        np.testing.assert_array_equal(of_beam(selected.cells, selected, mine), of_beam(rays.cells, rays, whole))
        assert selected.first_near[mine] - selected.offsets[mine] == rays.first_near[whole] - rays.offsets[whole]
    np.testing.assert_array_equal(selected.direction, rays.direction[beams])
    np.testing.assert_array_equal(selected.range_m, rays.range_m[beams])


def test_scans_may_be_traced_alone_from_other_poses_or_from_poses_of_their_beams():
    scans, there = random_scans(6), random_scans(7)
    whole = trace_rays(scans, GRID, poses_world=there.poses)
    assert_equal(whole, trace_rays(dataclasses.replace(scans, poses=there.poses), GRID))
    for scan in range(len(scans)):
        alone = trace_rays(scans.select(slice(scan, scan + 1)), GRID, poses_world=there.poses[scan])
        first = scan * len(scans.angles_rad)
        for b in range(alone.n_beams):
            np.testing.assert_array_equal(of_beam(alone.cells, alone, b), of_beam(whole.cells, whole, first + b))
    scans = random_scans(6, poses=1)
    moving = np.repeat(scans.poses[:, None], scans.n_beams, axis=1)
    moving[0, 1::2] += [0.4, -0.2, 0.3]
    other = dataclasses.replace(scans, poses=moving[0, 1], beam_poses=None)
    found = trace_rays(dataclasses.replace(scans, beam_poses=moving), GRID)
    both = [trace_rays(s, GRID) for s in (scans, other)]
    for b in range(scans.n_beams):
        np.testing.assert_array_equal(of_beam(found.cells, found, b), of_beam(both[b % 2].cells, both[b % 2], b))
        np.testing.assert_array_equal(found.start_m[b], both[b % 2].start_m[b])


def test_beams_are_traced_some_at_a_time_to_the_same_rays_and_too_many_incidences_are_refused(monkeypatch):
    scans, told = random_scans(3), []
    whole = near_readings(scans, MARGIN_M)
    monkeypatch.setattr("bayesmap.kernels.rays.BEAMS_PER_REPORT", 7)
    reach_m, near_m = around_readings(scans, MARGIN_M, GRID.resolution)
    pieces = trace_rays(scans, GRID, reach_m=reach_m, near_m=near_m, on_progress=lambda *now: told.append(now))
    assert_equal(pieces, whole)
    done = [done for done, _ in told]
    assert (done, told[-1]) == (sorted(done), (whole.n_beams, whole.n_beams))
    monkeypatch.setattr("bayesmap.kernels.rays.MAX_INCIDENCES", 10)
    with pytest.raises(bm.BadInput, match=r"90 beams cross .* cells, over the limit of 10; use a coarser resolution"):
        trace_rays(random_scans(3), GRID)


@EVERYWHERE
def test_a_ray_ends_where_no_stop_can_explain_its_reading_and_near_begins_not_far_before_it(kind):
    scans = random_scans(3, lattice=KINDS[kind])
    rays, whole = near_readings(scans, MARGIN_M), trace_rays(scans, GRID)
    entered, entered_whole = rays.chords()[0], whole.chords()[0]
    for b, reading in enumerate(scans.ranges_m.ravel()):
        within = of_beam(entered_whole, whole, b) <= (reading + MARGIN_M if np.isfinite(reading) else np.inf) + 1e-6
        np.testing.assert_array_equal(of_beam(rays.cells, rays, b), of_beam(whole.cells, whole, b)[within])
        enter, far = of_beam(entered, rays, b), int(rays.first_near[b] - rays.offsets[b])
        nearest = reading - MARGIN_M - GRID.resolution if np.isfinite(reading) else -np.inf
        assert (enter[:far] < nearest).all()
        assert far == len(enter) or enter[far] >= nearest - 1e-6
    assert (rays.lengths[np.isnan(scans.ranges_m.ravel())] == 0).all()


def test_margins_may_differ_from_beam_to_beam_and_end_points_are_in_metres_from_the_corner():
    scans = random_scans(8)
    margins = np.linspace(0.0, 2.0, scans.n_beams)
    rays = near_readings(scans, margins)
    for b in (1, scans.n_beams // 2, scans.n_beams - 1):
        alone = near_readings(scans, float(margins[b]))
        assert rays.lengths[b] == alone.lengths[b]
        assert rays.first_near[b] - rays.offsets[b] == alone.first_near[b] - alone.offsets[b]
    scans = random_scans(3)
    ends = near_readings(scans, MARGIN_M).end_points_m()
    hit = np.isfinite(scans.ranges_m.ravel())
    np.testing.assert_allclose(ends[hit], scans.hit_points_world() - np.array(GRID.origin), atol=1e-12)
    assert not np.isfinite(ends[~hit]).all(axis=1).any()


@pytest.mark.parametrize("readings", [[np.nan, np.nan], [1.0, np.inf]])
def test_no_valid_beam_or_none_through_the_grid_is_no_entry(readings):
    rays = trace_rays(bm.Scans([-0.5, 1.5, np.pi], [0.0, 0.1], [readings], max_range_m=9.0), bm.Grid((4, 3)))
    assert rays.n_incidences == len(rays.touched) == 0
    assert (rays.n_beams, rays.stop_distance_m(0.5).shape) == (2, (0,))
    whole = near_readings(random_scans(3), np.inf)  # without a warning of readings that are too close
    assert (whole.first_near == whole.offsets[:-1]).all()


@EVERYWHERE
def test_hits_and_passes_are_those_of_a_slow_count(kind):
    for seed in range(8):
        scans = random_scans(seed, lattice=KINDS[kind])
        met = touches(*beams(scans.poses, scans.angles_rad, GRID), GRID.shape) * GRID.resolution
        rays = trace_rays(scans, GRID)
        _, leave = rays.chords()
        hits, passes = np.zeros((2, GRID.n_cells), int)
        for b, z in enumerate(scans.ranges_m.ravel()):
            reach = min(z, scans.max_range_m)
            cells = [c for c in of_beam(rays.cells, rays, b).tolist() if met[b, c] <= reach + 1e-9]
            inside = len(cells) and z <= of_beam(leave, rays, b).max() + 1e-6
            stopped = np.isfinite(z) and inside
            if stopped:
                hits[cells[-1]] += 1
            if not np.isneginf(z) and not np.isnan(z):
                np.add.at(passes, cells[: -1 if stopped else None], 1)
        found = count_hits(scans, GRID)
        np.testing.assert_array_equal(found[0], hits)
        np.testing.assert_array_equal(found[1], passes)


LONGEST = 60.0
CELLS = 1e-9  # rounding over a few dozen cells is a thousand times smaller

seeds = st.integers(0, 2**32 - 1)
shapes = st.tuples(st.integers(1, 12), st.integers(1, 12))
densities = st.sampled_from([0.05, 0.3, 0.7, 1.0])
halves = st.integers(-8, 40).map(lambda n: n / 2)  # on lines, on corners, in cells' middles, in and out of the grid
anywhere = st.floats(-5, 17, allow_nan=False)
slopes = st.tuples(st.integers(-9, 9), st.integers(-9, 9)).filter(lambda s: s != (0, 0))


def random_walls(seed, shape, density):
    return np.random.default_rng(seed).random(shape) < density


def assert_equal_to_the_formula(walls, starts, angles):
    """Returns how many beams the formula was sure of."""
    expected = distances(walls, starts, angles, longest=LONGEST)
    sure = np.abs(expected - distances(walls, starts, angles, longest=LONGEST, slack=1e-7)) < CELLS
    found, _ = cast_beams(walls, starts, angles, LONGEST)
    np.testing.assert_allclose(found[sure], expected[sure], atol=CELLS, rtol=0)
    return sure.sum()


@given(seeds, shapes, densities)
def test_from_anywhere_at_any_angle(seed, shape, density):
    rng = np.random.default_rng(seed)
    starts = rng.uniform(-3, np.array(shape) + 3, (40, 2))
    assert assert_equal_to_the_formula(random_walls(seed, shape, density), starts, rng.uniform(-7, 7, 40)) >= 39


@given(seeds, shapes, densities, halves, halves, slopes)
def test_through_corners_and_along_lines_at_rational_slopes(seed, shape, density, x, y, slope):
    walls = random_walls(seed, shape, density)
    assert assert_equal_to_the_formula(walls, np.array([[x, y]]), np.array([np.arctan2(*slope)])) == 1


@given(seeds, shapes, anywhere, halves, st.sampled_from([0.0, np.pi / 2, np.pi, -np.pi / 2]))
def test_along_the_axes_from_anywhere(seed, shape, x, y, angle):
    assert_equal_to_the_formula(random_walls(seed, shape, 0.4), np.array([[x, y], [y, x]]), np.array([angle, angle]))


@given(st.integers(-6, 6), st.integers(-6, 6), st.floats(1e-12, 1e-6), st.sampled_from([-1, 1]))
def test_beams_a_hair_off_an_axis(x, y, tilt, sign):
    """Around the angle where a direction starts to count as parallel to an edge."""
    angle = np.array([0, 1, 2, 3]) * np.pi / 2 + sign * tilt
    assert_equal_to_the_formula(random_walls(1, (7, 7), 0.3), np.tile([x + 0.5, y + 0.25], (4, 1)), angle)


def test_long_beams_and_those_from_far_outside_keep_their_precision_and_look_no_further_than_their_hit():
    walls = random_walls(2, (8, 8), 0.3)
    rng = np.random.default_rng(6)
    aim, angles = rng.uniform(0, 8, (300, 2)), rng.uniform(-np.pi, np.pi, 300)
    starts = aim - 1e4 * np.column_stack([np.cos(angles), np.sin(angles)])
    expected = distances(walls, starts, angles, longest=3e4)
    sure = expected == distances(walls, starts, angles, longest=3e4, slack=1e-6)
    found, _ = cast_beams(walls, starts, angles, 3e4)
    assert sure.sum() > 290
    np.testing.assert_allclose(found[sure], expected[sure], atol=1e-6, rtol=0)  # 1e4 cells away, 1e-12 of them round
    walls = np.zeros((2000, 2000), dtype=bool)
    walls[-1, :] = walls[:, -1] = True
    rng = np.random.default_rng(5)
    starts, angles = rng.uniform(0, 3, (200, 2)), rng.uniform(0.001, np.pi / 2 - 0.001, 200)
    found, _ = cast_beams(walls, starts, angles, 1e4)
    to_x, to_y = (1999 - starts[:, 0]) / np.cos(angles), (1999 - starts[:, 1]) / np.sin(angles)
    np.testing.assert_allclose(found, np.minimum(to_x, to_y), atol=CELLS, rtol=0)
    walls = np.zeros((100, 1), dtype=bool)
    walls[10] = True
    _, visits = cast_beams(walls, np.array([[0.5, 0.5]]), np.array([0.0]), 1000.0)
    assert visits[0] <= 11


SENSORS = {
    "gaussian": bm.Gaussian(0.3), "growing": bm.Gaussian(0.1, 0.1), "student-t": bm.StudentT(0.2, 3.0, 0.02),
    "mixture": bm.BeamMixture(bm.Gaussian(0.05)),
    "wide mixture": bm.BeamMixture(bm.Gaussian(0.5, 0.05), 0.1, 0.1, 0.3, 1.0),
    "student-t mixture": bm.BeamMixture(bm.StudentT(0.05, 4.0)),
}  # fmt: skip
FLOAT32 = 2e-5
"""Likelihoods, and the distances that NumPy is given, are in single precision: 3e-7 of 3 m, times slopes of some tens
of nats a metre."""


@pytest.mark.parametrize("name", SENSORS)
def test_the_log_likelihood_of_a_map_is_the_sum_over_beams_at_the_oracle_s_distances(name, monkeypatch):
    """The compiled likelihood, and that of NumPy for a sensor without formulas for kernels."""
    monkeypatch.setattr(tracing, "SLICE", 100)  # several slices, not one
    sensor = SENSORS[name]
    for seed in range(10):
        scans = random_scans(seed)
        table, plain = trace(scans, GRID, sensor), trace(scans, GRID, OwnSensor(sensor))
        np.testing.assert_array_equal(table.offsets, plain.offsets)
        np.testing.assert_array_equal(table.cells, plain.cells)
        np.testing.assert_allclose(table.loglik, plain.loglik, rtol=FLOAT32, atol=FLOAT32)
        np.testing.assert_allclose(table.no_hit, plain.no_hit, rtol=1e-6, atol=1e-6)
        walls = np.random.default_rng([seed, 1]).random(GRID.shape) < [0.02, 0.1, 0.3, 0.9][seed % 4]
        starts, angles = beams(scans.poses, scans.angles_rad, GRID)
        d = distances(walls, starts, angles) * GRID.resolution
        z, limits = scans.ranges_m.ravel(), RangeLimits(scans.min_range_m, scans.max_range_m)
        expected = sensor.log_likelihood(z, d, limits)
        np.testing.assert_allclose(table.beam_log_likelihoods(walls), expected, atol=FLAT_NATS + FLOAT32, rtol=1e-5)
        assert table.log_likelihood(walls) == pytest.approx(expected.sum(), abs=len(z) * (FLAT_NATS + FLOAT32))


def test_a_robust_table_is_much_smaller_and_a_map_of_another_shape_is_refused():
    scans = bm.Scans([3.1, 0.1, 0.0], np.linspace(-0.5, 0.5, 50), np.full((1, 50), 0.5), max_range_m=10.0)
    robust, stiff = (trace(scans, GRID, s) for s in (bm.BeamMixture(bm.Gaussian(0.02)), bm.Gaussian(0.02)))
    assert robust.n_incidences < 0.5 * stiff.n_incidences
    table = trace(random_scans(0), GRID, bm.Gaussian(0.1))
    with pytest.raises(bm.BadInput, match=r"walls have shape \(9, 13\), but the grid is \(13, 9\)"):
        table.log_likelihood(np.zeros((9, 13)))


@pytest.mark.parametrize("name", SENSORS)
def test_the_index_is_a_permutation_of_the_table_in_which_incidences_that_could_gain_come_first(name):
    table = trace(random_scans(1), GRID, SENSORS[name])
    index = index_by_cell(table)
    np.testing.assert_array_equal(np.sort(index.entry), np.arange(table.n_incidences))
    np.testing.assert_array_equal(table.cells[index.entry], np.repeat(np.arange(GRID.n_cells), np.diff(index.offsets)))
    np.testing.assert_array_equal(table.loglik[index.entry], index.loglik)
    assert (table.offsets[index.beam] <= index.entry).all()
    assert (index.entry < table.offsets[index.beam + 1]).all()
    for c in range(GRID.n_cells):
        gain = -np.diff(np.append(index.gain_bound[index.offsets[c] : index.offsets[c + 1]], 0.0))
        first_small = np.append(np.flatnonzero(gain < 5e-4), len(gain))[0]  # the kernel's limit is 1e-3 nats
        assert (gain[first_small:] < 2e-3).all()


@pytest.mark.parametrize("sensor", [bm.Gaussian(0.3), bm.BeamMixture(bm.Gaussian(0.1))], ids=["gaussian", "mixture"])
@pytest.mark.parametrize("seed", range(4))
def test_the_index_bounds_what_walls_can_add(sensor, seed):
    """All 512 maps of 3 x 3 cells. The advantage: the least that a wall is worth to a beam that hits it in some map."""
    table = make_case(seed, shape=(3, 3), n_poses=3, sensor=sensor).problem().table
    index = index_by_cell(table)
    for b, e, advantage in zip(index.beam, index.entry, index.advantage, strict=True):
        behind = np.append(table.loglik[e + 1 : table.offsets[b + 1]], table.no_hit[b])
        assert advantage == pytest.approx(table.loglik[e] - behind.max(), abs=1e-5)
    maps = all_maps(9)
    for c in range(9):
        gains = np.zeros((len(maps), index.offsets[c + 1] - index.offsets[c]))
        put, removed = maps.copy(), maps.copy()
        put[:, c], removed[:, c] = True, False
        for m in range(len(maps)):
            with_wall, without = (table.beam_log_likelihoods(w[m].reshape(3, 3)) for w in (put, removed))
            gains[m] = (with_wall - without)[index.beam[index.offsets[c] : index.offsets[c + 1]]]
        rest = np.cumsum(gains[:, ::-1], axis=1)[:, ::-1]
        bound = index.gain_bound[index.offsets[c] : index.offsets[c + 1]]
        assert (rest <= bound + 1e-4).all()  # sums of some dozen single-precision terms of up to some hundred nats


def test_table_and_index_do_not_depend_on_the_number_of_threads(monkeypatch):
    scans, found = random_scans(3), []
    for threads in (1, 2, 3, 8):
        monkeypatch.setattr(devices, "available_cores", lambda threads=threads: threads)
        table = trace(scans, GRID, SENSORS["mixture"])
        parts = (table, index_by_cell(table))
        found.append([a for part in parts for a in vars(part).values() if isinstance(a, np.ndarray)])
    for other in found[1:]:
        for mine, theirs in zip(other, found[0], strict=True):
            np.testing.assert_array_equal(mine, theirs)
