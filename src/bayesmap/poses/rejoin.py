"""Join the parts of a broken path by places that were seen from two of them.

At a break of the path the relative pose of the two parts is unknown: wheels slipped, scans are missing, or the robot
was carried. Submaps of each part are matched to those of all other parts, with any heading. They are matched near the
pose from a wide search or odometry, and everywhere. A relative pose of two parts is accepted if several pairs of places
agree on it, and no other relative pose has nearly as many votes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import Agreement, mutual_view_counts
from bayesmap.poses.loops import Closures, Fineness, KeyPath, joined, match_submaps, no_closures
from bayesmap.space.planar import Floats, between, compose, inverse, wrap_angle

NEAR_M, NEAR_PLACES = 3.0, 6  # distance and number of the nearest places of other parts that are compared

EVERYWHERE_M, SAME_PLACE_M, SAME_VIEW_RAD = 3.0, 1.5, np.radians(45.0)
"""Each place is also compared with places everywhere. The first number is their distance along the path, and the half
width of these windows, metres. A place within the second and third number of an earlier one shows the same view, and is
left out."""

SPACING_M, QUERIES, QUERIES_IN_ALL, TURNS = 1.0, 24, 96, 3
"""Query places: their distance along a part, metres, the most per part and in all parts, and the turns over which they
are spread. Later turns are skipped if earlier turns surely join all parts."""

COARSE = Fineness(60, np.radians(2.0))  # refinement uses whole scans: more would add little
NEAR_SCORE, FAR_SCORE = 0.6, 0.75  # least scores of matches; with more places, chance matches score better
CHANCE = 0.5  # a place votes with the square of its score above this
TRIED = 6  # most relative poses of two parts that are tested against free space
MIN_PLACES = 3  # places that must agree on the relative pose of two parts in the last turn
MIN_PLACES_EARLIER = 4  # places that must agree on it in earlier turns
MIN_RIVAL_PLACES = 2  # places that must agree on a rival relative pose before the last turn
RIVAL, RIVAL_EARLY = 0.5, 0.4  # share of the best pose's votes at which a rival makes it doubtful: last turn, earlier
SAME_M, SAME_RAD = 0.5, np.radians(6.0)  # largest difference of equal relative poses: parts are bent
MET_M, COMPARED = 5.0, 600  # distance of compared key scans of two parts, and most pairs of them
SEEN, MOST_AGAINST = Agreement(near_m=0.2, clear_m=0.4, beams=60), 0.15  # of scans of two parts; most against


@dataclass(frozen=True, eq=False)
class Joint:
    """A relative pose of two parts: ``motion`` transforms the later part's poses to the earlier part's frame."""

    earlier: int
    later: int
    motion: Floats
    votes: float


def rejoin(path: KeyPath, half_width_m: float) -> tuple[Floats, NDArray[np.bool_]]:
    """Join the parts of a path of K key scans whose poses are right within each part.

    Returns the poses with every joined part moved, (K, 3), and a mask of the parts that are joined to an earlier part,
    (P,). Part 0 counts as joined. ``half_width_m`` is the half width of submaps' grids.
    """
    parts, islands = [no_closures()], path
    for turn in range(TURNS):
        for (first, second, centres), half_m, least in (
            (_near_pairs(path, turn), NEAR_M, NEAR_SCORE),
            (_all_pairs(path, turn), EVERYWHERE_M, FAR_SCORE),
        ):
            # Search with any heading: a half range of pi.
            every = np.ones(len(first))
            windows = centres, half_m * every, np.pi * every
            parts.append(match_submaps(path, first, second, *windows, half_width_m, least, COARSE))
        # Join by all matches so far.
        islands = _together(path, joined(parts), MIN_PLACES if turn == TURNS - 1 else MIN_PLACES_EARLIER)
        if not islands.parts.any():
            break
    return _assembled(path, islands)


def _together(path: KeyPath, closures: Closures, agree: int) -> KeyPath:
    """Return the path with parts joined to islands if ``agree`` places agree on their relative pose. The key scans of
    an island have the number of its first part, and poses in that part's frame.
    """
    islands = path
    while True:
        rival = RIVAL if agree == MIN_PLACES else RIVAL_EARLY
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
    """Return the consistent joint with the most votes that has no rival with at least a share of its votes, or None."""
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


Windows = tuple[NDArray[np.intp], NDArray[np.intp], Floats]  # keys, first ascending; middles (first's frame)


def _near_pairs(path: KeyPath, turn: int) -> Windows:
    """Return pairs of a query place and the nearest places of longer parts, with windows at their present poses."""
    places, poses = path.places(SPACING_M), path.poses
    first, second = [], []
    for query in _queries(path, turn):
        others = places[_longer(path)[path.parts[places]] > _longer(path)[path.parts[query]]]
        off = np.hypot(*(poses[others, :2] - poses[query, :2]).T)
        near = others[off < NEAR_M]
        near = near[np.argsort(off[off < NEAR_M], kind="stable")][:NEAR_PLACES]
        first += near.tolist()
        second += [int(query)] * len(near)
    # Sort by the first place, as `match_submaps` needs it.
    one, two = np.array(first, np.intp), np.array(second, np.intp)
    order = np.argsort(one, kind="stable")
    one, two = one[order], two[order]
    return one, two, between(poses[one], poses[two])


def _all_pairs(path: KeyPath, turn: int) -> Windows:
    """Return pairs of a query place and every place of longer parts, with windows around the same pose."""
    places = _different(path, path.places(EVERYWHERE_M))
    one, two = (grid.ravel() for grid in np.meshgrid(places, _queries(path, turn), indexing="ij"))
    apart = _longer(path)[path.parts[one]] > _longer(path)[path.parts[two]]
    return one[apart], two[apart], np.zeros((int(apart.sum()), 3))


def _longer(path: KeyPath) -> NDArray[np.intp]:
    """Return the rank of each part by its number of key scans, (P,). The shorter part of a pair is searched for."""
    rank = np.empty(int(path.parts[-1]) + 1, np.intp)
    rank[np.lexsort((-np.arange(len(rank)), np.bincount(path.parts)))] = np.arange(len(rank))
    return rank


def _different(path: KeyPath, places: NDArray[np.intp]) -> NDArray[np.intp]:
    """Remove places that are near an earlier place of the same part, with a similar heading."""
    chosen: list[int] = []
    for place in places:
        off = between(path.poses[chosen], path.poses[place])
        again = (np.hypot(off[:, 0], off[:, 1]) < SAME_PLACE_M) & (np.abs(off[:, 2]) < SAME_VIEW_RAD)
        if not (again & (path.parts[chosen] == path.parts[place])).any():
            chosen.append(int(place))
    return np.array(chosen, np.intp)


def _queries(path: KeyPath, turn: int) -> NDArray[np.intp]:
    """Return the query places of a turn, from all parts but the longest: every `TURNS`-th of an even selection."""
    places, count = path.places(SPACING_M), int(path.parts[-1]) + 1
    most, rank = min(QUERIES, max(2 * MIN_PLACES, QUERIES_IN_ALL // max(1, count - 1))), _longer(path)
    queries = [np.empty(0, np.intp)]
    for part in np.nonzero(rank < count - 1)[0]:
        own = places[path.parts[places] == part]
        queries.append((own if len(own) <= most else own[np.arange(most) * len(own) // most])[turn::TURNS])
    return np.concatenate(queries)


def _candidates(closures: Closures, islands: KeyPath, agree: int) -> Iterator[list[Joint]]:
    """Yield the relative poses of each pair of parts on which at least ``agree`` places agree, most votes first."""
    poses, parts = islands.poses, islands.parts
    # Each match implies a motion of the later part. Here the later part is the one with the higher number.
    motions = compose(compose(poses[closures.first], closures.relative), inverse(poses[closures.second]))
    swapped = parts[closures.first] > parts[closures.second]
    motions = np.where(swapped[:, None], inverse(motions), motions)
    brought = np.where(swapped, closures.first, closures.second)
    pairs = np.sort(np.stack([parts[closures.first], parts[closures.second]], axis=1), axis=1)
    for earlier, later in np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0):
        own = np.nonzero((pairs == (earlier, later)).all(axis=1))[0]
        # Compare motions by the positions to which they bring the keys: a turn about a far origin moves them much.
        at = compose(motions[own][:, None], poses[brought[own]][None])
        off = np.hypot(*np.moveaxis((at - at[np.arange(len(own)), np.arange(len(own))][None])[..., :2], -1, 0))
        turn = np.abs(wrap_angle(motions[own][:, None, 2] - motions[own][None, :, 2]))
        same = (off < SAME_M) & (turn < SAME_RAD)
        # Each place has one vote, that of its best match.
        places, voice = np.unique(closures.second[own], return_inverse=True)
        loud = np.where(same, (closures.scores[own][None] - CHANCE) ** 2, 0.0)
        # Take the motion with the most votes, remove the matches that agree with it, and repeat.
        joints: list[Joint] = []
        least = agree
        while len(joints) < TRIED:
            heard = np.stack([loud[:, voice == k].max(axis=1) for k in range(len(places))], axis=1)
            votes = np.where((heard > 0.0).sum(axis=1) >= least, heard.sum(axis=1), 0.0)
            best = int(np.argmax(votes))
            if not votes[best] > 0.0:
                break
            joints.append(Joint(int(earlier), int(later), motions[own[best]], float(votes[best])))
            loud[:, same[best]] = 0.0
            least = MIN_PLACES if agree == MIN_PLACES else MIN_RIVAL_PLACES
        yield joints


def consistent(islands: KeyPath, joint: Joint) -> bool:
    """Check that two joined parts do not contradict each other: few points of one lie in the other's free space."""
    # Select near pairs of key scans, evenly thinned to `COMPARED`.
    one, two = np.nonzero(islands.parts == joint.earlier)[0], np.nonzero(islands.parts == joint.later)[0]
    earlier, later = islands.poses[one], compose(joint.motion, islands.poses[two])
    a, b = np.nonzero(np.hypot(*np.moveaxis(earlier[:, None, :2] - later[None, :, :2], -1, 0)) < MET_M)
    kept = np.arange(min(len(a), COMPARED)) * len(a) // max(1, min(len(a), COMPARED))
    a, b = a[kept], b[kept]
    scans, seen, geometry = (
        (islands.scans(one[a]), islands.scans(two[b])), between(earlier[a], later[b]), islands.geometry,
    )  # fmt: skip
    matched, against, _ = mutual_view_counts(geometry, *scans, seen, SEEN, geometry.threads).sum(axis=0)
    return bool(against <= MOST_AGAINST * (matched + against))


def _assembled(path: KeyPath, islands: KeyPath) -> tuple[Floats, NDArray[np.bool_]]:
    """Bring all islands to one frame. Returns poses, (K, 3), and which parts are joined to an earlier part, (P,).

    An island that is not joined keeps the front end's motion from the part before. ``path`` has the front end's poses,
    which are right within a part. An island has the number of its first part.
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
