"""Pair the points of one scan with the walls of another, sum the pairs to a quadratic, and count points that disagree.

A point of scan i, moved into the frame of scan j, is paired with the nearest point of j among the beams that point in
its direction (Blais and Levine 1995; Censi 2008). The residual e is the distance from the wall there, along the mean of
the two normals, with the weight of Geman and McClure, (1 + e^2 / c^2)^-2. If neither point has a normal, it is the
offset in x and y, with less weight: two scans do not return the same points.

Let z = (x, y, yaw) be the pose of i in j's frame. H = sum w J J^T and g = sum w J e are the second and first
derivatives of half the cost by z (Gauss-Newton). ``slack`` is the part of H that comes from errors of the normals and
is no information: sum w spread T T^T, T the derivative of the offset *along* the wall, spread the variance of the
normal's angle for points of unit variance. Along a corridor H is slack alone.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float64Rows, Floats, Int32Rows, Int32s, Ints, Singles, Vec3ds
from bayesmap.kernels.match.scan_geometry import WITH_NORMAL, ScanArrays, equal_weights, max_gap, neighbour, scan_arrays
from bayesmap.space.planar import inverse

wp.set_module_options({"enable_backward": False})

MOST_BEAMS = wp.constant(25)  # most beams searched to either side
WIDEST_SPACING_M = wp.constant(0.15)  # points of less dense surfaces, such as walls that beams graze, fix no pose


@wp.struct
class PairRule:
    """Rules of pairs of points, and of their weights."""

    reach: float  # furthest that they may lie apart
    scale: float  # Geman and McClure's c
    alike: float  # least cosine between their normals


@wp.struct
class Sums:
    """Sums over the pairs of two scans."""

    second: wp.mat33f  # above the diagonal
    slack: wp.mat33f  # above the diagonal
    first: wp.vec3f
    cost: float
    weight: float
    force_sq: float  # sum of the squared weighted residuals; a point's own weight enters once
    matched: int
    seen: int  # points that fall between the beams of the other scan, within its range


@wp.func
def turns_of(p: wp.vec2f) -> float:
    """Return the angle of a vector in turns, -1/2 to 1/2, to 0.05 degrees: a polynomial, faster than atan2."""
    ax = wp.abs(p[0])
    ay = wp.abs(p[1])
    t = wp.min(ax, ay) / wp.max(wp.max(ax, ay), 1.0e-9)
    t2 = t * t
    angle = (((-0.0464964749 * t2 + 0.15931422) * t2 - 0.327622764) * t2 + 1.0) * t * 0.15915494309
    if ay > ax:
        angle = 0.25 - angle
    if p[0] < 0.0:
        angle = 0.5 - angle
    return wp.where(p[1] < 0.0, -angle, angle)


@wp.func
def beam_towards(scene: ScanArrays, j: int, point: wp.vec2f) -> int:
    """Return the beam of scan j that points towards a point; -1 if there is none."""
    bins = scene.beam_of_angle.shape[1]
    bin = int((turns_of(point) + 0.5) * float(bins))
    return scene.beam_of_angle[scene.layout[j], wp.clamp(bin, 0, bins - 1)]


@wp.func
def nearest_point(scene: ScanArrays, j: int, point: wp.vec2f, reach: float) -> int:
    """Return the beam of the nearest point of scan j within reach; -1 if there is none, -2 if out of view."""
    middle = beam_towards(scene, j, point)
    if middle < 0:
        return -2
    away = wp.length(point)
    step = scene.step[j]
    u = wp.min(1.0, reach / wp.max(away, 1.0e-6))
    # No point within reach is further off by angle than asin(u) <= u + (pi / 2 - 1) u^3.
    wide = wp.min(MOST_BEAMS, int((u + 0.5708 * u * u * u) / step) + 1)
    beams = scene.beams[j]
    circle = scene.full_circle[j] != 0
    closest = reach * reach
    nearest = int(-1)
    # Search outwards. Points of equal distance count in the order of beams, so that the lower side takes ties.
    for k in range(wide + 1):
        # A beam that is off by the angle a has no point nearer than away sin(a) >= away (a - a^3 / 6).
        a = wp.min(float(k - 1) * step, 1.4)
        bound = away * a * (1.0 - 0.16666667 * a * a)
        if k > 1 and bound * bound > closest:
            break
        low = middle - k
        if low < 0 and circle:
            low += beams
        if low >= 0:
            d = wp.length_sq(scene.points[j, low] - point)
            if d <= closest:
                closest = d
                nearest = low
        high = middle + k
        if high >= beams and circle:
            high -= beams
        if k > 0 and high < beams:
            d = wp.length_sq(scene.points[j, high] - point)
            if d < closest:
                closest = d
                nearest = high
    return nearest


@wp.func
def neighbour_distance(scene: ScanArrays, j: int, beam: int) -> float:
    """Return the spacing of returns on a surface: the distance of the nearer neighbouring point, 0.1 to 2 m."""
    beams = scene.beams[j]
    nearest = float(2.0)
    point = scene.points[j, beam]
    for side in range(2):
        c = neighbour(beam, 2 * side - 1, beams, scene.full_circle[j])
        if c >= 0:
            if scene.kind[j, c] != wp.uint8(0):
                nearest = wp.min(nearest, wp.length(scene.points[j, c] - point))
    return wp.max(nearest, 0.1)


@wp.func
def symmetric(m: wp.mat33f) -> wp.mat33d:
    """Return a symmetric matrix in double precision, from its part above the diagonal."""
    d = wp.mat33d(m)
    return wp.mat33d(d[0, 0], d[0, 1], d[0, 2], d[0, 1], d[1, 1], d[1, 2], d[0, 2], d[1, 2], d[2, 2])


@wp.func
def turn_by(z: wp.vec3d) -> wp.mat22f:
    """Return the rotation of a pose."""
    c = float(wp.cos(z[2]))
    s = float(wp.sin(z[2]))
    return wp.mat22f(c, -s, s, c)


@wp.func
def shift_by(z: wp.vec3d) -> wp.vec2f:
    """Return the position of a pose."""
    return wp.vec2f(float(z[0]), float(z[1]))


@wp.func
def pair_scans(
    scene: ScanArrays, weights: Float32Rows, i: int, j: int, z: wp.vec3d, rule: PairRule, stride: int
) -> Sums:
    """Sum over every ``stride``-th point of scan i on scan j, with i at pose z in j's frame."""
    # b: beam of i; r: its point turned by z; point: the point in j's frame; other: its partner; d: offset from the
    # partner; e: residual; w: weight; n, m: normals of the two points.
    turn = turn_by(z)
    shift = shift_by(z)
    second = wp.mat33f()
    slack = wp.mat33f()
    first = wp.vec3f()
    cost = float(0.0)
    total = float(0.0)
    force_sq = float(0.0)
    matched = int(0)
    seen = int(0)
    for b in range(0, scene.kind.shape[1], stride):
        if scene.kind[i, b] == wp.uint8(0):
            continue
        r = turn * scene.points[i, b]
        point = r + shift
        other = nearest_point(scene, j, point, rule.reach)
        if other == -2:
            continue
        seen += 1
        if other < 0:
            continue
        d = point - scene.points[j, other]
        has_normal = scene.kind[i, b] == WITH_NORMAL
        other_has_normal = scene.kind[j, other] == WITH_NORMAL
        if has_normal and other_has_normal:
            # Both points have normals: e is the offset along their mean u, with the derivative across.
            n = turn * scene.normals[i, b]
            m = scene.normals[j, other]
            if wp.dot(n, m) < rule.alike:
                continue
            u = (n + m) / wp.length(n + m)
            e = wp.dot(u, d)
            w = 1.0 / (1.0 + e * e / (rule.scale * rule.scale))
            w = w * w
            force_sq += weights[i, b] * w * w * e * e
            w = w * weights[i, b]
            across = wp.vec3f(u[0], u[1], u[1] * r[0] - u[0] * r[1])
            second += wp.outer(w * across, across)
            first += (w * across) * e
            v = w * 0.25 * (scene.spread[i, b] + scene.spread[j, other])
            along = wp.vec3f(-u[1], u[0], wp.dot(u, r))
            slack += wp.outer(v * along, along)
            cost += w * e * e
            total += w
            matched += 1
        elif not has_normal and not other_has_normal:
            # Neither point has a normal: both components of the offset count.
            spacing = 0.5 * neighbour_distance(scene, j, other)
            if spacing > WIDEST_SPACING_M:
                continue
            w = 1.0 / (1.0 + wp.length_sq(d) / (rule.scale * rule.scale + spacing * spacing))
            w = w * w * weights[i, b] * (0.01 * 0.01) / (spacing * spacing)
            second += wp.mat33f(w, 0.0, -w * r[1], 0.0, w, w * r[0], 0.0, 0.0, w * wp.length_sq(r))
            first += w * wp.vec3f(d[0], d[1], r[0] * d[1] - r[1] * d[0])
            matched += 1
    return Sums(second, slack, first, cost, total, force_sq, matched, seen)


@wp.struct
class PairSums:
    """The `Sums` of all pairs of scans."""

    second: wp.array(dtype=wp.mat33d)
    slack: wp.array(dtype=wp.mat33d)
    gradient: Vec3ds
    totals: Float64Rows  # cost, weight, matched, seen, force_sq


@wp.kernel
def sum_pairs(
    first: int, scene: ScanArrays, weights: Float32Rows, source: Int32s, target: Int32s, relative: Vec3ds,
    rule: PairRule, out: PairSums,
):  # fmt: skip
    """One thread per pair of scans: sum over the pairs of their points."""
    p = first + wp.tid()
    sums = pair_scans(scene, weights, source[p], target[p], relative[p], rule, scene.stride)
    out.second[p] = symmetric(sums.second)
    out.slack[p] = symmetric(sums.slack)
    out.gradient[p] = wp.vec3d(sums.first)
    out.totals[p, 0] = wp.float64(sums.cost)
    out.totals[p, 1] = wp.float64(sums.weight)
    out.totals[p, 2] = wp.float64(sums.matched)
    out.totals[p, 3] = wp.float64(sums.seen)
    out.totals[p, 4] = wp.float64(sums.force_sq)


def pair_sums(
    geometry: Any, weights: Singles | None, source: Ints, target: Ints, relative: Floats, reach_m: float,
    scale_m: float, alike: float, stride: int = 1, threads: int | None = None,
) -> tuple[Floats, Floats, Floats, Floats]:  # fmt: skip
    """Compute H (P, 3, 3), slack (P, 3, 3), g (P, 3) and totals (P, 5) of pairs of scans; see `Sums` for the totals."""
    device, count = geometry.device, len(source)
    weights = equal_weights(geometry) if weights is None else weights
    rule = devices.pack(PairRule, device, reach=reach_m, scale=scale_m, alike=alike)
    out = devices.pack(PairSums, device, second=(count,), slack=(count,), gradient=(count,), totals=(count, 5))
    inputs = [scan_arrays(geometry, stride), weights, source, target, relative, rule, out]
    devices.launch(sum_pairs, count, inputs, device, threads)
    return out.second.numpy(), out.slack.numpy(), out.gradient.numpy(), out.totals.numpy()


@wp.kernel
def count_matches(
    first: int, scene: ScanArrays, offsets: Int32s, target: Int32s, relative: Vec3ds, rule: PairRule,
    counts: Float32Rows,
):  # fmt: skip
    """One thread per scan: count the scans with which each beam is paired, weighted by how well it fits."""
    i = first + wp.tid()
    for p in range(offsets[i], offsets[i + 1]):
        j = target[p]
        turn = turn_by(relative[p])
        shift = shift_by(relative[p])
        for b in range(0, scene.kind.shape[1], scene.stride):
            if scene.kind[i, b] == wp.uint8(0):
                continue
            point = turn * scene.points[i, b] + shift
            other = nearest_point(scene, j, point, rule.reach)
            if other < 0 or scene.kind[i, b] != scene.kind[j, wp.max(other, 0)]:
                continue
            d = point - scene.points[j, other]
            error_sq = wp.length_sq(d)
            if scene.kind[i, b] == WITH_NORMAL:
                m = scene.normals[j, other]
                if wp.dot(turn * scene.normals[i, b], m) < rule.alike:
                    continue
                e = wp.dot(m, d)
                error_sq = e * e
            w = 1.0 / (1.0 + error_sq / (rule.scale * rule.scale))
            counts[i, b] = counts[i, b] + w * w


def match_counts(
    geometry: Any, offsets: Ints, target: Ints, relative: Floats, reach_m: float, scale_m: float, alike: float,
    stride: int = 1, threads: int | None = None,
) -> Singles:  # fmt: skip
    """Count the partners of every ``stride``-th beam, (S, B); scan s has the pairs offsets[s] to offsets[s + 1]."""
    scans, rule = len(geometry), devices.pack(PairRule, geometry.device, reach=reach_m, scale=scale_m, alike=alike)
    inputs = [scan_arrays(geometry, stride), offsets, target, relative, rule, (scans, geometry.beams)]
    return np.asarray(devices.launch(count_matches, scans, inputs, geometry.device, threads)[0])


@wp.func
def is_near_wall(scene: ScanArrays, j: int, beam: int, point: wp.vec2f, near: float) -> int:
    """Return 1 if a point is near the wall between the points of a beam of scan j and the next beam, else 0."""
    beams = scene.beams[j]
    a = beam
    if a < 0:
        if scene.full_circle[j] == 0:
            return 0
        a += beams
    b = neighbour(a, 1, beams, scene.full_circle[j])
    if b < 0:
        return 0
    if scene.kind[j, a] == wp.uint8(0) or scene.kind[j, b] == wp.uint8(0):
        return 0
    p = scene.points[j, a]
    d = scene.points[j, b] - p
    size = wp.length(d)
    if size > max_gap(scene.step[j], wp.length(p)):
        return 0
    to_point = point - p
    share = wp.clamp(wp.dot(to_point, d) / wp.max(size * size, 1.0e-9), 0.0, 1.0)
    return wp.where(wp.length(to_point - share * d) < near, 1, 0)


@wp.kernel
def compare_views(
    first: int, scene: ScanArrays, source: Int32s, target: Int32s, relative: Vec3ds, near: float, clear: float,
    counts: Int32Rows,
):  # fmt: skip
    """One thread per pair: count the points of the source that match the target, that contradict it, and all points."""
    # p: pair; i, j: source and target; k: beam of the source. A point contradicts the target if three neighbouring
    # beams of the target all hit something ``clear`` metres beyond it.
    p = first + wp.tid()
    i = source[p]
    j = target[p]
    turn = turn_by(relative[p])
    shift = shift_by(relative[p])
    matched = int(0)
    against = int(0)
    total = int(0)
    for k in range(0, scene.kind.shape[1], scene.stride):
        if scene.kind[i, k] == wp.uint8(0):
            continue
        total += 1
        point = turn * scene.points[i, k] + shift
        if nearest_point(scene, j, point, near) >= 0:
            matched += 1
            continue
        middle = beam_towards(scene, j, point)
        if middle < 0:
            continue
        if is_near_wall(scene, j, middle - 1, point, near) + is_near_wall(scene, j, middle, point, near) > 0:
            matched += 1
            continue
        away = wp.length(point)
        through = int(0)
        for d in range(-1, 2):
            c = neighbour(middle, d, scene.beams[j], scene.full_circle[j])
            if c >= 0:
                if scene.kind[j, c] != wp.uint8(0) and wp.length(scene.points[j, c]) > away + clear:
                    through += 1
        if through == 3:
            against += 1
    counts[p, 0] = matched
    counts[p, 1] = against
    counts[p, 2] = total


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
