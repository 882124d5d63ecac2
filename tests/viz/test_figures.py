"""Figures of maps: a posterior at a glance, one map, maps side by side, and animations."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import matplotlib
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.text import Text
from PIL import Image
from tiers import full_but
from viz_case import CORNER, GRID, HIDDEN, observed, occupancy, scans

import bayesmap as bm
from bayesmap import viz
from bayesmap.viz import Candidate, comparison_figure, palette, panel_figure, posterior_figure, write_figure
from bayesmap.viz.animation import CAPTION_PX, MARGIN_PX
from bayesmap.viz.figure import lay_out

FREE, WALL = palette.probability_colors(2)


def full(grid=GRID, **changes):
    arguments = {"draw": occupancy() == 1.0, "truth": occupancy() == 1.0, "scans": scans(), "title": "Title"}
    return posterior_figure(grid, occupancy(), observed(), **{**arguments, **changes})


def names(figure):
    return [ax.get_label() for ax in figure.axes]


SHAPES = [(21, 21), (400, 300), (97, 61), (333, 100), (40, 250)]


@pytest.mark.parametrize("shape", full_but(SHAPES, (97, 61), (40, 250)))
def test_every_cell_is_the_same_whole_number_of_pixels(shape, tmp_path):
    walls = np.random.default_rng(0).random(shape) < 0.5
    grid = bm.Grid(shape=shape, resolution=0.1, origin=(3.3, -7.7))
    write_figure(posterior_figure(grid, walls.astype(float)), tmp_path / "figure.png")
    with Image.open(tmp_path / "figure.png") as image:
        rgb = np.asarray(image.convert("RGB")) / 255.0
    layout = lay_out(grid, 2, bars=2, titled=False)
    assert rgb.shape[:2] == layout.figure[::-1]
    assert layout.exact
    size = layout.panel[0] // shape[0]
    assert layout.panel == (size * shape[0], size * shape[1])
    left, bottom = layout.corners[0]
    panel = rgb[len(rgb) - bottom - layout.panel[1] : len(rgb) - bottom, left : left + layout.panel[0]]
    dark = panel[::-1].transpose(1, 0, 2).mean(axis=2) < 0.5  # [x, y] from the lower left
    inner = (slice(3, -3), slice(3, -3))  # the frame covers the border
    np.testing.assert_array_equal(dark[inner], walls.repeat(size, axis=0).repeat(size, axis=1)[inner])


ORIGINS = {(21, 21): (-0.5, -0.5), (400, 300): (-1234.5, 98765.25), (300, 60): (0, 0)}


@pytest.mark.parametrize("shape", full_but(ORIGINS, (400, 300)))
def test_nothing_is_cut_off_and_no_texts_overlap(shape):
    grid = bm.Grid(shape=shape, resolution=0.1, origin=ORIGINS[shape])
    seen = np.ones(shape, dtype=bool)
    seen[0] = False
    half = np.full(shape, 0.5)
    figure = posterior_figure(grid, half, seen, draw=half > 0, truth=half > 0, scans=scans(), title="Title")
    renderer = figure.canvas.get_renderer()
    figure.draw(renderer)
    axes = [axis for ax in figure.axes for axis in (ax.xaxis, ax.yaxis)]
    drawn = {id(tick.label1) for axis in axes for tick in axis._update_ticks()}
    # Matplotlib keeps tick labels beyond the limits, and does not draw them.
    hidden = {id(tick.label1) for axis in axes for tick in axis.get_major_ticks()} - drawn
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text() and id(text) not in hidden]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts]
    labels = [(words, box) for words, box in boxes if box.width]
    assert len(labels) > 20
    for words, box in labels:
        assert 0 <= box.x0 <= box.x1 <= figure.bbox.width, words
        assert 0 <= box.y0 <= box.y1 <= figure.bbox.height, words
    for k, (words, box) in enumerate(labels):
        for other_words, other in labels[k + 1 :]:
            assert not box.overlaps(other) or words == other_words, (words, other_words)


def test_panels_follow_what_is_given_and_the_legend_names_what_is_drawn():
    bars = ["probability of wall", "entropy [bits]"]
    assert names(full()) == ["mean", "entropy", "data", "draw", *bars]
    assert names(full(draw=None)) == ["mean", "entropy", "data", *bars]
    assert names(posterior_figure(GRID, occupancy())) == ["mean", "entropy", *bars]
    (legend,) = full().legends
    expected = ["free", "wall", "unobserved", "true walls", "beam", "reading", "no return", "sensor"]
    assert [text.get_text() for text in legend.get_texts()] == expected
    assert posterior_figure(GRID, occupancy()).legends == []
    (legend,) = posterior_figure(GRID, occupancy(), observed()).legends
    assert [text.get_text() for text in legend.get_texts()] == ["unobserved"]

    def outlined(figure):
        return {ax.get_label() for ax in figure.axes for c in ax.collections if c.get_label() == "true walls"}

    # True walls do not bury the posterior of a fine map.
    assert outlined(full()) == {"mean", "data", "draw"}
    grid = bm.Grid(shape=(300, 200))
    half = np.full(grid.shape, 0.5)
    assert outlined(posterior_figure(grid, half, truth=half > 0, scans=scans())) == {"data"}
    assert outlined(posterior_figure(grid, half, truth=half > 0)) == {"mean"}


def test_arrangement_follows_the_shape():
    def columns(shape, panels):
        return lay_out(bm.Grid(shape=shape), panels, bars=2, titled=False).columns

    assert (columns((21, 21), 3), columns((21, 21), 4)) == (3, 2)
    assert (columns((400, 100), 3), columns((100, 400), 4)) == (1, 4)
    layout = lay_out(bm.Grid(shape=(8000, 6000)), 4, bars=2, titled=True)  # a huge map stays a picture of sensible size
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
        with pytest.raises(bm.BadInput, match=r"\.png, \.pdf, \.svg"):
            write_figure(full(), tmp_path / name)
    with pytest.raises(bm.BadInput, match="does not exist; make it"):
        write_figure(full(), tmp_path / "no" / "map.png")
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted([one.name, two.name])


def test_figures_in_threads_leave_the_settings_alone_and_never_load_pyplot(tmp_path):
    before = dict(matplotlib.rcParams)

    def written(k):
        write_figure(posterior_figure(GRID, occupancy(), observed()), tmp_path / f"{k}.svg")
        return (tmp_path / f"{k}.svg").read_bytes()

    with ThreadPoolExecutor(2) as pool:
        one, two = pool.map(written, range(2))
    assert one == two
    assert dict(matplotlib.rcParams) == before
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
    with pytest.raises(bm.BadInput, match="width runs from"):
        full(width=numbers + 1.0)


def test_surfaces_lie_over_the_mean_where_cells_are_large_enough():
    def strokes(figure):
        mean = next(ax for ax in figure.axes if ax.get_label() == "mean")
        return [line for line in mean.collections if line.get_label() == "surface"]

    figure = full(surfaces=surfaces())
    (lines,) = strokes(figure)
    assert len(lines.get_segments()) == len(surfaces()[0])
    assert "surface" in [text.get_text() for text in figure.legends[0].get_texts()]
    fine = bm.Grid(shape=(500, 500), resolution=0.01, origin=GRID.origin)
    assert not strokes(posterior_figure(fine, np.zeros(fine.shape), surfaces=surfaces()))


SMALL = bm.Grid(shape=(8, 6))


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
def test_every_map_has_a_panel_in_the_same_colours_over_one_bar(count):
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
        shown = ax.images[0].get_array().filled(-1).T
        np.testing.assert_array_equal(shown[observed()], (occupancy() * i / 4)[observed()])
    (bar,) = (ax for ax in figure.axes if not ax.images and ax not in panels)
    assert bar.get_xlabel() == "probability of wall"
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["unobserved"]

    box = bar.get_tightbbox()
    assert box.y0 > 0
    if count != 3:  # a panel of three has a row to itself
        assert all(box.y1 < ax.get_window_extent().y0 for ax in panels)
        middle = np.mean([ax.get_window_extent().x0 + ax.get_window_extent().width / 2 for ax in panels])
        assert (box.x0 + box.x1) / 2 == pytest.approx(middle, abs=3)


def test_maps_that_cannot_be_compared_are_refused():
    assert not comparison_figure(GRID, [Candidate("a", occupancy()), Candidate("b", occupancy())]).legends
    with pytest.raises(bm.BadInput, match="two to four maps, got 1"):
        comparison_figure(GRID, [Candidate("a", occupancy())])
    with pytest.raises(bm.BadInput, match="transpose"):
        comparison_figure(GRID, [Candidate("a", occupancy()), Candidate("b", occupancy().T)])


def chain(n=5):
    draws = np.zeros((n, *GRID.shape), dtype=bool)
    draws[:, CORNER[0], CORNER[1]] = True
    draws[::2, 0, 0] = True
    return draws


def cell(frame, i, j):
    scale = (frame.shape[1] - 2 * MARGIN_PX) // GRID.shape[0]
    top, left = MARGIN_PX + scale * (GRID.shape[1] - 1 - j), MARGIN_PX + scale * i
    return frame[top + scale // 4 : top + 3 * scale // 4, left + scale // 4 : left + 3 * scale // 4].mean(axis=(0, 1))


@pytest.mark.parametrize("ending", ["gif", "webp"])
def test_every_draw_is_a_frame_the_right_way_up(ending, tmp_path):
    path = tmp_path / f"chain.{ending}"
    viz.write_animation(path, GRID, chain(5), frames_per_second=20)
    with Image.open(path) as image:
        assert (image.n_frames, image.info["loop"]) == (5, 0)  # for ever
        for k in range(5):
            image.seek(k)
            frame, last = np.asarray(image.convert("RGB")) / 255.0, k == 4
            assert image.info["duration"] > 1000 if last else image.info["duration"] == 50  # milliseconds
            np.testing.assert_allclose(cell(frame, *CORNER), WALL, atol=0.01)
            np.testing.assert_allclose(cell(frame, 0, 0), WALL if k % 2 == 0 else FREE, atol=0.01)
            np.testing.assert_allclose(cell(frame, 0, 3), FREE, atol=0.01)
            np.testing.assert_allclose(cell(frame, 5, 0), FREE, atol=0.01)


def frames_of(draws, **options):
    """Return the frames of an animation that is not written, (n, rows, columns, 3)."""
    return np.array([np.asarray(frame.convert("RGB")) / 255.0 for frame in viz.render_frames(GRID, draws, **options)])


def test_cells_are_squares_of_whole_pixels_with_a_counter_and_means_can_be_shown():
    frame = next(viz.render_frames(GRID, chain()))
    scale, rest = divmod(frame.size[0] - 2 * MARGIN_PX, GRID.shape[0])
    assert rest == 0
    assert frame.size[1] == scale * GRID.shape[1] + 2 * MARGIN_PX + CAPTION_PX
    assert frame.mode == "P"
    means = frames_of(chain(2), running_mean=True)
    np.testing.assert_allclose(cell(means[0], 0, 0), WALL, atol=0.01)
    np.testing.assert_allclose(cell(means[1], 0, 0), palette.probability_colors(3)[1], atol=0.02)
    # Equal draws are separate frames, whose counters differ.
    frames = frames_of(np.zeros((7, *GRID.shape)), sweeps=range(100, 800, 100))
    assert len(frames) == 7
    map_rows = frames.shape[1] - CAPTION_PX
    assert (frames[:, :map_rows] == frames[0, :map_rows]).all()
    assert all((a[map_rows:] != b[map_rows:]).any() for a, b in pairwise(frames))


def test_unobserved_cells_true_walls_and_the_sensor_are_marked():
    center = (GRID.origin[0] + 2.5 * GRID.resolution, GRID.origin[1] + 1.5 * GRID.resolution)
    frame = frames_of(chain(1), observed=observed(), truth=occupancy() == 1.0, poses=[*center, 0.0])[0]
    hidden = cell(frame, *HIDDEN)
    assert np.abs(hidden - FREE).max() > 0.08
    assert hidden[0] > hidden[2] + 0.05
    np.testing.assert_allclose(cell(frame, *CORNER), WALL, atol=0.01)
    scale = (frame.shape[1] - 2 * MARGIN_PX) // GRID.shape[0]
    outline = np.argwhere(np.abs(frame - to_rgb(palette.TRUTH)).max(axis=2) < 0.02)
    assert outline[:, 0].max() < MARGIN_PX + scale + 10
    assert outline[:, 1].min() >= MARGIN_PX + 5 * scale - 10
    sensor = np.argwhere(np.abs(frame - to_rgb(palette.SENSOR)).max(axis=2) < 0.02).mean(axis=0)
    np.testing.assert_allclose(sensor, (MARGIN_PX + 2.5 * scale, MARGIN_PX + 2.5 * scale), atol=1.0)


@pytest.mark.parametrize(("name", "draws", "options", "message"), [
    ("a.gif", np.zeros((0, 6, 4)), {}, "chain is empty"), ("a.gif", np.zeros((6, 4)), {}, r"shape \(6, 4\).*one chain"),
    ("a.gif", np.zeros((3, 4, 6)), {}, r"shape \(3, 4, 6\)"), ("a.gif", np.full((3, 6, 4), np.nan), {}, "draw 0"),
    ("a.gif", np.full((3, 6, 4), 2), {}, r"draw 0 has numbers outside \[0, 1\]"),
    ("a.gif", np.full((3, 6, 4), "x"), {}, "array of numbers"), ("a.mp4", chain(), {}, r"\.gif, \.webp"),
    ("a.gif", chain(), {"frames_per_second": 0.0}, "frames_per_second"),
    ("a.gif", chain(), {"sweeps": [1, 2]}, "2 sweep numbers for 5 draws"),
    ("a.gif", chain(), {"truth": np.zeros((2, 2))}, "truth has shape"),
])  # fmt: skip
def test_animations_that_cannot_be_written_leave_no_file(name, draws, options, message, tmp_path):
    with pytest.raises(bm.BadInput, match=message):
        viz.write_animation(tmp_path / name, GRID, draws, **options)
    assert list(tmp_path.iterdir()) == []


def test_an_error_in_the_middle_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "a.gif"
    path.write_bytes(b"old")
    first = next(viz.render_frames(GRID, chain()))

    def frames(*_, **__):
        yield first
        raise MemoryError

    monkeypatch.setattr("bayesmap.viz.animation.render_frames", frames)
    with pytest.raises(MemoryError):
        viz.write_animation(path, GRID, chain())
    assert (path.read_bytes(), [p.name for p in tmp_path.iterdir()]) == (b"old", ["a.gif"])
