"""Range scans and poses in the plane: refusals, fans of beams, beams with poses of their own, and order in time.

Beams may differ from scan to scan. Results from such scans equal those from the same beams in equal scans: "whole" has
equal scans of which only a window of beams has readings, "own" only the beams of the windows; "turned" has the beams of
"whole" at trembling angles that the poses' yaw makes up for. Late scans are sorted; a clock that was set back is not.
Single scans that are absurdly far out are told from maps that are large.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import bayesmap as bm
from bayesmap.kernels.predict.density import ScanLikelihood
from bayesmap.kernels.rays import trace_rays
from bayesmap.kernels.walls.table import trace
from bayesmap.model import Model
from bayesmap.posterior.heldout import unseen_scans
from bayesmap.space import arrays
from bayesmap.space import planar as p
from bayesmap.space import time_order as times
from bayesmap.space.grid import outlying
from bayesmap.space.scans import fan, side_by_side

SENSOR = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.05, p_no_return=0.05, p_short=0.05)
BEAMS, SCANS = 60, 16


def test_fans_of_lasers_that_are_sold_and_of_a_full_circle():
    np.testing.assert_allclose(np.degrees(fan(180, 180.0)), np.arange(180) - 90)
    np.testing.assert_allclose(np.degrees(fan(361, 180.0)), np.arange(361) / 2 - 90)
    np.testing.assert_allclose(np.degrees(fan(4, 360.0)), [0, 90, 180, 270])
    np.testing.assert_array_equal(fan(7, math.degrees(2 * math.pi)), fan(7, 360.0))
    for beams, fov_deg, named in ((1, 90.0, "angles"), (90, 0.0, "fov"), (90, 361.0, "fov")):
        with pytest.raises(bm.BadInput, match=named):
            fan(beams, fov_deg)


@pytest.mark.parametrize(("changed", "message"), [
    ({"stamps_s": [0.0, 1.0, np.nan, 3.0]}, "stamp of scan 2 is not finite: nan; leave stamps_s out"),
    ({"beam_poses": np.zeros((4, 2, 3))}, r"beam_poses has shape \(4, 2, 3\), expected \(4, 3, 3\)"),
    ({"beam_poses": np.full((4, 3, 3), np.nan)}, "pose of beam 0 of scan 0 is not finite"),
])  # fmt: skip
def test_numbers_that_do_not_fit_are_refused_by_name(changed, message):
    with pytest.raises(bm.BadInput, match=message):
        bm.Scans(np.zeros((4, 3)), [0.0, 0.5, 1.0], np.ones((4, 3)), 10.0, **changed)


def test_beams_with_poses_of_their_own_are_as_many_scans_of_one_beam():
    rng, grid, sensor = np.random.default_rng(0), bm.Grid(shape=(20, 20), resolution=0.5), bm.Gaussian(0.1)
    beam_poses = rng.uniform([2, 2, -3], [8, 8, 3], (4, 3, 3))
    ranges, angles = rng.uniform(0.5, 4, (4, 3)), np.array([0.0, 0.5, 1.0])
    scans = bm.Scans(beam_poses[:, 0], angles, ranges, 10.0, beam_poses=beam_poses)
    poses = beam_poses.reshape(-1, 3) + np.outer(np.tile(angles, 4), [0, 0, 1])
    single = bm.Scans(poses, [0.0], ranges.reshape(-1, 1), 10.0)
    np.testing.assert_allclose(scans.hit_points_world(), single.hit_points_world(), atol=1e-12)
    plain = bm.Scans(scans.poses, angles, ranges, 10.0)
    still = replace(plain, beam_poses=np.repeat(scans.poses[:, None], 3, axis=1))
    for one, other in ((scans, single), (plain, still)):
        a, b = trace(one, grid, sensor), trace(other, grid, sensor)
        np.testing.assert_array_equal(a.cells, b.cells)
        np.testing.assert_array_equal(a.loglik, b.loglik)
    train, held = scans.holdout(3)
    np.testing.assert_array_equal(held.beam_poses, beam_poses[1:2])
    np.testing.assert_array_equal(train.beam_poses, beam_poses[[0, 2, 3]])


@pytest.fixture(scope="module")
def log():
    rng = np.random.default_rng(5)
    walls = np.zeros((24, 20), dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[8:12, 6:9] = True
    grid = bm.Grid(walls.shape, 0.25)
    poses = np.column_stack([rng.uniform(3.2, 5.5, SCANS), rng.uniform(0.8, 4.2, SCANS), rng.uniform(-3, 3, SCANS)])
    angles = np.arange(BEAMS) * 2 * np.pi / BEAMS - np.pi
    scans = bm.simulate(walls, grid, poses, angles, sensor=SENSOR, max_range_m=5.0, typed=True, seed=2)
    first, count = rng.integers(0, 6, SCANS), rng.integers(30, 55, SCANS)
    window = (np.arange(BEAMS) >= first[:, None]) & (np.arange(BEAMS) < (first + count)[:, None])
    ranges = np.where(window, scans.ranges_m, np.nan)
    stamps = 100.0 + 0.1 * np.arange(SCANS)
    own = side_by_side([angles[w] for w in window], [row[w] for row, w in zip(ranges, window, strict=True)])
    tremble = rng.normal(0, 0.02, (SCANS, 1))
    turned = np.column_stack([scans.poses[:, :2], scans.poses[:, 2:] - tremble])
    whole = replace(scans, ranges_m=ranges, stamps_s=stamps)
    return grid, window, {
        "whole": whole,
        "own": bm.Scans(scans.poses, *own, 5.0, stamps_s=stamps),
        "turned": replace(whole, poses=turned, own_angles_rad=angles + tremble),
    }  # fmt: skip


def test_the_beams_are_those_of_the_windows_and_scans_may_have_none(log):
    grid, window, logs = log
    whole, own, turned = logs["whole"], logs["own"], logs["turned"]
    assert own.ranges_m.shape == (SCANS, window.sum(axis=1).max())
    assert own.n_beams == window.sum() == sum(own.counts().values())
    assert (own.counts()["hit"], own.counts()["no_return"]) == (whole.counts()["hit"], whole.counts()["no_return"])
    np.testing.assert_array_equal(own.hit_points_world(), whole.hit_points_world())
    np.testing.assert_allclose(turned.hit_points_world(), whole.hit_points_world(), atol=1e-12)
    for i in range(SCANS):
        np.testing.assert_array_equal(own.beams_of(i)[0], whole.angles_rad[window[i]])
        np.testing.assert_array_equal(own.select([i]).beams_of(0), own.beams_of(i))
    train, held = own.holdout(4)
    np.testing.assert_array_equal(held.beams_of(1), own.beams_of(6))
    np.testing.assert_array_equal(own.at(own.poses + 1.0).limited(2.0).own_angles_rad, own.own_angles_rad)
    assert len(train) + len(held) == SCANS
    again = replace(whole, angles_rad=np.tile(whole.angles_rad, (SCANS, 1)))  # equal angles are those of all scans
    assert again.own_angles_rad is None
    np.testing.assert_array_equal(again.angles_rad, whole.angles_rad)
    angles, readings = own.own_angles_rad.copy(), own.ranges_m.copy()
    angles[3], readings[3] = np.nan, np.nan
    scans = replace(own, own_angles_rad=angles, ranges_m=readings)
    assert [len(part) for part in scans.beams_of(3)] == [0, 0]
    assert np.isfinite(scans.angles_by_scan()).all()
    np.testing.assert_array_equal(scans.stretched(1.1).has_beam, scans.has_beam)
    assert trace_rays(scans.select([3]), grid).n_incidences == 0
    with pytest.raises(bm.BadInput, match=r"angles_rad has shape \(16, 3\), expected"):
        replace(own, angles_rad=np.zeros((SCANS, 3)), own_angles_rad=None)
    with pytest.raises(bm.BadInput, match=r"angles_rad of scan 2: its beams point from 0 to 90 radians"):
        bm.Scans(np.zeros((3, 3)), [[0.0, 1.0], [0.0, 1.0], [0.0, 90.0]], np.ones((3, 2)), 5.0)


@pytest.mark.parametrize("name", ["own", "turned"])
@pytest.mark.parametrize("cells", [bm.Independent(0.2), bm.Surface()])
def test_the_model_says_the_same(log, name, cells):
    grid, _, logs = log
    drawn = cells.sample_cells(np.random.default_rng(0), grid)
    models = [Model(scans, grid, cells, SENSOR) for scans in (logs["whole"], logs[name])]
    expected, likelihoods = (model.beam_log_likelihoods(model.state(drawn)) for model in models)
    assert len(likelihoods) == logs[name].ranges_m.size
    np.testing.assert_allclose(likelihoods.sum(), expected.sum(), rtol=1e-6)
    valid = [np.sort(values[values != 0]) for values in (likelihoods, expected)]
    np.testing.assert_allclose(*valid, rtol=1e-3, atol=1e-6)


@pytest.mark.parametrize("name", ["own", "turned"])
def test_maps_scores_and_saved_runs_are_the_same(log, name, tmp_path):
    grid, _, logs = log
    runs, scores = [], []
    for scans in (logs["whole"], logs[name]):
        train, held = scans.holdout(4)
        schedule = bm.Schedule(chains=2, warmup=20, draws=60)
        run = bm.infer(train, grid, prior=bm.Independent(0.2), sensor=SENSOR, schedule=schedule, seed=1)
        runs.append(run)
        scores.append(bm.score(run, held))
        assert len(unseen_scans(train, held, 0, "log")) == len(held)
        with pytest.raises(bm.BadInput):
            unseen_scans(train, train, 0, "log")
    np.testing.assert_allclose(runs[1].occupancy, runs[0].occupancy, atol=0.02)
    assert scores[1].beams == scores[0].beams
    assert scores[1].nats_per_beam == pytest.approx(scores[0].nats_per_beam, abs=0.01)
    runs[1].save(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    for field in ("poses", "angles_rad", "own_angles_rad", "ranges_m", "stamps_s"):
        np.testing.assert_array_equal(getattr(loaded.posterior.scans, field), getattr(runs[1].posterior.scans, field))
    assert bm.score(loaded, logs[name].holdout(4)[1]).nats_per_beam == scores[1].nats_per_beam
    loaded.export(tmp_path / "map.yaml")
    loaded.export(tmp_path / "a.tum")


@pytest.mark.parametrize("name", ["own", "turned"])
def test_poses_are_inferred_as_from_equal_scans(log, name):
    """One pose at a time, both logs under the same map: the likelihood along its neighbourhood is the same."""
    grid, _, logs = log
    rng = np.random.default_rng(3)
    walls = (rng.random((1, grid.n_cells)) < 0.2).astype(np.float32)
    scan = rng.integers(0, SCANS, 40)
    shift = rng.normal(0, 0.05, (40, 3))
    expected, likelihoods = (
        ScanLikelihood(scans, grid, SENSOR, 0.0)(walls, scans.poses[scan] + shift, scan, np.zeros(40, np.intp))
        for scans in (logs["whole"], logs[name])
    )
    np.testing.assert_allclose(likelihoods, expected, rtol=1e-6)


def test_headings_in_degrees_are_refused():
    walls, grid = np.zeros((4, 4)), bm.Grid((4, 4))
    for call in (
        lambda: bm.simulate(walls, grid, [1, 1, 90.0], [0.0], sensor=bm.Gaussian(0.1), max_range_m=9.0),
        lambda: bm.InitialPose((1, 1, 90.0)), lambda: bm.InitialPose((1, 1, 0.0), 0.1, 5.0),
        lambda: bm.UncertainPoses(0.1, 5.0),
    ):  # fmt: skip
        with pytest.raises(bm.BadInput, match="are these degrees"):
            call()
    turning = np.column_stack([np.ones(9), np.ones(9), np.linspace(0, 30, 9)])  # headings may add up
    assert len(bm.simulate(walls, grid, turning, [0.0], sensor=bm.Gaussian(0.1), max_range_m=9.0)) == 9


EVEN = np.arange(400) * 0.1


def is_sorted(stamps_s, expected_s=EVEN):
    ordered = times.time_order(stamps_s)
    np.testing.assert_array_equal(ordered.stamps_s, expected_s)
    np.testing.assert_array_equal(stamps_s[ordered.order], expected_s)
    assert ordered.resets == ()
    return ordered


@pytest.mark.parametrize("burst", [5, 20, 50])
def test_bursts_and_single_scans_that_were_written_late_are_sorted(burst):
    assert is_sorted(EVEN).reordered == 0
    for seed in range(3):
        order = np.random.default_rng(seed).permutation(400 // burst)
        assert is_sorted(EVEN.reshape(-1, burst)[order].ravel()).reordered > 0
    is_sorted(np.concatenate([EVEN[:50], EVEN[51:100], EVEN[50:51], EVEN[100:]]))


@pytest.mark.parametrize("back_s", [1.6, 3.0, 15.0])
def test_a_clock_that_was_set_back_keeps_the_order_of_the_log(back_s):
    stamps = EVEN + np.random.default_rng(1).uniform(-0.02, 0.02, 400)
    stamps[200:] -= back_s
    stamps[300:] -= back_s
    ordered = times.time_order(stamps)
    assert ordered.resets == (200, 300)
    np.testing.assert_array_equal(ordered.order, np.arange(400))
    assert (np.diff(ordered.stamps_s) > 0).all()
    np.testing.assert_allclose(ordered.stamps_s, EVEN, atol=0.15)
    np.testing.assert_allclose(ordered.set_back_s, back_s - 0.1, atol=0.05)
    first, second = ordered.notes(stamps)
    assert f"at scan 200 (at {times.stamp_words(stamps[200])}); from there on" in first
    assert "at scan 300" in second


def test_stamps_are_told_as_people_tell_time():
    told = {59.31: "59.3 s", 0.0: "0.0 s", 1.7e9 + 0.96: "2023-11-14 22:13:21.0 UTC", 1e30: f"{1e30:.1f} s"}
    assert {stamp: times.stamp_words(stamp) for stamp in told} == told
    assert times.times_words(EVEN + 1.7e9, 30, 60) == " (3.0 to 6.0 s after the first scan)"
    assert times.times_words(EVEN, 30) == " (3.0 s after the first scan)"
    assert times.times_words(None, 30) == ""


@pytest.mark.parametrize("scans", [30, 129, 400, 5000])
def test_a_shuffled_log_is_sorted(scans):
    """Its stamps go back every other scan, which no clock does: 20 shuffles each."""
    stamps = np.arange(scans) * 0.7
    for seed in range(20):
        is_sorted(np.random.default_rng(seed).permutation(stamps), stamps)


EVERY_FIFTH = 1.7e9 + 0.2 * np.arange(200)


def test_stamps_that_all_differ_are_exact_a_pause_in_coarse_ones_is_one_and_only_repeated_ones_are_coarse():
    stamps = np.array([0.0, 0.2, 0.5, 9.0])
    for bound in times.elapsed_bounds_s(stamps):
        np.testing.assert_array_equal(bound, np.diff(stamps))
    assert not times.repeated_stamps(stamps).any()
    assert times.coarse_stamps_note(stamps) is None
    assert times.elapsed_bounds_s(stamps[:1])[0].shape == times.elapsed_bounds_s(stamps[:0])[0].shape == (0,)
    stamps = np.floor(EVERY_FIFTH + 60.0 * (np.arange(200) >= 100))
    least_s, most_s = times.elapsed_bounds_s(stamps)
    assert 59.0 <= least_s[99] <= 60.2 <= most_s[99] <= 62.0
    stamps = np.append(EVERY_FIFTH[:100], np.repeat(EVERY_FIFTH[99], 20))
    least_s, most_s = times.elapsed_bounds_s(stamps)
    np.testing.assert_allclose(least_s[:98], 0.2, atol=1e-6)
    np.testing.assert_array_equal(most_s[99:], np.inf)
    np.testing.assert_array_equal(least_s[99:], 0.0)
    np.testing.assert_array_equal(np.nonzero(times.repeated_stamps(stamps))[0], np.arange(99, 120))
    assert times.coarse_stamps_note(stamps).startswith("stamps are coarse: 21 of 120 scans")


@pytest.mark.parametrize(
    "coarse",
    [np.floor, np.round, np.ceil, lambda t: 10 * np.floor(t / 10), lambda t: t.astype(np.float32).astype(float)],
    ids=["whole seconds", "rounded", "rounded up", "tens of seconds", "single precision"],
)
def test_the_true_time_lies_between_the_bounds_of_coarse_stamps(coarse):
    stamps = coarse(EVERY_FIFTH)
    least_s, most_s = times.elapsed_bounds_s(stamps)
    assert (least_s <= 0.2 + 1e-6).all()
    assert (most_s >= 0.2 - 1e-6).all()
    assert times.repeated_stamps(stamps).mean() > 0.9
    assert "stamps are coarse: " in times.coarse_stamps_note(stamps)


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


def test_the_furthest_comes_first_and_where_none_or_many_are_far_away_nobody_is_wrong(walk):
    assert len(outlying(walk)) == 0
    assert bm.Grid.covering(walk, 0.1).n_cells < 100_000
    assert outlying(read(moved(moved(walk, 7, 1e6), 9, -1e9), 3, 1, 1e7)).tolist() == [9, 3, 7]
    far = walk.poses.copy()
    far[::3, 0] += 1e6
    scans = replace(walk, poses=far)
    assert len(outlying(scans)) == 0
    with pytest.raises(bm.BadInput, match="use a coarser resolution, or check that ranges and poses are in metres"):
        bm.Grid.covering(scans, 0.01)


def test_a_wild_pose_or_reading_is_named_and_others_are_counted(walk):
    for x_m in (1e7, -1e12, 1e300):
        with pytest.raises(bm.BadInput) as refused:
            bm.Grid.covering(moved(walk, 7, x_m), 0.1)
        message = str(refused.value)
        assert f"scan 7 (7.0 s after the first scan) was taken at ({x_m:.6g}, " in message
        assert "correct its pose in the log or leave it out" in message
        assert len(message) < 300
    with pytest.raises(bm.BadInput, match=r"beam 1 of scan 3 .* reads 1e\+07 m.*--max-range"):
        bm.Grid.covering(read(walk, 3, 1, 1e7), 0.1)
    with pytest.raises(bm.BadInput, match=r"scan 9 .*\(2 scans are so far out, this one most\)"):
        bm.Grid.covering(moved(moved(walk, 7, 1e8), 9, -1e9), 0.1)


NUMBER = st.floats(-50, 50)
POSE = st.tuples(NUMBER, NUMBER, NUMBER).map(np.array)


def matrix(pose):
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    return np.array([[cos, -sin, pose[0]], [sin, cos, pose[1]], [0, 0, 1]])


@given(POSE, POSE)
def test_composition_and_inverse_are_those_of_matrices(a, b):
    np.testing.assert_allclose(matrix(p.compose(a, b)), matrix(a) @ matrix(b), atol=1e-9)
    np.testing.assert_allclose(matrix(p.inverse(a)), np.linalg.inv(matrix(a)), atol=1e-9)
    np.testing.assert_allclose(matrix(p.compose(a, p.between(a, b))), matrix(b), atol=1e-9)


def test_angles_are_wrapped_and_interpolated_the_short_way_between_neighbours():
    wrapped = [-np.pi, -np.pi, 7.0 - 2 * np.pi, 0.5]
    np.testing.assert_allclose(p.wrap_angle(np.array([np.pi, -np.pi, 7.0, 0.5])), wrapped)
    stamps = np.array([0.0, 1.0, 1.0, 3.0])
    poses = np.array([[0, 0, 3.0], [1, 0, -3.0], [1, 1, -3.0], [3, 1, -3.0]], dtype=float)
    found = p.interpolate(stamps, poses, np.array([-1.0, 0.0, 0.5, 1.0, 2.0, 9.0]))
    np.testing.assert_allclose(found[[0, 1, 3, 5]], poses[[0, 0, 2, 3]], atol=1e-12)
    assert abs(abs(found[2, 2]) - np.pi) < 1e-9
    np.testing.assert_allclose(found[4], [2.0, 1.0, -3.0], atol=1e-12)
    for count in (1, 2):  # one pose holds at all times
        alone = p.interpolate(np.zeros(count), np.tile([[1.0, 2.0, 0.5]], (count, 1)), np.array([-1.0, 0.0, 1.0]))
        np.testing.assert_allclose(alone, [[1.0, 2.0, 0.5]] * 3)
    before, after = arrays.bracketing_indices(np.array([1.0, 2.0, 4.0]), np.array([0.0, 1.5, 2.0, 3.0, 9.0]))
    assert (before.tolist(), after.tolist()) == ([0, 0, 0, 1, 1], [1, 1, 1, 2, 2])
    alone = np.array([5]), np.array([1, 5, 9])
    indices = *arrays.bracketing_indices(*alone), arrays.nearest_index(*alone)
    assert [index.tolist() for index in indices] == [[0, 0, 0]] * 3


@given(st.lists(st.integers(-50, 50), min_size=1, max_size=8, unique=True), st.integers(-60, 60))
def test_the_nearest_is_the_nearest_of_all_and_of_two_the_earlier(numbers, number):
    ascending = np.sort(numbers)
    assert arrays.nearest_index(ascending, np.array([number]))[0] == np.argmin(np.abs(ascending - number))


A, B = np.random.default_rng(5).normal(0.0, 2.0, (2, 20, 3))


def test_points_follow_their_pose_and_jacobians_equal_finite_differences():
    points = np.random.default_rng(6).normal(size=(20, 2))
    np.testing.assert_allclose(p.transform(A, p.transform(B, points)), p.transform(p.compose(A, B), points), atol=1e-12)
    by_a, by_b = p.between_jacobians(p.between(A, B))
    for k, h in enumerate(np.eye(3) * 1e-6):
        change_a = (p.between(p.compose(A, h), B) - p.between(p.compose(A, -h), B)) / 2e-6
        change_b = (p.between(A, p.compose(B, h)) - p.between(A, p.compose(B, -h))) / 2e-6
        np.testing.assert_allclose(by_a[..., k], change_a, atol=1e-7)
        np.testing.assert_allclose(by_b[..., k], change_b, atol=1e-7)
