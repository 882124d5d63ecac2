"""What a cell's state is, as a user says it, and what follows from that for prior, sensor and schedule."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.cells.cell_priors import CellPrior
    from bayesmap.cells.priors import Independent
    from bayesmap.sensors.model import SensorModel

BINARY_DRAWS = 100
"""Draws of a chain over binary walls unless the user says otherwise."""

HIT_DEPTH = {"binary": 0.25, "reflectivity": 0.5, "surface": 0.5}
"""Where in a cell a beam stops unless the user says otherwise; a surface says so itself."""


def settled(values: dict[str, Any]) -> dict[str, Any]:
    """The settings with what follows from the kind of cells filled in.

    Raises:
        BadInput: settings that this kind of cells does not have, or no draws.
    """
    cells = values["cells"]
    out = {**values}
    out["hit_depth"] = HIT_DEPTH[cells] if values["hit_depth"] is None else values["hit_depth"]
    if out["draws"] is not None and out["draws"] < 1:  # the library allows none, where marginals are all that is wanted
        raise BadInput(f"draws: give 1 or more, got {out['draws']}; the picture and the map are made from them")
    if cells != "binary":
        for name, plain in (("prior", None), ("start", None), ("method", "gibbs"), ("order", "radial")):
            if values[name] != plain:
                raise BadInput(f"{name}: {values[name]!r} is for binary walls; add --cells binary")
    return out


def draws_for(values: dict[str, Any], beams: int, cells: int) -> int:
    """The draws of a chain: as many as the user says, else by the kind of cells, and for fields by beams and cells."""
    from bayesmap.field_inference import default_draws

    if values["draws"] is not None:
        return int(values["draws"])
    return BINARY_DRAWS if values["cells"] == "binary" else default_draws(beams, cells, values["chains"])


def prior_of(values: dict[str, Any]) -> Independent | CellPrior:
    """The prior of these cells."""
    from bayesmap.cells.cell_priors import Beta, Surface
    from bayesmap.cells.defaults import P_WALL
    from bayesmap.cells.priors import Independent

    if values["cells"] == "binary":
        return Independent(P_WALL if values["prior"] is None else values["prior"])
    return Surface() if values["cells"] == "surface" else Beta()


def sensor_for(values: dict[str, Any], chosen: SensorModel | str | None, resolution_m: float) -> SensorModel | str:
    """The sensor that was chosen; by default one that is fitted, but for binary walls a good laser's."""
    from bayesmap.cells.defaults import default_sensor

    if chosen is not None:
        return chosen
    return default_sensor(resolution_m) if values["cells"] == "binary" else "fit"
