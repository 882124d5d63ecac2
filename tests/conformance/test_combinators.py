"""Combinators, and functions made by `@gen`."""

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest

import bayesmap.gen as genjax
from bayesmap.gen import AddressError, AddressReuse, MissingAddress, ShapeMismatch, UnknownAddress
from bayesmap.gen import ChoiceMapBuilder as C


@genjax.gen
def draw(loc):
    v = genjax.normal(loc, 1.0) @ "v"
    return v * 2


@genjax.gen
def step(state, x):
    z = genjax.normal(state + x, 1.0) @ "z"
    return z, 2 * z


@genjax.gen
def walk(state):
    return genjax.normal(state, 1.0) @ "z"


def agrees(trace, tolerance=1e-5):
    """The trace's score is the density that assess gives its choices."""
    score, retval = trace.get_gen_fn().assess(trace.get_choices(), trace.get_args())
    np.testing.assert_allclose(trace.get_score(), score, rtol=tolerance)
    jax.tree.map(lambda a, b: np.testing.assert_allclose(a, b, rtol=1e-6), retval, trace.get_retval())


def test_repeats_are_one_array_that_indices_select_from_and_names_below_an_index_hold_whole_arrays():
    trace = genjax.flip.repeat(n=4).repeat(n=3)(0.5).simulate(jr.key(0), ())
    assert (trace.get_retval().shape, trace.get_retval().dtype, trace.get_score().shape) == ((3, 4), bool, ())
    chm = trace.get_choices()
    assert [leaf.shape for leaf in jax.tree.leaves(chm)] == [(3, 4)]
    whole = chm[()]
    for index in (0, (0, 1), slice(None), ()):
        np.testing.assert_array_equal(chm[index], whole[index])
    assert jax.jit(lambda i: chm[i, 1])(2) == whole[2, 1]
    agrees(trace)
    with pytest.raises(TypeError):
        genjax.flip.repeat(3)  # its number is given by name
    trace = draw.vmap(in_axes=0).simulate(jr.key(0), (jnp.arange(3.0),))
    chm = trace.get_choices()
    np.testing.assert_array_equal(chm["v"], chm[:, "v"])
    assert chm[1, "v"] == chm["v"][1]
    agrees(trace)
    moved, _ = draw.vmap(in_axes=0).importance(jr.key(0), C[1, "v"].set(9.0), (jnp.arange(3.0),))
    np.testing.assert_array_equal(moved.get_choices()["v"], chm["v"].at[1].set(9.0))


@pytest.mark.parametrize(("model", "args", "constraint"), [
    (genjax.normal.repeat(n=4), (0.0, 1.0), C.v(np.zeros(3))), (draw.repeat(n=4), (0.0,), C["v"].set(np.zeros(3))),
    (step.scan(n=4), (0.0, np.zeros(4)), C["z"].set(np.zeros(3))),
], ids=["product", "vmap", "scan"])  # fmt: skip
def test_a_constraint_array_of_the_wrong_length_raises(model, args, constraint):
    """GenJAX clamps silently."""
    for use in (lambda: model.importance(jr.key(0), constraint, args), lambda: model.assess(constraint, args)):
        with pytest.raises(ShapeMismatch, match=r"found \(3,\), expected \(4,\)"):
            use()


def test_some_elements_can_be_constrained_and_values_keep_their_dtype():
    """The others draw what they would have drawn."""
    model, free = genjax.normal.repeat(n=4), genjax.normal.repeat(n=4)(0.0, 1.0)(jr.key(0))
    several = C[1].set(0.5) | C[jnp.array([2, 3])].set(jnp.array([1.0, 2.0]))
    trace, weight = model.importance(jr.key(0), several, (0.0, 1.0))
    np.testing.assert_array_equal(trace.get_retval(), jnp.array([free[0], 0.5, 1.0, 2.0]))
    expected = sum(genjax.normal.assess(C.v(v), (0.0, 1.0))[0] for v in (0.5, 1.0, 2.0))
    np.testing.assert_allclose(weight, expected, rtol=1e-6)
    with pytest.raises(MissingAddress):
        model.assess(several, (0.0, 1.0))
    with pytest.raises(UnknownAddress, match="4: there are 4 elements"):
        model.importance(jr.key(0), C[4].set(0.0), (0.0, 1.0))
    model, given = genjax.flip.repeat(n=3), jnp.array([1.0, 0.0, 1.0])
    assert model.assess(C.v(given), (0.5,))[1].dtype == jnp.float32
    trace, _ = model.importance(jr.key(0), C.v(given), (0.5,))
    assert trace.get_retval().dtype == trace.get_choices()[()].dtype == jnp.float32
    assert genjax.normal.assess(C.v(1), (0.0, 1.0))[1].dtype == jnp.float32, "a real choice can be moved"
    trace, _ = model.importance(jr.key(0), C[0].set(1.0), (0.5,))
    assert trace.get_retval().dtype == bool
    assert trace.get_retval()[0]
    for dtype in (bool, jnp.int32, jnp.float32):  # an edit keeps the trace's, so that both can be branches of lax.cond
        trace, _ = model.importance(jr.key(0), C.v(given.astype(dtype)), (0.5,))
        for value in (jnp.zeros(3), jnp.zeros(3, bool)):
            assert trace.update(jr.key(0), C.v(value))[0].get_retval().dtype == dtype


def test_vmap_maps_the_axes_that_it_is_told_with_jax_s_errors_and_stores_broadcast_arguments_once():
    locs = jnp.arange(6.0).reshape(2, 3)
    trace = draw.vmap(in_axes=1).vmap(in_axes=(0,)).simulate(jr.key(0), (locs[:, None, :],))
    assert trace.get_choices()["v"].shape == (2, 3, 1)
    agrees(draw.vmap(in_axes=-1).simulate(jr.key(0), (locs[0],)))
    for args, message in (((jnp.zeros(3), jnp.zeros(4)), "inconsistent sizes"), ((jnp.zeros(3),), "vmap in_axes")):
        with pytest.raises(ValueError, match=message):
            genjax.normal.vmap(in_axes=(0, 0)).simulate(jr.key(0), args)
    shared = jnp.zeros((50, 50))
    model = genjax.gen(lambda table, i: genjax.normal(table[i, i], 1.0) @ "v")
    trace = model.vmap(in_axes=(None, 0)).simulate(jr.key(0), (shared, jnp.arange(40)))
    assert sum(leaf.nbytes for leaf in jax.tree.leaves(trace)) < shared.nbytes + 40 * 16


def test_scan_returns_its_last_state_and_outputs_iterate_and_accumulate_every_state():
    trace = step.scan(n=3).simulate(jr.key(0), (0.0, jnp.arange(3.0)))
    z = trace.get_choices()["z"]
    np.testing.assert_array_equal(trace.get_retval()[0], z[-1])
    np.testing.assert_array_equal(trace.get_retval()[1], 2 * z)
    assert trace.get_choices()[1, "z"] == z[1]
    agrees(trace)
    with pytest.raises(TypeError, match="n="):
        step.scan().simulate(jr.key(0), (0.0, None))
    add = genjax.gen(lambda state, x: genjax.normal(state + x, 1.0) @ "z")
    for model, args, last in [
        (walk.iterate(n=3), (0.0,), walk.iterate_final(n=3)),
        (add.accumulate(), (0.0, jnp.arange(3.0)), add.reduce()),
    ]:
        trace = model.simulate(jr.key(0), args)
        assert (trace.get_retval().shape, trace.get_retval()[0]) == ((4,), 0.0)
        np.testing.assert_array_equal(trace.get_retval()[1:], trace.get_choices()["z"])
        assert last.simulate(jr.key(0), args).get_retval() == trace.get_retval()[-1]
        agrees(trace)


EMPTY = np.zeros(0, np.float32)


@pytest.mark.parametrize(("model", "args"), [
    (genjax.normal.vmap(), (EMPTY, EMPTY)), (genjax.normal.repeat(n=0), (0.0, 1.0)),
    (genjax.normal.repeat(n=3).vmap(in_axes=(0, None)), (EMPTY, 1.0)),
    (draw.vmap(), (EMPTY,)), (draw.repeat(n=0), (0.0,)), (step.scan(), (0.0, EMPTY)), (walk.iterate(n=0), (0.0,)),
    (genjax.gen(lambda: step.scan()(0.0, EMPTY) @ "steps"), ()),
])  # fmt: skip
def test_a_model_without_elements_needs_no_choices(model, args):
    trace = model.simulate(jr.key(0), args)
    assert trace.get_choices().static_is_empty()
    score, retval = model.assess(trace.get_choices(), args)
    assert score == trace.get_score() == 0.0
    assert jax.tree.map(jnp.shape, retval) == jax.tree.map(jnp.shape, trace.get_retval())
    assert model.importance(jr.key(0), C.n(), args)[1] == 0.0
    assert trace.update(jr.key(0), C.n())[1] == 0.0


def test_a_mask_that_is_true_means_that_the_choices_score_and_switching_it_weighs_their_score():
    on, off = (draw.mask().simulate(jr.key(0), (flag, 0.0)) for flag in (True, False))
    np.testing.assert_allclose(on.get_score(), draw.simulate(jr.key(0), (0.0,)).get_score(), rtol=1e-6)
    assert off.get_score() == 0.0
    assert not off.get_choices()["v"].flag
    assert draw.mask().assess(off.get_choices(), off.get_args())[0] == 0.0
    assert bool(on.get_retval().flag)
    assert not bool(off.get_retval().flag)
    score = draw.simulate(jr.key(0), (0.0,)).get_score()
    for trace, flag, expected in ((off, True, (score, score)), (on, False, (-score, 0.0))):
        diffs = (genjax.Diff(flag, genjax.UnknownChange), genjax.Diff(0.0, genjax.NoChange))
        new, weight, _, _ = trace.edit(jr.key(0), genjax.EmptyRequest(), diffs)
        np.testing.assert_allclose((weight, new.get_score()), expected, rtol=1e-6)


def test_or_else_and_switch_run_the_branch_that_is_named():
    other = genjax.gen(lambda loc: genjax.normal(loc, 1.0) @ "w")
    for flag, name, loc in ((True, "v", 0.0), (False, "w", 50.0)):
        trace = jax.jit(draw.or_else(other).simulate)(jr.key(0), (flag, (0.0,), (50.0,)))
        assert abs(float(trace.get_choices()[name].unmask()) - loc) < 6
        agrees(trace)
    model = genjax.switch(walk, walk, walk)
    for k in range(3):
        trace = model.simulate(jr.key(0), (k, (0.0,), (10.0,), (20.0,)))
        assert abs(float(trace.get_retval()) - 10 * k) < 5
        agrees(trace)
    constrained, weight = model.importance(jr.key(0), C["z"].set(10.0), (1, (0.0,), (10.0,), (20.0,)))
    np.testing.assert_allclose(weight, constrained.get_score())
    with pytest.raises(UnknownAddress, match="no branch has it"):
        model.importance(jr.key(0), C["w"].set(10.0), (1, (0.0,), (10.0,), (20.0,)))


def test_arguments_and_return_values_can_be_transformed():
    trace = draw.map(lambda x: x + 100).simulate(jr.key(0), (0.0,))
    assert trace.get_retval() == draw(0.0)(jr.key(0)) + 100
    agrees(trace)
    assert draw.contramap(lambda a, b: (a + b,))(1.0, 2.0)(jr.key(0)) == draw(3.0)(jr.key(0))
    with pytest.raises(TypeError, match="must return a tuple"):
        draw.contramap(lambda a: a)(1.0)(jr.key(0))
    seen = draw.dimap(pre=lambda a: (a + 1,), post=lambda args, inner, ret: (args, inner, ret))
    trace = seen.simulate(jr.key(0), (1.0,))
    assert trace.get_retval() == ((1.0,), (2.0,), draw(2.0)(jr.key(0)))
    agrees(trace)


@genjax.gen
def model(loc):
    x = genjax.normal(loc, 1.0) @ "x"
    return x + genjax.normal(x, 2.0) @ "y"


@genjax.gen
def nested(loc, scale=1.0):
    return genjax.normal(model(loc) @ "inner", scale) @ "z"


def test_a_call_at_an_address_gives_its_return_value_and_a_subtrace_that_knows_its_arguments():
    trace = nested.simulate(jr.key(0), (1.0,))
    choices = trace.get_choices()
    assert choices["inner", "x"] + choices["inner", "y"] == trace.get_subtrace("inner").get_retval()
    assert nested(1.0)(jr.key(0)) == trace.get_retval() == choices["z"]
    parts = [trace.get_subtrace("inner", "x"), trace.get_subtrace("inner", "y"), trace.get_subtrace("z")]
    np.testing.assert_allclose(trace.get_score(), sum(p.get_score() for p in parts), rtol=1e-6)
    trace = nested.simulate(jr.key(0), (1.0, 2.0))
    assert trace.get_subtrace("z").get_args() == (trace.get_subtrace("inner").get_retval(), 2.0)
    batch = jax.vmap(lambda key: nested.simulate(key, (1.0, 2.0)))(jr.split(jr.key(0), 3))
    np.testing.assert_array_equal(batch.get_subtrace("z").get_args()[0], batch.get_subtrace("inner").get_retval())


def test_first_arguments_can_be_fixed_and_a_combinator_may_come_after_them():
    """The traces of a closure know them, those of a partial application leave them out."""
    for function, known_args in ((nested(1.0), (1.0, 2.0)), (nested.partial_apply(1.0), (2.0,))):
        trace = function.simulate(jr.key(0), (2.0,))
        assert trace.get_args() == known_args
        assert trace.get_retval() == nested.simulate(jr.key(0), (1.0, 2.0)).get_retval()
    np.testing.assert_array_equal(nested(1.0, 2.0).repeat(n=3)()(jr.key(0)), nested.repeat(n=3)(1.0, 2.0)(jr.key(0)))
    trace = nested(1.0).vmap()(jnp.array([1.0, 2.0])).simulate(jr.key(0), ())
    expected = nested.vmap(in_axes=(None, 0)).simulate(jr.key(0), (1.0, jnp.array([1.0, 2.0])))
    np.testing.assert_array_equal(trace.get_retval(), expected.get_retval())
    new, weight, _, _ = trace.edit(jr.key(0), genjax.Regenerate(genjax.Selection.all()))
    assert weight == 0.0
    np.testing.assert_allclose(new.get_score(), expected.gen_fn.assess(new.get_choices(), expected.get_args())[0])


def test_keyword_arguments_reach_the_body_and_python_s_if_on_a_traced_one_fails_with_jax_s_error():

    @genjax.gen
    def caller():
        return nested(1.0, scale=2.0) @ "n"

    np.testing.assert_array_equal(nested(1.0, scale=2.0)(jr.key(0)), nested(1.0, 2.0)(jr.key(0)))
    agrees(caller.simulate(jr.key(0), ()))
    branching = genjax.gen(lambda x: genjax.normal(0.0, 1.0 if x > 0 else 2.0) @ "x")
    with pytest.raises(jax.errors.TracerBoolConversionError):
        jax.jit(branching.simulate)(jr.key(0), (1.0,))
    assert branching.simulate(jr.key(0), (1.0,)).get_retval() == genjax.normal(0.0, 1.0)(jr.fold_in(jr.key(0), 1))


def test_addresses_may_be_empty_nested_or_a_mixture_s_but_not_in_use():
    bare = genjax.gen(lambda: genjax.normal(0.0, 1.0) @ ())
    trace = bare.simulate(jr.key(0), ())
    assert trace.get_choices()[()] == trace.get_retval()
    np.testing.assert_array_equal(bare.assess(C.v(trace.get_retval()), ())[0], trace.get_score())
    trace = genjax.gen(lambda: genjax.normal(0.0, 1.0) @ ("a", "b")).simulate(jr.key(0), ())
    assert trace.get_choices()("a")["b"] == trace.get_choices()["a", "b"] == trace.get_retval()
    trace = genjax.mix(draw, draw).simulate(jr.key(0), (jnp.zeros(2), (0.0,), (9.0,)))
    choices = trace.get_choices()
    assert choices["mixture_component"] in (0, 1)
    assert "v" in choices("component_sample")
    agrees(trace)
    for addresses, message in ((("x", ()), "x"), ((("a", "b"), ("a", "b")), r"\('a', 'b'\)")):
        clash = genjax.gen(lambda used=addresses: [genjax.normal(0.0, 1.0) @ address for address in used])
        with pytest.raises(AddressReuse, match=message):
            clash.simulate(jr.key(0), ())


@pytest.mark.parametrize("use", [
    lambda chm: nested.importance(jr.key(0), chm, (1.0,)),
    lambda chm: nested.assess(chm | nested.simulate(jr.key(0), (1.0,)).get_choices(), (1.0,)),
    lambda chm: nested.simulate(jr.key(0), (1.0,)).update(jr.key(0), chm),
], ids=["importance", "assess", "update"])  # fmt: skip
def test_an_address_that_the_model_lacks_raises(use):
    """GenJAX ignores it silently."""
    with pytest.raises(UnknownAddress, match="'w'"):
        use(C["w"].set(1.0))
    with pytest.raises(UnknownAddress, match=r"\('inner', 'w'\)"):
        use(C["inner", "w"].set(1.0))


def test_choices_and_requests_that_do_not_fit_and_sites_outside_a_body_are_named():
    with pytest.raises(MissingAddress, match=r"\('inner', 'y'\)"):
        nested.assess(C["inner", "x"].set(1.0) | C["z"].set(0.0), (1.0,))
    with pytest.raises(ShapeMismatch, match=r"\('inner', 'x'\): found \(2,\), expected \(\)"):
        nested.importance(jr.key(0), C["inner", "x"].set(jnp.zeros(2)), (1.0,))
    request = genjax.StaticRequest({"w": genjax.Update(C.v(1.0))})
    with pytest.raises(UnknownAddress, match="'w': its sites are 'inner', 'z'"):
        nested.simulate(jr.key(0), (1.0,)).edit(jr.key(0), request)
    with pytest.raises(AddressError, match="body of a @gen function"):
        genjax.normal(0.0, 1.0) @ "x"
    inside = genjax.gen(lambda: jax.vmap(lambda m: genjax.normal(m, 1.0) @ "x")(jnp.zeros(3)))
    with pytest.raises(AddressError, match="use the vmap, scan or or_else combinator"):
        inside.simulate(jr.key(0), ())


def test_inline_splices_the_sites_and_a_method_can_be_a_generative_function():
    spliced = genjax.gen(lambda: model.inline(0.0) + (genjax.normal(0.0, 1.0) @ "z"))
    choices = spliced.simulate(jr.key(0), ()).get_choices()
    assert all(name in choices for name in ("x", "y", "z"))
    assert choices["x"] == model.simulate(jr.key(0), (0.0,)).get_choices()["x"]

    @genjax.Pytree.dataclass
    class Walk(genjax.Pytree):
        scale: float

        @genjax.gen
        def step(self, x):
            return genjax.normal(x, self.scale) @ "x"

    assert Walk(2.0).step(1.0)(jr.key(0)) == 1.0 + 2.0 * genjax.normal(0.0, 1.0)(jr.fold_in(jr.key(0), 1))
