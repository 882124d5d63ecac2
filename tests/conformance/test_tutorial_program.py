"""The tutorial runs with only its imports changed, and draws what it drew on GenJAX 0.10.3."""

import hashlib
from functools import partial

import jax
import jax.numpy as jnp
import jax.random as jrand
import numpy as np
import pytest
from gen_tutorial_model import CENTER, GRID_SIZE, PARAMS, angles, full_model, sensor_model, true_walls
from gen_tutorial_model import walls_prior as prior

import bayesmap.gen as genjax
from bayesmap.gen import ChoiceMapBuilder as C

ARGS = (CENTER, PARAMS)
# The tutorial calls genjax.categorical with positional logits, which warns here as it does in GenJAX.
pytestmark = pytest.mark.filterwarnings("ignore:a bare argument to categorical:DeprecationWarning")


def fingerprint(walls):
    return hashlib.sha256(np.asarray(walls).astype(np.uint8).tobytes()).hexdigest()[:12]


@pytest.fixture(scope="module")
def readings():
    args = (CENTER, true_walls, PARAMS.sensor_noise, angles(PARAMS.num_angles))
    return sensor_model.simulate(jrand.key(0), args).get_retval()


@pytest.fixture(scope="module")
def basic_chain(readings):
    return run_chain(jrand.key(0), gibbs_sweep, ARGS, readings, num_samples=6)


assess = jax.jit(full_model.assess)


def gibbs_update_pixel(key, args, readings, walls, i, j):
    false_weight, _ = assess(C["readings"].set(readings) | C["walls"].set(walls.at[i, j].set(0)), args)
    true_weight, _ = assess(C["readings"].set(readings) | C["walls"].set(walls.at[i, j].set(1)), args)
    return genjax.categorical.sample(key, jnp.array([false_weight, true_weight])).astype(jnp.float32)


def over_pixels(update, state):
    rows = lambda i, s: jax.lax.fori_loop(0, GRID_SIZE, lambda j, s: update(i, j, s), s)  # noqa: E731
    return jax.lax.fori_loop(0, GRID_SIZE, rows, state)


def gibbs_sweep(key, args, readings, walls):
    keys = jrand.split(key, walls.shape)
    return over_pixels(lambda i, j, w: w.at[i, j].set(gibbs_update_pixel(keys[i, j], args, readings, w, i, j)), walls)


def run_chain(key, sweep, args, readings, num_samples):
    key, *subkeys = jrand.split(key, num_samples + 1)

    @jax.jit
    def inner():
        step = lambda walls, key: (sweep(key, args, readings, walls), walls)  # noqa: E731
        return jax.lax.scan(step, jnp.zeros((GRID_SIZE, GRID_SIZE)), jnp.array(subkeys))[1]

    return inner()


def start_trace(readings):
    constraints = C["walls"].set(jnp.zeros((GRID_SIZE, GRID_SIZE))) | C["readings"].set(readings)
    return full_model.importance(jrand.key(0), constraints, ARGS)[0]


def incremental_update(request_of, key, trace, i, j):
    walls = trace.get_choices()["walls"]
    new_trace, weight, _retdiff, _backward = trace.edit(key, request_of(walls, i, j), None)
    return jax.lax.cond(genjax.bernoulli.sample(key, logits=weight), lambda: new_trace, lambda: trace)


def whole_map_request(walls, i, j):
    return genjax.StaticRequest({"walls": genjax.Update(C.v(walls.at[i, j].set(1.0 - walls[i, j])))})


def index_request(walls, i, j):
    flipped = genjax.Update(C.v(1.0 - walls[i, j]))
    inner = genjax.IndexRequest(jnp.array(j), flipped)
    return genjax.StaticRequest({"walls": genjax.IndexRequest(jnp.array(i), inner)})


def address_request(walls, i, j):
    return genjax.Update(C["walls", i, j].set(1.0 - walls[i, j]))


@partial(jax.jit, static_argnums=0)
def incremental_sweep(request_of, key, trace):
    keys = jrand.split(key, (GRID_SIZE, GRID_SIZE))
    return over_pixels(lambda i, j, t: incremental_update(request_of, keys[i, j], t, i, j), trace)


def test_prior_and_full_model_draw_the_golden_maps():
    """227 walls, score -305.67792; 221 walls, readings sum 146.18332."""
    trace = jax.jit(prior(prior_wall_prob=0.5).simulate)(jrand.key(0), ())
    walls = trace.get_retval()
    assert (int(walls.sum()), fingerprint(walls)) == (227, "30ec82c4549b")
    np.testing.assert_allclose(trace.get_score(), -305.67792, rtol=2e-7)
    walls, readings = full_model.simulate(jrand.key(1), ARGS).get_retval()
    assert (int(walls.sum()), fingerprint(walls)) == (221, "c2ad6e295ff2")
    np.testing.assert_allclose(readings.sum(), 146.18332, rtol=1e-7)


def test_sensor_draws_the_golden_readings(readings):
    """The first readings and their sum; GenJAX 0.10.3 on the same machine agrees to the last bit."""
    np.testing.assert_allclose(readings[:4], [6.2485046, 6.2457266, 4.1215606, 3.7695596], rtol=2e-7)
    np.testing.assert_allclose(readings.sum(), 1225.6375, rtol=1e-7)


def test_basic_gibbs_visits_the_golden_states(basic_chain):
    """Wall counts of the first six states, and the hash of the sixth."""
    assert [int(state.sum()) for state in basic_chain] == [0, 219, 203, 193, 203, 152]
    assert fingerprint(basic_chain[5]) == "3337fc67e58b"


@pytest.mark.parametrize("request_of", [whole_map_request, index_request, address_request])
def test_incremental_gibbs_keeps_the_joint_density_as_its_score(request_of, readings):
    """In the tutorial's setting edits agree with assess, and their traces with cond."""
    trace = incremental_sweep(request_of, jrand.key(0), start_trace(readings))
    assert trace.get_choices()["walls"].dtype == jnp.float32, "walls are what they were given as"
    assert 0 < int(trace.get_choices()["walls"].sum()) < GRID_SIZE**2
    np.testing.assert_allclose(trace.get_score(), assess(trace.get_choices(), ARGS)[0], rtol=1e-6)


def test_importance_sampling_of_100_000_maps_stores_each_argument_once(readings):
    """At the tutorial's N nothing has the size of N x rays x map; the program is compiled, not run."""
    importance = jax.jit(jax.vmap(lambda key: full_model.importance(key, C["readings"].set(readings), ARGS)))
    lowered = importance.lower(jrand.split(jrand.key(3), 100_000))
    traces, _ = lowered.out_info
    assert sum(leaf.size * leaf.dtype.itemsize for leaf in jax.tree.leaves(traces)) < 150e6
    assert lowered.compile().memory_analysis().temp_size_in_bytes < 200e6


def test_penzai_dataclasses_can_inherit_from_pytree():
    """The tutorial writes `@pz.pytree_dataclass class ModelParams(Pytree)`."""
    pz = pytest.importorskip("penzai.pz", reason="penzai is an optional extra of its users")

    @pz.pytree_dataclass
    class Params(genjax.Pytree):
        prior_wall_prob: float = genjax.Pytree.static()
        sensor_noise: float

    params = Params(prior_wall_prob=0.5, sensor_noise=0.2)
    assert jax.tree.leaves(params) == [0.2]
    assert jax.jit(lambda p: p.replace(sensor_noise=p.sensor_noise * 2))(params).prior_wall_prob == 0.5
