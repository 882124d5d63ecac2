"""Alignment of key scans, and leave-one-out matching, which compares each scan with its partners alone.

A scan that was aligned wrongly stays wrong, because the pairs that would move it are out of reach. So every scan is
matched to the likelihood grid of its partners, without itself. If the partners explain it clearly better at another
pose, it is moved there. If no near pose explains it, a wide window is searched. Scans still unexplained are flagged.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bayesmap.poses.alignment import Alignment, Pairs, align, overlapping_pairs
from bayesmap.poses.front_end import Track
from bayesmap.poses.graph import DOUBTFUL_SQ, Factors
from bayesmap.poses.key_graph import contradicted_links
from bayesmap.poses.matcher import ANY_SCORE, LikelihoodGrids, Pull, likelihood_grids, match
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats, between, compose

NARROW_M, NARROW_RAD = 0.3, np.radians(6.0)  # half width and half range of angles of the narrow window
WIDE_M, WIDE_RAD = 1.5, np.radians(40.0)  # half width and half range of angles of the wide window
NARROW_PULL = Pull(0.2, np.radians(5.0), 0.005)  # penalty in the narrow window for leaving the present pose
NARROW_GAIN, WIDE_GAIN = 0.015, 0.12  # least gain in score, from 0 to 1, in the narrow and in the wide window
SCANS_AT_ONCE = 24  # number of scans matched at once
MAX_POINTS = 200  # most points of a scan that are matched
SIGMA_M = 0.06  # scale of the likelihood grids


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
        relative = [between(poses[k], poses[own]) for k, own in zip(batch, partners, strict=True)]
        reuse = grids if grids is not None and len(grids) == len(batch) else None
        grids = likelihood_grids(
            geometry, partners, relative, origin[:, :2], half_width_m, sigma_m=SIGMA_M, reuse=reuse
        )
        # Score each scan at its pose.
        points = [geometry.points_of(int(k), MAX_POINTS) for k in batch]
        present = match(grids, points, origin, 0.0, 0.0, min_score=ANY_SCORE).scores[:, 0]
        scores[batch] = best_scores[batch] = present
        if not search:
            continue
        # Search the narrow window, and the wide one for scans that still score badly.
        narrow = match(grids, points, origin, NARROW_M, NARROW_RAD, min_score=present, pull=NARROW_PULL)
        better = narrow.has_pose[:, 0]
        best = np.where(better, narrow.scores[:, 0], present)
        offsets = np.where(better[:, None], narrow.poses[:, 0], 0.0)
        poor = np.nonzero(best < poor_score)[0]
        if len(poor):
            wide = match(
                grids, [points[k] for k in poor], origin[poor], WIDE_M, WIDE_RAD, grid_of=poor,
                min_score=best[poor] + WIDE_GAIN, step_rad=np.radians(1.0),
            )  # fmt: skip
            better = wide.has_pose[:, 0]
            best[poor[better]], offsets[poor[better]] = wide.scores[better, 0], wide.poses[better, 0]
            is_wide[batch[poor[better]]] = True
        best_scores[batch], best_poses[batch] = best, compose(poses[batch], offsets)
    return LeaveOneOut(scores, best_scores, best_poses, (best_scores > scores + NARROW_GAIN) | is_wide)


FLAGGED_SHARE = 0.55  # a scan is flagged if its score is below this share of the median score


def flag_unexplained(explained: Floats, keys: Indices) -> Mask:
    """Flag scans whose scores ``explained``, (S,), are far below the median. Returns a mask, (S,). Key scans and other
    scans have separate medians. A median of 0 is replaced by the median of the positive scores.
    """
    flagged = np.zeros(len(explained), np.bool_)
    is_key = np.zeros(len(explained), np.bool_)
    is_key[keys] = True
    for group in (is_key, ~is_key):
        scores = explained[group]
        if len(scores) and np.median(scores) == 0.0:
            scores = scores[scores > 0.0]
        if len(scores):
            flagged[group] = explained[group] < FLAGGED_SHARE * np.median(scores)
    return flagged


OnRound = Callable[[int, Floats], None]  # called after each round with its number and the poses, (K, 3)
MATCH_REACH = 0.8  # greatest distance between the sensors of compared scans, as a share of the grids' half width
MAX_HALF_WIDTH_M = 14.0  # greatest half width of the grids for leave-one-out matching, metres
NARROW = {"reach_m": (0.15, 0.08), "scale_m": (0.06, 0.03)}  # for poses known to a decimetre
IMPROVEMENTS = 2  # rounds of leave-one-out matching that move scans
POOR_RATIO = 0.6  # a score is poor below this share of the median best score


@dataclass(frozen=True, eq=False)
class ScoredAlignment:
    """An alignment of K scans, and the score of each scan by its partners alone, from 0 to 1, (K,)."""

    alignment: Alignment
    scores: Floats


@dataclass(frozen=True, eq=False)
class KeyAlignment:
    """The alignment of a track's key scans."""

    geometry: ScanGeometry  # of the key scans
    track: Track
    half_width_m: float  # half width of the front end's grids, metres
    report: Callable[[Track, str, int], OnRound]  # returns the callback of a stage with a number of rounds

    def align(
        self, stage: str, poses: Floats, factors: Factors, rounds: int = 8, *, wide: bool, firm: Mask | None = None
    ) -> Alignment:
        """Align the key scans with odometry's factors; poses may be decimetres off if ``wide``. ``firm``: no slip."""

        def select_pairs(poses: Floats) -> Pairs:
            return overlapping_pairs(self.geometry, poses, MATCH_REACH * self.half_width_m)

        return align(
            self.geometry, poses, factors, select_pairs(poses), rounds=rounds, firm=firm, reselect=select_pairs,
            on_progress=self.report(self.track, stage, rounds), **({} if wide else NARROW),
        )  # fmt: skip

    def improve(self, aligned: Alignment, factors: Factors) -> ScoredAlignment:
        """Match each scan to the others, move scans that the others explain better elsewhere, and align all again. A
        moved scan goes back for good if its score after the next alignment is lower than before the move.
        """
        count = len(aligned.poses)
        callback = self.report(self.track, "rematch", IMPROVEMENTS + 1)
        poor_score, poses_before, scores = 0.0, aligned.poses, np.zeros(count)
        moved, stays = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        result, changed = None, None
        for number in range(IMPROVEMENTS + 1):
            result = match_without_itself(
                self.geometry, aligned.poses, aligned.pairs, self._match_half_width_m, poor_score=poor_score,
                search=number < IMPROVEMENTS, before=result, changed=changed,
            )  # fmt: skip
            callback(number + 1, np.where(result.is_better[:, None], result.best_poses, aligned.poses))
            # Return moved scans whose score fell, and move the others that match better elsewhere.
            returned = moved & (result.scores < scores)
            stays |= returned
            moved = result.is_better & ~stays
            scores = np.where(returned, scores, result.scores)
            if not (moved | returned).any():
                break
            poor_score = POOR_RATIO * float(np.median(result.best_scores))
            poses = np.where(returned[:, None], poses_before, aligned.poses)
            poses = np.where(moved[:, None], result.best_poses, poses)
            poses_before = aligned.poses
            aligned = self.align("aligned-rematched", poses, factors, 6, wide=False)
            # Match only scans again that a move concerns: the moved ones, and scans with a moved partner.
            changed = moved | returned
            changed[aligned.pairs.source[changed[aligned.pairs.target]]] = True
        return ScoredAlignment(aligned, scores)

    def without_leaps(self, matched: ScoredAlignment, factors: Factors) -> ScoredAlignment:
        """Align once more with firm odometry over leaps, if odometry agrees with the front end there. A leap is a step
        that contradicts the front end's. Returns the new alignment if it has fewer leaps, else ``matched``.
        """
        track, poses = self.track, matched.alignment.poses
        leaps = contradicted_links(track, poses)
        firm = leaps & (factors.squares(track.poses[track.keys]) < DOUBTFUL_SQ)
        if not firm.any():
            return matched
        held = self.align("aligned-rematched", poses, factors, wide=True, firm=firm)
        if contradicted_links(track, held.poses).sum() >= leaps.sum():
            return matched
        result = match_without_itself(self.geometry, held.poses, held.pairs, self._match_half_width_m, search=False)
        return ScoredAlignment(held, result.scores)

    @property
    def _match_half_width_m(self) -> float:
        """Half width of the grids for leave-one-out matching, metres."""
        return min(self.half_width_m, MAX_HALF_WIDTH_M)
