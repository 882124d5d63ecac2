"""Compute quantiles of the range that a beam will read, from the mixture of its stops
(`bayesmap.kernels.predict.stop_mixture`).

They are found by halving the span of ranges. Under the robust mixture the stops that lie far before or behind what is
left of it need not be asked again: so a beam costs a few times its number of stops, and not that times the halvings.
"""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.predict.density import are_typed, law_with_cumulative
from bayesmap.kernels.predict.stop_mixture import (
    LEAST_WEIGHT,
    StopMixture,
    StopMixtureArrays,
    mixture_below,
    stops_to_device,
)
from bayesmap.kernels.sensor_law import MIXTURE, SensorLaw64, is_before, is_behind, met_or_returned, random_below
from bayesmap.sensors.model import SensorModel

wp.set_module_options({"enable_backward": False, "max_unroll": 1})  # halvings unrolled take minutes to compile

Floats = NDArray[np.float64]
HALVINGS = wp.constant(15)  # of the span of ranges: quantiles are off by at most a 30 000th of it


@wp.struct
class LevelSearch:
    """The search for the range of a level, between two ranges, and the stops that are not decided yet.

    Of those before ``begin`` all that returns lies below, of those from ``end`` on behind.
    """

    low: wp.float64
    high: wp.float64
    begin: int
    end: int
    below: wp.float64  # of the stops before begin: weight times the chance of a reading that is not random
    behind: wp.float64  # of those from end on: weight
    total: wp.float64  # of all


@wp.func
def begin_search(stops: StopMixtureArrays, b: int, low_m: wp.float64) -> LevelSearch:
    """Start a search at a range, with all stops undecided."""
    s = LevelSearch()
    s.low = low_m
    s.begin = stops.offsets[b]
    s.total = stops.no_stop[b]
    for k in range(stops.offsets[b], stops.offsets[b + 1]):
        s.total += wp.float64(stops.weight[k])
    return s


@wp.func
def search_to(s: LevelSearch, stops: StopMixtureArrays, b: int, high_m: wp.float64) -> LevelSearch:
    """Extend the search up to a range; stops that lie before it stay decided."""
    s.high = high_m
    s.end = stops.offsets[b + 1]
    s.behind = stops.no_stop[b]
    return s


@wp.func
def halved(law: SensorLaw64, stops: StopMixtureArrays, s: LevelSearch, level: wp.float64) -> LevelSearch:
    """Return the half of the span that holds the level, for the robust mixture; stops that are decided are asked only
    once.
    """
    z = wp.float64(0.5) * (s.low + s.high)
    decay = wp.exp(-law.rate_short_per_m * z)
    p = s.below + s.behind * law.p_short * (wp.float64(1.0) - decay)
    for k in range(s.begin, s.end):
        weight = wp.float64(stops.weight[k])
        if weight > LEAST_WEIGHT:
            at = wp.float64(stops.distance_m[k])
            p += weight * met_or_returned(law, z, decay, at, wp.float64(stops.variance[k]))
    if s.total * random_below(law, z) + law.p_known * p < level:
        s.low = z
        going = bool(True)
        while going and s.begin < s.end:
            k = s.begin
            at = wp.float64(stops.distance_m[k])
            variance = wp.float64(stops.variance[k])
            weight = wp.float64(stops.weight[k])
            going = is_before(law, z, at, variance) or weight <= LEAST_WEIGHT
            if going:
                if weight > LEAST_WEIGHT:
                    s.below += weight * met_or_returned(law, z, decay, at, variance)
                s.begin += 1
    else:
        s.high = z
        going = bool(True)
        while going and s.begin < s.end:
            k = s.end - 1
            weight = wp.float64(stops.weight[k])
            behind = is_behind(law, z, wp.float64(stops.distance_m[k]), wp.float64(stops.variance[k]))
            going = behind or weight <= LEAST_WEIGHT
            if going:
                if weight > LEAST_WEIGHT:
                    s.behind += weight
                s.end -= 1
    return s


@wp.kernel
def find_quantiles(
    first: int,
    law: SensorLaw64,
    stops: StopMixtureArrays,
    levels: wp.array(dtype=wp.float64),
    low_m: wp.float64,
    high_m: wp.float64,
    quantiles: wp.array2d(dtype=wp.float64),
):
    """One thread per beam: halve the span of ranges until each quantile is found; levels rise."""
    b = first + wp.tid()
    at_low = mixture_below(law, stops, b, low_m)
    at_high = mixture_below(law, stops, b, high_m)
    start = low_m
    sought = begin_search(stops, b, low_m)
    for i in range(levels.shape[0]):
        level = levels[i]
        if level <= at_low:
            quantiles[b, i] = wp.float64(-wp.inf)
        elif level > at_high:
            quantiles[b, i] = wp.float64(wp.inf)
        elif law.kind == MIXTURE:
            sought = search_to(sought, stops, b, high_m)
            for _j in range(HALVINGS):
                sought = halved(law, stops, sought, level)
            quantiles[b, i] = sought.high
        else:
            low = start
            high = high_m
            for _j in range(HALVINGS):
                middle = wp.float64(0.5) * (low + high)
                if mixture_below(law, stops, b, middle) < level:
                    low = middle
                else:
                    high = middle
            quantiles[b, i] = high
            start = low


def range_quantiles(stops: StopMixture, levels: Floats, sensor: SensorModel, device: str = "cpu") -> Floats:
    """Compute the least range below which the reading falls with each probability, metres, (B, levels).

    No return counts as +inf, too close as -inf. A sensor that is noise alone may read past its limits: its quantiles
    are looked for from one range below zero to two ranges.

    Args:
        stops: where the beams stop.
        levels: rising probabilities.
        sensor: the law of a reading given where its beam stops.
        device: where to compute.
    """
    device = devices.resolve(device)
    limits = stops.rays.limits
    law = law_with_cumulative(sensor, limits, device)
    low, high = (limits.min_m, limits.max_m) if are_typed(sensor, limits) else (-limits.max_m, 2.0 * limits.max_m)
    beams = stops.rays.n_beams
    out = wp.empty((beams, len(levels)), dtype=wp.float64, device=device)
    inputs = [law, stops_to_device(stops, device), devices.to_device(np.asarray(levels), wp.float64, device)]
    devices.launch(find_quantiles, beams, [*inputs, wp.float64(low), wp.float64(high), out], device)
    return np.asarray(out.numpy())
