"""Localization: posteriors against enumeration, robots that are lost, fitted laws, and maps of other programs."""

from dataclasses import replace

import numpy as np
import pytest
from flat_options import infer
from oracle.worlds import OwnSensor
from rooms import LASER, enumerated, known, lattice_about, offset, scan_from, walls_of
from tiers import full_but

import bayesmap as bm
from bayesmap.localization.belief import PoseBelief
from bayesmap.localization.external_map import ASSUMED, external_map, fit_law, search_single_scans
from bayesmap.localization.filter import Prior, rescale_by_place_evidence, update_lost
from bayesmap.localization.localize import InitialPose, localize, predict_lost
from bayesmap.localization.search import likelihood_field
from bayesmap.space.planar import between, compose
from bayesmap.space.scans import side_by_side


def test_the_posterior_is_that_of_enumerated_poses():
    """Mean, spread and evidence of 24 runs against sums over a lattice of 50 000 poses.

    A run has 40 weighted poses, worth 10 or more: means of 24 runs are off by 0.07 standard deviations; 0.3 is chance
    less often than once in 10 000 runs. The twin looks at every second beam alone. Nothing known of the pose before,
    and with all beams counted, the same holds about the only mode; its twin counts beams by half, and is too wide.
    """
    walls, grid = walls_of(4.0, 3.0)
    truth, sigma = np.array([1.52, 1.23, 0.4]), np.array([0.1, 0.1, 0.1])
    scans = scan_from(walls, grid, truth)
    here = known(walls, grid, scans, beam_weight=0.05)
    found = [localize(here, scans, prior=InitialPose(truth, 0.1, 0.1), seed=seed).last for seed in range(24)]
    means = np.array([belief.weights @ belief.poses for belief in found])
    spreads = np.array([np.diag(belief.total_covariance) for belief in found])
    lattice = lattice_about(truth, 3 * sigma, 37)
    prior = -0.5 * (((lattice - truth) / sigma) ** 2).sum(axis=1)
    mean, sd = enumerated(here, lattice, scans.ranges_m[0], prior)
    np.testing.assert_array_less(np.abs(means.mean(axis=0) - mean) / sd, 0.3)
    np.testing.assert_allclose(np.sqrt(spreads.mean(axis=0)), sd, rtol=0.2)
    twin, _ = enumerated(here, lattice, scans.ranges_m[0], prior, thin=4)
    assert (np.abs(means.mean(axis=0) - twin) / sd).max() > 0.3
    here = replace(here, beam_weight=1.0)
    found = [localize(here, scans, seed=seed) for seed in range(16)]
    assert all(len([mode for mode in one.modes if mode.probability > 0.01]) == 1 for one in found)
    lattice = lattice_about(truth, (0.06, 0.06, 0.06), 41)
    mean, sd = enumerated(here, lattice, scans.ranges_m[0], weight=1.0)
    np.testing.assert_array_less(np.abs(np.mean([one.mean for one in found], axis=0) - mean) / sd, 0.3)
    np.testing.assert_allclose(np.sqrt(np.mean([np.diag(one.covariance) for one in found], axis=0)), sd, rtol=0.25)
    assert (enumerated(here, lattice, scans.ranges_m[0], weight=0.5)[1] > 1.2 * sd).all()


def test_the_odds_of_two_places_follow_half_the_log_likelihood():
    """Two places of a hall that is the same from both ends but for a post, and a scan whose beams all count as usual.

    Odds under the two beam weights are squares of each other where the places' spreads are alike; evidence of 300
    draws is right within 20 % in logs.
    """
    walls, grid = walls_of(5.0, 3.0, alcove=False)
    walls[36:38, 9:11] = True
    scans = scan_from(walls, grid, np.array([1.5, 1.2, 0.4]))
    here = known(walls, grid, scans)
    np.testing.assert_array_equal(*(localize(here, scans, seed=4).last.poses for _ in range(2)))
    both = []
    for beam_weight in (None, 5.4 / 36):
        found = [localize(replace(here, beam_weight=beam_weight), scans, seed=seed).modes for seed in range(8)]
        both.append(np.mean([np.log(first.probability / second.probability) for first, second, *_ in found]))
    assert both[1] > 0.5
    assert both[0] / both[1] == pytest.approx(0.5, rel=0.2)


def test_a_corridor_leaves_the_pose_along_it_open_and_a_hall_in_which_nothing_is_met_returns_the_prior():
    walls, grid = walls_of(16.0, 2.0, alcove=False)
    scans = scan_from(walls, grid, np.array([8.0, 1.0, 0.0]), max_range_m=4.0)
    found = localize(known(walls, grid, scans, beam_weight=0.3), scans, prior=InitialPose([8.0, 1.0, 0.0], 0.6, 0.2))
    along, across = np.sqrt(np.diag(found.covariance)[:2])
    assert along > 0.35
    assert across < 0.15
    grid = bm.Grid((80, 60), 0.1)
    walls = np.zeros(grid.shape, dtype=bool)
    scans = scan_from(walls, grid, np.array([4.0, 3.0, 0.0]), max_range_m=2.0)
    found = localize(known(walls, grid, scans), scans)
    sd = np.sqrt(np.diag(found.last.total_covariance)[:2])
    np.testing.assert_allclose(sd, np.array([8.0, 6.0]) / np.sqrt(12), rtol=0.1)
    assert found.probability_in([0, 4, 0, 6]) == pytest.approx(0.5 * (1 - found.p_lost), abs=0.06)


@pytest.fixture(scope="module")
def offices():
    made = [bm.worlds.building(seed, (20.0, 12.0), 0.1) for seed in (3, 8)]
    return made, [bm.worlds.patrol(building, 120, 3) for building in made]


ROUND = np.radians(np.arange(90) * 4.0)


def test_scans_of_another_building_are_lost_and_those_of_this_are_not(offices):
    (here, there), (route, other) = offices
    own = scan_from(here.walls, here.grid, route[10:120:12], angles=ROUND)
    strange = scan_from(there.walls, there.grid, other[10:120:12], angles=ROUND)
    map_here = known(here.walls, here.grid, own)
    right = localize(map_here, own, independent=True)
    wrong = localize(map_here, strange, independent=True)
    found = [offset(belief.mean, pose)[0] < 0.2 for belief, pose in zip(right.beliefs, route[10:120:12], strict=True)]
    lost = [belief.p_lost > 0.5 for belief in right.beliefs]
    # A single scan may look alike from two components; then it is a wrong one that does not fit.
    assert sum(found) >= 8
    assert not any(np.array(found) & np.array(lost))
    assert sum(belief.p_lost > 0.5 for belief in wrong.beliefs) >= 7


def test_being_lost_is_that_of_all_enumerated_paths_of_states():
    """On the map, lost where scans fit, lost elsewhere: 3 ** 6 paths. The twin without such places is far too sure."""
    rng = np.random.default_rng(3)
    ways_m, fits, anywhere = rng.uniform(0.0, 2.0, 6), np.append(-4.0, rng.normal(4.0, 1.0, 5)), rng.normal(size=6)
    states = np.indices((3,) * 6).reshape(6, -1).T
    joint = np.array([0.98, 0.002, 0.018])[states[:, 0]] * np.exp([fits, fits, anywhere])[states, range(6)].prod(axis=1)
    for k in range(1, 6):
        lost, found, unlike = np.array([1e-3, 0.05, 0.4]) * np.clip(ways_m[k] / 1.5, (0.02, 0.02, 0.0), 1.0)
        rows = [1 - lost, 0.1 * lost, 0.9 * lost], [0, 1 - unlike, unlike], [found, unlike / 9, 1 - found - unlike / 9]
        joint *= np.array(rows)[states[:, k - 1], states[:, k]]
    exact = joint[states[:, -1] > 0].sum() / joint.sum()
    for share in (1.0, 0.0):
        p_lost, p_alike = 0.02, 0.002
        for k in range(6):
            if k > 0:
                p_lost, p_alike, _ = predict_lost(p_lost, p_alike, ways_m[k])
            p_lost, p_alike = update_lost(Prior(p_lost=p_lost, p_alike=share * p_alike), fits[k], anywhere[k])
        assert p_lost == pytest.approx(exact, rel=1e-9) if share else p_lost < 0.1 * exact


def test_a_corridor_like_the_maps_does_not_make_a_lost_robot_sure():
    """It comes from a hall that is not on the map, and drives on through a corridor as wide as the one that is."""
    walls, grid = walls_of(16.0, 2.0, alcove=False)
    route = np.column_stack([4.0 + 0.1 * np.arange(20), np.full(20, 1.0), np.zeros(20)])
    scans = scan_from(walls, grid, route, SHARP_LASER, max_range_m=4.0)
    hall = scan_from(*walls_of(7.0, 5.0), [2.0, 2.5, 0.0], SHARP_LASER, max_range_m=4.0)
    scans = replace(scans, ranges_m=np.concatenate([hall.ranges_m, scans.ranges_m[1:]]))
    p_lost = [belief.p_lost for belief in localize(known(walls, grid, scans), scans).beliefs]
    assert (p_lost[0] > 0.9, min(p_lost) > 0.1) == (True, True)


def test_a_robot_that_looks_past_the_edge_of_the_map_is_found(offices):
    """Half a building is known. The twin takes the unknown for empty: any place where all meets walls looks better."""
    (here, _), (route, _) = offices
    observed = np.zeros(here.grid.shape, dtype=bool)
    observed[: round(10.0 / here.grid.resolution)] = True
    near = np.flatnonzero((route[:, 0] > 8.5) & (route[:, 0] < 9.7))
    scans = scan_from(here.walls, here.grid, route[near], angles=ROUND)
    states = np.where(observed, here.walls, 0.08).astype(np.float32)
    shown = {"occupancy": states.astype(float), "observed": observed}
    half = bm.KnownMap.of_draws(states.ravel()[None], here.grid, LASER, scans, hit_depth=0.0, **shown)
    blind = replace(half, p_stop_unknown=0.0, field=likelihood_field(here.walls & observed, here.grid, half.free))

    def found(known_map):
        beliefs = localize(known_map, scans, independent=True).beliefs
        return sum(offset(belief.mean, pose)[0] < 0.2 for belief, pose in zip(beliefs, route[near], strict=True))

    assert len(near) >= 10
    assert found(half) == len(near)
    assert found(blind) <= len(near) - 2


def test_a_robot_is_followed_by_its_odometry_and_found_again_when_it_was_carried_away(offices):
    (here, _), (route, _) = offices
    path = np.concatenate([route[:25], route[80:100]])
    scans = scan_from(here.walls, here.grid, path, angles=ROUND)
    raw = compose(np.array([30.0, -4.0, 1.0]), bm.simulate_odometry(path[:25], seed=1))
    # Carried: the odometry has not noticed.
    steps = bm.simulate_odometry(path[25:], seed=2)
    after = compose(raw[-1], between(np.broadcast_to(steps[:1], steps.shape), steps))
    followed = bm.Scans(np.concatenate([raw, after]), ROUND, scans.ranges_m, 10.0, stamps_s=np.arange(45.0))
    found = localize(known(here.walls, here.grid, scans), followed)
    errors = np.array([offset(b.mean, pose)[0] for b, pose in zip(found.beliefs, path, strict=True)])
    assert (errors[3:25] < 0.15).all()
    assert (errors[-5:] < 0.15).all()
    trajectory = found.trajectory()
    assert trajectory.covariances.shape == (45, 3, 3)
    np.testing.assert_array_equal(trajectory.stamps_s, np.arange(45.0))


def test_map_uncertainty_counts():
    """Two draws of a map, one moved by 20 cm, make the pose less sure than either alone."""
    room, _ = walls_of(4.0, 3.0)
    here, moved = (np.pad(room, ((left, 6 - left), (0, 0)), constant_values=True) for left in (2, 4))
    grid = bm.Grid(here.shape, 0.1)
    truth, middle = np.array([1.72, 1.23, 0.4]), np.array([1.82, 1.23, 0.4])
    scans = scan_from(here, grid, truth)

    def sd(*maps):
        draws = np.stack([m.ravel() for m in maps]).astype(np.float32)
        both = bm.KnownMap.of_draws(
            draws, grid, LASER, scans, occupancy=draws.mean(axis=0).reshape(grid.shape),
            observed=np.ones(grid.shape, bool), hit_depth=0.0, beam_weight=0.2,
        )  # fmt: skip
        near = InitialPose(middle, 0.3, 0.1)
        found = [localize(both, scans, prior=near, seed=s).last.total_covariance for s in range(6)]
        return np.sqrt(np.mean(found, axis=0)[0, 0])

    assert sd(here, moved) > 1.5 * max(sd(here), sd(moved))


def test_impossible_localizations_are_refused_and_no_probability_exceeds_one():
    walls, grid = walls_of(4.0, 3.0)
    scans = scan_from(walls, grid, np.array([1.5, 1.2, 0.4]))
    with pytest.raises(bm.BadInput, match="sigma_m and sigma_rad above 0"):
        InitialPose([0, 0, 0], 0.0)
    with pytest.raises(bm.BadInput, match="Gaussian, StudentT or a BeamMixture with such noise"):
        known(walls, grid, scans, sensor=OwnSensor(bm.Gaussian(0.1)))
    with pytest.raises(bm.BadInput, match="no free cell"):
        known(np.ones_like(walls), grid, scans)
    sensor = bm.BeamMixture(bm.Gaussian(0.02))
    run = infer(scans, grid, prior=bm.Independent(0.2), sensor=sensor, chains=1, warmup=2, draws=2)
    here, outside = known(walls, grid, scans), InitialPose((40.0, 1.0, 0.0), 0.5)
    for where, given, options, message in (
        (here, scans.select(slice(0, 0)), {}, "there is no scan"),
        (run, scans, {"device": "tpu:7"}, "device: 'tpu:7' is not on this machine"),
        ("x", scans, {}, "give a run, such as bm.load gives"),
        (run, "x", {}, "scans must be those that bm.read_log gives, got 'x'"),
        (run, str, {}, "scans must be those that bm.read_log gives"),
        (here, scans, {"prior": (0, 0, 0)}, r"prior must be such as bm.InitialPose\(\(x, y, yaw\)\)"),
        (here, scans, {"odometry": bm.Odometry}, r"odometry must be such as bm.Odometry\(\)"),
        (here, scans, {"prior": outside}, r"prior: \(40, 1\) \+- 0.5 m lies outside the map, which is from"),
    ):
        with pytest.raises(bm.BadInput, match=message):
            bm.localize(where, given, **options)
    # One that reaches into the map is none.
    assert len(localize(here, scans, prior=InitialPose((-1.0, 1.0, 0.0), 1.0))) == 1
    belief = PoseBelief(np.zeros((6, 3)), np.full(6, 1.0 / 6) * (1 + 4e-16), 0.0, 0.0)
    assert belief.weights.sum() > 1.0
    assert (belief.modes[0].probability, belief.probability_in([-1.0, 1.0, -1.0, 1.0])) == (1.0, 1.0)
    for area in ([1.0, -1.0, -1.0, 1.0], [-1.0, 1.0, 1.0, -1.0], [-1.0, np.nan, -1.0, 1.0]):
        with pytest.raises(bm.BadInput, match="give x_min below x_max and y_min below y_max"):
            belief.probability_in(area)


@pytest.mark.parametrize("seed", full_but(range(4), 1, 2))
def test_a_dense_prior_of_unknown_cells_does_not_hide_the_room(seed):
    """A fifth of a wide margin's cells are walls in each draw; a fifth of the readings see things not on the map."""
    inside, small = walls_of(5.0, 3.0)
    laser = replace(LASER, p_random=0.1, p_short=0.1)
    margin = 50
    walls = np.pad(inside, margin)
    grid = bm.Grid(walls.shape, small.resolution, (-margin * small.resolution,) * 2)
    observed = np.pad(np.ones(inside.shape, dtype=bool), margin)
    rng = np.random.default_rng(seed)
    draws = np.where(observed, walls, rng.random((4, *walls.shape)) < 0.2)
    truth = np.array([1.0 + rng.random(), 1.0 + rng.random(), 2 * np.pi * rng.random()])
    scans = scan_from(inside, small, truth, laser, np.arange(90) * np.pi / 45, seed=seed)
    here = bm.KnownMap.of_draws(
        draws.reshape(4, -1).astype(np.float32), grid, laser, scans, occupancy=draws.mean(axis=0), observed=observed,
        hit_depth=0.0,
    )  # fmt: skip
    found = localize(here, scans, seed=seed)
    assert offset(found.mean, truth)[0] < 0.1
    assert found.p_lost < 0.01


def test_scans_of_unlike_beams_are_located_as_equal_ones_are():
    """Every scan has a fan of its own, and one of them no beam at all: its pose is that of odometry."""
    walls, grid = walls_of(4.0, 3.0)
    truth = np.column_stack([np.linspace(1.2, 2.4, 6), np.full(6, 1.3), np.linspace(0.2, 0.8, 6)])
    fans = [-np.pi + 0.1 * i + np.arange(n) * 2 * np.pi / n for i, n in enumerate((36, 41, 33, 38, 0, 44))]
    beams = zip(truth, fans, strict=True)
    readings = [scan_from(walls, grid, pose, angles=own).ranges_m[0] if len(own) else own for pose, own in beams]
    stated = truth + np.array([0.05, -0.05, 0.02])
    scans = bm.Scans(stated, *side_by_side(fans, readings), 10.0, stamps_s=np.arange(6.0))
    here = known(walls, grid, scans)
    for i, belief in enumerate(localize(here, scans, prior=InitialPose(truth[0], 0.3, 0.2)).beliefs):
        metres, radians = offset(belief.modes[0].mean, truth[i])
        assert metres < (0.3 if i == 4 else 0.1)
        assert np.degrees(radians) < 5.0
    shifted = replace(scans, own_angles_rad=scans.own_angles_rad + 0.3)  # a wrong twin: other beams
    beliefs = localize(here, shifted, prior=InitialPose(truth[0], 0.3, 0.4)).beliefs
    off = [offset(belief.modes[0].mean, pose)[1] for belief, pose in zip(beliefs, truth, strict=True)]
    assert np.degrees(max(off)) > 10.0


SHARP_LASER = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01, p_short=0.001)


def drive(count=48):
    """A round in a room of 6 by 4 m."""
    turn = np.linspace(0.0, 4 * np.pi, count)
    at = np.array([3.0, 2.0]) + np.stack([1.6 * np.cos(turn), 0.9 * np.sin(turn)], axis=1)
    return np.column_stack([at, turn + np.pi / 2])


@pytest.fixture(scope="module")
def room():
    """A room, its scans with people in them at poses of odometry, the true poses, and a thick and shifted map of it."""
    walls, grid = walls_of(6.0, 4.0)
    truth = drive()
    scans = scan_from(walls, grid, truth, SHARP_LASER, np.arange(72) * np.pi / 36)
    rng = np.random.default_rng(0)
    readings = scans.ranges_m.copy()
    for row in readings:  # somebody stands on a sixth of the view
        at = rng.integers(72) + np.arange(12)
        row[at % 72] = np.minimum(row[at % 72], rng.uniform(0.4, 0.8))
    scans = bm.Scans(scans.poses, scans.angles_rad, readings, 10.0)
    occupancy = walls.astype(float)
    occupancy[-2:] = occupancy[:2] = 1.0
    occupancy[:, :25] = np.roll(occupancy[:, :25], 1, axis=0)
    occupancy[2:4, 30:34] = np.nan
    return occupancy, grid, scans.at(bm.simulate_odometry(truth, seed=1)), truth


def test_scans_of_unlike_beams_are_searched_by_their_own(room):
    """Angles tremble, and yaw makes up for it: the same readings fit as well; the twin's do not."""
    occupancy, grid, _, truth = room
    walls, few = occupancy > 0.5, truth[:6]
    scans = scan_from(walls, grid, few, SHARP_LASER, np.arange(72) * np.pi / 36)
    known = external_map(occupancy, grid, scans)
    tremble = np.linspace(-0.3, 0.3, 6)[:, None]
    own = replace(scans, own_angles_rad=scans.angles_by_scan() + tremble)
    turned = few - tremble * [0.0, 0.0, 1.0]
    usual, _ = search_single_scans(known, scans, 0)
    assert search_single_scans(known, own.at(turned), 0)[0].right == pytest.approx(usual.right, abs=1e-3)
    assert search_single_scans(known, own, 0)[0].right < usual.right - 0.1


def test_the_fitted_law_is_that_of_the_scans_which_are_located_from_anywhere(room):
    """A sixth of the beams meet somebody; walls are off by 10 cm and thick, so that noise is 2 to 15 cm."""
    occupancy, grid, moved, truth = room
    law = fit_law(occupancy, grid, moved)
    assert law.scans >= 20
    assert 0.08 < law.values["p_short"] + law.values["p_random"] < 0.5
    assert 0.02 < law.values["scale_m"] < 0.15
    assert 1.0 <= law.trust.place_readings <= law.trust.pose_readings <= 5.4
    assert 0.0 < law.reference_fit.missed < 0.5
    assert "independent readings (fitted on" in law.words()
    found = localize(external_map(occupancy, grid, moved, law), moved)
    off = np.array([offset(b.mean, pose)[0] for b, pose in zip(found.beliefs, truth, strict=True)])
    assert (off[10:] < 0.3).all()
    assert found.p_lost < 0.05


def test_few_scans_fit_no_law_and_maps_without_walls_or_free_cells_are_refused(room):
    occupancy, grid, moved, _ = room
    law = fit_law(occupancy, grid, moved.select(slice(0, 10)))
    assert (law.scans, law.values) == (0, ASSUMED)
    assert "too few scans" in law.words()
    with pytest.raises(bm.BadInput, match="no occupied cell that a beam could meet"):
        external_map(np.zeros(grid.shape), grid, moved)
    with pytest.raises(bm.BadInput, match="no free cell"):
        external_map(np.where(occupancy > 0.5, 1.0, np.nan), grid, moved)


def test_a_wrong_prior_is_given_up_when_the_scans_contradict_it():
    """A hall is alike from both ends but for a block: from the wrong end nine beams in ten fit, nothing looks lost.

    The twin neither searches while it is sure nor gives other places a chance, and stays where it was said to be.
    """
    walls, grid = walls_of(6.0, 4.0, alcove=False)
    walls[46:52, 8:13] = True
    truth = drive()
    scans = scan_from(walls, grid, truth, SHARP_LASER, np.arange(72) * np.pi / 36)
    turned = np.array([6.0, 4.0, np.pi]) + truth[0] * np.array([-1.0, -1.0, 1.0])
    known = external_map(walls.astype(float), grid, scans)

    def off(here):
        beliefs = localize(here, scans, prior=InitialPose(turned, 0.2, 0.1)).beliefs[-8:]
        return np.median([offset(b.mean, pose)[1] for b, pose in zip(beliefs, truth[-8:], strict=True)])

    assert off(known) < 0.2
    stubborn = replace(known.trust, p_carried=1e-12, search_path_m=np.inf, forgotten_nats=1.0)
    assert off(replace(known, trust=stubborn)) > 3.0


def test_places_share_by_powers_of_their_evidence():
    """Odds are the prior's, times a power of what the scan says; within a place poses keep their shares."""
    weights, group, mass = np.array([0.5, 0.3, 0.15, 0.05]), np.array([0, 0, 1, 1]), np.array([0.1, 0.9])
    for power in (1.0, 0.5, 0.0):
        shares = rescale_by_place_evidence(weights, group, mass, power)
        odds = (0.1 / 0.9) * ((0.8 / 0.2) / (0.1 / 0.9)) ** power
        assert shares[:2].sum() / shares[2:].sum() == pytest.approx(odds)
        np.testing.assert_allclose(shares[:2] / shares[:2].sum(), [0.625, 0.375])
