"""``bayesmap plan`` and ``bayesmap explore``: a short safe path, and the poses to scan from next.

Each command loads the run, warns if its chains have not converged, computes with joint draws of the map
(`bayesmap.posterior.decisions`), writes a picture, and prints lines or a JSON document.
"""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import FORCE, Call, command
from bayesmap.cli.console import counted, progress_bar, share_bar, write_lines
from bayesmap.cli.keys import ExploreSettings, PlanSettings
from bayesmap.cli.translation import numbers_of, picture_path

if TYPE_CHECKING:
    from bayesmap.posterior.decisions import Views
    from bayesmap.posterior.route import Route
    from bayesmap.result import Run


@command("plan")
@click.argument("run_file", metavar="RUN.nc")
@click.option("--from", "start", metavar="X,Y", required=True, help="Start of the robot, metres in the map's frame.")
@click.option("--to", "goal", metavar="X,Y", required=True, help="Goal of the robot, metres in the map's frame.")
@click.option("-o", "--output", metavar="FILE", help="Picture: .png, .pdf, .svg. [default: plan.png beside RUN.nc]")
@FORCE
def plan(call: Call[PlanSettings], run_file: str, start: str, goal: str, output: str | None, force: bool) -> None:
    r"""Plan a path for a disc in the map of a saved run.

    \b
    bayesmap plan runs/office/run.nc --from 0,0 --to 12.5,3 --radius 0.25 --risk 0.01
    bayesmap plan runs/office/run.nc --from 0,0 --to 12.5,3 --json | jq .path

    The path is the shortest found whose risk of touching something stays under --risk. If there is none, the command
    returns the safest path, with a warning. The probability of a free path is the share of map draws in which the path
    is free. The value for independent cells is printed beside it. The command prints one corner of the path per line.
    It warns first if the chains of the run have not converged.
    """
    settings = call.settings()
    start_m = numbers_of(start, "--from", "X,Y", (2,))
    goal_m = numbers_of(goal, "--to", "X,Y", (2,))
    run, target = _load_run(call, run_file, output, "plan.png", force=force)
    # These modules import SciPy and Matplotlib: a wrong argument is reported without waiting for them.
    from bayesmap.posterior.decisions import shortest_safe_path
    from bayesmap.viz.figure import write_figure
    from bayesmap.viz.overlays import route_figure

    with share_bar(call.console, "looking at draws of the map") as report:
        route = shortest_safe_path(run.posterior, start_m, goal_m, settings.radius, settings.risk, report)
    picture = route_figure(
        run.grid, run.occupancy, run.observed, route.path, settings.radius,
        title=_route_sentence(route).replace(" (", "\n("), label=run.posterior.prior.words.mean,
    )  # fmt: skip
    write_figure(picture, target)
    if not route.within_risk:
        call.console.warn(_risk_warning(1 - route.free.probability, settings.risk))
    lines = [*(f"{x:.3f},{y:.3f}" for x, y in route.path), _route_sentence(route)]
    free = route.free
    document = {
        "path": route.path.tolist(), "length_m": route.length_m, "radius_m": settings.radius, "risk": settings.risk,
        "within_risk": route.within_risk, "free_probability": free.probability, "standard_error": free.standard_error,
        "independent_cells": free.independent, "run": run_file, "problems": run.summary().problems(),
    }  # fmt: skip
    _print_result(call, document, lines, target)


def _load_run(
    call: Call[Any], run_file: str, output: str | None, default_name: str, *, force: bool
) -> "tuple[Run, Path]":
    """Return the run and the picture's path, by default beside the run. Prints whether the chains have converged."""
    from bayesmap.files import check_ending
    from bayesmap.result import load

    if output:
        check_ending(output, ("png", "pdf", "svg"), "figure")
    target = picture_path(run_file, output, default_name, force=force)
    run = load(run_file)
    call.console.say(f"{run_file}: {counted(run.log_joint.size, 'draw')} of a map of {run.grid.n_cells:,} cells")
    if run.n_draws:
        with progress_bar(call.console, "comparing the chains"):  # shows the text only
            summary = run.summary()
        for strength in summary.strengths():
            call.console.say(f"good: {strength}")
        for problem in summary.problems():
            call.console.warn(f"what follows may be wrong: {problem}")
    return run, target


def _print_result(call: Call[Any], document: dict[str, Any], lines: list[str], target: Path) -> None:
    """Print the lines and the picture's path, or with --json the document and the picture's path."""
    if call.console.as_json:
        call.console.result({**document, "outputs": {target.name: str(target)}}, [])
    else:
        write_lines([*lines, target])


def _route_sentence(route: "Route") -> str:
    """Return the length of a path and its probability of being free, in words."""
    free = route.free
    probability = f"{free.probability:.3f} +- {free.standard_error:.3f} (independent cells: {free.independent:.3f})"
    return f"{route.length_m:.2f} m, free with probability {probability}"


def _risk_warning(risk: float, accepted_risk: float) -> str:
    """Return the warning that the safest path has a larger risk than the accepted one, with a remedy."""
    if risk >= 1:
        finding = "no path was found that is free in any draw of the map"
        return f"{finding}: start or goal may touch a wall, or lie where no beam has been"
    finding = f"no path was found whose risk is {accepted_risk:g} or less"
    safest = f"the safest has a risk of {format_apart_from(risk, accepted_risk)}"
    return f"{finding}; {safest}: accept it with --risk, give a smaller --radius, or map more of the way"


def format_apart_from(value: float, bound: float) -> str:
    """Return a number with 3 digits, or with as many as distinguish it from the printed bound."""
    texts = (f"{value:.{digits}g}" for digits in range(3, 18))
    return next((text for text in texts if float(text) != float(f"{bound:g}")), f"{value:.17g}")


@command("explore")
@click.argument("run_file", metavar="RUN.nc")
@click.option("-o", "--output", metavar="FILE", help="Picture: .png, .pdf, .svg. [default: explore.png beside RUN.nc]")
@FORCE
def explore(call: Call[ExploreSettings], run_file: str, output: str | None, force: bool) -> None:
    r"""Rank the poses from which the next scan tells most about the map of a saved run.

    \b
    bayesmap explore runs/office/run.nc --candidates 200
    bayesmap explore runs/office/run.nc --views 1 --json | jq .views[0].pose

    Candidates are poses that the robot can reach. A fast formula for independent cells and beams ranks all of them. The
    best are compared by joint draws of the map, within each chain: the command prints an upper bound of the expected
    information in nats, one view per line, the best first. The picture has the same numbers. With --json there is a
    lower bound, too. The command warns first if the chains of the run have not converged.
    """
    settings = call.settings()
    run, target = _load_run(call, run_file, output, "explore.png", force=force)
    from bayesmap.posterior.decisions import headings_to_try, next_views
    from bayesmap.viz.figure import write_figure
    from bayesmap.viz.overlays import views_figure

    with share_bar(call.console, "comparing views") as report:
        views = next_views(
            run.posterior, settings.candidates, settings.views, settings.radius, draws=settings.draws,
            seed=settings.seed, on_progress=report,
        )  # fmt: skip
    information = views.information
    picture = views_figure(
        run.grid, run.occupancy, run.observed, candidates=views.candidates, information_nats=views.independent,
        best=views.best, bounds_nats=information.at_most,
    )  # fmt: skip
    write_figure(picture, target)
    best_views = _best_views_json(views)
    document = {
        "run": run_file, "problems": run.summary().problems(), "candidates": len(views.candidates),
        "draws": information.draws, "views": best_views,
    }  # fmt: skip
    any_yaw = len(headings_to_try(run.posterior.scans.angles_rad)) == 1
    lines = [_view_line(rank, view, any_yaw=any_yaw) for rank, view in enumerate(best_views, 1)]
    _print_result(call, document, lines, target)


def _best_views_json(views: "Views") -> list[dict[str, Any]]:
    """Return the best views as JSON values, with their expected information in nats."""
    information = views.information
    assert information.independent is not None
    bounds = {
        "at_least_nats": information.at_least, "at_least_error": information.at_least_error,
        "at_most_nats": information.at_most, "at_most_error": information.at_most_error,
        "independent_nats": information.independent,
    }  # fmt: skip
    poses = [{"pose": views.candidates[candidate].tolist()} for candidate in views.best]
    return [{**pose, **{k: float(v[rank]) for k, v in bounds.items()}} for rank, pose in enumerate(poses)]


def _view_line(rank: int, view: dict[str, Any], *, any_yaw: bool) -> str:
    """Return the pose of a view, and its information, in words; with ``any_yaw`` all yaws are as good."""
    x, y, yaw = view["pose"]
    heading = "any yaw" if any_yaw else f"yaw {math.degrees(yaw):.0f} degrees"
    information = f"at most {view['at_most_nats']:.0f} +- {view['at_most_error']:.0f} nats"
    return f"{rank}: x {x:.2f} m  y {y:.2f} m  {heading}  {information}"
