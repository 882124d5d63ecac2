"""Reconnect the segments of a broken path by places that were seen from two segments.

At a break of the path the relative pose of the two segments is unknown: wheels slipped, scans are missing, or the robot
was carried. `reconnect_segments` works in three steps, in the order of this file. Match submaps of each segment to
those of longer segments, with any heading: near the front end's guess (`_near_pairs`) and everywhere (`_far_pairs`).
Let places vote for relative poses, and merge two segments if one pose clearly wins (`_merge_segments`). Bring the
merged segments to one frame (`_assemble`).
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from bayesmap.kernels.match.view_comparison import Agreement, mutual_view_counts
from bayesmap.poses.loops import Closures, Fineness, KeyPath, concatenate_closures, match_submaps, no_closures
from bayesmap.space.arrays import Indices, Mask, evenly_spaced
from bayesmap.space.planar import Floats, are_within, between, compose, inverse, wrap_angle

PASSES = 3  # passes over which query places are spread; later ones are skipped once all segments are merged
NEAR_M = 3.0  # maximum distance of places that are compared near by, and half width of their windows
NEAR_PLACES = 6  # number of the nearest places of other segments that are compared
FAR_M = 3.0  # spacing along the path of places that are compared everywhere, and half width of their windows
SAME_VIEW_M, SAME_VIEW_RAD = 1.5, np.radians(45.0)  # a place this near an earlier one shows the same view
QUERY_SPACING_M = 1.0  # distance of query places along a segment
MAX_SEGMENT_QUERIES, MAX_QUERIES = 24, 96  # most query places of a segment, and of all segments
COARSE = Fineness(60, np.radians(2.0))  # refinement uses whole scans: more would add little
MIN_NEAR_SCORE, MIN_FAR_SCORE = 0.6, 0.75  # least scores: with more places, chance matches score better
CHANCE_SCORE = 0.5  # score of chance matches: a place votes with the square of its excess
MAX_HYPOTHESES = 6  # most relative poses of two segments that are tested against free space
MIN_PLACES = 3  # fewest places that agree on a relative pose, in the last pass
SAME_M, SAME_RAD = 0.5, np.radians(6.0)  # maximum difference of equal relative poses: segments are bent
COMPARED_M = 5.0  # maximum distance of compared key scans of two segments
MAX_COMPARED = 600  # most pairs of key scans that are compared
VIEW_AGREEMENT = Agreement(near_m=0.2, clear_m=0.4, beams=60)  # limits when scans of two segments are compared
MAX_AGAINST_SHARE = 0.15  # largest share of contradicting points


class MergeRule(NamedTuple):
    """The certainty that a merge needs."""

    min_places: int  # fewest places that agree on the relative pose
    min_rival_places: int  # fewest places that agree on a rival relative pose
    max_rival_share: float  # a rival with this share of the best pose's votes casts doubt


EARLIER_PASSES = MergeRule(min_places=4, min_rival_places=2, max_rival_share=0.4)  # strict: more matches may follow
LAST_PASS = MergeRule(MIN_PLACES, min_rival_places=MIN_PLACES, max_rival_share=0.5)


@dataclass(frozen=True, eq=False)
class Merge:
    """A hypothesis of the relative pose of two segments, by which they can be merged."""

    earlier: int  # number of the earlier segment
    later: int
    motion: Floats  # pose of the later segment's frame in the earlier segment's frame, (3,)
    votes: float  # weighted number of places that agree on the motion


def reconnect_segments(path: KeyPath, half_width_m: float) -> tuple[Floats, Mask]:
    """Merge the segments of a path of K key scans whose poses are right within each segment.
    Returns the poses with every merged segment moved, (K, 3), and a mask of the segments that are joined to an earlier
    segment, (P,). Segment 0 counts as joined. ``half_width_m`` is the half width of submaps' grids.
    """
    matches, islands = [no_closures()], path
    for search_pass in range(PASSES):
        for pairs, half_m, min_score in (
            (_near_pairs(path, search_pass), NEAR_M, MIN_NEAR_SCORE),
            (_far_pairs(path, search_pass), FAR_M, MIN_FAR_SCORE),
        ):
            # Search with any heading: a half range of pi.
            ones = np.ones(len(pairs[0]))
            matches.append(match_submaps(path, *pairs, half_m * ones, np.pi * ones, half_width_m, min_score, COARSE))
        # Merge by all matches so far.
        rule = LAST_PASS if search_pass == PASSES - 1 else EARLIER_PASSES
        islands = _merge_segments(path, concatenate_closures(matches), rule)
        if not islands.segments.any():
            break
    return _assemble(path, islands)


PlacePairs = tuple[Indices, Indices, Floats]
"""Keys of the first places, ascending, and of the second ones, (M,), and middles of windows in the first's frame."""


def _near_pairs(path: KeyPath, search_pass: int) -> PlacePairs:
    """Return pairs of a query place and the nearest places of longer segments, with windows at their present poses."""
    places, poses, rank = path.places(QUERY_SPACING_M), path.poses, _length_ranks(path)[path.segments]
    pairs: list[tuple[int, int]] = []
    for query in _queries(path, search_pass).tolist():
        others = places[rank[places] > rank[query]]
        distance_m = np.hypot(*(poses[others, :2] - poses[query, :2]).T)
        nearest = np.argsort(distance_m, kind="stable")[:NEAR_PLACES]
        pairs += [(place, query) for place in others[nearest[distance_m[nearest] < NEAR_M]].tolist()]
    # Sort by the first place, as `match_submaps` needs it.
    first, second = np.array(sorted(pairs, key=lambda pair: pair[0]), np.intp).reshape(-1, 2).T
    return first, second, between(poses[first], poses[second])


def _far_pairs(path: KeyPath, search_pass: int) -> PlacePairs:
    """Return pairs of a query place and every place of longer segments, with windows around equal poses."""
    places, rank = _distinct_views(path, path.places(FAR_M)), _length_ranks(path)[path.segments]
    first, second = (grid.ravel() for grid in np.meshgrid(places, _queries(path, search_pass), indexing="ij"))
    is_longer = rank[first] > rank[second]
    return first[is_longer], second[is_longer], np.zeros((int(is_longer.sum()), 3))


def _length_ranks(path: KeyPath) -> Indices:
    """Return the rank of each segment by its number of key scans, (P,). The shorter one of a pair is searched for."""
    rank = np.empty(int(path.segments[-1]) + 1, np.intp)
    rank[np.lexsort((-np.arange(len(rank)), np.bincount(path.segments)))] = np.arange(len(rank))
    return rank


def _distinct_views(path: KeyPath, places: Indices) -> Indices:
    """Remove places that are near an earlier place of the same segment, with a similar heading."""
    selected: list[int] = []
    for place in places.tolist():
        same_view = are_within(between(path.poses[selected], path.poses[place]), SAME_VIEW_M, SAME_VIEW_RAD)
        if not (same_view & (path.segments[selected] == path.segments[place])).any():
            selected.append(place)
    return np.array(selected, np.intp)


def _queries(path: KeyPath, search_pass: int) -> Indices:
    """Return the query places of a pass, from all segments but the longest: every `PASSES`-th of an even selection."""
    places, rank = path.places(QUERY_SPACING_M), _length_ranks(path)
    max_queries = min(MAX_SEGMENT_QUERIES, max(2 * MIN_PLACES, MAX_QUERIES // max(1, len(rank) - 1)))
    shorter = [places[path.segments[places] == segment] for segment in np.nonzero(rank < len(rank) - 1)[0]]
    queries = [evenly_spaced(candidates, max_queries)[search_pass::PASSES] for candidates in shorter]
    return np.concatenate([np.empty(0, np.intp), *queries])


def _merge_segments(path: KeyPath, matches: Closures, rule: MergeRule) -> KeyPath:
    """Return the path with segments merged to islands where enough places agree on their relative pose.
    The key scans of an island have the number of its first segment, and poses in that segment's frame.
    """
    islands = path
    while True:
        merge = _select_merge(_propose_merges(matches, islands, rule), islands, rule.max_rival_share)
        if merge is None:
            return islands
        is_later = islands.segments == merge.later
        poses = np.where(is_later[:, None], compose(merge.motion, islands.poses), islands.poses)
        islands = replace(islands, poses=poses, segments=np.where(is_later, merge.earlier, islands.segments))


def _select_merge(proposals: Iterator[list[Merge]], islands: KeyPath, max_rival_share: float) -> Merge | None:
    """Return the consistent merge with the most votes whose rivals all have less than a share of its votes, or None."""
    best = None
    for hypotheses in proposals:
        if not hypotheses or (best is not None and hypotheses[0].votes <= best.votes):
            continue
        consistent = [merge for merge in hypotheses if is_consistent(islands, merge)]
        if not consistent or (len(consistent) > 1 and consistent[1].votes >= max_rival_share * consistent[0].votes):
            continue
        if best is None or consistent[0].votes > best.votes:
            best = consistent[0]
    return best


def _propose_merges(matches: Closures, islands: KeyPath, rule: MergeRule) -> Iterator[list[Merge]]:
    """Yield the relative poses of each pair of segments on which enough places agree, most votes first."""
    poses, segments = islands.poses, islands.segments
    # Each match implies a motion of the later segment. Here the later segment is the one with the higher number.
    motions = compose(compose(poses[matches.first], matches.relative), inverse(poses[matches.second]))
    is_swapped = segments[matches.first] > segments[matches.second]
    motions = np.where(is_swapped[:, None], inverse(motions), motions)
    later_keys = np.where(is_swapped, matches.first, matches.second)
    pairs = np.sort(np.stack([segments[matches.first], segments[matches.second]], axis=1), axis=1)
    for earlier, later in np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0):
        selected = np.nonzero((pairs == (earlier, later)).all(axis=1))[0]
        pair_motions = motions[selected]
        # Compare motions by the positions to which they bring the keys: a turn about a far origin moves them much.
        # moved[i, j] is key j under motion i; the diagonal has each key under its own motion.
        moved = compose(pair_motions[:, None], poses[later_keys[selected]][None])
        off_m = np.hypot(*np.moveaxis((moved - moved.diagonal().T[None])[..., :2], -1, 0))
        turns_rad = np.abs(wrap_angle(pair_motions[:, None, 2] - pair_motions[None, :, 2]))
        agree = (off_m < SAME_M) & (turns_rad < SAME_RAD)
        # Each place has one vote, by its best match: votes are (motions, matches), then (motions, places).
        places, place = np.unique(matches.second[selected], return_inverse=True)
        match_votes = np.where(agree, (matches.scores[selected][None] - CHANCE_SCORE) ** 2, 0.0)
        # Take the motion with the most votes, remove the matches that agree with it, and repeat.
        merges: list[Merge] = []
        min_agreeing = rule.min_places
        while len(merges) < MAX_HYPOTHESES:
            place_votes = np.stack([match_votes[:, place == k].max(axis=1) for k in range(len(places))], axis=1)
            votes = np.where((place_votes > 0.0).sum(axis=1) >= min_agreeing, place_votes.sum(axis=1), 0.0)
            best = int(np.argmax(votes))
            if not votes[best] > 0.0:
                break
            merges.append(Merge(int(earlier), int(later), pair_motions[best], float(votes[best])))
            match_votes[:, agree[best]] = 0.0
            min_agreeing = rule.min_rival_places
        yield merges


def is_consistent(islands: KeyPath, merge: Merge) -> bool:
    """Return whether two merged segments agree: few points of one lie in the free space of the other."""
    # Select near pairs of key scans, evenly thinned.
    geometry = islands.geometry
    earlier = np.nonzero(islands.segments == merge.earlier)[0]
    later = np.nonzero(islands.segments == merge.later)[0]
    earlier_poses, later_poses = islands.poses[earlier], compose(merge.motion, islands.poses[later])
    off_m = earlier_poses[:, None, :2] - later_poses[None, :, :2]
    a, b = evenly_spaced(np.argwhere(np.hypot(off_m[..., 0], off_m[..., 1]) < COMPARED_M), MAX_COMPARED).T
    counts = mutual_view_counts(
        geometry, islands.scans(earlier[a]), islands.scans(later[b]), between(earlier_poses[a], later_poses[b]),
        VIEW_AGREEMENT, geometry.threads,
    )  # fmt: skip
    matched, against, _ = counts.sum(axis=0)
    return bool(against <= MAX_AGAINST_SHARE * (matched + against))


def _assemble(path: KeyPath, islands: KeyPath) -> tuple[Floats, Mask]:
    """Bring all islands to one frame. Returns poses, (K, 3), and a mask of segments joined to an earlier one, (P,)."""
    poses, segments = path.poses, path.segments
    result, joined = islands.poses.copy(), np.ones(int(segments[-1]) + 1, np.bool_)
    for segment in range(1, len(joined)):
        begin = int(np.searchsorted(segments, segment))
        if islands.segments[begin] != segment:
            continue  # joined to an earlier segment
        joined[segment] = False  # keep its motion from the segment before on ``path``
        guess = compose(result[begin - 1], between(poses[begin - 1], poses[begin]))
        motion = compose(guess, inverse(islands.poses[begin]))
        is_moved = islands.segments == segment
        result[is_moved] = compose(motion, islands.poses[is_moved])
    return result, joined
