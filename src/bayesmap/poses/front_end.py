"""The front end: match every scan to the latest key scans, in the order of time.

`track_scans` is the main function, and `_Path.advance` its step. The functions after `_Path` match single scans.

A scan is searched for in the window that odometry allows. Branch and bound finds the best pose on the likelihood grid
of the latest key scans. Point-to-line pairs refine it, with odometry's Gaussian as prior. Scans that lie close together
are matched to the same key scans at once. The first scan that has moved far enough, or that the key scans do not
explain, becomes a key scan. Later scans are matched anew.

A scan contradicts the key scans if points of one lie in free space of the other, at every pose that odometry allows. If
one of the next scans fits again, somebody walked by, and the scan gets odometry's pose. If none fits, odometry was
wrong, or the robot was carried. The path then breaks, and later scans are matched only to scans after the break.
`bayesmap.poses.reconnect` joins the two segments by places that were seen from both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.kernels.match.view_comparison import Agreement, mutual_view_counts
from bayesmap.poses.calibration import RunningOdometry
from bayesmap.poses.graph import DOUBTFUL_SQ
from bayesmap.poses.matcher import ANY_SCORE, LikelihoodGrids, Pull, SearchWindows, likelihood_grids, match
from bayesmap.poses.scan_geometry import NO_POINT, ScanGeometry
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats, between, chain_motions, compose, lengths_and_turns, rotation, wrap_yaw
from bayesmap.space.time_order import EQUAL_STAMPS_S

KEY_DISTANCE_M, KEY_TURN_RAD = 0.4, np.radians(20.0)  # a scan this far from the last key scan becomes a key scan
KEY_SCORE = 0.5  # a scan with a lower score becomes a key scan, too
MIN_KEY_MOTION = 0.05  # motion along x, y or yaw after which a low score makes a key scan, metres or radians
WINDOW_KEYS = 12  # number of latest key scans that a scan is matched to
MAX_BATCH = 12  # most scans that are matched to the key scans at once
POOR_SCORE, POOR_LOSS = 0.45, 0.25  # a scan is poor below max(POOR_SCORE, usual score - POOR_LOSS)
LOST_SIGMA = np.array([0.5, 0.5, np.radians(30.0)])  # sigmas of a pose beyond which a poor scan is a contradiction
SLIP_LOSS = 0.15  # a wide search may move a scan to a score that is lower than usual by at most this
REMATCH_LOSS = 0.1  # scans this far below the usual score are matched again, from the pose of the scan before
MAX_LEARN_LOSS = 0.25  # odometry is not calibrated by a scan whose score is lower than usual by more than this
MAX_BACKWARDS_M = 1.0  # longest motion that odometry may have stated with the wrong sign, metres
MAX_AHEAD_SCANS, MAX_AHEAD_M, MAX_AHEAD_RAD = 10, 1.5, np.radians(90.0)  # most scans, path and turn to seek a fit in
UNKNOWN_SIGMA = np.array([1.0, 1.0, np.radians(60.0)])  # standard deviations of an unknown motion
INITIAL_SCORE = 0.6  # usual score before the first scan is matched
SCORE_RATE = 0.05  # rate at which the usual score follows the scores of scans
UNUSUAL_LOSS = 0.04  # scans this far below the usual score may have gone backwards, unreported by odometry
BACKWARDS_GAIN = 0.05  # least gain in score for going backwards: along a wall both directions fit
WIDE_M = 1.0  # half width of the wide search, metres
WIDE_STAGES = ((np.radians(45.0), 0.1), (np.pi, 0.15))  # stages of it: half range of angles, least gain in score
WINDOW_SIGMAS = 3.5  # half width of a search window in standard deviations of odometry, within limits
HALF_M_RANGE, HALF_RAD_RANGE = (0.1, 1.5), (np.radians(1.5), np.radians(60.0))  # limits of half widths, half ranges
MIN_PULL_M, MIN_PULL_RAD = 0.03, np.radians(1.0)  # least scales of the penalty for leaving the predicted pose
UNSTATED_SIGMA = np.array([0.05, 0.05, np.radians(4.0)])  # standard deviations of a motion without odometry at first
UNSTATED_SIGMA_PER_S, MAX_GROWTH_S = np.array([0.5, 0.5, 0.6]), 1.0  # growth of these, and how long they grow
USUAL_GAP_S = 0.2  # time between two scans without stamps
MAX_MOTION_RATIO = 1.5  # largest ratio of a motion without odometry to the last one, over a longer gap
MIN_GAIN_POINTS = 6.0  # least gain in score, in points that fit: it decides for scans with few points
POINT_SIGMA_M = 0.02  # sigma of a point-to-line residual: the laser's noise, rough walls, a scan's own distortion
MAX_POINTS = 200  # most points of a scan that are matched
REACH_M = (0.3, 0.12)  # maximum distance of paired points: in the first step and in the last
SCALE_M = (0.15, 0.05)  # distance from which points count as outliers: in the first step and in the last
MIN_COSINE = 0.7  # least cosine of the angle between paired normals
MAX_REFINEMENT_STEPS = 8  # most steps of a refinement
BATCH_KEYS = 6  # number of newest key scans against which scans are refined, if several scans are placed at once
VIEW_AGREEMENT = Agreement(near_m=0.2, clear_m=0.5, beams=90)  # limits when a scan is compared with a key scan
MAX_AGAINST_SHARE = 0.2  # greater shares of contradicting points are a contradiction: fewer are people
MIN_JUDGED_POINTS = 60  # fewest compared points for a contradiction
WIDE_VARIANCE = np.array([0.05, 0.05, 0.02])  # of the pose of a wide search: sigmas of 0.22 m and 8 degrees
LAST_POSE_VARIANCE = np.array([1e-4, 1e-4, 2.5e-5])  # variance of the pose before: sigmas of 1 cm and 5 mrad
MATCH_VARIANCE = 1e-5  # variance of a matched motion beyond that of the pose: 3 mm and 3 mrad


@dataclass(frozen=True, eq=False)
class Track:
    """The result of the front end."""

    poses: Floats  # poses of the laser, (S, 3). The first is the origin.
    information: Floats  # inverse covariance of each pose by laser and earlier key scans, own frame, (S, 3, 3)
    odometry_variance: Floats  # variance of odometry's motion from the key scan before, x, y and yaw, (S, 3)
    scores: Floats  # fit of each scan to the key scans, from 0 to 1, (S,); 1 for the first
    keys: Indices  # indices of the key scans, ascending
    broken: Mask  # mask of scans that begin a new segment of the path: nothing confirms the motion before them, (S,)
    is_reversed: Mask  # mask of scans before which the robot moved opposite to odometry, (S,)
    slope: Floats  # correction of odometry's systematic error, (3, 3)
    noise_ratios: Floats  # odometry's noise as a multiple of an ordinary robot's, position and heading, (2,)


def track_scans(
    geometry: ScanGeometry, motions: Floats | None, stamps_s: Floats | None,
    impossible: Mask | None = None, on_progress: Callable[[int, Floats], None] | None = None,
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
    """The path up to scan ``last``, the last one with a pose. ``keys[segment_begin]`` begins the present segment."""

    def __init__(
        self, geometry: ScanGeometry, motions: Floats | None, stamps_s: Floats | None, impossible: Mask | None
    ) -> None:
        count = len(geometry)
        self.geometry, self.stamps_s = geometry, stamps_s
        self.half_width_m = grid_half_width(geometry)
        self.unknown = np.zeros(max(count - 1, 0), np.bool_)
        if motions is not None and impossible is not None:
            motions, self.unknown = np.where(impossible[:, None], 0.0, motions), impossible
        self.motions = motions
        # The results, and the key scans so far. The first scan is a key scan at the origin.
        self.poses, self.information = np.zeros((count, 3)), np.zeros((count, 3, 3))
        self.odometry_variance, self.scores = np.zeros((count, 3)), np.ones(count)
        self.broken, self.is_reversed = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        self.last, self.keys, self.segment_begin = 0, [0], 0
        # Running estimates, and the state since the last key scan.
        self.odometry = RunningOdometry()
        self.usual_score = INITIAL_SCORE  # running mean of scores
        self.variance_since_key = np.zeros(3)  # variance of odometry since the last key scan
        self.pose_variance = np.zeros(3)  # variance of the last scan's pose
        self.usual_since_key = True  # True if all motions since the last key scan were usual
        self.window = self._latest_window(None)

    def advance(self) -> None:
        """Set the poses of one or more next scans."""
        if self.window.keys[0] != self.keys[-1]:
            self.window = self._latest_window(self.window)
        batch = self._batch()
        # Break the path over an unknown motion.
        if self.unknown[self.last]:
            placed, _ = self._place_near(batch[:1])
            wide = search_widely(self.geometry, self.window, self.last + 1, placed.predicted[0], placed.scores[0])
            self._break(self.last + 1, placed, wide)
            return
        # Match the scans up to the next unknown motion; look further ahead if the first contradicts the key scans.
        breaks = np.nonzero(self.unknown[self.last : int(batch[-1])])[0]
        batch = batch[: int(breaks[0]) if len(breaks) else len(batch)]
        placed, misfits = self._place_near(batch)
        if misfits[0] and self.motions is not None:
            batch = self._scans_ahead()
            placed, misfits = self._place_near(batch)
        # If no scan fits, or the first fits worse than usual, wheels may have slipped: search widely.
        scan = int(batch[0])
        wide = None
        may_slip = self.motions is not None and placed.scores[0] <= self.usual_score - SLIP_LOSS
        if misfits.all() or (may_slip and not misfits[0]):
            wide = search_widely(self.geometry, self.window, scan, placed.predicted[0], placed.scores[0])
        if wide is not None and self._accept_slip(scan, placed, wide):
            return  # the scan is accepted where the wide search found it
        # Accept the scans before the first misfit, skip misfits before one that fits, or break the path.
        if not misfits[0]:
            self._accept(batch, placed, int(np.argmax(misfits)) if misfits.any() else len(batch))
        elif not misfits.all():
            self._skip(batch, placed, int(np.argmin(misfits)))
        else:
            self._break(scan, placed, wide)

    def _accept(self, batch: Indices, placed: PlacedScans, count: int) -> None:
        """Accept the first ``count`` scans of a batch, up to one that becomes a key scan."""
        for k in range(count):
            if k and placed.scores[k] < self.usual_score - REMATCH_LOSS:
                break  # match this scan again, from the pose of the scan before
            scan = int(batch[k])
            self._store(scan, placed, k)
            motion = between(self.poses[self.keys[-1]], self.poses[scan])
            is_far = np.hypot(motion[0], motion[1]) > KEY_DISTANCE_M or abs(motion[2]) > KEY_TURN_RAD
            if is_far or (placed.scores[k] < KEY_SCORE and np.abs(motion).max() > MIN_KEY_MOTION):
                self._add_key(scan)
                break

    def _skip(self, batch: Indices, placed: PlacedScans, next_fit: int) -> None:
        """Give odometry's poses to the scans of a batch before number ``next_fit``, which becomes a key scan."""
        for k in range(next_fit + 1):
            self._store(int(batch[k]), placed, k)
        skipped = batch[:next_fit]
        self.information[skipped] = 0.0
        self.poses[skipped] = placed.predicted[:next_fit]
        self._add_key(int(batch[next_fit]))

    def _accept_slip(self, scan: int, placed: PlacedScans, wide: WideMatch) -> bool:
        """Accept a pose near by or allowed by odometry, if the scan fits as usual. Returns whether it was accepted."""
        deviation = wrap_yaw(between(placed.predicted[0], wide.pose))
        is_allowed = wide.is_near or float((deviation**2 / placed.variance[0]).sum()) < DOUBTFUL_SQ
        if not is_allowed or wide.score < self.usual_score - SLIP_LOSS:
            return False
        if contradicts(self.geometry, self.window, scan, wide.pose):
            return False
        self.poses[scan], self.information[scan], self.scores[scan] = wide.pose, wide.information, wide.score
        self.odometry_variance[scan] = self.variance_since_key + placed.variance[0] + UNKNOWN_SIGMA**2
        self.usual_since_key = False
        self._add_key(scan)
        self.last = scan
        return True

    def _break(self, scan: int, placed: PlacedScans, wide: WideMatch | None) -> None:
        """Break the path before an unconfirmed scan, and go on from the pose of a wide search, or of odometry."""
        # Move the break back over scans just before it that are badly explained, too.
        begin, pose, score = scan, placed.predicted[0], float(placed.scores[0])
        while begin - 1 > self.keys[self.segment_begin] and self.scores[begin - 1] < self._poor_score():
            begin -= 1
        if begin < scan:
            if self.keys[-1] >= begin:
                self.keys = [key for key in self.keys if key < begin]
                self.window = self._latest_window(self.window)
            pose, score = self.poses[begin], float(self.scores[begin])
            wide = search_widely(self.geometry, self.window, begin, pose, score)
        # Begin a new segment with a key scan that the laser says nothing about.
        self.poses[begin], self.scores[begin] = (pose, score) if wide is None else (wide.pose, wide.score)
        self.information[begin] = 0.0
        self.odometry_variance[begin] = self.variance_since_key + placed.variance[0] + UNKNOWN_SIGMA**2
        self.broken[begin] = True
        self._add_key(begin)
        self.last = begin
        self.segment_begin = len(self.keys) - 1

    def _poor_score(self) -> float:
        """Return the score below which a scan is badly explained."""
        return max(POOR_SCORE, self.usual_score - POOR_LOSS)

    def _store(self, scan: int, placed: PlacedScans, k: int) -> None:
        """Store the pose of scan number ``k`` of a batch, and learn odometry's noise from its motion."""
        self.poses[scan], self.information[scan] = placed.poses[k], placed.information[k]
        self.scores[scan], self.is_reversed[scan] = placed.scores[k], placed.is_reversed[k]
        score = float(placed.scores[k])
        variance_before = placed.variance[k - 1] if k else 0.0  # variances accumulate over the batch
        self.variance_since_key = self.variance_since_key + placed.variance[k] - variance_before
        self.odometry_variance[scan] = self.variance_since_key
        # Learn only from scans that fit as usual: others say little about odometry.
        if self.motions is not None:
            self.pose_variance = _posterior_variance(placed, k)
            if score > max(KEY_SCORE, self.usual_score - MAX_LEARN_LOSS) and not placed.is_reversed[k]:
                matched = between(self.poses[scan - 1], self.poses[scan])
                self.odometry.learn_noise(self.motions[scan - 1], matched, self.pose_variance + MATCH_VARIANCE)
            else:
                self.usual_since_key = False
        self.usual_score += SCORE_RATE * (score - self.usual_score)
        self.last = scan

    def _add_key(self, scan: int) -> None:
        """Make a scan a key scan, and learn odometry's systematic error from the motion since the last key scan."""
        if self.motions is not None and self.usual_since_key and not self.broken[scan]:
            last_key = self.keys[-1]
            stated = chain_motions(np.zeros(3), self.motions[last_key:scan])[-1]
            matched = between(self.poses[last_key], self.poses[scan])
            self.odometry.learn_slope(stated, matched, self.pose_variance + MATCH_VARIANCE)
        self.usual_since_key = True
        self.keys.append(scan)
        self.variance_since_key = np.zeros(3)

    def _place_near(self, scans: Indices) -> tuple[PlacedScans, Mask]:
        """Place the next scans near odometry's poses. Returns them, and the mask of misfits: scans that do not fit."""
        predicted, variance = predict(self.poses, self.last, len(scans), self.motions, self.stamps_s, self.odometry)
        backwards = None
        stated = None if self.motions is None else self.motions[self.last : int(scans[-1])]
        if stated is not None and np.hypot(*stated[:, :2].sum(axis=0)) < MAX_BACKWARDS_M:
            backwards = chain_motions(self.poses[self.last], self.odometry.corrected(stated) * [-1.0, -1.0, 1.0])
        placed = place_near(self.geometry, self.window, scans, predicted, variance, backwards, self.usual_score)
        misfits = placed.scores < self._poor_score()
        for k in np.nonzero(misfits)[0]:
            misfits[k] = self._rematch_misfit(int(scans[k]), placed, int(k))
        return placed, misfits

    def _rematch_misfit(self, scan: int, placed: PlacedScans, k: int) -> bool:
        """Match a misfit again in a wide window. Stores a better pose near by; returns whether it is still a misfit."""
        is_uncertain = (np.sqrt(_posterior_variance(placed, k)) > LOST_SIGMA).any()
        if is_uncertain or contradicts(self.geometry, self.window, scan, placed.poses[k]):
            return True
        wide = search_widely(self.geometry, self.window, scan, placed.predicted[k], placed.scores[k])
        if wide is not None and wide.is_near:
            placed.poses[k], placed.information[k], placed.scores[k] = wide.pose, wide.information, wide.score
        return wide is not None and not wide.is_near

    def _batch(self) -> Indices:
        """Return the scans to match next: those that odometry predicts near the last key scan, and one more."""
        if self.motions is None:
            return np.array([self.last + 1])
        end = min(self.last + MAX_BATCH, len(self.poses) - 1)
        lengths_m, turns_rad = np.cumsum(lengths_and_turns(self.motions[self.last : end]), axis=1)
        since_key = between(self.poses[self.keys[-1]], self.poses[self.last])
        is_near = lengths_m < KEY_DISTANCE_M - np.hypot(since_key[0], since_key[1])
        is_near &= turns_rad < KEY_TURN_RAD - abs(since_key[2])
        count = int(np.argmin(is_near) if not is_near.all() else len(is_near) - 1)
        return np.arange(self.last + 1, self.last + 2 + count)

    def _scans_ahead(self) -> Indices:
        """Return the scans in which a fit is sought after a contradiction, none of them over a break."""
        assert self.motions is not None  # the caller has checked it
        motions = self.motions[self.last : self.last + MAX_AHEAD_SCANS]
        lengths_m, turns_rad = np.cumsum(lengths_and_turns(motions), axis=1)
        unknown = np.maximum.accumulate(self.unknown[self.last :][: len(motions)])
        count = max(1, int(((lengths_m < MAX_AHEAD_M) & (turns_rad < MAX_AHEAD_RAD) & ~unknown).sum()))
        return np.arange(self.last + 1, self.last + 1 + count)

    def _latest_window(self, before: Window | None) -> Window:
        """Return the window of the latest key scans. Its grid reuses the memory of the window before."""
        keys = np.array(self.keys[self.segment_begin :][-WINDOW_KEYS:][::-1])
        poses = self.poses[keys]
        reuse = None if before is None else before.grid
        grid = likelihood_grids(self.geometry, [keys], [poses], poses[0, :2], self.half_width_m, reuse=reuse)
        return Window(keys, poses, grid)


def _posterior_variance(placed: PlacedScans, k: int) -> Floats:
    """Return the variance of pose number ``k`` by laser and odometry together, x, y and yaw, (3,)."""
    return np.asarray(np.diag(np.linalg.inv(placed.information[k] + np.diag(1.0 / placed.variance[k]))))


def grid_half_width(geometry: ScanGeometry) -> float:
    """Return the half width of grids that hold nearly all points of a scan taken at their middle, metres."""
    sampled = slice(None, None, max(1, len(geometry) // 500))  # 500 scans or somewhat more
    distance_m = np.linalg.norm(geometry.host_points[sampled][geometry.host_kind[sampled] != NO_POINT], axis=-1)
    # The width holds 97 % of the points and a margin of a metre. Limits bound the memory of grids.
    return float(np.clip(np.percentile(distance_m, 97.0) + 1.0, 4.0, 30.0)) if len(distance_m) else 4.0


@dataclass(frozen=True, eq=False)
class Window:
    """The latest key scans."""

    keys: Indices  # indices of the scans, newest first, (W,)
    poses: Floats  # (W, 3)
    grid: LikelihoodGrids  # one grid of all these scans


@dataclass(frozen=True, eq=False)
class PlacedScans:
    """Poses of N scans, by odometry and the window."""

    predicted: Floats  # poses predicted by odometry, (N, 3)
    variance: Floats  # variance of the prediction since the last path pose, x, y and yaw, own frames, (N, 3)
    poses: Floats  # poses after matching, (N, 3)
    information: Floats  # inverse covariance by the laser alone, in the poses' own frames, (N, 3, 3)
    scores: Floats  # fit of each scan to the window, from 0 to 1, (N,)
    is_reversed: Mask  # mask of scans before which the robot moved opposite to odometry, (N,)


def predict(
    poses: Floats, last: int, count: int, motions: Floats | None, stamps_s: Floats | None, odometry: RunningOdometry
) -> tuple[Floats, Floats]:
    """Predict poses of ``count`` scans after scan ``last``, and variances in their own frames, (N, 3) each."""
    if motions is None:
        # Assume constant velocity.
        gap_s = gap_before_s = USUAL_GAP_S
        if stamps_s is not None and last > 0 and (np.diff(stamps_s[last - 1 : last + 2]) >= EQUAL_STAMPS_S).all():
            gap_before_s, gap_s = np.diff(stamps_s[last - 1 : last + 2])
        motion = between(poses[last - 1], poses[last]) if last > 0 else np.zeros(3)
        sigma = UNSTATED_SIGMA + UNSTATED_SIGMA_PER_S * min(gap_s, MAX_GROWTH_S)
        return compose(poses[last], motion * min(gap_s / gap_before_s, MAX_MOTION_RATIO))[None], sigma[None] ** 2
    stated = motions[last : last + count]
    return chain_motions(poses[last], odometry.corrected(stated)), np.cumsum(odometry.variances(stated), axis=0)


def place_near(
    geometry: ScanGeometry, window: Window, scans: Indices, predicted: Floats, variance: Floats,
    backwards: Floats | None, usual_score: float,
) -> PlacedScans:  # fmt: skip
    """Match N scans near predicted poses, (N, 3). Unusual misfits are also tried at ``backwards``: robots reverse."""
    # Search the windows that odometry allows.
    points = [geometry.points_of(int(scan), MAX_POINTS) for scan in scans]
    sigma = np.sqrt(variance)
    half_m = np.clip(WINDOW_SIGMAS * sigma[:, :2].max(axis=1), *HALF_M_RANGE)
    half_rad = np.clip(WINDOW_SIGMAS * sigma[:, 2], *HALF_RAD_RANGE)
    pull = Pull(max(float(sigma[:, :2].max()), MIN_PULL_M), max(float(sigma[:, 2].max()), MIN_PULL_RAD))
    windows = SearchWindows(predicted, half_m, half_rad)
    best = match(window.grid, points, windows, min_score=ANY_SCORE, pull=pull)
    start, scores = best.poses[:, 0], best.scores[:, 0]
    # Try the motion backwards for scans that fit worse than usual.
    prior_mean, is_reversed = predicted.copy(), np.zeros(len(scans), np.bool_)
    doubtful = np.nonzero(scores < usual_score - UNUSUAL_LOSS)[0]
    if backwards is not None and len(doubtful):
        doubtful_points = [points[k] for k in doubtful]
        windows = SearchWindows(backwards[doubtful], half_m[doubtful], half_rad[doubtful])
        min_score = scores[doubtful] + _min_gains(BACKWARDS_GAIN, doubtful_points)
        reverse = match(window.grid, doubtful_points, windows, min_score=min_score, pull=pull)
        is_better = reverse.has_pose[:, 0]
        moved = doubtful[is_better]
        start[moved], scores[moved] = reverse.poses[is_better, 0], reverse.scores[is_better, 0]
        prior_mean[moved] = backwards[moved]
        is_reversed[moved] = True
    poses, information = _refine(geometry, window, scans, start, prior_mean, variance)
    return PlacedScans(predicted, variance, poses, information, scores, is_reversed)


@dataclass(frozen=True, eq=False)
class WideMatch:
    """A pose that a wide search found for a scan."""

    pose: Floats  # (3,)
    information: Floats  # inverse covariance by the laser alone, in the pose's own frame, (3, 3)
    score: float  # fit to the window, from 0 to 1
    is_near: bool  # True if it is within `WIDE_M` and the first angle of `WIDE_STAGES` of the prediction


def search_widely(
    geometry: ScanGeometry, window: Window, scan: int, predicted: Floats, score: float
) -> WideMatch | None:
    """Return the best pose in wide windows about a prediction, (3,), or None if no score is clearly above ``score``."""
    points = [geometry.points_of(scan, MAX_POINTS)]
    for stage, (wide_rad, gain) in enumerate(WIDE_STAGES):
        windows = SearchWindows(predicted[None], WIDE_M, wide_rad, step_rad=np.radians(1.0))
        min_score = score + _min_gains(gain, points)
        matches = match(window.grid, points, windows, min_score=min_score, pull=Pull(WIDE_M, wide_rad))
        if matches.has_pose[0, 0]:
            # Odometry was wrong: the prior is centred at the new pose.
            start = matches.poses[:, 0]
            poses, information = _refine(geometry, window, np.array([scan]), start, start, WIDE_VARIANCE[None])
            return WideMatch(poses[0], information[0], float(matches.scores[0, 0]), is_near=stage == 0)
    return None


def _min_gains(gain: float, points: list[Floats]) -> Floats:
    """Return the minimum gain in score of each of N scans, (N,): ``gain``, or `MIN_GAIN_POINTS` points if more."""
    return np.maximum(gain, MIN_GAIN_POINTS / np.maximum([len(p) for p in points], 1))


def contradicts(geometry: ScanGeometry, window: Window, scan: int, pose: Floats) -> bool:
    """Return whether a scan at a pose and the window's key scans contradict each other: beams pass through surfaces."""
    keys, scans = window.keys.astype(np.int32), np.full(len(window.keys), scan, np.int32)
    relative = between(window.poses, pose)
    counts = mutual_view_counts(geometry, keys, scans, relative, VIEW_AGREEMENT, geometry.threads)
    matched, against, _ = counts.sum(axis=0)
    judged = int(matched + against)
    return judged >= MIN_JUDGED_POINTS and against > MAX_AGAINST_SHARE * judged


def _refine(
    geometry: ScanGeometry, window: Window, scans: Indices, start: Floats, prior_mean: Floats, variance: Floats
) -> tuple[Floats, Floats]:
    """Return poses refined under odometry's Gaussian, and the laser's information in the poses' own frames."""
    jobs = len(scans)
    newest = slice(None, None if jobs == 1 else BATCH_KEYS)
    keys, poses = window.keys[newest], window.poses[newest]
    own_information = np.array([np.diag(1.0 / (row + LAST_POSE_VARIANCE)) for row in variance])
    to_world = rotation(prior_mean[:, 2])
    prior_information = to_world @ own_information @ np.swapaxes(to_world, 1, 2)
    refinement = Refinement(
        scans.astype(np.int32), np.arange(jobs + 1, dtype=np.int32) * len(keys), np.tile(keys, jobs).astype(np.int32),
        np.tile(poses, (jobs, 1)), start, prior_mean, prior_information,
    )  # fmt: skip
    reach, scale = geometry.reach_m(*REACH_M), geometry.scale_m(*SCALE_M)
    convergence = Convergence(max(POINT_SIGMA_M, geometry.noise_m), MAX_REFINEMENT_STEPS, reach, scale, MIN_COSINE)
    refined, laser_information, _ = refine_scans(geometry, refinement, convergence, geometry.threads)
    to_world = rotation(refined[:, 2])
    return refined, np.swapaxes(to_world, 1, 2) @ laser_information @ to_world
