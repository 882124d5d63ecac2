"""Sensors as generative functions of the walls: the law of readings, the base of all sensors, the one at known poses.

`ReadingLaw` is the law, or probability distribution, of readings at given distances. `RangeSensor` is the contract of
sensors. `BeamSensor` is the sensor at known poses, whose beams cross the cells of a `BeamGeometry`. Its trace stores
the position of each beam's first hit. Only beams through a changed cell matter, so an edit reads these beams alone.
"""

import dataclasses
import hashlib
import math
from collections.abc import Sequence
from functools import cached_property, partial
from typing import Any

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
from jax.scipy.special import betainc, ndtr
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Change, Diff, IndexChange
from bayesmap.gen.distribution import DistributionTrace, ExactDensity
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, IndexRequest, Regenerate, Update
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight
from bayesmap.sensors.model import LOG_IMPOSSIBLE, KernelParameters, RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans


@dataclass
class ReadingLaw(ExactDensity):
    """The distribution of independent readings, `law(distance_m)`, in metres and the distances' shape.
    The distance `inf` means that the beam meets nothing. Readings are coded as in `Scans`: `inf` is no return, `-inf`
    is too close, and NaN is invalid. An invalid reading scores 0 and is never drawn. The formulas are those of
    `bayesmap.sensors`; in them `wall_m` is the distance, or the largest range if it is smaller.
    """

    parameters: KernelParameters = static()
    limits: RangeLimits = static()

    def sample(self, key: PRNGKey, distance_m: Any, /) -> Any:
        distance = jnp.asarray(distance_m, jnp.result_type(float))
        law, limits, shape = self.parameters, self.limits, distance.shape
        keys = jr.split(key, 6)
        wall_m = jnp.minimum(distance, limits.max_m)
        noise = jr.t(keys[0], law.dof, shape) if law.dof > 0 else jr.normal(keys[0], shape)
        reading = wall_m + self._scale(wall_m) * noise
        if not law.robust:
            return reading
        # The events of `BeamMixture` in reverse order: an earlier event there overrules a later one.
        lost = (jr.uniform(keys[1], shape) < law.p_no_return) | (distance > limits.max_m)
        reading = jnp.where(lost, jnp.inf, reading)
        object_m = jr.exponential(keys[2], shape) / law.rate_short_per_m
        passing = jr.uniform(keys[3], shape) < law.p_short
        reading = jnp.where(passing & (object_m < wall_m), object_m, reading)
        reading = jnp.where(reading > limits.max_m, jnp.inf, reading)
        reading = jnp.where(reading < limits.min_m, -jnp.inf, reading)
        uniform = jr.uniform(keys[4], shape, minval=limits.min_m, maxval=limits.max_m)
        return jnp.where(jr.uniform(keys[5], shape) < law.p_random, uniform, reading)

    def index_shape(self, args: Arguments) -> tuple[int, ...]:
        """Return the shape of the distances: constraints may give some readings by their indices."""
        return jnp.shape(args[0])

    def logpdf(self, value: Any, distance_m: Any, /) -> Any:
        """Return the log density in nats, elementwise over readings and distances in metres."""
        reading, distance = jnp.asarray(value), jnp.asarray(distance_m)
        wall_m = jnp.minimum(distance, self.limits.max_m)
        if self.parameters.robust:
            log_density = self._mixture(reading, wall_m, distance <= self.limits.max_m)
        else:
            # Plain noise has no typed readings: they count as the range limits.
            finite = jnp.nan_to_num(reading, posinf=self.limits.max_m, neginf=self.limits.min_m)
            log_density = self._log_noise(finite, wall_m)
        return jnp.where(jnp.isnan(reading), 0.0, log_density)

    def _scale(self, wall_m: Any) -> Any:
        """Return the scale of the noise in metres, given the distance of the wall in metres."""
        return self.parameters.sigma_m + self.parameters.sigma_per_m * wall_m

    def _log_noise(self, reading: Any, wall_m: Any) -> Any:
        """Return the log density of wall + noise at the reading: Student's t, or normal if dof is 0."""
        scale = self._scale(wall_m)
        dof = self.parameters.dof
        x = (reading - wall_m) / scale
        if dof > 0:
            half = 0.5 * (dof + 1)
            constant = math.lgamma(half) - math.lgamma(0.5 * dof) - 0.5 * math.log(dof * math.pi)
            return constant - half * jnp.log1p(x * x / dof) - jnp.log(scale)
        return -0.5 * x * x - 0.5 * math.log(2 * math.pi) - jnp.log(scale)

    def _tail(self, x: Any) -> Any:
        """Return P(standard noise > x)."""
        dof = self.parameters.dof
        if dof > 0:
            half = 0.5 * betainc(0.5 * dof, 0.5, dof / (dof + x * x))
            return jnp.where(x > 0, half, 1.0 - half)
        return ndtr(-x)

    def _mixture(self, reading: Any, wall_m: Any, in_range: Any) -> Any:
        """Return the log density of readings by the formula of `bayesmap.sensors.model` for the kind of each."""
        law, limits = self.parameters, self.limits

        def unblocked(distance: Any) -> Any:
            return 1.0 + law.p_short * jnp.expm1(-law.rate_short_per_m * distance)

        # Hits: uniform, short of the wall, or from the wall with noise.
        is_hit = jnp.isfinite(reading)
        range_m = jnp.where(is_hit, reading, limits.max_m)
        returned = jnp.where(in_range, unblocked(wall_m) * (1.0 - law.p_no_return), 0.0)
        lost = unblocked(wall_m) * jnp.where(in_range, law.p_no_return, 1.0)
        passing = law.p_short * law.rate_short_per_m * jnp.exp(-law.rate_short_per_m * jnp.maximum(range_m, 0.0))
        short = jnp.where(range_m < wall_m, passing, 0.0)
        noise = jnp.exp(self._log_noise(range_m, wall_m))
        hit = law.p_random / (limits.max_m - limits.min_m) + (1 - law.p_random) * (short + returned * noise)
        # No return and too close: the probabilities of noise beyond the limits.
        scale = self._scale(wall_m)
        above = self._tail((limits.max_m - wall_m) / scale)
        below = self._tail((wall_m - limits.min_m) / scale)  # the noise is symmetric
        no_return = (1 - law.p_random) * (lost + returned * above)
        blocked = -law.p_short * jnp.expm1(-law.rate_short_per_m * jnp.minimum(wall_m, limits.min_m))
        too_close = (1 - law.p_random) * (blocked + returned * below)
        by_kind = jnp.where(is_hit, hit, jnp.where(reading > 0, no_return, too_close))
        return jnp.maximum(jnp.log(by_kind), LOG_IMPOSSIBLE)


def reading_law(sensor: SensorModel, limits: RangeLimits) -> ReadingLaw:
    """Return the law of a sensor model. Raises `BadInput` if the model has no `kernel_parameters`."""
    parameters = sensor.kernel_parameters()
    if parameters is None:
        fault = f"{type(sensor).__name__} has no likelihood on JAX, because it gives no kernel_parameters()"
        raise BadInput(f"mapping_model: {fault}; use Gaussian, StudentT or BeamMixture")
    return ReadingLaw(parameters, limits)


CELLS_AT_ONCE = 16  # number of a beam's cells that are read at once
BEAMS_AT_ONCE = 8  # number of a cell's beams that are read at once


@dataclasses.dataclass(frozen=True, eq=False)
class BeamGeometry:
    """The cells that each of B beams crosses on a grid of N cells, and their distances.
    Position l of a beam is the l-th cell that it touches. A geometry is compared and hashed by content, so that it may
    be a static part of JAX's trees: models of equal geometry share one compilation, and traces hold no copies of it.
    """

    shape: tuple[int, int]  # shape of the grid
    # Flat indices x * ny + y in the order of touch, then sentinels N, which count as walls: (B, L + CELLS_AT_ONCE).
    cells: NDArray[np.int32]
    distance_m: NDArray[np.float32]  # distances at which the beam hits these cells; inf at sentinels
    offsets: NDArray[np.int32]  # (N + 1,); cell c has the entries offsets[c] : offsets[c + 1] of the two arrays below
    crossing_beam: NDArray[np.int32]  # beam of each of K crossings with a cell, then padding, (K + BEAMS_AT_ONCE,)
    crossing_position: NDArray[np.int32]  # the cell's position in this beam, then padding, (K + BEAMS_AT_ONCE,)

    @property
    def n_beams(self) -> int:
        """B, the number of beams."""
        return len(self.cells)

    @property
    def n_cells(self) -> int:
        """N, the number of cells of the grid."""
        return self.shape[0] * self.shape[1]

    @property
    def n_outcomes(self) -> int:
        """L + 1, the number of outcomes of the longest beam. Its last position is a sentinel."""
        return int(self.cells.shape[1]) - CELLS_AT_ONCE + 1

    @cached_property
    def _digest(self) -> bytes:
        """The hash of all fields."""
        digest = hashlib.sha256()
        for f in dataclasses.fields(self):
            array = np.asarray(getattr(self, f.name))
            digest.update(repr((array.shape, array.dtype)).encode() + array.tobytes())
        return digest.digest()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, BeamGeometry) and self._digest == other._digest

    def __hash__(self) -> int:
        return hash(self._digest)

    def __repr__(self) -> str:
        return f"BeamGeometry({self.n_beams} beams on {self.shape[0]} x {self.shape[1]} cells)"


def beam_geometry(
    grid: Grid, poses: ArrayLike, angles_rad: NDArray[np.float64], limits: RangeLimits, hit_depth: float
) -> BeamGeometry:
    """Trace the beams of S poses, shape (S, 3), and A angles: beam s * A + a is beam a of pose s."""
    from bayesmap.kernels.rays import trace_rays  # loads Warp

    # Trace the beams, for which the ranges do not matter.
    no_ranges = np.zeros((len(np.atleast_2d(poses)), len(angles_rad)))
    scans = Scans(poses, angles_rad, no_ranges, limits.max_m, limits.min_m)  # type: ignore[arg-type]
    rays = trace_rays(scans, grid)
    # Pad the cells and distances of each beam with sentinels.
    beam = rays.beam_of_entry()
    position = (np.arange(rays.n_incidences) - rays.offsets[beam]).astype(np.int32)
    width = int(rays.lengths.max(initial=0)) + CELLS_AT_ONCE
    cells = np.full((rays.n_beams, width), grid.n_cells, dtype=np.int32)
    distance_m = np.full((rays.n_beams, width), np.inf, dtype=np.float32)
    cells[beam, position] = rays.cells
    distance_m[beam, position] = rays.stop_distance_m(hit_depth)
    # Sort the beams by the cells that they cross.
    by_cell = np.argsort(rays.cells, kind="stable")
    offsets = np.zeros(grid.n_cells + 1, dtype=np.int32)
    np.cumsum(np.bincount(rays.cells, minlength=grid.n_cells), out=offsets[1:])
    padding = np.zeros(BEAMS_AT_ONCE, dtype=np.int32)
    beam, position = (np.concatenate([entries[by_cell], padding]) for entries in (beam, position))
    return BeamGeometry(grid.shape, cells, distance_m, offsets, beam, position)


class ReadingsTrace(Trace):
    """Base of sensors' traces, with the choice `readings`. The score is computed when read, so that it cannot drift."""

    readings: Any

    def get_retval(self) -> Any:
        return self.readings

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.choice(self.readings)

    @property
    def hits(self) -> Any:
        """The first hits of all beams, in the form that the sensor's `find_hits` returns."""
        raise NotImplementedError


class RangeSensor(GenerativeFunction):
    """Base of sensors. The choice at () is the readings in metres, which follow `law`. Sensors define four methods."""

    law: ReadingLaw

    def find_hits(self, args: Arguments) -> Any:
        """Return the first hits of all beams, in the form that traces store as `hits`."""
        raise NotImplementedError

    def law_args(self, args: Arguments, hits: Any) -> Arguments:
        """Return the law's arguments: the distances of the hits, in the shape of the readings."""
        raise NotImplementedError

    def trace(self, args: Arguments, hits: Any, readings: Any) -> Trace:
        """Return the trace of a run with these hits and readings."""
        raise NotImplementedError

    def change_hits(self, trace: Any, args: Arguments, tangents: Sequence[Change]) -> tuple[Any, Weight] | None:
        """Return (first hits after a change of arguments, change of the log-likelihood); None for a large change."""
        raise NotImplementedError

    def simulate(self, key: PRNGKey, args: Arguments) -> Trace:
        hits = self.find_hits(args)
        return self.trace(args, hits, self.law.draw(key, self.law_args(args, hits)))

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        """Return (log-likelihood of the readings in `choices`, readings)."""
        return self.law.assess(choices, self.law_args(args, self.find_hits(args)))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        """Return the trace of the given readings and of draws elsewhere, weighted by the given ones' likelihood."""
        hits = self.find_hits(args)
        inner, weight = self.law.generate(key, constraint, self.law_args(args, hits))
        return self.trace(args, hits, inner.get_retval()), weight

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        """Return the log-likelihood if the readings are selected, else 0."""
        score = trace.get_score()
        return score if selection.check() else jnp.zeros_like(score)

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit the readings by the law's edit. If they are unchanged, change only the hits, by `change_hits`."""
        keeps_readings = False
        match request:
            case IndexRequest(i, Update(constraint)):
                request, keeps_readings = Update(constraint.extend(i)), constraint.static_is_empty()
            case Update(constraint):
                keeps_readings = constraint.static_is_empty()
            case Regenerate(selection):
                keeps_readings = not selection.check()
        args, args_unchanged = Diff.tree_primal(argdiffs), Diff.static_check_no_change(argdiffs)
        if keeps_readings and args_unchanged:
            return EmptyRequest().edit(key, trace, argdiffs)
        change = self.change_hits(trace, args, Diff.tangents(argdiffs)) if keeps_readings else None
        if change is not None:
            hits, weight = change
            new = self.trace(args, hits, trace.readings)
            return new, weight, Diff.no_change(trace.readings), Update(ChoiceMap.empty())
        # Otherwise find all hits again, and let the law edit the readings.
        hits = trace.hits if args_unchanged else self.find_hits(args)
        old = DistributionTrace(self.law, self.law_args(args, trace.hits), trace.readings, trace.get_score())
        law_diffs = Diff.unknown_change(self.law_args(args, hits))
        inner, weight, retdiff, backward = self.law.edit(key, old, request, law_diffs)
        return self.trace(args, hits, inner.get_retval()), weight, retdiff, backward


def checked_walls(walls: Any, shape: tuple[int, int]) -> Any:
    """Return the walls as an array. Raises `BadInput` unless they have the grid's shape."""
    if jnp.shape(walls) != shape:
        raise BadInput(f"sensor model: the argument walls has shape {jnp.shape(walls)}, expected {shape}")
    return jnp.asarray(walls)


@dataclass
class BeamTrace(ReadingsTrace):
    """The trace of a `BeamSensor`: readings with the first hits of their beams."""

    first_hit: Any  # (B,) unsigned, the position of each beam's first wall
    readings: Any  # metres, in the sensor's `readings_shape`

    @property
    def hits(self) -> Any:
        return self.first_hit

    def get_score(self) -> Score:
        sensor: BeamSensor = self.gen_fn
        readings = self.readings.reshape(self.first_hit.shape)
        return sensor.law.logpdf(readings, sensor.distances_at(self.first_hit)).sum(axis=-1)  # type: ignore[no-any-return]


@dataclass
class BeamSensor(RangeSensor):
    """`sensor(walls)`: walls of shape (nx, ny), readings in metres of shape `readings_shape`, at the address ()."""

    geometry: BeamGeometry = static()
    law: ReadingLaw = static()
    readings_shape: tuple[int, ...] = static()

    def find_hits(self, args: Arguments) -> Any:
        """Return the position of each beam's first wall, (B,), by a search through the cells of all beams."""
        (walls,), geometry = args, self.geometry
        cells = geometry.cells[:, : geometry.n_outcomes]
        is_wall = jnp.append(checked_walls(walls, geometry.shape).reshape(-1) != 0, True)  # the sentinel is a wall
        positions = jnp.arange(geometry.n_outcomes, dtype=np.min_scalar_type(geometry.n_outcomes))
        return jnp.where(is_wall[cells], positions, positions[-1]).min(axis=1)

    def distances_at(self, first_hit: Any) -> Any:
        """Return the distances in metres of the first walls, (..., B); inf where there is none."""
        return jnp.asarray(self.geometry.distance_m)[jnp.arange(self.geometry.n_beams), first_hit]

    def law_args(self, args: Arguments, hits: Any) -> Arguments:
        return (self.distances_at(hits).reshape(self.readings_shape),)

    def trace(self, args: Arguments, hits: Any, readings: Any) -> BeamTrace:
        return BeamTrace(self, args, hits, readings)

    def change_hits(self, trace: Any, args: Arguments, tangents: Sequence[Change]) -> tuple[Any, Weight] | None:
        """Return (first hits, change of the log-likelihood) if only some cells changed; else None."""
        match tangents:
            case [IndexChange((i, j))]:
                return self._change_cells(trace.first_hit, trace.readings, args[0], i, j)  # type: ignore[no-any-return]
        return None

    @partial(jax.jit, inline=True)  # else every edit outside of `jit` would compile its loops again
    def _change_cells(self, first_hit: Any, readings: Any, walls: Any, i: Any, j: Any) -> tuple[Any, Weight]:
        """Return the first hits, and the change of the log-likelihood, after the cells (i, j) changed to `walls`.
        Each cell is compared with the new map in turn. A beam that loses its hit goes to the next wall of the new map,
        and a wall that appears before a hit replaces it, so that the order of the cells does not matter.
        """
        # No operation here may touch the whole map, not even to flatten it: XLA would fuse the operation with the write
        # that made the map, and would write twice, into two copies.
        walls, (nx, ny) = checked_walls(walls, self.geometry.shape), self.geometry.shape
        i, j = jnp.asarray(i, jnp.int32), jnp.asarray(j, jnp.int32)
        cells = jnp.ravel(jnp.where(i < 0, i + nx, i) * ny + jnp.where(j < 0, j + ny, j))
        readings = readings.reshape(-1)
        if len(cells) == 1:
            return self._change_cell(walls, cells[0], first_hit, readings)

        def change(k: Any, state: tuple[Any, Any]) -> tuple[Any, Any]:
            first_hit, gain = self._change_cell(walls, cells[k], state[0], readings)
            return first_hit, state[1] + gain

        return jax.lax.fori_loop(0, len(cells), change, (first_hit, jnp.zeros((), readings.dtype)))  # type: ignore[no-any-return]

    def _change_cell(self, walls: Any, cell: Any, first_hit: Any, readings: Any) -> tuple[Any, Weight]:
        """Return (first hits, change of the log-likelihood) after one cell changed, by groups of the cell's beams."""
        geometry = self.geometry
        is_wall = self._is_wall(walls, cell)
        offsets, beams, positions = map(
            jnp.asarray, (geometry.offsets, geometry.crossing_beam, geometry.crossing_position)
        )
        distance_m = jnp.asarray(geometry.distance_m)
        end = offsets[cell + 1]

        def change_group(state: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
            k, first_hit, weight = state
            valid = k + jnp.arange(BEAMS_AT_ONCE, dtype=jnp.int32) < end  # the last group ends with padding
            beam = jax.lax.dynamic_slice(beams, (k,), (BEAMS_AT_ONCE,))
            position = jax.lax.dynamic_slice(positions, (k,), (BEAMS_AT_ONCE,))
            # A beam whose wall is removed goes on to its next wall; a new wall before the hit replaces the hit.
            old = first_hit[beam].astype(jnp.int32)
            uncovered = valid & ~is_wall & (position == old)
            new = jnp.where(valid & is_wall, jnp.minimum(position, old), old)
            new = self._next_walls(walls, beam, new, uncovered)
            gain = self.law.logpdf(readings[beam], distance_m[beam, new])
            gain -= self.law.logpdf(readings[beam], distance_m[beam, old])
            weight += jnp.where(new != old, gain, 0.0).sum()
            target = jnp.where(valid, beam, geometry.n_beams)  # padding has a target that is dropped
            first_hit = first_hit.at[target].set(new.astype(first_hit.dtype), mode="drop")
            return k + BEAMS_AT_ONCE, first_hit, weight

        start = (offsets[cell], first_hit, jnp.zeros((), readings.dtype))
        _, first_hit, weight = jax.lax.while_loop(lambda state: state[0] < end, change_group, start)
        return first_hit, weight

    def _is_wall(self, walls: Any, cell: Any) -> Any:
        """Return whether the cells with these flat indices are walls."""
        ny = self.geometry.shape[1]
        return walls[cell // ny, cell % ny] != 0

    def _next_walls(self, walls: Any, beam: Any, position: Any, uncovered: Any) -> Any:
        """Return the next walls behind `position` for uncovered beams, and `position` for others, (BEAMS_AT_ONCE,)."""
        cells, n_cells = jnp.asarray(self.geometry.cells), self.geometry.n_cells
        steps = jnp.arange(CELLS_AT_ONCE, dtype=jnp.int32)

        def search(state: tuple[Any, Any]) -> tuple[Any, Any]:
            position, searching = state
            next_cells = cells[beam[:, None], position[:, None] + 1 + steps]
            is_wall = (next_cells == n_cells) | self._is_wall(walls, jnp.minimum(next_cells, n_cells - 1))
            step = jnp.where(is_wall, steps, CELLS_AT_ONCE).min(axis=1)
            hit = step < CELLS_AT_ONCE
            position = jnp.where(searching, position + jnp.where(hit, step + 1, CELLS_AT_ONCE), position)
            return position, searching & ~hit

        position, _ = jax.lax.while_loop(lambda state: state[1].any(), search, (position, uncovered))
        return position
