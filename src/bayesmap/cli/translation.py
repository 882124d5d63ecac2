"""Settings as the library takes them: prior, sensor, method, schedule, executor, and how a log is read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeVar

import msgspec

from bayesmap.cli.keys import InferSettings, ReadingSettings, SamplingSettings
from bayesmap.cli.typed import pose_of, sensor_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.arguments import Schedule
    from bayesmap.cells.kind import CellPrior
    from bayesmap.run.runner import Executor
    from bayesmap.samplers.methods import Method
    from bayesmap.sensors.model import SensorModel

S = TypeVar("S", bound=SamplingSettings)

BINARY_DRAWS = 100
"""Draws of a chain over binary walls unless the user says otherwise."""

THREADS, RAY = "threads", "ray"


def completed(settings: S) -> S:
    """Return the settings with what follows from the kind of cells filled in.

    Raises:
        BadInput: settings that this kind of cells does not have, or a sensor that is none.
    """
    from bayesmap.cells.kinds import BUILT_IN

    kind = BUILT_IN[settings.cells]
    if isinstance(settings, InferSettings) and not kind.has_walls:
        if settings.coupling == "fit":
            raise BadInput("coupling: 'fit' is for binary walls; add --cells binary, or give a number")
        for name in ("prior", "start", "method", "order"):
            value = getattr(settings, name)
            if value != getattr(InferSettings(), name):
                raise BadInput(f"{name}: {value!r} is for binary walls; add --cells binary")
    if settings.sensor != "fit":
        sensor_of(settings.sensor)
    return settings if settings.hit_depth is not None else msgspec.structs.replace(settings, hit_depth=kind.hit_depth)


def with_schedule(settings: InferSettings, beams: int, cells: int) -> InferSettings:
    """Return the settings with ``thin`` and ``draws`` that suit the kind of cells, the beams and the grid."""
    from bayesmap.cells.kinds import BUILT_IN

    kind, thin, draws = BUILT_IN[settings.cells], settings.thin, settings.draws
    if thin is None:
        thin = kind.sweeps_a_draw if draws is None else 1
    if draws is None:
        draws = BINARY_DRAWS if kind.has_walls else kind().default_draws(beams, cells, settings.chains, thin)
    return msgspec.structs.replace(settings, thin=thin, draws=draws)


def schedule_of(settings: SamplingSettings) -> Schedule:
    """Return the schedule of the chains."""
    from bayesmap.arguments import Schedule

    return Schedule(settings.chains, settings.warmup, settings.draws, settings.thin)


def method_of(settings: InferSettings) -> Method:
    """Return the method with its options."""
    from bayesmap.samplers.methods import METHODS

    kind = METHODS[settings.method]
    names = ("order", "start", "rounds", "particles")
    return kind(**{name: getattr(settings, name) for name in names if name in kind.__dataclass_fields__})


def prior_of(settings: SamplingSettings) -> CellPrior:
    """Return the prior of the cells."""
    from bayesmap.cells.binary import Independent, Ising
    from bayesmap.cells.kinds import BUILT_IN, P_WALL

    p_wall, coupling = (settings.prior, settings.coupling) if isinstance(settings, InferSettings) else (None, None)
    kind = BUILT_IN[settings.cells]
    if not kind.has_walls:
        return kind(coupling=coupling or 0.0)  # type: ignore[call-arg]
    p_wall = P_WALL if p_wall is None else p_wall
    return Independent(p_wall) if coupling is None else Ising(p_wall, coupling)


def sensor_for(settings: SamplingSettings, resolution_m: float) -> SensorModel | Literal["fit"]:
    """Return the sensor that was chosen; by default one that is fitted, but for binary walls that of a good laser."""
    from bayesmap.cells.kinds import BUILT_IN, default_sensor

    if settings.sensor == "fit":
        return "fit"
    chosen = sensor_of(settings.sensor)
    if chosen is not None:
        return chosen
    return "fit" if BUILT_IN[settings.cells].sensor_is_fitted else default_sensor(resolution_m)


def ray_address(executor: str) -> tuple[bool, str | None]:
    """Return whether chains run on a Ray cluster, and its address: None where Ray shall find one, or start one.

    Raises:
        BadInput: neither threads nor Ray.
    """
    if executor == THREADS:
        return False, None
    if executor == RAY:
        return True, None
    if executor.startswith("ray://") and executor != "ray://":
        return True, executor
    raise BadInput(f"--executor must be threads, ray or ray://HOST:PORT, got {executor!r}")


def executor_of(executor: str) -> Executor | None:
    """Return the executor that a setting names; None for the threads of this process."""
    on_ray, address = ray_address(executor)
    if not on_ray:
        return None
    from bayesmap.run.ray_executor import RayExecutor

    return RayExecutor(address)


def reading_of(settings: ReadingSettings) -> dict[str, Any]:
    """Return the arguments of `bayesmap.read_log`."""
    names = ("no_return", "skip_bad_lines", "scan_topic", "pose_topic", "fixed_frame", "deskew")
    return {
        **{name: getattr(settings, name) for name in names},
        "thin_m": settings.thin_scans,
        "laser": None if settings.laser is None else pose_of(settings.laser, "--laser"),
    }
