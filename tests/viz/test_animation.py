from itertools import pairwise

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from PIL import Image
from viz_case import CORNER, GRID, HIDDEN, observed, occupancy

from bayesmap.errors import BadInput
from bayesmap.viz import palette, render_frames, write_animation
from bayesmap.viz.animation import CAPTION_PX, MARGIN_PX

FREE, WALL = palette.probability_colors(2)


def chain(n=5):
    draws = np.zeros((n, *GRID.shape), dtype=bool)
    draws[:, CORNER[0], CORNER[1]] = True
    draws[::2, 0, 0] = True
    return draws


def film(path):
    """RGB of every frame, (n, rows, columns, 3), and the duration of each in milliseconds."""
    frames, durations = [], []
    with Image.open(path) as image:
        for k in range(image.n_frames):
            image.seek(k)
            frames.append(np.asarray(image.convert("RGB")) / 255.0)
            durations.append(image.info["duration"])
        loop = image.info["loop"]
    return np.array(frames), durations, loop


def cell(frame, i, j):
    scale = (frame.shape[1] - 2 * MARGIN_PX) // GRID.shape[0]
    top, left = MARGIN_PX + scale * (GRID.shape[1] - 1 - j), MARGIN_PX + scale * i
    return frame[top + scale // 4 : top + 3 * scale // 4, left + scale // 4 : left + 3 * scale // 4].mean(axis=(0, 1))


@pytest.mark.parametrize("ending", ["gif", "webp"])
def test_every_draw_is_a_frame_the_right_way_up(ending, tmp_path):
    path = tmp_path / f"chain.{ending}"
    write_animation(path, GRID, chain(5), frames_per_second=20)
    frames, durations, loop = film(path)
    assert len(frames) == 5
    assert durations[:-1] == [50] * 4
    assert durations[-1] > 1000
    assert loop == 0  # for ever
    for k, frame in enumerate(frames):
        np.testing.assert_allclose(cell(frame, *CORNER), WALL, atol=0.01)
        np.testing.assert_allclose(cell(frame, 0, 0), WALL if k % 2 == 0 else FREE, atol=0.01)
        np.testing.assert_allclose(cell(frame, 0, 3), FREE, atol=0.01)
        np.testing.assert_allclose(cell(frame, 5, 0), FREE, atol=0.01)


def frames_of(draws, **options):
    """The frames of an animation that is not written, (n, rows, columns, 3)."""
    return np.array([np.asarray(frame.convert("RGB")) / 255.0 for frame in render_frames(GRID, draws, **options)])


def test_cells_are_squares_of_whole_pixels():
    frame = next(render_frames(GRID, chain()))
    scale, rest = divmod(frame.size[0] - 2 * MARGIN_PX, GRID.shape[0])
    assert rest == 0
    assert frame.size[1] == scale * GRID.shape[1] + 2 * MARGIN_PX + CAPTION_PX
    assert frame.mode == "P"


def test_running_mean():
    frames = frames_of(chain(2), running_mean=True)
    np.testing.assert_allclose(cell(frames[0], 0, 0), WALL, atol=0.01)
    np.testing.assert_allclose(cell(frames[1], 0, 0), palette.probability_colors(3)[1], atol=0.02)


def test_the_counter_changes_and_equal_draws_are_still_separate_frames():
    frames = frames_of(np.zeros((7, *GRID.shape)), sweeps=range(100, 800, 100))
    assert len(frames) == 7
    map_rows = frames.shape[1] - CAPTION_PX
    assert (frames[:, :map_rows] == frames[0, :map_rows]).all()
    assert all((a[map_rows:] != b[map_rows:]).any() for a, b in pairwise(frames))


def test_marks():
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


@pytest.mark.parametrize(
    ("name", "draws", "options", "message"),
    [
        ("a.gif", np.zeros((0, 6, 4)), {}, "chain is empty"),
        ("a.gif", np.zeros((6, 4)), {}, r"shape \(6, 4\).*one chain"),
        ("a.gif", np.zeros((3, 4, 6)), {}, r"shape \(3, 4, 6\)"),
        ("a.gif", np.full((3, 6, 4), 2), {}, r"draw 0 has numbers outside \[0, 1\]"),
        ("a.gif", np.full((3, 6, 4), np.nan), {}, "draw 0"),
        ("a.gif", np.full((3, 6, 4), "x"), {}, "array of numbers"),
        ("a.mp4", chain(), {}, r"\.gif, \.webp"),
        ("a.gif", chain(), {"frames_per_second": 0.0}, "frames_per_second"),
        ("a.gif", chain(), {"sweeps": [1, 2]}, "2 sweep numbers for 5 draws"),
        ("a.gif", chain(), {"truth": np.zeros((2, 2))}, "truth has shape"),
    ],
)
def test_what_cannot_be_written_leaves_no_file(name, draws, options, message, tmp_path):
    with pytest.raises(BadInput, match=message):
        write_animation(tmp_path / name, GRID, draws, **options)
    assert list(tmp_path.iterdir()) == []


def test_an_error_in_the_middle_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "a.gif"
    path.write_bytes(b"old")

    def frames(*_, **__):
        yield next(render_frames(GRID, chain()))
        raise MemoryError

    monkeypatch.setattr("bayesmap.viz.animation.render_frames", frames)
    with pytest.raises(MemoryError):
        write_animation(path, GRID, chain())
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.gif"]
