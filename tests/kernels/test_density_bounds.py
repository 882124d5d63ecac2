"""How likely and how unlikely a reading can be, wherever its beam stops: what a walk leaves unweighed goes by it."""

import numpy as np
import pytest
import warp as wp
from oracle.own_sensor import OwnSensor

import bayesmap as bm
from bayesmap.kernels.sensor_law import (
    SensorLaw32,
    highest_density,
    lowest_density,
    object_decay,
    sensor_law,
    stop_density,
)
from bayesmap.sensors.model import RangeLimits

wp.set_module_options({"enable_backward": False})

LIMITS = RangeLimits(0.1, 6.0)
COUNT = 40_000
SENSORS = {
    "normal": bm.BeamMixture(bm.Gaussian(0.02, 0.01), p_random=0.02, p_no_return=0.1, p_short=0.1),
    "sharp": bm.BeamMixture(bm.Gaussian(0.001, 0.0), p_random=0.001, p_no_return=0.0, p_short=0.3),
    "heavy tails": bm.BeamMixture(bm.StudentT(0.05), p_random=0.2, p_no_return=0.02, p_short=0.05),
}


@wp.kernel
def densities(
    law: SensorLaw32,
    reading_m: wp.array(dtype=wp.float32),
    distance_m: wp.array(dtype=wp.float32),
    variance: wp.array(dtype=wp.float32),
    out: wp.array2d(dtype=wp.float32),
):
    i = wp.tid()
    z = reading_m[i]
    out[0, i] = lowest_density(law, z)
    out[1, i] = stop_density(law, z, object_decay(law, z), distance_m[i], variance[i])
    out[2, i] = highest_density(law, z)


def lowest_any_highest(sensor):
    rng = np.random.default_rng(3)
    distance = rng.uniform(0.0, 9.0, COUNT)
    distance[:100] = np.inf
    reading = np.where(rng.random(COUNT) < 0.5, distance + rng.normal(0, 0.01, COUNT), rng.uniform(0.1, 6.0, COUNT))
    reading = np.where(np.isfinite(reading) & (reading > 0.1) & (reading < 6.0), reading, np.inf)
    reading[rng.random(COUNT) < 0.1] = -np.inf
    variance = rng.choice([0.0, 1e-6, 1e-4, 0.01], COUNT)
    arrays = [wp.array(x.astype(np.float32), dtype=wp.float32, device="cpu") for x in (reading, distance, variance)]
    out = wp.zeros((3, COUNT), dtype=wp.float32, device="cpu")
    law = sensor_law(sensor, LIMITS, "cpu", SensorLaw32)
    wp.launch(densities, dim=COUNT, inputs=[law, *arrays, out], device="cpu")
    return reading, *out.numpy()


@pytest.mark.parametrize("name", SENSORS)
def test_no_density_lies_outside_its_bounds_and_some_come_close(name):
    reading, lowest, density, highest = lowest_any_highest(SENSORS[name])
    assert (density >= 0.999 * lowest).all()
    assert (density <= 1.001 * highest).all()
    hit = np.isfinite(reading)
    assert density[hit].min() < 1.1 * lowest[hit].min()
    assert density[hit].max() > 0.5 * highest[hit].max()  # the twin: half of the bound would be too low
    assert (density[np.isposinf(reading)] < 2 * lowest[np.isposinf(reading)]).any()


def test_of_a_law_that_is_tabulated_nothing_is_taken_for_granted():
    _, lowest, _, highest = lowest_any_highest(OwnSensor(bm.Gaussian(0.2)))
    assert (lowest == 0).all()
    assert np.isinf(highest).all()
