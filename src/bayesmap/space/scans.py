"""Range scans: poses, beam angles, and readings of four kinds.

`Scans` is the value that log readers make and samplers read. The functions after it check the arrays that users give
and name the faulty scan and beam: `as_poses`, `as_angles`, `check_limits`. `Fan` and `fan` make beam angles.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats, between, compose

MAX_FAN_TURNS = 1.1  # largest angle from the first to the last beam: beams may overlap a little after a whole turn
MAX_BEAMS = 100_000  # most beams per scan


class ReadingKind(IntEnum):
    """The kinds of a beam's reading (REP-117)."""

    HIT = 0
    """A finite range: the beam hit something there."""
    NO_RETURN = 1
    """+inf: nothing came back within the sensor's range. An observation, with its own likelihood."""
    TOO_CLOSE = 2
    """-inf: something nearer than the sensor can measure."""
    INVALID = 3
    """NaN: an erroneous reading, which has no information about the map."""


@dataclass(frozen=True, eq=False)
class Scans:
    """Range scans of one sensor, taken from known poses.

    Attributes:
        poses: sensor poses in the world frame, shape (S, 3): x in metres, y in metres, yaw in radians,
            counter-clockwise from +x. A single pose of shape (3,) is taken as one scan.
        angles_rad: beam angles in the sensor frame, shape (A,). If beams differ from scan to scan, pass shape (S, A),
            with NaN if a scan has fewer beams. The attribute then holds the angles of the largest scan, and
            `own_angles_rad` the angles of each scan.
        ranges_m: readings, shape (S, A) (or (A,) for one scan), coded as in REP-117: +inf is no return, -inf too close,
            NaN invalid. Every finite number is a hit: noise may make it negative, which only log readers refuse.
        max_range_m: the sensor's largest range.
        min_range_m: the sensor's smallest range.
        stamps_s: time of each scan in seconds, shape (S,), or None.
        beam_poses: sensor pose in the world frame for each beam, shape (S, A, 3), if the sensor moves during a sweep;
            None if all beams of a scan leave from the scan's pose.
        own_angles_rad: beam angles of each scan, shape (S, A), NaN if a scan has no such beam; None if all scans have
            the beams ``angles_rad``. `angles_by_scan` and `beams_of` serve both cases.
        mount: pose of the sensor on the robot's base (metres, radians), (3,), the median if it moves, or None.

    Raises `BadInput` for shapes that do not fit together, poses or angles that are not finite, a fan of over a turn, a
    reading without an angle, or a range limit that is not positive. The message names the array, the scan and the beam.
    """

    poses: Floats
    angles_rad: Floats
    ranges_m: Floats
    max_range_m: float
    min_range_m: float = 0.0
    stamps_s: Floats | None = None
    beam_poses: Floats | None = None
    own_angles_rad: Floats | None = None
    mount: Floats | None = None

    def __post_init__(self) -> None:
        # Poses, readings, and the angles of all scans or of each scan.
        poses = as_poses(self.poses)
        ranges = np.atleast_2d(as_array(self.ranges_m, "scans: ranges_m"))
        own = self.own_angles_rad
        if own is None and np.ndim(self.angles_rad) == 2:
            own = self.angles_rad
        if own is None:
            angles = as_angles(self.angles_rad)
        else:
            angles, own = _as_own_angles(self.angles_rad, own, ranges)
        if ranges.shape != (len(poses), len(angles)):
            raise BadInput(
                f"scans: ranges_m has shape {ranges.shape}, but {len(poses)} poses and {len(angles)} angles "
                f"need ({len(poses)}, {len(angles)})"
            )
        check_limits(self.min_range_m, self.max_range_m)
        checked: dict[str, Any] = {
            "poses": poses, "angles_rad": angles, "own_angles_rad": own, "ranges_m": ranges,
            "max_range_m": float(self.max_range_m), "min_range_m": float(self.min_range_m),
        }  # fmt: skip
        # Optional arrays.
        for name, shape in (("stamps_s", (len(poses),)), ("beam_poses", (*ranges.shape, 3))):
            if getattr(self, name) is not None:
                checked[name] = array = as_array(getattr(self, name), f"scans: {name}")
                if array.shape != shape:
                    raise BadInput(f"scans: {name} has shape {array.shape}, expected {shape}")
        stamps, beam_poses = checked.get("stamps_s", np.zeros(0)), checked.get("beam_poses", np.zeros((0, 0, 3)))
        if not np.isfinite(stamps).all():
            scan = np.flatnonzero(~np.isfinite(stamps))[0]
            raise BadInput(
                f"scans: stamp of scan {scan} is not finite: {stamps[scan]}; leave stamps_s out if there are none"
            )
        if not np.isfinite(beam_poses).all():
            scan, beam, _ = np.argwhere(~np.isfinite(beam_poses))[0]
            pose = beam_poses[scan, beam].tolist()
            raise BadInput(f"scans: pose of beam {beam} of scan {scan} is not finite: {pose}")
        if self.mount is not None:
            checked["mount"] = mount = as_array(self.mount, "scans: mount")
            if mount.shape != (3,) or not np.isfinite(mount).all():
                raise BadInput(f"scans: mount must be x and y in metres and yaw in radians, got {mount.tolist()}")
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.poses)

    def __repr__(self) -> str:
        """Return four lines: size, readings, fan and range limits, and path."""
        kinds = ", ".join(f"{count:,} {kind.replace('_', ' ')}" for kind, count in self.counts().items())
        fan = "no beams"
        if self.n_beams:
            low, high = np.degrees([np.nanmin(self.angles_rad), np.nanmax(self.angles_rad)])
            fan = f"{low:.1f} to {high:.1f} degrees"
        return (
            f"Scans: {len(self):,}, {self.n_beams:,} beams\n  readings: {kinds}\n"
            f"  sensor: {fan}, {self.min_range_m:g} to {self.max_range_m:g} m\n"
            f"  path: {path_words(self.poses, self.stamps_s)}"
        )

    @property
    def n_beams(self) -> int:
        """Number of beams, over all scans."""
        return int(self.ranges_m.size if self.own_angles_rad is None else np.isfinite(self.own_angles_rad).sum())

    @property
    def has_beam(self) -> Mask:
        """Mask of the beams that each scan has, shape (S, A)."""
        if self.own_angles_rad is None:
            return np.broadcast_to(np.True_, self.ranges_m.shape)
        return np.isfinite(self.own_angles_rad)

    def angles_by_scan(self) -> Floats:
        """Return beam angles in the sensor frame, (S, A), all finite: missing beams have the largest scan's angles."""
        if self.own_angles_rad is None:
            return np.broadcast_to(self.angles_rad, self.ranges_m.shape)
        return np.where(np.isnan(self.own_angles_rad), self.angles_rad, self.own_angles_rad)

    def beams_of(self, scan: int) -> tuple[Floats, Floats]:
        """Return the angles in radians and the readings in metres of the N beams of one scan, shape (N,) each."""
        if self.own_angles_rad is None:
            return self.angles_rad, self.ranges_m[scan]
        beams = np.isfinite(self.own_angles_rad[scan])
        return self.own_angles_rad[scan, beams], self.ranges_m[scan, beams]

    @property
    def readings(self) -> NDArray[np.uint8]:
        """The kind of every reading, as `ReadingKind`, shape (S, A)."""
        kinds = np.full(self.ranges_m.shape, ReadingKind.HIT, dtype=np.uint8)
        kinds[np.isposinf(self.ranges_m)] = ReadingKind.NO_RETURN
        kinds[np.isneginf(self.ranges_m)] = ReadingKind.TOO_CLOSE
        kinds[np.isnan(self.ranges_m)] = ReadingKind.INVALID
        return kinds

    def counts(self) -> dict[str, int]:
        """Count the readings of each `ReadingKind`, by its name in lower case."""
        kinds = self.readings if self.own_angles_rad is None else self.readings[self.has_beam]
        counts = np.bincount(kinds.ravel(), minlength=len(ReadingKind))
        return {kind.name.lower(): int(counts[kind]) for kind in ReadingKind}

    def beam_angles_world(self) -> Floats:
        """Return the direction of every beam in the world frame, radians, shape (S, A)."""
        yaw = self.poses[:, 2:3] if self.beam_poses is None else self.beam_poses[..., 2]
        return np.asarray(yaw + self.angles_by_scan())

    def beam_starts_world(self) -> Floats:
        """Return the start of every beam, metres in the world frame, shape (S, A, 2)."""
        if self.beam_poses is not None:
            return self.beam_poses[..., :2]
        return np.broadcast_to(self.poses[:, None, :2], (*self.ranges_m.shape, 2))

    def hit_points_world(self) -> Floats:
        """Return the end points of the beams that hit something, metres, shape (H, 2)."""
        angles = self.beam_angles_world()
        hit = np.isfinite(self.ranges_m)
        ends = np.stack([np.cos(angles[hit]), np.sin(angles[hit])], axis=-1) * self.ranges_m[hit][:, None]
        return np.asarray(self.beam_starts_world()[hit] + ends)

    def select(self, scans: Indices | Mask | slice) -> "Scans":
        """Return the scans at the given indices, mask or slice."""
        names = ("poses", "ranges_m", "stamps_s", "beam_poses", "own_angles_rad")
        arrays = {name: getattr(self, name) for name in names}
        return replace(self, **{name: array[scans] for name, array in arrays.items() if array is not None})

    def stretched(self, ratio: float) -> "Scans":
        """Return the scans with all angles between beams multiplied by ``ratio``. First beams keep their angles."""
        angles = self.angles_rad[0] + ratio * (self.angles_rad - self.angles_rad[0])
        own = self.own_angles_rad
        if own is not None:
            first = self._first_and_last()[0][:, None]
            own = first + ratio * (own - first)
        return replace(self, angles_rad=angles, own_angles_rad=own)

    @property
    def sweep_rad(self) -> Floats:
        """The angle from the first to the last beam of each scan, (S,) or one for all, ()."""
        if self.own_angles_rad is None:
            return np.asarray(self.angles_rad[-1] - self.angles_rad[0])
        first, last = self._first_and_last()
        return last - first

    @property
    def steps_rad(self) -> Floats:
        """The angle from each beam to the next, (A - 1,), or (S, A - 1) with NaN for missing beams."""
        return np.diff(self.angles_rad if self.own_angles_rad is None else self.own_angles_rad, axis=-1)

    def _first_and_last(self) -> tuple[Floats, Floats]:
        """Return the angles of the first and last beam of each scan, (S,) each, or 0 for a scan without beams."""
        has_beam, scans = self.has_beam, np.arange(len(self))
        first, last = has_beam.argmax(axis=1), has_beam.shape[1] - 1 - has_beam[:, ::-1].argmax(axis=1)
        angles = np.nan_to_num(np.asarray(self.own_angles_rad))
        return angles[scans, first], angles[scans, last]

    def at(self, poses_world: ArrayLike) -> "Scans":
        """Return the readings at other poses, (S, 3). Beams move with their scans. Raises `BadInput` as `as_poses`."""
        poses = as_poses(poses_world)
        if poses.shape != self.poses.shape:
            raise BadInput(f"scans: poses has shape {poses.shape}, expected {self.poses.shape}")
        if self.beam_poses is None:
            return replace(self, poses=poses)
        relative = between(self.poses[:, None], self.beam_poses)
        return replace(self, poses=poses, beam_poses=compose(poses[:, None], relative))

    def holdout(self, every: int) -> tuple["Scans", "Scans"]:
        """Split into (training, held out) scans: every ``every``-th scan, from ``every // 2`` on, is held out.
        Raises `BadInput` for a number below 2, or so large that no scan is held out.
        """
        if every < 2:
            raise BadInput(f"holdout: hold out every n-th scan with n >= 2, got {every}")
        is_held_out = np.arange(len(self)) % every == every // 2
        if not is_held_out.any():
            raise BadInput(f"holdout: {len(self)} scans are too few to hold out every {every}-th")
        return self.select(~is_held_out), self.select(is_held_out)

    def limited(self, max_range_m: float) -> "Scans":
        """Return the scans as a sensor with a shorter range reads them: hits beyond ``max_range_m`` are no return."""
        if not (math.isfinite(max_range_m) and max_range_m > self.min_range_m):
            raise BadInput(f"scans: max_range_m must exceed min_range_m, got {max_range_m!r}")
        ranges = np.where(self.ranges_m > max_range_m, np.inf, self.ranges_m)
        return replace(self, ranges_m=ranges, max_range_m=max_range_m)


def as_poses(poses: ArrayLike) -> Floats:
    """Return poses as an (S, 3) array. Raises `BadInput` for another shape, or a number that is not finite."""
    array = np.atleast_2d(as_array(poses, "scans: poses"))
    if array.ndim != 2 or array.shape[1] != 3:
        raise BadInput(f"scans: poses has shape {array.shape}, expected (S, 3): x, y, yaw")
    if not np.isfinite(array).all():
        scan = int(np.nonzero(~np.isfinite(array).all(axis=1))[0][0])
        raise BadInput(f"scans: pose of scan {scan} is not finite: {array[scan].tolist()}")
    return array


def as_user_poses(caller: str, poses: ArrayLike) -> Floats:
    """Return poses that a user gave to the function ``caller``, (P, 3). Raises `BadInput` for headings in degrees.
    Headings in radians may add up along a path, so that only a change by over two turns at once is refused.
    """
    array = as_poses(poses)
    too_far = np.flatnonzero(np.abs(np.diff(array[:, 2], prepend=0.0)) > 4 * math.pi)
    if len(too_far):
        raise BadInput(
            f"{caller}: heading of pose {too_far[0]} is {array[too_far[0], 2]:g} radians, two turns or more away; "
            "headings must be in radians: are these degrees?"
        )
    return array


def check_sigma_rad(caller: str, sigma_rad: float) -> None:
    """Raise `BadInput` for a standard deviation of a heading over half a turn."""
    if sigma_rad > math.pi:
        raise BadInput(f"{caller}: sigma_rad is over half a turn: {sigma_rad:g} radians; are these degrees?")


def path_words(poses: Floats, stamps_s: Floats | None) -> str:
    """Return the length of a path, and its duration if there are stamps, in words."""
    words = f"{np.hypot(*np.diff(poses[:, :2], axis=0).T).sum():,.1f} m"
    return words if stamps_s is None or not len(stamps_s) else f"{words} in {np.ptp(stamps_s):,.1f} s"


def as_angles(angles_rad: ArrayLike) -> Floats:
    """Return beam angles as an (A,) array. Raises `BadInput` for another shape, no angle, or one that is not finite."""
    array = np.atleast_1d(as_array(angles_rad, "scans: angles_rad"))
    if array.ndim != 1 or len(array) == 0:
        raise BadInput(f"scans: angles_rad has shape {array.shape}, expected (A,) with at least one beam")
    if not np.isfinite(array).all():
        beam = int(np.nonzero(~np.isfinite(array))[0][0])
        raise BadInput(f"scans: angle of beam {beam} is not finite: {array[beam]}")
    if (fault := fan_fault(float(array.min()), float(array.max()))) is not None:
        raise BadInput(f"scans: angles_rad: {fault}")
    return array


def _as_own_angles(largest: ArrayLike, own: ArrayLike, ranges_m: Floats) -> tuple[Floats, Floats | None]:
    """Return angles of the largest scan, (A,), ``largest`` if it fits, and of all, (S, A), or None if all are equal."""
    # Check shapes and angles: a missing beam has the angle NaN and the reading NaN.
    angles = as_array(own, "scans: angles_rad")
    if angles.shape != ranges_m.shape or not angles.shape[1]:
        expected = f"(A,) or that of ranges_m, {ranges_m.shape}"
        raise BadInput(f"scans: angles_rad has shape {angles.shape}, expected {expected}")
    missing = np.isnan(angles)
    if np.isinf(angles).any() or (missing & ~np.isnan(ranges_m)).any():
        scan, beam = np.argwhere(np.isinf(angles) | (missing & ~np.isnan(ranges_m)))[0]
        raise BadInput(
            f"scans: angle of beam {beam} of scan {scan} is {angles[scan, beam]}, but its reading is "
            f"{ranges_m[scan, beam]}; a beam that a scan does not have has the angle NaN and the reading NaN"
        )
    lowest, highest = np.where(missing, np.inf, angles).min(axis=1), np.where(missing, -np.inf, angles).max(axis=1)
    for scan in np.flatnonzero((highest - lowest > math.tau) | (lowest > math.tau) | (highest < -math.tau)):
        fault = fan_fault(float(lowest[scan]), float(highest[scan])) if lowest[scan] <= highest[scan] else None
        if fault is not None:
            raise BadInput(f"scans: angles_rad of scan {scan}: {fault}")
    if len(angles) and not missing.any() and (angles == angles[:1]).all():
        return angles[0].copy(), None
    if np.shape(largest) == angles.shape[1:]:
        return as_array(largest, "scans: angles_rad"), angles
    # Select the scan with most beams, and repeat its last angle for beams that it does not have.
    selected = angles[int((~missing).sum(axis=1).argmax())] if len(angles) else np.zeros(angles.shape[1])
    selected = selected[np.isfinite(selected)] if np.isfinite(selected).any() else np.zeros(1)
    return np.append(selected, np.full(angles.shape[1] - len(selected), selected[-1])), angles


@dataclass(frozen=True)
class Fan:
    """The beams of a scan at equal angles from one to the next."""

    beams: int  # number of beams
    first_rad: float  # angle of the first beam in the sensor's frame
    step_rad: float  # angle from each beam to the next

    def angles_rad(self) -> Floats:
        """Return the angle of each beam, (A,)."""
        return np.asarray(self.first_rad + self.step_rad * np.arange(self.beams))

    def __str__(self) -> str:
        first, step = math.degrees(self.first_rad), math.degrees(self.step_rad)
        return f"{self.beams} beams {step:.4g} degrees apart from {first:.4g}"


def side_by_side(angles_rad: Sequence[Floats], readings_m: Sequence[NDArray[np.floating]]) -> tuple[Floats, Floats]:
    """Return the angles and the readings of S scans as arrays, (S, A) each. Shorter scans are padded with NaN."""
    shape = len(readings_m), max((len(row) for row in readings_m), default=0)
    angles, readings = np.full((2, *shape), np.nan)
    with np.errstate(invalid="ignore"):  # readings may hold signalling NaN
        for scan, (own, row) in enumerate(zip(angles_rad, readings_m, strict=True)):
            angles[scan, : len(own)], readings[scan, : len(row)] = own, row
    return angles, readings


def fan_fault(lowest_rad: float, highest_rad: float) -> str | None:
    """Return in words why angles are impossible: over `MAX_FAN_TURNS` in span, or from straight ahead; else None."""
    turns = (highest_rad - lowest_rad) / (2 * math.pi)
    away_rad = 0.0 if lowest_rad <= 0 <= highest_rad else min(abs(lowest_rad), abs(highest_rad))
    if turns <= MAX_FAN_TURNS and away_rad <= 2 * math.pi * MAX_FAN_TURNS:
        return None
    return (
        f"its beams point from {lowest_rad:g} to {highest_rad:g} radians, "
        + (f"{turns:.3g} turns" if turns > MAX_FAN_TURNS else "over a turn away from straight ahead")
        + "; angles must be in radians: are these degrees?"
    )


def check_limits(min_range_m: float, max_range_m: float) -> None:
    """Raise `BadInput` for a largest range that is not positive, or a smallest that is negative or not below it."""
    if not (math.isfinite(max_range_m) and max_range_m > 0):
        raise BadInput(f"scans: max_range_m must be a positive number of metres, got {max_range_m!r}")
    if not (math.isfinite(min_range_m) and 0 <= min_range_m < max_range_m):
        raise BadInput(f"scans: min_range_m must lie in [0, {max_range_m:g}), got {min_range_m!r}")


def as_array(values: ArrayLike, name: str) -> Floats:
    """Return an array of numbers of any shape. Raises `BadInput` for anything else."""
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise BadInput(f"{name} must be an array of numbers: {error}") from None


def fan(beams: int, fov_deg: float) -> Floats:
    """Return beam angles in the sensor frame, radians, (beams,), from the right end of the field of view to the left.
    An odd number of beams has one at each end, as in lasers of 181 or 361 beams. An even number leaves out the last, as
    in lasers of 180 or 360 beams. A full circle starts straight ahead. Raises `BadInput` for fewer than two beams, more
    than `MAX_BEAMS`, or a field of view outside (0, 360] degrees.
    """
    if not 2 <= beams <= MAX_BEAMS:
        raise BadInput(f"angles: give 2 to {MAX_BEAMS:,} beams a scan, got {beams}")
    if not 0 < fov_deg <= 360:
        raise BadInput(f"fov: the field of view must lie in (0, 360] degrees, got {fov_deg:g}")
    if fov_deg == 360:
        return np.asarray(np.arange(beams) * 2 * math.pi / beams)
    step = fov_deg / (beams - beams % 2)
    return np.asarray(np.radians(step * np.arange(beams) - fov_deg / 2))
