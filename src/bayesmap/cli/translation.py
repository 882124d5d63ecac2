"""Translate the texts and settings of a user into values of the library.

Three groups: texts (points, poses, sensor models such as ``mixture:0.02``, odometry such as ``typical,lag_s=0.1``);
settings (prior, sensor, method, schedule, executor, options for reading a log); and logs (files that must exist,
folders and patterns of logs, held-out scans).
"""

from __future__ import annotations

import glob
import math
import os
from collections.abc import Iterable, Sequence
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import click
import msgspec

from bayesmap.cli.keys import InferSettings, LogSettings, SamplingSettings
from bayesmap.errors import BadInput
from bayesmap.files import saved_run_hint

if TYPE_CHECKING:
    from bayesmap.arguments import Schedule
    from bayesmap.cells.kind import CellPrior
    from bayesmap.result import Run
    from bayesmap.run.runner import Executor
    from bayesmap.samplers.methods import Method
    from bayesmap.sensors.model import SensorModel
    from bayesmap.sim.robot import OdometryNoise
    from bayesmap.space.scans import Scans


def numbers_of(text: str, flag: str, form: str, counts: tuple[int, ...]) -> list[float]:
    """Return an option's numbers, named by ``form``, such as "X,Y". Raises `click.BadParameter` for others."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in counts or not all(map(math.isfinite, numbers)):
        raise click.BadParameter(f"{text!r} is not {form}", param_hint=f"'{flag}'")
    return numbers


def pose_of(text: str, flag: str = "--pose") -> tuple[float, float, float]:
    """Return a pose in metres and radians, from a text in metres and degrees. Raises `click.BadParameter`."""
    x, y, degrees = numbers_of(text, flag, "X,Y,DEGREES", (3,))
    return x, y, math.radians(degrees)


SENSOR_HELP = """MODEL is default, or a kind with parameters: gaussian:0.2 (sigma in metres),
gaussian:0.02,sigma_per_m=0.005, student-t:0.05,dof=4 or
mixture:0.05,p_random=0.05,p_no_return=0.02,p_short=0.1,rate_short_per_m=0.5 (the beam model, Gaussian noise inside;
with noise=student-t heavier tails)."""

_FIRST = {"gaussian": "sigma_m", "student-t": "scale_m"}


def sensor_of(text: str) -> SensorModel | None:
    """Return the sensor model of a text, None for ``default``. Raises `BadInput` for an invalid one."""
    if text == "default":
        return None
    from bayesmap.sensors.model import KINDS, from_description

    # Split the text into the kind of the model and its parameters.
    kind, _, rest = text.partition(":")
    if kind not in KINDS:
        raise BadInput(f"sensor {text!r}: unknown kind {kind!r}; known: default, fit (of infer), {', '.join(KINDS)}")
    values = _parameters(text, rest)
    # The kind of noise decides the name of the number that has none.
    noise_kind = str(values.pop("noise", "gaussian")) if kind == "mixture" else kind
    if noise_kind not in _FIRST:
        raise BadInput(f"sensor {text!r}: noise must be {' or '.join(_FIRST)}, got {noise_kind!r}")
    if "" in values:
        values.setdefault(_FIRST[noise_kind], values.pop(""))
    if kind == "mixture":
        # The mixture keeps its own parameters; all others describe its noise.
        own = {"p_random", "p_no_return", "p_short", "rate_short_per_m"}
        noise = {name: values.pop(name) for name in list(values) if name not in own}
        if noise or noise_kind != "gaussian":
            values["noise"] = {"kind": noise_kind, **noise}
    try:
        return from_description({"kind": kind, **values})
    except TypeError:
        first = _FIRST[noise_kind]
        raise BadInput(f"sensor {text!r}: {noise_kind} needs its {first}, as in {kind}:0.05") from None


def _parameters(text: str, rest: str) -> dict[str, Any]:
    """Return the parameters by name; the first may have no name, and is stored under ""."""
    values: dict[str, Any] = {}
    for position, part in enumerate(rest.split(",") if rest else []):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals:
            name, value = "", name
            if position:
                raise BadInput(f"sensor {text!r}: write {value!r} as name=value; only the first goes without a name")
        values[name] = value if name == "noise" else _number(value, f"sensor {text!r}")
    return values


ODOMETRY_HELP = """ODOMETRY is true (poses as they were), typical (a Pioneer's in an office), perfect (no error), or one
of the last two followed by numbers that differ: typical,drift_rad_per_m=0.02,lag_s=0.08 or perfect,turn_scale=0.03.
Numbers: distance_per_m, distance_per_rad, turn_per_m, turn_per_rad (standard deviations after one metre or radian),
distance_scale, turn_scale, drift_rad_per_m (bias), slips_per_m, slip_m, slip_rad, lag_s."""

TRUE_ODOMETRY = "true"


def odometry_of(text: str) -> OdometryNoise | None:
    """Return the odometry of a text, None for ``true``. Raises `BadInput` for an invalid one."""
    if text == TRUE_ODOMETRY:
        return None
    from bayesmap.sim.robot import OdometryNoise

    known = [field.name for field in fields(OdometryNoise)]
    first, *rest = (part.strip() for part in text.split(","))
    if first not in ("typical", "perfect"):
        raise BadInput(f"odometry {text!r}: begin with {TRUE_ODOMETRY}, typical or perfect, got {first!r}")
    values = dict.fromkeys(known, 0.0) if first == "perfect" else {}
    for part in rest:
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or name not in known:
            raise BadInput(f"odometry {text!r}: {part!r} is not name=value with one of {', '.join(known)}")
        values[name] = _number(value, f"odometry {text!r}")
    return OdometryNoise(**values)


def _number(text: str, where: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise BadInput(f"{where}: {text!r} is not a number") from None


S = TypeVar("S", bound=SamplingSettings)

BINARY_DRAWS = 100  # default number of draws per chain over binary walls


def completed(settings: S) -> S:
    """Fill in the hit depth. Raises `BadInput` for settings that the cells do not have, or a bad sensor."""
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
    """Fill in ``thin``, ``draws`` and ``precision`` for the kind of cells and the numbers of beams and cells."""
    from bayesmap.cells.kinds import BUILT_IN

    kind = BUILT_IN[settings.cells]

    def default_draws(thin: int) -> int:
        return BINARY_DRAWS if kind.has_walls else kind().default_draws(beams, cells, settings.chains, thin)

    complete = schedule_of(settings).completed(kind.sweeps_a_draw, default_draws)
    return msgspec.structs.replace(settings, thin=complete.thin, draws=complete.draws, precision=complete.precision)


def schedule_of(settings: SamplingSettings) -> Schedule:
    """Return the schedule of the chains."""
    from bayesmap.arguments import Schedule

    return Schedule(
        settings.chains, settings.warmup, settings.draws, settings.thin, settings.precision, settings.seconds
    )


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
    """Return the chosen sensor. By default it is fitted, or for binary walls a good laser."""
    from bayesmap.cells.kinds import BUILT_IN, default_sensor

    if settings.sensor == "fit":
        return "fit"
    sensor = sensor_of(settings.sensor)
    if sensor is not None:
        return sensor
    return "fit" if BUILT_IN[settings.cells].sensor_is_fitted else default_sensor(resolution_m)


def ray_address(executor: str) -> tuple[bool, str | None]:
    """Return whether chains run on Ray, and its address; None lets Ray find a cluster. Raises `BadInput`."""
    if executor == "threads":
        return False, None
    if executor == "ray":
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


def log_options_of(settings: LogSettings) -> dict[str, Any]:
    """Return the arguments of `bayesmap.read_log`."""
    names = ("no_return", "skip_bad_lines", "scan_topic", "pose_topic", "fixed_frame", "deskew")
    trajectory = None
    if settings.trajectory is not None:
        from bayesmap.io.text.trajectories import read_trajectory

        trajectory = read_trajectory(settings.trajectory, settings.trajectory_frame)
    elif settings.trajectory_frame is not None:
        raise click.UsageError("--trajectory-frame is the frame of --trajectory: give both")
    laser = None if settings.laser is None else pose_of(settings.laser, "--laser")
    options = {name: getattr(settings, name) for name in names}
    return {**options, "trajectory": trajectory, "thin_m": settings.thin_scans, "laser": laser}


RECORDED = (".db3", ".mcap", ".zstd")  # file endings of a ROS 2 bag
MAPS = (".yaml", ".yml")  # file endings of map_server maps
LOG = "a log or a recording of range scans"


def need_file(file: str, expected: str, *, runs: bool, pipes: bool = False) -> None:
    """Raise `BadInput` for a path that does not exist, a run's folder or a pipe, before slow modules are imported. The
    message asks for ``expected`` instead. ``runs`` and ``pipes`` tell whether a saved run and a pipe are accepted.
    """
    if not pipes and (file in ("-", "/dev/stdin") or Path(file).is_fifo()):
        raise BadInput(f"{file}: a pipe, and this needs a file that can be read again; localize --follow reads pipes")
    if not Path(file).exists():
        raise BadInput(f"{file}: no such file; give {expected}")
    if runs and (inside := saved_run_hint(file)):
        raise BadInput(f"{file}: {inside}")
    if (Path(file) / "run.nc").is_file():
        raise BadInput(f"{file}: a run's folder; give {expected}")


def logs_of(typed: Sequence[str]) -> tuple[list[str], bool]:
    """Return the logs that a user names, and whether they are several: many names, a folder, or a pattern.

    A folder stands for the logs in it, chosen by their endings, and for the folders of ROS 2 bags in it. Raises
    `BadInput` for a pattern or a folder without logs.
    """
    logs: list[str] = []
    several = len(typed) > 1
    for name in typed:
        path = Path(name)
        # A pattern, a folder of logs, or one log (a file, or the folder of a bag).
        if not path.exists() and any(sign in name for sign in "*?["):
            several = True
            matches = sorted(glob.glob(name))
            if not matches:
                raise BadInput(f"{name}: no file matches; give {LOG}")
            logs += matches
        elif path.is_dir() and not _is_recording(path) and not (path / "run.nc").is_file():
            several = True
            inside = [entry for entry in sorted(path.iterdir()) if _is_log(entry)]
            if not inside:
                raise BadInput(f"{name}: a folder without logs, by the endings of the names; give {LOG}")
            logs += map(str, inside)
        else:
            logs.append(name)
    return logs, several


def _is_log(path: Path) -> bool:
    from bayesmap.io.logs import ENDINGS

    if path.is_dir():
        return _is_recording(path)
    return path.name.endswith((*ENDINGS, *RECORDED)) and not path.name.startswith(".")


def _is_recording(folder: Path) -> bool:
    """Return whether a folder is one ROS 2 bag, and not a folder of logs."""
    recorded = sum(entry.name.endswith(RECORDED) for entry in folder.iterdir())
    return (folder / "metadata.yaml").exists() or recorded == 1


def heldout_scans(run: Run, log: str, settings: LogSettings, every: int) -> Scans:
    """Return the scans of a log that a run has not seen, read with the run's largest range.

    If ``every`` is 0, the log is another of the same place; else the run's own, which held out each ``every``-th.

    Raises `BadInput` if the log cannot be read, or the run was made from some of these scans.
    """
    need_file(log, "the log that the run was made from", runs=False)
    from bayesmap.io.logs import read_log
    from bayesmap.posterior.heldout import moved_by, unseen_scans

    train, options = run.posterior.scans, log_options_of(settings)
    laser = options.pop("laser")
    first_laser = laser if settings.trajectory is not None else None
    scans = read_log(log, max_range_m=train.max_range_m, laser=first_laser, **options)
    if laser is not None and moved_by(train, scans):
        scans = read_log(log, max_range_m=train.max_range_m, laser=laser, **options)  # as infer --laser read them
    return unseen_scans(train, scans, every, log)


def need_free(paths: Iterable[Path], force: bool, option: str = "-o") -> None:
    """Raise `BadInput` for an older file without ``force``: the rule of all commands, before slow work."""
    older = next((path for path in paths if os.path.lexists(path)), None)
    if older is not None and not force:
        raise BadInput(f"{older}: exists already; --force replaces it, {option} takes another name")


def is_map(path: str) -> bool:
    """Return whether a path has the ending of a map_server map."""
    return Path(path).suffix.lower() in MAPS
