"""Pair the points of one scan with the walls of another, sum the pairs to a quadratic, and count points that disagree.

A point of a *source* scan, moved into the frame of a *target* scan, is paired with the nearest of the target's points
among the beams that point in its direction (Blais and Levine 1995; Censi 2008). The residual e is the distance from the
wall there, along the mean of the two normals, with the weight w = (1 + e^2 / c^2)^-2 of Geman and McClure. If neither
point has a normal, e is the offset in x and y, with less weight: two scans do not return the same points.

Let z = (x, y, yaw) be the pose of the source in the target's frame, and J the derivative of e by z. H = sum w J J^T
and g = sum w J e are the second and first derivatives of half the cost (Gauss-Newton). ``slack`` is the part of H that
comes from errors of the normals and is no information: sum w spread T T^T. T is the derivative of the offset *along*
the wall, spread the variance of the normal's angle for points of unit variance. Along a corridor H is slack alone.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Floats, Int32Rows, Int32s, Ints, Singles, Vec3ds
from bayesmap.kernels.match import scan_geometry as scenes
from bayesmap.kernels.match.scan_geometry import ScanArrays, equal_weights, max_gap, neighbour, scan_arrays
from bayesmap.space.planar import inverse

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
class Sums:
    """Sums over the pairs of points of two scans."""

    second: wp.mat33f  # H, above the diagonal
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
def beam_towards(scene: ScanArrays, scan: int, point: wp.vec2f) -> int:
    """Return the beam of a scan that points towards a point, or -1 if there is none."""
    bins = scene.beam_of_angle.shape[1]
    number = int((angle_in_turns(point) + 0.5) * float(bins))
    return scene.beam_of_angle[scene.layout[scan], wp.clamp(number, 0, bins - 1)]


@wp.func
def nearest_point(scene: ScanArrays, scan: int, point: wp.vec2f, reach_m: float) -> int:
    """Return the beam of the nearest point of a scan within ``reach_m``, or -1 if there is none, or `OUT_OF_VIEW`."""
    middle = beam_towards(scene, scan, point)
    if middle < 0:
        return OUT_OF_VIEW
    distance = wp.length(point)
    step = scene.step[scan]
    u = wp.min(1.0, reach_m / wp.max(distance, 1.0e-6))
    # No point within reach is further off by angle than asin(u) <= u + (pi / 2 - 1) u^3.
    side_beams = wp.min(MAX_SIDE_BEAMS, int((u + 0.5708 * u * u * u) / step) + 1)
    beams = scene.beams[scan]
    is_circle = scene.full_circle[scan] != 0
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
            d_sq = wp.length_sq(scene.points[scan, low] - point)
            if d_sq <= closest_sq:
                closest_sq = d_sq
                nearest = low
        high = middle + k
        if high >= beams and is_circle:
            high -= beams
        if k > 0 and high < beams:
            d_sq = wp.length_sq(scene.points[scan, high] - point)
            if d_sq < closest_sq:
                closest_sq = d_sq
                nearest = high
    return nearest


@wp.func
def neighbour_distance(scene: ScanArrays, scan: int, beam: int) -> float:
    """Return the spacing of returns on a surface: the distance of the nearer neighbouring point, 0.1 to 2 m."""
    beams = scene.beams[scan]
    nearest = float(2.0)
    point = scene.points[scan, beam]
    for side in range(2):
        nearby = neighbour(beam, 2 * side - 1, beams, scene.full_circle[scan])
        if nearby >= 0:
            if scene.kind[scan, nearby] != scenes.NO_POINT:
                nearest = wp.min(nearest, wp.length(scene.points[scan, nearby] - point))
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
def pair_scans(
    scene: ScanArrays, weights: Float32Rows, source: int, target: int, pose: wp.vec3d, rules: PairRulesArrays
) -> Sums:
    """Sum over the pairs of a source scan's points, at its pose in the target's frame, with a target scan."""
    turn = rotation_of(pose)
    shift = wp.vec2f(float(pose[0]), float(pose[1]))
    second = wp.mat33f()
    slack = wp.mat33f()
    gradient = wp.vec3f()
    totals = Totals()
    for beam in range(0, scene.kind.shape[1], rules.stride):
        if scene.kind[source, beam] == scenes.NO_POINT:
            continue
        arm = turn * scene.points[source, beam]  # from the source's laser to its point, in the target's axes
        point = arm + shift
        partner = nearest_point(scene, target, point, rules.reach_m)
        if partner == OUT_OF_VIEW:
            continue
        totals[SEEN] += 1.0
        if partner < 0:
            continue
        offset = point - scene.points[target, partner]
        has_normal = scene.kind[source, beam] == scenes.WITH_NORMAL
        partner_has_normal = scene.kind[target, partner] == scenes.WITH_NORMAL
        if has_normal and partner_has_normal:
            # Both points have normals: e is the offset along their mean, with the derivative ``across``.
            normal = turn * scene.normals[source, beam]
            partner_normal = scene.normals[target, partner]
            if wp.dot(normal, partner_normal) < rules.min_cosine:
                continue
            mean_normal = (normal + partner_normal) / wp.length(normal + partner_normal)
            e = wp.dot(mean_normal, offset)
            weight = 1.0 / (1.0 + e * e / (rules.scale_m * rules.scale_m))
            weight = weight * weight
            totals[FORCE_SQ] += weights[source, beam] * weight * weight * e * e
            weight = weight * weights[source, beam]
            across = wp.vec3f(mean_normal[0], mean_normal[1], mean_normal[1] * arm[0] - mean_normal[0] * arm[1])
            second += wp.outer(weight * across, across)
            gradient += (weight * across) * e
            slack_weight = weight * 0.25 * (scene.spread[source, beam] + scene.spread[target, partner])
            along = wp.vec3f(-mean_normal[1], mean_normal[0], wp.dot(mean_normal, arm))
            slack += wp.outer(slack_weight * along, along)
            totals[COST] += weight * e * e
            totals[WEIGHT] += weight
            totals[MATCHED] += 1.0
        elif not has_normal and not partner_has_normal:
            # Neither point has a normal: both components of the offset count.
            spacing = 0.5 * neighbour_distance(scene, target, partner)
            if spacing > MAX_SPACING_M:
                continue
            w = 1.0 / (1.0 + wp.length_sq(offset) / (rules.scale_m * rules.scale_m + spacing * spacing))
            w = w * w * weights[source, beam] * (0.01 * 0.01) / (spacing * spacing)  # 0.01 m: noise of a range
            second += wp.mat33f(w, 0.0, -w * arm[1], 0.0, w, w * arm[0], 0.0, 0.0, w * wp.length_sq(arm))
            gradient += w * wp.vec3f(offset[0], offset[1], arm[0] * offset[1] - arm[1] * offset[0])
            totals[MATCHED] += 1.0
    return Sums(second, slack, gradient, totals)


class PairSums(NamedTuple):
    """The `Sums` of P pairs of scans, in double precision."""

    second: Floats  # H, (P, 3, 3)
    slack: Floats  # (P, 3, 3)
    gradient: Floats  # g, (P, 3)
    totals: Floats  # COST, WEIGHT, MATCHED, SEEN, FORCE_SQ, (P, 5)


Mat33ds = wp.array(dtype=wp.mat33d)
PairSumsArrays = devices.struct_like(PairSums, Mat33ds, Mat33ds, Vec3ds, Totals64s)


@wp.kernel
def sum_pairs(
    first: int, scene: ScanArrays, weights: Float32Rows, source: Int32s, target: Int32s, relative: Vec3ds,
    rules: PairRulesArrays, out: PairSumsArrays,
):  # fmt: skip
    """One thread per pair of scans: sum over the pairs of their points."""
    pair = first + wp.tid()
    sums = pair_scans(scene, weights, source[pair], target[pair], relative[pair], rules)
    out.second[pair] = symmetric(sums.second)
    out.slack[pair] = symmetric(sums.slack)
    out.gradient[pair] = wp.vec3d(sums.gradient)
    out.totals[pair] = Totals64(sums.totals)


def pair_sums(
    geometry: Any, weights: Singles | None, source: Ints, target: Ints, relative: Floats, rules: PairRules,
    threads: int | None = None,
) -> PairSums:  # fmt: skip
    """Sum the pairs of scans ``source`` and ``target``, (P,); ``relative`` are poses in the targets' frames, (P, 3)."""
    device, count = geometry.device, len(source)
    weights = equal_weights(geometry) if weights is None else weights
    out = devices.pack(PairSumsArrays, device, second=(count,), slack=(count,), gradient=(count,), totals=(count,))
    packed_rules = devices.pack(PairRulesArrays, "cpu", **rules._asdict())
    inputs = [scan_arrays(geometry, rules.stride), weights, source, target, relative, packed_rules, out]
    devices.launch(sum_pairs, count, inputs, device, threads)
    return PairSums(out.second.numpy(), out.slack.numpy(), out.gradient.numpy(), out.totals.numpy())


@wp.kernel
def count_matches(
    first: int, scene: ScanArrays, offsets: Int32s, target: Int32s, relative: Vec3ds, rules: PairRulesArrays,
    counts: Float32Rows,
):  # fmt: skip
    """One thread per scan: count the scans with which each beam is paired, weighted by how well it fits."""
    source = first + wp.tid()
    for pair in range(offsets[source], offsets[source + 1]):
        other = target[pair]
        turn = rotation_of(relative[pair])
        shift = wp.vec2f(float(relative[pair][0]), float(relative[pair][1]))
        for beam in range(0, scene.kind.shape[1], rules.stride):
            if scene.kind[source, beam] == scenes.NO_POINT:
                continue
            point = turn * scene.points[source, beam] + shift
            partner = nearest_point(scene, other, point, rules.reach_m)
            if partner < 0 or scene.kind[source, beam] != scene.kind[other, wp.max(partner, 0)]:
                continue
            offset = point - scene.points[other, partner]
            error_sq = wp.length_sq(offset)
            if scene.kind[source, beam] == scenes.WITH_NORMAL:
                normal = scene.normals[other, partner]
                if wp.dot(turn * scene.normals[source, beam], normal) < rules.min_cosine:
                    continue
                e = wp.dot(normal, offset)
                error_sq = e * e
            w = 1.0 / (1.0 + error_sq / (rules.scale_m * rules.scale_m))
            counts[source, beam] = counts[source, beam] + w * w


def match_counts(
    geometry: Any, offsets: Ints, target: Ints, relative: Floats, rules: PairRules, threads: int | None = None
) -> Singles:
    """Count the partners of every ``stride``-th beam, (S, B); scan s has the pairs offsets[s] to offsets[s + 1]."""
    scans, scene = len(geometry), scan_arrays(geometry, rules.stride)
    packed_rules = devices.pack(PairRulesArrays, "cpu", **rules._asdict())
    inputs = [scene, offsets, target, relative, packed_rules, (scans, geometry.beams)]
    return np.asarray(devices.launch(count_matches, scans, inputs, geometry.device, threads)[0])


@wp.func
def is_near_wall(scene: ScanArrays, scan: int, beam: int, point: wp.vec2f, near_m: float) -> int:
    """Return 1 if a point is near the wall between the points of a beam and the next beam, else 0."""
    beams = scene.beams[scan]
    start = beam
    if start < 0:
        if scene.full_circle[scan] == 0:
            return 0
        start += beams
    end = neighbour(start, 1, beams, scene.full_circle[scan])
    if end < 0:
        return 0
    if scene.kind[scan, start] == scenes.NO_POINT or scene.kind[scan, end] == scenes.NO_POINT:
        return 0
    start_point = scene.points[scan, start]
    wall = scene.points[scan, end] - start_point
    length = wp.length(wall)
    if length > max_gap(scene.step[scan], wp.length(start_point)):
        return 0
    to_point = point - start_point
    share = wp.clamp(wp.dot(to_point, wall) / wp.max(length * length, 1.0e-9), 0.0, 1.0)
    return wp.where(wp.length(to_point - share * wall) < near_m, 1, 0)


@wp.kernel
def compare_views(
    first: int, scene: ScanArrays, source: Int32s, target: Int32s, relative: Vec3ds, near_m: float, clear_m: float,
    counts: Int32Rows,
):  # fmt: skip
    """One thread per pair: count the points of the source that match the target, that contradict it, and all points."""
    # A point contradicts the target if three neighbouring beams of it all hit something ``clear_m`` beyond the point.
    pair = first + wp.tid()
    other = target[pair]
    turn = rotation_of(relative[pair])
    shift = wp.vec2f(float(relative[pair][0]), float(relative[pair][1]))
    matched, contradicting, total = int(0), int(0), int(0)
    for beam in range(0, scene.kind.shape[1], scene.stride):
        if scene.kind[source[pair], beam] == scenes.NO_POINT:
            continue
        total += 1
        point = turn * scene.points[source[pair], beam] + shift
        # A match: near a point, or near the wall between two points.
        if nearest_point(scene, other, point, near_m) >= 0:
            matched += 1
            continue
        middle = beam_towards(scene, other, point)
        if middle < 0:
            continue
        walls = is_near_wall(scene, other, middle - 1, point, near_m) + is_near_wall(
            scene, other, middle, point, near_m
        )
        if walls > 0:
            matched += 1
            continue
        # A contradiction: the beams about the point pass through it.
        beyond = wp.length(point) + clear_m
        through = int(0)
        for step in range(-1, 2):
            nearby = neighbour(middle, step, scene.beams[other], scene.full_circle[other])
            if nearby >= 0:
                if scene.kind[other, nearby] != scenes.NO_POINT and wp.length(scene.points[other, nearby]) > beyond:
                    through += 1
        if through == 3:
            contradicting += 1
    counts[pair, 0] = matched
    counts[pair, 1] = contradicting
    counts[pair, 2] = total


@dataclass(frozen=True)
class Agreement:
    """Rules for points of one scan that match another scan, or contradict it."""

    near_m: float  # distance to a point of the other scan, or to the wall between two neighbouring points, of a match
    clear_m: float  # least distance of a contradicting point before the points that the other scan hit
    beams: int  # number of beams of each scan that are compared, about


def view_counts(
    geometry: Any, source: Ints, target: Ints, relative: Floats, agreement: Agreement, threads: int | None = None
) -> Ints:
    """Count each source's points that match, that contradict, and all, (P, 3); ``relative`` poses: in target frames."""
    scene, pairs = scan_arrays(geometry, max(1, geometry.beams // agreement.beams)), len(source)
    inputs = [scene, source, target, relative, agreement.near_m, agreement.clear_m, (pairs, 3)]
    return np.asarray(devices.launch(compare_views, pairs, inputs, geometry.device, threads)[0])


def mutual_view_counts(
    geometry: Any, first: Ints, second: Ints, relative: Floats, agreement: Agreement, threads: int | None = None
) -> Ints:
    """Sum `view_counts` in both directions, (P, 3); ``relative`` are the poses of the second in the first's frame."""
    counts = view_counts(geometry, second, first, relative, agreement, threads)
    return counts + view_counts(geometry, first, second, inverse(relative), agreement, threads)
