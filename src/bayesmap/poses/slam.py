"""From scans and raw odometry to a trajectory with covariances: the stages, one after the other."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.alignment import point_error, with_point_error
from bayesmap.poses.calibration import angle_step_ratio
from bayesmap.poses.front_end import Track, follow, grid_half_width
from bayesmap.poses.key_alignment import KeyAlignment, flag_unexplained
from bayesmap.poses.key_graph import ClosedGraph, close_loops, contradicted_links, poses_between_keys, unconfirmed_links
from bayesmap.poses.log_checks import check_scans
from bayesmap.poses.odometry_factors import StatedOdometry, stated_odometry
from bayesmap.poses.placement import place_scans
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.stages import Stages, fingerprint
from bayesmap.poses.trajectory import NO_ALTERNATIVES, Alternatives, Calibration, LoopClosures, Trajectory, calibrated
from bayesmap.space.planar import between, compose, nearest, wrapped
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import time_order

Floats = NDArray[np.float64]
Progress = Callable[[str, int, int], None]
OnPoses = Callable[[str, Floats], None]

FARTHEST_M = 30.0
"""Hits beyond are not matched: beams are then half a metre apart and more."""

ANGLE_TOLERANCE = 0.003
"""A smaller relative error of the angle between beams is not corrected: over half a circle it turns by 0.3 degrees."""

LOOKS = 60
"""How often the front end says where the robot is, at most."""


def infer_trajectory(
    scans: Scans,
    *,
    no_odometry: bool = False,
    calibrate_angles: bool = True,
    seed: int = 0,
    threads: int | None = None,
    device: str = "cpu",
    checkpoint: str | os.PathLike[str] | None = None,
    on_progress: Progress | None = None,
    on_poses: OnPoses | None = None,
) -> Trajectory:
    """Infer where a robot was from its scans and its raw odometry.

    Args:
        scans: S scans whose poses are raw odometry (of the laser). Stamps may come in bursts or out of order: scans
            are taken in the order of time, or of the log where its clock was set back (`bayesmap.space.time_order`).
        no_odometry: do not look at the poses; the scans must come at 5 Hz or so.
        calibrate_angles: find the angle between beams, too, rather than to believe what the log states.
        seed: of whatever is random; the result is the same for any number of threads.
        threads: to compute with; by default all cores.
        device: "cpu" or a CUDA device.
        checkpoint: a folder for finished stages: a run that is interrupted and started again on the same scans goes on.
        on_progress: called as (stage, done, of).
        on_poses: called as (stage, poses) now and then in the front end, and after each round of every other stage
            that is not taken from the checkpoint: where all scans are as far as is known, (S, 3), in the order of time
            and the frame of `Trajectory.poses`. Scans that the front end has not come to go on by odometry. What it
            raises ends the inference.

    Raises:
        BadInput: fewer than two scans, scans without a single hit, odometry that stands still all the time although
            the robot moves, or no odometry and too few scans a second.
    """
    # Scans in the order of time, and the motions that odometry states from one to the next.
    check_scans(scans, no_odometry)
    order, scans = in_order_of_time(scans)
    stages = Stages(checkpoint, _digest(scans, f"3 {no_odometry} {calibrate_angles} {seed}"))
    report = _Report(np.zeros(3) if no_odometry else scans.poses[0], on_progress, on_poses)
    geometry = scan_geometry(scans, farthest_m=FARTHEST_M, device=device, threads=threads)
    odometry = stated_odometry(scans, None if no_odometry else geometry, threads)

    # The front end matches every scan to those before it, and says which motions are stated the wrong way round.
    def match_all() -> Track:
        told = report.of_front_end(odometry)
        return follow(
            geometry, odometry.used_motions, odometry.stamps_s, odometry.impossible, on_progress=told, threads=threads
        )

    track = stages.get("front-end", Track, match_all)
    odometry = odometry.reversed_at(track.against)
    keys = track.keys

    # Loops between key scans are closed.
    def find_loops() -> ClosedGraph:
        told = report.of_keys(track, "loops", 3)
        return close_loops(geometry, track, on_progress=told, threads=threads)

    closed = stages.get("loops", ClosedGraph, find_loops)

    # Key scans are aligned with all others that see the same walls.
    half_width_m = grid_half_width(geometry)
    alignment = KeyAlignment(geometry.select(keys), track, half_width_m, report.of_keys, threads)
    first = alignment.align("aligned", closed.poses, odometry.first_factors(track, closed.poses), wide=True)

    # Laser and odometry are calibrated, and key scans aligned once more.
    poses, ratio = first.poses, 1.0
    if calibrate_angles:
        ratio = _angle_ratio(scans.select(keys), poses, first.pairs.source, first.pairs.target, threads)
    if ratio != 1.0:
        poses = poses.copy()  # beams are stretched from the first on: the middle one keeps its direction
        poses[:, 2] -= 0.5 * (ratio - 1.0) * scans.select(keys).sweep_rad
        geometry = scan_geometry(scans.stretched(ratio), farthest_m=FARTHEST_M, device=device, threads=threads)
        alignment = replace(alignment, geometry=geometry.select(keys))
    fit, factors = odometry.fitted(track, first)
    second = alignment.align("aligned-again", poses, factors, wide=ratio != 1.0)

    # Every key scan is matched anew without itself, and moved where the others explain it better.
    matched = alignment.improved(second, factors)
    if odometry.used:
        matched = alignment.without_leaps(matched, factors)
    final = matched.alignment

    # The other scans are placed between the key scans.
    start = poses_between_keys(track.poses, keys, final.poses, track.broken)
    error = point_error(alignment.geometry, final, threads)
    placed = place_scans(geometry, start, keys, final.poses, final.pairs, final.sigma_m, error, threads=threads)
    report.told("placing", len(scans), len(scans), placed.poses)

    # What is known, how well, and what is doubtful.
    leaping = contradicted_links(track, final.poses)
    if odometry.used:
        leaping |= unconfirmed_links(geometry, track, factors, final.poses, threads)
    gaussian = replace(with_point_error(final, error), poses=compose(report.origin, final.poses))
    alternatives, elsewhere = alternatives_of(closed, keys, gaussian.poses)
    explained = placed.matched.copy()
    explained[keys] = matched.scores
    noise = None if fit is None else fit.noise.of_scans(odometry.motions)
    return Trajectory(
        compose(report.origin, placed.poses),
        scans.stamps_s,
        keys,
        replace(gaussian, elsewhere=elsewhere),
        nearest_key=nearest(keys, np.arange(len(scans))),
        own_covariance=placed.own_covariance(keys),
        explained=explained,
        flagged=flag_unexplained(explained, keys),
        breaks=np.nonzero(track.broken)[0][~closed.joined[1:]],
        closures=_closures(closed, keys, final.poses),
        calibration=Calibration(ratio, calibrated(scans, ratio).angles_rad, fit, noise, final.sigma_m),
        order=order,
        odometry=None if fit is None else factors,
        leaps=keys[1:][leaping],
        alternatives=alternatives,
    )


def in_order_of_time(scans: Scans) -> tuple[NDArray[np.intp], Scans]:
    """Return where each scan of the order of time stands in the log, (S,), and the scans in that order."""
    if scans.stamps_s is None:
        return np.arange(len(scans)), scans
    timed = time_order(scans.stamps_s)
    return timed.order, replace(scans.select(timed.order), stamps_s=timed.stamps_s)


def alternatives_of(closed: ClosedGraph, keys: NDArray[np.intp], poses: Floats) -> tuple[Alternatives, Floats | None]:
    """Return the alternatives to the poses of the keys, (K, 3), and the steps to them for `PoseGaussian.elsewhere`."""
    weighed = closed.weighed
    if not len(weighed.probabilities):
        return NO_ALTERNATIVES, None
    steps = between(closed.poses[None], weighed.alternatives)
    steps[..., 2] = wrapped(steps[..., 2])
    first, last, probabilities = keys[weighed.first], keys[weighed.last], weighed.probabilities
    elsewhere = steps * np.sqrt(probabilities)[:, None, None]
    return Alternatives(first, last, probabilities, compose(poses[None], steps)), elsewhere


def _digest(scans: Scans, settings: str) -> str:
    own = () if scans.own_angles_rad is None else (scans.own_angles_rad,)
    limits = f"{scans.max_range_m} {scans.min_range_m}"
    return fingerprint(
        scans.poses, scans.ranges_m, scans.angles_rad, scans.stamps_s, *own, settings=f"{settings} {limits}"
    )


def _angle_ratio(scans: Scans, poses: Floats, first: NDArray[Any], second: NDArray[Any], threads: int | None) -> float:
    """Return the angle between beams by the stated one; 1 where the difference is too small to matter."""
    found = angle_step_ratio(scans, poses, first, second, farthest_m=FARTHEST_M, threads=threads)
    return found if abs(found - 1.0) > ANGLE_TOLERANCE else 1.0


def _closures(closed: ClosedGraph, keys: NDArray[np.intp], poses: Floats) -> LoopClosures:
    """Return the loop closures with what the final poses of the keys, (K, 3), differ from them."""
    found = closed.closures
    residuals = found.factors().errors(poses)
    return LoopClosures(keys[found.first], keys[found.second], found.relative, residuals, closed.weights)


@dataclass(frozen=True, eq=False)
class _Report:
    """Tells how far a stage is, and where all scans are: poses in the frame of the first scan, told in the map's.

    Attributes:
        origin: the first scan's pose in the map, (3,).
        on_progress: as for `infer_trajectory`.
        on_poses: likewise.
    """

    origin: Floats
    on_progress: Progress | None
    on_poses: OnPoses | None

    def told(self, stage: str, done: int, of: int, poses: Floats | Callable[[], Floats]) -> None:
        if self.on_progress is not None:
            self.on_progress(stage, done, of)
        if self.on_poses is not None:
            self.on_poses(stage, compose(self.origin, poses() if callable(poses) else poses))

    def of_keys(self, track: Track, stage: str, rounds: int) -> Callable[[int, Floats], None]:
        """Return what a stage calls with the number of rounds that are done and the poses of the keys, (K, 3)."""

        def told(done: int, at: Floats) -> None:
            self.told(stage, done, rounds, lambda: poses_between_keys(track.poses, track.keys, at, track.broken))

        return told

    def of_front_end(self, odometry: StatedOdometry) -> Callable[[int, Floats], None]:
        """Return what the front end calls with the number of scans that are done and the poses, (S, 3)."""
        count, next_look = len(odometry.poses), 0

        def told(done: int, poses: Floats) -> None:
            nonlocal next_look
            if self.on_progress is not None:
                self.on_progress("front end", done, count)
            if self.on_poses is not None and done >= next_look:
                next_look = done + -(-count // LOOKS)
                stated = odometry.poses[done - 1 :]
                rest = between(stated[:1], stated[1:]) * (1.0 if odometry.used else 0.0)
                known = np.concatenate([poses[:done], compose(poses[done - 1], rest)])
                self.on_poses("front end", compose(self.origin, known))

        return told
