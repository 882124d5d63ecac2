"""A generative function with its own edit, which recomputes only what one cell affects.

The model is a row of scales: each scale reads the total weight of three cells, plus noise. A change of one cell changes
one scale, as a change of a map's cell changes the beams through it.
"""

from typing import Any

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest

import bayesmap.gen as gen
from bayesmap.gen import ChoiceMap, Diff, IndexChange, NoChange, Pytree, Update
from bayesmap.gen import ChoiceMapBuilder as C

CELLS, PER_SCALE = 12, 3
full_recomputations: list[str] = []


@Pytree.dataclass
class ScalesTrace(gen.Trace):
    """Keeps the cells and the totals, so that a change of one cell is a change of one total."""

    gen_fn: Any
    args: Any
    cells: Any
    totals: Any
    retval: Any
    score: Any

    def get_choices(self):
        return ChoiceMap.choice(self.retval)


@Pytree.dataclass
class Scales(gen.GenerativeFunction):
    """`scales(cells)`: cells of shape (12,), readings of shape (4,) ~ Normal(total of three cells, 0.5)."""

    def totals(self, cells):
        full_recomputations.append("totals")
        return jnp.asarray(cells, float).reshape(-1, PER_SCALE).sum(axis=1)

    def build(self, args, readings):
        totals = self.totals(args[0])
        score = gen.normal.assess(C.v(readings), (totals, 0.5))[0]
        return ScalesTrace(self, args, jnp.asarray(args[0]), totals, readings, score)

    def simulate(self, key, args):
        return self.build(args, gen.normal.sample(key, self.totals(args[0]), 0.5))

    def assess(self, choices, args):
        return gen.normal.assess(choices, (self.totals(args[0]), 0.5))

    def generate(self, key, constraint, args):
        inner, weight = gen.normal.generate(key, constraint, (self.totals(args[0]), 0.5))
        return self.build(args, inner.get_retval()), weight

    def project(self, key, trace, selection):
        return trace.score if selection.check() else jnp.zeros(())

    def edit(self, key, trace, request, argdiffs):
        (cells,) = argdiffs
        if isinstance(request, Update) and request.constraint.static_is_empty():
            match cells.tangent:
                case IndexChange((i,)):
                    return self.move_one(trace, i, cells.primal)
        args = Diff.tree_primal(argdiffs)
        new = self.build(args, (request.constraint | trace.get_choices())[()])
        undo = Update(request.constraint & trace.get_choices())
        return new, new.score - trace.score, Diff.unknown_change(new.retval), undo

    def move_one(self, trace, i, cells):
        scale = i // PER_SCALE
        old = trace.totals[scale]
        new = old + jnp.asarray(cells[i], float) - jnp.asarray(trace.cells[i], float)
        reading = trace.retval[scale]
        density = lambda total: gen.normal.assess(C.v(reading), (total, 0.5))[0]  # noqa: E731
        weight = density(new) - density(old)
        moved = trace.replace(cells=cells, totals=trace.totals.at[scale].set(new), score=trace.score + weight)
        return moved, weight, Diff.no_change(trace.retval), Update(C.n())


scales = Scales()


@gen.gen
def model(p):
    return scales(gen.flip.repeat(n=CELLS)(p) @ "cells") @ "readings"


def test_a_user_s_generative_function_joins_a_larger_model_and_a_sweep_of_its_edits_keeps_the_score():
    trace = model.simulate(jr.key(0), (0.5,))
    score, _ = model.assess(trace.get_choices(), (0.5,))
    np.testing.assert_allclose(trace.get_score(), score, rtol=1e-6)
    constrained, weight = model.importance(jr.key(0), C["readings"].set(jnp.ones(4)), (0.5,))
    np.testing.assert_allclose(weight, constrained.get_subtrace("readings").get_score(), rtol=1e-6)

    @jax.jit
    def sweep(trace, key):
        def step(i, trace):
            new, weight, _, _ = trace.edit(key, Update(C["cells", i].set(1.0 - trace.get_choices()["cells"][i])))
            return jax.lax.cond(jnp.log(jr.uniform(jr.fold_in(key, i))) < weight, lambda: new, lambda: trace)

        return jax.lax.fori_loop(0, CELLS, step, trace)

    swept = sweep(trace, jr.key(0))
    np.testing.assert_allclose(swept.get_score(), model.assess(swept.get_choices(), (0.5,))[0], rtol=1e-4)


@pytest.mark.parametrize("traced", [False, True])
def test_a_change_of_one_element_reaches_its_edit_as_such(traced):
    """The weight is the joint's, and the whole was not recomputed."""
    trace = model.simulate(jr.key(0), (0.5,))
    cells = trace.get_choices()["cells"]

    def edit(i):
        return trace.edit(jr.key(0), gen.StaticRequest({"cells": gen.IndexRequest(i, Update(C.v(1.0 - cells[i])))}))

    full_recomputations.clear()
    new, weight, retdiff, back = (jax.jit(edit) if traced else edit)(7)
    assert full_recomputations == []
    assert all(t == NoChange for t in Diff.tangents(retdiff))
    joint = lambda t: model.assess(t.get_choices(), (0.5,))[0]  # noqa: E731
    np.testing.assert_allclose(weight, joint(new) - joint(trace), rtol=1e-4)
    restored, undone, _, _ = new.edit(jr.key(0), back)
    np.testing.assert_array_equal(restored.get_choices()["cells"], cells)
    np.testing.assert_allclose(undone, -weight, rtol=1e-5)
    new, weight, _, _ = trace.update(jr.key(0), C["cells"].set(jnp.ones(CELLS, bool)))
    assert full_recomputations != [], "any other change is recomputed"
    np.testing.assert_allclose(weight, new.get_score() - trace.get_score(), rtol=1e-5)
