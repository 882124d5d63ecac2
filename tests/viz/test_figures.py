"""Figures of maps: a posterior at a glance, one map, maps side by side."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import matplotlib
import numpy as np
import pytest
from matplotlib.text import Text
from PIL import Image
from tiers import full_but
from viz_case import GRID, observed, occupancy, scans

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.viz import Candidate, comparison_figure, palette, panel_figure, posterior_figure, write_figure
from bayesmap.viz.figure import lay_out

FREE, WALL = palette.probability_colors(2)


def full(grid=GRID, **changes):
    arguments = {"draw": occupancy() == 1.0, "truth": occupancy() == 1.0, "scans": scans(), "title": "Title"}
    return posterior_figure(grid, occupancy(), observed(), **{**arguments, **changes})


def names(figure):
    return [ax.get_label() for ax in figure.axes]


def picture(figure, tmp_path):
    write_figure(figure, tmp_path / "figure.png")
    with Image.open(tmp_path / "figure.png") as image:
        return np.asarray(image.convert("RGB")) / 255.0


def test_panels_follow_what_is_given():
    bars = ["probability of wall", "entropy [bits]"]
    assert names(full()) == ["mean", "entropy", "data", "draw", *bars]
    assert names(full(draw=None)) == ["mean", "entropy", "data", *bars]
    assert names(posterior_figure(GRID, occupancy())) == ["mean", "entropy", *bars]


@pytest.mark.parametrize(
    "shape", full_but([(21, 21), (400, 300), (97, 61), (333, 100), (40, 250)], (97, 61), (40, 250))
)
def test_every_cell_is_the_same_whole_number_of_pixels(shape, tmp_path):
    walls = np.random.default_rng(0).random(shape) < 0.5
    figure = posterior_figure(Grid(shape=shape, resolution=0.1, origin=(3.3, -7.7)), walls.astype(float))
    rgb = picture(figure, tmp_path)
    layout = lay_out(Grid(shape=shape, resolution=0.1, origin=(3.3, -7.7)), 2, bars=2, titled=False)
    assert rgb.shape[:2] == layout.figure[::-1]
    assert layout.exact
    size = layout.panel[0] // shape[0]
    assert layout.panel == (size * shape[0], size * shape[1])
    left, bottom = layout.corners[0]
    panel = rgb[len(rgb) - bottom - layout.panel[1] : len(rgb) - bottom, left : left + layout.panel[0]]
    dark = panel[::-1].transpose(1, 0, 2).mean(axis=2) < 0.5  # [x, y] from the lower left
    expected = walls.repeat(size, axis=0).repeat(size, axis=1)
    inner = (slice(3, -3), slice(3, -3))  # the frame covers the border
    np.testing.assert_array_equal(dark[inner], expected[inner])


ORIGINS = {(21, 21): (-0.5, -0.5), (400, 300): (-1234.5, 98765.25), (300, 60): (0, 0)}


@pytest.mark.parametrize("shape", full_but(ORIGINS, (400, 300)))
def test_nothing_is_cut_off_and_no_texts_overlap(shape):
    grid = Grid(shape=shape, resolution=0.1, origin=ORIGINS[shape])
    seen = np.ones(shape, dtype=bool)
    seen[0] = False
    half = np.full(shape, 0.5)
    figure = posterior_figure(grid, half, seen, draw=half > 0, truth=half > 0, scans=scans(), title="Title")
    renderer = figure.canvas.get_renderer()
    figure.draw(renderer)
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text()]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts]
    labels = [(words, box) for words, box in boxes if box.width and not _out_of_view(words, box, figure)]
    for words, box in labels:
        assert 0 <= box.x0 <= box.x1 <= figure.bbox.width, words
        assert 0 <= box.y0 <= box.y1 <= figure.bbox.height, words
    for k, (words, box) in enumerate(labels):
        for other_words, other in labels[k + 1 :]:
            assert not box.overlaps(other) or words == other_words, (words, other_words)


def _out_of_view(words, box, figure):
    """Matplotlib keeps tick labels beyond the limits, and does not draw them."""
    for ax in figure.axes:
        for axis in (ax.xaxis, ax.yaxis):
            low, high = sorted(axis.get_view_interval())
            margin = 1e-9 * (high - low)
            for tick in axis.get_major_ticks():
                outside = not low - margin <= tick.get_loc() <= high + margin
                same = tick.label1.get_text() == words and tick.label1.get_window_extent().bounds == box.bounds
                if outside and same:
                    return True
    return False


def test_legend_names_what_is_drawn_and_nothing_else():
    (legend,) = full().legends
    expected = ["free", "wall", "unobserved", "true walls", "beam", "reading", "no return", "sensor"]
    assert [text.get_text() for text in legend.get_texts()] == expected
    assert posterior_figure(GRID, occupancy()).legends == []
    (legend,) = posterior_figure(GRID, occupancy(), observed()).legends
    assert [text.get_text() for text in legend.get_texts()] == ["unobserved"]


def test_truth_does_not_bury_the_posterior_of_a_fine_map():
    def outlined(figure):
        return {ax.get_label() for ax in figure.axes for c in ax.collections if c.get_label() == "true walls"}

    assert outlined(full()) == {"mean", "data", "draw"}
    grid = Grid(shape=(300, 200))
    half = np.full(grid.shape, 0.5)
    assert outlined(posterior_figure(grid, half, truth=half > 0, scans=scans())) == {"data"}
    assert outlined(posterior_figure(grid, half, truth=half > 0)) == {"mean"}


def test_arrangement_follows_the_shape():
    def columns(shape, panels):
        return lay_out(Grid(shape=shape), panels, bars=2, titled=False).columns

    assert columns((21, 21), 3) == 3
    assert columns((21, 21), 4) == 2
    assert columns((400, 100), 3) == 1
    assert columns((100, 400), 4) == 4
    layout = lay_out(Grid(shape=(8000, 6000)), 4, bars=2, titled=True)  # a huge map stays a picture of sensible size
    assert not layout.exact
    assert max(layout.figure) < 4000


MAGIC = {"PNG": b"\x89PNG", "png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}


@pytest.mark.parametrize("ending", full_but(MAGIC, "PNG", "pdf"))
def test_formats_and_equal_bytes(ending, tmp_path):
    one, two = tmp_path / f"a.{ending}", tmp_path / f"b.{ending}"
    for path in (one, two):
        write_figure(posterior_figure(GRID, occupancy(), observed(), scans=scans()), path)
    assert one.read_bytes().startswith(MAGIC[ending])
    assert one.read_bytes() == two.read_bytes()
    for name in ("map.jpg", "map", "map.gif"):
        with pytest.raises(BadInput, match=r"\.png, \.pdf, \.svg"):
            write_figure(full(), tmp_path / name)
    with pytest.raises(BadInput, match="does not exist; make it"):
        write_figure(full(), tmp_path / "no" / "map.png")
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted([one.name, two.name])


def test_figures_in_threads_leave_the_settings_alone(tmp_path):
    before = dict(matplotlib.rcParams)

    def written(k):
        write_figure(posterior_figure(GRID, occupancy(), observed()), tmp_path / f"{k}.svg")
        return (tmp_path / f"{k}.svg").read_bytes()

    with ThreadPoolExecutor(2) as pool:
        one, two = pool.map(written, range(2))
    assert one == two
    assert dict(matplotlib.rcParams) == before


def test_pyplot_and_its_global_figures_are_never_loaded(tmp_path):
    program = (
        "import sys, numpy as np; from bayesmap import viz; from bayesmap.space.grid import Grid;"
        "viz.write_figure(viz.posterior_figure(Grid((3, 3)), np.eye(3)), sys.argv[1]);"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program, str(tmp_path / "a.png")], check=True)


def surfaces():
    x, y = (axis[: min(len(axis) for axis in GRID.centers_m())] for axis in GRID.centers_m())
    means = np.stack([x, y], axis=-1)
    return means, np.tile(np.diag([0.04, 0.001]) * GRID.resolution**2, (len(means), 1, 1)), np.ones(len(means))


def test_reflectivities_have_intervals_shades_and_a_name_of_their_own():
    numbers = 0.5 * occupancy()
    figure = full(draw=numbers, width=numbers, label="reflectivity")
    assert names(figure) == ["mean", "width", "data", "draw", "reflectivity", "width of the 90 % interval"]
    np.testing.assert_allclose(np.ma.getdata(figure.axes[3].images[0].get_array()).T, numbers)
    assert figure.axes[4].get_xlabel() == "reflectivity"
    (legend,) = figure.legends
    assert not {"wall", "free"} & {text.get_text() for text in legend.get_texts()}
    with pytest.raises(BadInput, match="width runs from"):
        full(width=numbers + 1.0)


def test_surfaces_lie_over_the_mean_where_cells_are_large_enough():
    def strokes(figure):
        mean = next(ax for ax in figure.axes if ax.get_label() == "mean")
        return [line for line in mean.collections if line.get_label() == "surface"]

    figure = full(surfaces=surfaces())
    (lines,) = strokes(figure)
    assert len(lines.get_segments()) == len(surfaces()[0])
    assert "surface" in [text.get_text() for text in figure.legends[0].get_texts()]
    fine = Grid(shape=(500, 500), resolution=0.01, origin=GRID.origin)
    nothing = np.zeros(fine.shape)
    assert not strokes(posterior_figure(fine, nothing, surfaces=surfaces()))


SMALL = Grid(shape=(8, 6))


def test_a_panel_says_what_it_shows():
    draw = {"label": "mean reflectivity"}  # of one draw it is no mean
    for what, options, label in (
        ("mean", {}, "probability of wall"), ("entropy", {}, "entropy [bits]"), ("deviation", {}, "standard deviation"),
        ("width", {}, "width of the 90 % interval"), ("draw", draw, "reflectivity"),
    ):  # fmt: skip
        figure = panel_figure(SMALL, what, np.full(SMALL.shape, 0.3), truth=np.eye(8, 6) > 0, **options)
        assert [axes.get_ylabel() for axes in figure.axes[1:]] == [label]
        assert "true walls" in [lines.get_label() for lines in figure.axes[0].collections]
    chances = np.zeros(SMALL.shape)
    chances[3, 3] = 0.5
    shown = panel_figure(SMALL, "deviation", chances).axes[0].images[0].get_array()
    assert (float(np.min(shown)), float(np.max(shown))) == pytest.approx((0.0, 0.5))


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


def test_the_bar_lies_below_all_panels_and_inside_the_figure_and_what_does_not_fit_is_refused():
    figure = comparison_figure(GRID, [Candidate("a", occupancy()), Candidate("b", occupancy())])
    figure.canvas.draw()
    *panels, bar = figure.axes
    box = bar.get_tightbbox()
    assert box.y0 > 0
    assert all(box.y1 < ax.get_window_extent().y0 for ax in panels)
    middle = np.mean([ax.get_window_extent().x0 + ax.get_window_extent().width / 2 for ax in panels])
    assert (box.x0 + box.x1) / 2 == pytest.approx(middle, abs=3)
    assert not figure.legends
    with pytest.raises(BadInput, match="two to four maps, got 1"):
        comparison_figure(GRID, [Candidate("a", occupancy())])
    with pytest.raises(BadInput, match="transpose"):
        comparison_figure(GRID, [Candidate("a", occupancy()), Candidate("b", occupancy().T)])
