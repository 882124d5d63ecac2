"""bayesmap: given noisy range scans, where are the walls, and how sure are we?

The public names are loaded on first use, so that importing this package costs nothing: neither JAX nor Warp nor
matplotlib is loaded until something needs it.
"""

from __future__ import annotations

import importlib

from bayesmap.version import __version__ as __version__

TYPE_CHECKING = False  # typing's own would load typing, in the first moments of every command
if TYPE_CHECKING:
    from typing import Any

    from bayesmap import worlds as worlds
    from bayesmap.api import infer as infer
    from bayesmap.app.widget import MapWidget as MapWidget
    from bayesmap.arguments import Checkpoints as Checkpoints
    from bayesmap.arguments import Schedule as Schedule
    from bayesmap.arguments import Where as Where
    from bayesmap.cells.binary import Independent as Independent
    from bayesmap.cells.binary import Ising as Ising
    from bayesmap.cells.binary import fit_coupling as fit_coupling
    from bayesmap.cells.reflectivity import Beta as Beta
    from bayesmap.cells.surface import Surface as Surface
    from bayesmap.errors import BadInput as BadInput
    from bayesmap.from_odometry import slam as slam
    from bayesmap.io.logs import read_log as read_log
    from bayesmap.localization.known_map import KnownMap as KnownMap
    from bayesmap.localization.localize import Near as Near
    from bayesmap.localization.localize import localize as localize
    from bayesmap.poses.prior import Known as Known
    from bayesmap.poses.prior import Odometry as Odometry
    from bayesmap.poses.prior import Uncertain as Uncertain
    from bayesmap.posterior.information import Information as Information
    from bayesmap.posterior.route import FreeProbability as FreeProbability
    from bayesmap.posterior.route import Route as Route
    from bayesmap.programs.mapping import mapping_model as mapping_model
    from bayesmap.result import Run as Run
    from bayesmap.result import load as load
    from bayesmap.result import score as score
    from bayesmap.run.ray_executor import RayExecutor as RayExecutor
    from bayesmap.samplers.methods import Block as Block
    from bayesmap.samplers.methods import Exact as Exact
    from bayesmap.samplers.methods import Gibbs as Gibbs
    from bayesmap.samplers.methods import Importance as Importance
    from bayesmap.samplers.methods import Propagate as Propagate
    from bayesmap.sensors.builtin import BeamMixture as BeamMixture
    from bayesmap.sensors.builtin import Gaussian as Gaussian
    from bayesmap.sensors.builtin import StudentT as StudentT
    from bayesmap.sensors.model import SensorModel as SensorModel
    from bayesmap.sim.forward import ranges as ranges
    from bayesmap.sim.forward import simulate as simulate
    from bayesmap.sim.robot import OdometryNoise as OdometryNoise
    from bayesmap.sim.robot import simulate_odometry as simulate_odometry
    from bayesmap.space.grid import Grid as Grid
    from bayesmap.space.scans import Reading as Reading
    from bayesmap.space.scans import Scans as Scans

_HOME = {
    "BadInput": "bayesmap.errors",
    "BeamMixture": "bayesmap.sensors.builtin",
    "Beta": "bayesmap.cells.reflectivity",
    "Block": "bayesmap.samplers.methods",
    "Checkpoints": "bayesmap.arguments",
    "Exact": "bayesmap.samplers.methods",
    "FreeProbability": "bayesmap.posterior.route",
    "Gaussian": "bayesmap.sensors.builtin",
    "Gibbs": "bayesmap.samplers.methods",
    "Grid": "bayesmap.space.grid",
    "Importance": "bayesmap.samplers.methods",
    "Independent": "bayesmap.cells.binary",
    "Information": "bayesmap.posterior.information",
    "Ising": "bayesmap.cells.binary",
    "Known": "bayesmap.poses.prior",
    "KnownMap": "bayesmap.localization.known_map",
    "MapWidget": "bayesmap.app.widget",
    "Near": "bayesmap.localization.localize",
    "Odometry": "bayesmap.poses.prior",
    "OdometryNoise": "bayesmap.sim.robot",
    "Propagate": "bayesmap.samplers.methods",
    "RayExecutor": "bayesmap.run.ray_executor",
    "Reading": "bayesmap.space.scans",
    "Route": "bayesmap.posterior.route",
    "Run": "bayesmap.result",
    "Scans": "bayesmap.space.scans",
    "Schedule": "bayesmap.arguments",
    "SensorModel": "bayesmap.sensors.model",
    "StudentT": "bayesmap.sensors.builtin",
    "Surface": "bayesmap.cells.surface",
    "Uncertain": "bayesmap.poses.prior",
    "Where": "bayesmap.arguments",
    "fit_coupling": "bayesmap.cells.binary",
    "infer": "bayesmap.api",
    "load": "bayesmap.result",
    "localize": "bayesmap.localization.localize",
    "mapping_model": "bayesmap.programs.mapping",
    "ranges": "bayesmap.sim.forward",
    "read_log": "bayesmap.io.logs",
    "score": "bayesmap.result",
    "simulate": "bayesmap.sim.forward",
    "simulate_odometry": "bayesmap.sim.robot",
    "slam": "bayesmap.from_odometry",
    "worlds": "bayesmap.worlds",
}

__all__ = ["__version__", *_HOME]  # noqa: PLE0604 -- the strings are in _HOME


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'bayesmap' has no attribute {name!r}")
    module = importlib.import_module(_HOME[name])
    return module if name == "worlds" else getattr(module, name)


def __dir__() -> list[str]:
    return sorted(__all__)
