"""``bayesmap render``: pictures and films of a saved run."""

from __future__ import annotations

from pathlib import Path

import click

from bayesmap.cli.command import Call, takes
from bayesmap.errors import BadInput
from bayesmap.version import __version__

NAMES = {"figure": "posterior.png", "animation": "chain.gif"}
"""What a picture is called unless the user says otherwise; others are called what they show."""


@takes("render")
@click.argument("run_file", metavar="RUN.nc")
@click.option("-o", "--output", metavar="FILE", help=".png, .pdf, .svg; .gif, .webp. [default: beside RUN.nc]")
@click.option("--truth", metavar="MAP.yaml", help="Outline the true walls, a map_server map.")
def command(call: Call, run_file: str, output: str | None, truth: str | None) -> None:
    """Draw a saved run.

    The figure shows mean, entropy, readings and one draw; --what takes a single panel, the trace of the log joint, the
    weights of importance sampling, or the animation of a chain. An older picture of the same name is replaced.
    """
    from bayesmap.cli import pictures
    from bayesmap.run import load
    from bayesmap.viz.figure import write_figure

    values = call.values()
    what = values["what"]
    target = Path(output) if output else Path(run_file).with_name(NAMES.get(what, f"{what}.png"))
    run = load(run_file)
    draws = run.posterior.packed.shape[1]
    # Methods that compute marginals have an answer without a draw; chains in their warm-up have none.
    if draws == 0 and (what in ("draw", "animation") or run.posterior.settings["method"] in ("gibbs", "block")):
        raise BadInput(f"{run_file}: the run has no draws yet; go on with it by bayesmap infer --resume")
    walls = None if truth is None else pictures.truth_on(run.grid, truth)
    draw = pictures.one_draw(run, values["chain"], values["draw"]) if draws else None
    if what == "figure":
        write_figure(run.plot(truth=walls, **({} if draw is None else {"draw": draw})), target)
    elif what == "trace":
        from bayesmap.viz.diagnostics import trace_figure

        write_figure(trace_figure(run.log_joint, first_sweep=run.posterior.settings["warmup"] + 1), target)
    elif what == "weights":
        from bayesmap.viz.weights import weights_figure

        write_figure(weights_figure(run.log_weights), target)
    elif what == "animation":
        from bayesmap.viz.animation import write_animation

        chain, numbers = pictures.frames(run, values["chain"], values["frames"])
        write_animation(target, run.grid, chain, observed=run.observed, truth=walls, sweeps=numbers)
    else:
        from bayesmap.viz.panel import panel_figure

        values_shown = draw if what == "draw" and draw is not None else run.occupancy
        write_figure(panel_figure(run.grid, what, values_shown, run.observed, truth=walls), target)
    document = {"version": __version__, "what": what, "run": run_file, "outputs": {target.name: str(target)}}
    call.talk.result(document, [target])
