"""Chains that are watched while they run: where they start, the library's runner in short steps, the kept draws."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import CHAIN_METHODS, Document
from bayesmap.app.scene import Scene
from bayesmap.app.shown.beliefs import Preview
from bayesmap.app.shown.result import CHAINS, Figures, Found, Result, settings_of_run
from bayesmap.app.shown.verdict import difference, judge_chains
from bayesmap.cells.arrays import Draws
from bayesmap.model import Model
from bayesmap.poses.prior import PosePrior, Uncertain
from bayesmap.posterior.diagnostics import bulk_ess, rhat
from bayesmap.posterior.posterior import posterior_of_chains
from bayesmap.result import Run
from bayesmap.run.chains import Chains, Record, SweepPlan
from bayesmap.run.runner import BUFFER_BYTES, no_draws, sweeps
from bayesmap.samplers.methods import Gibbs, sampler_of
from bayesmap.samplers.propagate import Marginals
from bayesmap.samplers.sampler import Problem, Sampler
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import Start, start_maps
from bayesmap.samplers.with_poses import MovableSampler, PoseProblem, WithPoses

POSE_CHAINS = 16
"""Where poses are uncertain: a map holds its sensors in place, so that each chain stays near where it started."""

STEP_SECONDS = 0.015
"""Of work between two looks at the pipe."""

DRAW_BYTES = 128 << 20
"""Of the kept draws of a run; more sweeps than fit are thinned."""

LOOKS = 32
"""At which cells some beam says something is counted so often in a run, besides at sweeps 1, 2, 4 and so on."""

DIAGNOSIS_SHARE = 0.1
"""Of the time that diagnostics of the growing trace may take; they are those of every sweep, as of the last time."""

RECENT, RECENT_BYTES = 200, 16 << 20
"""Maps of each chain that are remembered where none are kept."""

SMALLEST_POSE_M = 0.001
SMALLEST_HEADING_RAD = math.radians(0.05)
"""Where only one of the two is uncertain, the other is taken as known up to this: a density needs a width."""

FARTHEST_SIGMAS = 4.0
EVENLY = (0.7548776662466927, 0.5698402909980532)


@dataclass(frozen=True)
class Mixing:
    """R-hat and effective sample size of the log joint, and its last value averaged over the chains."""

    rhat: float
    ess: float
    log_joint: float


def joined(before: Draws | None, after: Draws, most: int = RECENT) -> Draws:
    """The last draws of both, as many of each chain as are to be remembered and fit in `RECENT_BYTES`."""
    one = sum(a[:, :1].nbytes for a in after.arrays.values())
    last = min(most, max(1, RECENT_BYTES // max(one, 1)))
    if before is None or before.index.keys() != after.index.keys():
        before = replace(after, arrays={name: a[:, :0] for name, a in after.arrays.items()})
    both = {name: np.concatenate([before.arrays[name], a], axis=1)[:, -last:] for name, a in after.arrays.items()}
    return replace(after, arrays=both)


class Stream(Found):
    """Some chains from their start to their last sweep, whatever their kind of cells.

    Attributes:
        model: what is sampled.
        problem: what the sampler has prepared of it.
        total: sweeps to do.
        thin: sweeps from one counted map to the next; 1 unless so many are kept that they would not fit.
        n_chains: how many chains.
        counted: maps that each chain's mean is made of.
    """

    def __init__(
        self, model: Model, sampler: Sampler[Any, Any], problem: Problem, total: int, seed: int, *, keep: bool
    ) -> None:
        self.model: Model = model
        self.problem, self._sampler, self.keep = problem, sampler, keep
        self.n_chains = POSE_CHAINS if model.poses.unknown else CHAINS
        self.state = sampler.init(problem, range(self.n_chains), seed)
        empty = no_draws(model, self.state, self.n_chains)
        one = sum(spec.empty(self.n_chains, 1, empty.shape_of(spec)).nbytes for spec in empty.specs)
        self.thin = math.ceil(total * one / DRAW_BYTES) if keep else 1
        self.total = math.ceil(total / self.thin) * self.thin
        schedule = SweepPlan(0, self.total // self.thin, self.thin)
        self._record = Record(empty, schedule if keep else SweepPlan(0, 0), schedule.keep)
        # At fixed sweeps: how long a step is depends on the machine, and the same actions make the same page.
        doubling = (2**k for k in range(self.total.bit_length()))
        self._look_at = {*doubling, *(self.total * k // LOOKS for k in range(1, LOOKS + 1))}
        self._steps = sweeps(
            sampler, self.state, self.total, keep=schedule.keep, step_seconds=STEP_SECONDS,
            most_kept=max(1, BUFFER_BYTES // max(one, 1)), stops=tuple(sorted(self._look_at)),
        )  # fmt: skip
        self.seconds, self.counted = 0.0, 0
        self._latest = self._recent = empty
        self._sums = np.zeros((self.n_chains, *model.grid.shape))
        self._rhat = self._ess = math.nan
        self._diagnose_at, self._diagnosed = 0.0, 0
        self._observed_counts = np.zeros((2, *model.grid.shape), dtype=np.int32)
        self._log_likelihood = np.zeros((self.n_chains, self.total))
        self._log_prior = np.zeros((self.n_chains, self.total))

    @property
    def sweep(self) -> int:
        """Sweeps done."""
        return int(self.state.sweep)

    @property
    def done(self) -> bool:
        """Whether all sweeps are."""
        return self.sweep >= self.total

    def advance(self) -> None:
        """Some sweeps: about `STEP_SECONDS` of work."""
        before, began = self.sweep, time.perf_counter()
        self.state, info = next(self._steps)
        latest = replace(self._latest, arrays=info.draws)
        if latest.count:
            self._latest = latest
            self._recent = joined(self._recent, latest)
            for chain in range(self.n_chains):
                one = replace(latest, arrays={name: a[chain : chain + 1] for name, a in info.draws.items()})
                self._sums[chain] += self.model.cells.mean_map(one) * latest.count
            self.counted += latest.count
        if self.keep:
            self._record.add(info, before)
        self._log_likelihood[:, before : self.sweep] = info.log_likelihood
        self._log_prior[:, before : self.sweep] = info.log_prior
        if self.sweep in self._look_at:
            self._observed_counts += self._sampler.observed_counts(self.state, {})
        self.seconds += time.perf_counter() - began

    @property
    def draws(self) -> Draws:
        """The kept draws."""
        return self._record.draws

    def mean(self) -> NDArray[np.float64]:
        """Mean over the counted maps of the probability that a cell stops a beam, (nx, ny).

        Where draws are not kept, cells that no beam touches have the prior's mean exactly: what their draws average to.
        """
        mean = self._sums.mean(axis=0) / max(1, self.counted)
        if self.keep or self.model.poses.unknown:  # from other poses beams touch other cells
            return np.asarray(mean)
        return np.where(self.problem.touched(), mean, self.model.cells.mean_stop(self.model.grid))

    def means(self) -> NDArray[np.float64]:
        """The same of each chain, (chains, nx, ny)."""
        return self._sums / max(1, self.counted)

    def observed(self) -> NDArray[np.bool_]:
        """Cells of which a beam said something in at least half of the maps that were looked at, (nx, ny)."""
        return np.asarray(2 * self._observed_counts[0] >= np.maximum(1, self._observed_counts[1]))

    def draw(self, chain: int | None, draw: int | None) -> tuple[NDArray[Any], int, int]:
        """One map, (nx, ny), and which it is: the last where there is none such, the latest where none are kept."""
        kept, which = self.draws, min(chain or 0, self.n_chains - 1)
        if kept.count == 0:
            return self.model.cells.map_of(self._latest, which, -1), which, 0
        number = kept.count - 1 if draw is None else min(draw, kept.count - 1)
        return self.model.cells.map_of(kept, which, number), which, number

    def log_joint(self) -> NDArray[np.float64]:
        """Of every sweep, (chains, sweeps)."""
        return self._log_likelihood[:, : self.sweep] + self._log_prior[:, : self.sweep]

    def mixing(self) -> Mixing:
        """Diagnostics of all sweeps, while the chains run of those until a moment ago; NaN where nothing changed."""
        joint = self.log_joint()
        last = float(joint[:, -1].mean()) if joint.shape[1] else math.nan
        now = time.perf_counter()
        if now >= self._diagnose_at or (self.done and self._diagnosed < self.sweep):
            constant = joint.size == 0 or float(np.ptp(joint)) == 0.0
            self._rhat, self._ess = (math.nan, math.nan) if constant else (rhat(joint), bulk_ess(joint))
            self._diagnosed = self.sweep
            self._diagnose_at = math.inf if self.done else now + (time.perf_counter() - now) / DIAGNOSIS_SHARE
        return Mixing(self._rhat, self._ess, last)

    def chains(self) -> Chains:
        """Everything, as the library's runner leaves it."""
        log_likelihood, log_prior, warmup = self._record.log_densities
        return Chains(
            draws=self.draws, log_likelihood=log_likelihood, log_prior=log_prior, warmup_log_joint=warmup,
            snapshot=self._sampler.snapshot(self.state), observed_counts=self._observed_counts, statistics={},
            n_incidences=self.problem.n_incidences,
            seconds={"trace": 0.0, "warm_start": 0.0, "sampling": self.seconds}, finished=self.done,
        )  # fmt: skip

    @property
    def kept(self) -> Draws | None:
        """The kept draws, if there are any."""
        return self.draws if self.draws.count else None

    @property
    def at_hand(self) -> Draws | None:
        """The kept draws, or the latest where none are kept."""
        draws = self.draws if self.draws.count else self._recent
        return draws if draws.count else None

    def figures(self, over: bool) -> Figures:
        """Return the sweeps done, and whether the chains agree."""
        mixing, apart = self.mixing(), difference(self.means(), self.observed())
        verdict = judge_chains(mixing.rhat, mixing.ess, self.sweep, apart, over=over or self.done)
        return Figures(self.sweep, self.total, mixing.ess, mixing.rhat, mixing.log_joint, verdict)

    def as_run(self, result: Result) -> Run:
        """Return the kept draws as a run.

        Raises:
            BadInput: no draw was kept.
        """
        if self.kept is None:
            return super().as_run(result)
        count = self.total // self.thin
        settings = settings_of_run(result, self.model, chains=self.n_chains, draws=count, thin=self.thin)
        chains = self.chains()
        total = {"total": chains.seconds["sampling"]}
        return Run(posterior_of_chains(self.model, chains, settings, total, None))


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
    sampler, _ = sampler_of(name, walls.grid, Gibbs(document.order, begun))
    poses = pose_prior(document)
    if poses is None:
        return Stream(model, sampler, walls, document.sweeps, document.seed, keep=keep)
    model = replace(model, poses=poses)
    joint = PoseProblem(model, walls.for_any_poses(), walls.device, walls.threads)
    both = WithPoses(cast(MovableSampler, sampler), 0, pose_starts(document, POSE_CHAINS))
    return Stream(model, both, joint, document.sweeps, document.seed, keep=keep)


def starts(problem: WallProblem, document: Document, preview: Preview | None) -> NDArray[np.bool_]:
    """One map a chain, (chains, nx, ny), that depends on the document alone.

    "prior" and "empty" are what they say. "auto" is prior draws where there is no preview. After one, the first chain
    of a simulation starts from what belief propagation says and the second from the empty map, and so on in turn:
    chains that started alike would agree on a wrong answer long before they have left it. On a file, whose maps are
    large, all start from belief propagation, with prior draws where it says nothing.
    """
    chains = CHAINS if pose_prior(document) is None else POSE_CHAINS

    def maps(kind: Start, marginals: Marginals | None = None) -> NDArray[np.bool_]:
        return start_maps(problem, kind, range(chains), document.seed, marginals)

    if document.start == "empty":
        return maps("zeros")
    if document.start == "prior" or preview is None:
        return maps("prior")
    likely = maps("propagate", preview.marginals())
    if not document.simulated:
        return likely
    likely[1::2] = False
    if chains > CHAINS:  # a map that is shifted starts empty: the beliefs are those of another place
        likely[(pose_starts(document, chains) != pose_starts(document, 1)).any(axis=(1, 2))] = False
    return likely
