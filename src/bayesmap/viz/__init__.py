"""Figures and animations of maps, posteriors and chains.

Import this package inside the function that draws: matplotlib and Pillow are slow to load, and most runs draw
nothing.
"""

from bayesmap.viz.animation import render_frames, write_animation
from bayesmap.viz.diagnostics import draw_log_joint, draw_running_mean, trace_figure
from bayesmap.viz.figure import posterior_figure, write_figure
from bayesmap.viz.maps import draw_deviation, draw_entropy, draw_probability, draw_sample
from bayesmap.viz.overlays import draw_rays, draw_sensor, draw_truth_outline
from bayesmap.viz.panel import panel_figure
from bayesmap.viz.weights import draw_weights, weights_figure

__all__ = [
    "draw_deviation",
    "draw_entropy",
    "draw_log_joint",
    "draw_probability",
    "draw_rays",
    "draw_running_mean",
    "draw_sample",
    "draw_sensor",
    "draw_truth_outline",
    "draw_weights",
    "panel_figure",
    "posterior_figure",
    "render_frames",
    "trace_figure",
    "weights_figure",
    "write_animation",
    "write_figure",
]
