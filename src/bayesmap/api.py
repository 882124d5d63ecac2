"""The public `infer`: from scans to a posterior, for any kind of cells, by any of its methods."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.kind import CellPrior
from bayesmap.errors import BadInput, check_count
from bayesmap.model import Model
from bayesmap.poses.prior import Known, PosePrior
from bayesmap.posterior.posterior import Posterior, chains_of, posterior_of_chains, posterior_of_draws
from bayesmap.result import Run
from bayesmap.run.chains import Chains, Schedule
from bayesmap.run.fingerprint import RANDOM_STREAMS, check_same, fingerprint
from bayesmap.run.memory import check_memory
from bayesmap.run.runner import Executor, Job, ThreadExecutor, stop_on_interrupt
from bayesmap.samplers.coupling_pilot import fit_coupling_to_scans
from bayesmap.samplers.fit import PILOT_SWEEPS, Parameters, first_sensor, fit, fit_sensor
from bayesmap.samplers.methods import WITHOUT_CHAINS, sampler_of, sampler_on_walls
from bayesmap.samplers.progress import Event as Event
from bayesmap.samplers.progress import Watch
from bayesmap.samplers.propagate import ROUNDS
from bayesmap.samplers.sampler import Sampler
from bayesmap.samplers.wall_problem import trace_walls
from bayesmap.samplers.walls import Order, Start, default_start
from bayesmap.samplers.with_poses import MovableSampler, WithPoses
from bayesmap.samplers.without_chains import DrawRequest
from bayesmap.sensors.describe import describe
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

FIT = "fit"


def infer(
    scans: Scans,
    grid: Grid,
    *,
    prior: CellPrior,
    sensor: SensorModel | Literal["fit"],
    method: str | None = None,
    order: Order = "radial",
    chains: int = 4,
    warmup: int = 100,
    draws: int | None = None,
    thin: int | None = None,
    seed: int = 0,
    start: Start | NDArray[np.bool_] | None = None,
    poses: PosePrior | None = None,
    start_poses: NDArray[np.float64] | None = None,
    particles: int = 100_000,
    rounds: int = ROUNDS,
    hit_depth: float = 0.0,
    threads: int | None = None,
    device: str = "cpu",
    resume: Run | None = None,
    on_progress: Callable[[Event], None] | None = None,
    on_checkpoint: Callable[[Run], None] | None = None,
    checkpoint_every_s: float = 30.0,
    executor: Executor | None = None,
) -> Run:
    """Infer the walls from scans; or, where the prior says that cells stop only some beams, how many, and where.

    The result depends on the arguments up to ``hit_depth`` alone, and on the kind of device in the last bits: neither
    on the number of threads nor on how often the run was stopped and resumed. What chain 5 draws depends on its number
    and not on how many others there are, the fit included: a pilot of its own fits sensor and prior beforehand.

    Args:
        scans: what the sensor reported, and from where.
        grid: the map to infer.
        prior: decides what a cell's state is: `Independent` (binary walls) or `Ising` (binary walls whose neighbours
            know of each other), `Beta` (reflectivities), `Surface` (reflectivities and surfaces; with a coupling
            neighbours of both know of each other, too), or a kind of your own (`bayesmap.cells.kind.CellPrior`).
        sensor: the law of the readings; "fit" fits a `BeamMixture`, and with it the numbers of a `Beta` or `Surface`,
            to the scans themselves.
        method: by default the first that the kind of cells has. Of binary walls: "gibbs" (single cells), "block"
            (overlapping 2 x 2 blocks: use it where walls are rare), "propagate" (belief propagation: approximate, at
            once), "importance" (from the prior: for teaching), or "exact" (at most 16 unknown cells). `Beta` and
            `Surface` have "gibbs" alone, and neither order nor start.
        order: of the cells or blocks in a sweep: "radial", "raster" or "random".
        chains: how many Markov chains; the other methods give ``chains * draws`` independent draws.
        warmup: sweeps of each chain that are not kept.
        draws: maps that each chain keeps; by default 1000, or of `Beta` and `Surface`, whose draws are larger and mix
            in tens of sweeps, 100 to 200 (50 to 200 if ``thin`` is 1), the more the fewer beams there are
            (`CellPrior.default_draws`); but none for "propagate", whose answer is the marginals.
        thin: sweeps from one kept map to the next; by default 1, or of `Beta` and `Surface`, where draws are not given
            either, 3.
        seed: of all random numbers.
        start: "prior", "zeros", "ones", "propagate", or a map; by default "propagate" on maps of more than 10 000
            cells and "prior" on others.
        poses: what is believed of the scans' poses before they are looked at: `Known` (the default), `Uncertain` about
            the log's, or `Odometry`. Unknown poses are sampled along with the map: ``run.poses``.
        start_poses: poses from which chains start, one trajectory each, (chains, S, 3); draws of their prior if None.
        particles: of "importance".
        rounds: of belief propagation, at most.
        hit_depth: where in a cell a beam stops, as a fraction of its chord: 0 at the near edge, as in the tutorial.
        threads: chains that run at once, and threads of belief propagation; all cores if None. Building the beam
            table uses all cores in any case.
        device: "cpu" or a CUDA device such as "cuda:0".
        resume: a run with the same arguments that was stopped early: go on where it stopped.
        on_progress: called with how far the run is, about four times a second.
        on_checkpoint: given the run so far at the end of warm-up and every ``checkpoint_every_s`` seconds.
        checkpoint_every_s: see above.
        executor: where chains run; in this process if None.

    Returns:
        The run. Ctrl-C stops at the end of the current sweeps and returns what there is, with ``finished`` false.

    Raises:
        BadInput: arguments that do not make sense, or a run to resume that was made with others.
    """
    if not isinstance(prior, CellPrior):
        raise BadInput(
            f"infer: prior must say what cells are, such as bm.Independent(0.2) or bm.Surface(), got {prior!r}"
        )
    if not isinstance(sensor, str | SensorModel):
        raise BadInput(f"infer: sensor must be a sensor model or {FIT!r}, got {sensor!r}")
    if executor is not None and (isinstance(executor, type) or not callable(getattr(executor, "run", None))):
        raise BadInput(
            f"infer: executor must be one such as bm.RayExecutor(), or None for this process, got {executor!r}"
        )
    if poses is not None and not isinstance(poses, PosePrior):
        raise BadInput(
            "infer: poses must say what is believed of them, such as bm.Uncertain(0.1, 0.05) or bm.Odometry(), "
            f"got {poses!r}"
        )
    kind = type(prior).__name__
    method = next(iter(prior.methods)) if method is None else method
    if method not in prior.methods:
        one = len(prior.methods) == 1
        known = f"one method, {next(iter(prior.methods))!r}" if one else f"the methods {', '.join(prior.methods)}"
        raise BadInput(f"infer: {kind} has {known}, got {method!r}")
    chains = check_count("infer", "chains", chains, 1)
    if thin is None:
        thin = prior.sweeps_a_draw if draws is None else 1
    thin = check_count("infer", "thin", thin, 1)
    if draws is None:
        draws = 0 if method == "propagate" else prior.default_draws(scans.n_beams, grid.n_cells, chains, thin)
    schedule = Schedule(
        check_count("infer", "warmup", warmup, 0),
        check_count("infer", "draws", draws, 0),
        thin,
    )
    seed = check_count("infer", "seed", seed, 0)
    particles = check_count("infer", "particles", particles, 1)
    rounds = check_count("infer", "rounds", rounds, 1)
    if threads is not None:
        threads = check_count("infer", "threads", threads, 1)
    if not 0.0 <= hit_depth <= 1.0:
        raise BadInput(f"infer: hit_depth must lie in [0, 1], got {hit_depth!r}")
    if isinstance(sensor, str) and sensor != FIT:
        raise BadInput(f"infer: sensor must be a sensor model or {FIT!r}, got {sensor!r}")
    if resume is not None and resume.posterior.kind != prior.words.kind:
        raise BadInput(
            f"resume: the saved run is one over {resume.posterior.prior.words.states}, not over {prior.words.states}"
        )
    ask = DrawRequest(chains, schedule.draws, seed, particles, rounds)
    first = first_sensor(prior, grid.resolution) if isinstance(sensor, str) else sensor
    model = Model(scans, grid, prior, first, Known() if poses is None else poses, float(hit_depth))
    if start_poses is not None and np.shape(start_poses)[1:] != scans.poses.shape:
        raise BadInput(f"infer: start_poses has shape {np.shape(start_poses)}, expected (chains, {len(scans)}, 3)")
    if model.poses.unknown and prior.methods[method] not in ("wall-gibbs", "wall-blocks", "stop-gibbs"):
        raise BadInput(f"infer: method {method!r} of {kind} takes poses as known; leave poses out, or take another")
    inference = Inference(model, method, schedule, ask, isinstance(sensor, str), threads, device, start_poses)
    with stop_on_interrupt() as should_stop:
        return inference.run(
            order=order, start=start, resume=None if resume is None else resume.posterior,
            watch=Watch(on_progress, should_stop), executor=ThreadExecutor() if executor is None else executor,
            on_checkpoint=on_checkpoint, checkpoint_every_s=checkpoint_every_s,
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Inference:
    """What was asked for: the arguments of `infer`, checked."""

    model: Model
    method: str
    schedule: Schedule
    asked: DrawRequest
    fitted: bool
    threads: int | None
    device: str
    start_poses: NDArray[np.float64] | None = None

    def run(
        self,
        *,
        order: Order,
        start: Start | NDArray[np.bool_] | None,
        resume: Posterior | None,
        watch: Watch,
        executor: Executor,
        on_checkpoint: Callable[[Run], None] | None,
        checkpoint_every_s: float,
    ) -> Run:
        """Fit, sample, and make a run of it."""
        began = time.perf_counter()
        name = self.model.cells.methods[self.method]
        if name == "stop-gibbs" and self.device == "cpu":
            here = self.asked.chains if isinstance(executor, ThreadExecutor) else 1  # of others the pilot alone
            check_memory(self.model.grid, self.model.scans, self.model.cells.has_surfaces, here)
        if name in WITHOUT_CHAINS:
            sampler, options = None, {"order": order, "start": default_start(self.model.grid)}
        else:
            alone = 0 if self.model.poses.unknown else self.schedule.warmup
            sampler, options = sampler_of(name, self.model.grid, order, start, self.asked.rounds, alone)
        if sampler is not None and self.model.poses.unknown:
            sampler = WithPoses(cast(MovableSampler, sampler), self.schedule.warmup, self.start_poses)
        settings = self._settings(options)
        given = (None if isinstance(start, str) else start, self.start_poses)
        settings["fingerprint"] = fingerprint(settings, self.model, *given)
        if resume is not None:
            check_same(resume.settings, settings)
            if resume.sweep == 0:
                resume = None  # stopped before its first sweep: there is nothing to go on with
        spent = 0.0 if resume is None else resume.seconds["total"]

        def total() -> float:
            return time.perf_counter() - began + spent

        model, parameters = self.model, None
        if self.fitted and name == "stop-gibbs":
            assert sampler is not None
            if resume is not None:
                parameters = Parameters.from_description(resume.settings["fitted"])
            else:
                parameters = self._fit(sampler, watch)
            settings["fitted"] = parameters.describe()
        elif self.fitted:
            sensor = fit_sensor(model, self.device, seed=self.asked.seed, threads=self.threads, watch=watch)
            model = replace(model, sensor=sensor)
            settings["fitted"] = {"sensor": describe(sensor)}
        if model.cells.is_incomplete:
            pilot = sampler_on_walls(name)
            prior = fit_coupling_to_scans(
                model, pilot, self.device, seed=self.asked.seed, threads=self.threads, watch=watch
            )
            model = replace(model, cells=prior)
            settings["fitted"] = {**settings.get("fitted", {}), "prior": prior.describe()}
        fit_seconds = time.perf_counter() - began if "fitted" in settings else 0.0
        settings["threads_used"] = self._threads_used()
        if sampler is None:
            walls = trace_walls(model, self.device, self.threads)
            seconds = {"trace": time.perf_counter() - began - fit_seconds, "fit": fit_seconds}
            found = WITHOUT_CHAINS[name](walls, self.asked, watch)
            seconds["total"] = total()
            return Run(posterior_of_draws(model, found, walls.n_incidences, settings, seconds))

        def as_run(chains: Chains) -> Run:
            spent_beside = {"total": total(), "fit": fit_seconds}
            return Run(posterior_of_chains(model, chains, settings, spent_beside, parameters))

        job = Job(
            model, sampler, self.schedule, self.asked.seed, tuple(range(self.asked.chains)), self.device, self.threads,
            parameters,
        )  # fmt: skip
        return as_run(
            executor.run(
                job,
                None if resume is None else chains_of(resume),
                watch,
                None if on_checkpoint is None else lambda chains: on_checkpoint(as_run(chains)),
                checkpoint_every_s,
            )
        )

    def _fit(self, sampler: Sampler[Any, Any], watch: Watch) -> Parameters:
        """Sensor and prior, by a pilot over the cells; what it needed for that is gone afterwards."""
        problem = sampler.prepare(self.model, self.device, self.threads, watch)
        cells = problem.cells if self.model.poses.unknown else problem
        return fit(cells, self.asked.seed, min(PILOT_SWEEPS, self.schedule.warmup), watch)

    def _settings(self, options: dict[str, Any]) -> dict[str, Any]:
        asked, schedule = self.asked, self.schedule
        return {
            "method": self.method, **options, "chains": asked.chains, "warmup": schedule.warmup,
            "draws": schedule.draws, "thin": schedule.thin, "seed": asked.seed, "particles": asked.particles,
            "rounds": asked.rounds, "hit_depth": self.model.hit_depth, "prior": self.model.cells.describe(),
            "sensor": FIT if self.fitted else describe(self.model.sensor), "streams": RANDOM_STREAMS,
            "poses": self.model.poses.describe(),
        }  # fmt: skip

    def _threads_used(self) -> int:
        from bayesmap.kernels.device import available_cores

        # A GPU may be on another machine alone: whether there is one, those say who use it.
        return (self.threads or available_cores()) if self.device == "cpu" else 1
