"""Write a posterior as a file for other programs. The format's name, or the path's ending, selects the writer.

docs/file-formats.md describes the formats. `export_run` writes the map of a run, or its trajectory by
`export_trajectory`. The writers of the formats have files of their own.
"""

import contextlib
import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.geotiff import write_geotiff
from bayesmap.io.rerun import write_rerun
from bayesmap.io.ros import writer
from bayesmap.io.ros.maps import write_map
from bayesmap.io.text.g2o import Edges, chain_edges, slam_edges, write_g2o
from bayesmap.io.text.trajectories import covariances_path, write_covariances, write_trajectory
from bayesmap.space.planar import inverse
from bayesmap.space.scans import Scans
from bayesmap.space.trajectory import RelativeLaw, Trajectory

if TYPE_CHECKING:
    from bayesmap.cells.arrays import Draws
    from bayesmap.cells.kind import CellPrior
    from bayesmap.poses.trajectory import InferredTrajectory

RECORDING_ENDINGS = tuple(ending for ending in writer.ENDINGS if ending != writer.FOLDER)
FORMATS = {  # formats with the endings that select them; a name without ending is an occupancy grid in a folder
    "map-server": (".yaml", ".yml"), "occupancy-grid": RECORDING_ENDINGS, "gridmap": (), "rerun": (".rrd",),
    "tum": (".tum",), "trajectory": (), "g2o": (".g2o",), "geotiff": (".tif", ".tiff"),
}  # fmt: skip
TRAJECTORIES = ("tum", "trajectory", "g2o")  # formats of trajectories
THRESHOLDED = ("map-server", "occupancy-grid")  # formats in per cent, which take a mode and thresholds
APPROXIMATION = "the Student-t approximation of all scans' poses"
INTERVAL_PROBABILITY = 0.9  # probability of the interval from the layer lower to the layer upper
EVIDENCE_PROBABILITY = 0.9  # probability of the interval of a cell's stop probability given the beams alone


def export_format(path: str | os.PathLike[str], format: str | None = None) -> str:
    """Return the format, by the path's ending if None. Raises `BadInput` for an unknown format or ending."""
    if format is not None:
        if format not in FORMATS:
            raise BadInput(f"export: format {format!r} is not known; use one of {', '.join(FORMATS)}")
        return format
    ending = Path(path).suffix.lower()
    if os.fspath(path).endswith(os.sep) or Path(path).is_dir() or ending == writer.FOLDER:
        return "occupancy-grid"
    for name, endings in FORMATS.items():
        if ending in endings:
            return name
    known_endings = ", ".join(ending for endings in FORMATS.values() for ending in endings)
    choices = f"the known endings are {known_endings}, and a name without ending is the folder of a ROS 2 bag"
    raise BadInput(f"{path}: no format is known by the ending {ending!r}; {choices}")


def path_to_replace(path: str | os.PathLike[str], format: str | None = None) -> Path | None:
    """Return a file or folder that an export would replace, or None. Raises `BadInput` for an unknown format."""
    target = Path(path)
    outputs = [target]
    chosen = export_format(path, format)
    if chosen == "map-server":
        outputs += [target.with_suffix(ending) for ending in (".pgm", ".png")]
    elif chosen == "tum":
        outputs.append(covariances_path(target))
    replaced = [output for output in outputs if os.path.lexists(output)]
    # Nothing can be lost in an empty folder.
    if replaced == [target] and target.is_dir() and not any(target.iterdir()):
        return None
    return replaced[0] if replaced else None


def layers_of(run: Any) -> dict[str, NDArray[np.float64]]:
    """Return the layers of a run, each (nx, ny): mean, entropy, and lower and upper if cells have intervals."""
    layers = {"mean": run.occupancy, "entropy": run.entropy}
    # Not part of the protocol: runs on binary walls need not have the method, and may raise `BadInput`.
    interval = getattr(run, "interval", None)
    if interval is not None:
        with contextlib.suppress(BadInput):
            layers["lower"], layers["upper"] = interval(INTERVAL_PROBABILITY)
    return layers


def trajectory_of(run: object, scans: Scans) -> Trajectory:
    """Return the trajectory of the sensor in a run, with its uncertainty.
    A run of `bayesmap.slam` gives the draws of its chains over poses if these have mixed, else its approximation of the
    poses of all scans. Other runs give their draws of poses, or else the poses of their scans.
    """
    approximation = getattr(run, "trajectory", None)
    draws = getattr(run, "poses", None)  # (chains, draws, S, 3)
    if draws is None or draws.ndim != 4 or draws.shape[0] * draws.shape[1] < 2 or (draws == draws[0, 0]).all():
        if approximation is None:
            return Trajectory(scans.poses, scans.stamps_s, frame="laser")
        return approximate_trajectory(approximation)
    from bayesmap.posterior.summary import summarise_poses

    mixing = summarise_poses(draws)
    figures = f"R-hat up to {mixing.rhat_max:.3g}, effective sample size from {mixing.ess_min:.0f}"
    unmixed = f"the chains over poses have not mixed ({figures})"
    if approximation is not None and not mixing.mixed:
        return approximate_trajectory(approximation, f"{APPROXIMATION}: {unmixed}")
    known_by = f"draws of poses, which are too alike: {unmixed}"
    if mixing.mixed:
        known_by = f"draws of the chains over poses, which have mixed ({figures})"
    return replace(Trajectory.of_draws(draws, scans.stamps_s, known_by), frame="laser")


def approximate_trajectory(trajectory: "InferredTrajectory", known_by: str = APPROXIMATION) -> Trajectory:
    """Return the approximate trajectory of `bayesmap.slam` with its law of relative poses."""
    law = RelativeLaw(trajectory.relative_scales, trajectory.gaussian.dof)
    covariances = trajectory.covariances()
    return Trajectory(trajectory.poses, trajectory.stamps_s, covariances, None, law, known_by, frame="laser")


def export_trajectory(
    path: str | os.PathLike[str], trajectory: Trajectory, *, format: str | None = None, edges: Edges | None = None,
    lost: Sequence[bool] = (),
) -> tuple[Path, ...]:  # fmt: skip
    """Write a trajectory as "tum", "g2o" or "trajectory" (a recording), by the path's ending if ``format`` is None.

    An existing file is replaced. ``edges`` is the pose graph for g2o; if None, the chain of steps
    (`bayesmap.io.text.g2o.chain_edges`). Returns the paths of the files written. If covariances are known,
    NAME-covariances.txt is written beside NAME.tum. There, poses that are ``lost``, (S,), become comments. Raises
    `BadInput` for another format, no pose, a graph of a trajectory without covariances, or an unwritable file.
    """
    ending = Path(path).suffix.lower()
    chosen = {".tum": "tum", ".g2o": "g2o"}.get(ending, "trajectory") if format is None else format
    if chosen == "g2o":
        return (write_g2o(path, trajectory.poses, chain_edges(trajectory) if edges is None else edges),)
    if chosen == "tum":
        written = (write_trajectory(path, trajectory.poses, trajectory.stamps_s, trajectory.frame, lost),)
        if trajectory.covariances is None:
            return written
        covariances = write_covariances(covariances_path(path), trajectory.covariances, trajectory.stamps_s, lost)
        return (*written, covariances)
    if chosen != "trajectory":
        raise BadInput(f"export: a trajectory is written as {', '.join(TRAJECTORIES)}, not as {chosen!r}")
    return (writer.write_trajectory_recording(path, trajectory),)


def known_cells(
    prior: "CellPrior", draws: "Draws | None", occupancy: NDArray[np.float64], observed: NDArray[np.bool_],
    free_thresh: float | None = None,
) -> NDArray[np.bool_]:  # fmt: skip
    """Select the cells that a map of occupied, free and unknown cells does not call unknown, (nx, ny).
    An observed cell below the free threshold is unknown unless the beams alone show that it stops fewer than half of
    all beams: four passed it, and none stopped. This holds for kinds of cells that count beams.
    """
    if prior.thresholds is None or draws is None or not draws.count:
        return observed
    evidence = prior.evidence_interval(draws, EVIDENCE_PROBABILITY)
    if evidence is None:
        return observed
    limit = prior.thresholds[1] if free_thresh is None else free_thresh
    return observed & ((evidence[1] < 0.5) | (occupancy >= limit))


def export_run(
    path: str | os.PathLike[str], run: Any, scans: Scans, *, format: str | None = None, mode: str | None = None,
    occupied_thresh: float | None = None, free_thresh: float | None = None, known: NDArray[np.bool_] | None = None,
    frame: str | None = None,
) -> tuple[Path, ...]:  # fmt: skip
    """Write a run in another program's format, by the path's ending if ``format`` is None. Returns the paths written.

    An existing file is replaced. The path may be the folder of a ROS 2 bag. The stamp of the last of ``scans`` is the
    map's, and their poses are the default trajectory. ``mode`` is trinary, scale or raw, see `bayesmap.io.ros.maps`: by
    default trinary for map-server (a cell is occupied above 0.65, and free below 0.25), and scale, the probability in
    per cent, for occupancy-grid. Other formats write exact numbers and take no mode. ``known`` are the cells, (nx, ny),
    that these two do not call unknown; by default the observed ones. ``frame`` is the frame on the robot whose poses a
    trajectory has, "base" or "laser"; by default the base, if the log said where the laser sits on it.

    Raises `BadInput` for an unknown ending, format or mode, a mode or threshold that the format does not take, an
    optional package that is not installed, or a file that cannot be written.
    """
    chosen = export_format(path, format)
    thresholds = {"mode": mode, "occupied_thresh": occupied_thresh, "free_thresh": free_thresh}
    options: dict[str, Any] = {name: value for name, value in thresholds.items() if value is not None}
    if options and chosen not in THRESHOLDED:
        remedy = f"leave it out, or choose {' or '.join(THRESHOLDED)}"
        raise BadInput(f"{path}: {chosen} keeps the numbers and takes no {next(iter(options))}; {remedy}")
    if frame is not None and chosen not in TRAJECTORIES:
        raise BadInput(f"{path}: {chosen} holds a map, and takes no frame; {', '.join(TRAJECTORIES)} hold a trajectory")
    grid, observed = run.grid, run.observed
    known = observed if known is None else known
    stamp_s = float(scans.stamps_s[-1]) if scans.stamps_s is not None and len(scans) else None
    if chosen == "map-server":
        return write_map(path, run.occupancy, grid, known, **options)
    if chosen == "occupancy-grid":
        return (writer.write_occupancy_grid(path, run.occupancy, grid, known, stamp_s=stamp_s, **options),)
    if chosen == "gridmap":
        return (writer.write_grid_map(path, layers_of(run), grid, observed, stamp_s=stamp_s),)
    if chosen == "geotiff":
        return (write_geotiff(path, layers_of(run), grid, observed),)
    trajectory = trajectory_of(run, scans)
    if chosen == "rerun":
        return (write_rerun(path, layers_of(run), grid, observed, scans=scans, trajectory=trajectory),)
    # Trajectories, of the frame that the user names. The pose graph of `bayesmap.slam` is of the laser's poses.
    framed = trajectory.of(frame, scans.mount)
    edges = None
    if chosen == "g2o" and trajectory.relative is not None and run.trajectory is not None:
        edges = slam_edges(run.trajectory)
        if framed.frame == "base":
            edges = edges.of_frame(inverse(np.asarray(scans.mount)))
    return export_trajectory(path, framed, format=chosen, edges=edges)
