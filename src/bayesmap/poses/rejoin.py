"""Join the parts of a broken path by places that were seen from two of them.

Where the front end broke the path, the relative pose of the two parts is unknown: wheels slipped, scans are missing, or
the robot was carried. Submaps of each part are matched to those of all others, with any heading: near where a wide
search or odometry puts them, and everywhere. A relative pose of two parts is believed if several pairs of places agree
on it, and no other relative pose has nearly as many.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import Agreement, mutual_view_counts
from bayesmap.poses.loops import Closures, Fineness, KeyPath, joined, match_submaps, no_closures
from bayesmap.space.planar import between, compose, inverse, wrapped

Floats = NDArray[np.float64]

NEAR_M, NEAR_PLACES = 3.0, 6
"""Each place is compared with up to this many places of other parts within this distance, nearest first."""

EVERYWHERE_M, SAME_PLACE_M, SAME_VIEW_RAD = 3.0, 1.5, np.radians(45.0)
"""Each place is also compared with places everywhere, this far apart along the path, in windows of this half width.
Places within the second and third number of an earlier one saw the same, and are left out."""

SPACING_M, QUERIES, QUERIES_IN_ALL, TURNS = 1.0, 24, 96, 3
"""Places that are sought: their distance along a part, the most of a part, and the most of all parts, evenly spread.
They are sought in turns; later turns are spared where the first turns join all parts surely."""

COARSE = Fineness(60, np.radians(2.0))
"""Fineness of these searches: refinement uses whole scans, so that more points and headings would add little."""

NEAR_SCORE, FAR_SCORE = 0.6, 0.75
"""Least scores of matches: among all places of other parts, chance finds better ones than among near places."""

CHANCE = 0.5
"""A place votes with the square of its score above this."""

TRIED = 6
"""Most relative poses of two parts that are tested against free space."""

AGREE, SURELY = 3, 4
"""Places that must agree on the relative pose of two parts: after the last turn, and after earlier ones."""

FEW = 2
"""Places that make a rival relative pose before the last turn."""

RIVAL, RIVAL_EARLY = 0.5, 0.4
"""Share of the best one's votes with which another relative pose makes both doubtful: after the last turn, before."""

SAME_M, SAME_RAD = 0.5, np.radians(6.0)
"""Greatest difference between relative poses of parts that count as one: parts bend."""

MET_M, COMPARED = 5.0, 600
"""Key scans of two joined parts that lie this near are compared, up to this many pairs."""

SEEN, MOST_AGAINST = Agreement(near_m=0.2, clear_m=0.4, beams=60), 0.15
"""When scans of two parts agree or contradict each other, and the most share of contradicting points."""


@dataclass(frozen=True, eq=False)
class Joint:
    """The relative pose of two parts: ``motion`` brings the later part's poses to the earlier one's frame."""

    earlier: int
    later: int
    motion: Floats
    votes: float


def rejoin(path: KeyPath, half_width_m: float) -> tuple[Floats, NDArray[np.bool_]]:
    """Join the parts of a path of K key scans whose poses are right within each part.

    Returns poses with every joined part moved, (K, 3), and which parts are joined to an earlier one by places that both
    saw, (P,); part 0 is. ``half_width_m`` is that of submaps' grids.
    """
    parts, islands = [no_closures()], path
    for turn in range(TURNS):
        for (first, second, centres), half_m, least in (
            (_near_pairs(path, turn), NEAR_M, NEAR_SCORE),
            (_all_pairs(path, turn), EVERYWHERE_M, FAR_SCORE),
        ):
            every = np.ones(len(first))
            windows = centres, half_m * every, np.pi * every
            parts.append(match_submaps(path, first, second, *windows, half_width_m, least, COARSE))
        islands = _together(path, joined(parts), AGREE if turn == TURNS - 1 else SURELY)
        if not islands.parts.any():
            break
    return _assembled(path, islands)


def _together(path: KeyPath, closures: Closures, agree: int) -> KeyPath:
    """Join the parts on which ``agree`` places agree: an island has the number of its first part, and right poses."""
    islands = path
    while True:
        rival = RIVAL if agree == AGREE else RIVAL_EARLY
        joint = _surest(_candidates(closures, islands, agree), islands, rival)
        if joint is None:
            return islands
        later = islands.parts == joint.later
        islands = replace(
            islands,
            poses=np.where(later[:, None], compose(joint.motion, islands.poses), islands.poses),
            parts=np.where(later, joint.earlier, islands.parts),
        )


def _surest(pairs: Iterator[list[Joint]], islands: KeyPath, rival: float) -> Joint | None:
    """Return the joint with the most votes that contradicts nothing and has no rival."""
    best = None
    for candidates in pairs:
        if not candidates or (best is not None and candidates[0].votes <= best.votes):
            continue
        consistent_joints = [j for j in candidates if consistent(islands, j)]
        if consistent_joints and (
            len(consistent_joints) == 1 or consistent_joints[1].votes < rival * consistent_joints[0].votes
        ):
            best = consistent_joints[0] if best is None or consistent_joints[0].votes > best.votes else best
    return best


Windows = tuple[NDArray[np.intp], NDArray[np.intp], Floats]
"""Pairs of keys, the first ascending, and the middle of the window for the second's pose in the first's frame."""


def _near_pairs(path: KeyPath, turn: int) -> Windows:
    """Return pairs of a place of each part and the places of longer parts near it."""
    places, poses = path.places(SPACING_M), path.poses
    first, second = [], []
    for query in _queries(path, turn):
        others = places[_longer(path)[path.parts[places]] > _longer(path)[path.parts[query]]]
        off = np.hypot(*(poses[others, :2] - poses[query, :2]).T)
        near = others[off < NEAR_M]
        near = near[np.argsort(off[off < NEAR_M], kind="stable")][:NEAR_PLACES]
        first += near.tolist()
        second += [int(query)] * len(near)
    one, two = np.array(first, np.intp), np.array(second, np.intp)
    order = np.argsort(one, kind="stable")
    one, two = one[order], two[order]
    return one, two, between(poses[one], poses[two])


def _all_pairs(path: KeyPath, turn: int) -> Windows:
    """Return pairs of some places of each part and all places of longer parts, as if both stood at the same point."""
    places = _different(path, path.places(EVERYWHERE_M))
    one, two = (grid.ravel() for grid in np.meshgrid(places, _queries(path, turn), indexing="ij"))
    apart = _longer(path)[path.parts[one]] > _longer(path)[path.parts[two]]
    return one[apart], two[apart], np.zeros((int(apart.sum()), 3))


def _longer(path: KeyPath) -> NDArray[np.intp]:
    """Return the rank of each part by its number of key scans, (P,): the shorter part of a pair is sought."""
    rank = np.empty(int(path.parts[-1]) + 1, np.intp)
    rank[np.lexsort((-np.arange(len(rank)), np.bincount(path.parts)))] = np.arange(len(rank))
    return rank


def _different(path: KeyPath, places: NDArray[np.intp]) -> NDArray[np.intp]:
    """Remove places that lie near an earlier one of the same part and look the same way."""
    chosen: list[int] = []
    for place in places:
        off = between(path.poses[chosen], path.poses[place])
        again = (np.hypot(off[:, 0], off[:, 1]) < SAME_PLACE_M) & (np.abs(off[:, 2]) < SAME_VIEW_RAD)
        if not (again & (path.parts[chosen] == path.parts[place])).any():
            chosen.append(int(place))
    return np.array(chosen, np.intp)


def _queries(path: KeyPath, turn: int) -> NDArray[np.intp]:
    """Return the places that are sought in a turn: of all parts but the longest."""
    places, count = path.places(SPACING_M), int(path.parts[-1]) + 1
    most, rank = min(QUERIES, max(2 * AGREE, QUERIES_IN_ALL // max(1, count - 1))), _longer(path)
    queries = [np.empty(0, np.intp)]
    for part in np.nonzero(rank < count - 1)[0]:
        own = places[path.parts[places] == part]
        queries.append((own if len(own) <= most else own[np.arange(most) * len(own) // most])[turn::TURNS])
    return np.concatenate(queries)


def _candidates(closures: Closures, islands: KeyPath, agree: int) -> Iterator[list[Joint]]:
    """Yield for each pair of parts the relative poses on which enough places agree, by votes, the most first."""
    poses, parts = islands.poses, islands.parts
    # The motion of the later part that brings its key to where the match has it.
    motions = compose(compose(poses[closures.first], closures.relative), inverse(poses[closures.second]))
    swapped = parts[closures.first] > parts[closures.second]
    motions = np.where(swapped[:, None], inverse(motions), motions)
    brought = np.where(swapped, closures.first, closures.second)
    pairs = np.sort(np.stack([parts[closures.first], parts[closures.second]], axis=1), axis=1)
    for earlier, later in np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0):
        own = np.nonzero((pairs == (earlier, later)).all(axis=1))[0]
        # Compared where the later part's keys come to lie: a turn about a far origin moves them.
        at = compose(motions[own][:, None], poses[brought[own]][None])
        off = np.hypot(*np.moveaxis((at - at[np.arange(len(own)), np.arange(len(own))][None])[..., :2], -1, 0))
        turn = np.abs(wrapped(motions[own][:, None, 2] - motions[own][None, :, 2]))
        same = (off < SAME_M) & (turn < SAME_RAD)
        # Several matches of one place count as one vote, the highest.
        places, voice = np.unique(closures.second[own], return_inverse=True)
        loud = np.where(same, (closures.scores[own][None] - CHANCE) ** 2, 0.0)
        joints: list[Joint] = []
        least = agree
        while len(joints) < TRIED:
            heard = np.stack([loud[:, voice == k].max(axis=1) for k in range(len(places))], axis=1)
            votes = np.where((heard > 0.0).sum(axis=1) >= least, heard.sum(axis=1), 0.0)
            best = int(np.argmax(votes))
            if not votes[best] > 0.0:
                break
            joints.append(Joint(int(earlier), int(later), motions[own[best]], float(votes[best])))
            loud[:, same[best]] = 0.0  # a match that agrees with one relative pose votes for no other: parts bend
            least = AGREE if agree == AGREE else FEW
        yield joints


def consistent(islands: KeyPath, joint: Joint) -> bool:
    """Check that two joined parts do not contradict each other: few points of one stand where the other saw through."""
    one, two = np.nonzero(islands.parts == joint.earlier)[0], np.nonzero(islands.parts == joint.later)[0]
    earlier, later = islands.poses[one], compose(joint.motion, islands.poses[two])
    a, b = np.nonzero(np.hypot(*np.moveaxis(earlier[:, None, :2] - later[None, :, :2], -1, 0)) < MET_M)
    kept = np.arange(min(len(a), COMPARED)) * len(a) // max(1, min(len(a), COMPARED))
    a, b = a[kept], b[kept]
    scans, seen, geometry = (
        (islands.scans(one[a]), islands.scans(two[b])),
        between(earlier[a], later[b]),
        islands.geometry,
    )
    matched, against, _ = mutual_view_counts(geometry, *scans, seen, SEEN, geometry.threads).sum(axis=0)
    return bool(against <= MOST_AGAINST * (matched + against))


def _assembled(path: KeyPath, islands: KeyPath) -> tuple[Floats, NDArray[np.bool_]]:
    """Bring all islands to one frame; one that nothing joins stays where the front end has it after the part before.

    Poses of the path are the front end's, right within a part; an island has the number of the first of its parts.
    """
    poses, where, parts = path.poses, islands.poses, path.parts
    result, placed = where.copy(), np.ones(int(parts[-1]) + 1, np.bool_)
    for part in range(1, len(placed)):
        begin = int(np.searchsorted(parts, part))
        if islands.parts[begin] != part:
            continue  # joined to an earlier part
        placed[part] = False
        guess = compose(result[begin - 1], between(poses[begin - 1], poses[begin]))
        motion = compose(guess, inverse(where[begin]))
        own = islands.parts == part
        result[own] = compose(motion, where[own])
    return result, placed
