r"""The surface of a cell: the beams that meet it (`bayesmap.beams.rays.stops_of` states the law), and its prior.

`bayesmap.cells.surface.Surface` states the prior. Its factor exp(-tr Sigma / (2 kappa^2)) keeps surfaces from growing
beyond their cell: beams of other cells are no evidence against it. Steps are taken in mu, log l11, l21 and log l22 of
Sigma = L L'. In these coordinates the density inside the cell's square is proportional to

    exp(-|mu - centre|^2 / (2 tau^2)) l11^-nu l22^-(nu + 1) exp(-psi/2 tr Sigma^-1 - tr Sigma / (2 kappa^2)):

the Wishart's |Sigma|^-(nu + 3)/2 = (l11 l22)^-(nu + 3) times the Jacobian 4 l11^3 l22^2.
"""

from typing import Any

import numpy as np
import warp as wp
from scipy import special

from bayesmap.beams.rays import CROSSING_WIDTH, DIRECTION_RAD
from bayesmap.cells.reflectivity import PriorParameters
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import HALF, ONE, Singles
from bayesmap.kernels.random import COUNTERS_PER_GAMMA, log_gamma_variate, normal

CROSSING_WIDTH_SQ = wp.constant(wp.float32(CROSSING_WIDTH**2))
DIRECTION_SQ = wp.constant(wp.float32(DIRECTION_RAD**2))
Cell = wp.types.vector(length=8, dtype=wp.float32)  # a cell's state; its last number is not used
REFLECTIVITY = 0
MEAN_X, MEAN_Y = 1, 2  # metres from the grid's corner
L11, L21, L22 = 3, 4, 5  # Cholesky factor of Sigma
TRYING = 6  # 1 while a candidate for the surface is tried, else 0
MEAN_TRIES = wp.constant(8)  # most draws of a mean's coordinate


def cells_to_device(states: Singles, device: str) -> Any:
    """Put states, (..., 6), or reflectivities, (..., 1), on a device as an array of `Cell`."""
    padded = np.zeros((*states.shape[:-1], 8), dtype=np.float32)
    padded[..., : states.shape[-1]] = states
    return wp.array(padded, dtype=Cell, device=device, copy=device != "cpu")


@wp.struct
class Ray:
    """A beam: start in metres from the grid's corner, and direction."""

    start_m: wp.vec2
    direction: wp.vec2


@wp.struct
class Crossing:
    """Chance g of meeting the surface, and mean and variance of the distance at which the beam meets it."""

    meeting_chance: wp.float32
    distance_m: wp.float32
    variance: wp.float32


@wp.func
def meeting_chance_at(offset: wp.float32, across: wp.float32) -> wp.float32:
    """Return the chance g of meeting a surface, given the offset of its mean and its variance across the beam."""
    r = offset * offset / (CROSSING_WIDTH_SQ * across)
    return wp.float32(1.0) / (wp.float32(1.0) + r * r * r)


@wp.func
def meeting_chance(cell: Cell, ray: Ray) -> wp.float32:
    """Return the chance g that the beam meets the cell's surface."""
    u = ray.direction
    offset = u[0] * (cell[MEAN_Y] - ray.start_m[1]) - u[1] * (cell[MEAN_X] - ray.start_m[0])
    across_1, across_2 = cell[L21] * u[0] - cell[L11] * u[1], cell[L22] * u[0]
    return meeting_chance_at(offset, across_1 * across_1 + across_2 * across_2)


@wp.func
def cross_at(offset: wp.float32, ahead: wp.float32, cell: Cell, ux: wp.float32, uy: wp.float32) -> Crossing:
    """Return the crossing of a surface whose mean lies ``offset`` beside the beam and ``ahead`` of its start."""
    l11, l21, l22 = cell[L11], cell[L21], cell[L22]
    # across, along: L' n and L' u; body: n' Sigma n; unsure: variance from the beam's direction.
    across_1, across_2 = l21 * ux - l11 * uy, l22 * ux
    along_1, along_2 = l11 * ux + l21 * uy, l22 * uy
    depth = wp.max(ahead, wp.float32(0.0))
    body = across_1 * across_1 + across_2 * across_2
    unsure = DIRECTION_SQ * depth * depth
    per_across = wp.float32(1.0) / (body + unsure)
    slope = (along_1 * across_1 + along_2 * across_2) * per_across
    area = l11 * l22
    # |Sigma + unsure n n'| / w^2 = (|Sigma| + unsure u' Sigma u) / w^2: no difference of large numbers
    variance = (area * area + unsure * (along_1 * along_1 + along_2 * along_2)) * per_across
    return Crossing(meeting_chance_at(offset, body), wp.max(ahead - slope * offset, wp.float32(0.0)), variance)


@wp.func
def cross_surface(cell: Cell, ray: Ray) -> Crossing:
    """Return the chance that the beam meets the cell's surface, and mean and variance of the distance."""
    u = ray.direction
    rx, ry = cell[MEAN_X] - ray.start_m[0], cell[MEAN_Y] - ray.start_m[1]
    return cross_at(u[0] * ry - u[1] * rx, u[0] * rx + u[1] * ry, cell, u[0], u[1])


PriorArrays = devices.struct_like(PriorParameters, *[wp.float64] * len(PriorParameters._fields))


def pack_prior(parameters: PriorParameters) -> Any:
    """Pack a prior as kernels read it, with the log normalisers of the Betas if cells have labels."""
    if parameters.coupling > 0:
        log_betas = special.betaln((parameters.a, parameters.a_solid), (parameters.b, parameters.b_solid))
        parameters = parameters._replace(log_beta=float(log_betas[0]), log_beta_solid=float(log_betas[1]))
    return devices.pack(PriorArrays, "cpu", **parameters._asdict())


@wp.func
def pseudo_counts(prior: PriorArrays, solid: wp.uint8) -> wp.vec2d:
    """Return a and b of the reflectivity of a cell with this label. Without labels all cells are free."""
    if solid != wp.uint8(0):
        return wp.vec2d(prior.a_solid, prior.b_solid)
    return wp.vec2d(prior.a, prior.b)


@wp.func
def centre_of(index: int, ny: int, edge_m: wp.float64) -> wp.vec2:
    """Return the centre of the cell with a flat index, metres from the grid's lower left corner."""
    x = wp.float32((wp.float64(index // ny) + HALF) * edge_m)
    return wp.vec2(x, wp.float32((wp.float64(index % ny) + HALF) * edge_m))


@wp.func
def is_in_square(prior: PriorArrays, centre: wp.vec2, cell: Cell) -> bool:
    """Return whether the surface's mean lies in the cell's own square."""
    half = wp.float32(prior.half_m)
    return wp.abs(cell[MEAN_X] - centre[0]) <= half and wp.abs(cell[MEAN_Y] - centre[1]) <= half


@wp.func
def draw_mean_coordinate(prior: PriorArrays, key: wp.uint64, counter: wp.uint64) -> wp.float32:
    """Draw a coordinate of a mean, relative to the cell's centre, by rejection; takes 2 `MEAN_TRIES` counters."""
    # Under the default prior one try in five fails. All fail once in 300 000 times; that candidate is not accepted.
    x = prior.tau_m * normal(key, counter)
    for i in range(1, MEAN_TRIES):
        if wp.abs(x) > prior.half_m:
            x = prior.tau_m * normal(key, counter + wp.uint64(2 * i))
    return wp.float32(x)


@wp.func
def fresh_surface(prior: PriorArrays, centre: wp.vec2, cell: Cell, key: wp.uint64, counter: wp.uint64) -> Cell:
    """Return the cell with a surface drawn from the prior without `log_size_penalty`, which the acceptance includes."""
    # Sigma^-1 = A A' / psi with Bartlett's lower triangular A. The inverse has the upper factor A^-T sqrt(psi), which
    # becomes a lower factor when x and y are exchanged; the law is symmetric in them. n: next counter.
    n = counter + wp.uint64(COUNTERS_PER_GAMMA)
    a11 = wp.exp(HALF * (log_gamma_variate(HALF * prior.nu, key, counter) + wp.log(wp.float64(2.0))))
    shape = HALF * (prior.nu - wp.float64(1.0))
    a22 = wp.exp(HALF * (log_gamma_variate(shape, key, n) + wp.log(wp.float64(2.0))))
    n = n + wp.uint64(COUNTERS_PER_GAMMA)
    a21 = normal(key, n)
    scale = wp.sqrt(prior.psi_m2)
    cell[MEAN_X] = centre[0] + draw_mean_coordinate(prior, key, n + wp.uint64(2))
    cell[MEAN_Y] = centre[1] + draw_mean_coordinate(prior, key, n + wp.uint64(2 + 2 * MEAN_TRIES))
    cell[L11] = wp.float32(scale / a22)
    cell[L21] = wp.float32(-scale * a21 / (a11 * a22))
    cell[L22] = wp.float32(scale / a11)
    return cell


@wp.func
def log_surface_prior(prior: PriorArrays, centre: wp.vec2, cell: Cell) -> wp.float64:
    """Return the log density of a surface in the coordinates of its steps, up to a constant."""
    # (x, y): mean relative to the centre; q: the lower left entry of L^-1, up to its sign.
    x, y = wp.float64(cell[MEAN_X] - centre[0]), wp.float64(cell[MEAN_Y] - centre[1])
    l11, l22 = wp.float64(cell[L11]), wp.float64(cell[L22])
    q = wp.float64(cell[L21]) / (l11 * l22)
    trace = ONE / (l11 * l11) + ONE / (l22 * l22) + q * q
    shape = -prior.nu * wp.log(l11) - (prior.nu + ONE) * wp.log(l22) - HALF * prior.psi_m2 * trace
    shape += log_size_penalty(prior, cell)
    return shape - HALF * (x * x + y * y) / (prior.tau_m * prior.tau_m)


@wp.func
def log_size_penalty(prior: PriorArrays, cell: Cell) -> wp.float64:
    """Return the logarithm of the factor that keeps a surface from growing beyond its cell: -tr Sigma / (2 kappa^2)."""
    l11, l21, l22 = wp.float64(cell[L11]), wp.float64(cell[L21]), wp.float64(cell[L22])
    return wp.float64(-0.5) * (l11 * l11 + l21 * l21 + l22 * l22) / (prior.kappa_m * prior.kappa_m)


@wp.func
def log_reflectivity_prior(prior: PriorArrays, solid: wp.uint8, reflectivity: wp.float32) -> wp.float32:
    """Return the log density of the logit of a reflectivity given the label, up to a constant without labels."""
    m = wp.clamp(reflectivity, wp.float32(1.0e-30), wp.float32(1.0 - 1.0e-7))  # its logarithms are finite
    counts = pseudo_counts(prior, solid)
    density = wp.float32(counts[0]) * wp.log(m) + wp.float32(counts[1]) * wp.log(wp.float32(1.0) - m)
    return density - wp.float32(wp.where(solid != wp.uint8(0), prior.log_beta_solid, prior.log_beta))
