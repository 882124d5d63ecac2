"""Figures and animations of maps, posteriors and chains.

Import this package inside the function that renders: matplotlib and Pillow load slowly, and most runs render nothing.
Public names are loaded on first use, since a first map needs no more than `bayesmap.viz.palette`.
"""

from importlib import import_module
from typing import Any

__all__ = [
    "Candidate", "comparison_figure", "panel_figure", "plot_deviation", "plot_entropy", "plot_log_joint",
    "plot_probability", "plot_rays", "plot_residuals", "plot_running_mean", "plot_sample", "plot_sensor",
    "plot_surfaces", "plot_truth_outline", "plot_weights", "plot_width", "posterior_figure", "render_frames",
    "residual_scale", "residuals_figure", "surface_strokes", "surfaces_figure", "surprise_scale", "trace_figure",
    "weights_figure", "window", "write_animation", "write_figure",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    for module in ("animation", "diagnostics", "figure", "maps", "overlays", "scores") if name in __all__ else ():
        if hasattr(loaded := import_module(f"{__name__}.{module}"), name):
            return getattr(loaded, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
