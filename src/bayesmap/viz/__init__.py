"""Figures and animations of maps, posteriors and chains.

Import this package inside the function that draws: matplotlib and Pillow are slow to load, and most runs draw
nothing.
"""

from bayesmap.viz.animation import render_frames, write_animation
from bayesmap.viz.diagnostics import draw_log_joint, draw_running_mean, draw_weights, trace_figure, weights_figure
from bayesmap.viz.figure import Candidate, comparison_figure, panel_figure, posterior_figure, write_figure
from bayesmap.viz.maps import draw_deviation, draw_entropy, draw_probability, draw_sample, draw_width, window
from bayesmap.viz.overlays import (
    draw_rays,
    draw_sensor,
    draw_surfaces,
    draw_truth_outline,
    surface_strokes,
    surfaces_figure,
)  # fmt: skip
from bayesmap.viz.scores import draw_residuals, residual_scale, residuals_figure, surprise_scale

__all__ = [
    "Candidate", "comparison_figure", "draw_deviation", "draw_entropy", "draw_log_joint", "draw_probability",
    "draw_rays", "draw_residuals", "draw_running_mean", "draw_sample", "draw_sensor", "draw_surfaces",
    "draw_truth_outline", "draw_weights", "draw_width", "panel_figure", "posterior_figure", "render_frames",
    "residual_scale", "residuals_figure", "surface_strokes", "surfaces_figure", "surprise_scale", "trace_figure",
    "weights_figure", "window", "write_animation", "write_figure",
]  # fmt: skip
