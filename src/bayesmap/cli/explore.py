"""``bayesmap explore``: the poses from which one more scan would tell most about the map."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import Call, takes
from bayesmap.cli.console import write_out
from bayesmap.cli.progress import share
from bayesmap.version import __version__

if TYPE_CHECKING:
    from bayesmap.posterior.decisions import Views


@takes("explore")
@click.argument("run_file", metavar="RUN.nc")
@click.option("-o", "--output", metavar="FILE", help="Picture: .png, .pdf, .svg. [default: explore.png beside RUN.nc]")
def command(call: Call, run_file: str, output: str | None) -> None:
    r"""Say from where to look next, in the map of a saved run.

    \b
    bayesmap explore runs/office/run.nc --candidates 200
    bayesmap explore runs/office/run.nc --views 1 --json | jq .views[0].pose

    Candidates lie where the robot can get to. A fast formula that takes cells and beams for independent goes over all
    of them; the best are compared by joint draws of the map: what a scan tells lies between two bounds. Prints a line
    for each view, the best first. An older picture of the same name is replaced.
    """
    values = call.values()
    target = Path(output) if output else Path(run_file).with_name("explore.png")
    from bayesmap.files import need_ending
    from bayesmap.posterior.decisions import next_views
    from bayesmap.result import load

    need_ending(target, ("png", "pdf", "svg"), "figure")
    run = load(run_file)
    with share(call.console, "comparing views") as report:
        found = next_views(
            run.posterior, values["candidates"], values["views"], values["radius"],
            draws=values["draws"], seed=values["seed"], on_progress=report,
        )  # fmt: skip
    from bayesmap.viz.decisions import views_figure
    from bayesmap.viz.figure import write_figure

    picture = views_figure(
        run.grid, run.occupancy, run.observed, found.candidates, found.independent, found.best,
        label=run.posterior.prior.words.mean,
    )  # fmt: skip
    write_figure(picture, target)
    if call.console.as_json:
        document = {
            "version": __version__, "run": run_file, "candidates": len(found.candidates),
            "draws": found.information.draws, "views": _views(found), "outputs": {target.name: str(target)},
        }  # fmt: skip
        call.console.result(document, [])
        return
    write_out("".join(f"{_line(view)}\n" for view in _views(found)) + f"{target}\n")


def _views(found: Views) -> list[dict[str, Any]]:
    information = found.information
    assert information.independent is not None
    return [
        {
            "pose": [float(v) for v in found.candidates[i]],
            "at_least_nats": float(information.at_least[k]),
            "at_least_error": float(information.at_least_error[k]),
            "at_most_nats": float(information.at_most[k]),
            "at_most_error": float(information.at_most_error[k]),
            "independent_nats": float(information.independent[k]),
        }
        for k, i in enumerate(found.best)
    ]


def _line(view: dict[str, Any]) -> str:
    x, y, yaw = view["pose"]
    return (
        f"x {x:.2f} m  y {y:.2f} m  yaw {math.degrees(yaw):.0f} degrees  "
        f"{view['at_least_nats']:.1f} to {view['at_most_nats']:.1f} +- {view['at_most_error']:.1f} nats  "
        f"(independent: {view['independent_nats']:.1f})"
    )
