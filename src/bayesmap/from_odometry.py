"""From a log with raw odometry to the posterior over map and trajectory.

First an approximation of all poses (`bayesmap.poses.pipeline`: matching, loops, a Gaussian about the likeliest poses);
then chains over the map and the poses of the key scans, each started from a draw of that approximation, under the same
forward law as every map here. What the chains correct is the approximation's detail; which way a long loop bends stays
near what they started from (docs/poses.md).
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from bayesmap.api import Event, infer
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.surface import Surface
from bayesmap.poses.prior import FREE, Motions, PosePrior
from bayesmap.poses.trajectory import Trajectory, calibrated
from bayesmap.result import Run
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.planar import between, compose
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

P_SLIP = 0.01
"""Chance that odometry says nothing of a motion. On Intel's log eight motions of 891 are off by 200 to 350 standard
deviations (a pose is stated twice while the robot turns by 30 degrees): a normal law alone would turn the scans there
until they contradict the walls."""


@dataclass(frozen=True, eq=False)
class KeyScans:
    """The scans that the map is made from, and what is believed of their poses.

    Attributes:
        scans: the key scans at their most probable poses, beam angles calibrated.
        prior: of their poses: odometry, corrected for its systematic error.
        starts: poses from which chains start, one trajectory each, (chains, K, 3).
    """

    scans: Scans
    prior: PosePrior
    starts: Floats


def key_scans(log: Scans, found: Trajectory, chains: int, seed: int) -> KeyScans:
    """What the chains sample, from an approximation of the trajectory.

    Args:
        log: the scans with raw odometry, in the order of the log.
        found: their approximate posterior.
        chains: how many starts.
        seed: of the starts.
    """
    keys = found.keys
    poses = found.poses[keys]
    in_time = log.select(found.order)
    scans = calibrated(in_time, found.calibration.angle_step_ratio).select(keys).at(poses)
    # All trajectories share the first pose: it is the frame of the map.
    drawn = found.draw(chains, seed)[:, keys]
    starts = compose(poses[0], between(drawn[:, :1], drawn))
    return KeyScans(scans, _prior_of(found), starts)


def _prior_of(found: Trajectory) -> PosePrior:
    """Odometry between the key scans; where it says nothing, a robot may have gone anywhere nearby."""
    relative = np.zeros((len(found.keys) - 1, 3))
    sigmas = relative + FREE
    factors = found.odometry
    if factors is not None:
        covariance = np.linalg.inv(factors.information)
        relative[factors.first] = factors.relative
        sigmas[factors.first] = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
    return Motions(relative, sigmas, P_SLIP)


def slam(
    log: str | os.PathLike[str] | Scans,
    *,
    resolution: float = 0.1,
    prior: CellPrior | None = None,
    sensor: SensorModel | Literal["fit"] = "fit",
    fast: bool = False,
    no_odometry: bool = False,
    chains: int = 4,
    warmup: int = 100,
    draws: int | None = None,
    thin: int = 1,
    seed: int = 0,
    threads: int | None = None,
    device: str = "cpu",
    checkpoint: str | os.PathLike[str] | None = None,
    resume: Run | None = None,
    on_progress: Callable[[Event], None] | None = None,
    on_trajectory: Callable[[Trajectory], None] | None = None,
    on_checkpoint: Callable[[Run], None] | None = None,
    **options: Any,
) -> Run:
    """Infer map and trajectory from a log with raw odometry.

    Args:
        log: a file that `bayesmap.read_log` reads, or scans; their poses are raw odometry.
        resolution: edge of a cell, metres.
        prior: kind of cells; `Surface()` if None.
        sensor: the law of the readings, or "fit".
        fast: stop after the approximation: the map is then inferred with the poses as if they were known.
        no_odometry: do not look at the log's poses; scans must come at 5 Hz or so.
        chains: how many chains over map and poses.
        warmup: sweeps that are not kept.
        draws: kept draws of each chain; by default those that `infer` keeps where it keeps every sweep.
        thin: sweeps from one kept draw to the next.
        seed: of all random numbers.
        threads: of the CPU; all cores if None.
        device: "cpu" or a CUDA device such as "cuda:0".
        checkpoint: a folder for the finished stages of the approximation.
        resume: a run with the same arguments that was stopped early.
        on_progress: the progress callback.
        on_trajectory: given the approximation when it is there.
        on_checkpoint: given the run so far.
        options: others of `bayesmap.infer`.

    Returns:
        The run over the key scans: ``run.poses`` are draws of their poses, ``run.trajectory`` has all scans.

    Raises:
        BadInput: as `bayesmap.read_log`, `bayesmap.poses.pipeline.infer_trajectory` and `bayesmap.infer`.
    """
    from bayesmap.poses.pipeline import infer_trajectory

    if not isinstance(log, Scans):
        from bayesmap.io.logs import read_log

        log = read_log(log)

    def on_stage(stage: str, done: int, of: int) -> None:
        if on_progress is not None:
            on_progress(Event(stage, done, of))  # type: ignore[arg-type]

    found = infer_trajectory(
        log, no_odometry=no_odometry, seed=seed, threads=threads, device=device, checkpoint=checkpoint,
        on_progress=on_stage,
    )  # fmt: skip
    if on_trajectory is not None:
        on_trajectory(found)
    return map_along(
        log, found, resolution=resolution, prior=prior, sensor=sensor, fast=fast, chains=chains, seed=seed,
        warmup=warmup, draws=draws, thin=thin, threads=threads, device=device, resume=resume, on_progress=on_progress,
        on_checkpoint=on_checkpoint, **options,
    )  # fmt: skip


def map_along(
    log: Scans,
    found: Trajectory,
    *,
    resolution: float,
    prior: CellPrior | None,
    fast: bool,
    chains: int,
    seed: int,
    on_checkpoint: Callable[[Run], None] | None = None,
    **options: Any,
) -> Run:
    """The second half of `slam`: the map, and unless ``fast`` the poses of the key scans with it."""
    keys = key_scans(log, found, chains, seed)
    grid = Grid.covering(keys.scans, resolution)
    cells = Surface() if prior is None else prior
    poses: dict[str, Any] = {} if fast else {"poses": keys.prior, "start_poses": keys.starts}
    options.setdefault("hit_depth", cells.hit_depth)
    if on_checkpoint is not None:
        options["on_checkpoint"] = lambda run: on_checkpoint(replace(run, trajectory=found))
    run = infer(keys.scans, grid, prior=cells, chains=chains, seed=seed, **poses, **options)
    return replace(run, trajectory=found)
