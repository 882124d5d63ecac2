"""The mapping tutorial's model under GenJAX 0.10.3: a 21 x 21 map of walls seen by 100 noisy ranges.

The computation is the tutorial's own, and so is its cost: every evaluation intersects all 100 rays with
the four edges of all 441 pixels. Do not make it faster; it is what our own figures are compared with.
"""

import genjax
import jax
import jax.numpy as jnp
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

TRUE_WALLS = jnp.array([[float(char == "X") for char in line] for line in GRID.split()])


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
