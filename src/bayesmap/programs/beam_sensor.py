"""The sensor as a generative function of the walls, whose edits look at the beams through what changed.

A trace keeps, beside the readings, where each beam first hits. That is all: a cell c stands at position m of a beam
with first hit f, and a change of c matters only if it becomes a wall before f (m < f), or was the first wall (m = f)
and is removed, which moves the hit to the next wall behind it. No other beam, and no other cell, is looked at.
"""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from __future__ import annotations

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.errors import BadInput
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff, IndexChange
from bayesmap.gen.distribution import DistributionTrace
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, IndexRequest, Regenerate, Update
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight
from bayesmap.programs.beam_geometry import GROUP, LOOK, BeamGeometry
from bayesmap.programs.reading_law import ReadingLaw


@dataclass
class BeamTrace(Trace):
    """Readings, and what is needed to change a cell under them.

    The score is worked out when it is asked for, from the first hits: it is as exact after a million edits as after
    one, and edits do not pay for it.

    Attributes:
        first_hit: (B,) unsigned, the position of each beam's first wall.
        readings: metres, in the shape that the sensor gives them.
    """

    gen_fn: Any
    args: Any
    first_hit: Any
    readings: Any

    def get_retval(self) -> Any:
        return self.readings

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.choice(self.readings)

    def get_score(self) -> Score:
        sensor: BeamSensor = self.gen_fn
        readings = self.readings.reshape(self.first_hit.shape)
        return sensor.law.logpdf(readings, sensor.distances_at(self.first_hit)).sum(axis=-1)  # type: ignore[no-any-return]


@dataclass
class BeamSensor(GenerativeFunction):
    """`sensor(walls)`: walls of shape (nx, ny), readings in metres of shape `readings_shape`, at the address ()."""

    geometry: BeamGeometry = static()
    law: ReadingLaw = static()
    readings_shape: tuple[int, ...] = static()

    # From walls to distances ----------------------------------------------------------------------

    def first_hits(self, walls: Any) -> Any:
        """The position of each beam's first wall, (B,), all beams looked at."""
        geometry = self.geometry
        cells = geometry.cells[:, : geometry.longest]
        known = jnp.append(self._checked(walls).reshape(-1) != 0, True)  # the sentinel is a wall
        positions = jnp.arange(geometry.longest, dtype=geometry.position_dtype)
        return jnp.where(known[cells], positions, positions[-1]).min(axis=1)

    def distances_at(self, first_hit: Any) -> Any:
        """Metres to the first walls, inf where there is none, (..., B)."""
        return jnp.asarray(self.geometry.distance_m)[jnp.arange(self.geometry.n_beams), first_hit]

    def _checked(self, walls: Any) -> Any:
        if jnp.shape(walls) != self.geometry.shape:
            raise BadInput(
                f"sensor model: the argument walls has shape {jnp.shape(walls)}, expected {self.geometry.shape}"
            )
        return jnp.asarray(walls)

    def _law_args(self, first_hit: Any) -> Arguments:
        return (self.distances_at(first_hit).reshape(self.readings_shape),)

    # The contract ---------------------------------------------------------------------------------

    def simulate(self, key: PRNGKey, args: Arguments) -> BeamTrace:
        first_hit = self.first_hits(*args)
        return BeamTrace(self, args, first_hit, self.law.draw(key, self._law_args(first_hit)))

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        return self.law.assess(choices, self._law_args(self.first_hits(*args)))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        first_hit = self.first_hits(*args)
        inner, weight = self.law.generate(key, constraint, self._law_args(first_hit))
        return BeamTrace(self, args, first_hit, inner.get_retval()), weight

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
        args, tangents = Diff.tree_primal(argdiffs), Diff.tangents(argdiffs)
        if keeps and Diff.static_check_no_change(argdiffs):
            return EmptyRequest().edit(key, trace, argdiffs)
        match tangents:
            case [IndexChange((i, j))] if keeps:
                first_hit, weight = self._change_cells(trace.first_hit, trace.readings, args[0], i, j)
                new = BeamTrace(self, args, first_hit, trace.readings)
                return new, weight, Diff.no_change(new.readings), Update(ChoiceMap.empty())
        first_hit = trace.first_hit if Diff.static_check_no_change(argdiffs) else self.first_hits(*args)
        old = DistributionTrace(self.law, self._law_args(trace.first_hit), trace.readings, trace.get_score())
        law_diffs = Diff.unknown_change(self._law_args(first_hit))
        inner, weight, retdiff, backward = self.law.edit(key, old, request, law_diffs)
        return BeamTrace(self, args, first_hit, inner.get_retval()), weight, retdiff, backward

    # Some cells -----------------------------------------------------------------------------------

    @partial(jax.jit, inline=True)  # else every edit outside of `jit` would compile its loops again
    def _change_cells(self, first_hit: Any, readings: Any, walls: Any, i: Any, j: Any) -> tuple[Any, Weight]:
        """First hits, and the change of the log-likelihood, now that the cells (i, j) are what `walls` says they are.

        One cell after the other, each against the new map: a beam that loses its hit goes to the next wall of that
        map, and a wall that appears before a hit takes it over, in whatever order.
        """
        # No operation here may touch the whole map: not to compare it, and not to flatten it either, for XLA would
        # fuse that with the write that made the map, and write twice, into two copies.
        walls, (nx, ny) = self._checked(walls), self.geometry.shape
        i, j = jnp.asarray(i, jnp.int32), jnp.asarray(j, jnp.int32)
        cells = jnp.ravel(jnp.where(i < 0, i + nx, i) * ny + jnp.where(j < 0, j + ny, j))
        readings = readings.reshape(-1)
        if len(cells) == 1:
            return self._change_cell(walls, cells[0], first_hit, readings)

        def one(k: Any, state: tuple[Any, Any]) -> tuple[Any, Any]:
            first_hit, gain = self._change_cell(walls, cells[k], state[0], readings)
            return first_hit, state[1] + gain

        return jax.lax.fori_loop(0, len(cells), one, (first_hit, jnp.zeros((), readings.dtype)))  # type: ignore[no-any-return]

    def _change_cell(self, walls: Any, cell: Any, first_hit: Any, readings: Any) -> tuple[Any, Weight]:
        geometry, is_wall = self.geometry, self._wall_at(walls, cell)
        offsets, beams, positions = map(jnp.asarray, (geometry.offsets, geometry.beam, geometry.position))
        distance_m = jnp.asarray(geometry.distance_m)
        end = offsets[cell + 1]

        def group(state: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
            k, first_hit, weight = state
            here = k + jnp.arange(GROUP, dtype=jnp.int32) < end
            beam = jax.lax.dynamic_slice(beams, (k,), (GROUP,))
            at = jax.lax.dynamic_slice(positions, (k,), (GROUP,))
            old = first_hit[beam].astype(jnp.int32)
            uncovered = here & ~is_wall & (at == old)
            new = jnp.where(here & is_wall, jnp.minimum(at, old), old)
            new = self._next_walls(walls, beam, new, uncovered)
            gain = self.law.logpdf(readings[beam], distance_m[beam, new])
            gain -= self.law.logpdf(readings[beam], distance_m[beam, old])
            weight += jnp.where(new != old, gain, 0.0).sum()
            where_to = jnp.where(here, beam, geometry.n_beams)  # outside: dropped
            first_hit = first_hit.at[where_to].set(new.astype(first_hit.dtype), mode="drop")
            return k + GROUP, first_hit, weight

        start = (offsets[cell], first_hit, jnp.zeros((), readings.dtype))
        _, first_hit, weight = jax.lax.while_loop(lambda state: state[0] < end, group, start)
        return first_hit, weight

    def _wall_at(self, walls: Any, cell: Any) -> Any:
        """Is there a wall in the cells with these flat indices?"""
        ny = self.geometry.shape[1]
        return walls[cell // ny, cell % ny] != 0

    def _next_walls(self, walls: Any, beam: Any, position: Any, uncovered: Any) -> Any:
        """Where beams first hit behind `position`, for those that are uncovered; the others stay. All (GROUP,)."""
        cells, n_cells = jnp.asarray(self.geometry.cells), self.geometry.n_cells
        ahead = jnp.arange(LOOK, dtype=jnp.int32)

        def look(state: tuple[Any, Any]) -> tuple[Any, Any]:
            position, searching = state
            seen = cells[beam[:, None], position[:, None] + 1 + ahead]
            wall = (seen == n_cells) | self._wall_at(walls, jnp.minimum(seen, n_cells - 1))
            step = jnp.where(wall, ahead, LOOK).min(axis=1)
            found = step < LOOK
            position = jnp.where(searching, position + jnp.where(found, step + 1, LOOK), position)
            return position, searching & ~found

        position, _ = jax.lax.while_loop(lambda state: state[1].any(), look, (position, uncovered))
        return position
