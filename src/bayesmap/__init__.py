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

    from bayesmap.api import infer as infer
    from bayesmap.app.widget import MapWidget as MapWidget
    from bayesmap.errors import BadInput as BadInput
    from bayesmap.field_run import FieldRun as FieldRun
    from bayesmap.io.logs import read_log as read_log
    from bayesmap.loading import load as load
    from bayesmap.model.cell_priors import Beta as Beta
    from bayesmap.model.cell_priors import Surface as Surface
    from bayesmap.model.forward import ranges as ranges
    from bayesmap.model.forward import simulate as simulate
    from bayesmap.model.mapping import mapping_model as mapping_model
    from bayesmap.model.priors import Independent as Independent
    from bayesmap.run import Run as Run
    from bayesmap.run import score as score
    from bayesmap.sensor.mixture import BeamMixture as BeamMixture
    from bayesmap.sensor.model import SensorModel as SensorModel
    from bayesmap.sensor.noise import Gaussian as Gaussian
    from bayesmap.sensor.noise import StudentT as StudentT
    from bayesmap.world import worlds as worlds
    from bayesmap.world.grid import Grid as Grid
    from bayesmap.world.scans import Reading as Reading
    from bayesmap.world.scans import Scans as Scans

_HOME = {
    "BadInput": "bayesmap.errors",
    "Beta": "bayesmap.model.cell_priors",
    "BeamMixture": "bayesmap.sensor.mixture",
    "FieldRun": "bayesmap.field_run",
    "Gaussian": "bayesmap.sensor.noise",
    "Grid": "bayesmap.world.grid",
    "Independent": "bayesmap.model.priors",
    "MapWidget": "bayesmap.app.widget",
    "Reading": "bayesmap.world.scans",
    "Run": "bayesmap.run",
    "Scans": "bayesmap.world.scans",
    "SensorModel": "bayesmap.sensor.model",
    "StudentT": "bayesmap.sensor.noise",
    "Surface": "bayesmap.model.cell_priors",
    "infer": "bayesmap.api",
    "load": "bayesmap.loading",
    "mapping_model": "bayesmap.model.mapping",
    "ranges": "bayesmap.model.forward",
    "read_log": "bayesmap.io.logs",
    "score": "bayesmap.run",
    "simulate": "bayesmap.model.forward",
    "worlds": "bayesmap.world.worlds",
}

__all__ = ["__version__", *_HOME]  # noqa: PLE0604 -- the strings are in _HOME


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'bayesmap' has no attribute {name!r}")
    module = importlib.import_module(_HOME[name])
    return module if name == "worlds" else getattr(module, name)


def __dir__() -> list[str]:
    return sorted(__all__)
