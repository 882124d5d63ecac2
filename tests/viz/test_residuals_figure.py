import numpy as np
import pytest
from viz_case import GRID, observed, occupancy, panel

from bayesmap.errors import BadInput
from bayesmap.viz import draw_residuals, palette, residual_scale, residuals_figure, surprise_scale
from bayesmap.viz.scores import MAX_POINTS


def test_shorter_is_blue_longer_is_orange_and_as_predicted_is_grey():
    ax = panel()
    dots = draw_residuals(ax, [[0, 3], [0.5, 3], [1, 3]], [-1.0, 0.0, 1.0], residual_scale([], 0.5))
    ax.figure.canvas.draw()
    colors = {
        tuple(xy): color[:3] for xy, color in zip(dots.get_offsets().tolist(), dots.get_facecolors(), strict=True)
    }
    short, grey, long = colors[0, 3], colors[0.5, 3], colors[1, 3]
    assert short[2] > short[0] + 0.3
    assert long[0] > long[2] + 0.3
    assert np.ptp(grey) < 0.05


def test_the_worst_are_larger_and_on_top():
    dots = draw_residuals(panel(), np.zeros((4, 2)), [0.3, -0.5, 0.0, 0.1], residual_scale([], 0.5))
    np.testing.assert_allclose(dots.get_array(), [0.0, 0.1, 0.3, -0.5])
    assert (np.diff(dots.get_sizes()) > 0).all()


def test_of_very_many_beams_the_worst_are_all_there():
    rng = np.random.default_rng(0)
    values = rng.normal(0.0, 0.01, 3 * MAX_POINTS)
    values[:100] = 2.0
    dots = draw_residuals(panel(), np.zeros((len(values), 2)), values, residual_scale(values))
    shown = dots.get_array()
    assert len(shown) <= MAX_POINTS
    assert (shown == 2.0).sum() == 100


def test_scales():
    rng = np.random.default_rng(1)
    scale = residual_scale(rng.normal(0.0, 0.2, 10_000))  # 90 % lie within 0.33
    assert (scale.low, scale.high) == (-0.5, 0.5)
    assert residual_scale(np.zeros(5)).high == 0.05
    assert residual_scale([]).high == 0.05
    surprise = surprise_scale(np.linspace(-1.0, 1.0, 101))
    assert (surprise.low, surprise.high) == pytest.approx((0.0, 0.98))
    with pytest.raises(BadInput, match="limit of the residuals"):
        residual_scale([1.0], -1.0)


def test_colours_stay_apart_without_red_and_green():
    """As a deuteranope sees them (Vienot 1999): the ends differ from each other and from the middle."""
    seen = np.array([[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]])
    short, grey, long = (np.array(palette.residual_colormap()(v)[:3]) ** 2.2 @ seen.T for v in (0.0, 0.5, 1.0))
    for a, b in ((short, grey), (grey, long), (short, long)):
        assert np.abs(a - b).max() > 0.15


def test_the_figure_lays_the_beams_over_the_faded_map():
    figure = residuals_figure(GRID, occupancy(), [[0.0, 3.0]], [0.1], observed())
    ax, bar = figure.axes
    assert ax.images[0].get_alpha() < 0.5
    assert len(ax.collections) == 1
    assert bar.get_ylabel() == "reading minus predicted median [m]"
    surprise = surprise_scale([0.5, 3.0])
    figure = residuals_figure(GRID, occupancy(), [[0.0, 3.0]] * 2, [0.5, 3.0], scale=surprise)
    assert figure.axes[1].get_ylabel() == "surprise: minus log score [nats]"


@pytest.mark.parametrize(
    ("ends", "values", "says"),
    [
        (np.zeros((2, 2)), [0.0], r"shape \(2, 2\) and values \(1,\)"),
        (np.zeros((1, 3)), [0.0], r"give \(n, 2\) and \(n,\)"),
        ([[0.0, np.nan]], [0.0], "not finite"),
        ([[0.0, 0.0]], [np.inf], "not finite"),
    ],
)
def test_what_does_not_fit_is_named(ends, values, says):
    with pytest.raises(BadInput, match=says):
        draw_residuals(panel(), ends, values, residual_scale([], 1.0))
