"""With the same key, the same numbers as GenJAX 0.10.3.

Hexadecimal literals are draws of GenJAX 0.10.3 with `jax.random.key(7)`.
"""

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np

import bayesmap.gen as genjax
from bayesmap.gen import ChoiceMapBuilder as C


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
    constraint = C["a"].set(0.25) | C["d", "e"].set(jnp.ones(3))
    trace, weight = several.importance(jr.key(7), constraint, (0.5,))
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
