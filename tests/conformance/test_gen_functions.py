"""Functions made by `@gen`."""

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest

import bayesmap.gen as genjax
from bayesmap.gen import AddressError, AddressReuse, MissingAddress, ShapeMismatch, UnknownAddress
from bayesmap.gen import ChoiceMapBuilder as C


@genjax.gen
def model(loc):
    x = genjax.normal(loc, 1.0) @ "x"
    y = genjax.normal(x, 2.0) @ "y"
    return x + y


@genjax.gen
def nested(loc, scale=1.0):
    total = model(loc) @ "inner"
    return genjax.normal(total, scale) @ "z"


def test_a_call_at_an_address_gives_its_return_value():
    trace = nested.simulate(jr.key(0), (1.0,))
    choices = trace.get_choices()
    assert choices["inner", "x"] + choices["inner", "y"] == trace.get_subtrace("inner").get_retval()
    assert nested(1.0)(jr.key(0)) == trace.get_retval() == choices["z"]
    parts = [trace.get_subtrace("inner", "x"), trace.get_subtrace("inner", "y"), trace.get_subtrace("z")]
    np.testing.assert_allclose(trace.get_score(), sum(p.get_score() for p in parts), rtol=1e-6)


def test_first_arguments_can_be_fixed():
    """The traces of a closure know them, those of a partial application leave them out."""
    for function, known_args in ((nested(1.0), (1.0, 2.0)), (nested.partial_apply(1.0), (2.0,))):
        trace = function.simulate(jr.key(0), (2.0,))
        assert trace.get_args() == known_args
        assert trace.get_retval() == nested.simulate(jr.key(0), (1.0, 2.0)).get_retval()


def test_a_combinator_may_come_after_the_arguments():
    """It works on the function of the arguments that are still to come."""
    np.testing.assert_array_equal(nested(1.0, 2.0).repeat(n=3)()(jr.key(0)), nested.repeat(n=3)(1.0, 2.0)(jr.key(0)))
    trace = nested(1.0).vmap()(jnp.array([1.0, 2.0])).simulate(jr.key(0), ())
    expected = nested.vmap(in_axes=(None, 0)).simulate(jr.key(0), (1.0, jnp.array([1.0, 2.0])))
    np.testing.assert_array_equal(trace.get_retval(), expected.get_retval())
    new, weight, _, _ = trace.edit(jr.key(0), genjax.Regenerate(genjax.Selection.all()))
    assert weight == 0.0
    np.testing.assert_allclose(new.get_score(), expected.gen_fn.assess(new.get_choices(), expected.get_args())[0])


def test_keyword_arguments_reach_the_body():

    @genjax.gen
    def caller():
        return nested(1.0, scale=2.0) @ "n"

    np.testing.assert_array_equal(nested(1.0, scale=2.0)(jr.key(0)), nested(1.0, 2.0)(jr.key(0)))
    assert (
        caller.simulate(jr.key(0), ()).get_score() == caller.assess(caller.simulate(jr.key(0), ()).get_choices(), ())[0]
    )


def test_addresses_may_be_empty_or_nested():
    bare = genjax.gen(lambda: genjax.normal(0.0, 1.0) @ ())
    trace = bare.simulate(jr.key(0), ())
    assert trace.get_choices()[()] == trace.get_retval()
    np.testing.assert_array_equal(bare.assess(C.v(trace.get_retval()), ())[0], trace.get_score())
    trace = genjax.gen(lambda: genjax.normal(0.0, 1.0) @ ("a", "b")).simulate(jr.key(0), ())
    assert trace.get_choices()("a")["b"] == trace.get_choices()["a", "b"] == trace.get_retval()


@pytest.mark.parametrize("addresses", [("x", ()), (("a", "b"), ("a", "b"))])
def test_an_address_in_use_raises(addresses):
    clash = genjax.gen(lambda: [genjax.normal(0.0, 1.0) @ address for address in addresses])
    with pytest.raises(AddressReuse, match=r"\('a', 'b'\)" if addresses[1] else None):
        clash.simulate(jr.key(0), ())


@pytest.mark.parametrize(
    "use",
    [
        lambda chm: nested.importance(jr.key(0), chm, (1.0,)),
        lambda chm: nested.assess(chm | nested.simulate(jr.key(0), (1.0,)).get_choices(), (1.0,)),
        lambda chm: nested.simulate(jr.key(0), (1.0,)).update(jr.key(0), chm),
    ],
    ids=["importance", "assess", "update"],
)
def test_an_address_that_the_model_lacks_raises(use):
    """GenJAX ignores it silently."""
    with pytest.raises(UnknownAddress, match="'w'"):
        use(C["w"].set(1.0))
    with pytest.raises(UnknownAddress, match=r"\('inner', 'w'\)"):
        use(C["inner", "w"].set(1.0))


def test_choices_and_requests_that_do_not_fit_are_named_in_full():
    with pytest.raises(MissingAddress, match=r"\('inner', 'y'\)"):
        nested.assess(C["inner", "x"].set(1.0) | C["z"].set(0.0), (1.0,))
    with pytest.raises(ShapeMismatch, match=r"\('inner', 'x'\): found \(2,\), expected \(\)"):
        nested.importance(jr.key(0), C["inner", "x"].set(jnp.zeros(2)), (1.0,))
    request = genjax.StaticRequest({"w": genjax.Update(C.v(1.0))})
    with pytest.raises(UnknownAddress, match="'w': its sites are 'inner', 'z'"):
        nested.simulate(jr.key(0), (1.0,)).edit(jr.key(0), request)


def test_a_site_outside_a_body_or_inside_a_jax_transformation_raises():
    with pytest.raises(AddressError, match="body of a @gen function"):
        genjax.normal(0.0, 1.0) @ "x"
    inside = genjax.gen(lambda: jax.vmap(lambda m: genjax.normal(m, 1.0) @ "x")(jnp.zeros(3)))
    with pytest.raises(AddressError, match="use the vmap, scan or or_else combinator"):
        inside.simulate(jr.key(0), ())


def test_importance_weight_is_the_density_of_what_was_constrained_given_the_rest():
    trace, weight = model.importance(jr.key(0), C["y"].set(0.5), (1.0,))
    np.testing.assert_allclose(weight, trace.get_subtrace("y").get_score(), rtol=1e-6)


def test_update_weight_is_the_change_of_score_downstream_sites_included():
    trace = nested.simulate(jr.key(0), (1.0,))
    new, weight, _, discard = trace.update(jr.key(0), C["inner", "x"].set(0.25))
    np.testing.assert_allclose(weight, new.get_score() - trace.get_score(), rtol=1e-5)
    np.testing.assert_allclose(new.get_score(), nested.assess(new.get_choices(), (1.0,))[0], rtol=1e-6)
    assert abs(float(new.get_subtrace("z").get_score() - trace.get_subtrace("z").get_score())) > 1e-3
    assert discard["inner", "x"] == trace.get_choices()["inner", "x"]
    assert "z" not in discard


def test_inline_splices_the_sites():
    spliced = genjax.gen(lambda: model.inline(0.0) + (genjax.normal(0.0, 1.0) @ "z"))
    choices = spliced.simulate(jr.key(0), ()).get_choices()
    assert all(name in choices for name in ("x", "y", "z"))
    assert choices["x"] == model.simulate(jr.key(0), (0.0,)).get_choices()["x"]


def test_python_if_on_a_traced_argument_fails_with_jaxs_error():
    branching = genjax.gen(lambda x: genjax.normal(0.0, 1.0 if x > 0 else 2.0) @ "x")
    with pytest.raises(jax.errors.TracerBoolConversionError):
        jax.jit(branching.simulate)(jr.key(0), (1.0,))
    assert branching.simulate(jr.key(0), (1.0,)).get_retval() == genjax.normal(0.0, 1.0)(jr.fold_in(jr.key(0), 1))


def test_a_method_can_be_a_generative_function():
    @genjax.Pytree.dataclass
    class Walk(genjax.Pytree):
        scale: float

        @genjax.gen
        def step(self, x):
            return genjax.normal(x, self.scale) @ "x"

    assert Walk(2.0).step(1.0)(jr.key(0)) == 1.0 + 2.0 * genjax.normal(0.0, 1.0)(jr.fold_in(jr.key(0), 1))


def test_a_subtrace_knows_the_arguments_that_it_was_called_with():
    """The parent stores them once and works them out; for a batch of traces too."""
    trace = nested.simulate(jr.key(0), (1.0, 2.0))
    assert trace.get_subtrace("z").get_args() == (trace.get_subtrace("inner").get_retval(), 2.0)
    batch = jax.vmap(lambda key: nested.simulate(key, (1.0, 2.0)))(jr.split(jr.key(0), 3))
    np.testing.assert_array_equal(batch.get_subtrace("z").get_args()[0], batch.get_subtrace("inner").get_retval())
