"""Time and memory of a run, said before it begins."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bayesmap.cli import translation
from bayesmap.cli.console import Console
from bayesmap.cli.keys import InferSettings, SlamSettings

if TYPE_CHECKING:
    from bayesmap.run.cost import Estimate
    from bayesmap.run.runner import Executor
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans


def of_infer(
    settings: InferSettings, scans: Scans, grid: Grid | None = None, executor: Executor | None = None
) -> Estimate | None:
    """Estimate the cost of `infer`; None if it is not known."""
    from bayesmap.api import Inference
    from bayesmap.arguments import Where
    from bayesmap.space.grid import Grid

    grid = Grid.covering(scans, settings.resolution) if grid is None else grid
    inference = Inference.of(
        scans, grid, translation.prior_of(settings), translation.sensor_for(settings, grid.resolution),
        translation.method_of(settings), translation.schedule_of(settings), settings.seed, None,
        settings.hit_depth or 0.0, Where(settings.threads, settings.device, executor),
    )  # fmt: skip
    return inference.estimate()


def of_slam(settings: SlamSettings, scans: Scans) -> Estimate | None:
    """Estimate the cost of `slam` from the poses of the log; None if it is not known."""
    from bayesmap.api import estimate_slam
    from bayesmap.arguments import Where

    return estimate_slam(
        scans, settings.resolution, translation.prior_of(settings),
        translation.sensor_for(settings, settings.resolution),
        True if settings.fast else False if settings.sample_poses else None, settings.no_odometry,
        translation.schedule_of(settings), Where(settings.threads, settings.device),
    )  # fmt: skip


def foretell(console: Console, estimate: Estimate | None) -> None:
    """Print the estimate if the run is long or large."""
    if estimate is not None and (estimate.is_long or estimate.is_large):
        console.say(f"this takes {estimate.words()}")


def of_suggestion(suggestion: str | None, scans: Scans | None) -> dict[str, Any] | None:
    """Return the cost of a suggested command as JSON values; None if it is not known."""
    from bayesmap.errors import BadInput

    if suggestion is None or scans is None:
        return None
    slam, without = suggestion.startswith("bayesmap slam"), "--no-odometry" in suggestion.split()
    try:
        found = of_slam(SlamSettings(no_odometry=without), scans) if slam else of_infer(InferSettings(), scans)
    except BadInput:  # the command itself says why
        return None
    if found is None:
        return None
    return {
        "seconds": found.seconds, "cores": found.cores, "memory_bytes": found.memory,
        "available_bytes": found.available, "fits": not found.is_too_large, "remedy": found.remedy or None,
        "words": found.words(),
    }  # fmt: skip
