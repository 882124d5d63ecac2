"""Walking beams through a grid on JAX, from any pose: which wall is the first, and how far away a cell is.

Where poses are unknown the beams' cells cannot be listed beforehand (`bayesmap.programs.beam_geometry` does that where
they are known), so each beam walks from cell to cell: Amanatides and Woo, "A fast voxel traversal algorithm for ray
tracing" (1987). Lengths are in units of cells from the grid's lower left corner.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

LEAST_COSINE = 1e-10
"""Direction cosines below this count as this: the beam then never leaves its column, or its row."""


class Beams(NamedTuple):
    """Some beams.

    Attributes:
        start: where they begin, (..., 2).
        direction: unit vectors without zeros, (..., 2).
    """

    start: Any
    direction: Any


def beams_of(start: Any, angle_rad: Any) -> Beams:
    """Beams from `start` (..., 2) at `angle_rad` (...) in the world frame."""
    direction = jnp.stack([jnp.cos(angle_rad), jnp.sin(angle_rad)], axis=-1)
    small = jnp.abs(direction) < LEAST_COSINE
    return Beams(jnp.broadcast_to(start, direction.shape), jnp.where(small, LEAST_COSINE, direction))


def span(beams: Beams, low: Any, high: Any) -> tuple[Any, Any]:
    """Where beams enter and leave the rectangle from `low` to `high`, (...): it is missed if they leave before.

    A beam is in the rectangle where it is between its sides in x and in y (the slab method); behind the start
    distances are negative.
    """
    one, other = (low - beams.start) / beams.direction, (high - beams.start) / beams.direction
    return jnp.minimum(one, other).max(axis=-1), jnp.maximum(one, other).min(axis=-1)


def cell_span(beams: Beams, cell: Any) -> tuple[Any, Any]:
    """`span` of the cells with indices `cell`, (..., 2)."""
    low = jnp.asarray(cell, beams.start.dtype)
    return span(beams, low, low + 1)


def first_cells(beams: Beams, shape: tuple[int, int]) -> tuple[Any, Any]:
    """The cells in which beams start, or by which they enter the grid, (..., 2), and whether they touch it at all."""
    size = jnp.array(shape)
    enter, leave = span(beams, jnp.zeros_like(beams.start), size.astype(beams.start.dtype))
    at = beams.start + jnp.maximum(enter, 0)[..., None] * beams.direction
    return jnp.clip(jnp.floor(at).astype(jnp.int32), 0, size - 1), (enter <= leave) & (leave >= 0)


def first_walls(walls: Any, beams: Beams, cell: Any, active: Any) -> Any:
    """The first wall at or behind a cell, for beams that are active.

    Args:
        walls: (nx, ny), non-zero where there is a wall.
        beams: K beams.
        cell: a cell of each, to begin with, (K, 2).
        active: which beams are wanted, (K,).

    Returns:
        Flat indices x * ny + y, (K,) int32; nx * ny for a beam that meets no wall or is not active.
    """
    shape = jnp.array(jnp.shape(walls))
    nx, ny = jnp.shape(walls)
    forward = beams.direction > 0
    step = jnp.where(forward, 1, -1).astype(jnp.int32)
    gap = 1 / jnp.abs(beams.direction)
    border = (cell + forward - beams.start) / beams.direction  # distance of the next line in x and in y

    def walk(state: tuple[Any, Any, Any, Any]) -> tuple[Any, Any, Any, Any]:
        cell, border, found, active = state
        is_wall = active & (walls[cell[:, 0], cell[:, 1]] != 0)
        found = jnp.where(is_wall, cell[:, 0] * ny + cell[:, 1], found)
        along_x = border[:, 0] < border[:, 1]
        crossed = jnp.stack([along_x, ~along_x], axis=-1)
        cell = cell + jnp.where(crossed, step, 0)
        border = border + jnp.where(crossed, gap, 0)
        return cell, border, found, active & ~is_wall & ((cell >= 0) & (cell < shape)).all(axis=-1)

    none = jnp.full(jnp.shape(active), nx * ny, jnp.int32)
    return jax.lax.while_loop(lambda state: state[3].any(), walk, (cell, border, none, active))[2]
