"""bayesmap: given noisy range scans, where are the walls, and how sure are we?

Read `bayesmap.api` first, and then `bayesmap.result.Run`, which `infer` and `slam` return. The public names are loaded
on first use (`__getattr__`). So the import is fast. Type checkers read the first block of imports instead.
"""

from __future__ import annotations

import importlib

from bayesmap.version import __version__ as __version__

TYPE_CHECKING = False  # importing typing for it would slow the start of every command
if TYPE_CHECKING:
    from typing import Any

    # isort: off
    from bayesmap import worlds as worlds
    from bayesmap.api import infer as infer, slam as slam
    from bayesmap.app.widget import MapWidget as MapWidget
    from bayesmap.arguments import Checkpoints as Checkpoints, Schedule as Schedule, Where as Where
    from bayesmap.cells.binary import Independent as Independent, Ising as Ising, fit_coupling as fit_coupling
    from bayesmap.cells.reflectivity import Beta as Beta
    from bayesmap.cells.surface import Surface as Surface
    from bayesmap.errors import BadInput as BadInput
    from bayesmap.io.logs import read_log as read_log
    from bayesmap.io.text.trajectories import read_trajectory as read_trajectory
    from bayesmap.localization.known_map import KnownMap as KnownMap
    from bayesmap.localization.localize import InitialPose as InitialPose, localize as localize
    from bayesmap.poses.prior import KnownPoses as KnownPoses, Odometry as Odometry, UncertainPoses as UncertainPoses
    from bayesmap.posterior.decisions import InformationGain as InformationGain
    from bayesmap.posterior.route import FreeProbability as FreeProbability, Route as Route
    from bayesmap.posterior.scores import compare_scores as compare_scores
    from bayesmap.programs.mapping import mapping_model as mapping_model
    from bayesmap.result import Run as Run, load as load, score as score
    from bayesmap.run.ray_executor import RayExecutor as RayExecutor
    from bayesmap.samplers.methods import (
        Block as Block, Exact as Exact, Gibbs as Gibbs, Importance as Importance, Propagate as Propagate,
    )  # fmt: skip
    from bayesmap.sensors.model import BeamMixture as BeamMixture, Gaussian as Gaussian, StudentT as StudentT
    from bayesmap.sensors.model import SensorModel as SensorModel
    from bayesmap.sim.forward import ranges as ranges, simulate as simulate
    from bayesmap.sim.robot import OdometryNoise as OdometryNoise, simulate_odometry as simulate_odometry
    from bayesmap.space.grid import Grid as Grid
    from bayesmap.space.scans import ReadingKind as ReadingKind, Scans as Scans
    # isort: on

# fmt: off
_NAMES = {  # public names, by the module that defines them
    "api": "infer slam", "app.widget": "MapWidget", "arguments": "Checkpoints Schedule Where",
    "cells.binary": "Independent Ising fit_coupling", "cells.reflectivity": "Beta", "cells.surface": "Surface",
    "errors": "BadInput", "io.logs": "read_log", "io.text.trajectories": "read_trajectory",
    "localization.known_map": "KnownMap", "localization.localize": "InitialPose localize",
    "poses.prior": "KnownPoses Odometry UncertainPoses", "posterior.decisions": "InformationGain",
    "posterior.route": "FreeProbability Route", "posterior.scores": "compare_scores",
    "programs.mapping": "mapping_model", "result": "Run load score", "run.ray_executor": "RayExecutor",
    "samplers.methods": "Block Exact Gibbs Importance Propagate",
    "sensors.model": "BeamMixture Gaussian SensorModel StudentT", "sim.forward": "ranges simulate",
    "sim.robot": "OdometryNoise simulate_odometry", "space.grid": "Grid", "space.scans": "ReadingKind Scans",
    "worlds": "worlds",
}
# fmt: on
_MODULES = {name: f"bayesmap.{module}" for module, names in _NAMES.items() for name in names.split()}

__all__ = ["__version__", *_MODULES]  # noqa: PLE0604 -- the strings are in _MODULES


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module 'bayesmap' has no attribute {name!r}")
    module = importlib.import_module(_MODULES[name])
    return module if name == "worlds" else getattr(module, name)


def __dir__() -> list[str]:
    return sorted(__all__)
