"""The sensor as a generative function of walls and poses: poses may be unknown too.

A trace keeps, beside readings and poses, the wall at which each beam ends. An edit of a pose visits the beams of that
scan and no other. An edit of a wall asks of every beam whether it crosses that cell, which takes no walk; only beams
that lose their wall walk on to the next.

Walking beams through a grid on JAX, from any pose: which wall is the first, and how far away a cell is.

Where poses are unknown the beams' cells cannot be listed beforehand (`bayesmap.programs.beam_geometry` does that where
they are known), so each beam walks from cell to cell: Amanatides and Woo, "A fast voxel traversal algorithm for ray
tracing" (1987). Lengths are in units of cells from the grid's lower left corner.
"""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from bayesmap.errors import BadInput
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff, IndexChange, NoChange
from bayesmap.gen.distribution import DistributionTrace
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, IndexRequest, Regenerate, Update
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight
from bayesmap.programs.reading_law import ReadingLaw
from bayesmap.space.grid import Grid

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


# ruff: noqa: D102 - the methods are those of the contract, documented with it.


GROUP = 8
"""How many beams that lost their wall walk on in one go."""


@dataclass
class PoseTrace(Trace):
    """Readings, poses, and the cells at which the beams end.

    The score is worked out when it is asked for, so it does not drift however many edits came before.

    Attributes:
        poses: of the scans, (S, 3) float.
        ends: (S, A) int32, flat index of each beam's first wall, or the number of cells if there is none.
        readings: metres, in the shape that the sensor gives them.
    """

    gen_fn: Any
    args: Any
    poses: Any
    ends: Any
    readings: Any

    def get_retval(self) -> Any:
        return self.readings

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.choice(self.readings)

    def get_score(self) -> Score:
        sensor: PoseSensor = self.gen_fn
        distance_m = sensor.distances_m(self.poses, self.ends)
        return sensor.law.logpdf(self.readings.reshape(distance_m.shape), distance_m).sum(axis=(-2, -1))  # type: ignore[no-any-return]


@dataclass
class PoseSensor(GenerativeFunction):
    """`sensor(walls, poses)`: walls (nx, ny), poses (3,) or (S, 3); readings in metres, (A,) or (S, A), at address ().

    Attributes:
        grid: where the cells are.
        angles_rad: of the beams in the sensor frame, A of them.
        law: of a reading given the distance of the first wall.
        hit_depth: where in a cell a beam stops, as a fraction of its chord.
    """

    grid: Grid = static()
    angles_rad: tuple[float, ...] = static()
    law: ReadingLaw = static()
    hit_depth: float = static()

    # From walls and poses to distances --------------------------------------------------------------

    def beams(self, poses: Any) -> Beams:
        """The beams of poses (..., 3): (..., A) of them."""
        poses = jnp.asarray(poses, jnp.result_type(float))
        start = (poses[..., :2] - jnp.array(self.grid.origin)) / self.grid.resolution
        return beams_of(start[..., None, :], poses[..., 2, None] + jnp.array(self.angles_rad))

    def ends(self, walls: Any, poses: Any) -> Any:
        """The cells at which the beams of poses (S, 3) end, (S, A), all of them walked."""
        beams = self.beams(poses)
        flat = Beams(*(part.reshape(-1, 2) for part in beams))
        return first_walls(jnp.asarray(walls), flat, *first_cells(flat, self.grid.shape)).reshape(
            beams.start.shape[:-1]
        )

    def distances_m(self, poses: Any, ends: Any) -> Any:
        """Metres to the cells `ends` (..., S, A), inf where there is none."""
        ny = self.grid.shape[1]
        enter, leave = cell_span(self.beams(poses), jnp.stack([ends // ny, ends % ny], axis=-1))
        # from inside a cell, its far side: so do all of this library's beams
        at = jnp.where(enter >= 0, enter + self.hit_depth * jnp.maximum(leave - enter, 0), leave)
        return jnp.where(ends < self.grid.n_cells, at * self.grid.resolution, jnp.inf)

    def _read(self, args: Arguments) -> tuple[Any, Any]:
        """Walls and poses, the latter as (S, 3)."""
        walls, poses = args
        if jnp.shape(walls) != self.grid.shape:
            raise BadInput(f"sensor model: the argument walls has shape {jnp.shape(walls)}, expected {self.grid.shape}")
        if jnp.ndim(poses) not in (1, 2) or jnp.shape(poses)[-1] != 3:
            raise BadInput(f"sensor model: the argument poses has shape {jnp.shape(poses)}, expected (3,) or (S, 3)")
        return jnp.asarray(walls), jnp.asarray(poses, jnp.result_type(float)).reshape(-1, 3)

    def _law_args(self, args: Arguments, poses: Any, ends: Any) -> Arguments:
        return (self.distances_m(poses, ends).reshape((*jnp.shape(args[1])[:-1], -1)),)

    # The contract ---------------------------------------------------------------------------------

    def simulate(self, key: PRNGKey, args: Arguments) -> PoseTrace:
        walls, poses = self._read(args)
        ends = self.ends(walls, poses)
        return PoseTrace(self, args, poses, ends, self.law.draw(key, self._law_args(args, poses, ends)))

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        walls, poses = self._read(args)
        return self.law.assess(choices, self._law_args(args, poses, self.ends(walls, poses)))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        walls, poses = self._read(args)
        ends = self.ends(walls, poses)
        inner, weight = self.law.generate(key, constraint, self._law_args(args, poses, ends))
        return PoseTrace(self, args, poses, ends, inner.get_retval()), weight

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        score = trace.get_score()
        return score if selection.check() else jnp.zeros_like(score)

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        match request:
            case IndexRequest(i, Update(constraint)):
                request = Update(constraint.extend(i))
        keeps = (isinstance(request, Update) and request.constraint.static_is_empty()) or (
            isinstance(request, Regenerate) and not request.selection.check()
        )
        args, (of_walls, of_poses) = Diff.tree_primal(argdiffs), Diff.tangents(argdiffs)
        if keeps and Diff.static_check_no_change(argdiffs):
            return EmptyRequest().edit(key, trace, argdiffs)
        walls, poses = self._read(args)
        if keeps and (of_walls == NoChange or isinstance(of_walls, IndexChange)):
            ends, readings = trace.ends, trace.readings.reshape(trace.ends.shape)
            weight = jnp.zeros((), readings.dtype)
            if isinstance(of_walls, IndexChange):
                ends, weight = self._change_cells(trace.poses, ends, readings, walls, *of_walls.index)
            if of_poses != NoChange:
                ends, gain = self._move_scans(trace.poses, ends, readings, walls, poses)
                weight += gain
            new = PoseTrace(self, args, poses, ends, trace.readings)
            return new, weight, Diff.no_change(new.readings), Update(ChoiceMap.empty())
        ends = self.ends(walls, poses)
        old_args = self._law_args(args, trace.poses, trace.ends)
        old = DistributionTrace(self.law, old_args, trace.readings, trace.get_score())
        law_diffs = Diff.unknown_change(self._law_args(args, poses, ends))
        inner, weight, retdiff, backward = self.law.edit(key, old, request, law_diffs)
        return PoseTrace(self, args, poses, ends, inner.get_retval()), weight, retdiff, backward

    # Some scans, some cells -------------------------------------------------------------------------

    @partial(jax.jit, inline=True)  # else every edit outside of `jit` would compile its loops again
    def _move_scans(self, before: Any, ends: Any, readings: Any, walls: Any, poses: Any) -> tuple[Any, Weight]:
        """Ends, and the change of the log-likelihood, now that the poses `before` are `poses`.

        Which poses differ is found by comparing them, whatever edit changed them: a prior may move one pose alone, or
        the state of a motion model and what follows from it.
        """

        def move(state: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
            moved, ends, weight = state
            s = moved.argmax()
            old_m = self.distances_m(before[s], ends[s])
            now = self.ends(walls, poses[s][None])[0]
            gain = self.law.logpdf(readings[s], self.distances_m(poses[s], now)) - self.law.logpdf(readings[s], old_m)
            return moved.at[s].set(False), ends.at[s].set(now), weight + gain.sum()

        moved = (before != poses).any(axis=-1)
        start = (moved, ends, jnp.zeros((), readings.dtype))
        _, ends, weight = jax.lax.while_loop(lambda state: state[0].any(), move, start)
        return ends, weight

    @partial(jax.jit, inline=True)
    def _change_cells(self, poses: Any, ends: Any, readings: Any, walls: Any, i: Any, j: Any) -> tuple[Any, Weight]:
        """Ends, and the change of the log-likelihood, now that the cells (i, j) are what `walls` says they are."""
        nx, ny = self.grid.shape
        beams = Beams(*(part.reshape(-1, 2) for part in self.beams(poses)))
        i, j = (jnp.ravel(jnp.asarray(k, jnp.int32)) for k in jnp.broadcast_arrays(i, j))
        cells = jnp.stack([jnp.where(i < 0, i + nx, i), jnp.where(j < 0, j + ny, j)], axis=-1)
        old_m = self.distances_m(poses, ends)

        def change(k: Any, ends: Any) -> Any:
            return self._change_cell(beams, ends, walls, cells[k])

        flat = jax.lax.fori_loop(0, len(cells), change, ends.reshape(-1))
        ends = flat.reshape(ends.shape)
        gain = self.law.logpdf(readings, self.distances_m(poses, ends)) - self.law.logpdf(readings, old_m)
        return ends, gain.sum()

    def _change_cell(self, beams: Beams, ends: Any, walls: Any, cell: Any) -> Any:
        """The ends (B,) of all beams against the new map, where they were right but for this cell."""
        ny, none = self.grid.shape[1], self.grid.n_cells
        here = cell[0] * ny + cell[1]
        is_wall = walls[cell[0], cell[1]] != 0
        enter, leave = cell_span(beams, cell)
        end_enter, _ = cell_span(beams, jnp.stack([ends // ny, ends % ny], axis=-1))
        nearer = (ends == none) | (enter < end_enter)
        taken = is_wall & (enter <= leave) & (leave >= 0) & nearer
        ends = jnp.where(taken, here, ends)

        def walk_on(state: tuple[Any, Any]) -> tuple[Any, Any]:
            ends, lost = state
            some = jnp.nonzero(lost, size=GROUP, fill_value=len(ends))[0]
            few = Beams(*(part.at[some].get(mode="clip") for part in beams))
            found = first_walls(walls, few, jnp.broadcast_to(cell, (GROUP, 2)), some < len(ends))
            return ends.at[some].set(found, mode="drop"), lost.at[some].set(False, mode="drop")

        return jax.lax.while_loop(lambda state: state[1].any(), walk_on, (ends, ~is_wall & (ends == here)))[0]
