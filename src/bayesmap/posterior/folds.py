"""Leave training scans out of a map and predict them, to fit baselines and external maps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Reading, Scans

Floats = NDArray[np.float64]

FOLDS = 10
"""Every tenth scan, as in the protocol itself: inner and outer counts are nearly as dense."""

BEAMS_WANTED = 20_000
"""Valid beams to fit on: a dozen parameters cost about 6 / 20 000 nats a beam."""

THIN = 4
"""Every fourth of a fold's scans, or of the folds, is enough to find out where the best values are, roughly."""

PAST_READING_M = 3.0
"""How far past a reading a beam is traced for fitting: its density is flat there."""


@dataclass(frozen=True, eq=False)
class Fold:
    """One way to leave training scans out: the counts of the others, and the beams to predict."""

    hits: Floats
    passes: Floats
    scans: Scans
    rays: Rays

    def thinned(self) -> Fold:
        """Return the counts with every `THIN`-th of the scans to predict, for a first rough search."""
        return _fold(self.hits, self.passes, self.scans.select(slice(None, None, THIN)), self.rays.grid)


def _fold(hits: Floats, passes: Floats, scans: Scans, grid: Grid) -> Fold:
    from bayesmap.kernels.rays import trace_rays

    reach = np.where(np.isfinite(scans.ranges_m), scans.ranges_m + PAST_READING_M, scans.max_range_m).ravel()
    return Fold(hits, passes, scans, trace_rays(scans, grid, reach_m=reach))


def make_folds(train: Scans, grid: Grid) -> list[Fold]:
    """Make inner hold-outs, interleaved, until they have `BEAMS_WANTED` beams.

    Raises:
        BadInput: fewer than two training scans with valid readings.
    """
    from bayesmap.kernels.counts import count_hits

    folds: list[Fold] = []
    count, beams = min(FOLDS, len(train)), 0
    if count < 2:
        raise BadInput("score: baselines are fitted by holding out training scans, which takes two scans or more")
    hits, passes = count_hits(train, grid)
    for i in np.random.default_rng(0).permutation(count).tolist():  # a fixed order, but not that of the protocol
        part = train.select(np.arange(len(train)) % count == i)
        valid = int((part.readings != Reading.INVALID).sum())
        if valid == 0:
            continue
        own_hits, own_passes = count_hits(part, grid)
        folds.append(_fold((hits - own_hits).astype(float), (passes - own_passes).astype(float), part, grid))
        beams += valid
        if beams >= BEAMS_WANTED:
            break
    if not folds:
        raise BadInput("score: none of the training scans has a valid reading to fit baselines on")
    return folds


def one_fold(train: Scans, grid: Grid) -> list[Fold]:
    """Make the fold for a map that scans do not change: `BEAMS_WANTED` beams, if there are, and none held out.

    Raises:
        BadInput: no training scan with a valid reading.
    """
    valid = (train.readings != Reading.INVALID).sum(axis=1)
    train, valid = train.select(valid > 0), valid[valid > 0]
    if len(train) == 0:
        raise BadInput("score: none of the training scans has a valid reading to fit a sensor on")
    count = min(len(train), int(np.ceil(len(train) * BEAMS_WANTED / valid.sum())))
    nothing = np.zeros(grid.shape).ravel()
    return [_fold(nothing, nothing, train.select(np.arange(count) * len(train) // count), grid)]


@dataclass(frozen=True, eq=False)
class HeldOut:
    """Folds whose beams are predicted together, each under its own fold's map.

    Attributes:
        folds: the F ways to leave scans out.
        rays: beams of all folds, one after the other.
        columns: of each of their entries its place in the folds' maps one after the other, each with the cells that
            its own beams touch, (K,).
    """

    folds: tuple[Fold, ...]
    rays: Rays
    columns: NDArray[np.int32]


def together(folds: Sequence[Fold]) -> HeldOut:
    """Put folds side by side: many small predictions take longer than one large prediction."""
    rays = [fold.rays for fold in folds]
    entries = np.cumsum([0, *(len(one.cells) for one in rays)])[:-1]
    places = np.cumsum([0, *(len(one.touched) for one in rays)])[:-1]

    def shifted(arrays: list[NDArray[np.int32]], by: NDArray[np.int_]) -> NDArray[np.int32]:
        return np.concatenate([array + at for array, at in zip(arrays, by, strict=True)]).astype(np.int32)

    joined = Rays(
        grid=rays[0].grid,
        offsets=np.append(np.int32(0), shifted([one.offsets[1:] for one in rays], entries)),
        cells=np.concatenate([one.cells for one in rays]),
        near=shifted([one.near for one in rays], entries),
        start_m=np.concatenate([one.start_m for one in rays]),
        direction=np.concatenate([one.direction for one in rays]),
        range_m=np.concatenate([one.range_m for one in rays]),
        limits=rays[0].limits,
    )
    return HeldOut(tuple(folds), joined, shifted([one.columns for one in rays], places))
