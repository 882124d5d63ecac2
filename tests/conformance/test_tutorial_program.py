"""With the same key, the same numbers as GenJAX 0.10.3; the tutorial runs with only its imports changed.

Hexadecimal literals are draws of GenJAX 0.10.3 with `jax.random.key(7)`. The original notebook's code cells run as they
are: imports changed, pictures stubbed, fewer samples. It is not part of the project; its test skips where it is absent.
"""

import hashlib
import sys
import types
from functools import partial

import jax
import jax.numpy as jnp
import jax.random as jr
import jax.random as jrand
import numpy as np
import pytest
from gen_tutorial_model import CENTER, GRID_SIZE, PARAMS, angles, full_model, sensor_model, true_walls
from gen_tutorial_model import walls_prior as prior
from run_peer_tests import notebook_cells

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


REQUESTS = {
    "whole map": lambda flipped, i, j, walls: genjax.StaticRequest(
        {"walls": genjax.Update(C.v(walls.at[i, j].set(flipped)))}
    ),
    "index": lambda flipped, i, j, walls: genjax.StaticRequest(
        {"walls": genjax.IndexRequest(i, genjax.IndexRequest(j, genjax.Update(C.v(flipped))))}
    ),
    "address": lambda flipped, i, j, walls: genjax.Update(C["walls", i, j].set(flipped)),
}


def incremental_update(request, key, trace, i, j):
    walls = trace.get_choices()["walls"]
    new_trace, weight, _retdiff, _backward = trace.edit(key, REQUESTS[request](1.0 - walls[i, j], i, j, walls), None)
    return jax.lax.cond(genjax.bernoulli.sample(key, logits=weight), lambda: new_trace, lambda: trace)


@partial(jax.jit, static_argnums=0)
def incremental_sweep(request, key, trace):
    keys = jrand.split(key, (GRID_SIZE, GRID_SIZE))
    return over_pixels(lambda i, j, t: incremental_update(request, keys[i, j], t, i, j), trace)


def test_prior_model_sensor_and_basic_gibbs_draw_what_they_drew_on_genjax(readings):
    """Wall counts, hashes, scores and sums of readings of GenJAX 0.10.3, which agree to the last bit on one machine."""
    trace = jax.jit(prior(prior_wall_prob=0.5).simulate)(jrand.key(0), ())
    walls = trace.get_retval()
    assert (int(walls.sum()), fingerprint(walls)) == (227, "30ec82c4549b")
    np.testing.assert_allclose(trace.get_score(), -305.67792, rtol=2e-7)
    walls, drawn = full_model.simulate(jrand.key(1), ARGS).get_retval()
    assert (int(walls.sum()), fingerprint(walls)) == (221, "c2ad6e295ff2")
    np.testing.assert_allclose(drawn.sum(), 146.18332, rtol=1e-7)
    np.testing.assert_allclose(readings[:4], [6.2485046, 6.2457266, 4.1215606, 3.7695596], rtol=2e-7)
    np.testing.assert_allclose(readings.sum(), 1225.6375, rtol=1e-7)
    chain = run_chain(jrand.key(0), gibbs_sweep, ARGS, readings, num_samples=6)
    assert [int(state.sum()) for state in chain] == [0, 219, 203, 193, 203, 152]
    assert fingerprint(chain[5]) == "3337fc67e58b"


@pytest.mark.parametrize("edit", REQUESTS)
def test_incremental_gibbs_keeps_the_joint_density_as_its_score(edit, readings):
    """In the tutorial's setting edits agree with assess, and their traces with cond."""
    constraints = C["walls"].set(jnp.zeros((GRID_SIZE, GRID_SIZE))) | C["readings"].set(readings)
    trace = incremental_sweep(edit, jrand.key(0), full_model.importance(jrand.key(0), constraints, ARGS)[0])
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


def same(found, *literals):
    expected = np.array([float.fromhex(x) for x in literals], np.float32)
    np.testing.assert_array_equal(np.ravel(np.asarray(found, np.float32)), expected)


@genjax.gen
def several(x):
    a = genjax.normal(x, 1.0) @ "a"
    genjax.flip.repeat(n=4)(0.3) @ "b"
    c = genjax.uniform(0.0, a * a + 1) @ "c"
    genjax.normal.vmap(in_axes=(0, None))(jnp.arange(3.0), c) @ ("d", "e")
    return a + c


@genjax.gen
def one(x):
    return genjax.normal(x, 1.0) @ "v"


@genjax.gen
def add(state, x):
    return genjax.normal(state + x, 1.0) @ "v"


def test_the_ith_site_uses_fold_in_of_i_and_importance_counts_constrained_ones_too():
    choices = several.simulate(jr.key(7), (0.5,)).get_choices()
    assert choices["a"] == 0.5 + jr.normal(jr.fold_in(jr.key(7), 1))
    same(choices["a"], "0x1.e88430p-1")
    same(choices["c"], "0x1.c48a52p-2")
    same(choices["d", "e"], "-0x1.75acc8p-2", "0x1.00c42ap+0", "0x1.5adf76p+1")
    trace, weight = several.importance(jr.key(7), C["a"].set(0.25) | C["d", "e"].set(jnp.ones(3)), (0.5,))
    same(trace.get_choices()["c"], "0x1.f7620cp-3")
    np.testing.assert_allclose(weight, float.fromhex("-0x1.00cb74p+4"), rtol=1e-6)


def test_vmap_and_repeat_split_the_key_and_scan_chains_it():
    repeated = genjax.normal.repeat(n=3)(0.0, 1.0)(jr.key(7))
    np.testing.assert_array_equal(repeated, jax.vmap(jr.normal)(jr.split(jr.key(7), 3)))
    step = genjax.gen(lambda c, x: genjax.normal(c + x, 1.0) @ "z")
    trace = step.vmap(in_axes=(0, None)).simulate(jr.key(7), (jnp.arange(3.0), 1.0))
    same(trace.get_choices()["z"], "0x1.9f277ap+1", "0x1.4a7e8cp+0", "0x1.1d4040p+2")
    step = genjax.gen(lambda c, x: (lambda z: (z, 2 * z))(genjax.normal(c + x, 1.0) @ "z"))
    draws = step.scan(n=5).simulate(jr.key(7), (0.0, jnp.arange(5.0))).get_choices()["z"]
    same(draws, "0x1.1f277ap+1", "0x1.5f6ed2p+1", "0x1.661362p+2", "0x1.23164ap+3", "0x1.be0da0p+3")
    same(one.iterate(n=3)(0.0)(jr.key(7)), "0x0p+0", "0x1.1f277ap+1", "0x1.bedda4p+0", "0x1.4c26c4p+1")
    same(add.reduce()(0.0, jnp.arange(3.0))(jr.key(7)), "0x1.661362p+2")


def test_other_combinators_pass_the_key_through():
    draw = genjax.normal(0.0, 1.0)(jr.key(7))
    assert genjax.normal.map(lambda x: 2 * x)(0.0, 1.0)(jr.key(7)) == 2 * draw
    assert genjax.normal.dimap(pre=lambda s: (0.0, s), post=lambda a, x, r: r)(1.0)(jr.key(7)) == draw
    assert genjax.normal(0.0).simulate(jr.key(7), (1.0,)).get_retval() == draw
    same(one.switch(one)(1, (0.0,), (5.0,))(jr.key(7)), "0x1.5d1086p+2")
    same(one.or_else(one)(False, (0.0,), (5.0,))(jr.key(7)), "0x1.5d1086p+2")
    same(genjax.mix(one, one)(jnp.array([0.3, 0.7]), (0.0,), (5.0,))(jr.key(7)), "0x1.9d4040p+2")
    same(one.mask()(True, 0.0)(jr.key(7)).unmask(), "0x1.d10860p-2")


def test_distributions_draw_bit_for_bit():
    p = jnp.linspace(0.1, 0.9, 9)
    flips = genjax.flip(p)(jr.key(7))
    assert flips.dtype == bool
    np.testing.assert_array_equal(flips, jr.uniform(jr.key(7), (9,)) < p)
    integers = genjax.bernoulli(probs=p)(jr.key(7))
    assert integers.dtype == jnp.int32
    np.testing.assert_array_equal(integers, flips)
    same(genjax.bernoulli(logits=jnp.linspace(-2, 2, 9))(jr.key(7)), *["0x0p+0"] * 6, *["0x1p+0"] * 3)
    same(genjax.normal(1.5, 2.5)(jr.key(7)), "0x1.506530p+1")
    same(genjax.normal(jnp.arange(1.0, 4.0), 0.5)(jr.key(7)), "0x1.39c212p+0", "0x1.7d0558p+1", "0x1.5ef5eep+1")
    same(genjax.uniform(-1.0, 2.5)(jr.key(7)), "0x1.5bfc0cp+0")
    uniforms = genjax.uniform(jnp.zeros(3), jnp.arange(1.0, 4.0))(jr.key(7))
    same(uniforms, "0x1.592250p-1", "0x1.f300fcp+0", "0x1.d12af0p-1")
    logits = jnp.arange(15.0).reshape(3, 5)
    np.testing.assert_array_equal(genjax.categorical(logits=logits)(jr.key(7)), jr.categorical(jr.key(7), logits))
    same(genjax.categorical(probs=jnp.array([0.1, 0.2, 0.7]))(jr.key(7)), "0x1p+0")
    normals = genjax.normal.sample(jr.key(7), 0.0, 1.0, sample_shape=(4,))
    same(normals, "0x1.ce1096p-2", "0x1.f4155cp+0", "-0x1.08508ap-1", "-0x1.20a54ep-3")


SHORTER = {"num_samples=100": "num_samples=3", "N=100000": "N=200", "num_frames = 100": "num_frames = 1"}
"""100 samples take minutes."""


class Picture:
    """Stands for whatever the plotting library would make."""

    def __getattr__(self, name):
        return Picture()

    def __call__(self, *args, **kwargs):
        return Picture()

    def __add__(self, other):
        return Picture()

    __radd__ = __and__ = __rand__ = __or__ = __ror__ = __add__


def stubs():
    """The modules that draw, and penzai, whose dataclasses are ours where it is not installed."""
    plot = types.ModuleType("genstudio.plot")
    plot.__getattr__ = lambda name: Picture()
    studio = types.ModuleType("genstudio")
    studio.plot = plot
    penzai = types.ModuleType("penzai")
    penzai.pz = types.SimpleNamespace(pytree_dataclass=genjax.Pytree.dataclass)
    return {"genstudio": studio, "genstudio.plot": plot, "penzai": penzai}


@pytest.fixture(scope="module")
def names():
    """Everything that the notebook defines, in its last state, and the chains that it overwrites."""
    import matplotlib

    matplotlib.use("Agg")
    names = {"display": lambda value: None, "chains": []}
    with pytest.MonkeyPatch.context() as patch:
        for name, module in {**stubs(), "genjax": genjax, "genjax.typing": genjax.typing}.items():
            patch.setitem(sys.modules, name, module)
        for cell in notebook_cells():
            for long, short in SHORTER.items():
                cell = cell.replace(long, short)  # noqa: PLW2901
            exec(compile(cell, "a cell of the notebook", "exec"), names)
            if "run_gibbs_chain(" in cell and "gibbs_chain = " in cell:
                names["chains"].append(names["gibbs_chain"])
    return names


@pytest.mark.full
def test_every_cell_runs_and_draws_what_it_drew_on_genjax_and_walls_stay_floats(names):
    """The golden figures of GenJAX 0.10.3: walls of a draw from the prior, readings, the first states of Gibbs."""
    assert int(names["true_walls"].sum()) == 54
    np.testing.assert_allclose(names["observed_readings"].sum(), 1225.6375, rtol=1e-6)
    simple, radial, sparse, block = names["chains"]
    assert [int(state.sum()) for state in simple] == [0, 219, 203]
    for chain in (radial, sparse, block, names["gibbs_chain_incremental"]):
        assert chain.shape == (3, 21, 21)
        assert 0 < int(chain[-1].sum()) < 21 * 21
    assert all(chain.dtype == jnp.float32 for chain in names["chains"])
    assert names["gibbs_chain_incremental"].dtype == jnp.float32
    args = (names["CENTER"], names["DEFAULT_PARAMS"])
    chm = names["C"]["readings"].set(names["observed_readings"]) | names["C"]["walls"].set(jnp.zeros((21, 21)))
    walls, readings = jax.eval_shape(names["full_model"].assess, chm, args)[1]
    assert (walls.dtype, readings.dtype) == (jnp.float32, jnp.float32)
