"""The compiled density of readings given cells that stop some beams, and the prior's, equal the plain reference."""

from dataclasses import replace

import numpy as np
import pytest
import warp as wp
from oracle.stop_law import draw_readings, draw_states, log_likelihoods, log_prior, paths_of
from oracle.stop_worlds import Worlds, beam_rays, centres_of, draw_worlds
from oracle.worlds import OwnSensor

import bayesmap as bm
from bayesmap.kernels.device import Float32Rows, Float32s
from bayesmap.kernels.predict.density import log_densities
from bayesmap.kernels.sensor_law import (
    SensorLaw32,
    highest_density,
    lowest_density,
    object_decay,
    sensor_law,
    stop_density,
)
from bayesmap.samplers.stop_problem import trace_stops
from bayesmap.sensors.model import RangeLimits

wp.set_module_options({"enable_backward": False})

SENSOR = bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_random=0.05, p_no_return=0.1, p_short=0.1, rate_short_per_m=0.6)
SHARP = bm.BeamMixture(bm.Gaussian(0.004, 0.001), p_random=0.01, p_no_return=0.0, p_short=0.02)
TAILS = bm.BeamMixture(bm.StudentT(0.02, 3.0, 0.005), p_random=0.02, p_no_return=0.1, p_short=0.1)
LONE = bm.Grid((5, 2), 0.4)
PRIORS = {
    "reflectivities": bm.Beta(0.8, 1.5), "reflectivities by default": bm.Beta(), "surfaces": bm.Surface(0.8, 1.5),
    "thin surfaces": bm.Surface(0.8, 1.5, mean_scale=0.6, spread=0.05, dof=4.0), "surfaces by default": bm.Surface(),
}  # fmt: skip
# Single precision: a density is off by 1e-6 of itself, more where a surface is seen edge on.
CLOSE = {"rtol": 3e-4, "atol": 3e-4}


def kernel_log_likelihoods(worlds, truth):
    """Log-likelihoods of every beam under the given states, as a sweep computes them on the way."""
    sampler = worlds.sampler(1, truth)
    total, prior = sampler.sweep()
    return sampler.arrays.log_likelihood.numpy(), total[0], prior[0]


@pytest.mark.parametrize("sensor", [SENSOR, SHARP, TAILS], ids=["blunt", "sharp", "heavy tails"])
@pytest.mark.parametrize("name", PRIORS)
def test_a_sweep_s_log_likelihood_is_the_reference_s(name, sensor):
    prior = PRIORS[name]
    worlds, truth = draw_worlds([7, len(name)], LONE, prior, sensor, 300, poses=2, beams=6)
    paths = paths_of(worlds.problem.rays)
    assert paths.far.sum() > 50
    mine, total, _ = kernel_log_likelihoods(worlds, truth)
    expected = log_likelihoods(paths, truth.astype(np.float32).astype(float), sensor, not isinstance(prior, bm.Surface))
    np.testing.assert_allclose(mine, expected, **CLOSE)
    assert total == pytest.approx(expected.sum(), rel=1e-4)


@pytest.mark.parametrize("noise", [bm.Gaussian(0.02, 0.003), bm.StudentT(0.01, 3.0, 0.002)], ids=["normal", "t"])
@pytest.mark.parametrize("name", ["surfaces", "surfaces by default", "reflectivities by default"])
def test_stops_far_from_the_reading_that_count_as_random_readings_hardly_matter(name, noise):
    """Readings of prior surfaces, whose spread has heavy tails, with the shortcut and with every entry's own law: the
    shortcut costs less than 0.005 nats a beam, and nothing where cells have no surfaces and noise has no heavy tails.
    """
    prior = PRIORS[name]
    plain = not isinstance(prior, bm.Surface)
    grid = bm.Grid((24, 2), 0.1)
    sensor = bm.BeamMixture(noise, p_random=0.02, p_no_return=0.01, p_short=0.02)
    rng = np.random.default_rng(10)
    poses = np.column_stack([np.full(400, -0.05), rng.uniform(0.02, 0.18, 400), np.zeros(400)])
    scans = bm.Scans(poses, [-0.03, 0.0, 0.03], np.ones((400, 3)), max_range_m=2.6)
    whole = beam_rays(scans, grid, margin_m=np.inf, whole=True)
    lost, far = [], 0
    for _ in range(5):
        states = draw_states(rng, prior, centres_of(whole))
        readings = draw_readings(rng, paths_of(whole, far=False), states, sensor, plain)
        rays = trace_stops(replace(scans, ranges_m=readings.reshape(400, 3)), grid, prior, sensor).rays
        np.testing.assert_array_equal(rays.touched, whole.touched)
        short, full = paths_of(rays), paths_of(replace(whole, range_m=readings), far=False)
        lost.append(log_likelihoods(full, states, sensor, plain) - log_likelihoods(short, states, sensor, plain))
        far += short.far.sum()
    assert far > 1000
    most = 5e-3 if not plain else 1e-9 if isinstance(noise, bm.Gaussian) else 1e-4
    assert np.mean(np.abs(lost)) < most


@pytest.mark.parametrize("name", PRIORS)
def test_the_log_prior_is_the_reference_s_but_for_its_constant(name):
    """The constant depends on the prior alone: sums over the same cells differ by the same number in all states."""
    prior = PRIORS[name]
    worlds, _ = draw_worlds([11, 0], bm.Grid((2, 2), 0.4), prior, SENSOR, 4, poses=1, beams=3)
    rng, centres = np.random.default_rng(12), centres_of(worlds.problem.rays)
    off = []
    for _ in range(20):
        state = draw_states(rng, prior, centres).astype(np.float32)
        state[:, 0] = np.clip(state[:, 0], 1e-25, 1 - 1e-6)
        _, _, mine = kernel_log_likelihoods(worlds, state)
        off.append(mine - log_prior(prior, state.astype(float), centres).sum())
    assert np.ptp(off) < 1e-3 * (1 + abs(np.mean(off)))


@pytest.mark.parametrize("plain", [True, False])
def test_nothing_is_impossible_but_no_density_is_nan(plain):
    """Cells that stop everything, or nothing, and readings that such cells cannot give."""
    prior = bm.Beta(1, 1) if plain else bm.Surface(1, 1)
    sensor = bm.BeamMixture(bm.Gaussian(0.01), p_random=1e-3, p_no_return=0.0, p_short=0.0)
    readings = np.array([[0.9, np.inf, -np.inf, np.nan, 0.0, 3.0]])
    scans = bm.Scans([-0.3, 0.3, 0.0], np.linspace(-0.2, 0.2, 6), readings, max_range_m=3.0)
    problem = trace_stops(scans, LONE, prior, sensor)
    for m in (0.0, 1.0, 1e-30, 1 - 1e-7):
        states = np.zeros((len(problem.rays.touched), 6))
        states[:, 0], states[:, 3], states[:, 5] = m, 0.1, 0.1
        states[:, 1:3] = centres_of(problem.rays)[0]
        worlds = Worlds(problem, LONE.shape, 1)
        sampler = worlds.sampler(1, states)
        for beta in (1.0, 1.0, 0.5, 0.0):
            log_likelihood, _ = sampler.sweep(beta=beta)
            assert np.isfinite(log_likelihood).all()
            hits, met = sampler.counts()
            assert hits.min() >= 0
            assert max(hits.max(), met.max()) <= 5
        batch = states[None].astype(np.float32)
        found = log_densities(problem.rays, [batch[..., 0] if plain else batch], sensor, 0.5)
        assert np.isfinite(found[~np.isnan(readings[0])]).all()


LIMITS = RangeLimits(0.1, 6.0)
COUNT = 40_000
BOUNDED = {
    "normal": bm.BeamMixture(bm.Gaussian(0.02, 0.01), p_random=0.02, p_no_return=0.1, p_short=0.1),
    "sharp": bm.BeamMixture(bm.Gaussian(0.001, 0.0), p_random=0.001, p_no_return=0.0, p_short=0.3),
    "heavy tails": bm.BeamMixture(bm.StudentT(0.05), p_random=0.2, p_no_return=0.02, p_short=0.05),
}


@wp.kernel
def densities(law: SensorLaw32, reading_m: Float32s, distance_m: Float32s, variance: Float32s, out: Float32Rows):
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


@pytest.mark.parametrize("name", BOUNDED)
def test_no_density_lies_outside_its_bounds_and_some_come_close(name):
    reading, lowest, density, highest = lowest_any_highest(BOUNDED[name])
    assert (density >= 0.999 * lowest).all()
    assert (density <= 1.001 * highest).all()
    hit = np.isfinite(reading)
    assert density[hit].min() < 1.1 * lowest[hit].min()
    assert density[hit].max() > 0.5 * highest[hit].max()  # the twin: half of the bound would be too low
    assert (density[np.isposinf(reading)] < 2 * lowest[np.isposinf(reading)]).any()
    if name == "normal":  # a tabulated law has no bounds
        _, lowest, _, highest = lowest_any_highest(OwnSensor(bm.Gaussian(0.2)))
        assert (lowest == 0).all()
        assert np.isinf(highest).all()
