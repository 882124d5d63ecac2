"""Join the parts of a broken path by places that were seen from two parts.

At a break of the path the relative pose of the two parts is unknown: wheels slipped, scans are missing, or the robot
was carried. Submaps of each part are matched to those of all other parts, with any heading. They are matched near the
pose from a wide search or odometry, and everywhere. A relative pose of two parts is accepted if several pairs of places
agree on it, and no other relative pose has nearly as many votes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from bayesmap.kernels.match.line_pairs import Agreement, mutual_view_counts
from bayesmap.poses.loops import Closures, Fineness, KeyPath, concatenate_closures, match_submaps, no_closures
from bayesmap.space.arrays import Indices, Mask, evenly_spaced
from bayesmap.space.planar import Floats, are_within, between, compose, inverse, wrap_angle

NEAR_M = 3.0  # greatest distance of places of other parts that are compared near by, and half width of their windows
NEAR_PLACES = 6  # number of the nearest places of other parts that are compared
FAR_M = 3.0  # spacing along the path of places that are compared everywhere, and half width of their windows
SAME_VIEW_M, SAME_VIEW_RAD = 1.5, np.radians(45.0)  # a place this near an earlier one shows the same view

QUERY_SPACING_M = 1.0  # distance of query places along a part
MAX_PART_QUERIES, MAX_QUERIES = 24, 96  # most query places of a part, and of all parts
TURNS = 3  # turns over which query places are spread; later turns are skipped if earlier ones surely join all parts

COARSE = Fineness(60, np.radians(2.0))  # refinement uses whole scans: more would add little
NEAR_SCORE, FAR_SCORE = 0.6, 0.75  # least scores of matches; with more places, chance matches score better
CHANCE_SCORE = 0.5  # a place votes with the square of its score above this
MAX_TRIED = 6  # most relative poses of two parts that are tested against free space
MIN_PLACES = 3  # places that must agree on the relative pose of two parts in the last turn
MIN_PLACES_EARLIER = 4  # places that must agree on it in earlier turns
MIN_RIVAL_PLACES = 2  # places that must agree on a rival relative pose before the last turn
RIVAL_SHARE = 0.5  # share of the best pose's votes at which a rival makes it doubtful in the last turn
RIVAL_SHARE_EARLIER = 0.4  # the same in earlier turns
SAME_M, SAME_RAD = 0.5, np.radians(6.0)  # largest difference of equal relative poses: parts are bent
MET_M = 5.0  # greatest distance of compared key scans of two parts
MAX_COMPARED = 600  # most pairs of key scans that are compared
VIEW_AGREEMENT = Agreement(near_m=0.2, clear_m=0.4, beams=60)  # limits for scans of two parts
MAX_AGAINST_SHARE = 0.15  # largest share of contradicting points


@dataclass(frozen=True, eq=False)
class Joint:
    """A relative pose of two parts: ``motion`` transforms the later part's poses to the earlier part's frame."""

    earlier: int
    later: int
    motion: Floats
    votes: float


def rejoin(path: KeyPath, half_width_m: float) -> tuple[Floats, Mask]:
    """Join the parts of a path of K key scans whose poses are right within each part.

    Returns the poses with every joined part moved, (K, 3), and a mask of the parts that are joined to an earlier part,
    (P,). Part 0 counts as joined. ``half_width_m`` is the half width of submaps' grids.
    """
    matches, islands = [no_closures()], path
    for turn in range(TURNS):
        for pairs, half_m, min_score in (
            (_near_pairs(path, turn), NEAR_M, NEAR_SCORE),
            (_far_pairs(path, turn), FAR_M, FAR_SCORE),
        ):
            # Search with any heading: a half range of pi.
            ones = np.ones(len(pairs[0]))
            matches.append(match_submaps(path, *pairs, half_m * ones, np.pi * ones, half_width_m, min_score, COARSE))
        # Join by all matches so far.
        min_places = MIN_PLACES if turn == TURNS - 1 else MIN_PLACES_EARLIER
        islands = _join_parts(path, concatenate_closures(matches), min_places)
        if not islands.parts.any():
            break
    return _assemble(path, islands)


def _join_parts(path: KeyPath, matches: Closures, min_places: int) -> KeyPath:
    """Return the path with parts joined to islands if ``min_places`` places agree on their relative pose. The key scans
    of an island have the number of its first part, and poses in that part's frame.
    """
    islands, rival_share = path, RIVAL_SHARE if min_places == MIN_PLACES else RIVAL_SHARE_EARLIER
    while (joint := _surest_joint(_candidates(matches, islands, min_places), islands, rival_share)) is not None:
        later = islands.parts == joint.later
        islands = replace(
            islands,
            poses=np.where(later[:, None], compose(joint.motion, islands.poses), islands.poses),
            parts=np.where(later, joint.earlier, islands.parts),
        )
    return islands


def _surest_joint(pairs: Iterator[list[Joint]], islands: KeyPath, rival_share: float) -> Joint | None:
    """Return the consistent joint with the most votes whose rivals all have less than a share of its votes, or None."""
    best = None
    for candidates in pairs:
        if not candidates or (best is not None and candidates[0].votes <= best.votes):
            continue
        joints = [joint for joint in candidates if is_consistent(islands, joint)]
        if joints and (len(joints) == 1 or joints[1].votes < rival_share * joints[0].votes):
            best = joints[0] if best is None or joints[0].votes > best.votes else best
    return best


PlacePairs = tuple[Indices, Indices, Floats]
"""Keys of the first places, ascending, and of the second ones, (M,), and middles of windows in the first's frame."""


def _near_pairs(path: KeyPath, turn: int) -> PlacePairs:
    """Return pairs of a query place and the nearest places of longer parts, with windows at their present poses."""
    places, poses, rank = path.places(QUERY_SPACING_M), path.poses, _length_ranks(path)[path.parts]
    pairs: list[tuple[int, int]] = []
    for query in _queries(path, turn).tolist():
        others = places[rank[places] > rank[query]]
        distance_m = np.hypot(*(poses[others, :2] - poses[query, :2]).T)
        nearest = np.argsort(distance_m, kind="stable")[:NEAR_PLACES]
        pairs += [(place, query) for place in others[nearest[distance_m[nearest] < NEAR_M]].tolist()]
    # Sort by the first place, as `match_submaps` needs it.
    first, second = np.array(sorted(pairs, key=lambda pair: pair[0]), np.intp).reshape(-1, 2).T
    return first, second, between(poses[first], poses[second])


def _far_pairs(path: KeyPath, turn: int) -> PlacePairs:
    """Return pairs of a query place and every place of longer parts, with windows around the same pose."""
    places, rank = _distinct_views(path, path.places(FAR_M)), _length_ranks(path)[path.parts]
    first, second = (grid.ravel() for grid in np.meshgrid(places, _queries(path, turn), indexing="ij"))
    is_longer = rank[first] > rank[second]
    return first[is_longer], second[is_longer], np.zeros((int(is_longer.sum()), 3))


def _length_ranks(path: KeyPath) -> Indices:
    """Return the rank of each part by its number of key scans, (P,). The shorter part of a pair is searched for."""
    rank = np.empty(int(path.parts[-1]) + 1, np.intp)
    rank[np.lexsort((-np.arange(len(rank)), np.bincount(path.parts)))] = np.arange(len(rank))
    return rank


def _distinct_views(path: KeyPath, places: Indices) -> Indices:
    """Remove places that are near an earlier place of the same part, with a similar heading."""
    chosen: list[int] = []
    for place in places.tolist():
        same_view = are_within(between(path.poses[chosen], path.poses[place]), SAME_VIEW_M, SAME_VIEW_RAD)
        if not (same_view & (path.parts[chosen] == path.parts[place])).any():
            chosen.append(place)
    return np.array(chosen, np.intp)


def _queries(path: KeyPath, turn: int) -> Indices:
    """Return the query places of a turn, from all parts but the longest: every `TURNS`-th of an even selection."""
    places, rank = path.places(QUERY_SPACING_M), _length_ranks(path)
    most = min(MAX_PART_QUERIES, max(2 * MIN_PLACES, MAX_QUERIES // max(1, len(rank) - 1)))
    shorter = np.nonzero(rank < len(rank) - 1)[0]
    queries = [evenly_spaced(places[path.parts[places] == part], most)[turn::TURNS] for part in shorter]
    return np.concatenate([np.empty(0, np.intp), *queries])


def _candidates(matches: Closures, islands: KeyPath, min_places: int) -> Iterator[list[Joint]]:
    """Yield the relative poses of each pair of parts on which ``min_places`` places or more agree, most votes first."""
    poses, parts = islands.poses, islands.parts
    # Each match implies a motion of the later part. Here the later part is the one with the higher number.
    motions = compose(compose(poses[matches.first], matches.relative), inverse(poses[matches.second]))
    swapped = parts[matches.first] > parts[matches.second]
    motions = np.where(swapped[:, None], inverse(motions), motions)
    later_keys = np.where(swapped, matches.first, matches.second)
    pairs = np.sort(np.stack([parts[matches.first], parts[matches.second]], axis=1), axis=1)
    for earlier, later in np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0):
        own = np.nonzero((pairs == (earlier, later)).all(axis=1))[0]
        # Compare motions by the positions to which they bring the keys: a turn about a far origin moves them much.
        moved = compose(motions[own][:, None], poses[later_keys[own]][None])
        off_m = np.hypot(*np.moveaxis((moved - moved.diagonal().T[None])[..., :2], -1, 0))
        turns = np.abs(wrap_angle(motions[own][:, None, 2] - motions[own][None, :, 2]))
        agree = (off_m < SAME_M) & (turns < SAME_RAD)
        # Each place has one vote, by its best match: votes are (motions, matches), then (motions, places).
        places, place = np.unique(matches.second[own], return_inverse=True)
        match_votes = np.where(agree, (matches.scores[own][None] - CHANCE_SCORE) ** 2, 0.0)
        # Take the motion with the most votes, remove the matches that agree with it, and repeat.
        joints: list[Joint] = []
        least = min_places
        while len(joints) < MAX_TRIED:
            place_votes = np.stack([match_votes[:, place == k].max(axis=1) for k in range(len(places))], axis=1)
            votes = np.where((place_votes > 0.0).sum(axis=1) >= least, place_votes.sum(axis=1), 0.0)
            best = int(np.argmax(votes))
            if not votes[best] > 0.0:
                break
            joints.append(Joint(int(earlier), int(later), motions[own[best]], float(votes[best])))
            match_votes[:, agree[best]] = 0.0
            least = MIN_PLACES if min_places == MIN_PLACES else MIN_RIVAL_PLACES
        yield joints


def is_consistent(islands: KeyPath, joint: Joint) -> bool:
    """Check that two joined parts do not contradict each other: few points of one lie in the other's free space."""
    # Select near pairs of key scans, evenly thinned.
    geometry = islands.geometry
    earlier, later = (np.nonzero(islands.parts == part)[0] for part in (joint.earlier, joint.later))
    earlier_poses, later_poses = islands.poses[earlier], compose(joint.motion, islands.poses[later])
    off = earlier_poses[:, None, :2] - later_poses[None, :, :2]
    a, b = evenly_spaced(np.argwhere(np.hypot(off[..., 0], off[..., 1]) < MET_M), MAX_COMPARED).T
    counts = mutual_view_counts(
        geometry, islands.scans(earlier[a]), islands.scans(later[b]), between(earlier_poses[a], later_poses[b]),
        VIEW_AGREEMENT, geometry.threads,
    )  # fmt: skip
    matched, against, _ = counts.sum(axis=0)
    return bool(against <= MAX_AGAINST_SHARE * (matched + against))


def _assemble(path: KeyPath, islands: KeyPath) -> tuple[Floats, Mask]:
    """Bring all islands to one frame. Returns poses, (K, 3), and which parts are joined to an earlier part, (P,). An
    island has the number of its first part. If it is not joined, it keeps its motion from the part before on ``path``.
    """
    poses, parts = path.poses, path.parts
    result, joined = islands.poses.copy(), np.ones(int(parts[-1]) + 1, np.bool_)
    for part in range(1, len(joined)):
        begin = int(np.searchsorted(parts, part))
        if islands.parts[begin] != part:
            continue  # joined to an earlier part
        joined[part] = False
        guess = compose(result[begin - 1], between(poses[begin - 1], poses[begin]))
        motion = compose(guess, inverse(islands.poses[begin]))
        own = islands.parts == part
        result[own] = compose(motion, islands.poses[own])
    return result, joined
