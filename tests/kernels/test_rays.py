"""Rays are the beam table's walks, cut after the reading and marked where it begins to matter."""

import numpy as np
import pytest
from oracle.field_worlds import scans_of_all_kinds

import bayesmap as bm
from bayesmap.kernels.crossings import trace_crossings
from bayesmap.kernels.rays import trace_rays
from bayesmap.kernels.trace import trace

MARGIN_M = 0.3


@pytest.fixture(scope="module", params=[False, True], ids=["anywhere", "on lines"])
def case(request):
    grid = bm.Grid((6, 5), resolution=0.5, origin=(-1.0, 2.0))
    return grid, scans_of_all_kinds(3, grid, lattice=request.param)


def of_beam(array, offsets, b):
    return array[offsets[b] : offsets[b + 1]]


def test_whole_rays_cross_the_beam_table_s_cells_in_its_order(case):
    grid, scans = case
    rays = trace_rays(scans, grid, margin_m=0.0, whole=True)
    table = trace(scans, grid, bm.Gaussian(0.1))
    np.testing.assert_array_equal(rays.offsets, table.offsets)
    np.testing.assert_array_equal(rays.touched[rays.cells], table.cells)
    np.testing.assert_array_equal(rays.touched, np.unique(table.cells))


def test_beams_are_traced_some_at_a_time_to_the_same_rays(case, monkeypatch):
    grid, scans = case
    whole, told = trace_rays(scans, grid, margin_m=MARGIN_M), []
    monkeypatch.setattr("bayesmap.kernels.rays.BEAMS_AT_ONCE", 7)
    pieces = trace_rays(scans, grid, margin_m=MARGIN_M, on_progress=lambda *now: told.append(now))
    for name in ("touched", "offsets", "cells", "distance_m", "near"):
        np.testing.assert_array_equal(getattr(pieces, name), getattr(whole, name))
    done = [done for done, _ in told]
    assert done == sorted(done)
    assert told[-1] == (whole.n_beams, whole.n_beams)


@pytest.mark.parametrize("depth", [0.0, 0.5, 1.0])
def test_a_plain_stop_is_at_the_given_part_of_the_chord(case, depth):
    grid, scans = case
    rays = trace_rays(scans, grid, margin_m=0.0, hit_depth=depth, whole=True)
    crossings = trace_crossings(scans, grid)
    np.testing.assert_allclose(rays.distance_m, crossings.entry_m + depth * crossings.chord_m, atol=1e-5)


def test_a_ray_ends_where_no_stop_can_explain_its_reading(case):
    grid, scans = case
    rays, whole = trace_rays(scans, grid, margin_m=MARGIN_M), trace_crossings(scans, grid)
    for b, reading in enumerate(scans.ranges_m.ravel()):
        entry = of_beam(whole.entry_m, whole.offsets, b)
        wanted = entry <= (reading + MARGIN_M if np.isfinite(reading) else np.inf) + 1e-6
        cells = of_beam(rays.cells, rays.offsets, b)
        np.testing.assert_array_equal(rays.touched[cells], of_beam(whole.cells, whole.offsets, b)[wanted])
    assert (np.diff(rays.offsets)[np.isnan(scans.ranges_m.ravel())] == 0).all()


def test_near_begins_at_the_first_entry_not_far_before_the_reading(case):
    grid, scans = case
    rays = trace_rays(scans, grid, margin_m=MARGIN_M)
    for b, reading in enumerate(scans.ranges_m.ravel()):
        distance = of_beam(rays.distance_m, rays.offsets, b)
        far = int(rays.near[b] - rays.offsets[b])
        if not np.isfinite(reading):
            assert far == 0
            continue
        nearest = reading - MARGIN_M - grid.resolution
        assert (distance[:far] < nearest).all()
        assert far == len(distance) or distance[far] >= nearest - 1e-6


def test_margins_may_differ_from_beam_to_beam(case):
    grid, scans = case
    margins = np.linspace(0.0, 2.0, scans.n_beams)
    rays = trace_rays(scans, grid, margin_m=margins)
    for b in (1, scans.n_beams // 2, scans.n_beams - 1):
        alone = trace_rays(scans, grid, margin_m=float(margins[b]))
        assert np.diff(rays.offsets)[b] == np.diff(alone.offsets)[b]
        assert rays.near[b] - rays.offsets[b] == alone.near[b] - alone.offsets[b]


def test_end_points_and_centres_are_in_metres_from_the_corner(case):
    grid, scans = case
    rays = trace_rays(scans, grid, margin_m=MARGIN_M)
    ends = rays.end_points_m()
    hit = np.isfinite(scans.ranges_m.ravel())
    np.testing.assert_allclose(ends[hit], scans.hit_points_world() - np.array(grid.origin), atol=1e-5)
    assert not np.isfinite(ends[~hit]).all(axis=1).any()
    x, y = grid.centers_m()
    flat = rays.touched
    expected = np.stack([x[flat // grid.shape[1]], y[flat % grid.shape[1]]], axis=-1) - np.array(grid.origin)
    np.testing.assert_allclose(rays.centres_m(), expected, atol=1e-9)


def test_values_go_back_to_the_grid():
    scans = bm.Scans([-0.5, 1.5, 0.0], [0.0], [[1.2]], max_range_m=9.0)
    rays = trace_rays(scans, bm.Grid((4, 3)), margin_m=0.5)
    assert rays.n_cells == rays.n_incidences == 2
    np.testing.assert_array_equal(
        rays.to_grid(np.array([[5.0, 6.0]]), -1.0)[0], [[-1, 5, -1], [-1, 6, -1], [-1, -1, -1], [-1, -1, -1]]
    )


@pytest.mark.parametrize("readings", [[np.nan, np.nan], [1.0, np.inf]])
def test_no_valid_beam_or_none_through_the_grid_is_no_cell(readings):
    away = bm.Scans([-0.5, 1.5, np.pi], [0.0, 0.1], [readings], max_range_m=9.0)
    rays = trace_rays(away, bm.Grid((4, 3)), margin_m=0.5)
    assert rays.n_cells == rays.n_incidences == 0
    assert rays.n_beams == 2


def test_all_margins_at_once_make_no_warning_of_readings_that_are_too_close(case):
    grid, scans = case
    rays = trace_rays(scans, grid, margin_m=np.inf, whole=True)
    assert (rays.near == rays.offsets[:-1]).all()
