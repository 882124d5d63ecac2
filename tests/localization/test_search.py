"""The search finds what looking everywhere finds."""

import numpy as np
import pytest
from rooms import ANGLES, offset, scan_from, walls_of
from tiers import full_but

from bayesmap.localization.search import (
    APART_M,
    APART_RAD,
    HEADINGS,
    POINTS,
    _coarse_poses,
    end_points,
    likelihood_field,
    refine,
    search,
)
from bayesmap.space.planar import wrapped


@pytest.fixture(scope="module")
def room():
    walls, grid = walls_of(6.0, 4.0)
    return walls, grid, likelihood_field(walls.astype(float), grid, ~walls)


def test_the_coarse_search_scores_every_position_and_heading(room):
    """The best of its poses is the best of the whole lattice, by the plain sum."""
    walls, grid, field = room
    scans = scan_from(walls, grid, np.array([2.0, 1.7, 1.0]))
    points = end_points(ANGLES, scans.ranges_m[0], POINTS)
    (mx, my), size = field.coarse_grid.shape, field.coarse_grid.resolution

    def plain(cell, heading):
        cos, sin = np.cos(heading), np.sin(heading)
        i = cell[0] + np.floor((cos * points[:, 0] - sin * points[:, 1]) / size + 0.5).astype(int)
        j = cell[1] + np.floor((sin * points[:, 0] + cos * points[:, 1]) / size + 0.5).astype(int)
        inside = (i >= 0) & (j >= 0) & (i < mx) & (j < my)
        return int(field.coarse[i[inside], j[inside]].sum())

    headings = np.arange(HEADINGS) * 2 * np.pi / HEADINGS
    cells = np.argwhere(field.open)
    best = max(plain(cell, heading) for cell in cells for heading in headings)
    found = _coarse_poses(field, points)
    scores = [plain(np.floor(pose[:2] / size).astype(int), pose[2]) for pose in found]
    assert max(scores) == best


@pytest.mark.parametrize("seed", full_but(range(5), 0, 4))
def test_the_true_pose_is_found(room, seed):
    walls, grid, field = room
    rng = np.random.default_rng(seed)
    truth = np.array([rng.uniform(0.5, 4.5), rng.uniform(0.5, 2.5), rng.uniform(-np.pi, np.pi)])
    scans = scan_from(walls, grid, truth, seed=seed)
    found = search(field, ANGLES, scans.ranges_m[0], 10)
    off = [offset(pose, truth) for pose in found.poses]
    assert min(metres + radians for metres, radians in off) < 0.15
    assert (np.diff(found.scores) <= 0).all()
    for i, pose in enumerate(found.poses):
        near = np.abs(found.poses[:i, :2] - pose[:2]).max(axis=1, initial=0) < APART_M
        assert not (near & (np.abs(wrapped(found.poses[:i, 2] - pose[2])) < APART_RAD)).any()


def test_refining_never_loses(room):
    walls, grid, field = room
    scans = scan_from(walls, grid, np.array([2.0, 1.7, 1.0]))
    points = end_points(ANGLES, scans.ranges_m[0], 90)
    start = np.array([[2.1, 1.6, 1.05]])
    assert refine(field, points, start, 1).scores[0] >= field.score(points, start)[0]


def test_a_scan_without_hits_has_no_candidates(room):
    assert len(search(room[2], ANGLES, np.full(len(ANGLES), np.inf), 5).poses) == 0
