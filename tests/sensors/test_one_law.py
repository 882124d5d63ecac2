"""The law of a reading is one: NumPy's, both precisions of the compiled one, and JAX's say the same."""

from typing import Any

import numpy as np
import pytest
import warp as wp
from sensor_cases import ALL, LIMITS

from bayesmap.kernels import device as devices
from bayesmap.kernels.sensor_law import SensorLaw32, SensorLaw64, cumulative, object_decay, sensor_law, stop_log_density

wp.set_module_options({"enable_backward": False})

READINGS = np.concatenate([np.linspace(0.31, 7.9, 60), [np.inf, -np.inf]])
DISTANCES = np.concatenate([np.linspace(0.02, 7.95, 70), [8.5, np.inf]])
PRECISIONS = {"double": (SensorLaw64, wp.float64, 1e-9), "single": (SensorLaw32, wp.float32, 3e-3)}


@wp.kernel
def densities(law: Any, z: wp.array(dtype=Any), d: wp.array(dtype=Any), v: wp.array(dtype=Any),
              out: wp.array(dtype=Any), below: wp.array(dtype=Any)):  # fmt: skip
    i = wp.tid()
    out[i] = stop_log_density(law, z[i], object_decay(law, z[i]), d[i], v[i])
    below[i] = cumulative(law, wp.clamp(z[i], law.min_m, law.max_m), d[i], v[i])


def compiled(sensor, z, d, spread, precision):
    devices.start()
    law, real, _ = PRECISIONS[precision]
    inputs = [wp.array(a.ravel(), dtype=real, device="cpu") for a in np.broadcast_arrays(z, d, np.asarray(spread) ** 2)]
    out = [wp.zeros(inputs[0].shape, dtype=real, device="cpu") for _ in range(2)]
    inputs = [sensor_law(sensor, LIMITS, "cpu", law), *inputs, *out]
    wp.launch(densities, dim=inputs[1].shape[0], inputs=inputs, device="cpu")
    shape = np.broadcast_shapes(np.shape(z), np.shape(d), np.shape(spread))
    return [a.numpy().reshape(shape).astype(float) for a in out]


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("name", ALL)
def test_the_compiled_law_is_numpy_s(name, precision):
    """On all readings, distances and two spreads of the stop, which are axes of an array."""
    z, d, spread = READINGS[:, None, None], DISTANCES[:, None], np.array([0.0, 0.15])
    found, below = compiled(ALL[name], z, d, spread, precision)
    expected = ALL[name].stop_log_likelihood(z, d, spread, LIMITS)
    close = PRECISIONS[precision][2]
    # Single precision knows the probabilities of typed readings as differences of numbers near one.
    certain = (np.isfinite(z) & (d >= 0)) | (expected > (-18.0 if precision == "double" else -6.0))
    np.testing.assert_allclose(found[certain], expected[certain], rtol=close, atol=close)
    np.testing.assert_allclose(np.exp(found[~certain]), np.exp(expected[~certain]), atol=1e-6)
    inside = np.clip(z, LIMITS.min_m, LIMITS.max_m)
    np.testing.assert_allclose(
        below, ALL[name].cumulative(inside, d, LIMITS, spread_m=spread), atol=max(1e-9, close / 30)
    )


@pytest.mark.parametrize("name", ALL)
def test_jax_s_law_is_numpy_s(name):
    import jax.numpy as jnp

    from bayesmap.programs.beam_sensor import reading_law

    z, d = np.broadcast_arrays(READINGS[:, None], DISTANCES[None])
    found = reading_law(ALL[name], LIMITS).logpdf(jnp.asarray(z), jnp.asarray(d))
    np.testing.assert_allclose(found, ALL[name].log_likelihood(z, d, LIMITS), rtol=2e-3, atol=2e-3)
