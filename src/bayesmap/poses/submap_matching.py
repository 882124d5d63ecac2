"""Relative poses of key scans by matching their submaps: the key scans around one with those around another.

The best places in a window compete; each is refined, and kept if both ends see through nothing that the other sees, and
if matches of key scans nearby imply the same relative pose.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.kernels.match.view_agreement import Agreement, mutual_view_counts
from bayesmap.poses.graph import Factors
from bayesmap.poses.key_path import KeyPath
from bayesmap.poses.likelihood_grid import likelihood_grids
from bayesmap.poses.matcher import match
from bayesmap.space.planar import between, compose

Floats = NDArray[np.float64]

AROUND_M, NARROW_M, WIDE_M = 2.0, 0.7, 1.0
"""A submap holds the key scans within so much of the path; the one that is matched to it, and those compared."""

RESOLUTION_M, SIGMA_M = 0.1, 0.1
MODES, MODE_SHARE = 2, 0.92
"""So many places of a window are looked at: a further one if its score is at least this share of the best one's."""

ALIKE = 0.7

SEEN = Agreement(near_m=0.15, clear_m=0.4, beams=90)
"""When scans of two submaps agree, and when they contradict each other."""

LEAST_MATCHED = 0.2
MOST_AGAINST = 0.15
"""Of the points at two submaps' middles at least so many match; of those that tell, at most so many contradict."""

FLOOR = np.array([0.02, 0.02, np.radians(0.3)])
"""Standard deviations that a closure has at least: submaps are bent."""


@dataclass(frozen=True)
class Fineness:
    """Of a search: how many points of a submap are looked for, about, and the step between headings."""

    points: int
    step_rad: float


FINE = Fineness(350, np.radians(1.0))


@dataclass(frozen=True, eq=False)
class Closures:
    """Relative poses between key scans that saw the same place at different times.

    Attributes:
        first, second: key scans, as positions among the keys; the first is the earlier one.
        relative: the second in the frame of the first, (M, 3).
        information: of the relative pose, in the first's frame, (M, 3, 3).
        scores: how well the second's submap fits, from 0 to 1.
        support: how many other closures imply the same.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    relative: Floats
    information: Floats
    scores: Floats
    support: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.first)

    def select(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Closures:
        """Some of the closures."""
        return Closures(
            self.first[chosen], self.second[chosen], self.relative[chosen], self.information[chosen],
            self.scores[chosen], self.support[chosen],
        )  # fmt: skip

    def factors(self) -> Factors:
        """The closures as factors of the graph of key scans."""
        return Factors(self.first, self.second, self.relative, self.information)


def match_submaps(
    path: KeyPath,
    first: NDArray[np.intp],
    second: NDArray[np.intp],
    centres: Floats,
    half_m: Floats,
    half_rad: Floats,
    half_width_m: float,
    least_score: float,
    threads: int | None = None,
    fineness: Fineness = FINE,
) -> Closures:
    """Match the submaps of pairs of key scans.

    Args:
        path: the key scans; submaps do not reach over its breaks.
        first: of M pairs, ascending.
        second: of the same pairs.
        centres: middles of the windows for the second's pose in the first's frame, (M, 3).
        half_m: half the windows' widths, (M,).
        half_rad: half their ranges of angles, (M,).
        half_width_m: of submaps' grids.
        least_score: matches below are not kept.
        threads: to compute with; by default all cores.
        fineness: of the search; refining does the rest.
    """
    found = []
    submaps = np.unique(first)
    share = 24  # grids drawn at once: their memory
    for begin in range(0, len(submaps), share):
        some = submaps[begin : begin + share]
        members = [path.around(int(k), AROUND_M) for k in some]
        local = [path.seen_from(int(k), m) for k, m in zip(some, members, strict=True)]
        grids = likelihood_grids(
            path.geometry, [path.keys[m] for m in members], local, np.zeros((len(some), 2)), half_width_m,
            resolution=RESOLUTION_M, sigma_m=SIGMA_M, levels=6, threads=threads,
        )  # fmt: skip
        jobs = np.nonzero((first >= some[0]) & (first <= some[-1]))[0]
        points = [path.points_around(int(q), NARROW_M, fineness.points) for q in second[jobs]]
        best = match(
            grids, points, centres[jobs], half_m[jobs], half_rad[jobs], grid_of=np.searchsorted(some, first[jobs]),
            step_rad=fineness.step_rad, least=least_score, modes=MODES, share=MODE_SHARE, apart_m=0.6,
            apart_rad=np.radians(8.0), threads=threads,
        )  # fmt: skip
        job, mode = np.nonzero(best.found)
        if len(job):
            found.append(
                _refined(
                    path, first[jobs[job]], second[jobs[job]], best.poses[job, mode], best.scores[job, mode], threads
                )
            )
    return joined(found) if found else no_closures()


def _refined(
    path: KeyPath,
    first: NDArray[np.intp],
    second: NDArray[np.intp],
    start: Floats,
    scores: Floats,
    threads: int | None,
) -> Closures:
    """The second's scan refined against the scans of the first's submap, in the first's frame."""
    members = [path.around(int(k), AROUND_M) for k in first]
    others = path.scans(np.concatenate(members))
    offsets = np.concatenate([[0], np.cumsum([len(m) for m in members])]).astype(np.int32)
    anchor = np.repeat(first, np.diff(offsets))
    other_poses = between(path.poses[anchor], path.poses[np.concatenate(members)])
    weak = np.tile(np.diag([1.0, 1.0, 4.0]), (len(first), 1, 1))
    refinement = Refinement(path.scans(second), offsets, others, other_poses, start, start, weak)
    convergence = Convergence(0.02, 15, (0.4, 0.12), (0.2, 0.05), ALIKE)
    found, laser_information, _ = refine_scans(path.geometry, refinement, convergence, threads)
    covariance = np.linalg.inv(laser_information + np.diag([1e-2, 1e-2, 1e-1])) + np.diag(FLOOR**2)
    information = np.linalg.inv(covariance)
    # Refining that ends far from where the search began has slid into something else.
    moved = between(start, found)
    kept = (np.hypot(moved[:, 0], moved[:, 1]) < 0.4) & (np.abs(moved[:, 2]) < np.radians(6.0))
    kept &= _agrees(path, first, second, found, threads)
    return Closures(first, second, found, information, scores, np.zeros(len(first), np.intp)).select(kept)


def _agrees(
    path: KeyPath, first: NDArray[np.intp], second: NDArray[np.intp], relative: Floats, threads: int | None
) -> NDArray[np.bool_]:
    """Whether the scans about both ends see the same, as far as they see the same places, (M,)."""
    one, two, job = [], [], []
    for k in range(len(first)):
        a, b = path.around(int(first[k]), WIDE_M)[::2], path.around(int(second[k]), NARROW_M)[::2]
        one.append(np.repeat(a, len(b)))
        two.append(np.tile(b, len(a)))
        job.append(np.full(len(a) * len(b), k))
    starts, ends, of = np.concatenate(one), np.concatenate(two), np.concatenate(job)
    # The poses of the later scans in the frames of the earlier ones: by way of the closure.
    poses = path.poses
    to_first, from_second = between(poses[starts], poses[first[of]]), between(poses[second[of]], poses[ends])
    across = compose(to_first, compose(relative[of], from_second))
    counts = mutual_view_counts(path.geometry, path.scans(starts), path.scans(ends), across, SEEN, threads)
    sums = np.array([np.bincount(of, weights=counts[:, c], minlength=len(first)) for c in range(3)])
    matched, against, total = sums
    decided = np.maximum(matched + against, 1.0)
    return np.asarray((matched > LEAST_MATCHED * total) & (against < MOST_AGAINST * decided))


def supported(closures: Closures, path: KeyPath) -> Closures:
    """Those that agree with another closure between nearby scans: going round by that one ends at the same place."""
    poses, along = path.poses, path.along
    a, b = closures.first, closures.second
    one, two = np.nonzero(
        (np.abs(along[a][:, None] - along[a][None]) < 5.0)
        & (np.abs(along[b][:, None] - along[b][None]) < 5.0)
        & ((b[:, None] != b[None]) | (a[:, None] != a[None]))
    )
    implied = compose(
        between(poses[a[one]], poses[a[two]]), compose(closures.relative[two], between(poses[b[two]], poses[b[one]]))
    )
    off = between(closures.relative[one], implied)
    between_m = np.abs(along[a][one] - along[a][two]) + np.abs(along[b][one] - along[b][two])
    agree = (np.hypot(off[:, 0], off[:, 1]) < 0.15 + 0.02 * between_m) & (
        np.abs(off[:, 2]) < np.radians(2.0) + np.radians(0.3) * between_m
    )
    support = np.bincount(one[agree & (b[one] != b[two])], minlength=len(closures))
    found = Closures(a, b, closures.relative, closures.information, closures.scores, support)
    return found.select(support >= 2)


def joined(parts: list[Closures]) -> Closures:
    """All of several."""
    return Closures(
        *(
            np.concatenate([getattr(part, name) for part in parts])
            for name in ("first", "second", "relative", "information", "scores", "support")
        )
    )


def no_closures() -> Closures:
    """None at all."""
    none = np.empty(0, np.intp)
    return Closures(none, none, np.empty((0, 3)), np.empty((0, 3, 3)), np.empty(0), none)
