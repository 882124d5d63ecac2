"""Section E: edits of traces."""

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest

import bayesmap.gen as genjax
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import Diff, EmptyRequest, IndexRequest, Selection, StaticRequest, UnknownAddress, Update

KEY = jr.key(0)


@genjax.gen
def sensor(table, scale, i):
    return genjax.normal(jnp.sum(table) + i, scale) @ "r"


@genjax.gen
def model(p, scale):
    table = genjax.flip.repeat(n=4).repeat(n=3)(p) @ "table"
    readings = sensor.vmap(in_axes=(None, None, 0))(table, scale, jnp.arange(5.0)) @ "readings"
    return table, readings


@genjax.gen
def step(state, x):
    z = genjax.normal(state + x, 1.0) @ "z"
    genjax.normal(z, 0.5) @ "y"
    return z, z


ARGS = (0.3, 0.5)
TRACE = model.simulate(KEY, ARGS)
TABLE = TRACE.get_choices()["table"]


def changes_by_the_joint(trace, new, weight):
    """The weight is the difference of what assess gives the two traces' choices."""
    joint = lambda t: t.get_gen_fn().assess(t.get_choices(), t.get_args())[0]  # noqa: E731
    np.testing.assert_allclose(weight, joint(new) - joint(trace), rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(new.get_score(), joint(new), rtol=1e-5)


def same_types(a, b):
    assert jax.tree.structure(a) == jax.tree.structure(b)
    for x, y in zip(jax.tree.leaves(a), jax.tree.leaves(b), strict=True):
        assert (jnp.shape(x), jnp.result_type(x)) == (jnp.shape(y), jnp.result_type(y))


def test_edit_gives_trace_weight_retdiff_and_the_way_back():
    """E.26."""
    new, weight, retdiff, back = TRACE.edit(KEY, Update(C["table"].set(~TABLE)))
    np.testing.assert_array_equal(Diff.tree_primal(retdiff)[0], ~TABLE)
    restored, undone, _, _ = new.edit(KEY, back)
    jax.tree.map(np.testing.assert_array_equal, restored.get_choices(), TRACE.get_choices())
    np.testing.assert_allclose(undone, -weight, rtol=1e-5)


def test_update_returns_the_choices_that_it_replaced_last():
    """E.26."""
    _, _, _, discard = TRACE.update(KEY, C["table"].set(~TABLE))
    np.testing.assert_array_equal(discard["table"], TABLE)
    assert "readings" not in {path[0] for path in discard.paths()}


def test_argdiffs_change_the_arguments():
    """E.26."""
    new, weight, _, _ = TRACE.edit(KEY, Update(C.n()), Diff.unknown_change((0.6, 0.5)))
    assert new.get_args() == (0.6, 0.5)
    changes_by_the_joint(TRACE, new, weight)
    same_types(new, TRACE)


EDITS = {
    "static": lambda i, j: StaticRequest({"table": Update(C.v(TABLE.at[i, j].set(~TABLE[i, j])))}),
    "index": lambda i, j: StaticRequest({"table": IndexRequest(i, IndexRequest(j, Update(C.v(~TABLE[i, j]))))}),
    "address": lambda i, j: Update(C["table", i, j].set(~TABLE[i, j])),
    "float": lambda i, j: Update(C["table", i, j].set(1.0 - TABLE[i, j])),
}


@pytest.mark.parametrize("traced", [False, True])
@pytest.mark.parametrize("name", EDITS)
def test_one_element_can_be_changed(name, traced):
    """E.27 and E.28, with i and j ints or traced."""
    edit = lambda i, j: TRACE.edit(KEY, EDITS[name](i, j))[:2]  # noqa: E731
    new, weight = (jax.jit(edit) if traced else edit)(1, 2)
    np.testing.assert_array_equal(new.get_choices()["table"], TABLE.at[1, 2].set(~TABLE[1, 2]))
    changes_by_the_joint(TRACE, new, weight)
    same_types(new, TRACE)


def test_one_element_of_a_vmap_can_be_changed():
    """E.28."""
    request = StaticRequest({"readings": IndexRequest(2, Update(C["r"].set(0.25)))})
    for edit in (request, Update(C["readings", 2, "r"].set(0.25))):
        new, weight, _, back = TRACE.edit(KEY, edit)
        expected = TRACE.get_choices()["readings", "r"].at[2].set(0.25)
        np.testing.assert_array_equal(new.get_choices()["readings", "r"], expected)
        changes_by_the_joint(TRACE, new, weight)
        restored = new.edit(KEY, back)[0]
        jax.tree.map(np.testing.assert_array_equal, restored.get_choices(), TRACE.get_choices())


@pytest.mark.parametrize("t", [0, 2, 4])
def test_one_step_of_a_scan_can_be_changed(t):
    """E.28: the next step's state, and so its density, changes too."""
    trace = step.scan(n=5).simulate(KEY, (0.0, jnp.arange(5.0)))
    for request in (IndexRequest(t, Update(C["z"].set(0.25))), Update(C[t, "z"].set(0.25))):
        new, weight, _, _ = jax.jit(lambda r: trace.edit(KEY, r))(request)
        np.testing.assert_array_equal(new.get_choices()["z"], trace.get_choices()["z"].at[t].set(0.25))
        changes_by_the_joint(trace, new, weight)
        np.testing.assert_array_equal(new.get_retval()[1], new.get_choices()["z"])
        same_types(new, trace)


def test_all_steps_of_a_scan_can_be_changed():
    """E.27."""
    trace = step.scan(n=5).simulate(KEY, (0.0, jnp.arange(5.0)))
    new, weight, _, back = trace.edit(KEY, Update(C["y"].set(jnp.ones(5))), Diff.unknown_change((1.0, jnp.arange(5.0))))
    changes_by_the_joint(trace, new, weight)
    np.testing.assert_array_equal(back.constraint["y"], trace.get_choices()["y"])
    same_types(new, trace)


def test_an_edit_can_leave_and_return_from_an_impossible_value():
    """E.28: a score of -inf is not added to, which would give NaN."""
    trace, _ = genjax.flip.repeat(n=3).importance(KEY, C.v(jnp.zeros(3)), (0.0,))
    impossible, down, _, back = trace.edit(KEY, IndexRequest(1, Update(C.v(1.0))))
    assert down == impossible.get_score() == -jnp.inf
    restored, up, _, _ = impossible.edit(KEY, back)
    assert up == jnp.inf
    assert restored.get_score() == trace.get_score() == 0.0


def test_an_edit_of_an_element_outside_raises():
    """E.28."""
    with pytest.raises(UnknownAddress, match=r"\('table', 3\)"):
        TRACE.edit(KEY, Update(C["table", 3, 0].set(True)))


def test_old_and_new_trace_can_be_branches_of_cond():
    """E.29: also where the value that was given is a float."""

    @jax.jit
    def flip_if(flag):
        new = TRACE.edit(KEY, Update(C["table", 0, 0].set(1.0 - TABLE[0, 0])))[0]
        return jax.lax.cond(flag, lambda: new, lambda: TRACE).get_choices()["table"]

    np.testing.assert_array_equal(flip_if(False), TABLE)
    np.testing.assert_array_equal(flip_if(True), TABLE.at[0, 0].set(~TABLE[0, 0]))


def test_an_empty_request_weighs_nothing_when_nothing_changed():
    """E.30."""
    new, weight, retdiff, _ = TRACE.edit(KEY, EmptyRequest())
    assert weight == 0.0
    assert new is TRACE
    assert Diff.static_check_no_change(retdiff)


def test_an_empty_request_rescores_when_arguments_changed():
    """E.30."""
    new, weight, _, _ = TRACE.edit(KEY, EmptyRequest(), Diff.unknown_change((0.3, 2.0)))
    assert weight != 0.0
    changes_by_the_joint(TRACE, new, weight)


def test_project_sums_the_selected_scores():
    """E.30."""
    parts = [TRACE.project(KEY, Selection.at[name]) for name in ("table", "readings")]
    np.testing.assert_allclose(parts[0], TRACE.get_subtrace("table").get_score(), rtol=1e-6)
    np.testing.assert_allclose(sum(parts), TRACE.get_score(), rtol=1e-6)
    assert TRACE.project(KEY, Selection.none()) == 0.0
    np.testing.assert_allclose(TRACE.project(KEY, Selection.at["readings", "r"]), parts[1], rtol=1e-6)


def test_edit_takes_requests_only():
    """E.31."""
    with pytest.raises(TypeError, match="EditRequest"):
        TRACE.edit(KEY, C["table"].set(TABLE))


def test_untouched_sites_are_not_looked_at():
    """Where no argument changed a site keeps its trace, score and all: that is what makes edits pay."""
    new, _, retdiff, _ = TRACE.edit(KEY, Update(C["readings", "r"].set(jnp.zeros(5))))
    assert new.subtraces[("table",)].value is TRACE.subtraces[("table",)].value
    assert isinstance(Diff.tangents(retdiff)[0], type(genjax.NoChange))


def test_a_change_of_one_element_is_passed_on_as_such():
    """The return value's diff says which element changed; elementwise functions of it say so too."""
    inverted = model.map(lambda r: (jnp.logical_not(r[0]).astype(float) * 2.0, jnp.sum(r[0])))
    trace = inverted.simulate(KEY, ARGS)
    retdiff = trace.edit(KEY, Update(C["table", 1, 2].set(~TABLE[1, 2])))[2]
    one_element, whole = Diff.tangents(retdiff)
    assert one_element == genjax.IndexChange((1, 2))
    assert whole == genjax.UnknownChange


def test_a_function_defined_in_the_body_is_scored_anew():
    """It may close over values that changed, which its arguments do not show."""

    @genjax.gen
    def outer():
        x = genjax.normal(0.0, 1.0) @ "x"
        inner = genjax.gen(lambda: genjax.normal(x, 1.0) @ "y")
        return inner() @ "inner"

    trace = outer.simulate(KEY, ())
    new, weight, _, _ = trace.edit(KEY, Update(C["x"].set(3.0)))
    changes_by_the_joint(trace, new, weight)
    assert new.get_choices()["inner", "y"] == trace.get_choices()["inner", "y"]


@pytest.mark.parametrize("moved", [None, (jnp.ones(3), 0.5, 1 + jnp.arange(4.0))])
def test_an_update_without_choices_replaces_none(moved):
    normals = sensor.vmap(in_axes=(None, None, 0))
    args = (jnp.ones(3), 0.5, jnp.arange(4.0))
    trace = normals.simulate(KEY, args)
    argdiffs = None if moved is None else Diff.unknown_change(moved)
    new, weight, _, replaced = trace.update(KEY, C.n(), argdiffs)
    assert replaced.static_is_empty()
    expected, _ = normals.assess(trace.get_choices(), moved or args)
    np.testing.assert_allclose(weight, expected - trace.get_score(), rtol=1e-5)
    np.testing.assert_allclose(new.get_score(), expected, rtol=1e-6)
