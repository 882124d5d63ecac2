"""The public functions: `infer` computes the posterior over maps, `slam` that over maps and trajectories.

`slam` first approximates all poses (`bayesmap.poses.slam`: matching, loops, a Gaussian about the likeliest poses). Then
chains sample the map and the poses of the key scans under the forward law of `infer`. Each chain starts from its own
draw of the approximation. Chains correct details; the bend of a long loop stays near its start (docs/how/poses.md).

Read `infer` and then `Inference.run`, which fits the sensor, runs the chains and returns the run.
"""

import os
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal, cast

import numpy as np

from bayesmap.arguments import Checkpoints, Schedule, Where, need_value
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.surface import Surface
from bayesmap.errors import BadInput, check_count, near_names
from bayesmap.model import Model
from bayesmap.poses.prior import KnownPoses, PosePrior, UncertainPoses
from bayesmap.posterior.posterior import Posterior, chains_of, posterior_of_chains, posterior_of_draws
from bayesmap.result import Run
from bayesmap.run.chains import Chains, SweepPlan
from bayesmap.run.cost import MIN_TOUCHED_SHARE, Estimate, Sampling, estimate, size_of
from bayesmap.run.fingerprint import RANDOM_STREAMS, compute_fingerprint, refuse_changes
from bayesmap.run.runner import Job, ThreadExecutor, draw_first_map, stop_on_interrupt
from bayesmap.samplers import methods
from bayesmap.samplers.fit import PILOT_SWEEPS, Parameters, fit, fit_coupling_to_scans, fit_sensor, initial_sensor
from bayesmap.samplers.methods import Gibbs, Method, Propagate
from bayesmap.samplers.sampler import Event as Event
from bayesmap.samplers.sampler import Sampler, Watch
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.wall_problem import trace_walls
from bayesmap.samplers.walls import WallGibbs
from bayesmap.samplers.with_poses import MovableSampler, WithPoses
from bayesmap.samplers.without_chains import ROUNDS, DrawRequest
from bayesmap.sensors.model import SensorModel, describe
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

FIT = "fit"  # value of ``sensor`` that asks for a fit
EXAMPLE_PRIORS = "bm.Independent(0.2) or bm.Surface()"  # priors that error messages suggest
EXAMPLE_POSES = "bm.UncertainPoses(0.1, 0.05) or bm.Odometry()"
POSE_SAMPLERS = ("wall-gibbs", "wall-blocks", "stop-gibbs")  # samplers that can sample unknown poses


@near_names
def infer(
    scans: Scans, grid: Grid, *, prior: CellPrior | None = None, sensor: SensorModel | Literal["fit"] = "fit",
    method: Method | str | None = None, schedule: Schedule = Schedule(), seed: int = 0, poses: PosePrior | None = None,
    hit_depth: float = 0.0, where: Where = Where(), checkpoints: Checkpoints = Checkpoints(),
    on_progress: Callable[[Event], None] | None = None,
) -> Run:  # fmt: skip
    """Infer the map from scans: walls, or the share of beams that cells stop, and the surfaces in them.

    The result depends only on the arguments up to ``hit_depth``, and in the last bits on the kind of device. It does
    not depend on the number of threads, nor on stops and resumes of the run. The draws of a chain depend on its number,
    not on the number of chains. This includes the fit: a separate pilot fits sensor and prior beforehand.

    Args:
        scans: readings of the sensor, and the poses of the scans.
        grid: the map to infer.
        prior: decides what a cell's state is: `Independent` (binary walls) or `Ising` (binary walls that depend on
            their neighbours), `Beta` (reflectivities), `Surface` (reflectivities and surfaces; with a coupling
            neighbours depend on each other in both), or your own (`CellPrior`). None: ``Surface()``.
        sensor: the law of the readings; "fit" fits a `BeamMixture`, and the prior's numbers, to the scans.
        method: a method with its options, or its name for the defaults. Binary walls have `Gibbs` ("gibbs"), `Block`
            ("block"), `Propagate` ("propagate"), `Importance` ("importance") and `Exact` ("exact"); `Beta` and
            `Surface` have `Gibbs` alone. None: the first of the kind of cells.
        schedule: numbers of chains, warm-up sweeps and draws.
        seed: seed of all random numbers.
        poses: prior of the scans' poses: `KnownPoses`, `UncertainPoses` about the log's, or `Odometry`. Unknown poses
            are sampled along with the map: ``run.poses``. None: ``KnownPoses()``.
        hit_depth: point in a cell where a beam stops, as a fraction of its chord; 0, as in the tutorial: the near edge.
        where: threads, device and executor; by default all cores of this machine.
        checkpoints: the run to resume, and the function that saves the run so far; by default neither.
        on_progress: called with the progress of the run, about four times per second.

    Returns the run. Ctrl-C stops at the end of the current sweeps and returns the run so far, with ``finished`` False.
    Raises `BadInput` for invalid arguments, or a run to resume that was made with other arguments.
    """
    laws = ChosenLaws(prior, sensor, poses, hit_depth)
    inference = Inference.of(scans, grid, laws, method, schedule, seed, where)
    need_value("infer", "checkpoints", checkpoints, Checkpoints)
    with stop_on_interrupt() as should_stop:
        return inference.run(checkpoints, Watch(on_progress, should_stop))


@near_names
def slam(
    log: str | os.PathLike[str] | Scans, *, resolution: float = 0.1, prior: CellPrior | None = None,
    sensor: SensorModel | Literal["fit"] = "fit", fast: bool | None = None, no_odometry: bool = False,
    schedule: Schedule = Schedule(), seed: int = 0, hit_depth: float | None = None, where: Where = Where(),
    checkpoints: Checkpoints = Checkpoints(), on_progress: Callable[[Event], None] | None = None,
) -> Run:  # fmt: skip
    """Infer map and trajectory from a log with raw odometry.

    Args:
        log: a file that `bayesmap.read_log` reads, or scans; their poses are raw odometry.
        resolution: edge of a cell, metres.
        prior: the kind of cells with its prior; `Surface()` if None.
        sensor: the law of the readings, or "fit".
        fast: True: infer the map as if the poses of the approximate trajectory were known, from as many scans and beams
            as its cells need; False: sample the poses, too, from all beams of the key scans; None: sample the poses of
            at most 100 key scans, since chains over more do not mix.
        no_odometry: do not read the poses of the log; scans must come at about 5 Hz.
        schedule: numbers of chains, warm-up sweeps and draws; by default every sweep after warm-up is kept.
        seed: seed of all random numbers.
        hit_depth: point in a cell where a beam stops, see `bayesmap.infer`; None: the default of the kind of cells.
        where: threads, device and executor; by default all cores of this machine.
        checkpoints: the run to resume, the function that saves the run so far, and the folder for finished stages of
            the approximation; by default none of them.
        on_progress: called with the progress of the run.

    Returns the run over the key scans: ``run.poses`` are draws of their poses, ``run.trajectory`` has all scans.
    Raises `BadInput` as `bayesmap.read_log`, `bayesmap.poses.slam.infer_trajectory` and `bayesmap.infer`.
    """
    from bayesmap.poses import map_scans
    from bayesmap.poses.slam import infer_trajectory

    need_value("slam", "schedule", schedule, Schedule)
    need_value("slam", "where", where, Where)
    need_value("slam", "checkpoints", checkpoints, Checkpoints)
    if not isinstance(log, Scans):
        from bayesmap.io.logs import read_log

        log = read_log(log)
    # Refuse an impossible grid at once: the map will cover the first scan, whose pose stays as odometry stated it.
    Grid.covering(log.select(slice(0, 1)), resolution)

    if not where.any_size:
        cost = estimate_slam(log, resolution, ChosenLaws(prior, sensor), fast, no_odometry, schedule, where)
        if cost is not None:
            cost.refuse(log)

    trajectory = infer_trajectory(
        log, no_odometry=no_odometry, seed=seed, threads=where.threads, device=where.device,
        checkpoint=checkpoints.stages, on_progress=Watch(on_progress).report,  # type: ignore[arg-type]
    )  # fmt: skip
    if checkpoints.trajectory is not None:
        checkpoints.trajectory(trajectory)
    # Select the key scans, and lay the grid over them.
    keys = map_scans.select_key_scans(log, trajectory, schedule.chains, seed)
    grid = Grid.covering(keys.scans, resolution)
    cells = Surface() if prior is None else prior
    fast = len(keys.scans) > map_scans.MAX_SAMPLED_KEYS if fast is None else fast

    # Sample the map; unless ``fast``, sample the poses of the key scans too.
    def with_trajectory(callback: Callable[[Run], None] | None) -> Callable[[Run], None] | None:
        return None if callback is None else lambda run: callback(replace(run, trajectory=trajectory))

    save, preview = with_trajectory(checkpoints.save), with_trajectory(checkpoints.preview)
    run = infer(
        map_scans.thin_for_map(keys.scans, resolution) if fast else keys.scans, grid, prior=cells, sensor=sensor,
        method=None if fast else Gibbs(start_poses=keys.starts),
        schedule=replace(schedule, thin=1 if schedule.thin is None else schedule.thin), seed=seed,
        poses=None if fast else keys.prior, hit_depth=cells.hit_depth if hit_depth is None else hit_depth, where=where,
        checkpoints=replace(checkpoints, save=save, preview=preview), on_progress=on_progress,
    )  # fmt: skip
    return replace(run, trajectory=trajectory)


def estimate_slam(
    log: Scans, resolution: float, laws: "ChosenLaws", fast: bool | None, no_odometry: bool, schedule: Schedule,
    where: Where,
) -> Estimate | None:  # fmt: skip
    """Estimate time and memory of `slam` from the poses of the log; None if they allow no map."""
    from bayesmap.poses import map_scans

    keys = map_scans.select_keys_by_odometry(log, no_odometry=no_odometry)
    if len(log) < 2 or not np.isfinite(keys.ranges_m).any():
        return None  # refused with its reason later
    fast = len(keys) > map_scans.MAX_SAMPLED_KEYS if fast is None else fast
    try:
        grid = Grid.covering(keys, resolution)
    except BadInput:  # odometry leaps, which the trajectory will mend
        return None
    poses = KnownPoses() if fast else UncertainPoses(0.1, 0.1)  # their spread does not change the cost
    inference = Inference.of(
        map_scans.thin_for_map(keys, resolution) if fast else keys, grid, replace(laws, poses=poses), None,
        replace(schedule, thin=1 if schedule.thin is None else schedule.thin), 0, where,
    )  # fmt: skip
    return inference.estimate(log)


@dataclass(frozen=True, eq=False)
class ChosenLaws:
    """The laws of cells, readings and poses, as a caller of `infer` chooses them. None stands for the default."""

    prior: CellPrior | None = None
    sensor: SensorModel | str = FIT
    poses: PosePrior | None = None
    hit_depth: float = 0.0  # point in a cell where a beam stops, as a fraction of its chord

    def completed(self) -> tuple[CellPrior, PosePrior]:
        """Return the priors of cells and poses with their defaults. Raises `BadInput` for an invalid law."""
        prior = Surface() if self.prior is None else self.prior
        poses = KnownPoses() if self.poses is None else self.poses
        if not isinstance(prior, CellPrior):
            raise BadInput(f"infer: prior must say what cells are, such as {EXAMPLE_PRIORS}, got {prior!r}")
        if not isinstance(self.sensor, SensorModel) and not (isinstance(self.sensor, str) and self.sensor == FIT):
            raise BadInput(f"infer: sensor must be a sensor model or {FIT!r}, got {self.sensor!r}")
        if not isinstance(poses, PosePrior):
            raise BadInput(f"infer: poses must say what is believed of them, such as {EXAMPLE_POSES}, got {poses!r}")
        if not 0.0 <= self.hit_depth <= 1.0:
            raise BadInput(f"infer: hit_depth must lie in [0, 1], got {self.hit_depth!r}")
        return prior, poses


@dataclass(frozen=True, eq=False)
class Inference:
    """The arguments of `infer`, checked."""

    model: Model  # if the sensor is fitted, with the sensor that the fit starts from
    method_name: str
    method: Method
    plan: SweepPlan  # sweeps of each chain
    request: DrawRequest  # draws of methods without chains; chains take their number and seed from it too
    is_fitted: bool  # whether the sensor is to be fitted
    where: Where

    @classmethod
    def of(
        cls, scans: Scans, grid: Grid, laws: ChosenLaws, method: Method | str | None, schedule: Schedule, seed: int,
        where: Where,
    ) -> "Inference":  # fmt: skip
        """Check the arguments of `infer`, and fill in the defaults of the kind of cells."""
        need_value("infer", "schedule", schedule, Schedule)
        need_value("infer", "where", where, Where)
        prior, poses = laws.completed()
        method_name, method = methods.resolve_method(method, prior.methods, type(prior).__name__)
        start_poses = getattr(method, "start_poses", None)
        if start_poses is not None and np.shape(start_poses)[1:] != scans.poses.shape:
            raise BadInput(f"infer: start_poses has shape {np.shape(start_poses)}, expected (chains, {len(scans)}, 3)")
        _check_scans(scans, grid)
        is_fitted = isinstance(laws.sensor, str)
        sensor = initial_sensor(prior, grid.resolution) if isinstance(laws.sensor, str) else laws.sensor
        model = Model(scans, grid, prior, sensor, poses, float(laws.hit_depth))
        if poses.unknown and prior.methods[method_name] not in POSE_SAMPLERS:
            reason = f"method {method_name!r} of {type(prior).__name__} takes poses as known"
            raise BadInput(f"infer: {reason}; leave poses out, or take another method")

        def default_draws(thin: int) -> int:
            if method_name == Propagate.name:  # its answer is the marginals
                return 0
            return prior.default_draws(scans.n_beams, grid.n_cells, schedule.chains, thin)

        complete = schedule.completed(prior.sweeps_a_draw, default_draws)
        draws, thin = cast(int, complete.draws), cast(int, complete.thin)
        particles, rounds = getattr(method, "particles", methods.PARTICLES), getattr(method, "rounds", ROUNDS)
        request = DrawRequest(schedule.chains, draws, check_count("infer", "seed", seed, 0), particles, rounds)
        plan = SweepPlan(schedule.warmup, draws, thin, complete.precision, complete.seconds)
        return cls(model, method_name, method, plan, request, is_fitted, where)

    @property
    def sampler_name(self) -> str:
        """The name of the sampler that implements the method for this kind of cells."""
        return self.model.cells.methods[self.method_name]

    def run(self, checkpoints: Checkpoints, watch: Watch) -> Run:
        """Fit sensor and prior, sample the posterior, and return the run."""
        began = time.perf_counter()
        executor = ThreadExecutor() if self.where.executor is None else self.where.executor
        if not self.where.any_size and (cost := self.estimate()) is not None:
            cost.refuse(self.model.scans)
        # The settings hold everything that determines the draws. A stopped run must have the same arguments.
        settings = self._settings()
        stopped = self._posterior_to_resume(checkpoints.resume, settings)
        clock = _RunClock(self, checkpoints, settings, stopped, began)
        model, parameters = self._fit_model(clock, settings, stopped, watch)
        seconds = {"fit": time.perf_counter() - began if "fitted" in settings else 0.0}
        settings["threads_used"] = self._threads_used()
        # Methods without chains: draw independent maps.
        device, threads = self.where.device, self.where.threads
        if self.sampler_name in methods.INDEPENDENT_SAMPLERS:
            problem = trace_walls(model, device, threads)
            seconds["trace"] = time.perf_counter() - began - seconds["fit"]
            draws = methods.INDEPENDENT_SAMPLERS[self.sampler_name](problem, self.request, watch)
            seconds["total"] = clock.elapsed_s()
            return Run(posterior_of_draws(model, draws, problem.n_incidences, settings, seconds))

        def as_run(chains: Chains) -> Run:
            seconds["total"] = clock.elapsed_s()
            return Run(posterior_of_chains(model, chains, settings, seconds, parameters))

        # Show a first map, unless a pilot has done so. If the chains run elsewhere, no beams are traced here.
        problem_here = None
        is_local = isinstance(executor, ThreadExecutor) and not model.poses.unknown
        if clock.needs_first_map and parameters is None and stopped is None and is_local:
            sampler = self._sampler(clock.plan.warmup)
            problem_here = sampler.prepare(model, device, threads, watch)
            clock.make_first_map(model, sampler, problem_here)
        limit_s = clock.plan.seconds
        plan = clock.plan if limit_s is None else replace(clock.plan, seconds=max(0.0, limit_s - clock.elapsed_s()))
        settings["warmup"] = plan.warmup
        job = Job(
            model, self._sampler(plan.warmup), schedule=plan, seed=self.request.seed, device=device, threads=threads,
            chain_ids=tuple(range(self.request.chains)), parameters=parameters, problem=problem_here,
        )  # fmt: skip
        save = checkpoints.save
        earlier = None if stopped is None else chains_of(stopped)
        on_checkpoint = None if save is None else lambda chains: save(as_run(chains))
        return as_run(executor.run(job, earlier, watch, on_checkpoint, checkpoints.every_s))

    def _fit_model(
        self, clock: "_RunClock", settings: dict[str, Any], stopped: Posterior | None, watch: Watch
    ) -> tuple[Model, Parameters | None]:
        """Fit sensor and prior where asked for. Returns the model of the chains, and the parameters of a pilot."""
        model = self.model
        parameters = None
        device, threads, seed = self.where.device, self.where.threads, self.request.seed
        if self.is_fitted and self.sampler_name == "stop-gibbs":  # a pilot fits the sensor and the prior of stops
            if stopped is not None:
                parameters = Parameters.from_description(stopped.settings["fitted"])
            else:
                problem = self._sampler(clock.plan.warmup).prepare(model, device, threads, watch)
                cells = problem.cells if model.poses.unknown else problem
                begun = clock.make_first_map(model, StopGibbs(), cells)
                parameters = fit(cells, seed, min(PILOT_SWEEPS, clock.plan.warmup), watch, begun)
            settings["fitted"] = parameters.describe()
        elif self.is_fitted:  # walls, without a pilot
            model = replace(model, sensor=fit_sensor(model, device, seed=seed, threads=threads, watch=watch))
            settings["fitted"] = {"sensor": describe(model.sensor)}
        if model.cells.is_incomplete:  # the coupling of walls
            walls = methods.WALL_SAMPLERS.get(self.sampler_name, WallGibbs)()  # single cells, if without chains
            prior = fit_coupling_to_scans(model, walls, device, seed=seed, threads=threads, watch=watch)
            model = replace(model, cells=prior)
            settings["fitted"] = {**settings.get("fitted", {}), "prior": prior.describe()}
        return model, parameters

    def estimate(self, log: Scans | None = None) -> Estimate | None:
        """Estimate time and memory; None on a GPU, and for samplers of unknown cost. `slam` gives its ``log``, too."""
        if self.where.device != "cpu":
            return None
        is_local = self.where.executor is None or isinstance(self.where.executor, ThreadExecutor)
        sampling = Sampling(
            self.sampler_name, self.model.arrays, self.model.cells.has_surfaces, plan=self.plan,
            chains=self.request.chains if is_local else 1, is_fitted=self.is_fitted,
            samples_poses=self.model.poses.unknown, cores=self._threads_used(),
        )  # fmt: skip
        size = size_of(self.model.scans, self.model.grid, log)
        if log is not None:  # drift of odometry makes the grid too large, but beams touch no more cells
            size = replace(size, cells=min(size.cells, size.touched / MIN_TOUCHED_SHARE))
        cost = estimate(self.model.scans if log is None else log, self.model.grid, size, sampling)
        # If only the pilot runs here, and the chains elsewhere, their time is not known.
        return cost if is_local or cost is None else replace(cost, processor_s=None)

    def _sampler(self, warmup: int) -> Sampler[Any, Any]:
        """Return the sampler of the chains."""
        method = cast(Gibbs, self.method)
        if not self.model.poses.unknown:
            return methods.make_sampler(self.sampler_name, self.model.grid, method, warmup)
        sampler = methods.make_sampler(self.sampler_name, self.model.grid, method)
        return WithPoses(cast(MovableSampler, sampler), warmup, method.start_poses)

    def _posterior_to_resume(self, run: Run | None, settings: dict[str, Any]) -> Posterior | None:
        """Add the fingerprint to the settings, and return the posterior to resume; None without a run or a sweep."""
        start = getattr(self.method, "start", None)
        start_map = None if isinstance(start, str) else start
        start_poses = getattr(self.method, "start_poses", None)
        settings["fingerprint"] = compute_fingerprint(settings, self.model, start_map, start_poses)
        if run is None:
            return None
        posterior = run.posterior
        old, new = posterior.prior.words, self.model.cells.words
        if old.kind != new.kind:
            raise BadInput(f"resume: the saved run is one over {old.states}, not over {new.states}")
        refuse_changes(posterior.settings, settings)
        return posterior if posterior.sweep > 0 else None

    def _settings(self) -> dict[str, Any]:
        """Return everything that determines the draws, as JSON values."""
        request, plan = self.request, self.plan
        return {
            "method": self.method_name, **methods.sampler_options(self.sampler_name, self.model.grid, self.method),
            "chains": request.chains, "warmup": plan.warmup, "draws": plan.draws, "thin": plan.thin,
            "precision": plan.precision, "seed": request.seed, "particles": request.particles, "rounds": request.rounds,
            "hit_depth": self.model.hit_depth, "prior": self.model.cells.describe(),
            "sensor": FIT if self.is_fitted else describe(self.model.sensor), "streams": RANDOM_STREAMS,
            "poses": self.model.poses.describe(),
        }  # fmt: skip

    def _threads_used(self) -> int:
        from bayesmap.kernels.device import available_cores

        # The GPU may be on another machine, so this process does not look for it.
        return (self.where.threads or available_cores()) if self.where.device == "cpu" else 1


class _RunClock:
    """The time of a run: seconds elapsed, the plan of the chains in a limited time, and a first map."""

    def __init__(
        self, inference: Inference, checkpoints: Checkpoints, settings: dict[str, Any], stopped: Posterior | None,
        began: float,
    ) -> None:  # fmt: skip
        self._request, self._preview, self._settings = inference.request, checkpoints.preview, settings
        self._began = began - (0.0 if stopped is None else stopped.seconds["total"])
        self.plan = inference.plan if stopped is None else replace(inference.plan, warmup=stopped.settings["warmup"])

    @property
    def needs_first_map(self) -> bool:
        """True if a first map is to be shown, or the time is limited, so that the speed must be measured."""
        return self._preview is not None or self.plan.seconds is not None

    def elapsed_s(self) -> float:
        """Return the seconds since the start of the run, earlier parts included."""
        return time.perf_counter() - self._began

    def make_first_map(self, model: Model, sampler: Sampler[Any, Any], problem: Any) -> Any:
        """Show a first map, and shorten the warm-up if the time of the chains is limited. Returns the pilot so far."""
        if not self.needs_first_map:
            return None
        model = replace(model, poses=KnownPoses())  # a first map samples no poses
        first_map, sweep_s, pilot = draw_first_map(sampler, problem, model, self._request.seed)
        if self._preview is not None:
            seconds = {"total": self.elapsed_s(), "fit": 0.0}
            self._preview(Run(posterior_of_chains(model, first_map, self._settings, seconds, None)))
        if (plan := self.plan).seconds is not None:  # the pilot makes as many sweeps as the warm-up
            self.plan = plan.shortened(sweep_s * (1 + self._request.chains), plan.seconds - self.elapsed_s())
        return pilot


def _check_scans(scans: Scans, grid: Grid) -> None:
    """Refuse scans without information about the map: all readings are invalid, or none lies on the grid."""
    if not len(scans):
        return
    if np.isnan(scans.ranges_m).all():
        raise BadInput(f"infer: all {scans.n_beams:,} readings are NaN, which is invalid; no return is inf")
    points = np.concatenate([scans.poses[:, :2], scans.hit_points_world()])
    cells = np.floor(grid.to_cells(points))
    if not ((cells >= 0) & (cells < grid.shape)).all(axis=1).any():
        (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
        reason = f"no scan and no hit lies on the grid, {grid.extent_words()}"
        remedy = "which bm.Grid.covering(scans, resolution) holds"
        raise BadInput(f"infer: {reason}; they lie at x {x0:g} to {x1:g}, y {y0:g} to {y1:g} m, {remedy}")
