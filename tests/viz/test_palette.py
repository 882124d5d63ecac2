import numpy as np
from matplotlib.colors import to_rgb

from bayesmap.viz import palette


def to_lab(rgb):
    """SRGB to CIELAB, the inverse of what the palette computes, written apart from it."""
    rgb = np.asarray(rgb)
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    matrix = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
    xyz = linear @ np.array(matrix).T / [0.95047, 1.0, 1.08883]
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1)


def test_equal_steps_of_probability_are_equal_steps_of_colour():
    lab = to_lab(palette.probability_colors(64))
    steps = np.linalg.norm(np.diff(lab, axis=0), axis=1)
    assert steps.max() / steps.min() < 1.02
    assert (np.diff(lab[:, 0]) < 0).all()
    assert lab[0, 0] > 95
    assert lab[-1, 0] < 20


def test_unobserved_is_far_from_every_colour_of_both_maps():
    unobserved = to_lab(np.array([to_rgb(palette.UNOBSERVED)]))[0]
    steps = np.linspace(0, 1, 256)
    for colors in (palette.probability_colormap(), palette.uncertainty_colormap()):
        apart = np.linalg.norm(to_lab(colors(steps)[:, :3]) - unobserved, axis=1)
        assert apart.min() > 7  # 2 to 3 is just noticeable


def test_masked_cells_take_the_unobserved_colour():
    masked = np.ma.array([0.5], mask=[True])
    for colors in (palette.probability_colormap(), palette.uncertainty_colormap()):
        np.testing.assert_allclose(colors(masked)[0, :3], to_rgb(palette.UNOBSERVED))
