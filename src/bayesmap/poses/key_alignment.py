"""Key scans aligned with all others that see the same walls, and matched anew where others explain them better."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.alignment import Alignment, Pairs, align, overlapping_pairs
from bayesmap.poses.front_end import Track
from bayesmap.poses.graph import DOUBTFUL_SQ, Factors
from bayesmap.poses.key_graph import contradicted_links
from bayesmap.poses.rematch import rematch
from bayesmap.poses.scan_geometry import ScanGeometry

Floats = NDArray[np.float64]
OnRound = Callable[[int, Floats], None]

MATCH_REACH = 0.8
"""Scans are compared if their sensors are no further apart than this share of the grids' half width."""

REMATCH_M = 14.0
"""Half the width of the grids in which scans are matched anew, at most."""

NARROW = {"reach_m": (0.15, 0.08), "scale_m": (0.06, 0.03)}
"""How far paired points may lie apart where poses are known to a decimetre."""

IMPROVEMENTS = 2
"""How often scans are matched anew without themselves."""


@dataclass(frozen=True, eq=False)
class Rematched:
    """An alignment, and how well each scan is explained by the others alone, from 0 to 1, (K,)."""

    alignment: Alignment
    scores: Floats


@dataclass(frozen=True, eq=False)
class KeyAlignment:
    """The key scans of a track, to be aligned.

    Attributes:
        geometry: of the key scans.
        track: what the front end found.
        half_width_m: of the front end's grids.
        report: returns what is called after each round, for a track, a stage and its number of rounds.
        threads: to compute with; None: all cores.
    """

    geometry: ScanGeometry
    track: Track
    half_width_m: float
    report: Callable[[Track, str, int], OnRound]
    threads: int | None

    def align(
        self,
        stage: str,
        poses: Floats,
        factors: Factors,
        rounds: int = 8,
        *,
        wide: bool,
        firm: NDArray[np.bool_] | None = None,
    ) -> Alignment:
        """Align the key scans.

        Args:
            stage: its name, for the report.
            poses: to start from, (K, 3).
            factors: of odometry.
            rounds: of pairing and solving.
            wide: whether poses may be decimetres off.
            firm: links of odometry that no force bends, (K - 1,).
        """
        reach_m = MATCH_REACH * self.half_width_m

        def pairs(at: Floats) -> Pairs:
            return overlapping_pairs(self.geometry, at, reach_m, self.threads)

        return align(
            self.geometry, poses, factors, pairs(poses), rounds=rounds, firm=firm, reselect=pairs, threads=self.threads,
            on_progress=self.report(self.track, stage, rounds), **({} if wide else NARROW),
        )  # fmt: skip

    def improved(self, aligned: Alignment, factors: Factors) -> Rematched:
        """Match scans anew, each without itself; those that others explain better elsewhere are moved, and all aligned.

        A scan that its new place and the alignment after it explain worse than before is put back, and stays.
        """
        count = len(aligned.poses)
        told = self.report(self.track, "rematch", IMPROVEMENTS + 1)
        poor, old, before = 0.0, aligned.poses, np.zeros(count)
        moved, stays = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        for number in range(IMPROVEMENTS + 1):
            again = rematch(
                self.geometry, aligned.poses, aligned.pairs, self._rematch_m, poor_score=poor,
                search=number < IMPROVEMENTS, threads=self.threads,
            )  # fmt: skip
            told(number + 1, np.where(again.moved[:, None], again.best_poses, aligned.poses))
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
        return Rematched(aligned, before)

    def without_leaps(self, matched: Rematched, factors: Factors) -> Rematched:
        """Where poses leap over a step on which odometry and front end agree, no wheel has slipped: align once more."""
        aligned, track = matched.alignment, self.track
        leaps = contradicted_links(track, aligned.poses)
        firm = leaps & (factors.squares(track.poses[track.keys]) < DOUBTFUL_SQ)
        if not firm.any():
            return matched
        held = self.align("aligned-rematched", aligned.poses, factors, wide=True, firm=firm)
        if contradicted_links(track, held.poses).sum() >= leaps.sum():
            return matched
        again = rematch(self.geometry, held.poses, held.pairs, self._rematch_m, search=False, threads=self.threads)
        return Rematched(held, again.scores)

    @property
    def _rematch_m(self) -> float:
        return min(self.half_width_m, REMATCH_M)
