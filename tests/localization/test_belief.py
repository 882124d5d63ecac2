"""Modes, regions and areas of a posterior over poses."""

from functools import cache

import numpy as np
import pytest

from bayesmap.errors import BadInput
from bayesmap.localization.belief import PoseBelief


@cache
def belief(p_lost=0.0, count=2000):
    """Three quarters about (0, 0, pi), a quarter about (5, 2, 0)."""
    rng = np.random.default_rng(0)
    first = rng.normal(size=(count, 3)) * (0.1, 0.05, 0.02) + (0.0, 0.0, np.pi)
    second = rng.normal(size=(count, 3)) * 0.05 + (5.0, 2.0, 0.0)
    poses = np.concatenate([first, second])
    poses[:, 2] = (poses[:, 2] + np.pi) % (2 * np.pi) - np.pi
    return PoseBelief(poses, np.repeat([0.75 / count, 0.25 / count], count), p_lost, 1.0)


def test_modes_are_told_apart_and_averaged_round_the_circle():
    one, two = belief().modes
    assert (one.probability, two.probability) == pytest.approx((0.75, 0.25))
    np.testing.assert_allclose(two.mean, [5, 2, 0], atol=0.01)
    np.testing.assert_allclose(one.mean[:2], 0, atol=0.01)
    assert abs(one.mean[2]) == pytest.approx(np.pi, abs=0.01)
    np.testing.assert_allclose(np.sqrt(np.diag(one.covariance)), [0.1, 0.05, 0.02], rtol=0.05)


@pytest.mark.parametrize("level", [0.5, 0.8, 0.95])
def test_a_region_holds_its_share_and_no_more(level):
    found = belief()
    region = found.region(level)
    inside = region.contains(found.poses[:, :2])
    assert found.weights[inside].sum() == pytest.approx(level, abs=0.03)
    if level == 0.95:  # beside a region of that share about the first alone the second's is missing
        assert region.contains([[5.0, 2.0]])[0]
        assert region.area_m2 < np.pi * 0.1 * 0.05 * 10 + np.pi * 0.05**2 * 10


def test_the_probability_of_an_area_leaves_room_for_being_lost():
    assert belief().probability_in([-1, 1, -1, 1]) == pytest.approx(0.75, abs=0.01)
    assert belief(p_lost=0.2).probability_in([[4, 1], [6, 1], [6, 3], [4, 3]]) == pytest.approx(0.2, abs=0.01)
    triangle = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0]]
    assert belief().probability_in(np.array(triangle)) == pytest.approx(0.375, abs=0.02)
    with pytest.raises(BadInput, match="give corners"):
        belief().probability_in([1, 2, 3])


def test_levels_that_are_none():
    with pytest.raises(BadInput, match="inside"):
        belief().region(1.0)


def test_json_has_every_answer():
    answer = belief(0.1).as_json()
    assert len(answer["modes"]) == 2
    assert answer["p_lost"] == pytest.approx(0.1)
    assert answer["region_95_m2"] > 0
