"""Points of stops as the package draws them, many of one beam."""

import math
from functools import cache

import numpy as np
import warp as wp

from bayesmap.kernels import device
from bayesmap.kernels.random import mix
from bayesmap.kernels.sensor_law import SensorLaw32, object_decay, sensor_law
from bayesmap.kernels.surfaces.square_counts import stop_point_m


@wp.kernel
def points(
    law: SensorLaw32,
    reading: wp.float32,
    distance: wp.float32,
    variance: wp.float32,
    key: wp.uint64,
    out: wp.array(dtype=wp.float64),
):
    i = wp.tid()
    decay = object_decay(law, reading)
    out[i] = stop_point_m(law, reading, decay, distance, variance, key, wp.uint64(i) * wp.uint64(4))


law_of = cache(sensor_law)
"""The law of a model of the user's own is tabulated, which takes seconds."""


def draw_points(sensor, limits, reading_m, distance_m, spread_m, count, seed=0):
    """Distances at which a beam with this reading was stopped by a surface at about the distance, (count,), metres."""
    device.start()
    out = wp.zeros(count, dtype=wp.float64, device="cpu")
    law = law_of(sensor, limits, "cpu", SensorLaw32)
    inputs = [law, reading_m, distance_m, spread_m**2, mix(seed, math.floor(1e6 * spread_m)), out]
    wp.launch(points, dim=count, inputs=inputs, device="cpu")
    return np.array(out.numpy())
