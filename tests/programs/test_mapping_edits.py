"""Edits of cells: the weight is the change of the joint density, whatever was edited before."""

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest
from oracle.worlds import make_case
from programs.edits import block, check_chain, single
from tiers import full_but

import bayesmap as bm
import bayesmap.gen as gen
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import Diff, IndexChange, NoChange, Update
from bayesmap.programs.beam_sensor import BeamGeometry, BeamSensor
from bayesmap.programs.mapping import sensor_model

edit = jax.jit(lambda trace, request: trace.edit(jr.key(0), request))


def room(shape, n_poses, sensor, seed=0, beams=40):
    """A model, readings, and walls to start from: poses anywhere in a room that is longer than LOOK cells."""
    rng = np.random.default_rng(seed)
    grid = bm.Grid(shape, 0.5, (-2.0, 1.0))
    size = np.array(shape) * 0.5
    poses = np.column_stack([rng.uniform(0, 1, (n_poses, 2)) * size + grid.origin, rng.uniform(-3, 3, n_poses)])
    poses[0] = [-2.0 + 0.5 * (shape[0] // 2), 1.0 + 0.5 * (shape[1] // 2), 0.0]  # on a corner
    angles = np.linspace(0, 2 * np.pi, beams, endpoint=False)
    model = bm.mapping_model(
        grid, poses, angles, bm.Independent(rng.uniform(0.05, 0.6, shape)), sensor, max_range_m=9.0
    )
    readings = rng.uniform(0.0, 9.0, (n_poses, beams))
    readings[rng.random(readings.shape) < 0.05] = np.nan
    return model, jnp.asarray(readings), jnp.asarray(rng.random(shape) < 0.05)


def start(model, readings, walls):
    given = C["walls"].set(walls) | C["readings"].set(readings)
    return jax.jit(lambda given: model.importance(jr.key(0), given, ())[0])(given)


CASES = {
    "cells, gaussian": ((7, 9), 3, bm.Gaussian(0.5)),
    "cells, long beams": ((40, 3), 2, bm.StudentT(0.3, dof=4.0)),
    "blocks, mixture": ((9, 9), 1, bm.BeamMixture(bm.Gaussian(0.2))),
}


@pytest.mark.parametrize("name", full_but(list(CASES), "blocks, mixture"))
def test_long_chains_of_edits(name):
    """Random edits, walls as often as not, cells off every beam and repeats included."""
    (nx, ny), n_poses, sensor = CASES[name]
    model, readings, walls = room((nx, ny), n_poses, sensor)
    blocks = name.startswith("blocks")

    def propose(trace, key):
        keys = jr.split(key, 4)
        i, j = jr.randint(keys[0], (), 0, nx - blocks), jr.randint(keys[1], (), 0, ny - blocks)
        values = jr.uniform(keys[2], (4,)) < jr.uniform(keys[3])
        return trace.edit(key, block(i, j, values) if blocks else single(i, j, values[0]))[:2]

    def is_right(inner, choices):
        return (inner.first_hit == inner.gen_fn.first_hits(choices["walls"])).all()

    check_chain(model, start(model, readings, walls), propose, is_right, rtol=1e-5)


@pytest.fixture(scope="module")
def small():
    model, readings, walls = room((7, 9), 2, bm.Gaussian(0.5))
    return model, start(model, readings, walls)


def test_edits_do_not_read_the_whole_map(small, monkeypatch):
    """The rest of the model is not run again: neither all first hits nor the law of all readings."""
    _, trace = small
    monkeypatch.setattr(BeamSensor, "first_hits", lambda *_: pytest.fail("all beams were read"))
    for request in (single(3, 4, True), Update(C["walls", 3, 4].set(True)), block(2, 5, np.ones(4, bool))):
        _, _, retdiff, _ = jax.jit(lambda t, r=request: t.edit(jr.key(0), r))(trace)
        tangents = Diff.tangents(retdiff)
        assert isinstance(tangents[0], IndexChange)
        assert tangents[1] == NoChange
    with pytest.raises(pytest.fail.Exception, match="all beams"):
        trace.update(jr.key(0), C["walls"].set(np.ones((7, 9), bool)))


def test_the_work_on_one_cell_does_not_grow_with_the_map():
    """No value that it computes is of the map's size: the walls are read in place, not compared or copied."""
    sensor = sensor_model(bm.Grid((50, 51)), [25, 25, 0.0], 0.7 * np.arange(9.0), bm.Gaussian(0.1), max_range_m=60.0)

    def computed(jaxpr):
        for eqn in jaxpr.eqns:
            inner = [getattr(p, "jaxpr", p) for p in jax.tree.leaves(list(eqn.params.values())) if hasattr(p, "eqns")]
            if inner:
                for sub in inner:
                    yield from computed(sub)
            else:
                yield from (v.aval.size for v in eqn.outvars)

    first_hit = jnp.zeros(9, sensor.geometry.position_dtype)
    walls = jnp.zeros((50, 51), bool)
    program = jax.make_jaxpr(lambda w, h: sensor._change_cell(w, 7, h, jnp.ones(9)))(walls, first_hit)
    sizes = list(computed(program.jaxpr))
    assert len(sizes) > 30
    assert max(sizes) < 50 * 51


def test_backward_requests_undo_edits_those_that_change_nothing_weigh_nothing_and_indices_may_be_negative(small):
    _, trace = small
    for request in (single(3, 4, True), block(2, 5, np.array([True, False, True, True]))):
        new, weight, _, back = edit(trace, request)
        assert jax.tree.structure(new) == jax.tree.structure(trace)
        assert [x.dtype for x in jax.tree.leaves(new)] == [x.dtype for x in jax.tree.leaves(trace)]
        old, undone, _, _ = edit(new, back)
        np.testing.assert_array_equal(old.get_choices()["walls"], trace.get_choices()["walls"])
        np.testing.assert_allclose(undone, -weight, rtol=1e-5, atol=1e-4)
    _, trace = small
    same, weight, _, _ = edit(trace, single(3, 4, trace.get_choices()["walls"][3, 4]))
    assert weight == 0.0
    np.testing.assert_array_equal(same.get_subtrace("readings").first_hit, trace.get_subtrace("readings").first_hit)
    one, two = (edit(trace, single(i, j, True)) for i, j in ((6, 8), (-1, -1)))
    np.testing.assert_array_equal(one[0].get_choices()["walls"], two[0].get_choices()["walls"])
    assert one[1] == two[1]


@pytest.mark.full
def test_other_edits_are_right_too(small):
    """All walls at once, readings (all, one, one and a wall), regenerated parts."""
    model, trace = small
    assess = jax.jit(lambda choices: model.assess(choices, ())[0])
    readings = jnp.nan_to_num(trace.get_choices()["readings"], nan=1.0)
    requests = {
        "all walls": Update(C["walls"].set(jnp.ones((7, 9), bool))),
        "all readings": Update(C["readings"].set(readings + 0.3)),
        "one reading": Update(C["readings", 1, 3].set(2.5)),
        "one of each": Update(C["walls", 3, 4].set(True) | C["readings", 1, 3].set(2.5)),
        "by request": gen.StaticRequest({"readings": gen.IndexRequest(1, Update(C.v(readings[1])))}),
        "nothing": gen.EmptyRequest(),
    }
    for name, request in requests.items():
        new, weight, _, back = edit(trace, request)
        difference = assess(new.get_choices()) - assess(trace.get_choices())
        np.testing.assert_allclose(weight, difference, rtol=1e-4, atol=1e-3, err_msg=name)
        old, _, _, _ = edit(new, back)
        for address in ("walls", "readings"):
            np.testing.assert_array_equal(old.get_choices()[address], trace.get_choices()[address], err_msg=name)
    drawn, weight, _, _ = edit(trace, gen.Regenerate(gen.Selection.at["readings"]))
    assert weight == 0.0
    assert not np.array_equal(drawn.get_choices()["readings"], trace.get_choices()["readings"])
    moved, weight, _, _ = edit(trace, gen.Regenerate(gen.Selection.at["walls"]))
    before, after = (t.project(jr.key(0), gen.Selection.at["readings"]) for t in (trace, moved))
    np.testing.assert_allclose(weight, after - before, rtol=1e-4, atol=1e-3)


def test_no_beam_lists_a_cell_twice():
    """Edits rely on this: the beams of a cell are different beams. Poses are on corners, on lines and inside cells."""
    for seed in range(6):
        case = make_case(seed, shape=(4, 4), lattice=seed % 2 == 0, beams_per_pose=16)
        scans = case.scans
        sensor = sensor_model(case.grid, scans.poses, scans.angles_rad, case.sensor, max_range_m=3.0)
        geometry: BeamGeometry = sensor.geometry
        for row in geometry.cells:
            cells = row[row < geometry.n_cells]
            assert len(np.unique(cells)) == len(cells)
        for c in range(geometry.n_cells):
            entries = slice(geometry.offsets[c], geometry.offsets[c + 1])
            assert (geometry.cells[geometry.beam[entries], geometry.position[entries]] == c).all()
