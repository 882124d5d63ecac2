"""Alignment of key scans, and leave-one-out matching, which compares each scan with its partners alone.

A scan that was aligned wrongly stays wrong, because the pairs that would move it are out of reach. So every scan is
matched to the likelihood grid of its partners, without itself. If the partners explain it clearly better at another
pose, it is moved there. If no near pose explains it well, a wide window is searched. Scans that stay badly explained
are flagged.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.alignment import Alignment, Pairs, align, overlapping_pairs
from bayesmap.poses.front_end import Track
from bayesmap.poses.graph import DOUBTFUL_SQ, Factors
from bayesmap.poses.key_graph import contradicted_links
from bayesmap.poses.matcher import LikelihoodGrids, Pull, likelihood_grids, match
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, compose

WINDOW_M, WINDOW_RAD = 0.3, np.radians(6.0)  # half widths and half ranges of angle, narrow window
WIDE_M, WIDE_RAD = 1.5, np.radians(40.0)  # and wide window
NEAR = Pull(0.2, np.radians(5.0), 0.005)  # penalty in the narrow window for leaving the present pose
CLEARLY_BETTER, WIDE_BETTER = 0.015, 0.12  # least gain in score, from 0 to 1, in the narrow and in the wide window
AT_ONCE, POINTS, SIGMA_M = 24, 200, 0.06  # scans matched at once, their points, sigma of the grids, metres


@dataclass(frozen=True, eq=False)
class Rematch:
    """The result of leave-one-out matching of S scans."""

    scores: Floats  # score of each scan at its pose, by its partners alone, from 0 to 1, (S,); 0 without partners
    best_scores: Floats  # score at the best pose in the window, (S,)
    best_poses: Floats  # best pose in the window, (S, 3)
    moved: NDArray[np.bool_]  # mask of the scans whose best pose is clearly better, (S,)


def rematch(
    geometry: ScanGeometry, poses: Floats, pairs: Pairs, half_width_m: float, *, poor_score: float = 0.0,
    search: bool = True, before: Rematch | None = None, among: NDArray[np.bool_] | None = None,
) -> Rematch:  # fmt: skip
    """Match each of S scans at poses (S, 3) to its partners' likelihood grid.

    Scans with a score below ``poor_score`` are searched for in the wide window, too. Without ``search`` the given poses
    are only scored. Scans outside the mask ``among``, (S,), keep the scores of an earlier result ``before``.
    """
    count = len(poses)
    scores, best_scores, best_poses = np.zeros(count), np.zeros(count), poses.copy()
    wide = np.zeros(count, np.bool_)
    wanted = np.diff(pairs.offsets) > 0
    if before is not None and among is not None:
        wanted &= among
        scores = np.where(among, 0.0, before.scores)
        best_scores = scores.copy()
    partnered = np.nonzero(wanted)[0]
    grids: LikelihoodGrids | None = None
    for begin in range(0, len(partnered), AT_ONCE):
        # Make the grid of each scan's partners, in the scan's frame.
        batch = partnered[begin : begin + AT_ONCE]
        others = [pairs.target[pairs.offsets[k] : pairs.offsets[k + 1]].astype(np.intp) for k in batch]
        local = [between(np.broadcast_to(poses[k], (len(m), 3)), poses[m]) for k, m in zip(batch, others, strict=True)]
        reuse = grids if grids is not None and len(grids) == len(batch) else None
        middles = np.zeros((len(batch), 2))
        grids = likelihood_grids(geometry, others, local, middles, half_width_m, sigma_m=SIGMA_M, reuse=reuse)
        # Score each scan at its pose. The least score of -9 accepts any.
        points = [geometry.points_of(int(k), POINTS) for k in batch]
        origin = np.zeros((len(batch), 3))
        now = match(grids, points, origin, 0.0, 0.0, min_score=-9.0).scores[:, 0]
        scores[batch] = best_scores[batch] = now
        if not search:
            continue
        # Search the narrow window, and the wide one for scans that still score badly.
        near = match(grids, points, origin, WINDOW_M, WINDOW_RAD, min_score=now, pull=NEAR)
        found = near.found[:, 0]
        best = np.where(found, near.scores[:, 0], now)
        place = np.where(found[:, None], near.poses[:, 0], 0.0)
        poor = np.nonzero(best < poor_score)[0]
        if len(poor):
            far = match(
                grids, [points[k] for k in poor], origin[poor], WIDE_M, WIDE_RAD, grid_of=poor,
                min_score=best[poor] + WIDE_BETTER, step_rad=np.radians(1.0),
            )  # fmt: skip
            better = far.found[:, 0]
            best[poor[better]], place[poor[better]] = far.scores[better, 0], far.poses[better, 0]
            wide[batch[poor[better]]] = True
        best_scores[batch], best_poses[batch] = best, compose(poses[batch], place)
    moved = (best_scores > scores + CLEARLY_BETTER) | wide
    return Rematch(scores, best_scores, best_poses, moved)


FAR_BELOW = 0.55  # a scan is flagged if its score is below this share of the median score


def flag_unexplained(explained: Floats, keys: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Flag scans whose scores ``explained``, (S,), are far below the median. Returns a mask, (S,). Key scans and other
    scans have separate medians. A median of 0 is replaced by the median of the positive scores.
    """
    flagged = np.zeros(len(explained), np.bool_)
    is_key = np.zeros(len(explained), np.bool_)
    is_key[keys] = True
    for group in (is_key, ~is_key):
        usual = explained[group]
        if len(usual) and np.median(usual) == 0.0:
            usual = usual[usual > 0.0]
        if len(usual):
            flagged[group] = explained[group] < FAR_BELOW * np.median(usual)
    return flagged


OnRound = Callable[[int, Floats], None]  # called after each round with its number and the poses, (K, 3)
MATCH_REACH = 0.8  # greatest distance between the sensors of compared scans, as a share of the grids' half width
REMATCH_M = 14.0  # greatest half width of the grids for leave-one-out matching, metres
NARROW = {"reach_m": (0.15, 0.08), "scale_m": (0.06, 0.03)}  # for poses known to a decimetre
IMPROVEMENTS = 2  # rounds of leave-one-out matching that move scans


@dataclass(frozen=True, eq=False)
class Rematched:
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
        self, stage: str, poses: Floats, factors: Factors, rounds: int = 8, *, wide: bool,
        firm: NDArray[np.bool_] | None = None,
    ) -> Alignment:  # fmt: skip
        """Align the key scans with odometry's factors, from poses (K, 3), which may be decimetres off if ``wide``.
        ``firm`` is the mask of odometry's links that keep their full weight, (K - 1,).
        """
        reach_m = MATCH_REACH * self.half_width_m

        def pairs(at: Floats) -> Pairs:
            return overlapping_pairs(self.geometry, at, reach_m)

        return align(
            self.geometry, poses, factors, pairs(poses), rounds=rounds, firm=firm, reselect=pairs,
            on_progress=self.report(self.track, stage, rounds), **({} if wide else NARROW),
        )  # fmt: skip

    def improved(self, aligned: Alignment, factors: Factors) -> Rematched:
        """Match each scan to the others, move scans that the others explain better elsewhere, and align all again. A
        moved scan is put back for good if its score after the next alignment is lower than before the move.
        """
        count = len(aligned.poses)
        callback = self.report(self.track, "rematch", IMPROVEMENTS + 1)
        poor, old, before = 0.0, aligned.poses, np.zeros(count)
        moved, stays = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        again, near = None, None
        for number in range(IMPROVEMENTS + 1):
            again = rematch(
                self.geometry, aligned.poses, aligned.pairs, self._rematch_m, poor_score=poor,
                search=number < IMPROVEMENTS, before=again, among=near,
            )  # fmt: skip
            callback(number + 1, np.where(again.moved[:, None], again.best_poses, aligned.poses))
            # Put back moved scans whose score fell, and move the others that match better elsewhere.
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
            aligned = self.align("aligned-rematched", poses, factors, 6, wide=False)
            # Match only scans again that a move concerns: the moved ones, and those of which they are partners.
            near = moved | back
            near[aligned.pairs.source[near[aligned.pairs.target]]] = True
        return Rematched(aligned, before)

    def without_leaps(self, matched: Rematched, factors: Factors) -> Rematched:
        """Align once more with firm odometry over leaps, if odometry agrees with the front end there. A leap is a step
        that contradicts the front end's. The result is returned if it has fewer leaps.
        """
        aligned, track = matched.alignment, self.track
        leaps = contradicted_links(track, aligned.poses)
        firm = leaps & (factors.squares(track.poses[track.keys]) < DOUBTFUL_SQ)
        if not firm.any():
            return matched
        held = self.align("aligned-rematched", aligned.poses, factors, wide=True, firm=firm)
        if contradicted_links(track, held.poses).sum() >= leaps.sum():
            return matched
        again = rematch(self.geometry, held.poses, held.pairs, self._rematch_m, search=False)
        return Rematched(held, again.scores)

    @property
    def _rematch_m(self) -> float:
        """Half width of the grids for leave-one-out matching, metres."""
        return min(self.half_width_m, REMATCH_M)
