"""From a log with raw odometry to the posterior over map and trajectory.

First an approximation of all poses (`bayesmap.poses.slam`: matching, loops, a Gaussian about the likeliest poses);
then chains over the map and the poses of the key scans, each started from a draw of that approximation, under the same
forward law as every map here. What the chains correct is the approximation's detail; which way a long loop bends stays
near what they started from (docs/how/poses.md).
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from bayesmap.api import Event, infer
from bayesmap.arguments import Checkpoints, Schedule, Where, need_value
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.surface import Surface
from bayesmap.poses.prior import FREE, Motions, PosePrior
from bayesmap.poses.trajectory import Trajectory, calibrated
from bayesmap.result import Run
from bayesmap.samplers.methods import Gibbs
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.planar import between, compose
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

P_SLIP = 0.01
"""Probability that odometry says nothing of a motion. In the Intel log eight motions of 891 are off by 200 to 350
standard deviations, since a pose is stated twice while the robot turns by 30 degrees. A normal law alone would turn the
scans there until they contradict the walls."""


@dataclass(frozen=True, eq=False)
class KeyScans:
    """The scans that the map is made from, and the prior of their poses.

    Attributes:
        scans: the key scans at their most probable poses, beam angles calibrated.
        prior: of their poses: odometry, corrected for its systematic error.
        starts: poses from which chains start, one trajectory each, (chains, K, 3).
    """

    scans: Scans
    prior: PosePrior
    starts: Floats


def key_scans(log: Scans, found: Trajectory, chains: int, seed: int) -> KeyScans:
    """Return what the chains sample, from an approximation of the trajectory.

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
    """Return the prior of odometry between the key scans; without odometry a robot may have gone anywhere nearby."""
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
    schedule: Schedule = Schedule(),
    seed: int = 0,
    hit_depth: float | None = None,
    where: Where = Where(),
    checkpoints: Checkpoints = Checkpoints(),
    on_progress: Callable[[Event], None] | None = None,
) -> Run:
    """Infer map and trajectory from a log with raw odometry.

    Args:
        log: a file that `bayesmap.read_log` reads, or scans; their poses are raw odometry.
        resolution: edge of a cell, metres.
        prior: kind of cells; `Surface()` if None.
        sensor: the law of the readings, or "fit".
        fast: stop after the approximate trajectory: the map is then inferred with the poses as if they were known.
        no_odometry: do not read the poses of the log; scans must come at 5 Hz or so.
        schedule: how many chains over map and poses, warm-up sweeps and draws; every sweep is kept unless ``thin`` says
            otherwise.
        seed: of all random numbers.
        hit_depth: where in a cell a beam stops, see `bayesmap.infer`; that of the kind of cells if None.
        where: threads, device and executor; by default all cores of this machine.
        checkpoints: a run to go on with, what is called with the run so far, and a folder for the finished stages of
            the approximation; by default none of them.
        on_progress: called with how far the run is.

    Returns:
        The run over the key scans: ``run.poses`` are draws of their poses, ``run.trajectory`` has all scans.

    Raises:
        BadInput: as `bayesmap.read_log`, `bayesmap.poses.slam.infer_trajectory` and `bayesmap.infer`.
    """
    from bayesmap.poses.slam import infer_trajectory

    for name, value, kind in (
        ("schedule", schedule, Schedule), ("where", where, Where), ("checkpoints", checkpoints, Checkpoints),
    ):  # fmt: skip
        need_value("slam", name, value, kind)
    # Read the log.
    if not isinstance(log, Scans):
        from bayesmap.io.logs import read_log

        log = read_log(log)

    def on_stage(stage: str, done: int, of: int) -> None:
        if on_progress is not None:
            on_progress(Event(stage, done, of))  # type: ignore[arg-type]

    # Approximate the trajectory of all scans.
    trajectory = infer_trajectory(
        log, no_odometry=no_odometry, seed=seed, threads=where.threads, device=where.device,
        checkpoint=checkpoints.stages, on_progress=on_stage,
    )  # fmt: skip
    # Select the key scans, and lay the grid over them.
    keys = key_scans(log, trajectory, schedule.chains, seed)
    grid = Grid.covering(keys.scans, resolution)
    cells = Surface() if prior is None else prior
    # Sample the map, and unless it is to be fast the poses of the key scans with it.
    save = checkpoints.save
    if save is not None:
        checkpoints = replace(checkpoints, save=lambda run: save(replace(run, trajectory=trajectory)))
    run = infer(
        keys.scans, grid, prior=cells, sensor=sensor, method=None if fast else Gibbs(start_poses=keys.starts),
        schedule=replace(schedule, thin=1 if schedule.thin is None else schedule.thin), seed=seed,
        poses=None if fast else keys.prior, hit_depth=cells.hit_depth if hit_depth is None else hit_depth, where=where,
        checkpoints=checkpoints, on_progress=on_progress,
    )  # fmt: skip
    return replace(run, trajectory=trajectory)
