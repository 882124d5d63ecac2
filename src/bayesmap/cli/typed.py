"""Values as a user types them: points, poses, sensor models (``mixture:0.02``), odometry (``typical,lag_s=0.1``)."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import click

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.sensors.model import SensorModel
    from bayesmap.sim.robot import OdometryNoise


def numbers_of(text: str, flag: str, form: str, counts: tuple[int, ...]) -> list[float]:
    """Return the numbers of an option's text.

    Args:
        text: as typed.
        flag: the option.
        form: what was to be typed, such as "X,Y".
        counts: how many numbers it may be.

    Raises:
        click.BadParameter: another count, or something that is not a finite number.
    """
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in counts or not all(map(math.isfinite, numbers)):
        raise click.BadParameter(f"{text!r} is not {form}", param_hint=f"'{flag}'")
    return numbers


def pose_of(text: str, flag: str = "--pose") -> tuple[float, float, float]:
    """Return a pose, which is typed in metres and degrees, in metres and radians.

    Raises:
        click.BadParameter: something else; the message names the flag.
    """
    x, y, degrees = numbers_of(text, flag, "X,Y,DEGREES", (3,))
    return x, y, math.radians(degrees)


SENSOR_HELP = """MODEL is default, or a kind with parameters: gaussian:0.2 (sigma in metres),
gaussian:0.02,sigma_per_m=0.005, student-t:0.05,dof=4 or
mixture:0.05,p_random=0.05,p_no_return=0.02,p_short=0.1,rate_short_per_m=0.5 (the beam model, Gaussian noise inside;
with noise=student-t heavier tails)."""

_FIRST = {"gaussian": "sigma_m", "student-t": "scale_m"}


def sensor_of(text: str) -> SensorModel | None:
    """Return the sensor model that a text describes; None for ``default``.

    Raises:
        BadInput: an unknown kind or parameter, something that is not a number, or a value that the model refuses.
    """
    if text == "default":
        return None
    from bayesmap.sensors.builtin import KINDS, from_description

    kind, _, rest = text.partition(":")
    if kind not in KINDS:
        raise BadInput(f"sensor {text!r}: unknown kind {kind!r}; known: default, fit (of infer), {', '.join(KINDS)}")
    values = _parameters(text, rest)
    noise_kind = str(values.pop("noise", "gaussian")) if kind == "mixture" else kind
    if noise_kind not in _FIRST:
        raise BadInput(f"sensor {text!r}: noise must be {' or '.join(_FIRST)}, got {noise_kind!r}")
    if "" in values:
        values.setdefault(_FIRST[noise_kind], values.pop(""))
    if kind == "mixture":
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
    """Return numbers by name; the first may go without one."""
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
    """Return the odometry that a text describes; None for ``true``.

    Raises:
        BadInput: an unknown word or name, or a number that makes no sense.
    """
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
