"""The result of an inference: a posterior, with its summaries, scores, plans, pictures and exports.

`Run` is what users hold. Its data are those of a `Posterior`. Each method imports and calls the module that does the
work. `load` reads a saved run, and `score` judges one on scans that it has not seen.
"""

from __future__ import annotations

import base64
import html
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput, near_names
from bayesmap.posterior.posterior import Posterior, entropy_bits
from bayesmap.posterior.prediction import CENTRAL_80, PREDICTED_DRAWS, predictor_of
from bayesmap.posterior.scores import Score, beam_log_scores, score_prediction
from bayesmap.posterior.summary import Summary, rhat, summarise
from bayesmap.sensors.model import SensorModel
from bayesmap.space.arrays import Floats
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from bayesmap.cells.kind import CellPrior
    from bayesmap.poses.trajectory import InferredTrajectory
    from bayesmap.posterior.decisions import InformationGain
    from bayesmap.posterior.prediction import Prediction
    from bayesmap.posterior.route import FreeProbability, Route
    from bayesmap.posterior.summary import PoseSummary

THUMBNAIL_PIXELS = 240  # longer side, in pixels, of the picture of a run in a notebook


@dataclass(frozen=True, eq=False, repr=False)
class Run:
    """The posterior over a map, and over poses if they were unknown, as `bayesmap.infer` returns it.

    Attributes:
        posterior: draws, marginals, settings and scans of the run.
        trajectory: approximation of all scans' poses by `bayesmap.slam`; None after `bayesmap.infer`.
    """

    posterior: Posterior
    trajectory: InferredTrajectory | None = None

    @property
    def grid(self) -> Grid:
        """The grid of the cells."""
        return self.posterior.grid

    @property
    def sensor(self) -> SensorModel | None:
        """The law of the readings given the map, as fitted; None in a loaded run with a sensor model of your own."""
        return self.posterior.sensor

    @property
    def prior(self) -> CellPrior:
        """The prior of the cells, as fitted."""
        return self.posterior.prior

    @property
    def finished(self) -> bool:
        """True if the run has all its draws. `bayesmap.Checkpoints(resume=run)` resumes a run that was stopped."""
        return self.posterior.finished

    @property
    def occupancy(self) -> Floats:
        """The posterior mean of the probability that a cell stops a beam, (nx, ny).

        For binary walls it is the probability of a wall, with surfaces that a beam which enters the cell's square stops
        inside it (docs/surfaces.md). Except for walls it has less noise than the mean of ``draws``.
        """
        return self.posterior.occupancy

    @property
    def entropy(self) -> Floats:
        """The entropy, in bits, of the event that a cell stops a beam that meets its content, (nx, ny)."""
        return entropy_bits(self.posterior.occupancy)

    @property
    def observed(self) -> NDArray[np.bool_]:
        """The mask of the cells that a beam observes in at least half of the draws, (nx, ny)."""
        return self.posterior.observed

    @cached_property
    def draws(self) -> NDArray[Any]:
        """All kept maps, (chain, draw, nx, ny): walls, or chances to stop a beam.

        Unobserved cells have the prior's mean. The array is made on first use: 1 or 4 bytes per cell and draw.
        """
        draws = self.posterior.draws
        dtype = np.bool_ if self.n_draws == 0 or self.map_of(0, 0).dtype == np.bool_ else np.float32
        maps: NDArray[Any] = np.empty((draws.chains, draws.count, *self.grid.shape), dtype)
        for chain, draw in draws.numbers():
            maps[chain, draw] = self.map_of(chain, draw)
        return maps

    @property
    def n_draws(self) -> int:
        """The number of draws per chain."""
        return self.posterior.draws.count

    def map_of(self, chain: int, draw: int) -> NDArray[Any]:
        """Return one draw, (nx, ny): walls, or chances to stop a beam. Numbers start at 0; negative ones at the end."""
        return self.posterior.prior.map_of(self.posterior.draws, chain, draw)

    @property
    def poses(self) -> Floats:
        """The draws of the poses, (chain, draw, scan, 3): x, y in metres, yaw in radians. Known poses repeat."""
        draws = self.posterior.draws
        if "poses" in draws.arrays:
            return draws.values("poses")
        known_poses = self.posterior.scans.poses
        return np.broadcast_to(known_poses, (draws.chains, draws.count, *known_poses.shape))

    def pose_summary(self) -> PoseSummary:
        """Compute mean, covariance and R-hat of each scan's pose.

        If chains that started from an approximation have not mixed, return the approximation's mean and covariance.
        Raises `BadInput` for a run stopped before its first draw.
        """
        from bayesmap.posterior.summary import summarise_poses

        self._need_marginals()
        summary = summarise_poses(self.poses)
        if self.trajectory is None or summary.mixed or len(self.trajectory.keys) != len(summary.mean):
            return summary
        keys = self.trajectory.keys
        covariance = self.trajectory.covariances()[keys]
        return replace(summary, mean=self.trajectory.poses[keys], covariance=covariance, by_approximation=True)

    def interval(self, level: float = 0.9) -> tuple[Floats, Floats]:
        """Compute the central credible interval of each cell's chance to stop a beam: lower and upper ends, (nx, ny).

        Raises `BadInput` for a level outside (0, 1), a run stopped before its first draw, or binary walls.
        """
        if not 0 < level < 1:
            raise BadInput(f"interval: level must lie inside (0, 1), got {level!r}")
        self._need_marginals()
        return self.posterior.prior.interval(self.posterior.draws, level)

    def surfaces(self) -> tuple[Floats, Floats, Floats]:
        """Return mean surfaces: means (U, 2) in metres, covariances (U, 2, 2) in square metres, reflectivities (U,).

        Raises `BadInput` for a run without surfaces or without draws.
        """
        self._need_marginals()
        return self.posterior.prior.surfaces(self.posterior.draws)

    @property
    def log_joint(self) -> Floats:
        """The log joint density log p(cells, readings) of every draw, in nats, (chain, draw)."""
        return self.posterior.log_joint

    @property
    def log_weights(self) -> Floats:
        """The normalised log weights of importance sampling, (particles,). Other methods raise `BadInput`."""
        if self.posterior.log_weights is None:
            raise BadInput(f"run: method {self.posterior.settings['method']!r} has no importance weights")
        return self.posterior.log_weights

    def summary(self) -> Summary:
        """Return R-hat, effective sample sizes, cells that never changed, and timings."""
        return self._summary

    @cached_property
    def _summary(self) -> Summary:
        return summarise(self.posterior)

    def log_score(
        self, heldout_scans: Scans, sensor: SensorModel | None = None,
        on_progress: Callable[[int, int], None] = lambda done, total: None, device: str = "cpu",
    ) -> float:  # fmt: skip
        """Compute the mean log predictive density of the scans' valid readings: nats per beam, averaged over draws.

        The run has not seen these scans. Another ``sensor`` is needed only for a loaded run with your own sensor model.
        ``on_progress`` is called with the number of finished draws and their total. The device is "cpu", or a CUDA
        device such as "cuda:0". Raises `BadInput` for no draws, no valid reading, an unfit sensor, or no such device.
        """
        scores = beam_log_scores(predictor_of(self.posterior, sensor), heldout_scans, on_progress, device)
        return float(scores[~np.isnan(scores)].mean())

    def free_probability(self, path: ArrayLike, radius_m: float) -> FreeProbability:
        """Compute the probability that a disc moves along a path without touching anything: the share of joint draws.

        The path has the corners of the way of the disc's centre, world frame, metres, (P, 2); one point for a standing
        disc. Returns ``.probability`` with its Monte Carlo ``.standard_error``, and ``.independent``: the product over
        independent cells. Raises `BadInput` for no draws, a path invalid or outside the map, or no positive radius.
        """
        from bayesmap.posterior.decisions import path_free_probability

        return path_free_probability(self.posterior, path, radius_m)

    def plan(self, start: ArrayLike, goal: ArrayLike, radius_m: float, risk: float = 0.01) -> Route:
        """Plan the shortest path of a disc whose probability of touching something is at most ``risk``.

        Start and goal are points of the world frame in metres, (2,). Returns the path with its `free_probability`. If
        no path is ``.within_risk``, it is the safest one. Raises `BadInput` for a run without draws, a start or
        goal that is outside the map or blocked in nearly every draw, or if there is no path.
        """
        from bayesmap.posterior.decisions import shortest_safe_path

        return shortest_safe_path(self.posterior, start, goal, radius_m, risk)

    def information_gain(
        self, poses: ArrayLike, angles_rad: ArrayLike | None = None, *, max_range_m: float | None = None,
        sensor: SensorModel | None = None, draws: int | None = None, seed: int = 0,
    ) -> InformationGain:  # fmt: skip
        """Compute the expected information about the map from one more scan at each pose, in nats.

        Args:
            poses: poses in the world frame, (P, 3).
            angles_rad: angles of the beams in the sensor's frame, (A,); None: as in the run's scans.
            max_range_m: largest range of the sensor; None: as in the run's scans.
            sensor: law of the new readings; None: the run's.
            draws: number of compared draws; more draws tighten the bounds, and the work grows with their square.
            seed: seed of the simulated scans.

        Returns bounds from joint draws, ``.at_least`` and ``.at_most`` with Monte Carlo errors, and ``.independent``:
        the formula for independent cells and beams (FSMI; Zhang et al., ICRA 2019). Raises `BadInput` for fewer than
        two draws, or invalid poses, angles or range.
        """
        from bayesmap.posterior.decisions import information_of

        return information_of(
            self.posterior, poses, angles_rad, max_range_m=max_range_m, sensor=sensor, draws=draws, seed=seed
        )

    def predict(
        self, poses: ArrayLike, angles_rad: ArrayLike | None = None, *, levels: Sequence[float] = CENTRAL_80,
        draws: int = PREDICTED_DRAWS, max_range_m: float | None = None, sensor: SensorModel | None = None,
        seed: int = 0,
    ) -> Prediction:  # fmt: skip
        """Predict the readings of one scan from each pose: draws from their joint law, and quantiles of each reading.

        Args:
            poses: poses in the world frame, (3,) or (P, 3).
            angles_rad: angles of the beams in the sensor's frame, (A,); None: as in the run's scans.
            levels: probabilities of the quantiles, rising, inside (0, 1).
            draws: largest number of maps that readings are drawn from.
            max_range_m: largest range of the sensor; None: as in the run's scans.
            sensor: law of the readings; None: the run's.
            seed: seed of the drawn readings.

        Returns ``.draws_m`` (draws, P, A) and ``.quantiles_m`` (P, A, levels), metres (+inf: no return, -inf: close).
        Raises `BadInput` for a run without draws, poses outside the map, or invalid angles, levels or range.
        """
        from bayesmap.posterior.prediction import predict

        return predict(
            self.posterior, poses, angles_rad, levels=levels, draws=draws, max_range_m=max_range_m, sensor=sensor,
            seed=seed,
        )  # fmt: skip

    def dataset(self, *, by_reading: bool = False) -> xarray.Dataset:
        """Return draws, log densities and marginals as an xarray dataset with named dimensions.

        ``chain`` and ``draw`` count from 0. ``x`` and ``y`` are the cells' centres in the world frame, metres. Arrays
        over only a part of the cells have the indices of these cells as ``cell_x`` and ``cell_y``. ``by_reading`` adds
        the log likelihood of every valid reading in every draw, at 4 bytes each, as ``reading_log_likelihood``. Raises
        `BadInput` if xarray is not installed, and with ``by_reading`` for no draws or an unknown sensor model.
        """
        from bayesmap.posterior.posterior import dataset_of

        return dataset_of(self.posterior, by_reading)

    def save(
        self, path: str | os.PathLike[str], on_progress: Callable[[int, int], None] = lambda done, total: None, *,
        by_reading: bool = False,
    ) -> None:  # fmt: skip
        """Write the run to one netCDF file, whole or not at all.

        ``on_progress`` is called with the count done and the total. ``by_reading`` adds the log likelihood of every
        valid reading in every draw, which arviz's ``loo`` needs.
        """
        from bayesmap.io.saved import save

        save(self.posterior, path, on_progress, self.trajectory, by_reading=by_reading)

    def plot(self, **options: Any) -> Figure:
        """Plot the mean map, its uncertainty, the readings and one draw, with surfaces if cells are large enough.

        Takes the options of `bayesmap.viz.figure.posterior_figure`: ``draw``, ``truth``, ``scans``, ``title``,
        ``label``, ``width``, ``surfaces``. Raises `BadInput` for a run that was stopped before its first draw.
        """
        from bayesmap.viz.figure import posterior_figure

        self._need_marginals()
        prior = self.posterior.prior
        if self.n_draws and "draw" not in options:
            options["draw"] = self.map_of(0, -1)
        options.setdefault("scans", self.posterior.scans)
        options.setdefault("label", prior.words.value if prior.has_interval else prior.words.mean)
        if prior.has_interval and self.n_draws and "width" not in options:
            options["width"] = prior.width(self.posterior.draws, 0.9)
        if prior.has_surfaces:
            options.setdefault("surfaces", self.surfaces())
        return posterior_figure(self.grid, self.occupancy, self.observed, **options)

    def export(self, path: str | os.PathLike[str], **options: Any) -> tuple[Any, ...]:
        """Write the map, or the trajectory, for other programs, and return the paths of the written files.

        The path's ending chooses the format: map_server YAML, recordings for ROS 1 and 2, GeoTIFF, rerun or TUM, with
        the options of `bayesmap.io.exports.export_run`. Maps of occupied, free and unknown cells use the thresholds of
        the kind of cells by default. A cell of reflectivities below the free threshold is unknown unless enough beams
        passed it (docs/defaults.md). Raises `BadInput` for the map of a run that was stopped before its first draw, an
        unknown ending, or a file that cannot be written.
        """
        from bayesmap.io.exports import TRAJECTORIES, export_format, export_run, known_cells

        # The trajectory of `slam` is known before the first draw.
        chosen_format = export_format(path, options.get("format"))
        if self.trajectory is None or chosen_format not in TRAJECTORIES:
            self._need_marginals()
        mode = options.get("mode") or ("trinary" if chosen_format == "map-server" else None)
        if self.prior.thresholds is not None and mode == "trinary":
            for name, threshold in zip(("occupied_thresh", "free_thresh"), self.prior.thresholds, strict=True):
                options[name] = threshold if options.get(name) is None else options[name]
        free_thresh = options.get("free_thresh")
        known = known_cells(self.prior, self.posterior.draws, self.occupancy, self.observed, free_thresh)
        return export_run(path, self, self.posterior.scans, known=known, **options)

    def __repr__(self) -> str:
        """Return five lines: the map, the scans, the method, the log joint, and the time."""
        title, rows = _overview(self.posterior)
        return "\n".join([title, *(f"  {name}: {value}" for name, value in rows)])

    def _repr_html_(self) -> str:
        """Return a small picture of the mean map beside the five lines of `repr`, for notebooks."""
        from bayesmap.viz.thumbnail import thumbnail

        title, rows = _overview(self.posterior)
        size, png = thumbnail(self.occupancy, self.observed, THUMBNAIL_PIXELS)
        lines = "".join(
            f"<tr><th align='left'>{html.escape(name)}</th><td align='left'>{html.escape(value)}</td></tr>"
            for name, value in rows
        )
        return (
            "<div style='display:flex;gap:1em;align-items:flex-start'>"
            f"<img alt='mean map' width='{size[0]}' height='{size[1]}' "
            f"src='data:image/png;base64,{base64.b64encode(png).decode()}'>"
            f"<div><b>{html.escape(title)}</b><table>{lines}</table></div></div>"
        )

    def _need_marginals(self) -> None:
        """Refuse a run that was stopped before its first draw."""
        if np.isnan(self.posterior.occupancy).any():
            raise BadInput("run: stopped before its first draw, there is no posterior yet; resume it")


def _overview(posterior: Posterior) -> tuple[str, list[tuple[str, str]]]:
    """Return a title, and four rows of name and value: scans, method, log joint and time."""
    nx, ny = posterior.grid.shape
    log_joint = posterior.log_joint
    title = f"Run: {posterior.prior.words.states}, {nx} x {ny} cells of {posterior.grid.resolution:g} m"
    n_chains, n_draws = log_joint.shape
    work = f"{n_chains} chains of {posterior.sweep:,} sweeps, {n_draws:,} draws each"
    if not posterior.has_chains:
        work = f"{n_chains * n_draws:,} independent draws"
    state = "finished" if posterior.finished else "not finished"
    level = f"{log_joint.mean():,.1f} on average" if log_joint.size else "no draws yet"
    if log_joint.size and posterior.has_chains and n_draws >= 4:  # R-hat needs two draws in each half
        level += f", R-hat {rhat(log_joint):.3f}"
    observed = f"{np.count_nonzero(posterior.observed):,} of {posterior.observed.size:,} cells observed"
    return title, [
        ("scans", f"{posterior.counts['scans']:,}, {posterior.counts['beams']:,} beams; {observed}"),
        ("method", f"{posterior.settings['method']}, {work}, {state}"),
        ("log joint", level),
        ("seconds", f"{posterior.seconds['total']:.1f}, {posterior.seconds['sampling']:.1f} of them in sweeps"),
    ]


def load(path: str | os.PathLike[str]) -> Run:
    """Read a saved run. Raises `BadInput` for a file that is missing, damaged, or no run of bayesmap."""
    from bayesmap.io.saved import load_saved

    return Run(*load_saved(path))


@near_names
def score(
    run: Run, heldout_scans: Scans, sensor: SensorModel | None = None, *, seed: int = 0, device: str = "cpu",
    on_progress: Callable[[float], None] = lambda share: None,
) -> Score:  # fmt: skip
    """Score the predictions of a run on scans that it has not seen, and their calibration.

    Args:
        run: the run; the prediction is the mean over its draws.
        heldout_scans: scans that the run has not seen.
        sensor: another law of the readings; None: the run's.
        seed: seed of the randomised transform of typed readings, and of the bootstrap.
        device: "cpu" or a CUDA device such as "cuda:0".
        on_progress: called with the share that is done, from 0 to 1.

    Raises `BadInput` for no valid reading, no draws, no such device, or a sensor whose law is not normalised.
    """
    predictor = predictor_of(run.posterior, sensor)
    return score_prediction(predictor, heldout_scans, seed=seed, device=device, on_progress=on_progress)
