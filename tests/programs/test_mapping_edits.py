"""The weight of an edit of cells or unknown poses is the change of the joint density, whatever was edited before."""

from functools import cache

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest
from oracle.worlds import make_case
from tiers import full_but

import bayesmap as bm
import bayesmap.gen as gen
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import Diff, IndexChange, IndexRequest, NoChange, StaticRequest, Update
from bayesmap.programs.beam_sensor import BeamGeometry, BeamSensor
from bayesmap.programs.mapping import SetCells, pose_sensor_model, sensor_model

BLOCK_I, BLOCK_J = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1])


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


edit = jax.jit(lambda trace, request: trace.edit(jr.key(0), request))


def room(shape, n_poses, sensor, seed=0, beams=40):
    """A model, readings, and walls to start from: poses anywhere in a room that is longer than CELLS_AT_ONCE cells."""
    rng = np.random.default_rng(seed)
    grid = bm.Grid(shape, 0.5, (-2.0, 1.0))
    size = np.array(shape) * 0.5
    poses = np.column_stack([rng.uniform(0, 1, (n_poses, 2)) * size + grid.origin, rng.uniform(-3, 3, n_poses)])
    poses[0] = [-2.0 + 0.5 * (shape[0] // 2), 1.0 + 0.5 * (shape[1] // 2), 0.0]  # on a corner
    angles = np.linspace(0, 2 * np.pi, beams, endpoint=False)
    prior = bm.Independent(rng.uniform(0.05, 0.6, shape))
    model = bm.mapping_model(grid, poses, angles, prior, sensor, max_range_m=9.0)
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
        return (inner.first_hit == inner.gen_fn.find_hits((choices["walls"],))).all()

    check_chain(model, start(model, readings, walls), propose, is_right, rtol=1e-5)


@pytest.fixture(scope="module")
def small():
    model, readings, walls = room((7, 9), 2, bm.Gaussian(0.5))
    return model, start(model, readings, walls)


def test_edits_do_not_read_the_whole_map(small, monkeypatch):
    """The rest of the model is not run again: neither all first hits nor the law of all readings."""
    _, trace = small
    monkeypatch.setattr(BeamSensor, "find_hits", lambda *_: pytest.fail("all beams were read"))
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

    first_hit = jnp.zeros(9, np.min_scalar_type(sensor.geometry.n_outcomes))
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
    joint = jax.jit(lambda choices: model.assess(choices, ())[0])
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
        weighs_the_change(weight, trace, new, joint)
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
            assert (geometry.cells[geometry.crossing_beam[entries], geometry.crossing_position[entries]] == c).all()


GRID = bm.Grid((9, 7), 0.5, (-2.0, 1.0))
ANGLES = np.linspace(0, 2 * np.pi, 24, endpoint=False)
SIGMA = np.array([0.3, 0.3, 0.2], np.float32)
GUESSES = np.array([[-1.0, 2.0, 0.0], [0.3, 3.1, 1.0], [1.7, 2.4, -2.0], [5.0, 2.0, 3.0]])  # the last one is outside
SENSORS = {"gaussian": bm.Gaussian(0.3), "mixture": bm.BeamMixture(bm.Gaussian(0.2))}


@cache
def pose_start(name="mixture"):
    """The model with unknown poses, a trace of it, and its compiled log density: once for all tests."""
    prior = gen.mv_normal_diag.vmap(in_axes=(0, None))(jnp.asarray(GUESSES), SIGMA)
    model = bm.mapping_model(GRID, prior, ANGLES, bm.Independent(0.2), SENSORS[name], max_range_m=4.0, min_range_m=0.1)
    return model, jax.jit(model.simulate)(jr.key(0), ()), jax.jit(lambda choices: model.assess(choices, ())[0])


def weighs_the_change(weight, old, new, joint):
    np.testing.assert_allclose(weight, joint(new.get_choices()) - joint(old.get_choices()), rtol=1e-4, atol=2e-3)


def at(s, pose):
    return StaticRequest({"poses": IndexRequest(s, Update(C.v(pose)))})


@pytest.mark.parametrize("depth", full_but([0.0, 0.5], 0.5))
def test_beams_end_where_those_of_known_poses_do(depth):
    """From inside the grid and from outside, in walls and out of them; those of known poses are traced in float64."""
    rng = np.random.default_rng(1)
    poses = np.column_stack([rng.uniform(-4, 4, 60), rng.uniform(-1, 6, 60), rng.uniform(-9, 9, 60)])
    walls = rng.random(GRID.shape) < 0.15
    moving = pose_sensor_model(GRID, ANGLES, bm.Gaussian(0.2), max_range_m=50.0, hit_depth=depth)
    fixed = sensor_model(GRID, poses, ANGLES, bm.Gaussian(0.2), max_range_m=50.0, hit_depth=depth)
    found = np.asarray(jax.jit(lambda w: moving.distances_m(poses, moving.ends(w, poses)))(walls))
    expected = np.asarray(jax.jit(lambda w: fixed.distances_at(fixed.find_hits((w,))))(walls)).reshape(found.shape)
    assert 0.2 < np.isinf(expected).mean() < 0.9
    np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("name", full_but(list(SENSORS), "mixture"))
def test_the_joint_is_that_of_known_poses_times_their_prior(name):
    _, trace, joint = pose_start(name)
    choices = trace.get_choices()
    poses = np.asarray(choices["poses"])
    known = bm.mapping_model(GRID, poses, ANGLES, bm.Independent(0.2), SENSORS[name], max_range_m=4.0, min_range_m=0.1)
    prior = -0.5 * (((poses - GUESSES) / SIGMA) ** 2 + np.log(2 * np.pi)).sum() - len(poses) * np.log(SIGMA).sum()
    given = C["walls"].set(choices["walls"]) | C["readings"].set(choices["readings"])
    np.testing.assert_allclose(joint(choices), jax.jit(lambda chm: known.assess(chm, ())[0])(given) + prior, rtol=1e-4)


@pytest.mark.parametrize("name", full_but(list(SENSORS), "mixture"))
def test_long_chains_of_edits_of_poses_and_cells(name):
    model, first, _ = pose_start(name)

    def propose(trace, key):
        keys = jr.split(key, 5)
        i, j, s = jr.randint(keys[0], (3,), 0, jnp.array([8, 6, 4]))
        pose = trace.get_choices()["poses"][s] + 0.3 * jr.normal(keys[1], (3,))
        values = jr.uniform(keys[2], (4,)) < 0.5
        requests = (at(s, pose), single(i, j, values[0]), block(i, j, values))
        return jax.lax.switch(jr.randint(keys[3], (), 0, 3), [lambda r=r: trace.edit(key, r)[:2] for r in requests])

    def is_right(inner, choices):
        return (inner.ends == inner.gen_fn.ends(choices["walls"], choices["poses"])).all()

    check_chain(model, first, propose, is_right, rtol=1e-4)


def test_an_edit_of_a_pose_walks_the_beams_of_that_scan_alone_and_is_undone_by_its_backward_request():
    """The other scans' ends are set to a cell that their beams do not reach, and the edit must leave them there."""
    _, trace, joint = pose_start()
    inner = trace.get_subtrace("readings")
    ends = jnp.full_like(inner.ends, 17).at[1].set(inner.ends[1])
    marked = trace.replace(subtraces=trace.subtraces | {("readings",): inner.replace(ends=ends)})
    new, weight, _, _ = edit(marked, at(1, jnp.array([0.2, 3.0, 0.9])))
    after = np.asarray(new.get_subtrace("readings").ends)
    assert (after[[0, 2, 3]] == 17).all()
    assert (after[1] != np.asarray(inner.ends[1])).any()
    weighs_the_change(weight, marked, new, joint)
    new, weight, _, back = edit(trace, at(2, jnp.array([1.0, 2.0, 0.0])))
    again, undone, _, _ = edit(new, back)
    np.testing.assert_array_equal(again.get_choices()["poses"], trace.get_choices()["poses"])
    np.testing.assert_array_equal(again.get_subtrace("readings").ends, trace.get_subtrace("readings").ends)
    np.testing.assert_allclose(undone, -weight, rtol=1e-4, atol=1e-3)


@pytest.mark.full
def test_poses_and_walls_can_change_in_one_edit_and_a_single_pose_has_a_single_scan():
    _, trace, joint = pose_start()
    both = StaticRequest(at(0, jnp.array([-1.2, 2.2, 0.3])).addressed | single(3, 4, True).addressed)
    for request in (both, Update(C["poses"].set(trace.get_choices()["poses"] + 0.1) | C["walls", 2, 2].set(True))):
        new, weight, _, _ = edit(trace, request)
        weighs_the_change(weight, trace, new, joint)
    prior = gen.mv_normal_diag(jnp.array(GUESSES[0]), SIGMA)
    model = bm.mapping_model(GRID, prior, ANGLES, bm.Independent(0.2), bm.Gaussian(0.3), max_range_m=4.0)
    trace, weight = model.importance(jr.key(0), C["readings"].set(jnp.ones(24)), ())
    assert trace.get_choices()["poses"].shape == (3,)
    np.testing.assert_allclose(weight, trace.get_subtrace("readings").get_score(), rtol=1e-5)


@gen.gen
def step(pose, odometry):
    pose = gen.mv_normal_diag(pose + odometry, SIGMA / 10) @ "pose"
    return pose, pose


@gen.gen
def walk(odometry):
    return (step.scan()(jnp.array(GUESSES[0]), odometry) @ "steps")[1]


@pytest.mark.full
def test_the_prior_may_be_a_motion_model():
    odometry = jnp.array([[0.3, 0.1, 0.2]] * 4)
    model = bm.mapping_model(GRID, walk(odometry), ANGLES, bm.Independent(0.2), bm.Gaussian(0.3), max_range_m=4.0)
    trace = model.simulate(jr.key(0), ())
    assert trace.get_choices()["readings"].shape == (4, 24)
    moved = trace.get_choices()["poses", "steps", "pose"][1] + 0.05
    request = StaticRequest({"poses": StaticRequest({"steps": IndexRequest(1, Update(C["pose"].set(moved)))})})
    new, weight, _, _ = edit(trace, request)
    weighs_the_change(weight, trace, new, lambda choices: model.assess(choices, ())[0])
    before, after = (t.get_subtrace("readings").ends for t in (trace, new))
    np.testing.assert_array_equal(before[np.array([0, 2, 3])], after[np.array([0, 2, 3])])
    assert (before[1] != after[1]).any()


def test_bad_input_is_named():
    sensor = {"sensor": bm.Gaussian(0.3), "max_range_m": 4.0, "angles_rad": ANGLES, "prior": bm.Independent(0.2)}
    with pytest.raises(bm.BadInput, match=r"prior of the poses must return an array \(3,\) or \(S, 3\), found .*2"):
        bm.mapping_model(GRID, gen.mv_normal_diag(jnp.zeros(2), jnp.ones(2)), **sensor)
    with pytest.raises(bm.BadInput, match="prior of the poses must run without arguments"):
        bm.mapping_model(GRID, gen.mv_normal_diag, **sensor)
    alone = pose_sensor_model(GRID, ANGLES, bm.Gaussian(0.3), max_range_m=4.0)
    with pytest.raises(bm.BadInput, match=r"walls has shape \(2, 2\), expected \(9, 7\)"):
        alone.simulate(jr.key(0), (np.zeros((2, 2)), np.zeros(3)))
    with pytest.raises(bm.BadInput, match=r"poses has shape \(4,\), expected"):
        alone.simulate(jr.key(0), (np.zeros((9, 7)), np.zeros(4)))
