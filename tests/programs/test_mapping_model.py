"""The mapping model as a generative function: its densities and its posterior are those of `infer`, and it composes."""

import pickle
import re
from dataclasses import replace
from pathlib import Path

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest
from conformance.gen_tutorial_model import CENTER, PARAMS, full_model
from oracle.enumeration import sweeps
from oracle.verdict import ALPHA, least_p_value
from oracle.worlds import make_case
from test_mapping_edits import single
from tiers import full_but, latin

import bayesmap as bm
import bayesmap.gen as gen
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.kernels.walls.table import trace
from bayesmap.programs.mapping import sensor_model
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.sensors.model import RangeLimits

PAGE = Path(__file__).resolve().parents[2] / "docs" / "mapping-model.md"
ANGLES = np.arange(100) / 100 * 2 * np.pi
SENSORS = {
    "gaussian": bm.Gaussian(0.5), "growing": bm.Gaussian(0.1, sigma_per_m=0.05),
    "student": bm.StudentT(0.2, dof=3.0, scale_per_m=0.02), "mixture": bm.BeamMixture(bm.Gaussian(0.1)),
    "student mixture": bm.BeamMixture(bm.StudentT(0.1, dof=2.5), p_random=0.1, p_no_return=0.2, p_short=0.3),
}  # fmt: skip
TABLE_CUT = 1e-4  # nats a beam: where the mixture's beam table ends early (FLAT_NATS)


def of_case(case):
    scans = case.scans
    limits = {"max_range_m": scans.max_range_m, "min_range_m": scans.min_range_m}
    return bm.mapping_model(case.grid, scans.poses, scans.angles_rad, case.prior, case.sensor, **limits)


def both(walls, readings):
    return C["walls"].set(walls) | C["readings"].set(readings)


@pytest.mark.parametrize(("name", "lattice"), latin(2, list(SENSORS), [False, True]))
def test_assess_is_infer_s_log_joint(name, lattice):
    """No constants are left out on either side; float32 sums against float64 ones. Typed readings included."""
    case = replace(make_case(11, shape=(4, 3), n_poses=3, lattice=lattice, beams_per_pose=16), sensor=SENSORS[name])
    readings = case.scans.ranges_m.copy()
    readings[0, :3], readings[1, :2] = np.inf, -np.inf
    scans = bm.Scans(case.scans.poses, case.scans.angles_rad, readings, max_range_m=3.0, min_range_m=0.1)
    model, rng = of_case(case), np.random.default_rng(1)
    problem = WallProblem(trace(scans, case.grid, case.sensor), case.prior, scans.poses)
    maps = rng.random((50, *case.grid.shape)) < rng.random((50, 1, 1))
    assess = jax.jit(jax.vmap(lambda w: model.assess(both(w, jnp.asarray(readings)), ())[0]))
    expected = [problem.log_joint(w) for w in maps]
    np.testing.assert_allclose(assess(maps), expected, rtol=3e-6, atol=TABLE_CUT * readings.size + 1e-4)


def test_a_probability_for_each_cell_importance_weighs_by_what_is_given_and_project_divides_the_score():
    case = make_case(3, shape=(4, 4), prior="cells")
    problem, model = case.problem(), of_case(case)
    walls = np.asarray(case.walls)
    readings = jnp.asarray(case.scans.ranges_m)
    assess = jax.jit(lambda w: model.assess(both(w, readings), ())[0])
    np.testing.assert_allclose(assess(walls), problem.log_joint(walls), rtol=1e-5)
    assert assess(np.where(np.asarray(case.prior.p_wall) == 0, True, walls)) == -np.inf
    case = make_case(6, shape=(3, 3), prior=0.3)
    model, readings = of_case(case), jnp.asarray(case.scans.ranges_m)
    trace, weight = jax.jit(lambda chm: model.importance(jr.key(0), chm, ()))(C["readings"].set(readings))
    walls = np.asarray(trace.get_choices()["walls"])
    np.testing.assert_allclose(weight, case.problem().table.log_likelihood(walls), rtol=1e-5)
    parts = [trace.project(jr.key(0), gen.Selection.at[name]) for name in ("readings", "walls")]
    np.testing.assert_allclose(parts, [weight, case.prior.log_prob(walls, case.grid)], rtol=1e-5)
    empty, nothing = jax.jit(lambda: model.importance(jr.key(0), C.n(), ()))()
    assert nothing == 0.0
    assess = jax.jit(lambda chm: model.assess(chm, ())[0])
    np.testing.assert_allclose(empty.get_score(), assess(empty.get_choices()), rtol=1e-5)


def test_assess_and_the_maps_drawn_are_those_of_the_tutorial_s_own_program():
    grid = bm.worlds.TUTORIAL_GRID
    sensor, pose = bm.Gaussian(0.2), [10.0, 10.0, 0.0]
    tutorial = bm.mapping_model(grid, pose, ANGLES, bm.Independent(0.5), sensor, max_range_m=42.0)
    drawn, prior = tutorial.simulate(jr.key(0), ()), gen.flip.repeat(n=21).repeat(n=21)
    expected = prior.simulate(jr.fold_in(jr.key(0), 1), (0.5,)).get_retval()
    np.testing.assert_array_equal(drawn.get_choices()["walls"], expected)
    rng = np.random.default_rng(0)
    walls, _ = bm.worlds.tutorial()
    readings = bm.simulate(walls, grid, pose, ANGLES, sensor=sensor, max_range_m=42.0).ranges_m[0]
    plain = jax.jit(lambda w: full_model.assess(both(w, jnp.asarray(readings)), (CENTER, PARAMS))[0])
    ours = jax.jit(lambda w: tutorial.assess(both(w, readings), ())[0])
    for w in (walls, np.zeros_like(walls), rng.random(walls.shape) < 0.1):
        # Beams at multiples of 45 degrees graze corners, where the tutorial's float32 hits or misses; they are the
        # same in float64 (tests/kernels/test_rays.py).
        np.testing.assert_allclose(ours(w), plain(w), rtol=2e-5)


@pytest.mark.parametrize("name", full_but(list(SENSORS), "growing", "student mixture"))
def test_simulated_readings_follow_the_sensor(name):
    """Against the sensor's own sampler: the share of each kind, and quartiles, to five standard errors."""
    grid, walls = bm.Grid((6, 6), 0.5), np.zeros((6, 6), bool)
    walls[4] = True
    sensor = sensor_model(grid, [1.0, 1.6, 0.0], [0.0, 0.5, 2.0], SENSORS[name], max_range_m=2.5, min_range_m=0.2)
    n = 20_000
    ours = np.asarray(jax.jit(jax.vmap(lambda k: sensor.simulate(k, (walls,)).get_retval()))(jr.split(jr.key(0), n)))
    distance = np.broadcast_to([1.0, 1.0 / np.cos(0.5), np.inf], (n, 3))
    theirs = SENSORS[name].sample(np.random.default_rng(0), distance, RangeLimits(0.2, 2.5))
    for beam in range(3):
        a, b = ours[:, beam], theirs[:, beam]
        for cut in [-np.inf, *np.quantile(b[np.isfinite(b)], [0.1, 0.25, 0.5, 0.75, 0.9]), 1e9]:
            p, q = np.mean(a <= cut), np.mean(b <= cut)
            assert abs(p - q) <= 5 * np.sqrt(2 * max(q * (1 - q), 1e-4) / n), (name, beam, cut)


@pytest.mark.full
def test_it_nests_in_a_bigger_model():
    inner = of_case(make_case(5, shape=(3, 3)))

    @gen.gen
    def robot():
        walls, readings = inner() @ "map"
        return walls, jnp.where(gen.flip(0.1) @ "broken", jnp.nan, readings)

    trace = jax.jit(robot.simulate)(jr.key(0), ())
    choices = trace.get_choices()
    assert choices["map", "walls"].shape == (3, 3)
    score = inner.assess(choices("map"), ())[0] + gen.flip.assess(C.v(choices["broken"]), (0.1,))[0]
    np.testing.assert_allclose(trace.get_score(), score, rtol=1e-5)
    cell = choices["map", "walls"][1, 2]
    new, weight, _, _ = jax.jit(lambda t, c: t.update(jr.key(0), c))(trace, C["map", "walls", 1, 2].set(~cell))
    np.testing.assert_allclose(weight, new.get_score() - trace.get_score(), rtol=1e-3, atol=1e-3)


def test_a_batch_of_traces_is_a_trace_which_can_be_pickled_and_equal_models_are_equal():
    case = make_case(7, shape=(3, 3))
    model = of_case(case)
    batch = jax.jit(jax.vmap(lambda k: model.simulate(k, ())))(jr.split(jr.key(0), 7))
    assert batch.get_score().shape == (7,)
    scores = jax.jit(jax.vmap(lambda c: model.assess(c, ())[0]))(batch.get_choices())
    np.testing.assert_allclose(batch.get_score(), scores, rtol=1e-5)
    # Geometry and prior are no leaves: a batch does not repeat them.
    assert sum(leaf.size for leaf in jax.tree.leaves(batch)) <= 7 * (9 + 2 * case.scans.n_beams + 2)
    one, two = of_case(case), of_case(case)
    assert jax.tree.structure(one) == jax.tree.structure(two)
    trace = one.simulate(jr.key(0), ())
    again = pickle.loads(pickle.dumps(trace))
    assert jax.tree.structure(again) == jax.tree.structure(trace)
    np.testing.assert_array_equal(again.get_choices()["readings"], trace.get_choices()["readings"])
    other = bm.mapping_model(case.grid, [[0, 3, 0.0]], [0.0], case.prior, case.sensor, max_range_m=3.0)
    assert jax.tree.structure(other) != jax.tree.structure(one)


class Odd(bm.Gaussian):
    def kernel_parameters(self):
        return None


def test_bad_input_is_named():
    noise, walls, readings = bm.Gaussian(0.1), np.zeros((3, 3), bool), np.ones(2)
    alone = sensor_model(bm.Grid((3, 3)), [1, 1, 0], [0.0], noise, max_range_m=5.0)

    def model(p_wall=0.5, sensor=noise, max_range_m=5.0):
        prior = bm.Independent(p_wall)
        return bm.mapping_model(bm.Grid((3, 3)), [1, 1, 0], [0.0, 1.0], prior, sensor, max_range_m=max_range_m)

    for message, use in {
        r"'walls': found \(3, 4\), expected \(3, 3\)": lambda: model().assess(both(np.zeros((3, 4)), readings), ()),
        r"'readings': found \(1, 2\), expected \(2,\)": lambda: model().assess(both(walls, np.ones((1, 2))), ()),
        r"'walls'.*0\.5": lambda: model().assess(both(walls + 0.5, readings), ()),
        "'wals'": lambda: model().importance(jr.key(0), C["wals"].set(walls), ()),
        "'readings'": lambda: model().assess(C["walls"].set(walls), ()),
        r"p_wall must lie in \[0, 1\]": lambda: model(1.5),
        r"p_wall has shape \(2, 2\), but the grid is \(3, 3\)": lambda: model(np.full((2, 2), 0.5)),
        "Odd has no likelihood on JAX": lambda: model(sensor=Odd(0.1)),
        "max_range_m must be a positive": lambda: model(max_range_m=-1.0),
        r"walls has shape \(2, 2\), expected \(3, 3\)": lambda: alone.simulate(jr.key(0), (np.zeros((2, 2), bool),)),
    }.items():
        with pytest.raises(bm.BadInput, match=message):
            use()


@pytest.mark.full
def test_the_example_of_the_page_runs():
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL))
    names = {}
    exec(compile(code, str(PAGE), "exec"), names)
    model, run = names["model"], names["run"]
    np.testing.assert_allclose(names["score"], run.log_joint[0, -1], rtol=1e-5)
    change = names["edited"].get_score() - names["trace"].get_score()
    np.testing.assert_allclose(names["weight"], change, rtol=1e-3, atol=0.5)  # scores near -1e6, in float32
    moved = names["both"].assess(names["after"].get_choices(), ())[0]
    np.testing.assert_allclose(names["pose_weight"], moved - names["start"].get_score(), rtol=1e-3, atol=0.05)
    assert model.simulate(names["key"], ()).get_choices()["readings"].shape == (100,)


TESTS = 2  # statistical tests in this module: together they fail for one in ten thousand seeds (ALPHA)
CHAINS = 20_000


@pytest.fixture(scope="module")
def case():
    return make_case(21, shape=(3, 3), n_poses=2, prior=0.3)


@pytest.fixture(scope="module")
def model(case):
    return of_case(case)


@pytest.fixture(scope="module")
def chains(case, model):
    """Final maps (CHAINS, 9) of that many independent chains from the empty map, after a number of raster sweeps."""
    choices = C["walls"].set(jnp.zeros((3, 3), bool)) | C["readings"].set(jnp.asarray(case.scans.ranges_m))
    start, _ = model.importance(jr.key(0), choices, ())

    def step(k, trace, key):
        i, j = k // 3 % 3, k % 3
        new, weight, _, _ = trace.edit(key, single(i, j, ~trace.get_choices()["walls"][i, j]))
        accept = jr.bernoulli(jr.fold_in(key, k), jax.nn.sigmoid(weight))  # two outcomes: this is Gibbs
        return jax.lax.cond(accept, lambda: new, lambda: trace)

    @jax.jit
    def run(keys, updates):
        one = lambda key: jax.lax.fori_loop(0, updates, lambda k, t: step(k, t, key), start)  # noqa: E731
        return jax.vmap(one)(keys).get_choices()["walls"]

    return lambda n: np.asarray(run(jr.split(jr.key(n), CHAINS), 9 * n)).reshape(CHAINS, 9)


@pytest.mark.parametrize("n", full_but([2, 30], 2))
def test_gibbs_by_edits_has_the_law_of_gibbs(case, chains, n):
    """After any number of sweeps, not only in the end: 2, and 30, where it is the posterior."""
    p = sweeps(np.eye(512)[0], case.exact.log_joint, 9, [[c] for c in range(9)], n)
    if n == 30:
        np.testing.assert_allclose(p, case.exact.p, atol=1e-4)
    assert least_p_value(chains(n), p) > ALPHA / TESTS
