"""Walls as text, one character per cell, and the tutorial's map: 21 x 21 cells of 1 m, with a robot in the middle."""

import numpy as np
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Mask
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats

FREE = "."
WALLS = "X#"  # characters of walls; `to_text` writes the first


def from_text(text: str) -> Mask:
    """Read walls from a text drawing: ``.`` is free, ``X`` or ``#`` is a wall.

    As in the tutorial, lines are the *first* index: ``walls[i, j]`` is line ``i``, column ``j``. Maps are indexed
    ``[x, y]``, so the first line becomes the leftmost column of cells, from the bottom up. The drawing appears on the
    map turned a quarter anticlockwise. Use `from_image` for a picture that should appear as it is drawn.

    Blank lines around the drawing, blanks at the ends of lines, and an indentation common to all lines are ignored.
    Returns walls, (lines, columns). Raises `BadInput` for no lines, lines of different lengths, or other characters;
    the message names the line (counted from 1 in the whole text) and the column.
    """
    # Number the lines, cut blank lines off at both ends, and find the common indentation.
    numbered = [(number, line.rstrip()) for number, line in enumerate(text.splitlines(), start=1)]
    filled = [k for k, (_, line) in enumerate(numbered) if line]
    if not filled:
        raise BadInput("drawing: the text has no lines; draw free cells as '.' and walls as 'X' or '#'")
    numbered = numbered[filled[0] : filled[-1] + 1]
    indent = min(len(line) - len(line.lstrip()) for _, line in numbered)
    first, width = numbered[0][0], len(numbered[0][1]) - indent
    for number, line in numbered:
        for column, character in enumerate(line[indent:], start=indent + 1):
            if character not in FREE + WALLS:
                raise BadInput(
                    f"drawing: line {number}, column {column}: unknown character {character!r}; "
                    "use '.' for a free cell, 'X' or '#' for a wall"
                )
        if len(line) - indent != width:
            raise BadInput(
                f"drawing: line {number} has {len(line) - indent} cells, but line {first} has {width}; "
                "all lines must be equally long"
            )
    return np.array([[character in WALLS for character in line[indent:]] for _, line in numbered])


def to_text(walls: ArrayLike) -> str:
    """Return a drawing of walls (lines, columns) that `from_text` reads. Raises `BadInput` for other shapes."""
    array = np.asarray(walls).astype(bool)
    if array.ndim != 2 or array.size == 0:
        raise BadInput(f"drawing: walls must have shape (lines, columns), got {array.shape}")
    return "\n".join("".join(WALLS[0] if wall else FREE for wall in line) for line in array) + "\n"


TUTORIAL_GRID = Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))  # cell (i, j) is centred on the point (i, j)

DRAWING = """
.....................
.....................
.XXX..........X......
.X.X..........X......
.X............XXX....
.X..............X....
.X..............X....
.XX............XXX...
..X..............X...
..X..............X...
..X..............X...
..X..............X...
..XXXXX......XXXXX...
......X......X.......
......X....XXX.......
......X....X.........
......X....X.........
......XXXXXX.........
.....................
.....................
.....................
"""


def tutorial() -> tuple[Mask, Floats]:
    """Return walls on `TUTORIAL_GRID`, (21, 21), line i of the drawing at x = i, and the pose (10, 10, 0), (3,)."""
    return from_text(DRAWING), np.array([10.0, 10.0, 0.0])
