"""Held-out scans: those of a log that may score a run, and folds of training scans for the fits of baselines.

`unseen_scans` selects the scans of a log that a run has not used. `make_folds` splits the training scans: baselines are
fitted to the scans of each fold, predicted by a map of the others (`bayesmap.posterior.baselines`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Indices, Ints
from bayesmap.space.grid import Grid
from bayesmap.space.scans import ReadingKind, Scans

MAX_SUGGESTED_EVERY = 100  # largest hold-out period that an error message suggests
FOLDS = 10  # a fold has every tenth scan, as the held-out scans do: maps of the others are about as dense as the run's
FIT_BEAMS = 20_000  # valid beams for a fit: a dozen parameters over-fit by about 6 / 20 000 nats per beam
THIN = 4  # a rough search uses every fourth scan of a fold, or every fourth fold
PAST_READING_M = 3.0  # distance past a reading to which a beam is traced for fitting: its density is flat there


class NoneHeldOut(BadInput):
    """Error: the log is the run's own, and none of its scans can judge the map."""


def has_moved_scans(train: Scans, scans: Scans) -> bool:
    """Return whether a scan of a log has another pose than in the run, whose scans are ``train``."""
    match = match_scans(train, scans)
    used = match >= 0
    return not np.allclose(train.poses[match[used]], scans.poses[used], rtol=0.0, atol=1e-6)


def _is_thinned_from(train: Scans, scans: Scans) -> bool:
    """Return whether the run's scans have the stamps of a log's scans and fewer beams, as maps of `slam` have."""
    if train.stamps_s is None or scans.stamps_s is None or train.ranges_m.shape[1] >= scans.ranges_m.shape[1]:
        return False
    return bool(np.isin(train.stamps_s, scans.stamps_s).all())


def match_scans(train: Scans, scans: Scans) -> Indices:
    """Return the index of the run's scan with the stamp and readings of each scan, -1 if none has them, (S,)."""
    shared_angles = train.own_angles_rad is None and scans.own_angles_rad is None
    if shared_angles and not _equal_angles(train.angles_rad, scans.angles_rad):
        return np.full(len(scans), -1)
    stamped = train.stamps_s is not None and scans.stamps_s is not None
    # Match by fingerprints; then compare the angles of beams if scans have their own.
    index_of = {fingerprint: i for i, fingerprint in enumerate(_fingerprints(train, stamped))}
    match = np.array([index_of.get(fingerprint, -1) for fingerprint in _fingerprints(scans, stamped)], dtype=np.intp)
    if not shared_angles:
        for scan in np.flatnonzero(match >= 0):
            if not _equal_angles(train.beams_of(int(match[scan]))[0], scans.beams_of(int(scan))[0]):
                match[scan] = -1
    return match


def _equal_angles(first_rad: Floats, second_rad: Floats) -> bool:
    """Return whether two scans have as many beams, at the same angles up to rounding."""
    return first_rad.shape == second_rad.shape and np.allclose(first_rad, second_rad)


def _fingerprints(scans: Scans, stamped: bool) -> list[bytes]:
    """Return each scan's stamp and readings as bytes; with the pose if there is no stamp or no hit."""
    fingerprints = []
    for i in range(len(scans)):
        ranges = scans.beams_of(i)[1]
        identity = scans.stamps_s[i] if stamped and scans.stamps_s is not None else scans.poses[i]
        pose = b"" if np.isfinite(ranges).any() else scans.poses[i].tobytes()
        fingerprints.append(identity.tobytes() + pose + ranges.tobytes())
    return fingerprints


def unseen_scans(train: Scans, scans: Scans, every: int, log: str) -> Scans:
    """Return every ``every``-th scan of a log, as `Scans.holdout` does, or all if 0. ``log`` is its name for errors.

    Raises:
        NoneHeldOut: the run has used all scans, or has moved its scans, so that the poses of the others are unknown.
        BadInput: the run has used some of the held-out scans, which would bias the score; or it is another log.
    """
    used = match_scans(train, scans) >= 0
    if every == 0:
        if used.any():
            raise BadInput(
                f"{log}: the run was made from {used.sum():,} of its {len(scans):,} scans; --all is for another "
                "recording, and scans that were trained on would flatter the run; leave it out, or give --holdout"
            )
        return scans
    thinned = not used.any() and _is_thinned_from(train, scans)
    if not used.any() and not thinned:
        raise BadInput(
            f"{log}: none of the run's scans is in it: not the log that the run was made from, or read with another "
            "--no-return, topic or --deskew; to score another recording of the same place whole, give --all"
        )
    if thinned or has_moved_scans(train, scans):
        raise NoneHeldOut(
            f"{log}: the run has its scans elsewhere than this log, as bayesmap slam does, so none is left to judge "
            f"its map by; bayesmap score {log} --trajectory DIR/trajectory.tum judges a map along its path"
        )
    # Check that the run was made with this hold-out.
    held_out = np.arange(len(scans)) % max(every, 2) == every // 2
    if every < 2 or not held_out.any():
        scans.holdout(every)  # raises `BadInput`: every < 2, or too few scans
    if not (held_out & used).any():
        return scans.select(held_out)
    if used.all():
        raise NoneHeldOut(
            f"{log}: the run was made without holding scans out, so there is none to score it on; make one with "
            f"bayesmap infer --holdout {every}"
        )
    periods = [n for n in range(2, MAX_SUGGESTED_EVERY) if (~used == (np.arange(len(scans)) % n == n // 2)).all()]
    hint = f"it was made with --holdout {periods[0]}" if periods else "other scans were held out"
    raise BadInput(
        f"{log}: with --holdout {every} the run has seen {(held_out & used).sum():,} of the {held_out.sum():,} scans "
        f"that would score it; {hint}"
    )


@dataclass(frozen=True, eq=False)
class Fold:
    """A fold of the training scans: counts of the other scans, and the fold's own scans and beams."""

    hits: Floats  # hits of the other scans in each cell, (N,)
    passes: Floats  # beams of the other scans that pass each cell, (N,)
    scans: Scans  # the scans of the fold
    rays: Rays  # their beams

    @classmethod
    def of(cls, hits: Floats, passes: Floats, scans: Scans, grid: Grid) -> "Fold":
        """Trace the fold's beams, as far as their density varies."""
        from bayesmap.kernels.rays import trace_rays

        reach_m = np.where(np.isfinite(scans.ranges_m), scans.ranges_m + PAST_READING_M, scans.max_range_m).ravel()
        return cls(hits, passes, scans, trace_rays(scans, grid, reach_m=reach_m))

    def thinned(self) -> "Fold":
        """Return the fold with every `THIN`-th of its scans, for a rough search. The counts stay."""
        return Fold.of(self.hits, self.passes, self.scans.select(slice(None, None, THIN)), self.rays.grid)


def make_folds(train: Scans, grid: Grid) -> list[Fold]:
    """Make interleaved folds until they have `FIT_BEAMS` beams. Raises `BadInput` for too few scans."""
    from bayesmap.kernels.rays import count_hits

    folds: list[Fold] = []
    n_folds, n_beams = min(FOLDS, len(train)), 0
    if n_folds < 2:
        raise BadInput("score: baselines are fitted by holding out training scans, which takes two scans or more")
    hits, passes = count_hits(train, grid)
    # In a fixed random order, since `FIT_BEAMS` may end it early.
    for i in np.random.default_rng(0).permutation(n_folds).tolist():
        left_out = train.select(np.arange(len(train)) % n_folds == i)
        n_valid = int((left_out.readings != ReadingKind.INVALID).sum())
        if n_valid == 0:
            continue  # nothing can be scored
        own_hits, own_passes = count_hits(left_out, grid)
        folds.append(Fold.of((hits - own_hits).astype(float), (passes - own_passes).astype(float), left_out, grid))
        n_beams += n_valid
        if n_beams >= FIT_BEAMS:
            break
    if not folds:
        raise BadInput("score: none of the training scans has a valid reading to fit baselines on")
    return folds


def one_fold(train: Scans, grid: Grid) -> list[Fold]:
    """Make one fold of about `FIT_BEAMS` beams for a fixed map. Raises `BadInput` without a valid reading."""
    n_valid = (train.readings != ReadingKind.INVALID).sum(axis=1)
    usable = train.select(n_valid > 0)
    if len(usable) == 0:
        raise BadInput("score: none of the training scans has a valid reading to fit a sensor on")
    n_scans = min(len(usable), int(np.ceil(len(usable) * FIT_BEAMS / n_valid.sum())))
    no_counts = np.zeros(grid.n_cells)
    return [Fold.of(no_counts, no_counts, usable.select(np.arange(n_scans) * len(usable) // n_scans), grid)]


@dataclass(frozen=True, eq=False)
class JoinedFolds:
    """Folds whose beams are predicted together, each fold under its own map of the cells that its beams touch."""

    folds: tuple[Fold, ...]
    rays: Rays  # beams of all folds, one after the other
    columns: Ints  # index of each entry of the rays in the concatenated maps of the folds, (K,)


def join_folds(folds: Sequence[Fold]) -> JoinedFolds:
    """Join folds for one prediction, which is faster than many small ones."""
    by_fold = [fold.rays for fold in folds]
    # Offsets of each fold's entries in the joined rays, and of its cells in the joined maps.
    entry_offsets = np.cumsum([0, *(len(rays.cells) for rays in by_fold)])[:-1]
    cell_offsets = np.cumsum([0, *(len(rays.touched) for rays in by_fold)])[:-1]

    def joined(name: str, shifts: NDArray[np.int_]) -> Ints:
        arrays = zip(by_fold, shifts, strict=True)
        return np.concatenate([getattr(rays, name) + shift for rays, shift in arrays]).astype(np.int32)

    names = ("cells", "start_m", "direction", "range_m")
    unshifted = {name: np.concatenate([getattr(rays, name) for rays in by_fold]) for name in names}
    offsets = np.append(0, np.cumsum(np.concatenate([rays.lengths for rays in by_fold]))).astype(np.int32)
    first_near = joined("first_near", entry_offsets)
    rays = Rays(grid=by_fold[0].grid, offsets=offsets, first_near=first_near, limits=by_fold[0].limits, **unshifted)
    return JoinedFolds(tuple(folds), rays, joined("columns", cell_offsets))
