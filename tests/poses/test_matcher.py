"""Correlative matching is exact, and finds what there is to find."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import warp as wp

from bayesmap.errors import BadInput
from bayesmap.kernels.match.likelihood_grid import next_level, widen
from bayesmap.kernels.match.line_pairs import Agreement, view_counts
from bayesmap.poses.matcher import Pull, likelihood_grids, match, score_at
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.space.planar import between
from bayesmap.space.scans import Scans

ANGLES = np.linspace(-np.pi, np.pi, 120, endpoint=False)
STEP = np.radians(3.0)


def ranges_in_room(pose, width, depth, notch=0.0):
    """Distances to the walls of a room centred on the origin, with one notch in a corner to break its symmetry."""
    found = []
    for angle in ANGLES + pose[2]:
        u = np.array([np.cos(angle), np.sin(angle)])
        with np.errstate(divide="ignore", invalid="ignore"):
            t = np.concatenate(
                [(np.array([-width, width]) / 2 - pose[0]) / u[0], (np.array([-depth, depth]) / 2 - pose[1]) / u[1]]
            )
        hit = t[t > 0].min()
        along = np.linspace(0, hit, 400)[:, None] * u + pose[:2]
        inside = (along[:, 0] > width / 2 - notch) & (along[:, 1] > depth / 2 - notch)
        found.append(hit if not inside.any() else np.linspace(0, hit, 400)[inside.argmax()])
    return np.array(found)


def room(poses, notch=0.0, noise_m=0.0, seed=1):
    rng = np.random.default_rng(seed)
    ranges = np.array([ranges_in_room(p, 4.0, 3.0, notch) for p in poses])
    return Scans(np.array(poses), ANGLES, ranges + noise_m * rng.normal(size=ranges.shape), max_range_m=20.0)


POSES = np.array([[0.0, 0.0, 0.0], [0.3, -0.2, 0.5], [-0.5, 0.4, -1.0]])


@cache
def notched_geometry():
    """Return the points of three scans of a room with a notch."""
    return scan_geometry(room(POSES, notch=0.8, noise_m=0.01))


@cache
def notched_grids():
    """Return the likelihood grid of the first two scans."""
    return likelihood_grids(notched_geometry(), [[0, 1]], [POSES[:2]], [[0.0, 0.0]], 3.0, levels=4)


def everywhere(grid, points, centre, half_m, half_rad, pull):
    """The score of every shift and angle of a window, by the plain formula: (angles, x, y)."""
    cells, steps = round(half_m / notched_grids().resolution), int(half_rad / STEP + 1e-9)
    shifts = np.arange(-cells, cells + 1) * notched_grids().resolution
    off = np.arange(-steps, steps + 1) * STEP
    poses = np.stack(np.meshgrid(off, shifts, shifts, indexing="ij"), axis=-1)[..., [1, 2, 0]]
    score = score_at(notched_grids(), grid, points, (poses + centre).reshape(-1, 3)).reshape(poses.shape[:3])
    if pull is not None:
        score = score - pull.weight * (
            (poses[..., 0] ** 2 + poses[..., 1] ** 2) / (2 * pull.sigma_m**2)
            + poses[..., 2] ** 2 / (2 * pull.sigma_rad**2)
        )
    return score, poses + centre


@pytest.mark.parametrize("pull", [None, Pull(0.2, 0.3, 0.05)], ids=["alone", "pulled"])
@pytest.mark.parametrize("centre", [(0.1, 0.2, 0.3), (-0.4, 0.3, -0.9), (2.9, 2.9, 0.0)], ids=["a", "b", "border"])
def test_the_search_finds_what_looking_everywhere_finds(centre, pull):
    points = notched_geometry().points_of(2)
    score, poses = everywhere(0, points, np.array(centre), 0.5, 0.5, pull)
    found = match(notched_grids(), [points], [centre], 0.5, 0.5, step_rad=STEP, min_score=-9.0, pull=pull)
    assert found.scores[0, 0] == pytest.approx(score.max(), abs=1e-12)
    first = np.unravel_index(np.argmax(score > score.max() - 1e-12), score.shape)
    np.testing.assert_allclose(found.poses[0, 0], poses[first], atol=1e-9)


def test_further_modes_are_the_best_that_lie_apart_and_not_looked_for_where_they_score_too_little():
    points = notched_geometry().points_of(2)
    centre = np.array([0.0, 0.0, 0.0])
    score, poses = everywhere(0, points, centre, 0.8, 0.7, None)
    found = match(notched_grids(), [points], [centre], 0.8, 0.7, step_rad=STEP, modes=9, apart_m=0.3, apart_rad=0.32)
    left = score.copy()
    for m in range(9):
        assert found.scores[0, m] == pytest.approx(left.max(), abs=1e-12)
        off = np.abs(poses - found.poses[0, m])
        left[(off[..., :2] <= 0.3 + 1e-9).all(axis=-1) & (off[..., 2] <= 6 * STEP + 1e-9)] = -1
    points = notched_geometry().points_of(2)
    several = {"step_rad": STEP, "modes": 3, "apart_m": 0.3, "apart_rad": 0.32, "min_score": 0.1}
    whole = match(notched_grids(), [points], [np.zeros(3)], 1.0, 1.2, **several)
    ratio = whole.scores[0] / whole.scores[0, 0]
    assert ratio[1] > ratio[2] > 0.1
    for share in (ratio[1] - 1e-9, ratio[1] + 1e-9, ratio[2] - 1e-9):
        some = match(notched_grids(), [points], [np.zeros(3)], 1.0, 1.2, min_score_ratio=share, **several)
        np.testing.assert_array_equal(some.scores[0], np.where(ratio > share, whole.scores[0], -np.inf))


def test_the_result_does_not_depend_on_threads():
    points = [notched_geometry().points_of(k) for k in range(3)]
    centres = POSES + np.array([0.15, -0.1, 0.1])
    kwargs = {"step_rad": STEP, "modes": 2, "apart_m": 0.2}
    one = match(replace(notched_grids(), threads=1), points, centres, 0.6, np.pi, threads_per_job=1, **kwargs)
    for threads, strands in ((2, 1), (2, 3), (4, 8)):
        grids = replace(notched_grids(), threads=threads)
        other = match(grids, points, centres, 0.6, np.pi, threads_per_job=strands, **kwargs)
        np.testing.assert_array_equal(one.scores, other.scores)
        np.testing.assert_array_equal(one.poses, other.poses)


def test_scans_are_found_where_they_were_taken_and_nothing_is_where_nothing_scores():
    points = [notched_geometry().points_of(2)]
    nothing = match(notched_grids(), points, [[50.0, 0.0, 0.0]], 0.5, 0.5, step_rad=STEP, min_score=0.1)
    assert not nothing.has_pose.any()
    assert np.isnan(nothing.poses).all()
    found = match(notched_grids(), points, [[0.0, 0.0, 0.0]], 1.2, np.pi, step_rad=np.radians(1.0))
    off = between(POSES[2], found.poses[0, 0])
    assert np.hypot(off[0], off[1]) < 0.06
    assert abs(off[2]) < np.radians(1.5)
    with pytest.raises(BadInput, match="finite"):
        match(notched_grids(), [notched_geometry().points_of(2)], np.full((1, 3), np.nan), 0.5, 0.5)


def test_maxima_by_numpy_are_those_of_the_kernel():
    pyramid = np.random.default_rng(3).integers(0, 255, (2, 2, 37, 21), dtype=np.uint8)
    for level in (1, 2, 4):
        half = 1 << (level - 1)
        stack = np.zeros((2, level + 1, 37, 21), np.uint8)
        stack[:, level - 1] = pyramid[:, 0]
        on_device = wp.array(stack, dtype=wp.uint8, device="cpu")
        wp.launch(next_level, dim=2 * 37, inputs=[0, level, on_device], device="cpu")
        found = np.empty((2, 37, 21), np.uint8)
        widen(pyramid[:, 0], found, half)
        np.testing.assert_array_equal(found, on_device.numpy()[:, level])


def wall_scan(beams, jump_m=0.0):
    """A wall 4 m ahead, seen by beams 60 degrees wide; from the middle on it stands further back."""
    angles = np.radians(30.0) * np.linspace(-1.0, 1.0, beams)
    ranges = (4.0 + jump_m * (angles > 0)) / np.cos(angles)
    return scan_geometry(Scans(np.zeros((1, 3)), angles, ranges[None], max_range_m=20.0))


@pytest.mark.parametrize("beams", [121, 30, 15], ids=["half a degree", "2 degrees", "4 degrees"])
def test_a_wall_is_drawn_whole_however_far_apart_beams_are(beams):
    """Beams 4 degrees apart end 30 cm apart: half a sigma along the wall from a stamp the value is exp(-1/8)."""
    geometry = wall_scan(beams)
    grids = likelihood_grids(geometry, [[0]], [np.zeros((1, 3))], [[0.0, 0.0]], 6.0)
    along = np.column_stack([np.full(200, 4.0), np.linspace(-2.2, 2.2, 200)])
    values = [score_at(grids, 0, point[None], np.zeros(3))[0] for point in along]
    assert min(values) > np.exp(-0.125) - 0.25  # and a cell's half diagonal
    assert score_at(grids, 0, np.array([[3.7, 0.0]]), np.zeros(3))[0] == 0.0


def test_nothing_is_drawn_between_walls_one_behind_the_other():
    geometry = wall_scan(30, jump_m=1.5)
    grids = likelihood_grids(geometry, [[0]], [np.zeros((1, 3))], [[0.0, 0.0]], 8.0)
    between_them = np.column_stack([np.linspace(4.3, 5.2, 10), np.zeros(10)])
    assert [score_at(grids, 0, p[None], np.zeros(3))[0] for p in between_them] == [0.0] * 10


@pytest.mark.parametrize("beams", [121, 15], ids=["half a degree", "4 degrees"])
def test_points_on_a_wall_agree_with_it_between_beams(beams):
    """A scan moved along a wall: its points fall between beams of the other; 60 cm before it they contradict."""
    geometry = wall_scan(beams)
    one = np.zeros(1, np.int32)
    seen = Agreement(near_m=0.05, clear_m=0.4, beams=1000)
    for ahead, column in ((0.0, 0), (-0.6, 1)):
        moved = np.array([[ahead, 0.14, 0.0]])
        counts = view_counts(geometry, one, one, moved, seen)[0]
        assert counts[column] > 0.7 * counts[2], counts  # at the wall's ends beams meet nothing
        assert counts[1 - column] == 0, counts
