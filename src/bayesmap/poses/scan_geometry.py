"""Compute the geometry of scans for matching: end points, wall normals, and the noise of the laser's ranges.

`scan_geometry` is the main function. It merges beams that are too dense (`merge_beams`), estimates the noise
(`range_noise_m`), and lets a kernel compute points and normals. `ScanGeometry` holds the result.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.sensors.model import RangeLimits
from bayesmap.space.arrays import Indices, evenly_spaced
from bayesmap.space.planar import Floats
from bayesmap.space.scans import Scans

MIN_NOISE_M = 0.01  # standard deviation of a range: walls are rough, and robots move while they scan
MAX_NOISE_M = 0.05  # largest noise: with more, neighbouring walls could not be distinguished
MAX_NOISE_SCANS = 300  # scans from which the noise is estimated
MIN_TRIPLES = 100  # triples of neighbouring beams
GAP_M, GAP_STEPS = 0.15, 3.5  # metres plus beam spacings beyond which neighbouring readings lie on different surfaces
MEDIAN_OF_NORMAL = 0.6745  # median absolute value of a standard normal variable
MIN_NORMAL_REACH_M = 0.12  # half length of wall to which normals are fitted: with less, scans slide
MIN_NORMAL_REACH_SIGMAS = 10.0  # half length of wall in standard deviations of a range
MIN_RANGE_M = 0.05  # range below which readings are hits on the robot itself, metres
MIN_REACH_SIGMAS = 6.0  # pairing distance in standard deviations of a range
MIN_SCALE_SIGMAS = 3.0  # outlier scale in standard deviations of a range
MERGED_RAD = np.radians(1.0)  # closer beams are merged to this spacing, so that points are about a cell apart
BINS_A_BEAM = 4  # bins of angle per beam in the table of `Fans`
BINS_BOUNDS = (360, 1 << 16)  # bounds on the number of bins
MAX_ARC = 8  # a fan of at most so many beams is an arc, never a full circle
CIRCLE_GAP = 1.9  # a full circle has a smaller gap between its last and its first beam, in steps of the fan
NO_POINT, POINT, WITH_NORMAL = 0, 1, 2  # kinds of a beam's end: no point, a point, a point with a normal


@dataclass(frozen=True, eq=False)
class Fans:
    """The beam directions of S scans, of one fan of beams each. Beams are in the order of angles."""

    beams: NDArray[np.int32]  # number of beams of each scan, (S,)
    step_rad: Floats  # median angle between neighbouring beams of each scan, (S,)
    full_circle: NDArray[np.int32]  # 1 if the last beam's neighbour is the first, else 0, (S,)
    layout: NDArray[np.int32]  # row of ``beam_of_angle`` for each scan, (S,). Scans with equal beams share a row.
    beam_of_angle: NDArray[np.int32]  # nearest to equal bins from -pi to pi, (layouts, bins); -1 if none is near

    @classmethod
    def of(cls, angles_rad: Floats, n_scans: int) -> "Fans":
        """Return the fans of beams at ascending angles, (1, A) for all scans or (S, A), NaN past a scan's last beam."""
        beams = np.isfinite(angles_rad).sum(axis=1)
        # Number the layouts, which are rows of equal angles, and take the beams of one scan of each.
        numbers: dict[bytes, int] = {}
        layout = np.array([numbers.setdefault(row.tobytes(), len(numbers)) for row in angles_rad])
        fans = [angles_rad[scan, : beams[scan]] for scan in np.unique(layout, return_index=True)[1]]
        # Compute the step of each layout, whether it is a full circle, and its table of beams by angle.
        steps = [float(np.median(np.diff(fan))) if len(fan) > 1 else np.pi for fan in fans]
        steps = [step if step > 0 else np.pi for step in steps]  # beams that repeat one direction have no step
        layouts = list(zip(fans, steps, strict=True))
        circle = [len(fan) > MAX_ARC and 2.0 * np.pi - (fan[-1] - fan[0]) < CIRCLE_GAP * step for fan, step in layouts]
        bins = int(np.clip(np.ceil(2.0 * np.pi / min(steps) * BINS_A_BEAM), *BINS_BOUNDS))
        by_scan = np.broadcast_to(layout, n_scans)
        return cls(
            beams=np.broadcast_to(beams, n_scans).astype(np.int32), step_rad=np.array(steps)[by_scan],
            full_circle=np.array(circle, np.int32)[by_scan], layout=by_scan.astype(np.int32),
            beam_of_angle=np.array([_beam_of_angle(fan, step, bins) for fan, step in layouts]),
        )  # fmt: skip

    def select(self, scans: Indices) -> "Fans":
        """Return the fans of N scans by their indices, (N,)."""
        return replace(
            self, beams=self.beams[scans], step_rad=self.step_rad[scans], full_circle=self.full_circle[scans],
            layout=self.layout[scans],
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class ScanGeometry:
    """Points and normals of S scans of up to B beams, as Warp arrays; beams in the order of angles."""

    points: Any  # end point of each beam, metres in the laser's frame, (S, B)
    normals: Any  # unit normal of the wall there, towards the laser, (S, B); zero where there is none
    kind: Any  # one of the kinds above, (S, B)
    spread: Any  # variance of the normal's angle for a unit variance of the points, 1 / m^2, (S, B)
    fans: Fans  # directions of the beams
    noise_m: float = MIN_NOISE_M  # standard deviation of a range, estimated from the scans
    device: str = "cpu"  # device of the arrays
    threads: int | None = None  # number of threads for all that is computed from this geometry; all cores if None

    def __len__(self) -> int:
        return int(self.kind.shape[0])

    @property
    def beams(self) -> int:
        """The number of beams of the largest scan."""
        return int(self.kind.shape[1])

    def reach_m(self, first_m: float, last_m: float) -> tuple[float, float]:
        """Return the maximum distance of paired points in the first and the last round, raised to fit the noise."""
        min_reach_m = MIN_REACH_SIGMAS * self.noise_m
        return max(first_m, min_reach_m), max(last_m, min_reach_m)

    def scale_m(self, first_m: float, last_m: float) -> tuple[float, float]:
        """Return Geman and McClure's c in the first and the last round, raised so that noise makes no outliers."""
        min_scale_m = MIN_SCALE_SIGMAS * self.noise_m
        return max(first_m, min_scale_m), max(last_m, min_scale_m)

    @cached_property
    def host_points(self) -> NDArray[np.float32]:
        """The points in main memory, (S, B, 2)."""
        return np.asarray(self.points.numpy())

    @cached_property
    def host_kind(self) -> NDArray[np.uint8]:
        """The kinds in main memory, (S, B)."""
        return np.asarray(self.kind.numpy())

    @cached_property
    def kernel_inputs(self) -> dict[str, Any]:
        """The structs that kernels read, by name: a cache that `bayesmap.kernels.match.scan_geometry` fills."""
        return {}

    def select(self, scans: Indices) -> "ScanGeometry":
        """Return a copy of the geometry of N scans by their indices, (N,)."""
        from bayesmap.kernels.match.scan_geometry import select_rows

        return replace(
            self, points=select_rows(self.points, scans), normals=select_rows(self.normals, scans),
            kind=select_rows(self.kind, scans), spread=select_rows(self.spread, scans), fans=self.fans.select(scans),
        )  # fmt: skip

    def points_of(self, scan: int, max_points: int | None = None) -> Floats:
        """Return the points of one scan, (N, 2): all, or at most ``max_points``, evenly spaced by beams."""
        points: Floats = self.host_points[scan][self.host_kind[scan] != NO_POINT].astype(np.float64)
        return points if max_points is None else evenly_spaced(points, max_points)


def scan_geometry(
    scans: Scans, *, farthest_m: float | None = None, device: str = "cpu", threads: int | None = None
) -> ScanGeometry:
    """Compute points and normals of scans, by the scans' own angles and limits. Their poses are not used.
    Neighbouring beams that are closer than `MERGED_RAD` are merged, unless scans have beams of their own. Hits beyond
    ``farthest_m``, by default the largest range, are left out. ``threads`` also holds for matching.
    """
    from bayesmap.kernels.match.scan_geometry import LineFit, points_and_normals

    # Sort the beams by angle, and merge dense ones.
    stated = scans.angles_rad[None] if scans.own_angles_rad is None else scans.own_angles_rad
    order = np.argsort(stated, axis=1, kind="stable")  # NaN, where a scan has no such beam, comes last
    angles = np.take_along_axis(stated, order, axis=1)
    limit = scans.max_range_m if farthest_m is None else min(farthest_m, scans.max_range_m)
    nearest = max(MIN_RANGE_M, scans.min_range_m)
    if scans.own_angles_rad is None:
        ranges, angles, middles = merge_beams(scans.ranges_m[:, order[0]], angles[0], nearest, limit)
    else:
        ranges, middles = np.take_along_axis(scans.ranges_m, order, axis=1), angles
    # Estimate the noise, and compute points and normals with lines that are long enough for this noise.
    ranges = np.ascontiguousarray(ranges)
    fans = Fans.of(middles, len(scans))
    step = float(np.median(fans.step_rad))
    noise = range_noise_m(np.where((ranges > nearest) & (ranges < limit), ranges, np.nan), step)
    fit = LineFit(max(MIN_NORMAL_REACH_M, MIN_NORMAL_REACH_SIGMAS * noise), noise)
    arrays = points_and_normals(ranges, angles, RangeLimits(nearest, limit), fans, fit, device, threads)
    return ScanGeometry(arrays.points, arrays.normals, arrays.kind, arrays.spread, fans, noise, device, threads)


def merge_beams(
    ranges_m: Floats, angles_rad: Floats, nearest_m: float, farthest_m: float, spacing_rad: float = MERGED_RAD
) -> tuple[Floats, Floats, Floats]:
    """Merge groups of neighbouring beams whose spacing is at most half of ``spacing_rad``.

    A group's point lies at the mean angle of the readings on one surface, at their harmonic mean: inverse ranges of a
    straight wall are linear in small angles. Readings on other surfaces than the median reading's are left out, and
    beams after the last whole group. Readings, (S, B), are valid from ``nearest_m`` to ``farthest_m``. Angles of the
    beams ascend, (B,). Returns readings (S, G), their angles (1, G) or (S, G), and the middles of the groups, (1, G).
    """
    step = float(np.median(np.diff(angles_rad))) if len(angles_rad) > 1 else spacing_rad
    size = int(spacing_rad / step + 1e-3) if step > 0.0 else 1  # 1e-3: so that whole ratios stay whole
    if size < 2:
        return ranges_m, angles_rad[None], angles_rad[None]
    groups = len(angles_rad) // size
    readings = ranges_m[:, : groups * size].reshape(-1, groups, size)
    angles = angles_rad[: groups * size].reshape(groups, size)
    valid = (readings > nearest_m) & (readings < farthest_m)  # False for NaN and for either infinity
    # Average the readings of each group that are near its median reading.
    middle = np.maximum(valid.sum(axis=2, keepdims=True) - 1, 0) // 2
    median = np.take_along_axis(np.sort(np.where(valid, readings, np.inf), axis=2), middle, axis=2)
    with np.errstate(invalid="ignore", divide="ignore"):
        used = valid & (np.abs(readings - median) < GAP_M + GAP_STEPS * step * median)
        count = used.sum(axis=2)
        mean = count / np.where(used, 1.0 / readings, 0.0).sum(axis=2)
        angle = np.where(used, angles, 0.0).sum(axis=2) / count
    # A group without a valid reading keeps its first reading, at its middle.
    is_empty = count == 0
    middles = angles.mean(axis=1)[None]
    return np.where(is_empty, readings[..., 0], mean), np.where(is_empty, middles, angle), middles


def range_noise_m(ranges_m: Floats, step_rad: float) -> float:
    """Estimate the standard deviation of ranges (S, B) in the order of angles, between `MIN_NOISE_M` and `MAX_NOISE_M`.

    Along a straight wall the inverse ranges of three neighbouring beams obey 1/r_1 + 1/r_3 = 2 cos(step) / r_2. The
    residual of this equation, times r_2^2, has six times the variance of a range. Its median absolute value is robust
    against corners and edges, which are few.
    """
    sampled = ranges_m[:: max(1, len(ranges_m) // MAX_NOISE_SCANS)]
    before, middle, after = sampled[:, :-2], sampled[:, 1:-1], sampled[:, 2:]
    with np.errstate(invalid="ignore", divide="ignore"):
        gap = GAP_M + GAP_STEPS * step_rad * middle
        smooth = np.isfinite(before + middle + after) & (middle > 0) & (before > 0) & (after > 0)
        smooth &= (np.abs(before - middle) < gap) & (np.abs(after - middle) < gap)
        residual = middle**2 * (1.0 / before + 1.0 / after - 2.0 * np.cos(step_rad) / middle)
    if np.count_nonzero(smooth) < MIN_TRIPLES:
        return MIN_NOISE_M
    sigma = float(np.median(np.abs(residual[smooth]))) / MEDIAN_OF_NORMAL / np.sqrt(6.0)
    return float(np.clip(sigma, MIN_NOISE_M, MAX_NOISE_M))


def _beam_of_angle(angles_rad: Floats, step_rad: float, bins: int) -> NDArray[np.int32]:
    """Return the nearest beam for each bin of angle, (bins,), or -1 where it is more than two steps away."""
    if not len(angles_rad):
        return np.full(bins, -1, dtype=np.int32)
    # Repeat the beams a turn before and after, so that bins next to -pi and pi have neighbours on both sides.
    middles = -np.pi + (np.arange(bins) + 0.5) * 2.0 * np.pi / bins
    repeated_rad = np.concatenate([angles_rad - 2.0 * np.pi, angles_rad, angles_rad + 2.0 * np.pi])
    above = np.clip(np.searchsorted(repeated_rad, middles), 1, len(repeated_rad) - 1)
    nearest = np.where(middles - repeated_rad[above - 1] < repeated_rad[above] - middles, above - 1, above)
    is_far = np.abs(repeated_rad[nearest] - middles) > 2.0 * step_rad
    return np.where(is_far, -1, nearest % len(angles_rad)).astype(np.int32)
