"""Programs written for GenJAX: choice maps, selections, masks, pytrees, dtypes, names, and the errors of wrong use."""

import copy
import pickle

import jax
import jax.numpy as jnp
import jax.random as jr
import jax.scipy.stats as st
import numpy as np
import pytest
from tiers import full_but

import bayesmap.gen as genjax
from bayesmap.gen import (
    ChoiceMap,
    ChoiceMapNoValueAtAddress,
    Diff,
    IndexRequest,
    Mask,
    Pytree,
    Regenerate,
    Selection,
    ShapeMismatch,
    StaticRequest,
    Update,
)
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import SelectionBuilder as S
from bayesmap.gen.errors import BadArguments


@genjax.gen
def model_with_nested_names(loc):
    x = genjax.normal(loc, 1.0) @ "x"
    genjax.flip.repeat(n=3)(0.5) @ ("y", "z")
    return x


@pytest.mark.parametrize("join", [lambda a, b: a | b, lambda a, b: a + b, lambda a, b: a ^ b, lambda a, b: a.merge(b)])
def test_joining_prefers_the_left_value(join):
    both = join(C["x"].set(1.0) | C["y"].set(2.0), C["x"].set(3.0) | C["z", "w"].set(4.0))
    assert (both["x"], both["y"], both["z", "w"]) == (1.0, 2.0, 4.0)


def test_a_masked_value_lets_elements_and_switches_below_it_through():
    """As in GenJAX, the left value is taken where it is present."""
    elements, zeros = C[jnp.array([0, 2])].set(jnp.array([5.0, 6.0])), C.v(jnp.zeros(3))
    joined = C.v(jnp.ones(3)).mask(jnp.array(False)) | elements
    assert (joined[2].unmask(), joined[1].flag, (joined | zeros)[()].tolist()) == (6.0, False, [5.0, 0.0, 6.0])
    assert (C.switch(jnp.array(1), [C.v(1.0), C.n()]) | C.switch(jnp.array(0), [C.v(3.0), C.n()]))[()].unmask() == 3.0
    assert "no rule" in str(pickle.loads(pickle.dumps(genjax.NotSupportedEditRequest(C.n(), C.n()))))


def test_and_filters_the_right_map_by_the_left_ones_addresses_and_at_set_replaces():
    both = C["x"].set(1.0) & (C["x"].set(3.0) | C["y"].set(2.0))
    assert both["x"] == 3.0
    assert "y" not in both
    with pytest.raises(ValueError, match="bare value"):
        C["x"].set(1.0) | C["x", "y"].set(2.0)
    chm = C["x"].set(jnp.zeros(3)) | C["y"].set(1.0)
    np.testing.assert_array_equal(chm.at["x"].set(jnp.ones(3))["x"], jnp.ones(3))
    np.testing.assert_array_equal(chm.at["x", 1].set(5.0)["x"], [0.0, 5.0, 0.0])
    assert chm.at["y"].update(lambda y: y + 1)["y"] == 2.0
    with pytest.raises(ShapeMismatch, match=r"found \(2,\), expected \(3,\)"):
        chm.at["x"].set(jnp.ones(2))


def test_filter_mask_selection_extend_and_the_invalid_subset():
    chm = C["x"].set(1.0) | C["y", "z"].set(2.0)
    kept = chm.filter(S["y"])
    assert ("y", "z") in kept
    assert "x" not in kept
    assert "x" in chm.mask(True)
    assert "x" not in chm.mask(False)
    assert jax.jit(lambda flag: chm.mask(flag)["x"].unmask(default=7.0))(False) == 7.0
    assert chm.get_selection()["y", "z"]
    assert not chm.get_selection()["y"]
    assert chm.extend("a", "b")["a", "b", "x"] == 1.0
    assert ("y", "z") in chm
    for address in ("z", ("y", "x"), "y"):
        with pytest.raises(ChoiceMapNoValueAtAddress):
            chm[address]
    extras = (C["x"].set(1.0) | C["w"].set(2.0)).invalid_subset(model_with_nested_names, (0.0,))
    assert "w" in extras
    assert "x" not in extras
    assert C["x"].set(1.0).invalid_subset(model_with_nested_names, (0.0,)) is None


def test_ways_to_build_a_map_which_can_hold_indices():
    expected = C["x"].set(1.0) | C["y", "z"].set(2.0)
    for chm in (C.d({"x": 1.0, "y": {"z": 2.0}}), C.kw(x=1.0, y={"z": 2.0}), ChoiceMap.d({"x": 1.0, ("y", "z"): 2.0})):
        assert jax.tree.map(float, chm) == jax.tree.map(float, expected)
    assert C.n().static_is_empty()
    assert C["a"].v(3.0)["a"] == 3.0
    assert ChoiceMap.switch(1, [C["x"].set(1.0), C["x"].set(2.0)])["x"] == 2.0
    assert C["i"].switch(jnp.array(0), [C["x"].set(1.0), C["y"].set(2.0)])["i", "x"].unmask() == 1.0
    chm = C[0, "v"].set(1.0) | C[2, "v"].set(3.0)
    assert (chm[0, "v"], chm[2, "v"]) == (1.0, 3.0)
    assert (1, "v") not in chm
    several = C[jnp.array([1, 4])].set(jnp.array([10.0, 40.0]))
    assert (several[4].value, bool(several[4].flag)) == (40.0, True)
    assert not several[3].flag, "an array of indices does not decide what a map holds"
    assert jax.jit(lambda i: several[i].unmask(default=0.0))(3) == 0.0


def test_selections_match_everything_below_and_combine():
    x, y = Selection.at["x"], Selection.at["y"]
    wild, leaf = Selection.at[..., "y"], Selection.leaf().extend("x")
    inside = [(x, "x"), (x, ("x", "y", "z")), (x | y, "y"), (~x, "y"), (wild, ("a", "y")), (leaf, "x")]
    inside += [(Selection.all(), ("anything", "at", "all")), (Selection.all(), ())]
    outside = [(x, "y"), (x & y, "x"), (~x, ("x", "z")), (wild, ("a", "z")), (leaf, ("x", "y")), (Selection.none(), ())]
    assert all(sel[address] for sel, address in inside)
    assert not any(sel[address] for sel, address in outside)
    assert (x("x"), ~~x, S[()]) == (Selection.all(), x, Selection.leaf())


def test_unmask():
    value = jnp.arange(3.0)
    assert (Mask(1.0, True).unmask(), Mask(1.0, False).unmask()) == (1.0, 1.0)
    with genjax.do_checkify(), pytest.raises(Exception, match="flag is False"):
        Mask(1.0, False).unmask()
    assert Mask(1.0, False).unmask(default=5.0) == 5.0
    mixed = Mask(value, jnp.array([True, False, True]))
    np.testing.assert_array_equal(mixed.unmask(default=jnp.full(3, -1.0)), [0.0, -1.0, 2.0])
    np.testing.assert_array_equal((mixed | Mask(value + 10, jnp.array([True, True, True]))).value, [0.0, 11.0, 2.0])
    with pytest.raises(ValueError, match=r"shape \(3,\) must be a prefix"):
        Mask(jnp.zeros(2), jnp.ones(3, bool))


@Pytree.dataclass
class CountAndScale(Pytree):
    count: int = Pytree.static()
    scale: float = Pytree.field(default=1.0)


def test_pytree_dataclasses_are_frozen_with_static_fields_in_the_definition():
    params = CountAndScale(3, 2.0)
    assert jax.tree.leaves(params) == [2.0]
    assert jax.tree.structure(params) != jax.tree.structure(CountAndScale(4, 2.0))
    assert params.replace(scale=5.0) == CountAndScale(3, 5.0)
    with pytest.raises(AttributeError):
        params.count = 4
    with pytest.raises(TypeError, match="no field size"):
        params.replace(size=1)
    assert jax.jit(lambda p: jnp.zeros(p.count) + p.scale)(params).shape == (3,)


def test_traces_pickle_can_be_copied_and_print_as_trees():
    trace = model_with_nested_names.simulate(jr.key(0), (1.0,))
    loaded = pickle.loads(pickle.dumps(trace))
    assert loaded.get_gen_fn() == model_with_nested_names
    np.testing.assert_array_equal(loaded.get_choices()["y", "z"], trace.get_choices()["y", "z"])
    assert loaded.update(jr.key(0), C["x"].set(0.0))[0].get_choices()["x"] == 0.0
    local = genjax.gen(lambda: genjax.normal(0.0, 1.0) @ "x").simulate(jr.key(0), ())
    assert copy.deepcopy(local).get_choices()["x"] == local.get_choices()["x"]
    trace = model_with_nested_names.simulate(jr.key(0), (1.0,))
    assert "'y':\n    'z': [" in repr(trace)
    assert (repr(C["x", "y"].set(1.0)), repr(C.n())) == ("'x':\n  'y': 1.0", "(empty)")


def test_traces_survive_jit_vmap_scan_and_cond():
    trace = model_with_nested_names.simulate(jr.key(0), (1.0,))
    again = jax.jit(lambda t: t)(trace)
    assert again.get_score() == trace.get_score()
    batch = jax.vmap(lambda key: model_with_nested_names.simulate(key, (1.0,)))(jr.split(jr.key(0), 4))
    assert (batch.get_score().shape, batch.get_choices()["y", "z"].shape) == ((4,), (4, 3))
    np.testing.assert_array_equal(batch.get_retval(), batch.get_choices()["x"])

    def body(t, key):
        new = t.edit(key, genjax.Regenerate(Selection.at["x"]))[0]
        return jax.lax.cond(new.get_score() > t.get_score(), lambda: new, lambda: t), t.get_score()

    _, scores = jax.lax.scan(body, again, jr.split(jr.key(0), 20))
    assert jnp.all(jnp.diff(scores) >= 0)
    assert scores[-1] > scores[0]


@genjax.gen
def one():
    return genjax.normal(0.0, 1.0) @ "x"


@genjax.gen
def other():
    return genjax.normal(0.0, 2.0) @ "y"


def test_float_maps_and_counts_can_be_the_carry_of_a_loop():
    """In block Gibbs the loop's carry is the value that `assess` returns."""
    prior = genjax.flip.repeat(n=3)

    def sweep(_, walls):
        return prior.assess(C.v(1.0 - walls), (0.3,))[1]

    assert jax.lax.fori_loop(0, 3, sweep, jnp.zeros(3)).dtype == jnp.float32

    @genjax.gen
    def births(total, _):
        return total + genjax.poisson(2.0) @ "n" + genjax.geometric(0.5) @ "g" + genjax.binomial(3.0, 0.5) @ "b", None

    trace = births.scan(n=4).simulate(jr.key(0), (0.0, None))
    assert {trace.get_choices()[name].dtype for name in "ngb"} == {jnp.dtype("float32")}


def test_positional_parameters_are_tensorflow_probabilitys():
    """The second of `binomial` is logits; `mv_normal_diag` has a unit scale."""
    assert genjax.binomial.assess(C.v(1.0), (1.0, 0.5))[0] == genjax.binomial(1.0, logits=0.5).assess(C.v(1.0), ())[0]
    loc = jnp.array([1.0, 2.0])
    np.testing.assert_allclose(genjax.mv_normal_diag.assess(C.v(loc), (loc,))[0], 2 * st.norm.logpdf(0.0), rtol=1e-6)


@pytest.mark.parametrize(("a", "b", "dtype"), [(1, True, jnp.int32), (True, 2.0, jnp.float32), (1, 2.0, jnp.float32)])
def test_branches_of_different_types_have_their_common_type(a, b, dtype):
    both = genjax.gen(lambda: jnp.asarray(a)).switch(genjax.gen(lambda: jnp.asarray(b)))
    for k, value in enumerate((a, b)):
        result = both(k, (), ())(jr.key(0))
        assert (result.dtype, float(result)) == (dtype, float(value))


def test_choices_of_a_branch_that_did_not_run_are_masked_and_jit_changes_no_structure():
    trace = one.switch(other).simulate(jr.key(0), (jnp.array(0), (), ()))
    choices = trace.get_choices()
    assert choices["x"].flag
    assert not choices["y"].flag
    score, _ = one.switch(other).assess(choices, trace.get_args())
    np.testing.assert_allclose(score, trace.get_score(), rtol=1e-6)
    simulate = one.mask().simulate
    inside, outside = (run(jr.key(0), (jnp.array(False),)) for run in (jax.jit(simulate), simulate))
    assert jax.tree.structure(inside) == jax.tree.structure(outside)


def test_masks_combine_as_sets_and_over_a_vector_ask_for_vmap():
    a = Mask(jnp.array([1.0, 2.0, 3.0]), jnp.array([True, True, False]))
    b = Mask(jnp.zeros(3), jnp.array([True, False, True]))
    np.testing.assert_array_equal((a | b).value, [1.0, 2.0, 0.0])
    np.testing.assert_array_equal((a ^ b).primal_flag(), [False, True, True])
    np.testing.assert_array_equal((~a).flag, [False, False, True])
    np.testing.assert_array_equal(Mask.or_n(a, b, ~a).flag, [True, True, True])
    assert Mask.maybe_mask(3.0, True) == 3.0
    assert Mask.maybe_mask(3.0, False) is None
    with pytest.raises(ValueError, match="different array shapes"):
        a | Mask(jnp.zeros(2), jnp.array([True, False]))
    with pytest.raises(TypeError, match=r"\.mask\(\)\.vmap\(\)"):
        one.mask().simulate(jr.key(0), (jnp.array([True, False]),))
    flags = jnp.array([True, False, True])
    trace = one.mask().vmap().simulate(jr.key(0), (flags,))
    np.testing.assert_array_equal(trace.get_retval().flag, flags)
    np.testing.assert_allclose(trace.get_score(), st.norm.logpdf(trace.get_retval().value)[flags].sum(), rtol=1e-6)


@genjax.gen
def with_inner():
    scale = genjax.gamma(2.0, 1.0) @ "scale"

    @genjax.gen
    def step(state, _):
        return genjax.normal(state, scale) @ "s", None

    return step.scan(n=3)(0.0, None) @ "steps"


def log_joint(trace):
    return with_inner.assess(trace.get_choices(), ())[0]


@pytest.mark.parametrize("also_scale", full_but([False, True], True))
def test_an_element_of_a_scan_that_the_body_defines_can_be_edited(also_scale):
    """The weight is the joint's, the closed-over value's change included; the way back undoes it."""
    trace = with_inner.simulate(jr.key(0), ())
    requests = {"steps": IndexRequest(1, Update(C["s"].set(0.7)))}
    if also_scale:
        requests["scale"] = Update(C.v(1.3))
    new, weight, _, back = jax.jit(lambda t: t.edit(jr.key(0), StaticRequest(requests)))(trace)
    assert new.get_choices()["steps", 1, "s"] == pytest.approx(0.7)
    np.testing.assert_allclose(weight, log_joint(new) - log_joint(trace), rtol=1e-4, atol=1e-5)
    old, undone, _, _ = new.edit(jr.key(0), back)
    np.testing.assert_allclose(old.get_choices()["steps", "s"], trace.get_choices()["steps", "s"], rtol=1e-6)
    np.testing.assert_allclose(undone, -weight, rtol=1e-4, atol=1e-5)


def test_hmc_moves_a_site_that_the_body_defines():
    """With one tiny step energy is kept, so the log acceptance ratio is near 0 and the step is not."""
    trace = with_inner.simulate(jr.key(0), ())
    request = StaticRequest({"steps": genjax.HMC(Selection.at["s"], 1e-3, 5)})
    new, weight, _, _ = jax.jit(lambda t: t.edit(jr.key(0), request))(trace)
    assert abs(float(weight)) < 1e-3
    assert jnp.all(new.get_choices()["steps", "s"] != trace.get_choices()["steps", "s"])


def test_keywords_of_a_draw_overrule_those_of_the_closure_and_functions_keep_their_name_and_text():
    model = genjax.gen(lambda x, y=1.0: genjax.normal(x, 1.0).map(lambda z: (z, y))() @ "z")
    closure = model(2.0, y=5.0)
    assert (closure(jr.key(0))[1], closure(jr.key(0), y=3.0)[1]) == (5.0, 3.0)
    trace = model.handle_kwargs().simulate(jr.key(0), ((2.0,), {"y": 4.0}))
    assert (trace.get_args(), trace.get_retval()[1]) == (((2.0,), {"y": 4.0}), 4.0)

    @genjax.gen
    def documented(x: float) -> float:
        """Says what it does."""
        return x

    assert documented.__doc__ == "Says what it does."
    assert documented.__name__ == documented.__wrapped__.__name__ == "documented"


def test_a_trace_of_zeros_has_a_real_one_s_structure_and_subtraces_are_found_through_switches():
    zero = one.get_zero_trace()
    assert jax.tree.structure(zero) == jax.tree.structure(one.simulate(jr.key(0), ()))
    assert (zero.get_score(), zero.get_sample()["x"]) == (0.0, 0.0)
    trace = genjax.gen(lambda: one.or_else(other)(genjax.flip(0.5) @ "b", (), ()) @ "z").simulate(jr.key(0), ())
    found = trace.get_subtrace("z", "x" if trace.get_choices()["b"] else "y")
    np.testing.assert_allclose(found.get_score(), trace.get_score() - np.log(0.5), rtol=1e-6)


def test_constants_sequences_of_trees_and_choice_maps_by_builder_and_switch():
    assert jax.jit(lambda c: jnp.zeros(c.unwrap()))(genjax.Pytree.const(3)).shape == (3,)
    assert genjax.Const.unwrap(10) == 10

    @genjax.Pytree.dataclass
    class Points(genjax.PythonicPytree):
        x: jax.Array

    points = Points(jnp.arange(3.0))
    assert (len(points), float(points[1].x), len(points + points)) == (3, 1.0, 6)
    assert [float(p.x) for p in points.prepend(Points(jnp.array(-1.0)))] == [-1.0, 0.0, 1.0, 2.0]
    assert ChoiceMap.builder["a"].set(1.0)["a"] == 1.0
    chm = ChoiceMap.switch(jnp.array(1), [C["x"].set(1.0), C["y"].set(2.0)]) | C["z"].set(3.0)
    assert not chm["x"].flag
    assert (chm["y"].unmask(), chm["z"].unmask(), chm.simplify()) == (2.0, 3.0, chm)
    assert Selection.at["x", "y"].get_subselection("x")["y"]


def test_marks_of_change_can_be_taken_apart_put_together_and_looked_at_by_requests():
    tree = {"a": 1, "b": [2.0]}
    marks = {"a": genjax.NoChange, "b": [genjax.UnknownChange]}
    marked = Diff.tree_diff(tree, marks)
    assert (Diff.tree_tangent(marked), marked["a"].get_primal()) == (marks, 1)
    assert Diff.static_check_tree_diff(marked)
    assert not Diff.static_check_tree_diff(tree)
    seen = []
    trace = one.simulate(jr.key(0), ())
    Regenerate(Selection.all()).map(lambda diff: seen.append(diff) or diff).edit(jr.key(0), trace, ())
    assert not Diff.static_check_no_change(seen[0])
    safe = genjax.SafeHMC(Selection.at["x"], 0.1)
    with pytest.raises(BadArguments, match="return value depends"):
        safe.edit(jr.key(0), trace, ())


@pytest.mark.parametrize("flags", [(True, True, False), (True, True, True)])
def test_masked_iteration_counts_the_steps_whose_flag_holds(flags):
    walk, flags = genjax.gen(lambda x: genjax.normal(x, 1.0) @ "x"), np.array(flags)
    trace = walk.masked_iterate().simulate(jr.key(0), (0.0, flags))
    states = trace.get_retval()
    assert states.shape == (4,)
    np.testing.assert_allclose(trace.get_score(), st.norm.logpdf(states[1:], states[:-1])[flags].sum(), rtol=1e-5)
    assert walk.masked_iterate_final().simulate(jr.key(0), (0.0, flags)).get_retval() == states[-1]


@genjax.Pytree.dataclass
class Doubled(genjax.Distribution):
    """Twice a standard normal, its density estimated by itself."""

    def random_weighted(self, key, *args):
        value = 2 * jr.normal(key)
        return self.estimate_logpdf(key, value), value

    def estimate_logpdf(self, key, value, *args):
        return st.norm.logpdf(value, 0.0, 2.0)


def test_a_users_distribution_needs_two_methods():
    model = genjax.gen(lambda: Doubled()() @ "v")
    trace = model.simulate(jr.key(0), ())
    np.testing.assert_allclose(trace.get_score(), st.norm.logpdf(trace.get_choices()["v"], 0.0, 2.0), rtol=1e-6)
    _, weight, _, _ = trace.update(jr.key(0), C["v"].set(1.0))
    np.testing.assert_allclose(weight, st.norm.logpdf(1.0, 0.0, 2.0) - trace.get_score(), rtol=1e-5)
    mixed, _ = jax.jit(lambda flag: model.importance(jr.key(0), C["v"].set(7.0).mask(flag), ()))(True)
    assert mixed.get_choices()["v"] == 7.0


def mistaken():
    outer = genjax.gen(lambda: one() @ "y")
    nameless = genjax.gen(lambda: genjax.normal(0.0, 1.0) @ (genjax.normal(0.0, 1.0) @ "a"))
    return {
        r"normal\(loc.*scale.*missing a required argument: 'scale'":
            (lambda: genjax.gen(lambda: genjax.normal(0.0) @ "y").simulate(jr.key(0), ()), BadArguments),
        "'y': there is a function with the sites 'x', so a bare value":
            (lambda: outer.importance(jr.key(0), C["y"].set(1.0), ()), genjax.UnknownAddress),
        "a string or a tuple of strings": (lambda: nameless.simulate(jr.key(0), ()), TypeError),
        "no branch 2; the branches are 0 to 1":
            (lambda: one.switch(other).simulate(jr.key(0), (2, (), ())), BadArguments),
        "no arguments by name": (lambda: one.vmap()(x=1.0)(jr.key(0)), TypeError),
    }  # fmt: skip


@pytest.mark.parametrize("message", mistaken())
def test_wrong_use_says_what_is_wrong(message):
    use, error = mistaken()[message]
    with pytest.raises(error, match=message):
        use()


def test_an_error_carries_the_address_alone():
    with pytest.raises(genjax.MissingAddress) as caught:
        one.assess(C.n(), ())
    assert caught.value.args == ("x",)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.args, str(again)) == (caught.value.args, str(caught.value))
