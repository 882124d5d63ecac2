"""The mapping model with unknown poses: its geometry is that of the kernels; an edit weighs the change of the joint."""

from functools import cache

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest
from programs.edits import block, check_chain, single
from tiers import full_but

import bayesmap as bm
import bayesmap.gen as gen
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import IndexRequest, StaticRequest, Update
from bayesmap.programs.mapping import pose_sensor_model, sensor_model

GRID = bm.Grid((9, 7), 0.5, (-2.0, 1.0))
ANGLES = np.linspace(0, 2 * np.pi, 24, endpoint=False)
SIGMA = np.array([0.3, 0.3, 0.2], np.float32)
GUESSES = np.array([[-1.0, 2.0, 0.0], [0.3, 3.1, 1.0], [1.7, 2.4, -2.0], [5.0, 2.0, 3.0]])  # the last one is outside
SENSORS = {"gaussian": bm.Gaussian(0.3), "mixture": bm.BeamMixture(bm.Gaussian(0.2))}


@cache
def start(name="mixture"):
    """The model with unknown poses, a trace of it, and its compiled log density: once for all tests."""
    prior = gen.mv_normal_diag.vmap(in_axes=(0, None))(jnp.asarray(GUESSES), SIGMA)
    model = bm.mapping_model(GRID, prior, ANGLES, bm.Independent(0.2), SENSORS[name], max_range_m=4.0, min_range_m=0.1)
    return model, jax.jit(model.simulate)(jr.key(0), ()), jax.jit(lambda choices: model.assess(choices, ())[0])


@jax.jit
def edited(trace, request):
    return trace.edit(jr.key(0), request)


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
    expected = np.asarray(jax.jit(lambda w: fixed.distances_at(fixed.first_hits(w)))(walls)).reshape(found.shape)
    assert 0.2 < np.isinf(expected).mean() < 0.9
    np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("name", full_but(list(SENSORS), "mixture"))
def test_the_joint_is_that_of_known_poses_times_their_prior(name):
    _, trace, joint = start(name)
    choices = trace.get_choices()
    poses = np.asarray(choices["poses"])
    known = bm.mapping_model(GRID, poses, ANGLES, bm.Independent(0.2), SENSORS[name], max_range_m=4.0, min_range_m=0.1)
    prior = -0.5 * (((poses - GUESSES) / SIGMA) ** 2 + np.log(2 * np.pi)).sum() - len(poses) * np.log(SIGMA).sum()
    given = C["walls"].set(choices["walls"]) | C["readings"].set(choices["readings"])
    expected = jax.jit(lambda chm: known.assess(chm, ())[0])(given) + prior
    np.testing.assert_allclose(joint(choices), expected, rtol=1e-4)


@pytest.mark.parametrize("name", full_but(list(SENSORS), "mixture"))
def test_long_chains_of_edits(name):
    model, first, _ = start(name)

    def propose(trace, key):
        keys = jr.split(key, 5)
        i, j, s = jr.randint(keys[0], (3,), 0, jnp.array([8, 6, 4]))
        pose = trace.get_choices()["poses"][s] + 0.3 * jr.normal(keys[1], (3,))
        values = jr.uniform(keys[2], (4,)) < 0.5
        requests = (at(s, pose), single(i, j, values[0]), block(i, j, values))
        edits = [lambda r=r: trace.edit(key, r)[:2] for r in requests]
        return jax.lax.switch(jr.randint(keys[3], (), 0, 3), edits)

    def is_right(inner, choices):
        return (inner.ends == inner.gen_fn.ends(choices["walls"], choices["poses"])).all()

    check_chain(model, first, propose, is_right, rtol=1e-4)


def test_an_edit_of_a_pose_walks_the_beams_of_that_scan_alone_and_is_undone_by_its_backward_request():
    """The other scans' ends are set to a cell that their beams do not reach, and the edit must leave them there."""
    _, trace, joint = start()
    inner = trace.get_subtrace("readings")
    ends = jnp.full_like(inner.ends, 17).at[1].set(inner.ends[1])
    marked = trace.replace(subtraces=trace.subtraces | {("readings",): inner.replace(ends=ends)})
    new, weight, _, _ = edited(marked, at(1, jnp.array([0.2, 3.0, 0.9])))
    after = np.asarray(new.get_subtrace("readings").ends)
    assert (after[[0, 2, 3]] == 17).all()
    assert (after[1] != np.asarray(inner.ends[1])).any()
    weighs_the_change(weight, marked, new, joint)
    _, trace, _ = start()
    new, weight, _, back = edited(trace, at(2, jnp.array([1.0, 2.0, 0.0])))
    again, undone, _, _ = edited(new, back)
    np.testing.assert_array_equal(again.get_choices()["poses"], trace.get_choices()["poses"])
    np.testing.assert_array_equal(again.get_subtrace("readings").ends, trace.get_subtrace("readings").ends)
    np.testing.assert_allclose(undone, -weight, rtol=1e-4, atol=1e-3)


@pytest.mark.full
def test_poses_and_walls_can_change_in_one_edit_and_a_single_pose_has_a_single_scan():
    _, trace, joint = start()
    both = StaticRequest(at(0, jnp.array([-1.2, 2.2, 0.3])).addressed | single(3, 4, True).addressed)
    for request in (both, Update(C["poses"].set(trace.get_choices()["poses"] + 0.1) | C["walls", 2, 2].set(True))):
        new, weight, _, _ = edited(trace, request)
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
    new, weight, _, _ = edited(trace, request)
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
