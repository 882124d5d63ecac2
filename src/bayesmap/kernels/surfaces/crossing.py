r"""Compute where a beam meets the surface inside a cell, and the chance that it meets it at all.

A cell's surface is a normal distribution N(mu, Sigma) of the points where beams stop. A beam from p in direction u,
with normal n, passes the mean at the offset o = n . (mu - p); across the beam the surface has the standard deviation
v = sqrt(n' Sigma n). The beam meets the surface with probability

    g = 1 / (1 + (o / (2.2 v))^6)

which is nearly one where it crosses the surface's body and nearly zero where it passes beside it; 2.2 was measured
(docs/surfaces.md). If it meets it, and is stopped, that happens at the distance t ~ N(t*, s^2), the law of a point of
the surface *given that it lies on the beam*:

    t* = u . (mu - p) - (u' Sigma n / w^2) o        s^2 = u' Sigma u - (u' Sigma n)^2 / w^2

A beam's direction is known up to an angle omega only: at the mean's distance d = u . (mu - p) its line may lie off by
omega d, which spreads the readings of a wall that it grazes. So w^2 = v^2 + (omega d)^2, the variance across the beam
of the two together. The crossing probability keeps v: with w in its place, held-out scans were predicted worse.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

CROSSING_WIDTH_SQ = wp.constant(wp.float32(2.2**2))
DIRECTION_SQ = wp.constant(wp.float32(0.005**2))
"""Square of omega, radians: 4 to 8 thousandths predict held-out scans best (docs/lab/surfaces.md)."""

Cell = wp.types.vector(length=8, dtype=wp.float32)
"""A cell's state: reflectivity, mean x and y (metres from the grid's corner), Cholesky factor l11, l21, l22 of Sigma,
whether a candidate for its surface is being tried, and a number that is not used."""

REFLECTIVITY, MEAN_X, MEAN_Y, L11, L21, L22, TRYING = range(7)


def cells_to_device(states: NDArray[np.float32], device: str) -> Any:
    """Put states alone, (..., 6), or without a surface, (..., 1), on a device as an array of `Cell`."""
    padded = np.zeros((*states.shape[:-1], 8), dtype=np.float32)
    padded[..., : states.shape[-1]] = states
    return wp.array(padded, dtype=Cell, device=device, copy=device != "cpu")


@wp.struct
class Ray:
    """A beam: start in metres from the grid's corner, and direction."""

    x: wp.float32
    y: wp.float32
    ux: wp.float32
    uy: wp.float32


@wp.struct
class Crossing:
    """Probability of meeting the surface, and mean and variance of the distance at which the beam meets it."""

    chance: wp.float32
    distance_m: wp.float32
    variance: wp.float32


@wp.func
def ray_from(start_m: wp.vec2, direction: wp.vec2) -> Ray:
    """Make a ray from its start and its direction."""
    ray = Ray()
    ray.x = start_m[0]
    ray.y = start_m[1]
    ray.ux = direction[0]
    ray.uy = direction[1]
    return ray


@wp.func
def crossing_probability_at(offset: wp.float32, across: wp.float32) -> wp.float32:
    """Return the chance of meeting a surface, by the offset of its mean and its variance across the beam."""
    r = offset * offset / (CROSSING_WIDTH_SQ * across)
    return wp.float32(1.0) / (wp.float32(1.0) + r * r * r)


@wp.func
def crossing_probability(cell: Cell, ray: Ray) -> wp.float32:
    """Return the chance that the beam meets the cell's surface."""
    offset = ray.ux * (cell[MEAN_Y] - ray.y) - ray.uy * (cell[MEAN_X] - ray.x)
    across_1 = cell[L21] * ray.ux - cell[L11] * ray.uy
    across_2 = cell[L22] * ray.ux
    return crossing_probability_at(offset, across_1 * across_1 + across_2 * across_2)


@wp.func
def cross_at(offset: wp.float32, ahead: wp.float32, cell: Cell, ux: wp.float32, uy: wp.float32) -> Crossing:
    """Return the crossing of a surface, from the offset of its mean from the beam, the distance of that ahead, and the
    beam's direction.
    """
    l11 = cell[L11]
    l21 = cell[L21]
    l22 = cell[L22]
    one = wp.float32(1.0)
    across_1 = l21 * ux - l11 * uy  # L' n
    across_2 = l22 * ux
    along_1 = l11 * ux + l21 * uy  # L' u
    along_2 = l22 * uy
    depth = wp.max(ahead, wp.float32(0.0))
    body = across_1 * across_1 + across_2 * across_2
    unsure = DIRECTION_SQ * depth * depth
    per_across = one / (body + unsure)
    slope = (along_1 * across_1 + along_2 * across_2) * per_across
    area = l11 * l22
    met = Crossing()
    met.chance = crossing_probability_at(offset, body)
    met.distance_m = wp.max(ahead - slope * offset, wp.float32(0.0))
    # |Sigma + unsure n n'| / w^2 = (|Sigma| + unsure u' Sigma u) / w^2: no difference of large numbers
    met.variance = (area * area + unsure * (along_1 * along_1 + along_2 * along_2)) * per_across
    return met


@wp.func
def cross_surface(cell: Cell, ray: Ray) -> Crossing:
    """Return the chance that the beam meets the cell's surface, and the law of the distance at which."""
    rx = cell[MEAN_X] - ray.x
    ry = cell[MEAN_Y] - ray.y
    offset = ray.ux * ry - ray.uy * rx
    return cross_at(offset, ray.ux * rx + ray.uy * ry, cell, ray.ux, ray.uy)
