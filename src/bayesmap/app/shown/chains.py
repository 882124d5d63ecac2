"""Chains that are shown while they run: the runner in short steps, the starts, and the pilot that fits the sensor.

`RunningChains` advances the chains. `chains_of_walls` prepares chains of walls, which start from `first_maps_of` and
`pose_starts`. `fit_by_pilot` prepares chains of reflectivities or surfaces. The pilot is a short chain that fits the
sensor and the prior. The latter half of its draws is shown as a first estimate (docs/app.md).
"""

import math
import time
from collections.abc import Callable, Generator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import Verdict
from bayesmap.app.scene import Scene
from bayesmap.app.shown.result import CHAINS, DrawnMap, Estimate, Progress, Result
from bayesmap.app.shown.verdicts import compare_means, judge_chains, judge_shifted_chains, misfit_of, rhat_and_ess
from bayesmap.app.shown.without_chains import Preview
from bayesmap.arguments import Schedule
from bayesmap.cells.arrays import Draws
from bayesmap.cells.kinds import BUILT_IN
from bayesmap.model import Model
from bayesmap.poses.prior import PosePrior, UncertainPoses
from bayesmap.posterior.posterior import posterior_of_chains
from bayesmap.result import Run
from bayesmap.run.chains import DrawRecord, SweepPlan
from bayesmap.run.runner import MAX_BUFFER_BYTES, advance_chains, empty_draws
from bayesmap.samplers.fit import PILOT_SWEEPS, initial_sensor, pilot_sweeps
from bayesmap.samplers.methods import Gibbs, make_sampler
from bayesmap.samplers.sampler import Keep, Problem, Sampler
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import Start, start_maps
from bayesmap.samplers.with_poses import MovableSampler, PoseProblem, WithPoses
from bayesmap.samplers.without_chains import Marginals
from bayesmap.sensors.model import Gaussian
from bayesmap.space.planar import Floats

POSE_CHAINS = 16  # number of chains if poses are uncertain: a map fixes its sensors, so each stays near its start
STEP_SECONDS = 0.015  # duration of one step of the chains. The worker reads its pipe between two steps.
MAX_DRAW_BYTES = 128 << 20  # memory of a run's kept draws, which are thinned to fit
OBSERVED_COUNTS = 32  # counts of observed cells per run, besides those at sweeps 1, 2, 4 and so on
MAX_DIAGNOSIS_SHARE = 0.1  # share of time spent on diagnostics; the last numbers are shown meanwhile
RECENT_DRAWS = 200  # draws per chain that answer questions while chains run
MAX_RECENT_BYTES = 16 << 20  # memory of a pilot's draws
MIN_SIGMA_M = 0.001  # standard deviation of a position if only headings are uncertain: a density needs a width
MIN_SIGMA_RAD = math.radians(0.05)  # standard deviation of a heading if only positions are uncertain
MAX_SHIFT_SIGMAS = 4.0  # shift of a chain's start, in standard deviations
EVEN_STEPS = (0.7548776662466927, 0.5698402909980532)  # spreads shifts evenly (additive recurrence, Roberts, 2018)


class Checkpoint(NamedTuple):
    """Sums over the first sweeps of the chains. Differences of sums give means over the later sweeps."""

    sweep: int  # number of sweeps done
    sums: Floats  # sums of the chains' maps, (chains, nx, ny)
    observed_counts: NDArray[np.int32]  # see `Sampler.observed_counts`


class RunningChains(Estimate):
    """Chains of any kind of cells, advanced step by step. The burn-in, a share of the sweeps, ends at a checkpoint."""

    def __init__(self, model: Model, sampler: Sampler[Any, Any], problem: Problem, document: Document) -> None:
        self._burn_in = document.burn_in  # share of the sweeps
        self.model: Model = model
        self.requested_poses: Mapping[str, Any] = model.poses.describe()  # the document's prior of the poses
        self.problem = problem
        self._sampler = sampler
        self.n_chains = POSE_CHAINS if model.poses.unknown else CHAINS
        self.state = sampler.init(problem, range(self.n_chains), document.seed)
        empty = empty_draws(model, self.state, self.n_chains)
        self._draw_bytes = sum(spec.empty(self.n_chains, 1, empty.shape_of(spec)).nbytes for spec in empty.specs)
        self.total = 0  # sweeps to do
        self.thin = 1  # sweeps per kept draw
        self._record = DrawRecord(empty, SweepPlan(0, 0))
        # Results of the steps so far: latest draws, sums for the means, diagnostics, counts and trace.
        self.seconds = 0.0
        self.shifts = np.zeros((self.n_chains, 2))  # cells by which a chain's map and sensors are shifted together
        self._latest = empty
        self._sums = np.zeros((self.n_chains, *model.grid.shape))
        self._rhat = self._ess = math.nan
        self._diagnose_at_s = 0.0  # time of the next computation of R-hat and effective sample size
        self._diagnosed_sweep = 0  # number of sweeps at the last computation
        self._observed_counts = np.zeros((2, *model.grid.shape), dtype=np.int32)
        self._log_likelihood = self._log_joint = np.zeros((self.n_chains, 0))
        # The sums after the burn-in, and after later sweeps at which a longer burn-in may end.
        self._checkpoints = [Checkpoint(0, np.zeros_like(self._sums), self._observed_counts.copy())]
        self.extend(document.sweeps)

    def extend(self, count: int) -> None:
        """Let the chains do `count` more sweeps from their present states. All draws so far are kept, if they fit."""
        # Thin the kept draws until they fit, and round the sweeps up to a whole number of kept draws.
        total = self.total + count
        self.thin *= math.ceil(total * self._draw_bytes / (MAX_DRAW_BYTES * self.thin))
        self.total = math.ceil(total / self.thin) * self.thin
        self._record = self._record.grown(SweepPlan(0, self.total // self.thin, self.thin))
        padding = ((0, 0), (0, self.total - self._log_joint.shape[1]))
        self._log_joint = np.pad(self._log_joint, padding)
        self._log_likelihood = np.pad(self._log_likelihood, padding)
        # Count observed cells at fixed sweeps. The page must not depend on the lengths of steps, hence on the machine.
        doubling = (2**k for k in range(self.total.bit_length()))
        evenly = (self.total * k // OBSERVED_COUNTS for k in range(1, OBSERVED_COUNTS + 1))
        self._burn_in_end = int(self._burn_in * self.total) // self.thin * self.thin
        self._counted_sweeps = {*doubling, *evenly, self._burn_in_end} - {0}
        self._steps = advance_chains(
            self._sampler, self.state, self.total, keep=Keep(every=1), step_seconds=STEP_SECONDS,
            max_kept=max(1, MAX_BUFFER_BYTES // max(self._draw_bytes, 1)), stops=tuple(sorted(self._counted_sweeps)),
        )  # fmt: skip
        self.done = False
        self._diagnose_at_s = 0.0

    def advance(self) -> None:
        """Do some sweeps: about `STEP_SECONDS` of work."""
        before = self.sweep
        began_s = time.perf_counter()
        self.state, info = next(self._steps)
        self.sweep = int(self.state.sweep)
        self.done = self.sweep >= self.total
        self._latest = replace(self._latest, arrays=info.draws)
        for chain in range(self.n_chains):
            self._sums[chain] += self.model.cells.mean_map(self._latest.of_chain(chain)) * self._latest.count
        self._record.add(info, before)
        self._log_likelihood[:, before : self.sweep] = info.log_likelihood
        self._log_joint[:, before : self.sweep] = info.log_likelihood + info.log_prior
        # Count observed cells, and move the end of the burn-in to the last checkpoint that lies within it.
        if self.sweep in self._counted_sweeps:
            self._observed_counts += self._sampler.observed_counts(self.state, {})
            if self.sweep <= self._burn_in_end:
                self._checkpoints.append(Checkpoint(self.sweep, self._sums.copy(), self._observed_counts.copy()))
            while len(self._checkpoints) > 1 and self._checkpoints[1].sweep <= self._burn_in * self.sweep:
                del self._checkpoints[0]
        if self.done and self._checkpoints[0].sweep < self._burn_in_end:
            # There is no checkpoint of this sweep: the kept draws give the sums up to it.
            end = self._burn_in_end
            burned_draws = self.draws.select(slice(end // self.thin))
            maps = [self.model.cells.mean_map(burned_draws.of_chain(chain)) * end for chain in range(self.n_chains)]
            self._checkpoints = [Checkpoint(end, np.array(maps), self._checkpoints[0].observed_counts)]
        self.seconds += time.perf_counter() - began_s

    @property
    def poses(self) -> Mapping[str, Any]:
        """The document's prior of the poses. The model's may be a little wider, see `MIN_SIGMA_M`."""
        return self.requested_poses

    @property
    def draws(self) -> Draws:
        """The kept draws."""
        return self._record.draws

    def mean(self) -> Floats:
        """Return the probability that a cell stops a beam, averaged over the sweeps after the burn-in, (nx, ny).
        If poses are known, cells that no beam touches get the exact prior mean, to which their draws converge.
        """
        mean = self.means().mean(axis=0)
        if self.model.poses.unknown:  # which cells beams touch depends on the poses
            return np.asarray(mean)
        return np.where(self.problem.touched_map(), mean, self.model.cells.mean_stop(self.model.grid))

    def means(self) -> Floats:
        """Return the mean map of each chain, (chains, nx, ny)."""
        burned = self._checkpoints[0]
        return (self._sums - burned.sums) / max(1, self.sweep - burned.sweep)

    def reached(self) -> Floats:
        observed, inspected = self._observed_counts - self._checkpoints[0].observed_counts
        return np.asarray(observed / np.maximum(1, inspected))

    def draw(self, chain: int | None, number: int | None) -> DrawnMap:
        """Return a kept draw, the last if none has that number. Before the first, return the chain's latest draw."""
        draws, chain = self.draws, min(chain or 0, self.n_chains - 1)
        if draws.count == 0:
            return DrawnMap(self.model.cells.map_of(self._latest, chain, -1), chain, 0)
        number = draws.count - 1 if number is None else min(number, draws.count - 1)
        return DrawnMap(self.model.cells.map_of(draws, chain, number), chain, number)

    def log_joint(self) -> Floats:
        return self._log_joint[:, : self.sweep]

    @property
    def kept_draws(self) -> Draws | None:
        return self.draws if self.draws.count else None

    @property
    def available_draws(self) -> Draws | None:
        """The kept draws after the burn-in, thinned until the chains are done; at first the latest draws."""
        draws = self.draws.select(slice(self._checkpoints[0].sweep // self.thin, None))
        if not draws.count:
            draws = self._latest
        if not draws.count:
            return None
        return draws if self.done else draws.thinned(RECENT_DRAWS * self.n_chains)

    def progress(self, ended: bool) -> Progress:
        """Return the sweeps done and the diagnostics, which may be of an earlier sweep while the chains run."""
        burned = self._checkpoints[0].sweep
        log_joint = self.log_joint()
        self._diagnose(log_joint[:, burned:])
        return Progress(
            sweeps=self.sweep, total=self.total, ess=self._ess, rhat=self._rhat,
            log_joint=float(log_joint[:, -1].mean()) if log_joint.shape[1] else math.nan,
            verdict=self._judge(log_joint[:, burned:], ended or self.done), burned=burned, seconds=self.seconds,
        )  # fmt: skip

    def _diagnose(self, log_joint: Floats) -> None:
        """Update R-hat and effective sample size of the log joint after the burn-in, (chains, n), if it is time to."""
        began_s = time.perf_counter()
        if began_s >= self._diagnose_at_s or (self.done and self._diagnosed_sweep < self.sweep):
            self._rhat, self._ess = rhat_and_ess(log_joint)
            self._diagnosed_sweep = self.sweep
            pause_s = (time.perf_counter() - began_s) / MAX_DIAGNOSIS_SHARE
            self._diagnose_at_s = math.inf if self.done else began_s + pause_s

    def _judge(self, log_joint: Floats, ended: bool) -> Verdict | None:
        """Return the verdict on the chains, given the log joint after the burn-in, (chains, n); None if too early."""
        misfit = None
        if isinstance(self.model.sensor, Gaussian) and not self.model.poses.unknown:
            log_likelihood = self._log_likelihood[:, self._checkpoints[0].sweep : self.sweep]
            misfit = misfit_of(log_likelihood, self.model.sensor.sigma_m, self.model.scans.ranges_m.size)
        verdict = judge_chains(
            self._rhat, self._ess, self.sweep, compare_means(self.means(), self.observed()), ended=ended,
            quantity=self.model.cells.words.mean, misfit=misfit,
        )  # fmt: skip
        return judge_shifted_chains(verdict, log_joint, self.sweep, self.shifts)

    def as_run(self, result: Result) -> Run:
        if self.kept_draws is None:
            return super().as_run(result)
        chains = self._record.chains(
            snapshot=self._sampler.snapshot(self.state), observed_counts=self._observed_counts, statistics={},
            n_incidences=self.problem.n_incidences, finished=self.done,
            seconds={"trace": 0.0, "warm_start": 0.0, "sampling": self.seconds},
        )  # fmt: skip
        # The burn-in becomes the warm-up of the run: its draws are left out.
        burned = self._checkpoints[0]
        first = burned.sweep // self.thin
        chains = replace(
            chains, draws=chains.draws.select(slice(first, None)), log_likelihood=chains.log_likelihood[:, first:],
            log_prior=chains.log_prior[:, first:], warmup_log_joint=self.log_joint()[:, : burned.sweep],
            observed_counts=self._observed_counts - burned.observed_counts,
        )  # fmt: skip
        schedule = Schedule(self.n_chains, burned.sweep, draws=self.total // self.thin - first, thin=self.thin)
        settings = result.settings_of_run(self.model, schedule)
        return Run(posterior_of_chains(self.model, chains, settings, {"total": self.seconds}, None))


def pose_prior(document: Document) -> PosePrior | None:
    """Return the prior of the sensors' poses; None if they are known, or if the method treats them as known."""
    if not document.samples_poses:
        return None
    return UncertainPoses(max(document.pose_sigma, MIN_SIGMA_M), max(document.heading_sigma, MIN_SIGMA_RAD))


def pose_starts(document: Document, chains: int) -> NDArray[np.float64]:
    """Return the poses from which chains start: the document's poses, shifted by whole cells, (chains, S, 3).

    A map and all its sensors can be shifted together by whole cells. The likelihood then changes only at the border. So
    the posterior has a mode at every shift s. With S sensors, the prior weight of a mode is exp(-S s^2 / (2 sigma^2)).
    No chain moves from one mode to the next, so chains are distributed over the modes by these weights. Shifts by parts
    of a cell are avoided: walls would not fit the cells, and chains would take long to leave the start.
    """
    poses = np.array([(sensor.x, sensor.y, sensor.yaw) for sensor in document.sensors])
    sigma_cells = max(document.pose_sigma, MIN_SIGMA_M) / math.sqrt(len(poses)) / document.grid.resolution
    max_cells = math.ceil(MAX_SHIFT_SIGMAS * sigma_cells)
    cells = np.arange(-max_cells, max_cells + 1)
    cumulative = np.cumsum(np.exp(-0.5 * (cells / sigma_cells) ** 2))
    # Evenly spread points of the unit square, one per chain, become shifts by the inverse distribution function.
    points = (0.5 + np.outer(np.arange(chains), EVEN_STEPS)) % 1.0
    shifts = cells[np.searchsorted(cumulative / cumulative[-1], points)] * document.grid.resolution
    starts = np.repeat(poses[None], chains, axis=0)
    starts[:, :, :2] += shifts[:, None]
    return starts


def chains_of_walls(scene: Scene, document: Document, first_maps: NDArray[np.bool_]) -> RunningChains:
    """Return chains of a document with walls that start from `first_maps`, one per chain, (chains, nx, ny).
    Uncertain poses are sampled with the walls, as by `bayesmap.infer` without warm-up. They start from `pose_starts`.
    """
    walls = scene.problem
    model = scene.model(walls.prior)
    sampler = make_sampler(walls.prior.methods[document.sampler], walls.grid, Gibbs(document.order, first_maps))
    poses = pose_prior(document)
    if poses is None:
        return RunningChains(model, sampler, walls, document)
    model = replace(model, poses=poses)
    joint_problem = PoseProblem(model, walls.for_any_poses(), walls.device, walls.threads)
    first_poses = pose_starts(document, POSE_CHAINS)
    # Without warm-up (0), the sizes of pose steps are not adapted.
    chains = RunningChains(model, WithPoses(cast(MovableSampler, sampler), 0, first_poses), joint_problem, document)
    shifts_m = first_poses[:, 0, :2] - pose_starts(document, 1)[0, 0, :2]
    chains.shifts = np.rint(shifts_m / document.grid.resolution)
    chains.requested_poses = {"kind": "uncertain", "sigma_m": document.pose_sigma, "sigma_rad": document.heading_sigma}
    return chains


def first_maps_of(problem: WallProblem, document: Document, preview: Preview | None) -> NDArray[np.bool_]:
    """Return the map from which each chain starts, (chains, nx, ny). It depends on the document alone.

    Without a preview, the start "auto" means prior draws. After a preview, the chains of a simulation start alternately
    from the beliefs and from the empty map: chains that start alike agree on a wrong answer long before they leave it.
    For a file, whose maps are large, all chains start from the beliefs. Prior draws fill the cells without beliefs.
    """
    n_chains = POSE_CHAINS if document.samples_poses else CHAINS

    def draw_maps(kind: Start, marginals: Marginals | None = None) -> NDArray[np.bool_]:
        return start_maps(problem, kind, range(n_chains), document.seed, marginals)

    if document.start == "empty":
        return draw_maps("zeros")
    if document.start == "prior" or preview is None:
        return draw_maps("prior")
    maps = draw_maps("propagate", preview.marginals())
    if not document.simulated:
        return maps
    maps[1::2] = False
    if document.samples_poses:  # shifted chains start empty: the beliefs belong to the poses without a shift
        maps[(pose_starts(document, n_chains) != pose_starts(document, 1)).any(axis=(1, 2))] = False
    return maps


class Pilot(Estimate):
    """The chain that fits sensor and prior: the model after ``sweep`` of ``total`` sweeps, and the later draws."""

    approximate = True

    def __init__(self, model: Model, draws: Draws, sweep: int, total: int, touched: NDArray[np.bool_]) -> None:
        self.model: Model = model
        self.draws, self.sweep, self.total, self.averaged = draws, sweep, total, draws.count
        self._touched = touched

    @property
    def available_draws(self) -> Draws:
        """The latter half of the pilot's draws."""
        return self.draws

    def progress(self, ended: bool) -> Progress:
        return Progress(self.sweep, self.total)

    def mean(self) -> Floats:
        return self.model.cells.mean_map(self.draws)

    def reached(self) -> Floats:
        """Return 1 in the cells that a beam touches, and 0 in the others, (nx, ny)."""
        return self._touched.astype(np.float64)

    def draw(self, chain: int | None, number: int | None) -> DrawnMap:
        """Return the pilot's last draw."""
        return DrawnMap(self.model.cells.map_of(self.draws, 0, -1), 0, 0)


def append_draws(before: Draws | None, after: Draws, max_draws: int) -> Draws:
    """Return the last draws of two blocks: at most `max_draws` per chain, and at most `MAX_RECENT_BYTES`."""
    draw_bytes = sum(array[:, :1].nbytes for array in after.arrays.values())
    n_last = min(max_draws, max(1, MAX_RECENT_BYTES // max(draw_bytes, 1)))
    blocks: tuple[Draws, ...] = (after,)
    if before is not None and before.index.keys() == after.index.keys():
        blocks = (before, after)
    joined = {name: np.concatenate([block.arrays[name] for block in blocks], axis=1) for name in after.arrays}
    return replace(after, arrays={name: array[:, -n_last:] for name, array in joined.items()})


class FittedModel(NamedTuple):
    """A model under the fitted sensor and prior, with its sampler and its problem."""

    model: Model
    sampler: Any
    problem: Any


def fit_by_pilot(scene: Scene, document: Document, show: Callable[[Pilot], None]) -> Generator[None, None, FittedModel]:
    """Fit sensor and prior to the readings in short steps; ``show`` gets the pilot after every sweep."""
    prior = BUILT_IN[document.cells]()
    start_sensor = initial_sensor(prior, document.grid.resolution)
    model = replace(scene.model(prior), sensor=start_sensor, hit_depth=prior.hit_depth)
    sampler = make_sampler(prior.methods["gibbs"], model.grid, Gibbs())
    problem = sampler.prepare(model, "cpu")
    yield
    pilot = pilot_sweeps(problem, document.seed, PILOT_SWEEPS, keep=Keep(every=1))
    draws: Draws | None = None
    touched = scene.problem.touched_map()
    for sweep, (fit, info) in enumerate(pilot, 1):
        problem, model = problem.under(fit.sensor, fit.prior), replace(model, sensor=fit.sensor, cells=fit.prior)
        latest = Draws(model.grid, fit.prior.arrays, info.draws, problem.coordinates)
        draws = append_draws(draws, latest, math.ceil(sweep / 2))
        show(Pilot(model, draws, sweep, PILOT_SWEEPS, touched))
        yield
    return FittedModel(model, sampler, sampler.prepare(model, "cpu"))  # traces beams as far as the fitted noise reaches
