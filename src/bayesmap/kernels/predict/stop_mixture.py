"""Mix the stops of beams over draws, and predict from the mixture: chances of first hits, and quantiles of ranges.

The predictive law is linear in the weights of stops, so a prediction needs only their means over the draws. The stops
in one cell are merged into one with their mean distance; their scatter is added to its spread.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels import sensor_law as laws
from bayesmap.kernels.device import ONE, Float32s, Float64Rows, Float64s, Floats, Int32s, Ints, Singles
from bayesmap.kernels.predict import density
from bayesmap.kernels.predict.density import DeviceMaps, MapArrays, StopStates
from bayesmap.kernels.rays import RayArrays, chord, distance_at, line_of, rays_to_device, stop_distances
from bayesmap.kernels.sensor_law import MIXTURE, SensorLaw64
from bayesmap.sensors.model import SensorModel

wp.set_module_options({"enable_backward": False, "max_unroll": 1})  # halvings unrolled take minutes to compile
MIN_EVENT_CHANCE = wp.constant(wp.float64(1.0e-12))  # least chance of an event, and of getting to it
MIN_WEIGHT = wp.constant(wp.float64(1.0e-10))  # stops of less weight are skipped: a thousand of them add nothing
MAX_EVENT_CHANCE = wp.constant(wp.float64(1.0 - 1.0e-7))  # largest chance that single precision distinguishes from one
HALVINGS = wp.constant(15)  # halvings of the span of ranges: quantiles are off by at most 1 / 30 000 of it


@wp.struct
class StopSums:
    """Sums over draws, per entry and per beam."""

    weight: Float32s  # weight of the stop at each entry
    shift: Float32s  # weighted distance of the stop, from where it is without a surface
    square: Float32s  # weighted square of this distance, variance included
    no_stop: Float64s  # chance that a beam stops nowhere


@wp.kernel
def add_stops(first: int, rays: RayArrays, columns: Int32s, maps: MapArrays, min_survival: wp.float64, out: StopSums):
    """One thread per beam: add each stop's weight and moments, until the beam's chance is below ``min_survival``."""
    beam = first + wp.tid()
    line = line_of(rays.lines, beam)
    for draw in range(maps.draws):
        survive = wp.float64(1.0)
        for entry in range(rays.offsets[beam], rays.offsets[beam + 1]):
            # stop: chance, distance, variance
            stop = density.stop_in(maps, draw, columns[entry], line, rays.cells[entry])
            weight = survive * stop[0]
            survive = survive * (wp.float64(1.0) - stop[0])
            if weight > wp.float64(0.0):
                out.weight[entry] = out.weight[entry] + wp.float32(weight)
                if maps.has_surfaces != 0:
                    shift = stop[1] - distance_at(line, rays.cells[entry], maps.depth)
                    out.shift[entry] = out.shift[entry] + wp.float32(weight * shift)
                    out.square[entry] = out.square[entry] + wp.float32(weight * (shift * shift + stop[2]))
                if survive < min_survival:
                    break
        out.no_stop[beam] = out.no_stop[beam] + survive


@dataclass(frozen=True, eq=False)
class StopMixture:
    """The stops of each beam: a mixture over the cells that it meets."""

    rays: Rays  # the beams, with K entries
    weight: Singles  # probability that the beam stops at the entry, (K,), float32
    distance_m: Singles  # mean distance of this stop, metres, (K,), float32
    spread_m: Singles  # standard deviation of the distance, metres, (K,), float32
    no_stop: Floats  # probability that the beam stops nowhere in the map, (B,)


def mix_stops(rays: Rays, batches: Iterable[StopStates], hit_depth: float, *, device: str = "cpu") -> StopMixture:
    """Average the stops of each beam over draws, see `density.forecast`. Raises `BadInput` if there are no draws."""
    device = devices.resolve(device)
    on_device = (density.maps_to_device(batch, hit_depth, device) for batch in batches)
    return _mix(rays, rays.columns, on_device, hit_depth, device, float(MIN_EVENT_CHANCE))


def mix_device_stops(rays: Rays, maps: DeviceMaps, min_survival: float) -> StopMixture:
    """Average the stops over draws of all cells. Below ``min_survival`` a beam counts as one that stops nowhere."""
    return _mix(rays, rays.cells, [maps.arrays], maps.arrays.depth, maps.device, min_survival)


def _mix(
    rays: Rays, columns: Ints, batches: Iterable[Any], hit_depth: float, device: str, min_survival: float
) -> StopMixture:
    """Average over batches of `MapArrays`; ``columns`` are the columns of the entries' cells in the maps."""
    entries = (rays.n_incidences,)
    sums = devices.pack(StopSums, device, weight=entries, shift=entries, square=entries, no_stop=(rays.n_beams,))
    rays_and_columns = [rays_to_device(rays, device), devices.to_device(columns, wp.int32, device)]
    draws = 0
    for maps in batches:
        draws += maps.draws
        inputs = [*rays_and_columns, maps, min_survival, sums]
        devices.launch(add_stops, rays.n_beams, inputs, device, devices.threads_for(rays.n_beams))
    density.require_draws(draws)
    weight, shift, square = (a.numpy() for a in (sums.weight, sums.shift, sums.square))
    total = np.where(weight > 0, weight, np.float32(1.0))
    mean = shift / total
    spread = np.sqrt(np.maximum(square / total - mean * mean, 0.0))
    distance_m = stop_distances(rays, hit_depth, device) + mean
    return StopMixture(rays, weight / np.float32(draws), distance_m, spread, sums.no_stop.numpy() / draws)


@wp.struct
class StopMixtureArrays:
    """A `StopMixture` on a device."""

    offsets: Int32s
    weight: Float32s
    distance_m: Float32s
    variance: Float32s
    no_stop: Float64s


@wp.func
def mixture_below(law: SensorLaw64, stops: StopMixtureArrays, beam: int, range_m: wp.float64) -> wp.float64:
    """Return P(reading <= range_m) of a beam."""
    p = stops.no_stop[beam] * laws.cumulative(law, range_m, wp.float64(wp.inf), wp.float64(0.0))
    for entry in range(stops.offsets[beam], stops.offsets[beam + 1]):
        weight = wp.float64(stops.weight[entry])
        if weight > MIN_WEIGHT:
            distance = wp.float64(stops.distance_m[entry])
            p += weight * laws.cumulative(law, range_m, distance, wp.float64(stops.variance[entry]))
    return p


@wp.kernel
def find_events(
    first: int, law: SensorLaw64, stops: StopMixtureArrays, rays: RayArrays, range_m: Float64s, chance: Float32s,
    stopped: wp.array(dtype=wp.int8),
):  # fmt: skip
    """One thread per beam: compute the chance that its reading ends in each chord, and whether it ends there."""
    # before, after: cumulative probability at the chord's two ends; stopped: stays -1 if the reading does not reach
    # the chord, or if the chord has no length.
    beam = first + wp.tid()
    z = range_m[beam]  # the reading
    if wp.isnan(z):
        return
    line = line_of(rays.lines, beam)
    before = wp.float64(-1.0)
    for entry in range(rays.offsets[beam], rays.offsets[beam + 1]):
        inside = chord(line, rays.cells[entry])
        enter, leave = inside[0], inside[1]
        if entry + 1 < rays.offsets[beam + 1]:
            leave = chord(line, rays.cells[entry + 1])[0]
        leave = wp.min(leave, law.max_m)
        if enter > z:
            break
        if leave > enter:
            if before < wp.float64(0.0):
                before = mixture_below(law, stops, beam, enter)
            after = mixture_below(law, stops, beam, leave)
            p = (after - before) / wp.max(ONE - before, MIN_EVENT_CHANCE)
            chance[entry] = wp.float32(wp.clamp(p, MIN_EVENT_CHANCE, MAX_EVENT_CHANCE))
            stopped[entry] = wp.where(z < leave, wp.int8(1), wp.int8(0))
            before = after


def stops_to_device(stops: StopMixture, device: str) -> Any:
    """Put a mixture on a device."""
    return devices.pack(
        StopMixtureArrays, device, offsets=stops.rays.offsets, weight=stops.weight, distance_m=stops.distance_m,
        variance=stops.spread_m**2, no_stop=stops.no_stop,
    )  # fmt: skip


def first_hit_events(stops: StopMixture, sensor: SensorModel, device: str = "cpu") -> tuple[Singles, NDArray[np.int8]]:
    """Predict, for each chord of a beam in a cell that its reading reaches, whether the reading ends there.
    With the beam's predictive cumulative F and the chord [a, b), the chance is (F(b) - F(a)) / (1 - F(a)). Returns
    chances and outcomes, (K,) each: 1 if the reading ended there, 0 if it went on, -1 without an event.
    """
    device = devices.resolve(device)
    rays, size = stops.rays, len(stops.weight)
    chance = wp.full(size, wp.nan, dtype=wp.float32, device=device)
    stopped = wp.full(size, -1, dtype=wp.int8, device=device)
    inputs = [density.law_with_cumulative(sensor, rays.limits, device), stops_to_device(stops, device)]
    inputs += [rays_to_device(rays, device), rays.range_m, chance, stopped]
    devices.launch(find_events, rays.n_beams, inputs, device, devices.threads_for(rays.n_beams))
    return chance.numpy(), stopped.numpy()


@wp.struct
class LevelSearch:
    """The search for the range of a level, which lies between ``low`` and ``high``."""

    low: wp.float64
    high: wp.float64
    begin: int  # stops before this entry return readings below the range
    end: int  # stops from this entry on return readings behind it
    below: wp.float64  # sum over stops before begin: weight times the chance of a reading that is not random
    behind: wp.float64  # weight of the stops from end on
    total: wp.float64  # weight of all stops


@wp.func
def halve_span(law: SensorLaw64, stops: StopMixtureArrays, search: LevelSearch, level: wp.float64) -> LevelSearch:
    """Return the half of the span that holds the level, for the robust mixture; decided stops are evaluated once."""
    # z: middle of the span; p: probability of a reading below z that is not random.
    z = wp.float64(0.5) * (search.low + search.high)
    decay = wp.exp(-law.rate_short_per_m * z)
    p = search.below + search.behind * law.p_short * (wp.float64(1.0) - decay)
    for entry in range(search.begin, search.end):
        weight = wp.float64(stops.weight[entry])
        if weight > MIN_WEIGHT:
            distance = wp.float64(stops.distance_m[entry])
            p += weight * laws.not_random_below(law, z, decay, distance, wp.float64(stops.variance[entry]))
    if search.total * laws.random_below(law, z) + law.p_not_random * p < level:
        # Upper half: decide the stops whose returns all lie below z.
        search.low = z
        is_decided = bool(True)
        while is_decided and search.begin < search.end:
            entry = search.begin
            distance = wp.float64(stops.distance_m[entry])
            variance = wp.float64(stops.variance[entry])
            weight = wp.float64(stops.weight[entry])
            is_decided = laws.is_before(law, z, distance, variance) or weight <= MIN_WEIGHT
            if is_decided:
                if weight > MIN_WEIGHT:
                    search.below += weight * laws.not_random_below(law, z, decay, distance, variance)
                search.begin += 1
    else:
        # Lower half: decide the stops whose returns all lie behind z.
        search.high = z
        is_decided = bool(True)
        while is_decided and search.begin < search.end:
            entry = search.end - 1
            weight = wp.float64(stops.weight[entry])
            is_past = laws.is_behind(law, z, wp.float64(stops.distance_m[entry]), wp.float64(stops.variance[entry]))
            is_decided = is_past or weight <= MIN_WEIGHT
            if is_decided:
                if weight > MIN_WEIGHT:
                    search.behind += weight
                search.end -= 1
    return search


@wp.kernel
def find_quantiles(
    first: int, law: SensorLaw64, stops: StopMixtureArrays, levels: Float64s, low_m: wp.float64, high_m: wp.float64,
    quantiles: Float64Rows,
):  # fmt: skip
    """One thread per beam: find each quantile by bisection of the span of ranges; levels are ascending."""
    beam = first + wp.tid()
    at_low, at_high = mixture_below(law, stops, beam, low_m), mixture_below(law, stops, beam, high_m)
    start = low_m
    search = LevelSearch()
    search.low = low_m
    search.begin = stops.offsets[beam]
    search.total = stops.no_stop[beam]
    for entry in range(stops.offsets[beam], stops.offsets[beam + 1]):
        search.total += wp.float64(stops.weight[entry])
    for i in range(levels.shape[0]):
        level = levels[i]
        if level <= at_low:
            quantiles[beam, i] = wp.float64(-wp.inf)
        elif level > at_high:
            quantiles[beam, i] = wp.float64(wp.inf)
        elif law.kind == MIXTURE:
            search.high = high_m  # stops before the last level's range stay decided
            search.end = stops.offsets[beam + 1]
            search.behind = stops.no_stop[beam]
            for _j in range(HALVINGS):
                search = halve_span(law, stops, search, level)
            quantiles[beam, i] = search.high
        else:
            low = start
            high = high_m
            for _j in range(HALVINGS):
                middle = wp.float64(0.5) * (low + high)
                if mixture_below(law, stops, beam, middle) < level:
                    low = middle
                else:
                    high = middle
            quantiles[beam, i] = high
            start = low


def range_quantiles(stops: StopMixture, levels: Floats, sensor: SensorModel, device: str = "cpu") -> Floats:
    """Compute quantiles of readings at ascending levels, metres, (B, levels); no return is inf, too close -inf."""
    device, limits, beams = devices.resolve(device), stops.rays.limits, stops.rays.n_beams
    law = density.law_with_cumulative(sensor, limits, device)
    typed = density.are_typed(sensor, limits)
    # A sensor that is noise alone may read from minus to twice its largest range.
    low, high = (limits.min_m, limits.max_m) if typed else (-limits.max_m, 2.0 * limits.max_m)
    inputs = [law, stops_to_device(stops, device), np.asarray(levels), low, high, (beams, len(levels))]
    return np.asarray(devices.launch(find_quantiles, beams, inputs, device)[0])
