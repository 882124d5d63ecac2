"""Select the scans of a log that may score a run: those that it has not seen."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.scans import Scans

MOST_EVERY = 100


class NoneHeldOut(BadInput):
    """The log is the run's own, and none of its scans can judge the map."""


def seen_by(train: Scans, scans: Scans) -> NDArray[np.bool_]:
    """Return which scans are among those of a run, by stamps and readings, (S,).

    Poses do not count, since a run may have inferred them, except where scans have no stamps, or no hit, to tell them
    apart by.
    """
    return _matched(train, scans) >= 0


def moved_by(train: Scans, scans: Scans) -> bool:
    """Return whether scans that are among those of a run have other poses there."""
    match = _matched(train, scans)
    seen = match >= 0
    return not np.allclose(train.poses[match[seen]], scans.poses[seen], rtol=0.0, atol=1e-6)


def _matched(train: Scans, scans: Scans) -> NDArray[np.intp]:
    """Return the run's scan that equals each scan, -1 if none, (S,)."""
    shared = train.own_angles_rad is None and scans.own_angles_rad is None
    if shared and not _alike(train.angles_rad, scans.angles_rad):
        return np.full(len(scans), -1)
    stamped = train.stamps_s is not None and scans.stamps_s is not None
    known = {name: i for i, name in enumerate(_fingerprints(train, stamped))}
    match = np.array([known.get(name, -1) for name in _fingerprints(scans, stamped)], dtype=np.intp)
    if not shared:
        for scan in np.flatnonzero(match >= 0):
            if not _alike(train.beams_of(int(match[scan]))[0], scans.beams_of(int(scan))[0]):
                match[scan] = -1
    return match


def _alike(some: NDArray[np.float64], others: NDArray[np.float64]) -> bool:
    """Return whether the beams of two scans point the same way."""
    return some.shape == others.shape and np.allclose(some, others)


def _fingerprints(scans: Scans, stamped: bool) -> list[bytes]:
    """Return the readings with their stamp; with their pose where there is no stamp, or where no beam met anything."""
    names = []
    for i in range(len(scans)):
        ranges = scans.beams_of(i)[1]
        at = scans.stamps_s[i] if stamped and scans.stamps_s is not None else scans.poses[i]
        pose = b"" if np.isfinite(ranges).any() else scans.poses[i].tobytes()
        names.append(at.tobytes() + pose + ranges.tobytes())
    return names


def unseen_scans(train: Scans, scans: Scans, every: int, where: str) -> Scans:
    """Return every ``every``-th scan of a log, as `Scans.holdout` takes them, if the run has seen none of them.

    Args:
        train: what the run was made from.
        scans: the whole log, read as it was for the run.
        every: of the hold-out; 0 takes all scans, for another recording of the same place.
        where: the log's name, for messages.

    Raises:
        NoneHeldOut: the run has seen all scans, or has moved them, so that the poses of the others are
            unknown.
        BadInput: the run has seen some of them, so that the score would flatter it; or it is another log.
    """
    seen = seen_by(train, scans)
    if every == 0:
        if seen.any():
            raise BadInput(
                f"{where}: the run was made from {seen.sum():,} of its {len(scans):,} scans; --all is for another "
                "recording, and scans that were trained on would flatter the run; leave it out, or give --holdout"
            )
        return scans
    if not seen.any():
        raise BadInput(
            f"{where}: none of the run's scans is in it: not the log that the run was made from, or read with another "
            "--no-return, topic or --deskew; to score another recording of the same place whole, give --all"
        )
    if moved_by(train, scans):
        raise NoneHeldOut(
            f"{where}: the run has its scans elsewhere than this log, as bayesmap slam does, so none is left to judge "
            f"its map by; bayesmap score {where} --trajectory DIR/trajectory.tum judges a map along its path"
        )
    held = np.arange(len(scans)) % every == every // 2 if every >= 2 else None
    if held is None or not held.any():
        scans.holdout(every)  # says what is wrong
    assert held is not None
    if not (held & seen).any():
        return scans.select(held)
    if seen.all():
        raise NoneHeldOut(
            f"{where}: the run was made without holding scans out, so there is none to score it on; make one with "
            f"bayesmap infer --holdout {every}"
        )
    fitting = [n for n in range(2, MOST_EVERY) if (~seen == (np.arange(len(scans)) % n == n // 2)).all()]
    hint = f"it was made with --holdout {fitting[0]}" if fitting else "other scans were held out"
    raise BadInput(
        f"{where}: with --holdout {every} the run has seen {(held & seen).sum():,} of the {held.sum():,} scans that "
        f"would score it; {hint}"
    )
