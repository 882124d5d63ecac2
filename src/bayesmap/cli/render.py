"""``bayesmap render`` and ``bayesmap export``: write a saved run as pictures, films, and files for other programs.

`render` draws pictures of the whole map (`_whole_figure`), a panel (`_panel`), held-out beams (`_beams_figure`), or a
film. The next functions select what it shows. `export` leaves the formats to `bayesmap.io.exports`.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import FORCE, Call, command
from bayesmap.cli.console import share_bar
from bayesmap.cli.keys import ExportSettings, RenderSettings
from bayesmap.cli.translation import NO_MOUNT, heldout_scans, need_free, picture_path
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from bayesmap.result import Run
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans

    Walls = NDArray[np.bool_]
    Window = tuple[slice, slice]  # the cells of a part of the map

WITHOUT_WINDOW = ("figure", "animation", "trace", "weights")  # pictures that always show the whole map


@command("render")
@click.argument("run_file", metavar="RUN.nc")
@click.option("-o", "--output", metavar="FILE", help=".png, .pdf, .svg; .gif, .webp. [default: beside RUN.nc]")
@click.option("--truth", metavar="MAP.yaml", help="Outline the true walls of this map_server map.")
@click.option("--heldout", metavar="LOG", help="The log that the run was made from, or another of the same place.")
@FORCE
def render(
    call: Call[RenderSettings], run_file: str, output: str | None, truth: str | None, heldout: str | None, force: bool
) -> None:
    r"""Render a saved run as a picture or a film.

    By default the picture has the name of its kind, such as mean.png or animation.gif; surfaces are strokes.png.

    \b
    figure                  mean, uncertainty, readings and one draw
    mean, entropy, draw     one panel
    deviation, width        uncertainty: standard deviation of a wall, width
                            of the 90 % interval of a reflectivity
    residuals, surprise     held-out beams (--heldout LOG) over the map: reading
                            minus predicted median, and minus log score
    log-odds                the posterior beside the classic log-odds map
    surfaces                one stroke per cell, where its hits lie
    trace, weights          trace of the log joint, importance weights
    animation               film of a chain

    Read LOG as for the run: give the same --no-return, topics, --deskew and --thin-scans as to infer.
    """
    from bayesmap.result import load
    from bayesmap.viz.figure import write_figure

    settings = call.settings()
    kind = settings.what
    target = picture_path(run_file, output, default_name(kind), force=force)
    run = load(run_file)
    # Methods that compute marginals have a map without draws; chains in warm-up have none.
    if run.n_draws == 0 and (kind in ("draw", "animation") or run.posterior.has_chains):
        raise _without_draws(run_file, run)
    if settings.window is not None and kind in WITHOUT_WINDOW:
        raise BadInput(f"window: {kind} shows the whole map; a single panel, such as --what mean, takes a window")
    grid, window = parse_window(run, settings.window)
    walls = None if truth is None else truth_on(grid, truth)
    if kind == "animation":
        from bayesmap.viz.animation import write_animation

        draws, numbers = select_frames(run, settings.chain, settings.frames)
        write_animation(target, run.grid, draws, observed=run.observed, truth=walls, sweeps=numbers)
    elif kind in ("residuals", "surprise"):
        if heldout is None:
            raise BadInput(f"{kind} needs the log of scans that the run did not use: give --heldout LOG")
        scans = heldout_scans(run, heldout, settings, settings.holdout)
        with share_bar(call.console, "predicting held-out beams") as report:
            write_figure(_beams_figure(run, scans, kind, grid, window, report), target)
    elif kind in WITHOUT_WINDOW:
        write_figure(_whole_figure(run, settings, walls), target)
    else:
        write_figure(_panel(run, settings, grid, window, walls), target)
    call.console.result({"what": kind, "run": run_file, "outputs": {target.name: str(target)}}, [target])


def default_name(kind: str) -> str:
    """Return the name of a picture that the user has not named. `infer` and `slam` write surfaces.png themselves."""
    return f"{kind}.gif" if kind == "animation" else f"{'strokes' if kind == 'surfaces' else kind}.png"


def _whole_figure(run: Run, settings: RenderSettings, walls: Walls | None) -> Figure:
    """Render the trace, the importance weights, or the four panels of the whole map with true walls, (nx, ny)."""
    from bayesmap.viz.diagnostics import trace_figure, weights_figure

    if settings.what == "trace":
        return trace_figure(run.log_joint, first_sweep=run.posterior.settings["warmup"] + 1)
    if settings.what == "weights":
        return weights_figure(run.log_weights)
    return run.plot(truth=walls, **({"draw": select_draw(run, settings.chain, settings.draw)} if run.n_draws else {}))


def _panel(run: Run, settings: RenderSettings, grid: Grid, window: Window, walls: Walls | None) -> Figure:
    """Render one panel of a window of the map, whose cells are ``grid``."""
    from bayesmap.viz.figure import panel_figure
    from bayesmap.viz.overlays import surfaces_figure

    kind, label = settings.what, run.posterior.prior.words.mean
    values, observed = run.occupancy[window], run.observed[window]
    if kind == "surfaces":
        return surfaces_figure(grid, *run.surfaces(), observed)
    if kind == "log-odds":
        from bayesmap.viz.figure import Candidate, comparison_figure

        log_odds, counted_cells = log_odds_map(run)
        posterior = Candidate(f"posterior: {label}", values, observed)
        maps = [Candidate("log-odds", log_odds[window], counted_cells[window]), posterior]
        return comparison_figure(grid, maps, label="chance that a cell stops a beam")
    if kind == "deviation" and run.posterior.prior.has_interval:
        raise BadInput("deviation is for binary walls; --what width shows how sure a reflectivity is")
    if kind == "width":
        if not run.posterior.prior.has_interval:
            raise BadInput("width: a wall has no interval; --what entropy or deviation shows how sure it is")
        run.interval(0.9)  # raises `BadInput` for a run without draws
        values = run.posterior.prior.width(run.posterior.draws, 0.9)[window]
    elif run.n_draws:
        draw = select_draw(run, settings.chain, settings.draw)  # refuses a missing draw also for other panels
        values = draw[window] if kind == "draw" else values
    return panel_figure(grid, kind, values, observed, truth=walls, label=label)


def _beams_figure(
    run: Run, scans: Scans, kind: str, grid: Grid, window: Window, on_progress: Callable[[float], None]
) -> Figure:
    """Render the end points of held-out beams over the map, coloured by residual in metres or by surprise in nats."""
    from bayesmap.posterior.prediction import predictor_of, residuals_of
    from bayesmap.viz.scores import residuals_figure, surprise_scale

    residuals = residuals_of(predictor_of(run.posterior), scans, on_progress=on_progress)
    values = residuals.residual_m if kind == "residuals" else residuals.surprise_nats
    scale = surprise_scale(values) if kind == "surprise" else None
    mean, observed = run.occupancy[window], run.observed[window]
    return residuals_figure(grid, mean, residuals.ends_world, values, observed, scale=scale)


def select_draw(run: Run, chain: int, draw: int) -> NDArray[Any]:
    """Return a draw, (nx, ny). Numbers count from 1; draw -1 is the last. Raises `BadInput` without such a draw."""
    n_chains, n_draws = run.log_joint.shape
    if not 1 <= chain <= n_chains:
        raise BadInput(f"chain {chain}: this run has chains 1 to {n_chains}")
    if not (1 <= draw <= n_draws or -n_draws <= draw <= -1):
        choices = f"; give 1 to {n_draws}, or -1 for the last" if n_draws else ""
        raise BadInput(f"draw {draw}: this run has {n_draws:,} draws a chain{choices}")
    return run.map_of(chain - 1, draw - 1 if draw > 0 else draw)


def select_frames(run: Run, chain: int, max_frames: int) -> tuple[NDArray[Any], list[int]]:
    """Return at most ``max_frames`` evenly spaced draws of a chain, (frames, nx, ny), and their numbers, from 1."""
    import numpy as np

    from bayesmap.space.arrays import evenly_spaced_indices

    select_draw(run, chain, -1)  # raises `BadInput` for a chain that is not there
    indices = evenly_spaced_indices(run.n_draws, max_frames).tolist()
    return np.stack([run.map_of(chain - 1, index) for index in indices]), [index + 1 for index in indices]


def truth_on(grid: Grid, path: str) -> Walls:
    """Return the walls of a map_server map at the cell centres of a grid, (nx, ny); no walls outside of that map."""
    import numpy as np

    from bayesmap.io.ros.maps import read_map

    occupancy, map_grid = read_map(path)
    points: Any = np.stack(np.meshgrid(*grid.centers_m(), indexing="ij"), axis=-1)
    i, j = np.moveaxis(np.floor(map_grid.to_cells(points)).astype(int), -1, 0)
    inside = (i >= 0) & (i < map_grid.shape[0]) & (j >= 0) & (j < map_grid.shape[1])
    walls = np.zeros(grid.shape, dtype=np.bool_)
    walls[inside] = occupancy[i[inside], j[inside]] > 0.5
    return walls


def parse_window(run: Run, text: str | None) -> tuple[Grid, Window]:
    """Return grid and slices of the window "X0,X1,Y0,Y1" in metres, or "observed", or of the whole map if None."""
    from bayesmap.viz.maps import window, window_around

    if text is None:
        return run.grid, (slice(None), slice(None))
    if text == "observed":
        return window_around(run.grid, run.observed)
    try:
        x0, x1, y0, y1 = (float(number) for number in text.split(","))
    except ValueError:
        raise BadInput(f"window {text!r}: give X0,X1,Y0,Y1 in metres, such as 0,10,-5,5, or: observed") from None
    return window(run.grid, (x0, x1), (y0, y1))


def _without_draws(run_file: str, run: Run) -> BadInput:
    """Return the error for a run that was stopped before its first draw, with the command that resumes it."""
    command = "infer" if run.trajectory is None else "slam"
    resume_command = f"bayesmap {command} LOG -o {shlex.quote(str(Path(run_file).parent))} --resume"
    hint = "" if run.trajectory is None else "; its trajectory can be exported already, as with -o trajectory.tum"
    return BadInput(f"{run_file}: the run has no draws yet; go on with it by {resume_command}{hint}")


def log_odds_map(run: Run) -> tuple[NDArray[np.float64], Walls]:
    """Compute the log-odds map, (nx, ny), with OctoMap's numbers, unclamped, and a mask of the crossed cells."""
    from bayesmap.kernels.rays import count_hits
    from bayesmap.posterior.baselines import octomap_map

    hits, passes = (counts.reshape(run.grid.shape) for counts in count_hits(run.posterior.scans, run.grid))
    return octomap_map(hits.astype(float), passes.astype(float), {}), hits + passes > 0


@command("export")
@click.argument("run_file", metavar="RUN.nc")
@click.option("-o", "--output", metavar="FILE", help="Its ending chooses the format. [default: export.yaml by RUN.nc]")
@FORCE
def export(call: Call[ExportSettings], run_file: str, output: str | None, force: bool) -> None:
    r"""Write the map of a saved run, or its trajectory, for robots and other programs.

    Cells that no beam reached are unknown.

    \b
    .yaml               map_server: YAML and image (--mode trinary, scale, raw)
    .bag, .mcap, .db3   occupancy grid in a recording, ROS 1 or 2; a name
                        without ending is a ROS 2 bag's folder;
                        --format gridmap: all layers, for grid_map
    .tif                GeoTIFF, one band per layer (needs bayesmap[geotiff])
    .rrd                layers and scans for rerun (needs bayesmap[rerun])
    .tum                poses for evo, with covariances in a second file
    .g2o                poses as a graph with information matrices
    --format trajectory nav_msgs/Path, and PoseWithCovarianceStamped, in a
                        recording

    Poses are poses of the robot's base, if the log says where the laser sits on it, and else of the laser (--frame).
    The layers are mean and entropy. If the state of a cell is a number, the bounds of its 90 % interval are layers too.
    """
    import numpy as np

    from bayesmap.io.exports import FORMATS, TRAJECTORIES, export_format, path_to_replace
    from bayesmap.result import load

    settings = call.settings()
    chosen_format = None if settings.format == "auto" else settings.format
    endings = FORMATS.get(chosen_format or "map-server") or (".mcap",)  # no ending alone selects the other formats
    target = output or str(Path(run_file).with_name(f"export{endings[0]}"))
    existing_file = path_to_replace(target, chosen_format)
    need_free([] if existing_file is None else [existing_file], force=force)
    if not Path(target).parent.is_dir():
        raise BadInput(f"{Path(target).parent}: no such folder; make it first, or choose another with -o")
    run = load(run_file)
    is_trajectory = export_format(target, chosen_format) in TRAJECTORIES
    if np.isnan(run.occupancy).any() and not (is_trajectory and run.trajectory is not None):
        raise _without_draws(run_file, run)
    if run.posterior.scans.mount is None and settings.frame is None and is_trajectory:
        call.console.say(f"{run_file}: {NO_MOUNT}: these are poses of the laser")
    outputs = run.export(
        target, format=chosen_format, mode=settings.mode, occupied_thresh=settings.occupied_thresh,
        free_thresh=settings.free_thresh, frame=settings.frame,
    )  # fmt: skip
    call.console.result({"run": run_file, "outputs": {path.name: str(path) for path in outputs}}, outputs)
