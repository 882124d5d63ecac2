"""Translate the texts and settings of a user into values of the library.

Three groups, in this order: texts (points, poses, sensor models such as ``mixture:0.02``, odometry such as
``typical,lag_s=0.1``); settings (prior, sensor, method, schedule, executor, options for reading a log); and logs (files
that must exist, folders and patterns of logs, held-out scans). A function ``x_of`` returns the value x.
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

from bayesmap.cli.keys import InferSettings, LogSettings, SamplingSettings, SlamSettings
from bayesmap.errors import BadInput
from bayesmap.files import PICTURE_MARK, saved_run_hint

if TYPE_CHECKING:
    from bayesmap.arguments import Schedule
    from bayesmap.cells.kind import CellPrior
    from bayesmap.localization.localize import InitialPose
    from bayesmap.result import Run
    from bayesmap.run.runner import Executor
    from bayesmap.samplers.methods import Method
    from bayesmap.sensors.model import SensorModel
    from bayesmap.sim.robot import OdometryNoise
    from bayesmap.space.scans import Scans


def numbers_of(text: str, flag: str, form: str, counts: tuple[int, ...]) -> list[float]:
    """Return the numbers of an option, as many as ``counts`` allows, or refuse it and name the form, such as "X,Y"."""
    try:
        numbers = [float(number) for number in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in counts or not all(map(math.isfinite, numbers)):
        raise click.BadParameter(f"{text!r} is not {form}", param_hint=f"'{flag}'")
    return numbers


def pose_of(text: str, flag: str = "--pose") -> tuple[float, float, float]:
    """Return a pose in metres and radians, from a text in metres and degrees. Raises `click.BadParameter`."""
    x, y, degrees = numbers_of(text, flag, "X,Y,DEGREES", (3,))
    return x, y, math.radians(degrees)


def initial_pose_of(text: str | None) -> InitialPose | None:
    """Return the prior of the first pose that --prior describes."""
    from bayesmap.localization.localize import InitialPose

    if text is None:
        return None
    x, y, degrees, *spread = numbers_of(text, "--prior", "X,Y,DEGREES or X,Y,DEGREES,M,DEGREES", (3, 5))
    pose = (x, y, math.radians(degrees))
    return InitialPose(pose, spread[0], math.radians(spread[1])) if spread else InitialPose(pose)


def corners_of(text: str | None) -> list[float] | None:
    """Return the corners of the rectangle that --area describes, in metres."""
    if text is None:
        return None
    x0, x1, y0, y1 = corners = numbers_of(text, "--area", "X0,X1,Y0,Y1", (4,))
    if not (x0 < x1 and y0 < y1):
        raise BadInput(f"--area {text}: give X0 below X1, and Y0 below Y1")
    return corners


def slice_of(text: str | None, count: int | None = None) -> slice:
    """Return FIRST:LAST as a slice of ``count`` scans. ``count`` is None for a live log, whose end is not known."""
    which = " of scans to come" if count is None else ""
    refusal = click.BadParameter(f"{text!r} is not FIRST:LAST{which}", param_hint="'--scans'")
    first, colon, last = (text or ":").partition(":")
    try:
        span = slice(int(first) if first else None, int(last) if last else None)
    except ValueError:
        raise refusal from None
    start = span.start or 0
    is_empty_or_negative = start < 0 or (span.stop is not None and span.stop <= start)
    if not colon or (count is None and is_empty_or_negative):  # scans to come cannot be counted from the end
        raise refusal
    if text is not None and count is not None and not range(count)[span]:
        raise BadInput(f"--scans {text}: none of the log's {count:,} scans is among them")
    return span


SENSOR_HELP = """MODEL is default, or a kind with parameters: gaussian:0.2 (sigma in metres),
gaussian:0.02,sigma_per_m=0.005, student-t:0.05,dof=4 or
mixture:0.05,p_random=0.05,p_no_return=0.02,p_short=0.1,rate_short_per_m=0.5 (the beam model, Gaussian noise inside;
with noise=student-t heavier tails)."""

_NAMELESS = {"gaussian": "sigma_m", "student-t": "scale_m"}  # the parameter that needs no name, by kind of noise
_MIXTURE_PARAMETERS = ("p_random", "p_no_return", "p_short", "rate_short_per_m")  # all others describe the noise


def sensor_of(text: str) -> SensorModel | None:
    """Return the sensor model of a text, None for ``default``. Raises `BadInput` for an invalid one."""
    if text == "default":
        return None
    from bayesmap.sensors.model import KINDS, from_description

    kind, _, parameter_text = text.partition(":")
    if kind not in KINDS:
        raise BadInput(f"sensor {text!r}: unknown kind {kind!r}; known: default, fit (of infer), {', '.join(KINDS)}")
    parameters = _parameters_of(parameter_text, f"sensor {text!r}")
    # The kind of noise decides the name of the number that has none.
    noise_kind = str(parameters.pop("noise", "gaussian")) if kind == "mixture" else kind
    if noise_kind not in _NAMELESS:
        raise BadInput(f"sensor {text!r}: noise must be {' or '.join(_NAMELESS)}, got {noise_kind!r}")
    if "" in parameters:
        parameters.setdefault(_NAMELESS[noise_kind], parameters.pop(""))
    if kind == "mixture":
        noise = {name: parameters.pop(name) for name in list(parameters) if name not in _MIXTURE_PARAMETERS}
        if noise or noise_kind != "gaussian":
            parameters["noise"] = {"kind": noise_kind, **noise}
    try:
        return from_description({"kind": kind, **parameters})
    except TypeError:
        missing = _NAMELESS[noise_kind]
        raise BadInput(f"sensor {text!r}: {noise_kind} needs its {missing}, as in {kind}:0.05") from None


def _parameters_of(parameter_text: str, context: str) -> dict[str, Any]:
    """Return the parameters of a sensor by name; the first may have no name, and is stored under ""."""
    parameters: dict[str, Any] = {}
    for position, assignment in enumerate(parameter_text.split(",") if parameter_text else []):
        name, equals, value = (word.strip() for word in assignment.partition("="))
        if not equals:
            name, value = "", name
            if position:
                raise BadInput(f"{context}: write {value!r} as name=value; only the first goes without a name")
        parameters[name] = value if name == "noise" else _number_of(value, context)
    return parameters


ODOMETRY_HELP = """ODOMETRY is true (poses as they were), typical (a Pioneer's in an office), perfect (no error), or one
of the last two followed by numbers that differ: typical,drift_rad_per_m=0.02,lag_s=0.08 or perfect,turn_scale=0.03.
Numbers: distance_per_m, distance_per_rad, turn_per_m, turn_per_rad (standard deviations after one metre or radian),
distance_scale, turn_scale, drift_rad_per_m (bias), slips_per_m, slip_m, slip_rad, lag_s."""


def odometry_of(text: str) -> OdometryNoise | None:
    """Return the odometry of a text, None for ``true``. Raises `BadInput` for an invalid one."""
    if text == "true":
        return None
    from bayesmap.sim.robot import OdometryNoise

    known = [field.name for field in fields(OdometryNoise)]
    base, *assignments = (word.strip() for word in text.split(","))
    if base not in ("typical", "perfect"):
        raise BadInput(f"odometry {text!r}: begin with true, typical or perfect, got {base!r}")
    values = dict.fromkeys(known, 0.0) if base == "perfect" else {}
    for assignment in assignments:
        name, equals, value = (word.strip() for word in assignment.partition("="))
        if not equals or name not in known:
            raise BadInput(f"odometry {text!r}: {assignment!r} is not name=value with one of {', '.join(known)}")
        values[name] = _number_of(value, f"odometry {text!r}")
    return OdometryNoise(**values)


def _number_of(text: str, context: str) -> float:
    """Return the number that a text stands for. The message of `BadInput` begins with ``context``."""
    try:
        return float(text)
    except ValueError:
        raise BadInput(f"{context}: {text!r} is not a number") from None


S = TypeVar("S", bound=SamplingSettings)

BINARY_DRAWS = 100  # default number of draws per chain over binary walls


def completed(settings: S) -> S:
    """Return the settings with a hit depth. Raises `BadInput` for settings of other cells, or an invalid sensor."""
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


def with_schedule(settings: InferSettings, n_beams: int, n_cells: int) -> InferSettings:
    """Return the settings with ``thin``, ``draws`` and ``precision`` for the cells and the size of the problem."""
    from bayesmap.cells.kinds import BUILT_IN

    kind = BUILT_IN[settings.cells]

    def default_draws(thin: int) -> int:
        return BINARY_DRAWS if kind.has_walls else kind().default_draws(n_beams, n_cells, settings.chains, thin)

    complete = schedule_of(settings).completed(kind.sweeps_a_draw, default_draws)
    return msgspec.structs.replace(settings, thin=complete.thin, draws=complete.draws, precision=complete.precision)


def schedule_of(settings: SamplingSettings) -> Schedule:
    """Return the schedule of the chains."""
    from bayesmap.arguments import Schedule

    return Schedule(
        settings.chains, settings.warmup, settings.draws, settings.thin, settings.precision, settings.seconds
    )


def fast_of(settings: SlamSettings) -> bool | None:
    """Return the argument ``fast`` of `bayesmap.slam`; None lets the number of key scans decide."""
    if settings.fast:
        return True
    return False if settings.sample_poses else None


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


BAG_ENDINGS = (".db3", ".mcap", ".zstd")  # endings of the files of a ROS 2 bag
MAP_ENDINGS = (".yaml", ".yml")  # endings of map_server maps
LOG = "a log or a recording of range scans"
NO_MOUNT = "nothing in it says where the laser sits on the robot, as in runs of older versions"


def need_file(file: str, expected: str, *, runs: bool, pipes: bool = False) -> None:
    """Raise `BadInput` for a path that does not exist, or for a run's folder, a run or a pipe that is not accepted."""
    if not pipes and (file in ("-", "/dev/stdin") or Path(file).is_fifo()):
        raise BadInput(f"{file}: a pipe, and this needs a file that can be read again; localize --follow reads pipes")
    if not Path(file).exists():
        raise BadInput(f"{file}: no such file; give {expected}")
    if runs and (inside := saved_run_hint(file)):
        raise BadInput(f"{file}: {inside}")
    if (Path(file) / "run.nc").is_file():
        raise BadInput(f"{file}: a run's folder; give {expected}")


def logs_of(names: Sequence[str]) -> tuple[list[str], bool]:
    """Return the logs that a user names, and whether they are several: many names, a folder, or a pattern.

    A folder stands for the logs in it, chosen by their endings, and for the folders of ROS 2 bags in it. Raises
    `BadInput` for a pattern or a folder without logs.
    """
    logs: list[str] = []
    are_several = len(names) > 1
    for name in names:
        path = Path(name)
        # A pattern, a folder of logs, or one log (a file, or the folder of a bag).
        if not path.exists() and any(sign in name for sign in "*?["):
            are_several = True
            matches = sorted(glob.glob(name))
            if not matches:
                raise BadInput(f"{name}: no file matches; give {LOG}")
            logs += matches
        elif path.is_dir() and not _is_recording(path) and not (path / "run.nc").is_file():
            are_several = True
            logs_inside = [entry for entry in sorted(path.iterdir()) if _is_log(entry)]
            if not logs_inside:
                raise BadInput(f"{name}: a folder without logs, by the endings of the names; give {LOG}")
            logs += map(str, logs_inside)
        else:
            logs.append(name)
    return logs, are_several


def _is_log(path: Path) -> bool:
    from bayesmap.io.logs import ENDINGS

    if path.is_dir():
        return _is_recording(path)
    return path.name.endswith((*ENDINGS, *BAG_ENDINGS)) and not path.name.startswith(".")


def _is_recording(folder: Path) -> bool:
    """Return whether a folder is one ROS 2 bag, and not a folder of logs."""
    n_bag_files = sum(entry.name.endswith(BAG_ENDINGS) for entry in folder.iterdir())
    return (folder / "metadata.yaml").exists() or n_bag_files == 1


def heldout_scans(run: Run, log: str, settings: LogSettings, every: int) -> Scans:
    """Return the scans of a log that a run has not seen: each ``every``-th, or all of another log if ``every`` is 0.
    Raises `BadInput` if the log cannot be read, or the run was made from some of these scans.
    """
    need_file(log, "the log that the run was made from", runs=False)
    from bayesmap.io.logs import read_log
    from bayesmap.posterior.heldout import has_moved_scans, unseen_scans

    train = run.posterior.scans
    options = log_options_of(settings)
    # A log's own poses are read without --laser first, since the run may have been made without it.
    laser = options.pop("laser")
    first_laser = laser if settings.trajectory is not None else None
    scans = read_log(log, max_range_m=train.max_range_m, laser=first_laser, **options)
    if laser is not None and has_moved_scans(train, scans):
        scans = read_log(log, max_range_m=train.max_range_m, laser=laser, **options)
    return unseen_scans(train, scans, every, log)


def need_free(paths: Iterable[Path], *, force: bool, option: str = "-o") -> None:
    """Raise `BadInput` for a path that exists, unless ``force``. ``option`` is the flag that takes another name."""
    for path in paths:
        if os.path.lexists(path) and not force:
            raise BadInput(f"{path}: exists already; --force replaces it, {option} takes another name")


def picture_path(run_file: str, output: str | None, default: str, *, force: bool) -> Path:
    """Return the path of a picture, ``default`` beside the run, where an older picture of bayesmap may be replaced."""
    target = Path(output) if output else Path(run_file).with_name(default)
    is_own = not output and target.is_file() and PICTURE_MARK.encode() in target.read_bytes()[:1000]
    need_free([target], force=force or is_own)
    return target


def is_map(path: str) -> bool:
    """Return whether a path has the ending of a map_server map."""
    return Path(path).suffix.lower() in MAP_ENDINGS
