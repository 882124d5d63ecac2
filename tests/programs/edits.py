"""Mapping models of small worlds, requests for their cells, and a check of long chains of edits."""

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np

import bayesmap as bm
import bayesmap.gen as gen
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import Update
from bayesmap.programs.mapping import SetCells

BLOCK_I, BLOCK_J = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1])


def of_case(case):
    scans = case.scans
    limits = {"max_range_m": scans.max_range_m, "min_range_m": scans.min_range_m}
    return bm.mapping_model(case.grid, scans.poses, scans.angles_rad, case.prior, case.sensor, **limits)


def single(i, j, value):
    """Return an edit of one cell, in arrays of one dtype: such edits and their ways back are one compiled program."""
    update = Update(C.v(jnp.asarray(value, bool)))
    return gen.StaticRequest({"walls": gen.IndexRequest(jnp.int32(i), gen.IndexRequest(jnp.int32(j), update))})


def block(i, j, values):
    cells = (jnp.asarray(first + offsets, jnp.int32) for first, offsets in ((i, BLOCK_I), (j, BLOCK_J)))
    return gen.StaticRequest({"walls": SetCells(*cells, jnp.asarray(values, bool))})


def check_chain(model, start, propose, is_right, rtol):
    """Make 400 edits `propose(trace, key) -> (new trace, weight)`.

    After each, the weight, the score, and by `is_right` what the sensor's trace stores, are those of a run from
    scratch.
    """

    def step(carry, key):
        trace, before = carry
        new, weight = propose(trace, key)
        after = model.assess(new.get_choices(), ())[0]
        right = is_right(new.get_subtrace("readings"), new.get_choices())
        return (new, after), (weight, after - before, new.get_score(), after, right)

    @jax.jit
    def chain(trace):
        return jax.lax.scan(step, (trace, model.assess(trace.get_choices(), ())[0]), jr.split(jr.key(0), 400))

    (last, _), (weight, difference, score, assessed, right) = chain(start)
    assert right.all()
    np.testing.assert_allclose(weight, difference, rtol=rtol, atol=1e-6 * np.abs(assessed).max() + 2e-3)
    np.testing.assert_allclose(score, assessed, rtol=max(3e-6, rtol / 10), atol=2e-3)
    assert len(np.unique(np.asarray(assessed))) > 100  # power: the edits did matter
    np.testing.assert_array_equal(last.get_choices()["readings"], start.get_choices()["readings"])
