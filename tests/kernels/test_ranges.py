"""Ray casting equals the tutorial's formula.

Distances jump where a beam grazes a corner, so a beam is judged only where the formula itself is sure: where it gives
the same with edges that are 1e-11 and 1e-7 cells longer than the cell's side. Beams that touch a corner exactly are
sure: rounding moves them by less than 1e-11.
"""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from oracle.formula import distances

from bayesmap.kernels.walk import cast

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
    found, _ = cast(walls, starts, angles, LONGEST)
    np.testing.assert_allclose(found[sure], expected[sure], atol=CELLS, rtol=0)
    return sure.sum()


@given(seeds, shapes, densities)
def test_from_anywhere_at_any_angle(seed, shape, density):
    rng = np.random.default_rng(seed)
    starts = rng.uniform(-3, np.array(shape) + 3, (40, 2))
    sure = assert_equal_to_the_formula(random_walls(seed, shape, density), starts, rng.uniform(-7, 7, 40))
    assert sure >= 39


@given(seeds, shapes, densities, halves, halves, slopes)
def test_through_corners_and_along_lines_at_rational_slopes(seed, shape, density, x, y, slope):
    walls = random_walls(seed, shape, density)
    assert assert_equal_to_the_formula(walls, np.array([[x, y]]), np.array([np.arctan2(*slope)])) == 1


@given(seeds, shapes, anywhere, halves, st.sampled_from([0.0, np.pi / 2, np.pi, -np.pi / 2]))
def test_along_the_axes_from_anywhere(seed, shape, x, y, angle):
    walls = random_walls(seed, shape, 0.4)
    assert_equal_to_the_formula(walls, np.array([[x, y], [y, x]]), np.array([angle, angle]))


@given(st.integers(-6, 6), st.integers(-6, 6), st.floats(1e-12, 1e-6), st.sampled_from([-1, 1]))
def test_beams_a_hair_off_an_axis(x, y, tilt, sign):
    """Around the angle where a direction starts to count as parallel to an edge."""
    angle = np.array([0, 1, 2, 3]) * np.pi / 2 + sign * tilt
    starts = np.tile([x + 0.5, y + 0.25], (4, 1))
    assert_equal_to_the_formula(random_walls(1, (7, 7), 0.3), starts, angle)


def test_long_beams_and_those_from_far_outside_keep_their_precision_and_look_no_further_than_their_hit():
    walls = random_walls(2, (8, 8), 0.3)
    rng = np.random.default_rng(6)
    aim, angles = rng.uniform(0, 8, (300, 2)), rng.uniform(-np.pi, np.pi, 300)
    starts = aim - 1e4 * np.column_stack([np.cos(angles), np.sin(angles)])
    expected = distances(walls, starts, angles, longest=3e4)
    sure = expected == distances(walls, starts, angles, longest=3e4, slack=1e-6)
    found, _ = cast(walls, starts, angles, 3e4)
    assert sure.sum() > 290
    np.testing.assert_allclose(found[sure], expected[sure], atol=1e-6, rtol=0)  # 1e4 cells away, 1e-12 of them round
    walls = np.zeros((2000, 2000), dtype=bool)
    walls[-1, :] = walls[:, -1] = True
    rng = np.random.default_rng(5)
    starts, angles = rng.uniform(0, 3, (200, 2)), rng.uniform(0.001, np.pi / 2 - 0.001, 200)
    found, _ = cast(walls, starts, angles, 1e4)
    to_x, to_y = (1999 - starts[:, 0]) / np.cos(angles), (1999 - starts[:, 1]) / np.sin(angles)
    np.testing.assert_allclose(found, np.minimum(to_x, to_y), atol=CELLS, rtol=0)
    walls = np.zeros((100, 1), dtype=bool)
    walls[10] = True
    _, visits = cast(walls, np.array([[0.5, 0.5]]), np.array([0.0]), 1000.0)
    assert visits[0] <= 11
