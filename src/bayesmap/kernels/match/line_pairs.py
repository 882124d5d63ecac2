"""Pair the points of one scan with the walls of another, and sum the pairs to a quadratic cost of the relative pose.

A point of a *source* scan, moved into the frame of a *target* scan, is paired with the nearest of the target's points
among the beams that point in its direction (Blais and Levine 1995; Censi 2008). The residual e is the distance from the
wall there, along the mean of the two normals, with the weight w = (1 + e^2 / c^2)^-2 of Geman and McClure. If neither
point has a normal, e is the offset in x and y, with less weight: two scans do not return the same points.

Let z = (x, y, yaw) be the pose of the source in the target's frame, and J the derivative of e by z. H = sum w J J^T
and g = sum w J e are the second and first derivatives of half the cost (Gauss-Newton). ``slack`` is the part of H that
comes from errors of the normals and is no information: sum w spread T T^T. T is the derivative of the offset *along*
the wall, spread the variance of the normal's angle for points of unit variance. Along a corridor H is slack alone.
"""

from typing import Any, NamedTuple

import numpy as np
import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Floats, Int32s, Ints, Singles, Vec3ds
from bayesmap.kernels.match import scan_geometry as kinds
from bayesmap.kernels.match.scan_geometry import ScanArrays, equal_weights, neighbour, scan_arrays

wp.set_module_options({"enable_backward": False})
OUT_OF_VIEW = wp.constant(-2)  # result of `nearest_point` if no beam points towards the point
MAX_SIDE_BEAMS = wp.constant(25)  # most beams that are searched on either side
MAX_SPACING_M = wp.constant(0.15)  # points of less dense surfaces, such as walls that beams graze, fix no pose
# Numbers of a `Totals`: sums over the pairs of points. COST and WEIGHT are of pairs with normals. MATCHED is the number
# of pairs, SEEN that of points between the beams of the target, within its range. FORCE_SQ sums the squared weighted
# residuals; a point's own weight enters once.
COST, WEIGHT, MATCHED, SEEN, FORCE_SQ = 0, 1, 2, 3, 4
Totals = wp.types.vector(length=5, dtype=wp.float32)
Totals64 = wp.types.vector(length=5, dtype=wp.float64)
Totals64s = wp.array(dtype=Totals64)


class PairRules(NamedTuple):
    """Rules of pairs of points, and of their weights."""

    reach_m: float  # largest distance of paired points
    scale_m: float  # c of Geman and McClure's weight
    min_cosine: float  # least cosine between the normals of a pair
    stride: int = 1  # one point in so many is paired


PairRulesArrays = devices.struct_like(PairRules, float, float, float, int)


@wp.struct
class NormalEquations:
    """The Gauss-Newton equations of a source scan and a target scan: sums over their pairs of points."""

    hessian: wp.mat33f  # H, above the diagonal
    slack: wp.mat33f  # above the diagonal
    gradient: wp.vec3f  # g
    totals: Totals


@wp.func
def angle_in_turns(vector: wp.vec2f) -> float:
    """Return the angle of a vector in turns, -1/2 to 1/2, to 0.05 degrees: a polynomial, faster than atan2."""
    ax, ay = wp.abs(vector[0]), wp.abs(vector[1])
    t = wp.min(ax, ay) / wp.max(wp.max(ax, ay), 1.0e-9)
    t2 = t * t
    angle = (((-0.0464964749 * t2 + 0.15931422) * t2 - 0.327622764) * t2 + 1.0) * t * 0.15915494309  # 1 / (2 pi)
    if ay > ax:
        angle = 0.25 - angle
    if vector[0] < 0.0:
        angle = 0.5 - angle
    return wp.where(vector[1] < 0.0, -angle, angle)


@wp.func
def beam_towards(scans: ScanArrays, scan: int, point: wp.vec2f) -> int:
    """Return the beam of a scan that points towards a point, or -1 if there is none."""
    bins = scans.beam_of_angle.shape[1]
    number = int((angle_in_turns(point) + 0.5) * float(bins))
    return scans.beam_of_angle[scans.layout[scan], wp.clamp(number, 0, bins - 1)]


@wp.func
def nearest_point(scans: ScanArrays, scan: int, point: wp.vec2f, reach_m: float) -> int:
    """Return the beam of the nearest point of a scan within ``reach_m``, or -1 if there is none, or `OUT_OF_VIEW`."""
    middle = beam_towards(scans, scan, point)
    if middle < 0:
        return OUT_OF_VIEW
    distance = wp.length(point)
    step = scans.step[scan]
    u = wp.min(1.0, reach_m / wp.max(distance, 1.0e-6))
    # No point within reach is further off by angle than asin(u) <= u + (pi / 2 - 1) u^3.
    side_beams = wp.min(MAX_SIDE_BEAMS, int((u + 0.5708 * u * u * u) / step) + 1)
    beams = scans.beams[scan]
    is_circle = scans.full_circle[scan] != 0
    closest_sq = reach_m * reach_m
    nearest = int(-1)
    # Search outwards. Points of equal distance count in the order of beams, so that the lower side takes ties.
    for k in range(side_beams + 1):
        # A beam that is off by the angle a has no point nearer than distance sin(a) >= distance (a - a^3 / 6).
        a = wp.min(float(k - 1) * step, 1.4)
        bound = distance * a * (1.0 - 0.16666667 * a * a)
        if k > 1 and bound * bound > closest_sq:
            break
        low = middle - k
        if low < 0 and is_circle:
            low += beams
        if low >= 0:
            d_sq = wp.length_sq(scans.points[scan, low] - point)
            if d_sq <= closest_sq:
                closest_sq = d_sq
                nearest = low
        high = middle + k
        if high >= beams and is_circle:
            high -= beams
        if k > 0 and high < beams:
            d_sq = wp.length_sq(scans.points[scan, high] - point)
            if d_sq < closest_sq:
                closest_sq = d_sq
                nearest = high
    return nearest


@wp.func
def neighbour_distance(scans: ScanArrays, scan: int, beam: int) -> float:
    """Return the spacing of returns on a surface: the distance of the nearer neighbouring point, 0.1 to 2 m."""
    beams = scans.beams[scan]
    nearest = float(2.0)
    point = scans.points[scan, beam]
    for side in range(2):
        nearby = neighbour(beam, 2 * side - 1, beams, scans.full_circle[scan])
        if nearby >= 0:
            if scans.kind[scan, nearby] != kinds.NO_POINT:
                nearest = wp.min(nearest, wp.length(scans.points[scan, nearby] - point))
    return wp.max(nearest, 0.1)


@wp.func
def symmetric(m: wp.mat33f) -> wp.mat33d:
    """Return a symmetric matrix in double precision, from its part above the diagonal."""
    d = wp.mat33d(m)
    return wp.mat33d(d[0, 0], d[0, 1], d[0, 2], d[0, 1], d[1, 1], d[1, 2], d[0, 2], d[1, 2], d[2, 2])


@wp.func
def rotation_of(pose: wp.vec3d) -> wp.mat22f:
    """Return the rotation of a pose."""
    c, s = float(wp.cos(pose[2])), float(wp.sin(pose[2]))
    return wp.mat22f(c, -s, s, c)


@wp.func
def sum_over_points(
    scans: ScanArrays, weights: Float32Rows, source: int, target: int, pose: wp.vec3d, rules: PairRulesArrays
) -> NormalEquations:
    """Pair a source scan's points, at its pose in the target's frame, with a target scan, and sum the equations."""
    turn = rotation_of(pose)
    shift = wp.vec2f(float(pose[0]), float(pose[1]))
    hessian = wp.mat33f()
    slack = wp.mat33f()
    gradient = wp.vec3f()
    totals = Totals()
    for beam in range(0, scans.kind.shape[1], rules.stride):
        if scans.kind[source, beam] == kinds.NO_POINT:
            continue
        arm = turn * scans.points[source, beam]  # from the source's laser to its point, in the target's axes
        point = arm + shift
        partner = nearest_point(scans, target, point, rules.reach_m)
        if partner == OUT_OF_VIEW:
            continue
        totals[SEEN] += 1.0
        if partner < 0:
            continue
        offset = point - scans.points[target, partner]
        has_normal = scans.kind[source, beam] == kinds.WITH_NORMAL
        partner_has_normal = scans.kind[target, partner] == kinds.WITH_NORMAL
        if has_normal and partner_has_normal:
            # Both points have normals: e is the offset along their mean, with the derivative ``across``.
            normal = turn * scans.normals[source, beam]
            partner_normal = scans.normals[target, partner]
            if wp.dot(normal, partner_normal) < rules.min_cosine:
                continue
            mean_normal = (normal + partner_normal) / wp.length(normal + partner_normal)
            e = wp.dot(mean_normal, offset)
            weight = 1.0 / (1.0 + e * e / (rules.scale_m * rules.scale_m))
            weight = weight * weight
            totals[FORCE_SQ] += weights[source, beam] * weight * weight * e * e
            weight = weight * weights[source, beam]
            across = wp.vec3f(mean_normal[0], mean_normal[1], mean_normal[1] * arm[0] - mean_normal[0] * arm[1])
            hessian += wp.outer(weight * across, across)
            gradient += (weight * across) * e
            slack_weight = weight * 0.25 * (scans.spread[source, beam] + scans.spread[target, partner])
            along = wp.vec3f(-mean_normal[1], mean_normal[0], wp.dot(mean_normal, arm))
            slack += wp.outer(slack_weight * along, along)
            totals[COST] += weight * e * e
            totals[WEIGHT] += weight
            totals[MATCHED] += 1.0
        elif not has_normal and not partner_has_normal:
            # Neither point has a normal: both components of the offset count.
            spacing = 0.5 * neighbour_distance(scans, target, partner)
            if spacing > MAX_SPACING_M:
                continue
            w = 1.0 / (1.0 + wp.length_sq(offset) / (rules.scale_m * rules.scale_m + spacing * spacing))
            w = w * w * weights[source, beam] * (0.01 * 0.01) / (spacing * spacing)  # 0.01 m: noise of a range
            hessian += wp.mat33f(w, 0.0, -w * arm[1], 0.0, w, w * arm[0], 0.0, 0.0, w * wp.length_sq(arm))
            gradient += w * wp.vec3f(offset[0], offset[1], arm[0] * offset[1] - arm[1] * offset[0])
            totals[MATCHED] += 1.0
    return NormalEquations(hessian, slack, gradient, totals)


class LinearisedPairs(NamedTuple):
    """The `NormalEquations` of P pairs of scans, in double precision."""

    hessian: Floats  # H, (P, 3, 3)
    slack: Floats  # (P, 3, 3)
    gradient: Floats  # g, (P, 3)
    totals: Floats  # COST, WEIGHT, MATCHED, SEEN, FORCE_SQ, (P, 5)


Mat33ds = wp.array(dtype=wp.mat33d)
LinearisedPairsArrays = devices.struct_like(LinearisedPairs, Mat33ds, Mat33ds, Vec3ds, Totals64s)


@wp.kernel
def store_equations(
    first: int, scans: ScanArrays, weights: Float32Rows, source: Int32s, target: Int32s, relative: Vec3ds,
    rules: PairRulesArrays, out: LinearisedPairsArrays,
):  # fmt: skip
    """One thread per pair of scans: compute their equations."""
    pair = first + wp.tid()
    equations = sum_over_points(scans, weights, source[pair], target[pair], relative[pair], rules)
    out.hessian[pair] = symmetric(equations.hessian)
    out.slack[pair] = symmetric(equations.slack)
    out.gradient[pair] = wp.vec3d(equations.gradient)
    out.totals[pair] = Totals64(equations.totals)


def linearise_pairs(
    geometry: Any, weights: Singles | None, source: Ints, target: Ints, relative: Floats, rules: PairRules,
    threads: int | None = None,
) -> LinearisedPairs:  # fmt: skip
    """Linearise P pairs of scans; ``relative`` are the poses of the sources in the frames of the targets, (P, 3)."""
    device, count = geometry.device, len(source)
    weights = equal_weights(geometry) if weights is None else weights
    shapes = dict.fromkeys(LinearisedPairs._fields, (count,))
    out = devices.pack(LinearisedPairsArrays, device, **shapes)
    packed_rules = devices.pack(PairRulesArrays, "cpu", **rules._asdict())
    inputs = [scan_arrays(geometry, rules.stride), weights, source, target, relative, packed_rules, out]
    devices.launch(store_equations, count, inputs, device, threads)
    return LinearisedPairs(out.hessian.numpy(), out.slack.numpy(), out.gradient.numpy(), out.totals.numpy())


@wp.kernel
def count_matches(
    first: int, scans: ScanArrays, offsets: Int32s, target: Int32s, relative: Vec3ds, rules: PairRulesArrays,
    counts: Float32Rows,
):  # fmt: skip
    """One thread per scan: count the scans with which each beam is paired, weighted by how well it fits."""
    source = first + wp.tid()
    for pair in range(offsets[source], offsets[source + 1]):
        other = target[pair]
        turn = rotation_of(relative[pair])
        shift = wp.vec2f(float(relative[pair][0]), float(relative[pair][1]))
        for beam in range(0, scans.kind.shape[1], rules.stride):
            if scans.kind[source, beam] == kinds.NO_POINT:
                continue
            point = turn * scans.points[source, beam] + shift
            partner = nearest_point(scans, other, point, rules.reach_m)
            if partner < 0 or scans.kind[source, beam] != scans.kind[other, wp.max(partner, 0)]:
                continue
            offset = point - scans.points[other, partner]
            error_sq = wp.length_sq(offset)
            if scans.kind[source, beam] == kinds.WITH_NORMAL:
                normal = scans.normals[other, partner]
                if wp.dot(turn * scans.normals[source, beam], normal) < rules.min_cosine:
                    continue
                e = wp.dot(normal, offset)
                error_sq = e * e
            w = 1.0 / (1.0 + error_sq / (rules.scale_m * rules.scale_m))
            counts[source, beam] = counts[source, beam] + w * w


def match_counts(
    geometry: Any, offsets: Ints, target: Ints, relative: Floats, rules: PairRules, threads: int | None = None
) -> Singles:
    """Count the partners of every ``stride``-th beam, (S, B); scan s has the pairs offsets[s] to offsets[s + 1]."""
    n_scans, scans = len(geometry), scan_arrays(geometry, rules.stride)
    packed_rules = devices.pack(PairRulesArrays, "cpu", **rules._asdict())
    inputs = [scans, offsets, target, relative, packed_rules, (n_scans, geometry.beams)]
    return np.asarray(devices.launch(count_matches, n_scans, inputs, geometry.device, threads)[0])
