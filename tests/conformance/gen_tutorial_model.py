"""The tutorial's program with only its imports changed, in our words: the map, the sensor, the full model."""

import jax
import jax.numpy as jnp
import numpy as np

import bayesmap.gen as genjax
from bayesmap import worlds
from bayesmap.gen.typing import IntArray

GRID_SIZE = 21
CENTER = np.array([GRID_SIZE // 2, GRID_SIZE // 2])
NUM_DIRECTIONS = 100
MAX_DISTANCE = GRID_SIZE * 2
CORNERS = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]], np.float32)

true_walls = worlds.tutorial()[0].astype(np.float32)


@genjax.Pytree.dataclass
class ModelParams(genjax.Pytree):
    prior_wall_prob: float = genjax.Pytree.static()
    sensor_noise: float = genjax.Pytree.static()
    num_angles: int = genjax.Pytree.static()


PARAMS = ModelParams(prior_wall_prob=0.5, sensor_noise=0.2, num_angles=NUM_DIRECTIONS)


def walls_prior(prior_wall_prob):
    return genjax.flip.repeat(n=GRID_SIZE).repeat(n=GRID_SIZE)(prior_wall_prob)


def edges_of_pixel(pixel: IntArray):
    corners = pixel[None, :] + CORNERS
    return jnp.stack([corners, jnp.roll(corners, 1, axis=0)], axis=1)


def intersect(p, u, q, v, tolerance=1.0e-10):
    """Parameters (s, t) of the point p + s u = q + t v; -inf where the lines are parallel."""
    det = u[0] * v[1] - u[1] * v[0]
    s = (v[0] * (p[1] - q[1]) - v[1] * (p[0] - q[0])) / det
    t = (u[1] * (q[0] - p[0]) - u[0] * (q[1] - p[1])) / det
    return jnp.where(jnp.abs(det) < tolerance, jnp.array([-jnp.inf, -jnp.inf]), jnp.array([s, t]))


def distance_to_edge(pos, direction, edge):
    a = intersect(pos, direction, edge[0], edge[1] - edge[0])
    return jnp.where((a[0] >= 0.0) & (a[1] >= 0.0) & (a[1] <= 1.0), a[0], jnp.inf)


def unit_dir(angle):
    return jnp.array([jnp.cos(angle), jnp.sin(angle)])


def angles(num_angles):
    """Exactly `num_angles` of them; the tutorial's `arange(0, 1, 1 / n)` is sometimes one too long."""
    return (jnp.arange(num_angles) * jnp.float32(1 / num_angles)) * 2 * jnp.pi


def distance_to_pixel(pos, direction, pixel, wall):
    distances = jax.vmap(lambda edge: distance_to_edge(pos, direction, edge))(edges_of_pixel(pixel))
    return jax.lax.cond(wall > 0, lambda: jnp.min(distances, axis=0), lambda: jnp.inf)


def distance_to_pixels(pos, direction, walls):
    def row(i, cells):
        distance = lambda j, wall: distance_to_pixel(pos, direction, jnp.array([i, j]), wall)  # noqa: E731
        return jax.vmap(distance)(jnp.arange(walls.shape[1]), cells)

    return jnp.minimum(jnp.min(jax.vmap(row)(jnp.arange(walls.shape[0]), walls)), MAX_DISTANCE)


@genjax.gen
def sensor_model_single(pos, pixels, sensor_noise, angle):
    exact_distance = distance_to_pixels(pos, unit_dir(angle), pixels)
    return genjax.normal(exact_distance, sensor_noise) @ ()


sensor_model = sensor_model_single.vmap(in_axes=(None, None, None, 0))


@genjax.gen
def full_model(pos, model_params):
    walls = walls_prior(model_params.prior_wall_prob) @ "walls"
    readings = sensor_model(pos, walls, model_params.sensor_noise, angles(model_params.num_angles)) @ "readings"
    return (walls, readings)
