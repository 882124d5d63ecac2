"""Metropolis steps of each scan's pose, given the cells.

Given the map, scans depend on each other through the prior of the poses alone: under independent priors all scans can
move at once, under a motion model every second one (`bayesmap.poses.prior.PoseLaw.colours`). A proposal is a normal
step whose covariance is that of the scan's own likelihood and prior, so that it is long along a corridor and short
across it. The likelihood sums over where each beam stops; the next sweep of the cells draws the stops anew, so that
cells and poses together are sampled from their joint posterior (a collapsed Gibbs sampler: Liu, 1994).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.prior import PoseLaw

if TYPE_CHECKING:
    from bayesmap.kernels.predict.scan_likelihood import ScanLikelihood

Floats = NDArray[np.float64]

STREAM_POSES = 4
"""Stream of random numbers, beside those of `bayesmap.samplers.sampler`."""

OPTIMAL = 2.38 / np.sqrt(3.0)
"""Length of steps in three dimensions, in standard deviations (Roberts, Gelman and Gilks, 1997)."""

WANTED_ACCEPTANCE = 0.35

MOST_NATS = 2.0
"""The most that one beam's density may change within a difference, when information is estimated: where a beam slips
past an edge its density jumps, and the slope says nothing of how far the pose may move."""


@dataclass(frozen=True, eq=False)
class PoseState:
    """Where the poses of some chains stand.

    Attributes:
        poses: in the world frame, (C, S, 3).
        log_scale: logarithm of the size of the steps of each scan, (C, S); warm-up adapts it.
        chain_ids: global numbers of the chains, (C,).
        seed: of all random numbers.
        step: steps made: with the seed and the chain's number it decides the next random numbers.
    """

    poses: Floats
    log_scale: Floats
    chain_ids: NDArray[np.intp]
    seed: int
    step: int = 0


@dataclass(frozen=True, eq=False)
class PoseInfo:
    """What a step reports.

    Attributes:
        log_likelihood: of all readings at the new poses, (C,).
        acceptance: share of the scans whose pose moved, (C,).
    """

    log_likelihood: Floats
    acceptance: Floats


@dataclass(frozen=True, eq=False)
class PoseMetropolis:
    """Steps of all poses of some chains.

    Attributes:
        likelihood: of scans at poses.
        prior: of the poses.
        factor: Cholesky factor of each scan's proposal covariance in world axes, (S, 3, 3), or for each chain one,
            (C, S, 3, 3).
    """

    likelihood: ScanLikelihood
    prior: PoseLaw
    factor: Floats

    def init(self, poses: Floats, chain_ids: NDArray[np.intp], seed: int) -> PoseState:
        """Chains at the given poses, (C, S, 3)."""
        return PoseState(np.array(poses, dtype=np.float64), np.zeros(np.shape(poses)[:2]), np.asarray(chain_ids), seed)

    def step(
        self, state: PoseState, cells: NDArray[np.float32], n: int = 1, *, beta: float = 1.0, gain: float = 0.0
    ) -> tuple[PoseState, PoseInfo]:
        """Propose a new pose for every scan ``n`` times.

        Args:
            state: the chains.
            cells: one map a chain, as `bayesmap.kernels.predict.scan_likelihood.ScanLikelihood.beams` takes them.
            n: rounds over all scans.
            beta: inverse temperature of the likelihood.
            gain: how far each scan's steps grow when one is accepted and shrink when not (Robbins and Monro, 1951); 0
                once draws are kept.
        """
        chains, scans = state.poses.shape[:2]
        poses, log_scale = state.poses.copy(), state.log_scale.copy()
        log_lik = self._weigh(cells, poses, np.arange(scans))
        moved = np.zeros(chains)
        for step in range(state.step, state.step + n):
            noise, level = self._random(state, step)
            shifts = np.exp(log_scale)[..., None] * (self.factor @ noise[..., None])[..., 0]
            accepted = np.zeros((chains, scans), dtype=np.bool_)
            for colour in self.prior.colours(scans):
                proposed = poses.copy()
                proposed[:, colour] += shifts[:, colour]
                there = self._weigh(cells, proposed, colour)
                gained = beta * (there - log_lik[:, colour]) + self.prior.log_change(poses, proposed)[:, colour]
                yes = level[:, colour] < gained
                accepted[:, colour] = yes
                poses[:, colour] = np.where(yes[..., None], proposed[:, colour], poses[:, colour])
                log_lik[:, colour] = np.where(yes, there, log_lik[:, colour])
            moved += accepted.mean(axis=1) / n
            log_scale += gain * (accepted - WANTED_ACCEPTANCE)
        state = replace(state, poses=poses, log_scale=log_scale, step=state.step + n)
        return state, PoseInfo(log_lik.sum(axis=1), moved)

    def _weigh(self, cells: NDArray[np.float32], poses: Floats, scans: NDArray[np.intp]) -> Floats:
        chain, scan = (a.ravel() for a in np.meshgrid(np.arange(len(poses)), scans, indexing="ij"))
        return self.likelihood(cells, poses[:, scans].reshape(-1, 3), scan, chain).reshape(len(poses), -1)

    def _random(self, state: PoseState, step: int) -> tuple[Floats, Floats]:
        """Standard normal steps (C, S, 3), and logarithms of uniform numbers (C, S): of seed, chain and step alone."""
        scans = state.poses.shape[1]
        noise, level = np.empty(state.poses.shape), np.empty(state.poses.shape[:2])
        for i, chain in enumerate(state.chain_ids):
            rng = np.random.default_rng([state.seed, int(chain), STREAM_POSES, step])
            noise[i], level[i] = rng.standard_normal((scans, 3)), np.log(rng.random(scans))
        return noise, level


def proposal_factors(
    likelihood: ScanLikelihood, cells: NDArray[np.float32], poses: Floats, prior: PoseLaw, step_m: float
) -> Floats:
    """Cholesky factors of steps that fit each scan's posterior given the map, (S, 3, 3).

    The likelihood's information is estimated by the sum over beams of the outer products of their log densities'
    gradients, found by central differences: never negative, and without second derivatives.

    Args:
        likelihood: of the scans.
        cells: one map, (1, N) or (1, N, 6).
        poses: about which, (S, 3).
        prior: of the poses.
        step_m: of the differences, about the sensor's noise; angles take it at a lever of the scan's median range.
    """
    scans = len(poses)
    ranges = np.where(np.isfinite(likelihood.scans.ranges_m), likelihood.scans.ranges_m, np.nan)
    usable = np.isfinite(ranges).any(axis=1)
    lever = np.full(scans, 1.0)
    lever[usable] = np.maximum(np.nanmedian(ranges[usable], axis=1), 0.1)
    step = np.stack([np.full(scans, step_m), np.full(scans, step_m), step_m / lever], axis=-1)
    scan, chain = np.arange(scans), np.zeros(scans, dtype=np.intp)
    slopes = []
    for axis in range(3):
        shift = np.zeros((scans, 3))
        shift[:, axis] = step[:, axis]
        ahead, behind = (likelihood.beams(cells, poses + sign * shift, scan, chain) for sign in (1.0, -1.0))
        slopes.append(np.clip(ahead - behind, -MOST_NATS, MOST_NATS) / (2 * step[:, axis : axis + 1]))
    gradient = np.stack(slopes, axis=-1)  # (S, A, 3)
    information = np.einsum("sai,saj->sij", gradient, gradient) + prior.precision(poses)
    return np.asarray(OPTIMAL * np.linalg.cholesky(np.linalg.inv(information)))
