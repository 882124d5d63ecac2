"""The front end: every scan is matched to the latest key scans, in the order of time.

Scans that lie close together are matched to the same key scans at once (`bayesmap.poses.next_scans`). The first scan
that has moved far enough, or that the key scans do not explain, becomes a key scan. Later scans are matched anew.

A scan may contradict the key scans at every pose that odometry allows. If one of the next scans fits again, somebody
walked by, and the scan is passed over. If none fits, odometry was wrong, or the robot was carried. The path then
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
from bayesmap.poses.next_scans import Elsewhere, Placed, Window, contradicts, place_anywhere, place_near, predict
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, chain_motions, wrap_yaw

KEY_DISTANCE_M, KEY_TURN_RAD = 0.4, np.radians(20.0)  # a scan this far from the last key scan becomes a key scan
KEY_SCORE = 0.5  # a scan with a lower score becomes a key scan, too
WINDOW, BATCH = 12, 12  # latest key scans that a scan is matched to, and most scans matched to them at once
POOR_SCORE, POOR_BELOW = 0.45, 0.25  # a score is bad below the greater of this, and the usual score less that
LOST_SIGMA = np.array([0.5, 0.5, np.radians(30.0)])  # sigmas of a pose beyond which a poor scan is a contradiction
SLIPPED_BELOW = 0.15  # a wide search may move a scan to a score that is lower than usual by at most this
AGAIN_BELOW = 0.1  # scans this far below the usual score are matched again, from the pose of the scan before
LEARN_BELOW = 0.25  # odometry is not calibrated by a scan whose score is lower than usual by more than this
BACKWARDS_M = 1.0  # longest motion that odometry may have stated with the wrong sign, metres
PATIENCE, PATIENCE_M, PATIENCE_RAD = 10, 1.5, np.radians(90.0)  # scans, way and turn in which a fit is sought
UNKNOWN = np.array([1.0, 1.0, np.radians(60.0)])  # standard deviations of an unknown motion


@dataclass(frozen=True, eq=False)
class Track:
    """The result of the front end."""

    poses: Floats  # poses of the laser, (S, 3). The first is the origin.
    information: Floats  # of each pose by the laser, given earlier key scans, in its own frame, (S, 3, 3)
    odometry_variance: Floats  # variance of odometry's motion from the key scan before, x, y and yaw, (S, 3)
    scores: Floats  # fit of each scan to the key scans, from 0 to 1, (S,); 1 for the first
    keys: NDArray[np.intp]  # indices of the key scans, ascending
    broken: NDArray[np.bool_]  # scans that begin a new part of the path: nothing confirms the motion before them, (S,)
    against: NDArray[np.bool_]  # scans before which the robot moved opposite to odometry, (S,)
    slope: Floats  # correction of odometry's systematic error, (3, 3)
    noise_ratios: Floats  # odometry's noise as a multiple of an ordinary robot's, position and heading, (2,)


def follow(
    geometry: ScanGeometry, motions: Floats | None, stamps_s: Floats | None,
    impossible: NDArray[np.bool_] | None = None, on_progress: Callable[[int, Floats], None] | None = None,
) -> Track:  # fmt: skip
    """Match every scan to those before it.

    ``motions`` are odometry's from scan to scan in the earlier one's frame, (S - 1, 3); if None, each is predicted from
    the one before by the stamps, (S,). Motions of the mask ``impossible``, (S - 1,), are taken to be unknown.
    ``on_progress`` is called with the number of matched scans and the poses, (S, 3), zero for the other scans. The
    array changes afterwards, so a caller that keeps it must copy it.
    """
    path = _Path(geometry, motions, stamps_s, impossible)
    while path.at < len(geometry) - 1:
        path.advance()
        if on_progress is not None:
            on_progress(path.at + 1, path.poses)
    return Track(
        path.poses, path.information, path.spread, path.scores, np.array(path.keys), path.broken, path.against,
        path.odometry.slope, path.odometry.ratios,
    )  # fmt: skip


class _Path:
    """The path up to scan ``at``, the last one that has a pose. ``begin`` is the key that begins its present part."""

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
        self.spread, self.scores = np.zeros((count, 3)), np.ones(count)
        self.broken, self.against = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        self.at, self.keys, self.begin = 0, [0], 0
        self.since_key, self.usual = np.zeros(3), 0.6
        # True if all motions since the last key scan were usual; and the variance of the last scan's pose.
        self.plain, self.left = True, np.zeros(3)
        self.window = self._window(None)

    def advance(self) -> None:
        """Set the poses of the next scans, of at least one."""
        if self.window.keys[0] != self.keys[-1]:
            self.window = self._window(self.window)
        batch = _batch(self.at, len(self.poses), self.motions, self.poses[self.at], self.poses[self.keys[-1]])
        # Break the path over an unknown motion.
        if self.unknown[self.at]:
            scan, placed = self.at + 1, self._near(batch[:1])[0]
            self._leap(scan, placed, self._anywhere(scan, placed.predicted[0], float(placed.scores[0])))
            return
        # Match the scans up to the next unknown motion; look further ahead if the first contradicts the key scans.
        breaks = np.nonzero(self.unknown[self.at : int(batch[-1])])[0]
        batch = batch[: int(breaks[0]) if len(breaks) else len(batch)]
        placed, wrong = self._near(batch)
        if wrong[0] and self.motions is not None:
            batch = self._patience()
            placed, wrong = self._near(batch)
        # Accept scans, pass over an exception, move a scan that slipped, or break the path.
        if not wrong[0] and self._slips(int(batch[0]), placed):
            return
        if not wrong[0]:
            self._take(batch, placed, int(np.argmax(wrong)) if wrong.any() else len(batch))
        elif not wrong.all():
            self._pass_over(batch, placed, int(np.argmin(wrong)))
        else:
            scan = int(batch[0])
            place = self._anywhere(scan, placed.predicted[0], float(placed.scores[0]))
            if place is None or not self._slipped(scan, placed, place):
                self._leap(scan, placed, place)

    def _take(self, batch: NDArray[np.intp], placed: Placed, count: int) -> None:
        """Accept the first ``count`` scans of a batch, up to one that becomes a key scan."""
        for k in range(count):
            if k and placed.scores[k] < self.usual - AGAIN_BELOW:
                break
            scan = int(batch[k])
            self._put(scan, placed, k)
            moved = between(self.poses[self.keys[-1]], self.poses[scan])
            far = np.hypot(moved[0], moved[1]) > KEY_DISTANCE_M or abs(moved[2]) > KEY_TURN_RAD
            if far or (placed.scores[k] < KEY_SCORE and np.abs(moved).max() > 0.05):
                self._key(scan)
                break

    def _pass_over(self, batch: NDArray[np.intp], placed: Placed, fits: int) -> None:
        """Give odometry's poses to the unexplained scans. Scan number ``fits`` of the batch becomes a key scan."""
        for k in range(fits + 1):
            self._put(int(batch[k]), placed, k)
        skipped = batch[:fits]
        self.information[skipped] = 0.0
        self.poses[skipped] = placed.predicted[:fits]
        self._key(int(batch[fits]))

    def _slips(self, scan: int, placed: Placed) -> bool:
        """Move a scan that fits worse than usual to a near pose at which it fits as usual. Returns whether it moved."""
        score = float(placed.scores[0])
        if self.motions is None or score > self.usual - SLIPPED_BELOW:
            return False
        place = self._anywhere(scan, placed.predicted[0], score)
        return place is not None and self._slipped(scan, placed, place)

    def _slipped(self, scan: int, placed: Placed, place: Elsewhere) -> bool:
        """Accept a near place if the scan fits there as usual: wheels slipped. Returns whether it is accepted. A place
        counts as near if the wide search says so, or if the noise of odometry allows it.
        """
        off = wrap_yaw(between(placed.predicted[0], place.pose))
        allowed = float((off**2 / placed.variance[0]).sum()) < DOUBTFUL_SQ
        if not (place.near or allowed) or place.score < self.usual - SLIPPED_BELOW:
            return False
        if contradicts(self.geometry, self.window, scan, place.pose):
            return False
        self.poses[scan], self.information[scan], self.scores[scan] = place.pose, place.information, place.score
        self.spread[scan] = self.since_key + placed.variance[0] + UNKNOWN**2
        self.at, self.plain = scan, False
        self._key(scan)
        return True

    def _leap(self, scan: int, placed: Placed, place: Elsewhere | None) -> None:
        """Break the path before an unconfirmed scan, and go on from the pose of a wide search, or of odometry. The
        break moves back over scans just before it that are badly explained, too.
        """
        pose, score, begin = placed.predicted[0], float(placed.scores[0]), scan
        while begin - 1 > self.keys[self.begin] and self.scores[begin - 1] < self._poor_below():
            begin -= 1
        if begin < scan:
            if self.keys[-1] >= begin:
                self.keys = [key for key in self.keys if key < begin]
                self.window = self._window(self.window)
            pose, score = self.poses[begin], float(self.scores[begin])
            place = self._anywhere(begin, pose, score)
        self.poses[begin], self.scores[begin] = (pose, score) if place is None else (place.pose, place.score)
        self.information[begin], self.at = 0.0, begin
        self.spread[begin] = self.since_key + placed.variance[0] + UNKNOWN**2
        self.broken[begin] = True
        self._key(begin)
        self.begin = len(self.keys) - 1

    def _anywhere(self, scan: int, pose: Floats, score: float) -> Elsewhere | None:
        """Search wide windows about a pose for one with a clearly better score."""
        return place_anywhere(self.geometry, self.window, scan, pose, score)

    def _poor_below(self) -> float:
        """Return the score below which a scan is badly explained."""
        return max(POOR_SCORE, self.usual - POOR_BELOW)

    def _put(self, scan: int, placed: Placed, k: int) -> None:
        """Store the pose of scan number ``k`` of a batch, and learn odometry's noise from its motion."""
        self.poses[scan], self.information[scan] = placed.poses[k], placed.information[k]
        self.scores[scan], self.against[scan] = placed.scores[k], placed.turned[k]
        variance, score = placed.variance[k], float(placed.scores[k])
        self.since_key = self.since_key + variance - (placed.variance[k - 1] if k else 0.0)
        self.spread[scan] = self.since_key
        if self.motions is not None:
            left = np.diag(np.linalg.inv(placed.information[k] + np.diag(1.0 / variance)))
            usual = score > max(KEY_SCORE, self.usual - LEARN_BELOW)
            if usual and not placed.turned[k]:
                matched = between(self.poses[scan - 1], self.poses[scan])
                self.odometry.learn_noise(self.motions[scan - 1], matched, left + 1e-5)
            else:
                self.plain = False
            self.left = left
        self.usual += 0.05 * (score - self.usual)
        self.at = scan

    def _key(self, scan: int) -> None:
        """Make a scan a key scan, and learn odometry's systematic error from the way to it."""
        if self.motions is not None and self.plain and not self.broken[scan]:
            before = self.keys[-1]
            stated = chain_motions(np.zeros(3), self.motions[before:scan])[-1]
            self.odometry.learn_slope(stated, between(self.poses[before], self.poses[scan]), self.left + 1e-5)
        self.plain = True
        self.keys.append(scan)
        self.since_key = np.zeros(3)

    def _near(self, scans: NDArray[np.intp]) -> tuple[Placed, NDArray[np.bool_]]:
        """Place the next scans near odometry's poses. Returns them, and which of them contradict the key scans."""
        span = slice(self.at, int(scans[-1]))
        predicted, variance = predict(self.poses, self.at, scans, self.motions, self.stamps_s, self.odometry)
        backwards = None
        if self.motions is not None and np.hypot(*self.motions[span, :2].sum(axis=0)) < BACKWARDS_M:
            stated = self.odometry.corrected(self.motions[span]) * [-1.0, -1.0, 1.0]
            backwards = chain_motions(self.poses[self.at], stated)
        placed = place_near(self.geometry, self.window, scans, predicted, variance, backwards, self.usual)
        wrong = placed.scores < self._poor_below()
        for k in np.nonzero(wrong)[0]:
            wrong[k] = self._doubtful(int(scans[k]), placed, int(k))
        return placed, wrong

    def _doubtful(self, scan: int, placed: Placed, k: int) -> bool:
        """Return whether a badly explained scan contradicts the key scans, fits far away, or has an uncertain pose. If
        the scan fits clearly better near by, ``placed`` gets that pose.
        """
        if contradicts(self.geometry, self.window, scan, placed.poses[k]):
            return True
        left = np.diag(np.linalg.inv(placed.information[k] + np.diag(1.0 / placed.variance[k])))
        if (np.sqrt(left) > LOST_SIGMA).any():
            return True
        place = self._anywhere(scan, placed.predicted[k], float(placed.scores[k]))
        if place is not None and place.near:
            placed.poses[k], placed.information[k], placed.scores[k] = place.pose, place.information, place.score
        return place is not None and not place.near

    def _patience(self) -> NDArray[np.intp]:
        """Return the scans in which a fit is sought after a contradiction: at most `PATIENCE`, none over a break."""
        assert self.motions is not None
        steps = self.motions[self.at : self.at + PATIENCE]
        way, turn = np.cumsum(np.hypot(steps[:, 0], steps[:, 1])), np.cumsum(np.abs(steps[:, 2]))
        unknown = np.maximum.accumulate(self.unknown[self.at :][: len(steps)])
        count = max(1, int(((way < PATIENCE_M) & (turn < PATIENCE_RAD) & ~unknown).sum()))
        return np.arange(self.at + 1, self.at + 1 + count)

    def _window(self, before: Window | None) -> Window:
        """Return the window of the latest key scans. Its grid reuses the memory of the window before."""
        latest = np.array(self.keys[self.begin :][-WINDOW:][::-1])
        poses, reuse = self.poses[latest], None if before is None else before.grid
        grid = likelihood_grids(self.geometry, [latest], [poses], poses[0, :2], self.half_width_m, reuse=reuse)
        return Window(latest, poses, grid)


def grid_half_width(geometry: ScanGeometry) -> float:
    """Return the half width of grids that hold nearly all points of a scan taken at their middle, metres."""
    sampled = slice(None, None, max(1, len(geometry) // 500))
    distance = np.linalg.norm(geometry.host_points[sampled][geometry.host_kind[sampled] > 0], axis=-1)
    return float(np.clip(np.percentile(distance, 97.0) + 1.0, 4.0, 30.0)) if len(distance) else 4.0


def _batch(i: int, count: int, motions: Floats | None, here: Floats, key: Floats) -> NDArray[np.intp]:
    """Return the scans to match next: those that odometry predicts near the last key scan, and one more.

    ``i`` is the last scan with a pose, ``count`` the number of scans, and ``here`` and ``key`` are the poses of scan
    ``i`` and of the last key scan.
    """
    if motions is None:
        return np.array([i + 1])
    last = min(i + BATCH, count - 1)
    travelled = np.cumsum(np.hypot(motions[i:last, 0], motions[i:last, 1]))
    turned = np.cumsum(np.abs(motions[i:last, 2]))
    off = between(key, here)
    near = (travelled < KEY_DISTANCE_M - np.hypot(off[0], off[1])) & (turned < KEY_TURN_RAD - abs(off[2]))
    return np.arange(i + 1, i + 2 + int(np.argmin(near) if not near.all() else len(near) - 1))
