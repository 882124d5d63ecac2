"""The front end: every scan is matched to the latest key scans, in the order of time.

Scans that lie close together are matched to the same key scans at once (`bayesmap.poses.next_scans`). The first scan
that has moved far enough, or that the key scans do not explain, becomes a key scan. Later scans are matched anew.

A scan may contradict the key scans at every pose that odometry allows. If one of the next scans fits again, somebody
walked by, and the scan gets odometry's pose. If none fits, odometry was wrong, or the robot was carried. The path then
breaks, and later scans are matched only to scans after the break. `bayesmap.poses.rejoin` joins the parts by places
that were seen from both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.calibration import RunningOdometry
from bayesmap.poses.graph import DOUBTFUL_SQ
from bayesmap.poses.matcher import likelihood_grids
from bayesmap.poses.next_scans import (
    PlacedScans,
    WideMatch,
    Window,
    contradicts,
    place_near,
    predict,
    search_widely,
)  # fmt: skip
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, chain_motions, ways_and_turns, wrap_yaw

KEY_DISTANCE_M, KEY_TURN_RAD = 0.4, np.radians(20.0)  # a scan this far from the last key scan becomes a key scan
KEY_SCORE = 0.5  # a scan with a lower score becomes a key scan, too
MIN_KEY_MOTION = 0.05  # least motion along x, y or yaw after which a low score makes a key scan, metres or radians
WINDOW_KEYS = 12  # number of latest key scans that a scan is matched to
MAX_BATCH = 12  # most scans that are matched to them at once
POOR_SCORE, POOR_LOSS = 0.45, 0.25  # a score is poor below the greater of this, and the usual score less that
LOST_SIGMA = np.array([0.5, 0.5, np.radians(30.0)])  # sigmas of a pose beyond which a poor scan is a contradiction
SLIP_LOSS = 0.15  # a wide search may move a scan to a score that is lower than usual by at most this
REMATCH_LOSS = 0.1  # scans this far below the usual score are matched again, from the pose of the scan before
LEARN_LOSS = 0.25  # odometry is not calibrated by a scan whose score is lower than usual by more than this
BACKWARDS_M = 1.0  # longest motion that odometry may have stated with the wrong sign, metres
AHEAD_SCANS, AHEAD_M, AHEAD_RAD = 10, 1.5, np.radians(90.0)  # scans, way and turn in which a fit is sought
UNKNOWN_SIGMA = np.array([1.0, 1.0, np.radians(60.0)])  # standard deviations of an unknown motion
FIRST_SCORE = 0.6  # usual score before the first scan is matched
SCORE_RATE = 0.05  # rate at which the usual score follows the scores of scans


@dataclass(frozen=True, eq=False)
class Track:
    """The result of the front end."""

    poses: Floats  # poses of the laser, (S, 3). The first is the origin.
    information: Floats  # of each pose by the laser, given earlier key scans, in its own frame, (S, 3, 3)
    odometry_variance: Floats  # variance of odometry's motion from the key scan before, x, y and yaw, (S, 3)
    scores: Floats  # fit of each scan to the key scans, from 0 to 1, (S,); 1 for the first
    keys: NDArray[np.intp]  # indices of the key scans, ascending
    broken: NDArray[np.bool_]  # scans that begin a new part of the path: nothing confirms the motion before them, (S,)
    is_reversed: NDArray[np.bool_]  # scans before which the robot moved opposite to odometry, (S,)
    slope: Floats  # correction of odometry's systematic error, (3, 3)
    noise_ratios: Floats  # odometry's noise as a multiple of an ordinary robot's, position and heading, (2,)


def track_scans(
    geometry: ScanGeometry, motions: Floats | None, stamps_s: Floats | None,
    impossible: NDArray[np.bool_] | None = None, on_progress: Callable[[int, Floats], None] | None = None,
) -> Track:  # fmt: skip
    """Match every scan to earlier key scans.

    ``motions`` are odometry's from scan to scan in the earlier one's frame, (S - 1, 3); if None, each is predicted from
    the one before by the stamps, (S,). Motions of the mask ``impossible``, (S - 1,), are taken to be unknown.
    ``on_progress`` is called with the number of matched scans and the poses, (S, 3), zero for the other scans. The
    array changes afterwards, so a caller that keeps it must copy it.
    """
    path = _Path(geometry, motions, stamps_s, impossible)
    while path.last < len(geometry) - 1:
        path.advance()
        if on_progress is not None:
            on_progress(path.last + 1, path.poses)
    return Track(
        path.poses, path.information, path.odometry_variance, path.scores, np.array(path.keys), path.broken,
        path.is_reversed, path.odometry.slope, path.odometry.ratios,
    )  # fmt: skip


class _Path:
    """The path up to scan ``last``, the last one with a pose. ``keys[part_begin]`` begins the present part."""

    def __init__(
        self, geometry: ScanGeometry, motions: Floats | None, stamps_s: Floats | None,
        impossible: NDArray[np.bool_] | None,
    ) -> None:  # fmt: skip
        count = len(geometry)
        self.geometry, self.stamps_s = geometry, stamps_s
        self.half_width_m = grid_half_width(geometry)
        self.unknown = np.zeros(max(count - 1, 0), np.bool_)
        if motions is not None and impossible is not None:
            motions, self.unknown = np.where(impossible[:, None], 0.0, motions), impossible
        self.motions = motions
        self.odometry = RunningOdometry()
        self.poses, self.information = np.zeros((count, 3)), np.zeros((count, 3, 3))
        self.odometry_variance, self.scores = np.zeros((count, 3)), np.ones(count)
        self.broken, self.is_reversed = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        self.last, self.keys, self.part_begin = 0, [0], 0
        self.usual_score = FIRST_SCORE
        self.variance_since_key = np.zeros(3)  # odometry's
        self.pose_variance = np.zeros(3)  # of the last scan
        self.usual_since_key = True  # whether all motions since the last key scan were usual
        self.window = self._latest_window(None)

    def advance(self) -> None:
        """Set the poses of the next scans, of at least one."""
        if self.window.keys[0] != self.keys[-1]:
            self.window = self._latest_window(self.window)
        batch = self._batch()
        # Break the path over an unknown motion.
        if self.unknown[self.last]:
            scan, placed = self.last + 1, self._place_near(batch[:1])[0]
            self._break(scan, placed, self._search(scan, placed.predicted[0], placed.scores[0]))
            return
        # Match the scans up to the next unknown motion; look further ahead if the first contradicts the key scans.
        breaks = np.nonzero(self.unknown[self.last : int(batch[-1])])[0]
        batch = batch[: int(breaks[0]) if len(breaks) else len(batch)]
        placed, wrong = self._place_near(batch)
        if wrong[0] and self.motions is not None:
            batch = self._scans_ahead()
            placed, wrong = self._place_near(batch)
        # Move a scan that slipped, accept scans, leave out an exception, or break the path.
        scan, match = int(batch[0]), None
        may_slip = self.motions is not None and placed.scores[0] <= self.usual_score - SLIP_LOSS
        if wrong.all() or (may_slip and not wrong[0]):
            match = self._search(scan, placed.predicted[0], placed.scores[0])
        if match is not None and self._accept_slip(scan, placed, match):
            return
        if not wrong[0]:
            self._accept(batch, placed, int(np.argmax(wrong)) if wrong.any() else len(batch))
        elif not wrong.all():
            self._leave_out(batch, placed, int(np.argmin(wrong)))
        else:
            self._break(scan, placed, match)

    def _accept(self, batch: NDArray[np.intp], placed: PlacedScans, count: int) -> None:
        """Accept the first ``count`` scans of a batch, up to one that becomes a key scan."""
        for k in range(count):
            if k and placed.scores[k] < self.usual_score - REMATCH_LOSS:
                break
            scan = int(batch[k])
            self._store(scan, placed, k)
            motion = between(self.poses[self.keys[-1]], self.poses[scan])
            is_far = np.hypot(motion[0], motion[1]) > KEY_DISTANCE_M or abs(motion[2]) > KEY_TURN_RAD
            if is_far or (placed.scores[k] < KEY_SCORE and np.abs(motion).max() > MIN_KEY_MOTION):
                self._add_key(scan)
                break

    def _leave_out(self, batch: NDArray[np.intp], placed: PlacedScans, next_fit: int) -> None:
        """Give odometry's poses to the scans before number ``next_fit`` of the batch, which becomes a key scan."""
        for k in range(next_fit + 1):
            self._store(int(batch[k]), placed, k)
        skipped = batch[:next_fit]
        self.information[skipped] = 0.0
        self.poses[skipped] = placed.predicted[:next_fit]
        self._add_key(int(batch[next_fit]))

    def _accept_slip(self, scan: int, placed: PlacedScans, match: WideMatch) -> bool:
        """Accept a near pose if the scan fits there as usual: wheels slipped. Returns whether it is accepted. A pose
        counts as near if the wide search says so, or if the noise of odometry allows it.
        """
        off = wrap_yaw(between(placed.predicted[0], match.pose))
        allowed = float((off**2 / placed.variance[0]).sum()) < DOUBTFUL_SQ
        if not (match.near or allowed) or match.score < self.usual_score - SLIP_LOSS:
            return False
        if contradicts(self.geometry, self.window, scan, match.pose):
            return False
        self.poses[scan], self.information[scan], self.scores[scan] = match.pose, match.information, match.score
        self.odometry_variance[scan] = self.variance_since_key + placed.variance[0] + UNKNOWN_SIGMA**2
        self.last, self.usual_since_key = scan, False
        self._add_key(scan)
        return True

    def _break(self, scan: int, placed: PlacedScans, match: WideMatch | None) -> None:
        """Break the path before an unconfirmed scan, and go on from the pose of a wide search, or of odometry. The
        break moves back over scans just before it that are badly explained, too.
        """
        pose, score, begin = placed.predicted[0], float(placed.scores[0]), scan
        while begin - 1 > self.keys[self.part_begin] and self.scores[begin - 1] < self._poor_score():
            begin -= 1
        if begin < scan:
            if self.keys[-1] >= begin:
                self.keys = [key for key in self.keys if key < begin]
                self.window = self._latest_window(self.window)
            pose, score = self.poses[begin], float(self.scores[begin])
            match = self._search(begin, pose, score)
        self.poses[begin], self.scores[begin] = (pose, score) if match is None else (match.pose, match.score)
        self.information[begin], self.last = 0.0, begin
        self.odometry_variance[begin] = self.variance_since_key + placed.variance[0] + UNKNOWN_SIGMA**2
        self.broken[begin] = True
        self._add_key(begin)
        self.part_begin = len(self.keys) - 1

    def _search(self, scan: int, pose: Floats, score: float) -> WideMatch | None:
        """Search wide windows about a pose for a pose with a clearly better score."""
        return search_widely(self.geometry, self.window, scan, pose, float(score))

    def _poor_score(self) -> float:
        """Return the score below which a scan is badly explained."""
        return max(POOR_SCORE, self.usual_score - POOR_LOSS)

    def _store(self, scan: int, placed: PlacedScans, k: int) -> None:
        """Store the pose of scan number ``k`` of a batch, and learn odometry's noise from its motion."""
        self.poses[scan], self.information[scan] = placed.poses[k], placed.information[k]
        self.scores[scan], self.is_reversed[scan] = placed.scores[k], placed.is_reversed[k]
        score = float(placed.scores[k])
        variance_before = placed.variance[k - 1] if k else 0.0
        self.variance_since_key = self.variance_since_key + placed.variance[k] - variance_before
        self.odometry_variance[scan] = self.variance_since_key
        if self.motions is not None:
            self.pose_variance = _posterior_variance(placed, k)
            if score > max(KEY_SCORE, self.usual_score - LEARN_LOSS) and not placed.is_reversed[k]:
                matched = between(self.poses[scan - 1], self.poses[scan])
                self.odometry.learn_noise(self.motions[scan - 1], matched, self.pose_variance + 1e-5)
            else:
                self.usual_since_key = False
        self.usual_score += SCORE_RATE * (score - self.usual_score)
        self.last = scan

    def _add_key(self, scan: int) -> None:
        """Make a scan a key scan, and learn odometry's systematic error from the way to it."""
        if self.motions is not None and self.usual_since_key and not self.broken[scan]:
            before = self.keys[-1]
            stated = chain_motions(np.zeros(3), self.motions[before:scan])[-1]
            matched = between(self.poses[before], self.poses[scan])
            self.odometry.learn_slope(stated, matched, self.pose_variance + 1e-5)
        self.usual_since_key = True
        self.keys.append(scan)
        self.variance_since_key = np.zeros(3)

    def _place_near(self, scans: NDArray[np.intp]) -> tuple[PlacedScans, NDArray[np.bool_]]:
        """Place the next scans near odometry's poses. Returns them, and the mask of those that contradict the keys."""
        here, span = self.poses[self.last], slice(self.last, int(scans[-1]))
        predicted, variance = predict(self.poses, self.last, len(scans), self.motions, self.stamps_s, self.odometry)
        backwards = None
        if self.motions is not None and np.hypot(*self.motions[span, :2].sum(axis=0)) < BACKWARDS_M:
            backwards = chain_motions(here, self.odometry.corrected(self.motions[span]) * [-1.0, -1.0, 1.0])
        placed = place_near(self.geometry, self.window, scans, predicted, variance, backwards, self.usual_score)
        wrong = placed.scores < self._poor_score()
        for k in np.nonzero(wrong)[0]:
            wrong[k] = self._is_doubtful(int(scans[k]), placed, int(k))
        return placed, wrong

    def _is_doubtful(self, scan: int, placed: PlacedScans, k: int) -> bool:
        """Return whether a badly explained scan contradicts the key scans, fits far away, or has an uncertain pose. If
        the scan fits clearly better near by, ``placed`` gets that pose.
        """
        if contradicts(self.geometry, self.window, scan, placed.poses[k]):
            return True
        if (np.sqrt(_posterior_variance(placed, k)) > LOST_SIGMA).any():
            return True
        match = self._search(scan, placed.predicted[k], placed.scores[k])
        if match is not None and match.near:
            placed.poses[k], placed.information[k], placed.scores[k] = match.pose, match.information, match.score
        return match is not None and not match.near

    def _batch(self) -> NDArray[np.intp]:
        """Return the scans to match next: those that odometry predicts near the last key scan, and one more."""
        if self.motions is None:
            return np.array([self.last + 1])
        end = min(self.last + MAX_BATCH, len(self.poses) - 1)
        ways, turns = np.cumsum(ways_and_turns(self.motions[self.last : end]), axis=1)
        off = between(self.poses[self.keys[-1]], self.poses[self.last])
        near = (ways < KEY_DISTANCE_M - np.hypot(off[0], off[1])) & (turns < KEY_TURN_RAD - abs(off[2]))
        count = int(np.argmin(near) if not near.all() else len(near) - 1)
        return np.arange(self.last + 1, self.last + 2 + count)

    def _scans_ahead(self) -> NDArray[np.intp]:
        """Return the scans in which a fit is sought after a contradiction: at most `AHEAD_SCANS`, none over a break."""
        assert self.motions is not None
        motions = self.motions[self.last : self.last + AHEAD_SCANS]
        ways, turns = np.cumsum(ways_and_turns(motions), axis=1)
        unknown = np.maximum.accumulate(self.unknown[self.last :][: len(motions)])
        count = max(1, int(((ways < AHEAD_M) & (turns < AHEAD_RAD) & ~unknown).sum()))
        return np.arange(self.last + 1, self.last + 1 + count)

    def _latest_window(self, before: Window | None) -> Window:
        """Return the window of the latest key scans. Its grid reuses the memory of the window before."""
        latest = np.array(self.keys[self.part_begin :][-WINDOW_KEYS:][::-1])
        poses, reuse = self.poses[latest], None if before is None else before.grid
        grid = likelihood_grids(self.geometry, [latest], [poses], poses[0, :2], self.half_width_m, reuse=reuse)
        return Window(latest, poses, grid)


def _posterior_variance(placed: PlacedScans, k: int) -> Floats:
    """Return the variance of pose number ``k`` by laser and odometry together, x, y and yaw, (3,)."""
    return np.asarray(np.diag(np.linalg.inv(placed.information[k] + np.diag(1.0 / placed.variance[k]))))


def grid_half_width(geometry: ScanGeometry) -> float:
    """Return the half width of grids that hold nearly all points of a scan taken at their middle, metres."""
    sampled = slice(None, None, max(1, len(geometry) // 500))
    distance = np.linalg.norm(geometry.host_points[sampled][geometry.host_kind[sampled] > 0], axis=-1)
    return float(np.clip(np.percentile(distance, 97.0) + 1.0, 4.0, 30.0)) if len(distance) else 4.0
