"""Sample cells and poses together: sweeps of the cells at fixed poses, then steps of the poses given the cells.

Both leave the joint posterior of map and trajectory invariant (Gibbs sampling in two blocks). Each chain has its own
poses. After its poses have moved, its rays are traced again, and its cells stay.

Given the map, only the prior couples the poses: `independent_groups` of the prior's law tells which scans can move at
once. A proposal is a normal step with the covariance of the scan's own likelihood and prior. The likelihood sums over
the cells in which a beam may stop, and the next sweep draws these stops again (a collapsed Gibbs sampler: Liu, 1994).
`WithPoses`, at the end, is the sampler of both; `PoseMetropolis` makes the steps of the poses.
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.beams.table import BeamTable
from bayesmap.cells.kind import CellPrior
from bayesmap.model import POSES, Model
from bayesmap.poses.prior import PoseLaw
from bayesmap.samplers.sampler import SILENT, ChainState, Info, Keep, Problem, Sampler, Snapshot, Stream, Watch
from bayesmap.sensors.model import SensorModel
from bayesmap.space.arrays import Floats, Indices, Ints, Singles

if TYPE_CHECKING:
    from bayesmap.kernels.predict.density import ScanLikelihood

OPTIMAL_SCALE = 2.38 / np.sqrt(3.0)  # length of steps, in standard deviations (Roberts, Gelman and Gilks, 1997)
TARGET_ACCEPTANCE = 0.35  # share of accepted steps to which the sizes of steps adapt
MAX_STEP_NATS = 2.0  # cap of a beam's change in a difference: past an edge its density jumps, without a slope
SWEEPS_A_ROUND = 5  # sweeps of the cells from one round of pose steps to the next
STEPS_A_ROUND = 3  # steps of every pose in a round
DIFFERENCE_M = 0.02  # step of the central differences of the likelihood: about the noise of a laser
STEP_ARRAYS = ("pose_log_scale", "pose_factor")  # arrays of a snapshot beside the poses and those of the cells


@dataclass(frozen=True, eq=False)
class PoseState:
    """The present poses of some chains. Seed, number of the chain and step determine the next random numbers."""

    poses: Floats  # poses in the world frame, (C, S, 3)
    log_scale: Floats  # logarithm of the size of the steps of each scan, (C, S); warm-up adapts it
    chain_ids: Indices  # numbers among all chains of the run, (C,)
    seed: int
    n_steps: int = 0  # number of steps made


@dataclass(frozen=True, eq=False)
class PoseMetropolis:
    """Metropolis steps of all poses of some chains."""

    likelihood: "ScanLikelihood"
    prior: PoseLaw
    factor: Floats  # Cholesky factor of each scan's proposal covariance in world axes, (S, 3, 3) or (C, S, 3, 3)

    def step(
        self, state: PoseState, cells: Singles, count: int = 1, *, beta: float = 1.0, adaptation_rate: float = 0.0
    ) -> tuple[PoseState, Floats]:
        """Propose a new pose for every scan ``count`` times. Returns the chains, and the share of accepted steps, (C,).
        ``cells`` holds one map per chain (`ScanLikelihood.beams`). A scan's step size grows with accepted steps and
        shrinks with others (Robbins and Monro, 1951) at ``adaptation_rate``, which must be 0 once draws are kept.
        """
        n_chains, n_scans = state.poses.shape[:2]
        poses, log_scale = state.poses.copy(), state.log_scale.copy()
        log_lik = self._log_likelihoods(cells, poses, np.arange(n_scans))
        share_accepted = np.zeros(n_chains)
        for step in range(state.n_steps, state.n_steps + count):
            noise, log_uniform = self._random(state, step)
            shifts = np.exp(log_scale)[..., None] * (self.factor @ noise[..., None])[..., 0]
            accepted = np.zeros((n_chains, n_scans), dtype=np.bool_)
            # Scans of one group are independent given the others, so they are accepted or not one by one.
            for group in self.prior.independent_groups():
                proposed = poses.copy()
                proposed[:, group] += shifts[:, group]
                proposed_log_lik = self._log_likelihoods(cells, proposed, group)
                log_ratio = beta * (proposed_log_lik - log_lik[:, group])
                log_ratio += self.prior.log_change(poses, proposed)[:, group]
                accept = log_uniform[:, group] < log_ratio
                accepted[:, group] = accept
                poses[:, group] = np.where(accept[..., None], proposed[:, group], poses[:, group])
                log_lik[:, group] = np.where(accept, proposed_log_lik, log_lik[:, group])
            share_accepted += accepted.mean(axis=1) / count
            log_scale += adaptation_rate * (accepted - TARGET_ACCEPTANCE)
        return replace(state, poses=poses, log_scale=log_scale, n_steps=state.n_steps + count), share_accepted

    def _log_likelihoods(self, cells: Singles, poses: Floats, scans: Indices) -> Floats:
        """Compute the log likelihood of some scans, by index, (n,), of every chain at their poses, (C, n)."""
        chain, scan = (index.ravel() for index in np.meshgrid(np.arange(len(poses)), scans, indexing="ij"))
        return self.likelihood(cells, poses[:, scans].reshape(-1, 3), scan, chain).reshape(len(poses), -1)

    def _random(self, state: PoseState, step: int) -> tuple[Floats, Floats]:
        """Draw normal steps (C, S, 3) and logarithms of uniform numbers (C, S), from seed, chain and step alone."""
        noise, log_uniform = np.empty(state.poses.shape), np.empty(state.poses.shape[:2])
        for i, chain in enumerate(state.chain_ids):
            rng = np.random.default_rng([state.seed, int(chain), Stream.POSES, step])
            noise[i] = rng.standard_normal(noise[i].shape)
            log_uniform[i] = np.log(rng.random(log_uniform[i].shape))
        return noise, log_uniform


def proposal_factors(
    likelihood: "ScanLikelihood", cells: Singles, poses: Floats, prior: PoseLaw, step_m: float
) -> Floats:
    """Return Cholesky factors of proposals that fit the posterior of each scan's pose given one map, (S, 3, 3).
    The map is (1, N) or (1, N, 6). The information sums the outer products of the gradients of beams' log densities, by
    central differences: shifts by ``step_m``, about the noise, and turns that move the median range's point as far.
    """
    n_scans = len(poses)
    range_m = np.where(np.isfinite(likelihood.scans.ranges_m), likelihood.scans.ranges_m, np.nan)
    has_hits = np.isfinite(range_m).any(axis=1)
    lever_m = np.full(n_scans, 1.0)
    lever_m[has_hits] = np.maximum(np.nanmedian(range_m[has_hits], axis=1), 0.1)
    step = np.stack([np.full(n_scans, step_m), np.full(n_scans, step_m), step_m / lever_m], axis=-1)
    scan, map_index = np.arange(n_scans), np.zeros(n_scans, dtype=np.intp)
    slopes = []
    for axis in range(3):
        shift = np.zeros((n_scans, 3))
        shift[:, axis] = step[:, axis]
        forward, backward = (likelihood.beams(cells, poses + sign * shift, scan, map_index) for sign in (1.0, -1.0))
        slopes.append(np.clip(forward - backward, -MAX_STEP_NATS, MAX_STEP_NATS) / (2 * step[:, axis : axis + 1]))
    gradient = np.stack(slopes, axis=-1)  # (S, A, 3)
    information = np.einsum("sai,saj->sij", gradient, gradient) + prior.precision(poses)
    return np.asarray(OPTIMAL_SCALE * np.linalg.cholesky(np.linalg.inv(information)))


class MovableSampler(Sampler[Any, Any], Protocol):
    """A sampler of cells whose rays can be traced again from other poses, while its chains keep their cells."""

    def retrace(self, problem: Any, model: Model) -> Any:
        """Return this problem with the scans moved to other poses. Draws keep their cells."""

    def moved(self, state: Any, problem: Any) -> Any:
        """Return the chains with their present cells, under another problem of `retrace`."""

    def present_cells(self, state: Any) -> Singles:
        """Return the present cells of the chains, (C, N) or (C, N, 6), see `bayesmap.cells.kind.CellPrior.stops`."""


@dataclass(frozen=True, eq=False)
class PoseProblem(Problem):
    """A model with unknown poses, in the form that samplers use."""

    model: Model
    cells: Any  # the problem of the cells' sampler at the poses of the log
    device: str
    threads: int | None  # all cores if None

    @property
    def traced(self) -> Rays | BeamTable:
        """The beams at the poses of the log."""
        return self.cells.traced  # type: ignore[no-any-return]

    @property
    def coordinates(self) -> Mapping[str, Ints]:
        """The coordinates of the cells, and the numbers of scans and of the components of a pose."""
        scans = np.arange(len(self.model.scans), dtype=np.int32)
        return {**self.cells.coordinates, "scan": scans, "pose": np.arange(3, dtype=np.int32)}

    @cached_property
    def likelihood(self) -> "ScanLikelihood":
        """The likelihood of scans at poses."""
        from bayesmap.kernels.predict.density import ScanLikelihood

        model = self.model
        return ScanLikelihood(model.scans, model.grid, model.sensor, model.hit_depth, self.device)

    @cached_property
    def law(self) -> PoseLaw:
        """The prior of the poses."""
        return self.model.poses.law(self.model.scans.poses)

    def at(self, poses: Floats) -> Model:
        """Return the model with its scans moved to these poses, (S, 3)."""
        return replace(self.model, scans=self.model.scans.at(poses))

    def under(self, sensor: SensorModel, prior: CellPrior) -> "PoseProblem":
        """Return this problem under another sensor and another prior of the cells."""
        model = replace(self.model, sensor=sensor, cells=prior)
        return replace(self, model=model, cells=self.cells.under(sensor, prior))


@dataclass(frozen=True, eq=False)
class JointState(ChainState):
    """Chains between two sweeps."""

    problem: PoseProblem
    cells: tuple[Any, ...]  # one state of the cells' sampler per chain, each with its own rays
    pose_state: PoseState
    factor: Floats  # Cholesky factors of the chains' proposals, (C, S, 3, 3); zero before the first round


@dataclass(frozen=True, eq=False)
class WithPoses:
    """A sampler of cells and poses, made from a sampler of cells."""

    cells: MovableSampler
    adapt_until: int  # the sweep after which the sizes of pose steps stay fixed, the end of warm-up
    start: Floats | None = None  # first poses by chain number, (chains of the run, S, 3); draws of the prior if None
    every: int = SWEEPS_A_ROUND  # sweeps of the cells between rounds of pose steps
    pose_steps: int = STEPS_A_ROUND  # steps of every pose in a round

    def prepare(self, model: Model, device: str, threads: int | None = None, watch: Watch = SILENT) -> PoseProblem:
        """Trace the beams at the poses of the log."""
        problem = self.cells.prepare(model, device, threads, watch)
        return PoseProblem(model, problem.for_any_poses(), problem.device, threads)

    def init(
        self, problem: PoseProblem, chain_ids: Sequence[int], seed: int, resume: Snapshot | None = None,
        watch: Watch = SILENT,
    ) -> JointState:  # fmt: skip
        """Start chains, or continue from a snapshot."""
        n_chains, n_scans = len(chain_ids), len(problem.model.scans)
        if resume is None:
            sweep = 0
            if self.start is not None:
                poses = np.stack([np.asarray(self.start[chain % len(self.start)], np.float64) for chain in chain_ids])
            else:
                rngs = [np.random.default_rng([seed, chain, Stream.START_POSES]) for chain in chain_ids]
                poses = np.stack([problem.law.sample(rng) for rng in rngs])
            log_scale, factor = np.zeros((n_chains, n_scans)), np.zeros((n_chains, n_scans, 3, 3))
        else:
            sweep = resume.sweep
            poses, log_scale, factor = (resume.arrays[name] for name in ("poses", *STEP_ARRAYS))
        pose_state = PoseState(poses, log_scale, np.asarray(chain_ids), seed, sweep // self.every * self.pose_steps)

        def init_cells(i: int) -> Any:
            snapshot = None
            if resume is not None:
                arrays = {n: a[i : i + 1] for n, a in resume.arrays.items() if n not in ("poses", *STEP_ARRAYS)}
                snapshot = Snapshot(resume.sweep, arrays)
            retraced = self.cells.retrace(problem.cells, problem.at(poses[i]))
            return self.cells.init(retraced, [chain_ids[i]], seed, snapshot, watch)

        cells = tuple(self._map_chains(problem, init_cells, n_chains))
        return JointState(problem, sweep, cells, pose_state, factor)

    def step(self, state: JointState, sweeps: int, beta: float = 1.0, keep: Keep = Keep()) -> tuple[JointState, Info]:
        """Make some sweeps of all chains, with a round of pose steps after every few."""
        end = state.sweep + sweeps
        infos, drawn_poses = [], []
        while state.sweep < end:
            # Sweep the cells up to the next round, or to the end; the poses are the same in all these draws.
            count = min(end, (state.sweep // self.every + 1) * self.every) - state.sweep
            n_kept = len(keep.sweeps(state.sweep, state.sweep + count))
            drawn_poses.append(np.repeat(state.pose_state.poses[:, None], n_kept, axis=1))
            log_prior = state.problem.law.log_prob(state.pose_state.poses)
            state, info = self._sweep_cells(state, count, beta, keep)
            infos.append(replace(info, log_prior=info.log_prior + log_prior[:, None]))
            if state.sweep % self.every == 0:
                state = self._move_poses(state, beta)
        info = Info.joined(infos, axis=1)
        return state, replace(info, draws={**info.draws, POSES.name: np.concatenate(drawn_poses, axis=1)})

    def snapshot(self, state: JointState) -> Snapshot:
        """Return cells and poses, and the sizes of the steps."""
        by_chain = [self.cells.snapshot(chain).arrays for chain in state.cells]
        arrays = {name: np.concatenate([arrays[name] for arrays in by_chain]) for name in by_chain[0]}
        steps = dict(zip(STEP_ARRAYS, (state.pose_state.log_scale, state.factor), strict=True))
        return Snapshot(state.sweep, {**arrays, "poses": state.pose_state.poses, **steps})

    def observed_counts(self, state: JointState, draws: Mapping[str, NDArray[Any]]) -> Ints:
        """Count the draws in which some beam observes each cell, and the draws inspected. Returns (2, nx, ny)."""
        by_chain = [
            self.cells.observed_counts(chain, {name: a[i : i + 1] for name, a in draws.items() if name != POSES.name})
            for i, chain in enumerate(state.cells)
        ]
        return np.asarray(np.sum(by_chain, axis=0))

    def _sweep_cells(self, state: JointState, count: int, beta: float, keep: Keep) -> tuple[JointState, Info]:
        """Make some sweeps of the cells at fixed poses."""

        def sweep(i: int) -> tuple[Any, Info]:
            return self.cells.step(state.cells[i], count, beta, keep)

        cells, infos = zip(*self._map_chains(state.problem, sweep, len(state.cells)), strict=True)
        return replace(state, cells=cells, sweep=state.sweep + count), Info.joined(infos, axis=0)

    def _move_poses(self, state: JointState, beta: float) -> JointState:
        """Make a round of pose steps, and trace the chains' rays at the new poses."""
        problem = state.problem
        cells = np.concatenate([self.cells.present_cells(chain) for chain in state.cells])
        factor = state.factor
        if not factor.any():
            factor = np.stack([
                proposal_factors(problem.likelihood, cells[i : i + 1], poses, problem.law, DIFFERENCE_M)
                for i, poses in enumerate(state.pose_state.poses)
            ])  # fmt: skip
        # Steps adapt ever less during the warm-up, and not after it.
        rate = float((state.sweep // self.every) ** -0.6) if state.sweep <= self.adapt_until else 0.0
        sampler = PoseMetropolis(problem.likelihood, problem.law, factor)
        pose_state, _ = sampler.step(state.pose_state, cells, self.pose_steps, beta=beta, adaptation_rate=rate)

        def move_cells(i: int) -> Any:
            if (pose_state.poses[i] == state.pose_state.poses[i]).all():
                return state.cells[i]
            retraced = self.cells.retrace(problem.cells, problem.at(pose_state.poses[i]))
            return self.cells.moved(state.cells[i], retraced)

        chains = tuple(self._map_chains(problem, move_cells, len(state.cells)))
        return replace(state, cells=chains, pose_state=pose_state, factor=factor)

    def _map_chains(self, problem: PoseProblem, work: Callable[[int], Any], count: int) -> list[Any]:
        """Run the work for every chain: on the CPU in parallel threads, elsewhere one after the other."""
        from bayesmap.kernels.device import available_cores

        threads = min(problem.threads or available_cores(), count) if problem.device == "cpu" else 1
        if threads == 1:
            return [work(i) for i in range(count)]
        with ThreadPoolExecutor(threads) as pool:
            return list(pool.map(work, range(count)))
