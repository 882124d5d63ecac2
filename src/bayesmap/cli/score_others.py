"""The part of ``bayesmap score`` for maps and trajectories that other programs made."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bayesmap.cli.command import Call
from bayesmap.cli.input_files import need_file
from bayesmap.cli.progress import progress, share
from bayesmap.cli.reading import options_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.posterior.baselines import Fitted
    from bayesmap.posterior.scoring import Score
    from bayesmap.result import Run
    from bayesmap.space.scans import Scans
    from bayesmap.space.trajectory import Trajectory

MAPS = (".yaml", ".yml")

LITTLE_NATS, MUCH_NATS, MANY_STRAYS, VERDICT_M = 0.3, 1.0, 40.0, 3.0
"""Nats a beam beside no map under which a map does not agree with scans, or only in part; per cent of beams that meet
something else from which it agrees only in part; and the distance for which all that is said."""


@dataclass(frozen=True, eq=False)
class Placed:
    """A log's scans at the poses that are judged.

    Attributes:
        train, heldout: without and with every n-th scan.
        trajectory: of the laser.
    """

    train: Scans
    heldout: Scans
    trajectory: Trajectory


def placed_scans(log: str, values: dict[str, Any], trajectory: str | None, mount: NDArray[np.float64] | None) -> Placed:
    """The scans of a log, at their own poses or at those of a trajectory.

    Args:
        log: as typed.
        values: the command's settings.
        trajectory: TUM file; None for the log's own poses.
        mount: where the laser is in the frame whose trajectory that is, shape (3,); None if it is the laser's own.

    Raises:
        BadInput: files that cannot be read, no stamps, or a trajectory of another time.
    """
    need_file(log, "the log that the map was made from", runs=False)
    from bayesmap.io.logs import read_log
    from bayesmap.io.text.tum import read_trajectory
    from bayesmap.space.trajectory import Trajectory

    if values["holdout"] == 0:
        raise BadInput("score: --holdout 0 leaves nothing to score; the sensor is fitted on the other scans")
    scans = read_log(log, **options_of(values))
    if trajectory is None:
        found = Trajectory(scans.poses, scans.stamps_s)
    else:
        found = read_trajectory(trajectory)
        found = found if mount is None else found.of_frame(mount)
        if scans.stamps_s is None:
            raise BadInput(f"{log}: its scans have no stamps, so nobody can say where {trajectory} puts them")
        poses, inside = found.at(scans.stamps_s)
        if not inside.any():
            assert found.stamps_s is not None
            raise BadInput(
                f"{trajectory}: it reaches from {found.stamps_s[0]:.3f} to {found.stamps_s[-1]:.3f} s, but the scans "
                f"of {log} are from {scans.stamps_s[0]:.3f} to {scans.stamps_s[-1]:.3f} s; are both of one clock?"
            )
        scans = replace(scans, poses=poses, beam_poses=None).select(inside)
    train, heldout = scans.holdout(values["holdout"])
    return Placed(train, heldout, found)


def score_map(call: Call, path: str, placed: Placed, how: dict[str, Any]) -> tuple[Fitted, Score]:
    """Fit a sensor to a map on the training scans, and score it on the others.

    Args:
        call: of the command.
        path: of the map.
        placed: the scans.
        how: seed and device of the score.
    """
    from bayesmap.io.ros.maps import read_map
    from bayesmap.posterior.baselines import fit_external_map
    from bayesmap.posterior.scoring import score_prediction

    occupancy, grid = read_map(path)
    name = Path(path).name
    with share(call.console, f"fitting a sensor to {name}") as report:
        fit = fit_external_map(name, occupancy, grid, placed.train, report)
    with share(call.console, f"scoring {name}") as report:
        return fit, score_prediction(fit.predictor, placed.heldout, **how, on_progress=report)


def verdict(name: str, fit: Fitted, own: Score, placed: Placed) -> str:
    """Say in words whether a map agrees with the scans: by what it tells of a reading beside what no map tells.

    Args:
        name: of the map.
        fit: its sensor.
        own: its score on the scans that were held out.
        placed: the scans.
    """
    import numpy as np

    from bayesmap.localization.known_map import log_anywhere, readings_anywhere

    heldout, values = placed.heldout, fit.values
    law = readings_anywhere(placed.train)
    beams = max(1, int((~np.isnan(heldout.ranges_m)).sum()))
    gain = own.nats_per_beam - log_anywhere(law, heldout.ranges_m, placed.train.max_range_m) / beams
    off_m = values["scale_m"] + values["scale_per_m"] * VERDICT_M
    met = values["p_short"] * -math.expm1(-values["rate_short_per_m"] * VERDICT_M)
    strays = 100 * (values["p_random"] + (1 - values["p_random"]) * met)
    if gain < LITTLE_NATS:
        says = "does not agree with these scans: another place, another frame or scale, or wrong poses"
    elif gain < MUCH_NATS or strays > MANY_STRAYS:
        says = "agrees with these scans in part: much was moved, or parts are shifted"
    else:
        says = "agrees with these scans"
    return (
        f"{name} {says}. It tells {gain:.2f} nats a beam more than no map would; walls {VERDICT_M:g} m away are met to "
        f"{100 * off_m:.0f} cm, and {strays:.0f} % of beams met something else before them."
    )


def infer_map(call: Call, placed: Placed, values: dict[str, Any]) -> Run:
    """The posterior over surfaces given a trajectory, from the training scans."""
    from bayesmap.api import infer
    from bayesmap.arguments import Schedule, Where
    from bayesmap.cells.surface import Surface
    from bayesmap.space.grid import Grid

    grid = Grid.covering(placed.train, values["resolution"])
    call.console.say(f"inferring a map of {grid.shape[0]} x {grid.shape[1]} cells from {len(placed.train):,} scans")
    with progress(call.console, "tracing beams") as on_progress:
        return infer(
            placed.train, grid, prior=Surface(), sensor="fit", schedule=Schedule(warmup=50), seed=values["seed"],
            hit_depth=0.5, where=Where(device=values["device"]), on_progress=on_progress,
        )  # fmt: skip


def is_map(path: str) -> bool:
    """Whether a file is called like a map_server map."""
    return Path(path).suffix.lower() in MAPS
