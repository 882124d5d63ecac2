"""Edits of traces."""

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest
from tiers import full_but

import bayesmap.gen as genjax
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import Diff, EmptyRequest, IndexRequest, Selection, StaticRequest, UnknownAddress, Update


@genjax.gen
def sensor(table, scale, i):
    return genjax.normal(jnp.sum(table) + i, scale) @ "r"


@genjax.gen
def model(p, scale):
    table = genjax.flip.repeat(n=4).repeat(n=3)(p) @ "table"
    return table, sensor.vmap(in_axes=(None, None, 0))(table, scale, jnp.arange(5.0)) @ "readings"


@genjax.gen
def step(state, x):
    z = genjax.normal(state + x, 1.0) @ "z"
    genjax.normal(z, 0.5) @ "y"
    return z, z


ARGS = (0.3, 0.5)


@pytest.fixture(scope="module")
def trace():
    return model.simulate(jr.key(0), ARGS)


@pytest.fixture(scope="module")
def table(trace):
    return trace.get_choices()["table"]


def changes_by_the_joint(trace, new, weight):
    """The weight is the difference of what assess gives the two traces' choices."""
    joint = lambda t: t.get_gen_fn().assess(t.get_choices(), t.get_args())[0]  # noqa: E731
    np.testing.assert_allclose(weight, joint(new) - joint(trace), rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(new.get_score(), joint(new), rtol=1e-5)


def same_types(a, b):
    assert jax.tree.structure(a) == jax.tree.structure(b)
    for x, y in zip(jax.tree.leaves(a), jax.tree.leaves(b), strict=True):
        assert (jnp.shape(x), jnp.result_type(x)) == (jnp.shape(y), jnp.result_type(y))


def test_edit_gives_trace_weight_retdiff_and_the_way_back(trace, table):
    new, weight, retdiff, back = trace.edit(jr.key(0), Update(C["table"].set(~table)))
    np.testing.assert_array_equal(Diff.tree_primal(retdiff)[0], ~table)
    restored, undone, _, _ = new.edit(jr.key(0), back)
    jax.tree.map(np.testing.assert_array_equal, restored.get_choices(), trace.get_choices())
    np.testing.assert_allclose(undone, -weight, rtol=1e-5)
    discard = trace.update(jr.key(0), C["table"].set(~table))[3]
    np.testing.assert_array_equal(discard["table"], table)
    assert "readings" not in {path[0] for path in discard.paths()}
    with pytest.raises(TypeError, match="EditRequest"):
        trace.edit(jr.key(0), C["table"].set(table))
    with pytest.raises(UnknownAddress, match=r"\('table', 3\)"):
        trace.edit(jr.key(0), Update(C["table", 3, 0].set(True)))


EDITS = {
    "static": lambda table, i, j: StaticRequest({"table": Update(C.v(table.at[i, j].set(~table[i, j])))}),
    "index": lambda table, i, j: StaticRequest({"table": IndexRequest(i, IndexRequest(j, Update(C.v(~table[i, j]))))}),
    "address": lambda table, i, j: Update(C["table", i, j].set(~table[i, j])),
    "float": lambda table, i, j: Update(C["table", i, j].set(1.0 - table[i, j])),
}


@pytest.mark.parametrize("traced", [False, True])
@pytest.mark.parametrize("name", EDITS)
def test_one_element_can_be_changed(trace, table, name, traced):
    edit = lambda i, j: trace.edit(jr.key(0), EDITS[name](table, i, j))[:2]  # noqa: E731
    new, weight = (jax.jit(edit) if traced else edit)(1, 2)
    np.testing.assert_array_equal(new.get_choices()["table"], table.at[1, 2].set(~table[1, 2]))
    changes_by_the_joint(trace, new, weight)
    same_types(new, trace)


def test_one_element_of_a_vmap_can_be_changed(trace):
    request = StaticRequest({"readings": IndexRequest(2, Update(C["r"].set(0.25)))})
    for edit in (request, Update(C["readings", 2, "r"].set(0.25))):
        new, weight, _, back = trace.edit(jr.key(0), edit)
        expected = trace.get_choices()["readings", "r"].at[2].set(0.25)
        np.testing.assert_array_equal(new.get_choices()["readings", "r"], expected)
        changes_by_the_joint(trace, new, weight)
        jax.tree.map(np.testing.assert_array_equal, new.edit(jr.key(0), back)[0].get_choices(), trace.get_choices())


@pytest.mark.parametrize("t", full_but([0, 2, 4], 2, 4))
def test_one_step_of_a_scan_or_all_can_be_changed(t):
    """The state of the next step changes, and with it the density of this step."""
    trace = step.scan(n=5).simulate(jr.key(0), (0.0, jnp.arange(5.0)))
    for request in (IndexRequest(t, Update(C["z"].set(0.25))), Update(C[t, "z"].set(0.25))):
        new, weight, _, _ = jax.jit(lambda r: trace.edit(jr.key(0), r))(request)
        np.testing.assert_array_equal(new.get_choices()["z"], trace.get_choices()["z"].at[t].set(0.25))
        changes_by_the_joint(trace, new, weight)
        np.testing.assert_array_equal(new.get_retval()[1], new.get_choices()["z"])
        same_types(new, trace)
    steps = jnp.arange(5.0)
    new, weight, _, back = trace.edit(jr.key(0), Update(C["y"].set(jnp.ones(5))), Diff.unknown_change((1.0, steps)))
    changes_by_the_joint(trace, new, weight)
    np.testing.assert_array_equal(back.constraint["y"], trace.get_choices()["y"])
    same_types(new, trace)


def test_an_edit_can_leave_and_return_from_an_impossible_value():
    """A score of -inf is not added to, which would give NaN."""
    trace, _ = genjax.flip.repeat(n=3).importance(jr.key(0), C.v(jnp.zeros(3)), (0.0,))
    impossible, down, _, back = trace.edit(jr.key(0), IndexRequest(1, Update(C.v(1.0))))
    assert down == impossible.get_score() == -jnp.inf
    restored, up, _, _ = impossible.edit(jr.key(0), back)
    assert up == jnp.inf
    assert restored.get_score() == trace.get_score() == 0.0


def test_old_and_new_trace_can_be_branches_of_cond(trace, table):
    """The new value is a float, and the trace keeps its Boolean dtype."""

    @jax.jit
    def flip_if(flag):
        new = trace.edit(jr.key(0), Update(C["table", 0, 0].set(1.0 - table[0, 0])))[0]
        return jax.lax.cond(flag, lambda: new, lambda: trace).get_choices()["table"]

    np.testing.assert_array_equal(flip_if(False), table)
    np.testing.assert_array_equal(flip_if(True), table.at[0, 0].set(~table[0, 0]))


def test_an_empty_request_rescores_if_arguments_changed_and_else_returns_the_trace(trace):
    new, weight, retdiff, _ = trace.edit(jr.key(0), EmptyRequest())
    assert weight == 0.0
    assert new is trace
    assert Diff.static_check_no_change(retdiff)
    for request in (EmptyRequest(), Update(C.n())):
        new, weight, _, _ = trace.edit(jr.key(0), request, Diff.unknown_change((0.6, 2.0)))
        assert new.get_args() == (0.6, 2.0)
        assert weight != 0.0
        changes_by_the_joint(trace, new, weight)
        same_types(new, trace)
    for diffs in (None, Diff.unknown_change((0.6, 2.0))):
        new, _, _, replaced = trace.update(jr.key(0), C.n(), diffs)
        assert replaced.static_is_empty()
        np.testing.assert_allclose(new.get_score(), model.assess(trace.get_choices(), new.get_args())[0], rtol=1e-6)


def test_project_sums_the_selected_scores(trace):
    parts = [trace.project(jr.key(0), Selection.at[name]) for name in ("table", "readings")]
    np.testing.assert_allclose(parts[0], trace.get_subtrace("table").get_score(), rtol=1e-6)
    np.testing.assert_allclose(sum(parts), trace.get_score(), rtol=1e-6)
    assert trace.project(jr.key(0), Selection.none()) == 0.0
    np.testing.assert_allclose(trace.project(jr.key(0), Selection.at["readings", "r"]), parts[1], rtol=1e-6)


def test_unchanged_sites_keep_their_traces_and_a_change_of_one_element_is_passed_on_as_such(trace, table):
    """A site whose arguments did not change keeps its trace with its score, so that edits cost little."""
    new, _, retdiff, _ = trace.edit(jr.key(0), Update(C["readings", "r"].set(jnp.zeros(5))))
    assert new.subtraces[("table",)].value is trace.subtraces[("table",)].value
    assert isinstance(Diff.tangents(retdiff)[0], type(genjax.NoChange))
    trace = model.map(lambda r: (jnp.logical_not(r[0]).astype(float) * 2.0, jnp.sum(r[0]))).simulate(jr.key(0), ARGS)
    retdiff = trace.edit(jr.key(0), Update(C["table", 1, 2].set(~table[1, 2])))[2]
    one_element, whole = Diff.tangents(retdiff)
    assert (one_element, whole) == (genjax.IndexChange((1, 2)), genjax.UnknownChange)
