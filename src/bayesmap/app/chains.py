"""The chains of a document of walls, ready to be watched: of walls alone, or of walls and poses."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import cast

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.document import CHAIN_METHODS, Document
from bayesmap.app.scanning import Scene
from bayesmap.app.stream import POSE_CHAINS, Stream
from bayesmap.poses.prior import PosePrior, Uncertain
from bayesmap.samplers.methods import Gibbs, sampler_of
from bayesmap.samplers.with_poses import MovableSampler, PoseProblem, WithPoses

SMALLEST_POSE_M = 0.001
SMALLEST_HEADING_RAD = math.radians(0.05)
"""Where only one of the two is uncertain, the other is taken as known up to this: a density needs a width."""

FARTHEST_SIGMAS = 4.0
EVENLY = (0.7548776662466927, 0.5698402909980532)


def pose_prior(document: Document) -> PosePrior | None:
    """What is believed of the sensors' poses where they are uncertain and the method can take them so; else None."""
    sigma_m, sigma_rad = document.pose_sigma, document.heading_sigma
    if not document.simulated or document.sampler not in CHAIN_METHODS or not (sigma_m > 0 or sigma_rad > 0):
        return None
    return Uncertain(max(sigma_m, SMALLEST_POSE_M), max(sigma_rad, SMALLEST_HEADING_RAD))


def pose_starts(document: Document, chains: int) -> NDArray[np.float64]:
    """Poses of all sensors from which chains start: the document's, shifted by whole cells, (chains, S, 3).

    A map and all its sensors can be shifted together by whole cells without a change of the likelihood (but for what
    falls off the border), so that the posterior has a place at every such shift, as probable as the prior says: with S
    sensors exp(-S s^2 / (2 sigma^2)). No chain gets from one to the next, hence they are dealt out in these shares;
    between the cells walls do not fit, and chains that started there would take long to leave.
    """
    poses = np.array([(sensor.x, sensor.y, sensor.yaw) for sensor in document.sensors])
    sigma = max(document.pose_sigma, SMALLEST_POSE_M) / math.sqrt(len(poses)) / document.grid.resolution
    most = math.ceil(FARTHEST_SIGMAS * sigma)
    cells = np.arange(-most, most + 1)
    shares = np.cumsum(np.exp(-0.5 * (cells / sigma) ** 2))
    # Points that fill the square evenly, however many are taken (the additive recurrence of Roberts, 2018).
    points = (0.5 + np.outer(np.arange(chains), EVENLY)) % 1.0
    shifts = cells[np.searchsorted(shares / shares[-1], points)] * document.grid.resolution
    starts = np.repeat(poses[None], chains, axis=0)
    starts[:, :, :2] += shifts[:, None]
    return starts


def chains_of_walls(scene: Scene, document: Document, begun: NDArray[np.bool_], *, keep: bool) -> Stream:
    """Chains that start from these maps, one a chain, (chains, nx, ny).

    Poses that are uncertain are sampled along with the walls, as in `bayesmap.infer(..., poses=Uncertain(...))`
    without warm-up and with `pose_starts`.
    """
    walls = scene.problem
    model = scene.model(walls.prior)
    name = walls.prior.methods[document.sampler]
    sampler, _ = sampler_of(name, walls.grid, Gibbs(document.order, begun))  # type: ignore[arg-type]
    poses = pose_prior(document)
    if poses is None:
        return Stream(model, sampler, walls, document.sweeps, document.seed, keep=keep)
    model = replace(model, poses=poses)
    joint = PoseProblem(model, walls.for_any_poses(), walls.device, walls.threads)
    both = WithPoses(cast(MovableSampler, sampler), 0, pose_starts(document, POSE_CHAINS))
    return Stream(model, both, joint, document.sweeps, document.seed, keep=keep)
