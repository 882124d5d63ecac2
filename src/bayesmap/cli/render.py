"""``bayesmap render``: pictures and films of a saved run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import Call, takes
from bayesmap.cli.progress import share
from bayesmap.cli.reading import heldout_scans
from bayesmap.errors import BadInput
from bayesmap.version import __version__

if TYPE_CHECKING:
    from numpy.typing import NDArray

NAMES = {"figure": "posterior.png", "animation": "chain.gif"}
"""What a picture is called unless the user says otherwise; others are called what they show."""

WHOLE = ("figure", "animation", "trace", "weights")
"""Pictures that take no window."""


@takes("render")
@click.argument("run_file", metavar="RUN.nc")
@click.option("-o", "--output", metavar="FILE", help=".png, .pdf, .svg; .gif, .webp. [default: beside RUN.nc]")
@click.option("--truth", metavar="MAP.yaml", help="Outline the true walls, a map_server map.")
@click.option("--heldout", metavar="LOG", help="The log that the run was made from, or another of the same place.")
def command(call: Call, run_file: str, output: str | None, truth: str | None, heldout: str | None) -> None:
    r"""Draw a saved run.

    An older picture of the same name is replaced.

    \b
    figure                  mean, how sure, readings and one draw
    mean, entropy, draw     one panel
    deviation, width        how sure: of a wall's probability the standard
                            deviation, of a reflectivity the 90 % interval's
                            width
    residuals, surprise     held-out beams (--heldout LOG) over the map: reading
                            minus predicted median, and minus log score
    log-odds                the posterior beside the classic log-odds map
    surfaces                a stroke a cell, where its hits lie
    trace, weights          of the log joint; of importance sampling
    animation               of a chain

    LOG is read as it was for the run: give the same --no-return, topics, --deskew and --thin-scans as to infer.
    """
    from bayesmap.cli import pictures
    from bayesmap.result import load
    from bayesmap.viz.figure import write_figure

    values = call.values()
    what = values["what"]
    target = Path(output) if output else Path(run_file).with_name(NAMES.get(what, f"{what}.png"))
    run = load(run_file)
    draws = run.n_draws
    # Methods that compute marginals have an answer without a draw; chains in their warm-up have none.
    if draws == 0 and (what in ("draw", "animation") or run.posterior.has_chains):
        raise BadInput(f"{run_file}: the run has no draws yet; go on with it by bayesmap infer --resume")
    if values["window"] is not None and what in WHOLE:
        raise BadInput(f"window: {what} shows the whole map; a single panel, such as --what mean, takes a window")
    grid, cut = pictures.part_of(run, values["window"])
    mean, observed = run.occupancy[cut], run.observed[cut]
    walls = None if truth is None else pictures.truth_on(grid, truth)
    draw = pictures.one_draw(run, values["chain"], values["draw"]) if draws else None
    label = pictures.quantity(run)
    if what == "figure":
        options = {} if draw is None else {"draw": draw}
        write_figure(run.plot(truth=walls, **options), target)
    elif what == "trace":
        from bayesmap.viz.diagnostics import trace_figure

        write_figure(trace_figure(run.log_joint, first_sweep=run.posterior.settings["warmup"] + 1), target)
    elif what == "weights":
        from bayesmap.viz.diagnostics import weights_figure

        write_figure(weights_figure(run.log_weights), target)
    elif what == "animation":
        from bayesmap.viz.animation import write_animation

        chain, numbers = pictures.frames(run, values["chain"], values["frames"])
        write_animation(target, run.grid, chain, observed=run.observed, truth=walls, sweeps=numbers)
    elif what in ("residuals", "surprise"):
        from bayesmap.viz.residuals import residuals_figure, surprise_scale

        if heldout is None:
            raise BadInput(f"{what}: that of scans which the run did not see; name their log by --heldout")
        scans = heldout_scans(run, heldout, values, values["holdout"])
        with share(call.console, "predicting held-out beams") as report:
            ends, numbers_shown = pictures.misses(run, scans, what, report)
        scale = surprise_scale(numbers_shown) if what == "surprise" else None
        write_figure(residuals_figure(grid, mean, ends, numbers_shown, observed, scale=scale), target)
    elif what == "log-odds":
        from bayesmap.viz.map_figures import Candidate, comparison_figure

        other, seen = pictures.log_odds_map(run)
        both = [Candidate("log-odds", other[cut], seen[cut]), Candidate(f"posterior: {label}", mean, observed)]
        write_figure(comparison_figure(grid, both, label="chance that a beam stops"), target)
    elif what == "surfaces":
        from bayesmap.viz.surfaces import surfaces_figure

        write_figure(surfaces_figure(grid, *run.surfaces(), observed), target)
    else:
        from bayesmap.viz.map_figures import panel_figure

        shown: NDArray[Any] = mean
        if what == "deviation":
            pictures.need_walls(run)
        elif what == "width":
            shown = pictures.interval_width(run)[cut]
        elif what == "draw" and draw is not None:
            shown = draw[cut]
        write_figure(panel_figure(grid, what, shown, observed, truth=walls, label=label), target)
    document = {"version": __version__, "what": what, "run": run_file, "outputs": {target.name: str(target)}}
    call.console.result(document, [target])
