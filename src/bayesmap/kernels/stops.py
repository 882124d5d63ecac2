"""Half a sweep: where does every beam stop, given the cells?

A beam walks its cells in order. In each it meets the surface with chance g, and is then stopped with probability m; so
with a = m g it stops there with probability T a, T being the product of 1 - a over the cells before, and its stop has
the posterior probability proportional to T a p(z | stop). Far before the reading p(z | stop) is the constant density of
a random reading, and the sum over those cells telescopes to floor (1 - T): they cost a multiplication each.

A cell that a beam passes learns one of two things. In most sweeps: whether the beam *met* the surface (and was not
stopped), which given that it passed has probability g (1 - m) / (1 - a); met and stopped beams make its reflectivity's
Beta. In sweeps in which a candidate for its surface is tried: log (1 - m g') / (1 - m g), the beam's part of the
Metropolis ratio. Both are added up in whole numbers, so that the result does not depend on the order of beams.

Most cells are free, and are told that by many beams in every sweep; they *rest* in most sweeps, learning nothing. What
a resting cell with a reflectivity under single precision does to T is nothing, and it is passed at a glance.
"""

import warp as wp

from bayesmap.kernels.likelihood import SensorParameters
from bayesmap.kernels.meeting import TRYING, Cell, Meeting, Ray, gate, meet, ray_from
from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.stop_law import Law, fading, law_of, no_stop_law, stop_law

wp.set_module_options({"enable_backward": False})

GAIN_UNITS = 1 << 24
TO_UNITS = wp.constant(wp.float32(GAIN_UNITS))
LEAST = wp.constant(wp.float32(1.0e-30))
TO_UNIT_24 = wp.constant(wp.float32(1.0 / (1 << 24)))

IN_A_ROW = wp.constant(16)
"""Of so many cells in a row at most one tries a candidate in a sweep: rounds are multiples of it."""
FAR = wp.constant(-1)  # a stop before the near entries
AWAKE = wp.constant(wp.float32(-1.0))
CLEAR = wp.constant(wp.float32(2.0**-26))  # 1 - m is 1 in single precision
CLEAREST = wp.constant(wp.float32(1.0e-15))  # nor is a stop here worth weighing, whatever its density

# Counters of a sweep's random numbers: one for each purpose and entry or beam.
STREAM_CHOICE = wp.constant(wp.uint64(1 << 32))
STREAM_END = wp.constant(wp.uint64(2 << 32))
STREAM_FAR = wp.constant(wp.uint64(3 << 32))


@wp.struct
class Rays:
    """`BeamRays` on a device; ``plain`` says that cells have no surfaces, and stop beams at ``distance_m``."""

    plain: int
    offsets: wp.array(dtype=wp.int32)
    cells: wp.array(dtype=wp.int32)
    distance_m: wp.array(dtype=wp.float32)
    near: wp.array(dtype=wp.int32)
    start_m: wp.array(dtype=wp.vec2)
    direction: wp.array(dtype=wp.vec2)
    range_m: wp.array(dtype=wp.float32)


@wp.struct
class Field:
    """One chain: cells, a glance at each (its reflectivity if it rests, else AWAKE), and a candidate for each
    `IN_A_ROW` of them; what the beams told each cell in this sweep, a row for each part of the beams; and for each beam
    `fading` of its reading, the entry at which it stopped (its end if nowhere), the distance and variance of that stop,
    and the log-likelihood of its reading, summed over all stops.
    """

    cells: wp.array(dtype=Cell)
    glance: wp.array(dtype=wp.float32)
    candidates: wp.array(dtype=Cell)
    met: wp.array2d(dtype=wp.int32)
    hits: wp.array2d(dtype=wp.int32)
    gain: wp.array2d(dtype=wp.int64)
    faded: wp.array(dtype=wp.float32)
    stop: wp.array(dtype=wp.int32)
    where: wp.array(dtype=wp.vec2)
    log_likelihood: wp.array(dtype=wp.float32)


@wp.func
def plain_or_meet(rays: Rays, k: int, cell: Cell, ray: Ray) -> Meeting:
    """Chance, distance and variance of a stop at entry k."""
    if rays.plain != 0:
        m = Meeting()
        m.chance = wp.float32(1.0)
        m.distance_m = rays.distance_m[k]
        m.variance = wp.float32(0.0)
        return m
    return meet(cell, ray)


@wp.func
def in_units(log_ratio: wp.float32) -> wp.int64:
    """A logarithm as a whole number."""
    return wp.int64(wp.round(wp.clamp(log_ratio, wp.float32(-1.0e6), wp.float32(1.0e6)) * TO_UNITS))


@wp.func
def pass_by(field: Field, part: int, c: int, cell: Cell, g: wp.float32, ray: Ray, key: wp.uint64, k: int, sign: int):
    """Tell a cell that a beam passed it; with sign -1 take that back."""
    one = wp.float32(1.0)
    m = cell[0]
    if cell[TRYING] != wp.float32(0.0):
        other = gate(field.candidates[c // IN_A_ROW], ray)
        ratio = wp.log(wp.max(one - m * other, LEAST) / wp.max(one - m * g, LEAST))
        wp.atomic_add(field.gain, part, c, wp.int64(sign) * in_units(ratio))
        return
    u = wp.float32(random_bits(key, wp.uint64(k)) >> wp.uint64(40)) * TO_UNIT_24
    if u * (one - m * g) < g * (one - m):
        wp.atomic_add(field.met, part, c, sign)


@wp.func
def chance_at(rays: Rays, cell: Cell, ray: Ray) -> wp.float32:
    """The chance of meeting a cell's surface: one where cells are plain."""
    if rays.plain != 0:
        return wp.float32(1.0)
    return gate(cell, ray)


@wp.kernel
def draw_stops(
    first: int,
    part: int,
    sensor: SensorParameters,
    rays: Rays,
    field: Field,
    keys: wp.array(dtype=wp.uint64),
):
    """One thread a beam: draw where it stops, and tell the cells."""
    b = first + wp.tid()
    law = law_of(sensor)
    key = keys[0]
    one = wp.float32(1.0)
    reading = rays.range_m[b]
    begin = rays.offsets[b]
    end = rays.offsets[b + 1]
    near = rays.near[b]
    if begin == end or wp.isnan(reading):
        field.stop[b] = end
        field.log_likelihood[b] = wp.float32(0.0)
        if not wp.isnan(reading):
            field.log_likelihood[b] = wp.log(no_stop_law(law, reading, fading(law, reading)))
        return
    ray = ray_from(rays.start_m[b], rays.direction[b])

    faded = fading(law, reading)
    field.faded[b] = faded
    free = wp.float32(1.0)
    for k in range(begin, near):
        c = rays.cells[k]
        glance = field.glance[c]
        if glance < wp.float32(0.0) or glance > CLEAR:
            cell = field.cells[c]
            g = chance_at(rays, cell, ray)
            free = free * (one - cell[0] * g)
            if glance < wp.float32(0.0):
                pass_by(field, part, c, cell, g, ray, key, k, 1)
    stopped_far = one - free
    total = wp.float64(law.floor) * wp.float64(stopped_far)
    choice = FAR

    for k in range(near, end):
        c = rays.cells[k]
        glance = field.glance[c]
        if glance < wp.float32(0.0) or glance > CLEAREST:
            cell = field.cells[c]
            m = plain_or_meet(rays, k, cell, ray)
            a = cell[0] * m.chance
            weight = wp.float64(free * a * stop_law(law, reading, faded, m.distance_m, m.variance))
            total += weight
            u = to_uniform(random_bits(key, STREAM_CHOICE + wp.uint64(k)))
            if u * total < weight:
                choice = k
            free = free * (one - a)
    weight = wp.float64(free * no_stop_law(law, reading, faded))
    total += weight
    if to_uniform(random_bits(key, STREAM_END + wp.uint64(b))) * total < weight:
        choice = end
    field.log_likelihood[b] = wp.float32(wp.log(wp.max(total, wp.float64(1.0e-300))))

    if choice == FAR:
        # Rare. Find the cell, and take back what those from it on were told.
        target = wp.float32(to_uniform(random_bits(key, STREAM_FAR + wp.uint64(b)))) * stopped_far
        free = wp.float32(1.0)
        for k in range(begin, near):
            c = rays.cells[k]
            cell = field.cells[c]
            g = chance_at(rays, cell, ray)
            free = free * (one - cell[0] * g)
            if choice == FAR and (one - free >= target or k == near - 1):
                choice = k
            if choice != FAR and field.glance[c] < wp.float32(0.0):
                pass_by(field, part, c, cell, g, ray, key, k, -1)
    for k in range(near, wp.min(choice, end)):
        c = rays.cells[k]
        if field.glance[c] < wp.float32(0.0):
            cell = field.cells[c]
            pass_by(field, part, c, cell, chance_at(rays, cell, ray), ray, key, k, 1)

    field.stop[b] = choice
    if choice < end:
        c = rays.cells[choice]
        cell = field.cells[c]
        stopped = plain_or_meet(rays, choice, cell, ray)
        field.where[b] = wp.vec2(stopped.distance_m, stopped.variance)
        wp.atomic_add(field.hits, part, c, 1)
        if cell[TRYING] != wp.float32(0.0):
            old = meet(cell, ray)
            new = meet(field.candidates[c // IN_A_ROW], ray)
            after = wp.max(new.chance * hit_law(law, choice, near, reading, faded, new), LEAST)
            before = wp.max(old.chance * hit_law(law, choice, near, reading, faded, old), LEAST)
            wp.atomic_add(field.gain, part, c, in_units(wp.log(after / before)))


@wp.func
def hit_law(law: Law, k: int, near: int, reading: wp.float32, faded: wp.float32, m: Meeting) -> wp.float32:
    """p(z | stop) at entry k: that of a random reading at entries that are not near."""
    if k < near:
        return law.floor
    return stop_law(law, reading, faded, m.distance_m, m.variance)
