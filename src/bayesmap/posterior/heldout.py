"""Which scans of a log may judge a run: those that it has not seen."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.scans import Scans

MOST_EVERY = 100


def seen_by(train: Scans, scans: Scans) -> NDArray[np.bool_]:
    """Which scans are among those of a run: same pose, same readings; shape (S,)."""
    if train.angles_rad.shape != scans.angles_rad.shape or not np.allclose(train.angles_rad, scans.angles_rad):
        return np.zeros(len(scans), dtype=np.bool_)
    known = set(_fingerprints(train))
    return np.array([one in known for one in _fingerprints(scans)], dtype=np.bool_)


def _fingerprints(scans: Scans) -> list[bytes]:
    return [pose.tobytes() + ranges.tobytes() for pose, ranges in zip(scans.poses, scans.ranges_m, strict=True)]


def unseen_scans(train: Scans, scans: Scans, every: int, where: str) -> Scans:
    """Every ``every``-th scan of a log, as `Scans.holdout` takes them, if the run has seen none of them.

    Args:
        train: what the run was made from.
        scans: the whole log, read as it was for the run.
        every: of the hold-out; 0 takes all scans, for another recording of the same place.
        where: the log's name, for messages.

    Raises:
        BadInput: the run has seen some of them, so that the score would flatter it.
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
    held = np.arange(len(scans)) % every == every // 2 if every >= 2 else None
    if held is None or not held.any():
        scans.holdout(every)  # says what is wrong
    assert held is not None
    if not (held & seen).any():
        return scans.select(held)
    if seen.all():
        raise BadInput(
            f"{where}: the run was made without holding scans out, so there is none to score it on; make one with "
            f"bayesmap infer --holdout {every}"
        )
    fitting = [n for n in range(2, MOST_EVERY) if (~seen == (np.arange(len(scans)) % n == n // 2)).all()]
    hint = f"it was made with --holdout {fitting[0]}" if fitting else "other scans were held out"
    raise BadInput(
        f"{where}: with --holdout {every} the run has seen {(held & seen).sum():,} of the {held.sum():,} scans that "
        f"would score it; {hint}"
    )
