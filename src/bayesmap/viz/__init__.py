"""Figures and animations of maps, posteriors and chains.

Public names are loaded on first use, each with its module: matplotlib loads slowly, and most runs render nothing.
"""

from importlib import import_module
from typing import Any

_NAMES = {  # public names, by the module that defines them
    "animation": "render_frames write_animation", "maps": "plot_deviation plot_entropy plot_probability plot_sample "
    "plot_width window", "figure": "Candidate comparison_figure panel_figure posterior_figure write_figure",
    "diagnostics": "plot_log_joint plot_running_mean plot_weights trace_figure weights_figure",
    "overlays": "plot_rays plot_sensor plot_surfaces plot_truth_outline surface_strokes surfaces_figure",
    "scores": "plot_residuals residual_scale residuals_figure surprise_scale",
}  # fmt: skip
_MODULES = {name: f"{__name__}.{module}" for module, names in _NAMES.items() for name in names.split()}
__all__ = list(_MODULES)


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_MODULES[name]), name)
