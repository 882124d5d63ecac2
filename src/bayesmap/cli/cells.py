"""What a cell's state is, as a user says it, and what follows from that for prior, sensor and schedule."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.cells.kind import CellPrior
    from bayesmap.samplers.methods import Method
    from bayesmap.sensors.model import SensorModel

METHOD_OPTIONS = ("order", "start", "rounds", "particles")

BINARY_DRAWS = 100
"""Draws of a chain over binary walls unless the user says otherwise."""


def with_defaults(values: dict[str, Any]) -> dict[str, Any]:
    """The settings with what follows from the kind of cells filled in.

    Raises:
        BadInput: settings that this kind of cells does not have, or no draws.
    """
    from bayesmap.cells.kinds import BUILT_IN

    kind = BUILT_IN[values["cells"]]
    out = {**values}
    if out["hit_depth"] is None:
        out["hit_depth"] = kind.hit_depth
    if out["draws"] is not None and out["draws"] < 1:  # the library allows none, where marginals are all that is wanted
        raise BadInput(f"draws: give 1 or more, got {out['draws']}; the picture and the map are made from them")
    if not kind.has_walls:
        if values["coupling"] == "fit":
            raise BadInput("coupling: 'fit' is for binary walls; add --cells binary, or give a number")
        plain_values = {"prior": None, "start": None, "method": "gibbs", "order": "radial"}
        for name, plain in plain_values.items():
            if values[name] != plain:
                raise BadInput(f"{name}: {values[name]!r} is for binary walls; add --cells binary")
    return out


def draws_for(values: dict[str, Any], beams: int, cells: int) -> int:
    """The draws of a chain: as many as the user says, else as many as suit the kind of cells, beams and grid.

    ``thin`` is known by then (`sweeps_a_draw`).
    """
    from bayesmap.cells.kinds import BUILT_IN

    if values["draws"] is not None:
        return int(values["draws"])
    kind = BUILT_IN[values["cells"]]
    return BINARY_DRAWS if kind.has_walls else kind().default_draws(beams, cells, values["chains"], values["thin"])


def sweeps_a_draw(values: dict[str, Any]) -> int:
    """Sweeps from one draw to the next: as many as the user says, else as many as suit the kind of cells."""
    from bayesmap.cells.kinds import BUILT_IN

    if values["thin"] is not None:
        return int(values["thin"])
    return BUILT_IN[values["cells"]].sweeps_a_draw if values["draws"] is None else 1


def method_of(values: dict[str, Any]) -> Method:
    """The method with its options."""
    from bayesmap.samplers.methods import METHODS

    kind = METHODS[values["method"]]
    return kind(**{name: values[name] for name in METHOD_OPTIONS if name in kind.__dataclass_fields__})


def prior_of(values: dict[str, Any]) -> CellPrior:
    """The prior of these cells."""
    from bayesmap.cells.binary import Independent
    from bayesmap.cells.ising import Ising
    from bayesmap.cells.kinds import BUILT_IN, P_WALL

    kind = BUILT_IN[values["cells"]]
    if kind.has_walls:
        p_wall, coupling = P_WALL if values["prior"] is None else values["prior"], values["coupling"]
        return Independent(p_wall) if coupling is None else Ising(p_wall, coupling)
    return kind(coupling=values["coupling"] or 0.0)  # type: ignore[call-arg]


def sensor_for(values: dict[str, Any], chosen: SensorModel | str | None, resolution_m: float) -> SensorModel | str:
    """The sensor that was chosen; by default one that is fitted, but for binary walls a good laser's."""
    from bayesmap.cells.kinds import BUILT_IN, default_sensor

    if chosen is not None:
        return chosen
    return "fit" if BUILT_IN[values["cells"]].sensor_is_fitted else default_sensor(resolution_m)
