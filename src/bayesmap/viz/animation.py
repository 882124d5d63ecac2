"""Write a chain as an animation: one frame per draw, GIF or WebP, by Pillow.

`write_animation` writes the frames of `render_frames`, and `_Canvas` renders one. Frames are images of palette indices,
enlarged by a whole number. A hundred frames take a fraction of a second; matplotlib's writer takes several seconds.
"""

import io
import math
import os
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import ArrayLike, NDArray
from PIL import Image, ImageDraw, ImageFont
from scipy import ndimage

from bayesmap.errors import BadInput
from bayesmap.files import PICTURE_MARK, check_ending, write_file
from bayesmap.space.arrays import Mask
from bayesmap.space.grid import ROUNDING, Grid, as_mask, as_observed
from bayesmap.space.scans import as_poses
from bayesmap.viz import palette

LEVELS = 128  # levels of probability in a frame; finer levels look alike, and fewer colours give smaller files
# Palette indices of other colours, after the levels of probability.
BACKGROUND, UNOBSERVED, HATCH, TRUTH, SENSOR, FRAME = range(LEVELS, LEVELS + 6)
MIN_SIDE_PX = 560  # smallest length of the longer side; cells are enlarged by a whole number to reach it
MARGIN_PX = 10  # margin around the map
CAPTION_PX = 30  # height of the caption
HATCH_PITCH_PX = 7  # distance of the hatch's lines
MIN_LAST_FRAME_MS = 1500  # time of the last frame: the result stays visible before the animation starts again


def write_animation(
    path: str | os.PathLike[str], grid: Grid, draws: ArrayLike, *, running_mean: bool = False,
    observed: ArrayLike | None = None, truth: ArrayLike | None = None, poses: ArrayLike | None = None,
    sweeps: Sequence[int] | None = None, frames_per_second: float = 10.0,
) -> None:  # fmt: skip
    """Write the draws of one chain, (n, nx, ny), as an animation without end, .gif or .webp, whole or not at all.

    Draws are walls, or probabilities in [0, 1]; ``running_mean`` shows the mean of all draws so far in place of each.
    Cells that are not ``observed``, (nx, ny), are hatched; None: all are observed. ``truth``, (nx, ny), holds true
    walls, which are outlined. ``poses`` of the sensor, (S, 3) or (3,), become dots. ``sweeps`` are the numbers under
    the frames; None: 1 to n. The rate is at most 50 frames a second, since viewers slow down faster animations.
    Raises `BadInput` if the ending is another, the folder is missing, there is no draw, a shape differs from the
    grid's, a number is outside [0, 1], or the rate is out of bounds. Raises `OSError` if writing failed.
    """
    target, ending = check_ending(path, ("gif", "webp"), "animation")
    if not 0.0 < frames_per_second <= 50.0:
        raise BadInput(f"animation: frames_per_second must lie in (0, 50], got {frames_per_second!r}")
    frames = render_frames(
        grid, draws, running_mean=running_mean, observed=observed, truth=truth, poses=poses, sweeps=sweeps
    )
    # GIF stores hundredths of a second. Viewers round other durations in different ways.
    step_ms = 10 * max(2, round(100.0 / frames_per_second))
    durations = [step_ms] * (len(np.asarray(draws)) - 1) + [max(step_ms, MIN_LAST_FRAME_MS)]
    save_options: dict[str, Any] = {"format": ending, "save_all": True, "duration": durations, "loop": 0}
    if ending == "gif":
        save_options |= {"optimize": False, "disposal": 1, "comment": PICTURE_MARK.encode()}
    else:
        # Lossless keeps the edges of cells sharp. The least effort is three times faster, and files are hardly larger.
        save_options |= {"lossless": True, "method": 0, "quality": 0}
        frames = (frame.convert("RGB") for frame in frames)
    buffer = io.BytesIO()
    next(frames).save(buffer, append_images=frames, **save_options)
    write_file(target, buffer.getvalue())


def render_frames(
    grid: Grid, draws: ArrayLike, *, running_mean: bool = False, observed: ArrayLike | None = None,
    truth: ArrayLike | None = None, poses: ArrayLike | None = None, sweeps: Sequence[int] | None = None,
) -> Iterator[Image.Image]:  # fmt: skip
    """Return an iterator of the frames of `write_animation`, of mode "P". The arguments are checked at once."""
    chain = _as_chain(grid, draws)
    numbers = list(range(1, len(chain) + 1)) if sweeps is None else [int(sweep) for sweep in sweeps]
    if len(numbers) != len(chain):
        raise BadInput(f"animation: {len(numbers)} sweep numbers for {len(chain)} draws; give one for each")
    canvas = _Canvas(grid, as_observed(grid, observed), truth, poses)

    def frames() -> Iterator[Image.Image]:
        total = np.zeros(chain.shape[1:])
        for count, (draw, sweep) in enumerate(zip(chain, numbers, strict=True), start=1):
            if running_mean:
                total += draw
                yield canvas.frame(total / count, f"mean of {count} draws, to sweep {sweep}")
            else:
                yield canvas.frame(draw, f"sweep {sweep}")

    return frames()


class _Canvas:
    """The parts that all frames share: size, colours, and the marks over the map."""

    def __init__(self, grid: Grid, observed: Mask, truth: ArrayLike | None, poses: ArrayLike | None) -> None:
        self.scale = math.ceil(MIN_SIDE_PX / max(grid.shape))
        width, height = (n * self.scale for n in grid.shape)
        self.font = ImageFont.load_default(size=15)
        self.size = (width + 2 * MARGIN_PX, height + 2 * MARGIN_PX + CAPTION_PX)
        # The colours of all palette indices, three bytes each.
        unobserved = [palette.UNOBSERVED, palette.UNOBSERVED_HATCH]
        marks = ["#FFFFFF", *unobserved, palette.TRUTH, palette.SENSOR, palette.FRAME]
        colors = np.concatenate([palette.probability_colors(LEVELS), [to_rgb(mark) for mark in marks]])
        self.colors = np.rint(255.0 * colors).astype(np.uint8).tobytes()
        # The marks cover the map where they are not 0. No mark has the index 0, which is "surely free".
        self.marks = np.full((height + 2 * MARGIN_PX, width + 2 * MARGIN_PX), BACKGROUND, dtype=np.uint8)
        self.inside = (slice(MARGIN_PX, -MARGIN_PX), slice(MARGIN_PX, -MARGIN_PX))
        edge = slice(MARGIN_PX - 1, 1 - MARGIN_PX)
        self.marks[edge, edge] = FRAME
        self.marks[self.inside] = self._enlarge(np.where(observed, 0, UNOBSERVED).astype(np.uint8))
        # Hatch the unobserved cells, then add the true walls and the sensor.
        row, column = np.indices(self.marks.shape)
        self.marks[(self.marks == UNOBSERVED) & ((row + column) % HATCH_PITCH_PX == 0)] = HATCH
        if truth is not None:
            self._outline(as_mask(grid, truth, "truth"))
        if poses is not None:
            self._dots(grid, as_poses(poses))
        self.visible = self.marks == 0

    def frame(self, probability: NDArray[Any], text: str) -> Image.Image:
        """Return a frame: the map of probabilities, (nx, ny), the marks over it, and the caption below."""
        levels = self._enlarge(np.rint(np.clip(probability, 0.0, 1.0) * (LEVELS - 1)).astype(np.uint8))
        pixels = np.full((self.size[1], self.size[0]), BACKGROUND, dtype=np.uint8)
        area = pixels[: self.marks.shape[0]]
        area[...] = self.marks
        np.copyto(area[self.inside], levels, where=self.visible[self.inside])
        pixels[self.marks.shape[0] :] = self._caption(text)
        image = Image.fromarray(pixels)
        image.putpalette(self.colors)
        return image

    def _caption(self, text: str) -> NDArray[np.uint8]:
        """Return the caption's pixels, in smooth type with the shades of probability."""
        strip = Image.new("L", (self.size[0], CAPTION_PX), 0)
        anchor = (MARGIN_PX, CAPTION_PX // 2 - 4)
        ImageDraw.Draw(strip).text(anchor, text, fill=LEVELS - 1, font=self.font, anchor="lm")
        shades = np.asarray(strip)
        return np.where(shades > 0, shades, BACKGROUND).astype(np.uint8)

    def _enlarge(self, cells: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Convert cells [x, y] to pixels [row, column], with the first row on top."""
        return cells.T[::-1].repeat(self.scale, axis=0).repeat(self.scale, axis=1)

    def _outline(self, walls: Mask) -> None:
        """Mark a line around the walls, outside them, so that the walls stay visible."""
        solid = np.zeros(self.marks.shape, dtype=np.bool_)
        solid[self.inside] = self._enlarge(walls.astype(np.uint8)) == 1
        grown = ndimage.binary_dilation(solid, np.ones((3, 3)), iterations=max(1, self.scale // 12))
        self.marks[grown & ~solid] = TRUTH

    def _dots(self, grid: Grid, poses: NDArray[np.float64]) -> None:
        """Mark a dot with a light rim at each pose."""
        dot_px = float(np.clip(0.3 * self.scale, 2.0, 6.0))
        image = Image.fromarray(self.marks)
        pen = ImageDraw.Draw(image)
        for u, v in grid.to_cells(poses[:, :2]) * self.scale:
            x, y = MARGIN_PX + u, self.marks.shape[0] - MARGIN_PX - v
            for radius, color in ((dot_px + 1.5, BACKGROUND), (dot_px, SENSOR)):
                pen.ellipse((x - radius, y - radius, x + radius, y + radius), fill=color)
        self.marks = np.asarray(image)


def _as_chain(grid: Grid, draws: ArrayLike) -> NDArray[Any]:
    """Check the draws and return them in their own type: a long chain of a large map would not fit as floats."""
    chain = np.asarray(draws)
    if chain.dtype.kind not in "buif":
        raise BadInput(f"animation: draws must be an array of numbers, not of {chain.dtype}")
    if chain.ndim != 3 or chain.shape[1:] != grid.shape:
        fault = f"draws has shape {chain.shape}, a chain on this grid (n, {grid.shape[0]}, {grid.shape[1]})"
        raise BadInput(f"animation: {fault}; choose one chain, as run.draws[0]")
    if len(chain) == 0:
        raise BadInput("animation: the chain is empty; an animation needs at least one draw")
    for number, draw in enumerate(chain):
        if not (draw.min() >= -ROUNDING and draw.max() <= 1.0 + ROUNDING):  # written so that NaN fails too
            raise BadInput(f"animation: draw {number} has numbers outside [0, 1]; give walls (0 or 1) or probabilities")
    return chain
