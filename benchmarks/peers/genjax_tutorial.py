"""The mapping tutorial under GenJAX 0.10.3: the samplers that bayesmap grew out of, timed.

The code is the tutorial's own computation, so that the ratio in our benchmark means what it says: a
pixel's update runs the whole model twice through `full_model.assess`, inside two `fori_loop`s, under
`jit`. Only the 2 x 2 block sweep goes beyond the text, by the same means: `assess` for each of a block's
16 patterns. GenJAX runs with what XLA makes of it on all the cores that the process may use.

Run it with an interpreter that has GenJAX 0.10.3 (`python -m benchmarks.environments genjax` makes one):
`python genjax_tutorial.py --case raster --repeats 5 --json`.
"""

import hashlib
from collections.abc import Callable
from itertools import product
from pathlib import Path

import genjax
import harness
import jax
import jax.numpy as jnp
import numpy as np
from genjax import ChoiceMapBuilder as C
from genjax_model import CENTER, GRID_SIZE, TRUE_WALLS, ModelParams, full_model, log_joint, observe, walls_prior

PARTICLES = 10_000


def gibbs_update_pixel(key, args, readings, walls, i, j):
    """Draw one pixel from its conditional, by assessing the model without and with a wall there."""
    false_weight = log_joint(args, readings, walls.at[i, j].set(0))
    true_weight = log_joint(args, readings, walls.at[i, j].set(1))
    weights = jnp.array([false_weight, true_weight])
    return genjax.categorical.sample(key, weights).astype(jnp.float32)


def simple_gibbs_sweep(key, args, readings, walls):
    """Every pixel once, row by row."""
    subkeys = jax.random.split(key, walls.shape)

    def update(i, j, walls):
        return walls.at[i, j].set(gibbs_update_pixel(subkeys[i, j], args, readings, walls, i, j))

    return for_each_pixel(update, walls, walls.shape)


def for_each_pixel(update, state, shape):
    """The two nested loops that all sweeps run: `state = update(i, j, state)` in raster order."""
    return jax.lax.fori_loop(
        0,
        shape[0],
        lambda i, state: jax.lax.fori_loop(0, shape[1], lambda j, state: update(i, j, state), state),
        state,
    )


def smarter_gibbs_update_distance(key, args, readings, walls, dist):
    """Every pixel at L1 distance `dist` from the sensor."""
    pos, _params = args
    subkeys = jax.random.split(key, (GRID_SIZE, GRID_SIZE))

    def update(i, j, walls):
        new_value = jax.lax.cond(
            jnp.sum(jnp.floor(jnp.abs(jnp.array([i, j]) - pos))) == dist,
            lambda: gibbs_update_pixel(subkeys[i, j], args, readings, walls, i, j),
            lambda: walls[i, j],
        )
        return walls.at[i, j].set(new_value)

    return for_each_pixel(update, walls, walls.shape)


def smarter_gibbs_update(key, args, readings, walls):
    """Every pixel once, from the sensor outwards, diamond by diamond."""
    subkeys = jax.random.split(key, 2 * GRID_SIZE)
    return jax.lax.fori_loop(
        0,
        2 * GRID_SIZE,
        lambda dist, walls: smarter_gibbs_update_distance(subkeys[dist], args, readings, walls, dist),
        walls,
    )


def gibbs_update_pixel_incremental(key, trace, i, j):
    """Edit the trace to the pixel's other value; keep the edit with its conditional probability."""
    walls = trace.get_choices()["walls"]
    flipped = walls.at[i, j].set(1.0 - walls[i, j])
    request = genjax.StaticRequest({"walls": genjax.Update(C.v(flipped))})
    new_trace, inc_weight, _retdiff, _backward = trace.edit(key, request, None)
    # a logit of inc_weight is the probability e^inc_weight / (1 + e^inc_weight)
    accept = genjax.bernoulli.sample(key, logits=inc_weight)
    return jax.lax.cond(accept, lambda: new_trace, lambda: trace)


def simple_gibbs_sweep_incremental(key, trace):
    """Every pixel once, row by row, by editing the trace."""
    shape = trace.get_choices()["walls"].shape
    subkeys = jax.random.split(key, shape)

    def update(i, j, trace):
        return gibbs_update_pixel_incremental(subkeys[i][j], trace, i, j)

    return for_each_pixel(update, trace, shape)


BLOCK_PATTERNS = jnp.array(list(product([0.0, 1.0], repeat=4))).reshape(16, 2, 2)


def gibbs_update_block(key, args, readings, walls, i, j):
    """Draw the 2 x 2 block whose first pixel is (i, j) from its conditional over all 16 patterns."""

    def with_pattern(pattern):
        return jax.lax.dynamic_update_slice(walls, pattern, (i, j))

    candidates = jax.vmap(with_pattern)(BLOCK_PATTERNS)
    weights = jax.vmap(lambda candidate: log_joint(args, readings, candidate))(candidates)
    return candidates[genjax.categorical.sample(key, weights)]


def block_gibbs_sweep(key, args, readings, walls):
    """All 20 x 20 overlapping blocks, row by row."""
    shape = (walls.shape[0] - 1, walls.shape[1] - 1)
    subkeys = jax.random.split(key, shape)

    def update(i, j, walls):
        return gibbs_update_block(subkeys[i, j], args, readings, walls, i, j)

    return for_each_pixel(update, walls, shape)


def importance_sampling(key, args, readings, num_particles):
    """Maps from the prior, weighted by the likelihood of the readings; the log weights normalised."""
    model_importance = jax.jit(full_model.importance)
    constraints = C["readings"].set(readings)
    keys = jax.random.split(key, num_particles)
    traces, log_weights = jax.vmap(lambda key: model_importance(key, constraints, args))(keys)
    return traces, log_weights - jax.scipy.special.logsumexp(log_weights)


def run_gibbs_chain(key, gibbs_update, args, readings, num_samples=100):
    """The tutorial's chain from an empty map: the state before each of `num_samples` sweeps."""
    walls = jnp.zeros((GRID_SIZE, GRID_SIZE))
    subkeys = jax.random.split(key, num_samples + 1)[1:]

    def step(walls, key):
        return gibbs_update(key, args, readings, walls), walls

    return jax.jit(lambda: jax.lax.scan(step, walls, subkeys)[1])()


# --- timing ---------------------------------------------------------------------------------------

Sweep = Callable[..., jax.Array]


def _scan_of(step, state, sweeps):
    """`sweeps` steps as one compiled scan, as `run_gibbs_chain` runs them, from the last state reached."""
    scan = jax.jit(lambda keys, state: jax.lax.scan(lambda s, key: (step(key, s), None), state, keys)[0])
    key = jax.random.key(0)

    def advance():
        nonlocal key, state
        key, subkey = jax.random.split(key)
        state = jax.block_until_ready(scan(jax.random.split(subkey, sweeps), state))

    return advance, lambda: state


def chain(sweep: Sweep, sweeps: int) -> Callable[[float], harness.Ready]:
    """A case for a sampler whose state is the array of walls, started from an empty map."""

    def prepare(prior: float) -> harness.Ready:
        args, readings = (CENTER, ModelParams(prior_wall_prob=prior)), observe()
        walls = jnp.zeros((GRID_SIZE, GRID_SIZE))
        advance, state = _scan_of(lambda key, walls: sweep(key, args, readings, walls), walls, sweeps)
        return harness.Ready(advance, sweeps, lambda: int(state().sum()))

    return prepare


def incremental_chain(sweeps: int) -> Callable[[float], harness.Ready]:
    """A case for the sampler whose state is a trace."""

    def prepare(prior: float) -> harness.Ready:
        walls = jnp.zeros((GRID_SIZE, GRID_SIZE))
        constraints = C["walls"].set(walls) | C["readings"].set(observe())
        args = (CENTER, ModelParams(prior_wall_prob=prior))
        trace, _ = full_model.importance(jax.random.key(0), constraints, args)
        advance, state = _scan_of(simple_gibbs_sweep_incremental, trace, sweeps)
        return harness.Ready(advance, sweeps, lambda: int(state().get_choices()["walls"].sum()))

    return prepare


def importance_case(num_particles: int) -> Callable[[float], harness.Ready]:
    """A case for importance sampling: one unit is a whole run of `num_particles` maps."""

    def prepare(prior: float) -> harness.Ready:
        args, readings = (CENTER, ModelParams(prior_wall_prob=prior)), observe()
        run = jax.jit(lambda key: importance_sampling(key, args, readings, num_particles))
        key, best = jax.random.key(0), 0

        def advance():
            nonlocal key, best
            key, subkey = jax.random.split(key)
            traces, log_weights = jax.block_until_ready(run(subkey))
            best = int(traces.get_choices()["walls"][jnp.argmax(log_weights)].sum())

        return harness.Ready(advance, 1, lambda: best)

    return prepare


CASES = {
    "raster": harness.Case(chain(simple_gibbs_sweep, 5), 0.5, "sweep of 441 assess-based updates, row by row"),
    "incremental": harness.Case(incremental_chain(5), 0.5, "sweep of 441 trace edits, row by row"),
    "radial": harness.Case(chain(smarter_gibbs_update, 2), 0.5, "sweep of 441 updates, outwards"),
    "block": harness.Case(chain(block_gibbs_sweep, 2), 0.05, "sweep of 400 overlapping 2 x 2 blocks"),
    "importance": harness.Case(importance_case(PARTICLES), 0.5, f"run of {PARTICLES} weighted maps"),
}


# --- known answers --------------------------------------------------------------------------------


def _digest(walls) -> str:
    return hashlib.sha256(np.asarray(walls).astype(np.uint8).tobytes()).hexdigest()[:12]


def check() -> dict[str, object]:
    """Compare this port with answers recorded from the original tutorial; maps must agree to the bit."""
    args, readings = (CENTER, ModelParams()), observe()
    prior = walls_prior(0.5).simulate(jax.random.key(0), ()).get_retval()
    simulated, _ = full_model.simulate(jax.random.key(1), args).get_retval()
    states = run_gibbs_chain(jax.random.key(0), simple_gibbs_sweep, args, readings)
    edit_error = _largest_edit_error(args, readings)
    walls, recorded = harness.load_tutorial_data()
    counts = [int(n) for n in states[:6].sum((1, 2))]
    answers = {
        "prior, key 0": (_digest(prior), "30ec82c4549b"),
        "simulated map, key 1": (_digest(simulated), "c2ad6e295ff2"),
        "walls in the first six states": (counts, [0, 219, 203, 193, 203, 152]),
        "sixth state": (_digest(states[5]), "3337fc67e58b"),
        "sum of the readings within 1e-3 m": (bool(abs(float(readings.sum()) - 1225.6375) < 1e-3), True),
        "recorded walls": (bool((np.asarray(TRUE_WALLS) == walls).all()), True),
        "recorded readings within 1e-5 m": (bool(np.abs(np.asarray(readings) - recorded).max() < 1e-5), True),
        "edit weight equals assess difference": (edit_error < 1e-5, True),
    }
    return {
        "passed": all(got == expected for got, expected in answers.values()),
        "answers": {name: {"got": got, "expected": expected} for name, (got, expected) in answers.items()},
        "largest_edit_error": edit_error,
    }


def _largest_edit_error(args, readings) -> float:
    """How far an edit's weight lies from the difference of two assessed joints, relative to the joint."""
    constraints = C["walls"].set(TRUE_WALLS) | C["readings"].set(readings)
    trace, _ = full_model.importance(jax.random.key(0), constraints, args)
    base, errors = log_joint(args, readings, TRUE_WALLS), []
    for pixel in [(2, 2), (10, 10), (12, 3), (5, 16), (0, 0)]:
        flipped = TRUE_WALLS.at[pixel].set(1.0 - TRUE_WALLS[pixel])
        request = genjax.StaticRequest({"walls": genjax.Update(C.v(flipped))})
        _, weight, _, _ = trace.edit(jax.random.key(0), request, None)
        joint = log_joint(args, readings, flipped)
        errors.append(abs(float((weight - (joint - base)) / joint)))
    return max(errors)


def dump_data(path: Path) -> None:
    """Write the true walls, (21, 21) bool, and the readings of key 0 in metres, (100,) float32."""
    np.savez(path, walls=np.asarray(TRUE_WALLS, dtype=bool), readings_m=np.asarray(observe()))


def log_joint_of_truth(prior: float) -> float:
    """log p(true walls, readings): the same for everyone who runs this problem."""
    return float(log_joint((CENTER, ModelParams(prior_wall_prob=prior)), observe(), TRUE_WALLS))


if __name__ == "__main__":
    harness.main(
        "genjax",
        "The mapping tutorial's samplers under GenJAX.",
        CASES,
        ("genjax", "jax", "jaxlib", "numpy"),
        log_joint_of_truth,
        check,
        dump_data,
    )
