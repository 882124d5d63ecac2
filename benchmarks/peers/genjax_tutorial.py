"""The mapping tutorial under GenJAX 0.10.3: the model and the samplers that bayesmap grew out of.

A 21 x 21 map of unit cells, each a wall or free space; a robot in the middle; 100 noisy ranges. The code
is the tutorial's own computation, so that the ratio in our benchmark means what it says: a pixel's update
runs the whole model twice through `full_model.assess`, inside two `fori_loop`s, under `jit`. Only the
2 x 2 block sweep goes beyond the text, by the same means: `assess` for each of a block's 16 patterns.

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

GRID = """
.....................
.....................
.XXX..........X......
.X.X..........X......
.X............XXX....
.X..............X....
.X..............X....
.XX............XXX...
..X..............X...
..X..............X...
..X..............X...
..X..............X...
..XXXXX......XXXXX...
......X......X.......
......X....XXX.......
......X....X.........
......X....X.........
......XXXXXX.........
.....................
.....................
.....................
"""
GRID_SIZE = 21
CENTER = jnp.array([GRID_SIZE // 2, GRID_SIZE // 2])
NUM_DIRECTIONS = 100
MAX_DISTANCE = GRID_SIZE * 2  # cap on distances, so that no infinity enters the likelihood
PARTICLES = 10_000

TRUE_WALLS = jnp.array([[float(char == "X") for char in line] for line in GRID.split()])


# --- the model ------------------------------------------------------------------------------------


@genjax.Pytree.dataclass
class ModelParams(genjax.Pytree):
    """The constants of the model: prior wall probability, standard deviation of a reading, directions."""

    prior_wall_prob: float = genjax.Pytree.static(default=0.5)
    sensor_noise: float = genjax.Pytree.static(default=0.2)
    num_angles: int = genjax.Pytree.static(default=NUM_DIRECTIONS)


OFFSETS = jnp.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])


def line_segments_of_pixel(pixel):
    """The four edges of a pixel, (4, 2, 2): start and end points."""
    vertices = pixel[None, :] + OFFSETS
    return jnp.stack([vertices, jnp.roll(vertices, 1, axis=0)], axis=1)


def solve_lines(p, u, q, v, parallel_tol=1.0e-10):
    """Where p + s u meets q + t v: the pair (s, t), both -inf if the lines are parallel."""
    det = u[0] * v[1] - u[1] * v[0]
    return jnp.where(
        jnp.abs(det) < parallel_tol,
        jnp.array([-jnp.inf, -jnp.inf]),
        jnp.array(
            [
                (v[0] * (p[1] - q[1]) - v[1] * (p[0] - q[0])) / det,
                (u[1] * (q[0] - p[0]) - u[0] * (q[1] - p[1])) / det,
            ]
        ),
    )


def distance(pos, direction, seg):
    """The distance from `pos` along `direction` to the segment; infinity if the ray misses it."""
    a = solve_lines(pos, direction, seg[0], seg[1] - seg[0])
    return jnp.where((a[0] >= 0.0) & (a[1] >= 0.0) & (a[1] <= 1.0), a[0], jnp.inf)


def unit_dir(angle):
    """The unit vector at `angle`."""
    return jnp.array([jnp.cos(angle), jnp.sin(angle)])


def angles(num_angles):
    """Equidistant directions, as the tutorial spaces them (right for 100, not for every number)."""
    return jnp.arange(0, 1, 1 / num_angles) * 2 * jnp.pi


def distance_to_pixel(pos, direction, coord, wall):
    """The distance to one pixel, or infinity if the ray misses it or it is no wall."""
    dists = jax.vmap(lambda seg: distance(pos, direction, seg))(line_segments_of_pixel(coord))
    return jax.lax.cond(wall > 0, lambda: jnp.min(dists, axis=0), lambda: jnp.inf)


def distance_to_pixels(pos, direction, walls):
    """The distance to the nearest wall, capped at `MAX_DISTANCE`."""

    def distances_in_row(i, row):
        return jax.vmap(lambda j, wall: distance_to_pixel(pos, direction, jnp.array([i, j]), wall))(
            jnp.arange(walls.shape[1]), row
        )

    distances = jax.vmap(distances_in_row)(jnp.arange(walls.shape[0]), walls)
    return jnp.minimum(jnp.min(distances), MAX_DISTANCE)


def walls_prior(prior_wall_prob):
    """Independent coin flips, one for each pixel."""
    return genjax.flip.repeat(n=GRID_SIZE).repeat(n=GRID_SIZE)(prior_wall_prob)


@genjax.gen
def sensor_model_single(pos, pixels, sensor_noise, angle):
    """One reading: the exact distance plus Gaussian noise."""
    exact_distance = distance_to_pixels(pos, unit_dir(angle), pixels)
    return genjax.normal(exact_distance, sensor_noise) @ ()


sensor_model = sensor_model_single.vmap(in_axes=(None, None, None, 0))


@genjax.gen
def full_model(pos, model_params):
    """The walls from the prior, then the readings."""
    walls = walls_prior(model_params.prior_wall_prob) @ "walls"
    directions = angles(model_params.num_angles)
    readings = sensor_model(pos, walls, model_params.sensor_noise, directions) @ "readings"
    return (walls, readings)


full_model_assess = jax.jit(full_model.assess)


def observe(key=None):
    """The tutorial's noisy readings of the true map: those of key 0."""
    key = jax.random.key(0) if key is None else key
    args = (CENTER, TRUE_WALLS, ModelParams().sensor_noise, angles(NUM_DIRECTIONS))
    return sensor_model.simulate(key, args).get_retval()


def log_joint(args, readings, walls):
    """log p(walls, readings), by running the model with both given."""
    weight, _ = full_model_assess(C["readings"].set(readings) | C["walls"].set(walls), args)
    return weight


# --- the samplers ---------------------------------------------------------------------------------


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
    """Propose the other value of one pixel as an edit of the trace; keep it by its conditional probability."""
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
    candidates = jax.vmap(lambda pattern: jax.lax.dynamic_update_slice(walls, pattern, (i, j)))(BLOCK_PATTERNS)
    weights = jax.vmap(lambda walls: log_joint(args, readings, walls))(candidates)
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
