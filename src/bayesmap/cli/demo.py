"""``bayesmap demo``: infer the tutorial's map from one noisy scan, by three of the tutorial's methods.

A fourth run without warm-up gives the frames of a film.
"""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from bayesmap.cli.command import Call, command
from bayesmap.cli.console import Console, as_json, exit_unless_good, progress_bar
from bayesmap.cli.folder import run_document
from bayesmap.cli.keys import DemoSettings
from bayesmap.errors import BadInput
from bayesmap.files import write_file

if TYPE_CHECKING:
    from bayesmap.result import Run

N_BEAMS = 100  # beams of the scan
SIGMA_M = 0.2  # noise of the sensor
MAX_RANGE_M = 42.0  # longer than the map's diagonal, so that every beam meets a wall
FILM_SWEEPS = 80  # sweeps in the film of a chain, one frame each
MIN_EFFECTIVE_SAMPLE_SIZE = 10.0  # below, importance sampling is reported as collapsed
P_WALL = {"gibbs": 0.5, "block": 0.05, "importance": 0.5, "film": 0.5}  # prior wall probability of each run
TITLES = {  # titles of the compared methods
    "gibbs": f"single-site Gibbs, prior {P_WALL['gibbs']}", "block": f"2 x 2 block Gibbs, prior {P_WALL['block']}",
    "importance": f"importance sampling, prior {P_WALL['importance']}",
}  # fmt: skip


@command("demo")
@click.option("-o", "--output", metavar="DIR", default="runs/demo", help="Folder of results. [default: runs/demo]")
@click.option("--force", is_flag=True, help="Write into DIR even if it holds a run that is no demo.")
def demo(call: Call[DemoSettings], output: str, force: bool) -> None:
    """Map the tutorial's building from one scan of 100 noisy beams.

    Three methods infer from the same scan: single-site Gibbs with prior wall probability 0.5, 2 x 2 block Gibbs with
    prior 0.05, and importance sampling, which collapses. The command writes into DIR pictures of the posteriors and of
    the weights, a film of a chain (GIF and WebP), the saved run (run.nc), the map for nav2, and the JSON document
    (demo.json).
    """
    folder = Path(output)
    if (folder / "run.nc").exists() and not (folder / "demo.json").exists() and not force:
        raise BadInput(f"{folder}: holds a run that is no demo; take another folder with -o, or replace it by --force")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        raise BadInput(f"{folder}: not a folder; choose another with -o") from None
    runs = _infer_by_all_methods(call.console, call.settings())
    with progress_bar(call.console, "rendering pictures and a film"):
        outputs = [*_write_products(runs, folder), folder / "demo.json"]
    # The keys in which the methods differ.
    keys = ["method", "prior", "chains", "warmup", "draws", "sweeps", "seconds", "microseconds_per_sweep", "log_joint"]
    keys += ["log_evidence", "diagnostics", "problems"]
    documents = {name: run_document(run) for name, run in runs.items()}
    document = {
        **documents["gibbs"], "heldout": None, "outputs": {path.name: str(path) for path in outputs},
        "runs": {name: {key: entry[key] for key in keys} for name, entry in documents.items()},
    }  # fmt: skip
    write_file(folder / "demo.json", as_json(document))
    _print_report(call.console, runs, folder)
    call.console.result(document, outputs)
    finished = all(run.finished for run in runs.values())
    exit_unless_good(finished=finished, problems=call.settings().strict and bool(document["problems"]))


def _infer_by_all_methods(console: Console, settings: DemoSettings) -> "dict[str, Run]":
    """Return the runs of the three methods on one scan, and a run without warm-up for the film."""
    import numpy as np

    from bayesmap.api import infer
    from bayesmap.arguments import Schedule, Where
    from bayesmap.cells.binary import Independent
    from bayesmap.samplers.methods import Block, Gibbs, Importance, Method
    from bayesmap.sensors.model import Gaussian
    from bayesmap.sim.drawing import TUTORIAL_GRID, tutorial
    from bayesmap.sim.forward import simulate

    walls, pose = tutorial()
    sensor = Gaussian(SIGMA_M)
    angles_rad = np.arange(N_BEAMS) * 2 * np.pi / N_BEAMS
    console.detail(f"simulating {N_BEAMS} beams with noise of {SIGMA_M} m")
    scans = simulate(walls, TUTORIAL_GRID, pose, angles_rad, sensor=sensor, max_range_m=MAX_RANGE_M, seed=settings.seed)
    long_schedule = Schedule(settings.chains, settings.warmup, settings.draws)
    arguments: dict[str, tuple[Method, Schedule]] = {
        "gibbs": (Gibbs(), long_schedule),
        "block": (Block(), long_schedule),
        "importance": (Importance(settings.particles), Schedule(chains=1, draws=1000)),
        "film": (Gibbs(), Schedule(chains=1, warmup=0, draws=FILM_SWEEPS)),
    }
    # Run the methods one after the other; Ctrl-C ends the command, since it compares all runs.
    runs: dict[str, Run] = {}
    for name, (method, schedule) in arguments.items():
        with progress_bar(console, "compiling" if not runs else "tracing beams") as report:
            runs[name] = infer(
                scans, TUTORIAL_GRID, prior=Independent(P_WALL[name]), sensor=sensor, method=method, schedule=schedule,
                seed=settings.seed, where=Where(threads=settings.threads), on_progress=report,
            )  # fmt: skip
        if not runs[name].finished:
            raise KeyboardInterrupt
    return runs


def _write_products(runs: "dict[str, Run]", folder: Path) -> list[Path]:
    """Write pictures, a film, the saved run and the map for nav2, and return their paths."""
    import numpy as np

    from bayesmap.sim.drawing import tutorial
    from bayesmap.viz.animation import write_animation
    from bayesmap.viz.diagnostics import weights_figure
    from bayesmap.viz.figure import write_figure

    walls, pose = tutorial()
    paths = []
    for name, title in TITLES.items():
        paths.append(folder / ("posterior.png" if name == "gibbs" else f"posterior-{name}.png"))
        write_figure(runs[name].plot(truth=walls, title=title), paths[-1])
    # The tutorial's axis ends at -10 000 nats, but nearly all weights of this scan are lower: extend the axis.
    weights = runs["importance"].log_weights
    low = min(-10_000.0, 10_000.0 * float(np.floor(np.quantile(weights, 0.01) / 10_000.0)))
    paths.append(folder / "weights-importance.png")
    write_figure(weights_figure(weights, range_nats=(low, 0.0)), paths[-1])
    film = runs["film"]
    for ending in ("gif", "webp"):
        paths.append(folder / f"chain.{ending}")
        write_animation(paths[-1], film.grid, film.draws[0], observed=film.observed, truth=walls, poses=pose)
    paths.append(folder / "run.nc")
    runs["gibbs"].save(paths[-1])
    return [*paths, *runs["gibbs"].export(folder / "map.yaml")]


def _print_report(console: Console, runs: "dict[str, Run]", folder: Path) -> None:
    """Print the speed and the convergence of each method, and where the files are."""
    for name in ("gibbs", "block"):
        summary = runs[name].summary()
        work = f"{runs[name].posterior.draws.chains} chains of {runs[name].posterior.sweep:,} sweeps"
        speed = f"{summary.microseconds_per_sweep:.0f} us a sweep"
        console.say(f"{TITLES[name] + ':':31} {work}, {speed}, R-hat of the log joint {summary.rhat_log_joint:.3f}")
    n_particles = len(runs["importance"].log_weights)
    size = runs["importance"].summary().effective_sample_size
    state = ": importance sampling has collapsed" if size < MIN_EFFECTIVE_SAMPLE_SIZE else ""
    console.say(f"importance sampling:            {n_particles:,} particles, effective sample size {size:.1f}{state}")
    console.say(f"pictures, the saved run and demo.json are in {folder}")
