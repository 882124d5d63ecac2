import numpy as np
import pytest
from viz_case import GRID, observed, occupancy

from bayesmap.errors import BadInput
from bayesmap.viz import Candidate, comparison_figure


@pytest.mark.parametrize("count", [2, 3, 4])
def test_every_map_has_a_panel_in_the_same_colours(count):
    candidates = [
        Candidate(f"map {i}", occupancy() * i / 4, observed(), "1.3 nats a beam" * (i == 1)) for i in range(count)
    ]
    figure = comparison_figure(GRID, candidates, title="Two maps of a corridor")
    figure.canvas.draw()
    panels = [ax for ax in figure.axes if ax.images]
    assert [ax.get_title() for ax in panels][:2] == ["map 0", "map 1: 1.3 nats a beam"]
    assert len(panels) == count
    for i, ax in enumerate(panels):
        assert ax.images[0].get_clim() == (0.0, 1.0)
        np.testing.assert_array_equal(
            ax.images[0].get_array().filled(-1).T[observed()], (occupancy() * i / 4)[observed()]
        )
    (bar,) = (ax for ax in figure.axes if not ax.images and ax not in panels)
    assert bar.get_xlabel() == "probability of wall"
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["unobserved"]


def test_the_bar_lies_below_all_panels_and_inside_the_figure():
    figure = comparison_figure(GRID, [Candidate("a", occupancy()), Candidate("b", occupancy())])
    figure.canvas.draw()
    *panels, bar = figure.axes
    box = bar.get_tightbbox()
    assert box.y0 > 0
    assert all(box.y1 < ax.get_window_extent().y0 for ax in panels)
    middle = np.mean([ax.get_window_extent().x0 + ax.get_window_extent().width / 2 for ax in panels])
    assert (box.x0 + box.x1) / 2 == pytest.approx(middle, abs=3)
    assert not figure.legends


def test_one_map_is_no_comparison_and_shapes_are_checked():
    with pytest.raises(BadInput, match="two to four maps, got 1"):
        comparison_figure(GRID, [Candidate("a", occupancy())])
    with pytest.raises(BadInput, match="transpose"):
        comparison_figure(GRID, [Candidate("a", occupancy()), Candidate("b", occupancy().T)])
