"""What matching needs of scans: points in the laser's frame, normals of the walls that they lie on."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.point_noise import LEAST_M, range_noise_m
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

REACH_M, REACH_SIGMAS = 0.12, 10.0
"""How far to either side of a point its wall's direction is fitted at first, and at least so many standard deviations
of a point: narrower fits let scans slide, and among points that scatter as widely as they are apart there is no
line."""

NEAREST_M = 0.05
"""Readings closer than this are the robot itself."""

PAIR_SIGMAS, SCALE_SIGMAS = 6.0, 3.0
"""Standard deviations of a range: the distance between two points of one wall has the square root of two of them."""

BINS_A_BEAM = 4


@dataclass(frozen=True, eq=False)
class ScanGeometry:
    """Points and normals of S scans of B beams. Arrays on the device are Warp's; beams are in the order of angles.

    Attributes:
        points: (S, B) on the device, where each beam ended, metres in the laser's frame.
        normals: (S, B) on the device, unit normal of the wall there, towards the laser; zero where there is none.
        kind: (S, B) on the device: 0 no point, 1 a point, 2 a point with a normal.
        spread: (S, B) on the device: variance of the normal's angle, per variance of a point, 1 / m^2.
        beam_of_angle: (bins,), the beam nearest to each of equal bins of angle from -pi to pi; -1 where none is near.
        step_rad: the usual angle between neighbouring beams.
        full_circle: whether the last beam's neighbour is the first.
        farthest_m: hits beyond are left out.
        noise_m: standard deviation of a range, found from the scans.
        device: where the arrays are.
    """

    points: Any
    normals: Any
    kind: Any
    spread: Any
    beam_of_angle: NDArray[np.int32]
    step_rad: float
    full_circle: bool
    farthest_m: float
    noise_m: float = LEAST_M
    device: str = "cpu"

    def __len__(self) -> int:
        return int(self.kind.shape[0])

    @property
    def beams(self) -> int:
        """Beams of a scan."""
        return int(self.kind.shape[1])

    def reach_m(self, first_m: float, last_m: float) -> tuple[float, float]:
        """How far paired points may lie apart, at first and at last: no less than the noise sets them apart."""
        least = PAIR_SIGMAS * self.noise_m
        return max(first_m, least), max(last_m, least)

    def scale_m(self, first_m: float, last_m: float) -> tuple[float, float]:
        """Geman and McClure's c, at first and at last: one below the noise would take noise for outliers."""
        least = SCALE_SIGMAS * self.noise_m
        return max(first_m, least), max(last_m, least)

    @cached_property
    def host_points(self) -> NDArray[np.float32]:
        """(S, B, 2) in main memory."""
        return np.asarray(self.points.numpy())

    @cached_property
    def host_normals(self) -> NDArray[np.float32]:
        """(S, B, 2) in main memory."""
        return np.asarray(self.normals.numpy())

    @cached_property
    def host_kind(self) -> NDArray[np.uint8]:
        """(S, B) in main memory."""
        return np.asarray(self.kind.numpy())

    def select(self, scans: NDArray[np.intp]) -> ScanGeometry:
        """Some of the scans, copied."""
        from bayesmap.kernels.scan_geometry import selected

        return replace(
            self, points=selected(self.points, scans), normals=selected(self.normals, scans),
            kind=selected(self.kind, scans), spread=selected(self.spread, scans),
        )  # fmt: skip

    def points_of(self, scan: int, most: int | None = None) -> Floats:
        """The points of one scan, shape (N, 2): all, or about ``most`` of them, evenly spaced by beams."""
        points: Floats = self.host_points[scan][self.host_kind[scan] > 0].astype(np.float64)
        return points if most is None or len(points) <= most else points[_evenly(len(points), most)]


def scan_geometry(
    scans: Scans,
    *,
    farthest_m: float | None = None,
    angles_rad: Floats | None = None,
    device: str = "cpu",
    threads: int | None = None,
) -> ScanGeometry:
    """Points and normals of scans, by the scans' own angles and limits.

    Args:
        scans: their poses are not looked at.
        farthest_m: leave out hits beyond; by default the sensor's largest range.
        angles_rad: other beam angles than the scans', where they have been calibrated, shape (A,).
        device: "cpu" or a CUDA device.
        threads: to compute with; by default all cores.
    """
    from bayesmap.kernels.scan_geometry import points_and_normals

    angles = scans.angles_rad if angles_rad is None else angles_rad
    order = np.argsort(angles, kind="stable")
    angles = np.ascontiguousarray(angles[order])
    step = float(np.median(np.diff(angles))) if len(angles) > 1 else np.pi
    full_circle = len(angles) > 8 and 2.0 * np.pi - (angles[-1] - angles[0]) < 1.9 * step
    limit = scans.max_range_m if farthest_m is None else min(farthest_m, scans.max_range_m)
    ranges = np.ascontiguousarray(scans.ranges_m[:, order])
    nearest = max(NEAREST_M, scans.min_range_m)
    noise = range_noise_m(np.where((ranges > nearest) & (ranges < limit), ranges, np.nan), step)
    reach = max(REACH_M, REACH_SIGMAS * noise)
    arrays = points_and_normals(ranges, angles, nearest, limit, step, full_circle, reach, noise, device, threads)
    return ScanGeometry(*arrays, _beam_of_angle(angles, step), step, full_circle, limit, noise, device)


def _beam_of_angle(angles_rad: Floats, step_rad: float) -> NDArray[np.int32]:
    """The nearest beam for bins of angle; beams further than a few steps away do not count."""
    bins = int(np.clip(np.ceil(2.0 * np.pi / step_rad * BINS_A_BEAM), 360, 1 << 16))
    middles = -np.pi + (np.arange(bins) + 0.5) * 2.0 * np.pi / bins
    around = np.concatenate([angles_rad - 2.0 * np.pi, angles_rad, angles_rad + 2.0 * np.pi])
    after = np.clip(np.searchsorted(around, middles), 1, len(around) - 1)
    nearest = np.where(middles - around[after - 1] < around[after] - middles, after - 1, after)
    beam = nearest % len(angles_rad)
    far = np.abs(around[nearest] - middles) > 2.0 * step_rad
    return np.where(far, -1, beam).astype(np.int32)


def _evenly(count: int, most: int) -> NDArray[np.intp]:
    return np.asarray(np.arange(most) * count // most, dtype=np.intp)
