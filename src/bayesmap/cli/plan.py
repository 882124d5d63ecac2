"""``bayesmap plan``: the shortest path for a robot whose risk of touching something stays under a bound."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import Call, takes
from bayesmap.cli.console import write_out
from bayesmap.cli.progress import share
from bayesmap.cli.typed_numbers import numbers_of
from bayesmap.version import __version__

if TYPE_CHECKING:
    from bayesmap.posterior.route import Route


@takes("plan")
@click.argument("run_file", metavar="RUN.nc")
@click.option("--from", "start", metavar="X,Y", required=True, help="Where the robot is, metres in the map's frame.")
@click.option("--to", "goal", metavar="X,Y", required=True, help="Where it is to go.")
@click.option("-o", "--output", metavar="FILE", help="Picture: .png, .pdf, .svg. [default: plan.png beside RUN.nc]")
def command(call: Call, run_file: str, start: str, goal: str, output: str | None) -> None:
    r"""Plan a path for a disc in the map of a saved run.

    \b
    bayesmap plan runs/office/run.nc --from 0,0 --to 12.5,3 --radius 0.25 --risk 0.01
    bayesmap plan runs/office/run.nc --from 0,0 --to 12.5,3 --json | jq .path

    The path is the shortest found whose risk of touching something stays under --risk; if there is none, the safest,
    with a warning. Its probability of being free is the share of the posterior's joint draws of the map in which it is;
    beside it stands what a product over independent cells would say. Prints the path's corners, a line each. An older
    picture of the same name is replaced.
    """
    values = call.values()
    ends = [numbers_of(text, flag, "X,Y", (2,)) for text, flag in ((start, "--from"), (goal, "--to"))]
    target = Path(output) if output else Path(run_file).with_name("plan.png")
    from bayesmap.files import need_ending
    from bayesmap.posterior.decisions import shortest_safe_path
    from bayesmap.result import load

    need_ending(target, ("png", "pdf", "svg"), "figure")
    run = load(run_file)
    with share(call.console, "looking at draws of the map") as report:
        route = shortest_safe_path(run.posterior, ends[0], ends[1], values["radius"], values["risk"], report)
    from bayesmap.viz.decisions import route_figure
    from bayesmap.viz.figure import write_figure

    picture = route_figure(
        run.grid, run.occupancy, run.observed, route.path, values["radius"],
        title=_sentence(route), label=run.posterior.prior.words.mean,
    )  # fmt: skip
    write_figure(picture, target)
    if not route.within_risk:
        call.console.warn(
            f"no path was found whose risk is {values['risk']:g} or less; this is the safest: "
            f"{1 - route.free.probability:.3g}"
        )
    if call.console.as_json:
        call.console.result({**_document(route, values), "run": run_file, "outputs": {target.name: str(target)}}, [])
        return
    corners = "".join(f"{x:.3f},{y:.3f}\n" for x, y in route.path)
    write_out(f"{corners}{_sentence(route)}\n{target}\n")


def _sentence(route: Route) -> str:
    free = route.free
    return (
        f"{route.length_m:.2f} m, free with probability {free.probability:.3f} +- {free.standard_error:.3f} "
        f"(independent cells: {free.independent:.3f})"
    )


def _document(route: Route, values: dict[str, Any]) -> dict[str, Any]:
    return {
        "version": __version__,
        "path": route.path.tolist(),
        "length_m": route.length_m,
        "radius_m": values["radius"],
        "risk": values["risk"],
        "within_risk": route.within_risk,
        "free_probability": route.free.probability,
        "standard_error": route.free.standard_error,
        "independent_cells": route.free.independent,
    }
