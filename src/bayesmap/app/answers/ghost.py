"""A robot that is not there: what its laser would read, by the posterior on show, and what one really read nearby."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.answers.decisions import maps_of
from bayesmap.app.protocol.actions import MoveGhost
from bayesmap.app.protocol.notices import GhostScan, Near
from bayesmap.app.protocol.tasks import Buffers
from bayesmap.app.scene import Scene, hits
from bayesmap.app.shown.pilot import Pilot
from bayesmap.app.shown.result import Nothing, Result
from bayesmap.errors import BadInput
from bayesmap.posterior.predictor import MapStates, Predictor, ScanPredictor, fixed_maps
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.scans import fan

MOST_DRAWS = 32
HELD_BYTES = 192 << 20
"""Draws that predictions are averaged over: so many, or as many as fit."""

FEW_DRAWS = 8
"""While the hand moves: a fan is not looked at for longer than the next one takes."""

STALE_SECONDS = 3.0
"""Of chains that went on the draws are taken anew after this."""

NEARBY_M = 0.5
"""A scan taken no further from the ghost than this is shown beside it."""

LEAST_SHARED = 0.25
"""If it shares at least this part of its field of view."""


class GhostPredictor:
    """Predicts scans by the result on show; its draws are put where kernels read them once for many questions."""

    def __init__(self) -> None:
        self._of: object = None
        self._sweep, self._until = 0, 0.0
        self._predictor: ScanPredictor | None = None
        self._few: ScanPredictor | None = None  # the same by `FEW_DRAWS`, once they have been asked for
        self._draws = 0

    def answer(self, result: Result, question: MoveGhost, generation: int) -> tuple[GhostScan, Buffers]:
        """Predict the scan of a pose, and find the scan that was taken nearest.

        Raises:
            BadInput: there is nothing to predict from, or the sensor's law does not add up to one.
        """
        began = time.perf_counter()
        predictor, draws = self._ready(result, question.coarse)
        document, scans = result.document, result.scene.scans
        drawn = document.simulated
        angles = fan(document.angles, math.degrees(document.fov)) if drawn else scans.angles_rad
        pose = (question.x, question.y, question.yaw)
        near = None if drawn else nearest_scan(result.scan_poses, pose, angles)
        if near is not None:
            angles = scans.angles_by_scan()[near.index]
        low, median, high = predictor.quantiles(pose, angles).T.astype(np.float32)
        buffers: dict[str, NDArray[Any]] = {
            "angles": angles.astype(np.float32), "low": low, "median": median, "high": high,
        }  # fmt: skip
        if near is not None:
            buffers |= _taken(result.scene, result.scan_poses[near.index], near.index)
        milliseconds = round(1e3 * (time.perf_counter() - began), 1)
        return GhostScan(*pose, question.coarse, draws, near, milliseconds, generation=generation), buffers

    def _ready(self, result: Result, coarse: bool) -> tuple[ScanPredictor, int]:
        """Return the predictor of a result, of only some draws where those will do, and how many draws are in it.

        That of chains which go on is made anew now and then.
        """
        found, now = result.found, time.perf_counter()
        of: object = result if not found.sweep else result.scene if isinstance(found, Pilot) else found
        stale = found.sweep != self._sweep and (found.done or now > self._until)
        if self._predictor is None or of is not self._of or stale:
            predictor, self._draws = predictor_of_result(result)
            limits = RangeLimits(result.scene.scans.min_range_m, result.scene.scans.max_range_m)
            self._predictor, self._few, self._of = ScanPredictor.of(predictor, limits), None, of
            self._sweep, self._until = found.sweep, time.perf_counter() + STALE_SECONDS
        if not coarse or self._draws <= FEW_DRAWS:
            return self._predictor, self._draws
        if self._few is None:
            self._few = self._predictor.thinned(FEW_DRAWS)
        return self._few, FEW_DRAWS


def predictor_of_result(result: Result) -> tuple[Predictor, int]:
    """What predicts, and how many draws are in it: 0 where cells are taken for independent for want of draws.

    Raises:
        BadInput: there is nothing to predict from, or a sensor model that only the run's maker had.
    """
    scene, grid = result.scene, result.document.grid
    try:
        maps = maps_of(result)
    except BadInput:
        if isinstance(result.found, Nothing):
            raise BadInput("there is nothing to predict from yet; run inference first") from None
        chances = result.found.mean().reshape(1, -1)
        return Predictor(grid, fixed_maps(chances), scene.sensor, scene.hit_depth), 0
    sensor, depth = result.law
    one = grid.n_cells * (32 if maps.prior.has_surfaces else 4)
    some = maps.draws.thinned(int(np.clip(HELD_BYTES // one, maps.draws.chains, MOST_DRAWS)))

    def batches(cells: NDArray[np.int32] | None = None) -> Iterator[MapStates]:
        return maps.prior.predictive_stops(some, cells)

    return Predictor(grid, batches, sensor, depth, some.size), some.size


def nearest_scan(
    poses: NDArray[np.float64], pose: tuple[float, float, float], angles_rad: NDArray[np.float64]
) -> Near | None:
    """The scan that was taken most nearly there: its index, how far away (metres) and turned by how much (radians).

    None where none was taken within `NEARBY_M` whose field of view shares `LEAST_SHARED` with the ghost's.
    """
    field = float(np.ptp(angles_rad)) if len(angles_rad) > 1 else 0.0
    away = np.hypot(poses[:, 0] - pose[0], poses[:, 1] - pose[1])
    turn = np.remainder(poses[:, 2] - pose[2] + np.pi, 2 * np.pi) - np.pi
    # fans that go all round share everything, whatever their headings
    shared = np.ones(len(poses)) if field > 1.9 * np.pi else 1.0 - np.abs(turn) / max(field, 1e-9)
    cost = np.where((away <= NEARBY_M) & (shared >= LEAST_SHARED), away / NEARBY_M + 1.0 - shared, np.inf)
    if not len(cost) or not np.isfinite(cost.min()):
        return None
    best = int(cost.argmin())
    return Near(best, round(float(away[best]), 3), round(float(turn[best]), 4))


def _taken(scene: Scene, pose: NDArray[np.float64], index: int) -> dict[str, NDArray[Any]]:
    """A scan as the message has it."""
    return {
        "near_pose": pose,
        "near_ranges": scene.scans.ranges_m[index].astype(np.float32),
        "near_hit": hits(scene)[index].astype(np.uint8),
    }
