"""Align key scans, and find wrongly aligned ones by leave-one-out matching.

A scan that was aligned wrongly stays wrong, because the pairs that would move it are out of reach. So
`KeyAlignment.improve` matches every scan to the likelihood grid of its partners, without itself
(`match_without_itself`). If the partners explain it clearly better at another pose, it is moved there. If no near pose
explains it, a wide window is searched. `flag_unexplained` marks the scans that stay unexplained.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bayesmap.poses.alignment import Alignment, Annealing, Pairs, align, overlapping_pairs
from bayesmap.poses.front_end import Track
from bayesmap.poses.graph import DOUBTFUL_SQ, Factors
from bayesmap.poses.key_graph import contradicted_links
from bayesmap.poses.matcher import ANY_SCORE, LikelihoodGrids, Pull, SearchWindows, likelihood_grids, match
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats, between, compose

OnRound = Callable[[int, Floats], None]  # called after each round with its number and the poses, (K, 3)
MAX_REACH_SHARE = 0.8  # maximum distance between the sensors of compared scans, as a share of the grids' half width
MAX_HALF_WIDTH_M = 14.0  # half width of the grids for leave-one-out matching, metres
FINE_REACH_M, FINE_SCALE_M = (0.15, 0.08), (0.06, 0.03)  # for poses known to a decimetre; see `Annealing`
IMPROVEMENT_ROUNDS = 2  # rounds of leave-one-out matching that move scans
POOR_SHARE = 0.6  # a score is poor below this share of the median best score
NARROW_M, NARROW_RAD = 0.3, np.radians(6.0)  # half width and half range of angles of the narrow window
WIDE_M, WIDE_RAD = 1.5, np.radians(40.0)  # half width and half range of angles of the wide window
NARROW_PULL = Pull(0.2, np.radians(5.0), 0.005)  # penalty in the narrow window for leaving the present pose
MIN_NARROW_GAIN, MIN_WIDE_GAIN = 0.015, 0.12  # minimum gain in score, from 0 to 1, in the narrow and in the wide window
SCANS_AT_ONCE = 24  # number of scans matched at once
MAX_POINTS = 200  # points of a scan that are matched
SIGMA_M = 0.06  # scale of the likelihood grids
FLAGGED_SHARE = 0.55  # a scan is flagged if its score is below this share of the median score


@dataclass(frozen=True, eq=False)
class ScoredAlignment:
    """An alignment of K scans with leave-one-out scores."""

    alignment: Alignment
    scores: Floats  # score of each scan by its partners alone, from 0 to 1, (K,)


@dataclass(frozen=True, eq=False)
class KeyAlignment:
    """The aligner of a track's key scans."""

    geometry: ScanGeometry  # geometry of the key scans
    track: Track  # result of the front end
    half_width_m: float  # half width of the front end's grids, metres
    report: Callable[[Track, str, int], OnRound]  # returns the callback of a stage with a number of rounds

    def align(
        self, stage: str, poses: Floats, factors: Factors, rounds: int = 8, *, coarse: bool, firm: Mask | None = None
    ) -> Alignment:
        """Align the key scans, roughly if ``coarse``. ``firm`` masks odometry's factors without slip, (K - 1,)."""

        def select_pairs(poses: Floats) -> Pairs:
            return overlapping_pairs(self.geometry, poses, MAX_REACH_SHARE * self.half_width_m)

        annealing = Annealing(rounds) if coarse else Annealing(rounds, FINE_REACH_M, FINE_SCALE_M)
        callback = self.report(self.track, stage, rounds)
        return align(self.geometry, poses, factors, select_pairs, annealing, firm=firm, on_progress=callback)

    def improve(self, aligned: Alignment, factors: Factors) -> ScoredAlignment:
        """Match each scan to the others, move scans that the others explain better elsewhere, and align all again."""
        count, half_width_m = len(aligned.poses), min(self.half_width_m, MAX_HALF_WIDTH_M)
        callback = self.report(self.track, "rematch", IMPROVEMENT_ROUNDS + 1)
        poses_before = aligned.poses
        poor_score, scores = 0.0, np.zeros(count)
        is_moved, stays = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        result, changed = None, None
        for number in range(IMPROVEMENT_ROUNDS + 1):
            # Match each scan without itself. The last round only scores.
            result = match_without_itself(
                self.geometry, aligned.poses, aligned.pairs, half_width_m, poor_score=poor_score,
                search=number < IMPROVEMENT_ROUNDS, before=result, changed=changed,
            )  # fmt: skip
            callback(number + 1, np.where(result.is_better[:, None], result.best_poses, aligned.poses))
            # Return moved scans whose score fell, for good, and move the others that match better elsewhere.
            is_returned = is_moved & (result.scores < scores)
            stays |= is_returned
            is_moved = result.is_better & ~stays
            scores = np.where(is_returned, scores, result.scores)
            if not (is_moved | is_returned).any():
                break
            poor_score = POOR_SHARE * float(np.median(result.best_scores))
            poses = np.where(is_returned[:, None], poses_before, aligned.poses)
            poses = np.where(is_moved[:, None], result.best_poses, poses)
            poses_before = aligned.poses
            aligned = self.align("aligned-rematched", poses, factors, rounds=6, coarse=False)
            # Match only scans again that a move concerns: the moved ones, and scans with a moved partner.
            changed = is_moved | is_returned
            changed[aligned.pairs.source[changed[aligned.pairs.target]]] = True
        return ScoredAlignment(aligned, scores)

    def realign_over_leaps(self, matched: ScoredAlignment, factors: Factors) -> ScoredAlignment:
        """Align once more with firm odometry over leaps, if odometry agrees with the front end there.
        A leap is a step that contradicts the front end's. Returns ``matched`` unless this leaves fewer leaps.
        """
        track, poses = self.track, matched.alignment.poses
        leaps = contradicted_links(track, poses)
        firm = leaps & (factors.squares(track.poses[track.keys]) < DOUBTFUL_SQ)
        if not firm.any():
            return matched
        realigned = self.align("aligned-rematched", poses, factors, coarse=True, firm=firm)
        if contradicted_links(track, realigned.poses).sum() >= leaps.sum():
            return matched
        half_width_m = min(self.half_width_m, MAX_HALF_WIDTH_M)
        result = match_without_itself(self.geometry, realigned.poses, realigned.pairs, half_width_m, search=False)
        return ScoredAlignment(realigned, result.scores)


@dataclass(frozen=True, eq=False)
class LeaveOneOut:
    """The result of leave-one-out matching of S scans."""

    scores: Floats  # score of each scan at its pose, by its partners alone, from 0 to 1, (S,); 0 without partners
    best_scores: Floats  # score at the best pose in the window, (S,)
    best_poses: Floats  # best pose in the window, (S, 3)
    is_better: Mask  # mask of the scans whose best pose is clearly better, (S,)


def match_without_itself(
    geometry: ScanGeometry, poses: Floats, pairs: Pairs, half_width_m: float, *, poor_score: float = 0.0,
    search: bool = True, before: LeaveOneOut | None = None, changed: Mask | None = None,
) -> LeaveOneOut:  # fmt: skip
    """Match each of S scans at poses (S, 3) to its partners' likelihood grid.
    Scans with a score below ``poor_score`` are searched for in the wide window, too. Without ``search`` the poses are
    only scored. Scans outside the mask ``changed``, (S,), keep the scores of an earlier result ``before``.
    """
    count = len(poses)
    scores, best_scores, best_poses = np.zeros(count), np.zeros(count), poses.copy()
    is_wide = np.zeros(count, np.bool_)
    is_matched = np.diff(pairs.offsets) > 0
    if before is not None and changed is not None:
        is_matched &= changed
        scores = np.where(changed, 0.0, before.scores)
        best_scores = scores.copy()
    scans = np.nonzero(is_matched)[0]
    grids: LikelihoodGrids | None = None
    for begin in range(0, len(scans), SCANS_AT_ONCE):
        # Make the grid of each scan's partners, in the scan's frame.
        batch = scans[begin : begin + SCANS_AT_ONCE]
        origin = np.zeros((len(batch), 3))
        partners = [pairs.target[pairs.offsets[k] : pairs.offsets[k + 1]].astype(np.intp) for k in batch]
        relative = [between(poses[k], poses[others]) for k, others in zip(batch, partners, strict=True)]
        reuse = grids if grids is not None and len(grids) == len(batch) else None
        middles = np.zeros((len(batch), 2))
        grids = likelihood_grids(geometry, partners, relative, middles, half_width_m, sigma_m=SIGMA_M, reuse=reuse)
        points = [geometry.points_of(int(k), MAX_POINTS) for k in batch]
        present = match(grids, points, SearchWindows(origin, 0.0, 0.0), min_score=ANY_SCORE).scores[:, 0]
        scores[batch] = best_scores[batch] = present
        if not search:
            continue  # only the scores of the present poses are wanted
        # Search the narrow window, and the wide one for scans that still score badly.
        windows = SearchWindows(origin, NARROW_M, NARROW_RAD)
        narrow = match(grids, points, windows, min_score=present, pull=NARROW_PULL)
        in_narrow = narrow.has_pose[:, 0]
        best = np.where(in_narrow, narrow.scores[:, 0], present)
        offsets = np.where(in_narrow[:, None], narrow.poses[:, 0], 0.0)
        poor = np.nonzero(best < poor_score)[0]
        if len(poor):
            windows = SearchWindows(origin[poor], WIDE_M, WIDE_RAD, np.radians(1.0))
            wide = match(grids, [points[k] for k in poor], windows, grid_of=poor, min_score=best[poor] + MIN_WIDE_GAIN)
            in_wide = wide.has_pose[:, 0]
            moved = poor[in_wide]
            best[moved], offsets[moved] = wide.scores[in_wide, 0], wide.poses[in_wide, 0]
            is_wide[batch[moved]] = True
        best_scores[batch], best_poses[batch] = best, compose(poses[batch], offsets)
    return LeaveOneOut(scores, best_scores, best_poses, (best_scores > scores + MIN_NARROW_GAIN) | is_wide)


def flag_unexplained(explained: Floats, keys: Indices) -> Mask:
    """Flag scans whose scores ``explained``, (S,), are far below the median. Returns a mask, (S,)."""
    # Key scans and other scans have separate medians. A median of 0 is replaced by the median of the positive scores.
    flagged, is_key = np.zeros(len(explained), np.bool_), np.zeros(len(explained), np.bool_)
    is_key[keys] = True
    for group in (is_key, ~is_key):
        scores = explained[group]
        if len(scores) and np.median(scores) == 0.0:
            scores = scores[scores > 0.0]
        if len(scores):
            flagged[group] = explained[group] < FLAGGED_SHARE * np.median(scores)
    return flagged
