"""Maps of other programs: a law is fitted to the scans that are located, doubts are kept, errors survived."""

from dataclasses import replace

import numpy as np
import pytest
from rooms import offset, scan_from, walls_of

import bayesmap as bm
from bayesmap.localization.external_map import ASSUMED, external_map, fit_law, searched
from bayesmap.localization.filter import rescale_by_place_evidence
from bayesmap.localization.localize import InitialPose, localize

LASER = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01, p_short=0.001)


def drive(count=48):
    """A round in a room of 6 by 4 m."""
    turn = np.linspace(0.0, 4 * np.pi, count)
    middle = np.array([3.0, 2.0])
    at = middle + np.stack([1.6 * np.cos(turn), 0.9 * np.sin(turn)], axis=1)
    return np.column_stack([at, turn + np.pi / 2])


@pytest.fixture(scope="module")
def room():
    """A room, its scans with people in them at poses of odometry, the true poses, and a thick and shifted map of it."""
    walls, grid = walls_of(6.0, 4.0)
    truth = drive()
    scans = scan_from(walls, grid, truth, LASER, np.arange(72) * np.pi / 36)
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


@pytest.fixture(scope="module")
def law(room):
    occupancy, grid, moved, _ = room
    return fit_law(occupancy, grid, moved)


def test_scans_of_unlike_beams_are_searched_by_their_own(room):
    """Angles tremble, and yaw makes up for it: the same readings fit as well; the twin's do not."""
    occupancy, grid, _, truth = room
    walls, few = occupancy > 0.5, truth[:6]
    scans = scan_from(walls, grid, few, LASER, np.arange(72) * np.pi / 36)
    known = external_map(occupancy, grid, scans)
    tremble = np.linspace(-0.3, 0.3, 6)[:, None]
    own = replace(scans, own_angles_rad=scans.angles_by_scan() + tremble)
    turned = few - tremble * [0.0, 0.0, 1.0]
    usual, _ = searched(known, scans, few, 0)
    assert searched(known, own, turned, 0)[0].right == pytest.approx(usual.right, abs=1e-3)
    assert searched(known, own, few, 0)[0].right < usual.right - 0.1


def test_the_fitted_law_is_that_of_the_scans_which_are_located_from_anywhere(room, law):
    """A sixth of the beams meet somebody; walls are off by 10 cm and thick, so that noise is 2 to 15 cm."""
    assert law.scans >= 20
    assert 0.08 < law.values["p_short"] + law.values["p_random"] < 0.5
    assert 0.02 < law.values["scale_m"] < 0.15
    assert 1.0 <= law.trust.place_readings <= law.trust.pose_readings <= 5.4
    assert 0.0 < law.usual_fit.missed < 0.5
    assert "independent readings (fitted on" in law.words()
    occupancy, grid, moved, truth = room
    found = localize(external_map(occupancy, grid, moved, law), moved)
    off = np.array([offset(b.mean, pose)[0] for b, pose in zip(found.beliefs, truth, strict=True)])
    assert (off[10:] < 0.3).all()
    assert found.p_lost < 0.05


def test_few_scans_fit_no_law_and_maps_without_walls_or_free_cells_are_refused(room):
    occupancy, grid, moved, _ = room
    law = fit_law(occupancy, grid, moved.select(slice(0, 10)))
    assert (law.scans, law.values) == (0, ASSUMED)
    assert "too few scans" in law.words()
    occupancy, grid, moved, _ = room
    with pytest.raises(bm.BadInput, match="no occupied cell that a beam could meet"):
        external_map(np.zeros(grid.shape), grid, moved)
    with pytest.raises(bm.BadInput, match="no free cell"):
        external_map(np.where(occupancy > 0.5, 1.0, np.nan), grid, moved)


def test_a_wrong_prior_is_given_up_when_the_scans_contradict_it():
    """A hall that is the same from both ends but for a block, and a robot that is said to come from the wrong end.

    From there all but a tenth of the beams fit, so that it does not look lost. The twin neither searches while it is
    sure nor gives other places a chance, and stays where it was said to be.
    """
    walls, grid = walls_of(6.0, 4.0, alcove=False)
    walls[46:52, 8:13] = True
    truth = drive()
    scans = scan_from(walls, grid, truth, LASER, np.arange(72) * np.pi / 36)
    turned = np.array([6.0, 4.0, np.pi]) + truth[0] * np.array([-1.0, -1.0, 1.0])
    known = external_map(walls.astype(float), grid, scans)

    def off(here):
        beliefs = localize(here, scans, prior=InitialPose(turned, 0.2, 0.1)).beliefs[-8:]
        return np.median([offset(b.mean, pose)[1] for b, pose in zip(beliefs, truth[-8:], strict=True)])

    assert off(known) < 0.2
    stubborn = replace(known.trust, carried=1e-12, search_way_m=np.inf, forgotten_nats=1.0)
    assert off(replace(known, trust=stubborn)) > 3.0


def test_places_share_by_powers_of_their_evidence():
    """Half of the evidence: odds are the prior's, times the root of what the scan says; nothing new: the prior's."""
    weights, group = np.array([0.5, 0.3, 0.15, 0.05]), np.array([0, 0, 1, 1])
    mass = np.array([0.1, 0.9])
    whole = rescale_by_place_evidence(weights, group, mass, 1.0)
    np.testing.assert_allclose(whole, weights)
    half = rescale_by_place_evidence(weights, group, mass, 0.5)
    odds = half[:2].sum() / half[2:].sum()
    assert odds == pytest.approx((0.1 / 0.9) * np.sqrt((0.8 / 0.2) / (0.1 / 0.9)))
    np.testing.assert_allclose(half[:2] / half[:2].sum(), [0.625, 0.375])
    none = rescale_by_place_evidence(weights, group, mass, 0.0)
    np.testing.assert_allclose([none[:2].sum(), none[2:].sum()], mass)
