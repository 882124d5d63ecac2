"""Which of a saved run's draws, which part of the map, what truth and what other scans a picture shows."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.result import Run
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans

Walls = NDArray[np.bool_]
Draw = NDArray[Any]
"""Walls, or reflectivities in [0, 1]."""


def one_draw(run: Run, chain: int, draw: int) -> Draw:
    """A draw by its number and its chain's, from 1; draw -1 is the last.

    Raises:
        BadInput: there is no such chain or draw.
    """
    chains, draws = run.log_joint.shape
    if not 1 <= chain <= chains:
        raise BadInput(f"chain {chain}: this run has chains 1 to {chains}")
    if not (1 <= draw <= draws or -draws <= draw <= -1):
        raise BadInput(
            f"draw {draw}: this run has {draws:,} draws a chain" + (", 1 to that, or -1 for the last" * (draws > 0))
        )
    return run.map_of(chain - 1, draw - (draw > 0))


def frames(run: Run, chain: int, most: int) -> tuple[Draw, list[int]]:
    """Draws of a chain, evenly spread, and the number of each."""
    one_draw(run, chain, -1)
    if most < 1:
        raise BadInput(f"frames: give 1 or more, got {most}")
    chosen = np.unique(np.linspace(0, run.n_draws - 1, min(most, run.n_draws)).round().astype(int))
    return np.stack([run.map_of(chain - 1, i) for i in chosen.tolist()]), [int(i) + 1 for i in chosen]


def truth_on(grid: Grid, path: str) -> Walls:
    """The walls of a map_server map at the centres of another grid's cells; none outside of that map."""
    from bayesmap.io.ros.maps import read_map

    occupancy, there = read_map(path)
    x, y = grid.centers_m()
    points: Any = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    i, j = np.moveaxis(np.floor(there.to_cells(points)).astype(int), -1, 0)
    inside = (i >= 0) & (i < there.shape[0]) & (j >= 0) & (j < there.shape[1])
    walls = np.zeros(grid.shape, dtype=np.bool_)
    walls[inside] = occupancy[i[inside], j[inside]] > 0.5
    return walls


def part_of(run: Run, text: str | None) -> tuple[Grid, tuple[slice, slice]]:
    """The part of the map that a window, as typed, leaves; all of it for None.

    Raises:
        BadInput: neither four numbers nor "observed", or a window outside the map.
    """
    from bayesmap.viz.cells import window, window_around

    if text is None:
        return run.grid, (slice(None), slice(None))
    if text == "observed":
        return window_around(run.grid, run.observed)
    try:
        x0, x1, y0, y1 = (float(part) for part in text.split(","))
    except ValueError:
        raise BadInput(f"window {text!r}: give X0,X1,Y0,Y1 in metres, such as 0,10,-5,5, or: observed") from None
    return window(run.grid, (x0, x1), (y0, y1))


def need_walls(run: Run) -> None:
    """The standard deviation that pictures show is that of a wall.

    Raises:
        BadInput: cells are reflectivities.
    """
    if run.posterior.prior.has_interval:
        raise BadInput("deviation: that of binary walls; --what width shows how sure a reflectivity is")


def interval_width(run: Run) -> NDArray[np.float64]:
    """Upper minus lower bound of the central 90 % interval of each cell, (nx, ny).

    Raises:
        BadInput: cells are walls or free, which have no interval.
    """
    if not run.posterior.prior.has_interval:
        raise BadInput(
            "width: a wall is there or not, and has no interval; --what entropy or deviation shows how sure it is"
        )
    lower, upper = run.interval(0.9)
    return np.asarray(upper - lower)


def log_odds_map(run: Run) -> tuple[NDArray[np.float64], Walls]:
    """The log-odds map of the run's scans, by OctoMap's numbers and unclamped, and the cells it saw, (nx, ny)."""
    from bayesmap.kernels.counts import count_hits
    from bayesmap.posterior.baselines import log_odds_as_usual

    hits, passes = (counts.reshape(run.grid.shape) for counts in count_hits(run.posterior.scans, run.grid))
    return log_odds_as_usual(hits.astype(float), passes.astype(float), {}), hits + passes > 0


def misses(
    run: Run, scans: Scans, what: str, on_progress: Callable[[float], None]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """End points of beams, metres, (n, 2), and how badly each was predicted, (n,).

    That is reading minus predicted median in metres for "residuals", and minus the log score in nats for "surprise".
    """
    from bayesmap.posterior.predictor import predictor_of
    from bayesmap.posterior.residuals import residuals_of

    found = residuals_of(predictor_of(run.posterior), scans, on_progress=on_progress)
    return found.ends_world, found.residual_m if what == "residuals" else found.surprise_nats


def quantity(run: Run) -> str:
    """What the occupancy of a run's cells is, for colour bars."""
    return run.posterior.prior.words.mean
