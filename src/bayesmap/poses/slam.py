"""From scans and raw odometry to a trajectory with covariances: the stages, one after the other."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.alignment import Alignment, Pairs, align, overlapping_pairs, tied_pairs
from bayesmap.poses.calibration import OdometryFit, angle_step_ratio, fit_odometry
from bayesmap.poses.checkpoint import Arrays, Stages, fingerprint
from bayesmap.poses.explain import flag_unexplained
from bayesmap.poses.front_end import Track, follow, grid_half_width
from bayesmap.poses.frozen_odometry import caught_up
from bayesmap.poses.graph import DOUBTFUL_SQ, Factors
from bayesmap.poses.key_graph import (
    close_loops,
    contradicted_links,
    poses_between_keys,
    separate_stretches,
    unconfirmed_links,
)
from bayesmap.poses.log_checks import check_scans
from bayesmap.poses.next_scans import chained
from bayesmap.poses.odometry_factors import chain_factors, corrected_factors
from bayesmap.poses.odometry_motion import stated_motions, variances
from bayesmap.poses.placement import place_scans
from bayesmap.poses.point_errors import point_error, with_point_error
from bayesmap.poses.precision import relative_covariances
from bayesmap.poses.rematch import rematch
from bayesmap.poses.scan_geometry import ScanGeometry, scan_geometry
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

IMPROVEMENTS = 2
"""How often scans are matched anew without themselves."""

MATCH_REACH = 0.8
"""Scans are compared if their sensors are no further apart than this share of the grids' half width."""


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
    check_scans(scans, no_odometry)
    order = np.arange(len(scans))
    if scans.stamps_s is not None:
        timed = time_order(scans.stamps_s)
        order, scans = timed.order, replace(scans.select(timed.order), stamps_s=timed.stamps_s)
    stages = Stages(
        checkpoint,
        fingerprint(
            scans.poses, scans.ranges_m, scans.angles_rad, scans.stamps_s,
            *(() if scans.own_angles_rad is None else (scans.own_angles_rad,)),
            settings=f"3 {no_odometry} {calibrate_angles} {seed} {scans.max_range_m} {scans.min_range_m}",
        ),
    )  # fmt: skip
    run = _Run(scans, no_odometry, threads, device, stages, on_progress or (lambda stage, done, of: None), on_poses)
    return run.trajectory(order, calibrate_angles)


def alternatives_of(closed: Arrays, keys: NDArray[np.intp], poses: Floats) -> tuple[Alternatives, Floats | None]:
    """Return the alternatives to the poses of the keys, (K, 3), and the steps to them for `PoseGaussian.elsewhere`."""
    if not len(closed["probabilities"]):
        return NO_ALTERNATIVES, None
    steps = between(closed["poses"][None], closed["elsewhere"])
    steps[..., 2] = wrapped(steps[..., 2])
    first, last, probabilities = keys[closed["hangs_from"]], keys[closed["hangs_to"]], closed["probabilities"]
    elsewhere = steps * np.sqrt(probabilities)[:, None, None]
    return Alternatives(first, last, probabilities, compose(poses[None], steps)), elsewhere


class _Run:
    """One run: what its stages share."""

    def __init__(
        self,
        scans: Scans,
        no_odometry: bool,
        threads: int | None,
        device: str,
        stages: Stages,
        progress: Progress,
        on_poses: OnPoses | None = None,
    ) -> None:
        self.scans, self.threads, self.device = scans, threads, device
        self.stages, self.progress, self.on_poses = stages, progress, on_poses
        self.motions, self.impossible = stated_motions(scans.poses, scans.stamps_s)
        self.stated = scans.poses
        self.no_odometry = no_odometry
        self.origin = scans.poses[0] if not no_odometry else np.zeros(3)
        self.track: Track | None = None
        self.stretches: NDArray[np.intp] | None = None

    def geometry(self, scans: Scans) -> ScanGeometry:
        return scan_geometry(scans, farthest_m=FARTHEST_M, device=self.device, threads=self.threads)

    def trajectory(self, order: NDArray[np.intp], calibrate_angles: bool) -> Trajectory:
        scans, threads = self.scans, self.threads
        ratio = 1.0
        geometry = self.geometry(scans)
        if not self.no_odometry:
            self.stated = caught_up(scans, geometry, threads)
            self.motions, self.impossible = stated_motions(self.stated, scans.stamps_s)
        self.track = track = self.front_end(geometry)
        self.go_backwards(track.against)
        keys = track.keys
        closed = self.stages.get("loops", lambda: self.loops(geometry, track))
        half_width_m = grid_half_width(geometry)
        reach_m = MATCH_REACH * half_width_m
        believed = closed["weights"] > 0.5
        self.stretches = separate_stretches(track, closed["first"][believed], closed["second"][believed])
        key_geometry = geometry.select(keys)
        poses = closed["poses"]
        first = self.align("aligned", key_geometry, poses, self.first_factors(track, poses), reach_m, 8, wide=True)
        poses = first.poses
        if calibrate_angles:
            found = angle_step_ratio(
                scans.select(keys),
                poses,
                first.pairs.source,
                first.pairs.target,
                farthest_m=FARTHEST_M,
                threads=threads,
            )
            if abs(found - 1.0) > ANGLE_TOLERANCE:
                ratio, poses = found, poses.copy()
                poses[:, 2] -= 0.5 * (ratio - 1.0) * scans.select(keys).sweep_rad
                geometry = self.geometry(scans.stretched(ratio))
                key_geometry = geometry.select(keys)
        fit, factors = self.odometry(first, track)
        second = self.align("aligned-again", key_geometry, poses, factors, reach_m, 8, wide=ratio != 1.0)
        rematch_m = min(half_width_m, 14.0)
        final, scores = self.improve(key_geometry, second, factors, reach_m, rematch_m)
        if not self.no_odometry:
            final, scores = self.without_leaps(key_geometry, final, scores, factors, reach_m, rematch_m)
        start = poses_between_keys(track.poses, keys, final.poses, track.broken)
        error = point_error(key_geometry, final, threads)
        placed = place_scans(geometry, start, keys, final.poses, final.pairs, final.sigma_m, error, threads=threads)
        self.progress("placing", len(scans), len(scans))
        if self.on_poses is not None:
            self.on_poses("placing", compose(self.origin, placed.poses))
        residuals = Factors(
            closed["first"], closed["second"], closed["relative"], np.zeros((len(closed["first"]), 3, 3))
        )
        closures = LoopClosures(
            keys[closed["first"]], keys[closed["second"]], closed["relative"], residuals.errors(final.poses),
            closed["weights"],
        )  # fmt: skip
        explained = placed.matched.copy()
        explained[keys] = scores
        nearest_key = nearest(keys, np.arange(len(scans)))
        breaks = np.nonzero(track.broken)[0][~closed["joined"][1:]]
        leaping = contradicted_links(track, final.poses)
        if not self.no_odometry:
            leaping |= unconfirmed_links(geometry, track, factors, final.poses, threads)
        leaps = keys[1:][leaping]
        gaussian = replace(with_point_error(final, error), poses=compose(self.origin, final.poses))
        alternatives, elsewhere = alternatives_of(closed, keys, gaussian.poses)
        gaussian = replace(gaussian, elsewhere=elsewhere)
        noise = None if fit is None else fit.noise.of_scans(self.motions)
        return Trajectory(
            compose(self.origin, placed.poses), scans.stamps_s, keys, gaussian, nearest_key,
            placed.own_covariance(keys), explained, flag_unexplained(explained, keys), breaks, closures,
            Calibration(ratio, calibrated(scans, ratio).angles_rad, fit, noise, final.sigma_m), order,
            None if fit is None else factors, leaps, alternatives,
        )  # fmt: skip

    def front_end(self, geometry: ScanGeometry) -> Track:
        motions = None if self.no_odometry else self.motions
        count = len(self.scans)
        next_look = 0

        def on_progress(done: int, poses: Floats) -> None:
            nonlocal next_look
            self.progress("front end", done, count)
            if self.on_poses is not None and done >= next_look:
                next_look = done + -(-count // LOOKS)
                stated = self.stated[done - 1 :]
                rest = between(stated[:1], stated[1:]) * (0.0 if self.no_odometry else 1.0)
                known = np.concatenate([poses[:done], compose(poses[done - 1], rest)])
                self.on_poses("front end", compose(self.origin, known))

        def compute() -> Arrays:
            track = follow(
                geometry, motions, self.scans.stamps_s, self.impossible, on_progress=on_progress, threads=self.threads
            )
            return dict(track.__dict__)

        return Track(**self.stages.get("front-end", compute))

    def go_backwards(self, against: NDArray[np.bool_]) -> None:
        """Take motions that scans contradict in their direction the other way round."""
        if not self.no_odometry and against.any():
            self.motions = np.where(against[1:, None], self.motions * [-1.0, -1.0, 1.0], self.motions)
            self.stated = np.vstack([self.stated[:1], chained(self.stated[0], self.motions)])

    def report(self, stage: str, done: int, of: int, key_poses: Floats) -> None:
        """Say how far a stage is, and where all scans are by the present poses of the key scans."""
        self.progress(stage, done, of)
        if self.on_poses is not None and self.track is not None:
            known = poses_between_keys(self.track.poses, self.track.keys, key_poses, self.track.broken)
            self.on_poses(stage, compose(self.origin, known))

    def loops(self, geometry: ScanGeometry, track: Track) -> Arrays:
        closed = close_loops(
            geometry, track, on_progress=lambda done, at: self.report("loops", done, 3, at), threads=self.threads
        )
        return {
            "poses": closed.poses, "first": closed.closures.first, "second": closed.closures.second,
            "relative": closed.closures.relative, "weights": closed.weights, "joined": closed.joined,
            "elsewhere": closed.weighed.alternatives, "probabilities": closed.weighed.probabilities,
            "hangs_from": closed.weighed.first, "hangs_to": closed.weighed.last,
        }  # fmt: skip

    def first_factors(self, track: Track, poses: Floats) -> Factors:
        if self.no_odometry:
            return chain_factors(track, poses)
        return self.corrected(track, poses, track.slope, lambda motions: variances(motions, track.noise_ratios))

    def odometry(self, aligned: Alignment, track: Track) -> tuple[OdometryFit | None, Factors]:
        if self.no_odometry:
            return None, chain_factors(track, aligned.poses)
        order = np.arange(len(track.keys) - 1)
        covariance = relative_covariances(aligned.gaussian.precision, aligned.poses, order, order + 1)
        variance = np.diagonal(covariance, axis1=1, axis2=2)
        fit = fit_odometry(self.stated, self.scans.stamps_s, aligned.poses, track.keys, variance)
        return fit, self.corrected(track, aligned.poses, fit.slope, fit.noise.variances, fit.lag_s)

    def corrected(
        self, track: Track, poses: Floats, slope: Floats, noise: Callable[[Floats], Floats], lag_s: float = 0.0
    ) -> Factors:
        """Odometry between key scans, but where it was refused or the path breaks."""
        return corrected_factors(
            self.stated, self.scans.stamps_s, self.motions, self.impossible | track.broken[1:], track.keys, poses,
            slope, noise, lag_s,
        )  # fmt: skip

    def align(
        self,
        name: str,
        geometry: ScanGeometry,
        poses: Floats,
        factors: Factors,
        reach_m: float,
        rounds: int,
        *,
        wide: bool,
        firm: NDArray[np.bool_] | None = None,
    ) -> Alignment:
        threads = self.threads

        def again(at: Floats) -> Pairs:
            return tied_pairs(overlapping_pairs(geometry, at, reach_m, threads), self.stretches)

        pairs = again(poses)

        spans = {} if wide else {"reach_m": (0.15, 0.08), "scale_m": (0.06, 0.03)}
        return align(
            geometry, poses, factors, pairs, rounds=rounds, firm=firm, reselect=again, threads=threads,
            on_progress=lambda done, at: self.report(name, done, rounds, at), **spans,
        )  # fmt: skip

    def without_leaps(
        self,
        geometry: ScanGeometry,
        aligned: Alignment,
        scores: Floats,
        factors: Factors,
        reach_m: float,
        half_width_m: float,
    ) -> tuple[Alignment, Floats]:
        """Where poses leap over a step on which odometry and front end agree, no wheel has slipped: align once more."""
        assert self.track is not None
        leaps = contradicted_links(self.track, aligned.poses)
        firm = leaps & (factors.squares(self.track.poses[self.track.keys]) < DOUBTFUL_SQ)
        if not firm.any():
            return aligned, scores
        held = self.align("aligned-rematched", geometry, aligned.poses, factors, reach_m, 8, wide=True, firm=firm)
        if contradicted_links(self.track, held.poses).sum() >= leaps.sum():
            return aligned, scores
        again = rematch(geometry, held.poses, held.pairs, half_width_m, search=False, threads=self.threads)
        return held, again.scores

    def improve(
        self, geometry: ScanGeometry, aligned: Alignment, factors: Factors, reach_m: float, half_width_m: float
    ) -> tuple[Alignment, Floats]:
        """Match scans anew, each without itself; those that others explain better elsewhere are moved, and all aligned.

        A scan that its new place and the alignment after it explain worse than before is put back, and stays.
        """
        count = len(aligned.poses)
        poor, old, before = 0.0, aligned.poses, np.zeros(count)
        moved, stays = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        for number in range(IMPROVEMENTS + 1):
            again = rematch(
                geometry, aligned.poses, aligned.pairs, half_width_m, poor_score=poor, search=number < IMPROVEMENTS,
                threads=self.threads,
            )  # fmt: skip
            rematched = np.where(again.moved[:, None], again.best_poses, aligned.poses)
            self.report("rematch", number + 1, IMPROVEMENTS + 1, rematched)
            back = moved & (again.scores < before)
            stays |= back
            moved = again.moved & ~stays
            before = np.where(back, before, again.scores)
            if not (moved | back).any():
                break
            poor = 0.6 * float(np.median(again.best_scores))
            poses = np.where(back[:, None], old, aligned.poses)
            poses = np.where(moved[:, None], again.best_poses, poses)
            old = aligned.poses
            aligned = self.align("aligned-rematched", geometry, poses, factors, reach_m, 6, wide=False)
        return aligned, before
