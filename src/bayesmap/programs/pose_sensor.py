"""The sensor as a generative function of walls and poses, for unknown poses; walks of beams through a grid on JAX.

A trace keeps the readings, the poses and the wall at which each beam ends. An edit of a pose walks the beams of this
scan alone. An edit of a wall checks all beams without a walk, and only beams that lose their wall walk on to the next.

The cells of beams from unknown poses cannot be listed in advance, as `bayesmap.programs.beam_sensor` does for known
poses. Each beam walks from cell to cell: Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing" (1987).
Lengths are in units of cells from the grid's lower left corner.
"""

from collections.abc import Sequence
from functools import partial
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from bayesmap.errors import BadInput
from bayesmap.gen.diff import Change, IndexChange, NoChange
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.typing import Arguments, Score, Weight
from bayesmap.programs.beam_sensor import RangeSensor, ReadingLaw, ReadingsTrace, checked_walls
from bayesmap.space.grid import Grid

MIN_COSINE = 1e-10  # absolute direction cosines are raised to this: such beams stay in their row or column
BEAMS_AT_ONCE = 8  # number of beams without their wall that walk on at once


class Beams(NamedTuple):
    """Beams as rays: their first points and their directions, unit vectors without zeros, each (..., 2)."""

    start: Any
    direction: Any


def beams_of(start: Any, angle_rad: Any) -> Beams:
    """Return the beams from `start` (..., 2) at `angle_rad` (...) in the world frame."""
    direction = jnp.stack([jnp.cos(angle_rad), jnp.sin(angle_rad)], axis=-1)
    is_small = jnp.abs(direction) < MIN_COSINE
    return Beams(jnp.broadcast_to(start, direction.shape), jnp.where(is_small, MIN_COSINE, direction))


def span(beams: Beams, low: Any, high: Any) -> tuple[Any, Any]:
    """Return the distances at which beams enter and leave the rectangle from `low` to `high`, each (...).
    A beam that leaves before it enters misses the rectangle (slab method). Distances behind the start are negative.
    """
    to_low, to_high = (low - beams.start) / beams.direction, (high - beams.start) / beams.direction
    return jnp.minimum(to_low, to_high).max(axis=-1), jnp.maximum(to_low, to_high).min(axis=-1)


def cell_span(beams: Beams, cell: Any) -> tuple[Any, Any]:
    """Return `span` of the cells with indices `cell`, (..., 2)."""
    low = jnp.asarray(cell, beams.start.dtype)
    return span(beams, low, low + 1)


def first_cells(beams: Beams, shape: tuple[int, int]) -> tuple[Any, Any]:
    """Return each beam's first cell on the grid, (..., 2), and the mask of beams that touch the grid, (...)."""
    size = jnp.array(shape)
    enter, leave = span(beams, jnp.zeros_like(beams.start), size.astype(beams.start.dtype))
    entry = beams.start + jnp.maximum(enter, 0)[..., None] * beams.direction
    return jnp.clip(jnp.floor(entry).astype(jnp.int32), 0, size - 1), (enter <= leave) & (leave >= 0)


def first_walls(walls: Any, beams: Beams, cell: Any, active: Any) -> Any:
    """Return the first wall of each active beam at or behind its `cell`, (K, 2), as a flat index x * ny + y, (K,).
    Walls are (nx, ny). The index is nx * ny for a beam that meets no wall or is not active.
    """
    shape = jnp.array(jnp.shape(walls))
    nx, ny = jnp.shape(walls)
    forward = beams.direction > 0
    step = jnp.where(forward, 1, -1).astype(jnp.int32)
    gap = 1 / jnp.abs(beams.direction)
    border = (cell + forward - beams.start) / beams.direction  # distance of the next line in x and in y

    def walk(state: tuple[Any, Any, Any, Any]) -> tuple[Any, Any, Any, Any]:
        cell, border, hit, active = state
        is_wall = active & (walls[cell[:, 0], cell[:, 1]] != 0)
        hit = jnp.where(is_wall, cell[:, 0] * ny + cell[:, 1], hit)
        along_x = border[:, 0] < border[:, 1]
        crossed = jnp.stack([along_x, ~along_x], axis=-1)
        cell = cell + jnp.where(crossed, step, 0)
        border = border + jnp.where(crossed, gap, 0)
        return cell, border, hit, active & ~is_wall & ((cell >= 0) & (cell < shape)).all(axis=-1)

    no_hit = jnp.full(jnp.shape(active), nx * ny, jnp.int32)
    return jax.lax.while_loop(lambda state: state[3].any(), walk, (cell, border, no_hit, active))[2]


@dataclass
class PoseTrace(ReadingsTrace):
    """The trace of a `PoseSensor`: readings with the poses of the scans and the cells at which the beams end."""

    poses: Any  # (S, 3)
    ends: Any  # (S, A) int32, the flat index of each beam's first wall, or the number of cells if there is none
    readings: Any  # metres, (A,) or (S, A)

    @property
    def hits(self) -> tuple[Any, Any]:
        return self.poses, self.ends

    def get_score(self) -> Score:
        sensor: PoseSensor = self.gen_fn
        distance_m = sensor.distances_m(self.poses, self.ends)
        return sensor.law.logpdf(self.readings.reshape(distance_m.shape), distance_m).sum(axis=(-2, -1))  # type: ignore[no-any-return]


@dataclass
class PoseSensor(RangeSensor):
    """`sensor(walls, poses)`: walls (nx, ny), poses (3,) or (S, 3). The choice at () is readings, m, (A,) or (S, A)."""

    grid: Grid = static()
    angles_rad: tuple[float, ...] = static()  # angles of the A beams, in the sensor frame
    law: ReadingLaw = static()
    hit_depth: float = static()  # where in a cell a beam stops, as a fraction of its chord

    def beams(self, poses: Any) -> Beams:
        """Return the beams of poses (..., 3), shape (..., A)."""
        poses = jnp.asarray(poses, jnp.result_type(float))
        start = (poses[..., :2] - jnp.array(self.grid.origin)) / self.grid.resolution
        return beams_of(start[..., None, :], poses[..., 2, None] + jnp.array(self.angles_rad))

    def ends(self, walls: Any, poses: Any) -> Any:
        """Return the cells at which the beams of poses (S, 3) end, (S, A), by a walk of all beams."""
        beams = self.beams(poses)
        flat = Beams(*(part.reshape(-1, 2) for part in beams))
        ends = first_walls(jnp.asarray(walls), flat, *first_cells(flat, self.grid.shape))
        return ends.reshape(beams.start.shape[:-1])

    def distances_m(self, poses: Any, ends: Any) -> Any:
        """Return the distances in metres of the cells `ends` (..., S, A); inf where there is no cell."""
        ny = self.grid.shape[1]
        enter, leave = cell_span(self.beams(poses), jnp.stack([ends // ny, ends % ny], axis=-1))
        # A beam that starts inside a cell ends at the far side, as everywhere in this library.
        distance = jnp.where(enter >= 0, enter + self.hit_depth * jnp.maximum(leave - enter, 0), leave)
        return jnp.where(ends < self.grid.n_cells, distance * self.grid.resolution, jnp.inf)

    def _checked(self, args: Arguments) -> tuple[Any, Any]:
        """Return the walls, (nx, ny), and the poses, (S, 3). Raises `BadInput` for other shapes."""
        walls, poses = args
        walls = checked_walls(walls, self.grid.shape)
        if jnp.ndim(poses) not in (1, 2) or jnp.shape(poses)[-1] != 3:
            raise BadInput(f"sensor model: the argument poses has shape {jnp.shape(poses)}, expected (3,) or (S, 3)")
        return walls, jnp.asarray(poses, jnp.result_type(float)).reshape(-1, 3)

    def find_hits(self, args: Arguments) -> tuple[Any, Any]:
        walls, poses = self._checked(args)
        return poses, self.ends(walls, poses)

    def law_args(self, args: Arguments, hits: tuple[Any, Any]) -> Arguments:
        return (self.distances_m(*hits).reshape((*jnp.shape(args[1])[:-1], -1)),)

    def trace(self, args: Arguments, hits: tuple[Any, Any], readings: Any) -> PoseTrace:
        return PoseTrace(self, args, *hits, readings)

    def change_hits(self, trace: Any, args: Arguments, tangents: Sequence[Change]) -> tuple[Any, Weight] | None:
        """Return (hits, change of the log-likelihood) if at most some cells and poses changed; else None."""
        walls, poses = self._checked(args)
        wall_change, pose_change = tangents
        if wall_change != NoChange and not isinstance(wall_change, IndexChange):
            return None
        ends, readings = trace.ends, trace.readings.reshape(trace.ends.shape)
        weight = jnp.zeros((), readings.dtype)
        if isinstance(wall_change, IndexChange):
            ends, weight = self._change_cells(trace.poses, ends, readings, walls, *wall_change.index)
        if pose_change != NoChange:
            ends, gain = self._move_scans(trace.poses, ends, readings, walls, poses)
            weight += gain
        return (poses, ends), weight

    @partial(jax.jit, inline=True)  # else every edit outside of `jit` would compile its loops again
    def _move_scans(self, old_poses: Any, ends: Any, readings: Any, walls: Any, poses: Any) -> tuple[Any, Weight]:
        """Return (ends, change of the log-likelihood) after the scans whose poses differ have moved to `poses`."""

        def move_scan(state: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
            to_move, ends, weight = state
            scan = to_move.argmax()
            new = self.ends(walls, poses[scan][None])[0]
            old_m, new_m = self.distances_m(old_poses[scan], ends[scan]), self.distances_m(poses[scan], new)
            gain = self.law.logpdf(readings[scan], new_m) - self.law.logpdf(readings[scan], old_m)
            return to_move.at[scan].set(False), ends.at[scan].set(new), weight + gain.sum()

        start = ((old_poses != poses).any(axis=-1), ends, jnp.zeros((), readings.dtype))
        _, ends, weight = jax.lax.while_loop(lambda state: state[0].any(), move_scan, start)
        return ends, weight

    @partial(jax.jit, inline=True)
    def _change_cells(self, poses: Any, ends: Any, readings: Any, walls: Any, i: Any, j: Any) -> tuple[Any, Weight]:
        """Return (ends, change of the log-likelihood) after the cells (i, j) changed to those of `walls`."""
        nx, ny = self.grid.shape
        beams = Beams(*(part.reshape(-1, 2) for part in self.beams(poses)))
        i, j = (jnp.ravel(jnp.asarray(k, jnp.int32)) for k in jnp.broadcast_arrays(i, j))
        cells = jnp.stack([jnp.where(i < 0, i + nx, i), jnp.where(j < 0, j + ny, j)], axis=-1)
        old_m = self.distances_m(poses, ends)

        def change(k: Any, ends: Any) -> Any:
            return self._change_cell(beams, ends, walls, cells[k])

        ends = jax.lax.fori_loop(0, len(cells), change, ends.reshape(-1)).reshape(ends.shape)
        gain = self.law.logpdf(readings, self.distances_m(poses, ends)) - self.law.logpdf(readings, old_m)
        return ends, gain.sum()

    def _change_cell(self, beams: Beams, ends: Any, walls: Any, cell: Any) -> Any:
        """Return the ends of all beams on the new map, (B,), given their `ends` before this cell changed."""
        # A new wall that is nearer than a beam's end becomes its end.
        ny, no_end = self.grid.shape[1], self.grid.n_cells
        flat = cell[0] * ny + cell[1]
        is_wall = walls[cell[0], cell[1]] != 0
        enter, leave = cell_span(beams, cell)
        end_enter, _ = cell_span(beams, jnp.stack([ends // ny, ends % ny], axis=-1))
        nearer = (ends == no_end) | (enter < end_enter)
        ends = jnp.where(is_wall & (enter <= leave) & (leave >= 0) & nearer, flat, ends)

        # A beam whose wall was removed walks on from this cell.
        def walk_on(state: tuple[Any, Any]) -> tuple[Any, Any]:
            ends, lost = state
            group = jnp.nonzero(lost, size=BEAMS_AT_ONCE, fill_value=len(ends))[0]
            group_beams = Beams(*(array.at[group].get(mode="clip") for array in beams))
            cells = jnp.broadcast_to(cell, (BEAMS_AT_ONCE, 2))
            next_ends = first_walls(walls, group_beams, cells, group < len(ends))
            return ends.at[group].set(next_ends, mode="drop"), lost.at[group].set(False, mode="drop")

        return jax.lax.while_loop(lambda state: state[1].any(), walk_on, (ends, ~is_wall & (ends == flat)))[0]
