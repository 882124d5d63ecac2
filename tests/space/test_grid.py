"""Single scans that are absurdly far out: found, named, and told apart from maps that are large."""

from dataclasses import replace

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.space.grid import outlying


@pytest.fixture
def walk():
    """Fifty scans of a robot that goes 10 m, seeing up to 5 m."""
    rng = np.random.default_rng(4)
    poses = np.column_stack([np.linspace(0, 10, 50), rng.normal(0, 1, 50), rng.uniform(-3, 3, 50)])
    return bm.Scans(poses, [0.0, 0.5], rng.uniform(1, 5, (50, 2)), max_range_m=2e7, stamps_s=np.arange(50.0))


def moved(scans, scan, x_m):
    poses = scans.poses.copy()
    poses[scan, 0] = x_m
    return replace(scans, poses=poses)


def read(scans, scan, beam, range_m):
    ranges = scans.ranges_m.copy()
    ranges[scan, beam] = range_m
    return replace(scans, ranges_m=ranges)


def test_the_furthest_comes_first_and_an_ordinary_walk_has_none(walk):
    assert len(outlying(walk)) == 0
    assert bm.Grid.covering(walk, 0.1).n_cells < 100_000
    wrong = read(moved(moved(walk, 7, 1e6), 9, -1e9), 3, 1, 1e7)
    assert outlying(wrong).tolist() == [9, 3, 7]


def test_where_many_are_far_away_nobody_is_wrong(walk):
    far = walk.poses.copy()
    far[::3, 0] += 1e6
    scans = replace(walk, poses=far)
    assert len(outlying(scans)) == 0
    with pytest.raises(bm.BadInput, match="use a coarser resolution, or check that ranges and poses are in metres"):
        bm.Grid.covering(scans, 0.01)


@pytest.mark.parametrize("x_m", [1e7, -1e12, 1e300])
def test_a_wild_pose_is_named(walk, x_m):
    with pytest.raises(bm.BadInput) as refused:
        bm.Grid.covering(moved(walk, 7, x_m), 0.1)
    message = str(refused.value)
    assert f"scan 7 (at 7.000 s) was taken at ({x_m:.6g}, " in message
    assert "correct its pose in the log or leave it out" in message
    assert len(message) < 300


def test_a_wild_reading_is_named_with_its_beam_and_others_are_counted(walk):
    with pytest.raises(bm.BadInput, match=r"beam 1 of scan 3 .* reads 1e\+07 m.*--max-range"):
        bm.Grid.covering(read(walk, 3, 1, 1e7), 0.1)
    with pytest.raises(bm.BadInput, match=r"scan 9 .*\(2 scans are so far out, this one most\)"):
        bm.Grid.covering(moved(moved(walk, 7, 1e8), 9, -1e9), 0.1)
