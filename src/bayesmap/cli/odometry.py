"""Odometry as a user types it: ``typical``, and what is different, ``name=value,...``."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.sim.odometry import OdometryNoise

HELP = """ODOMETRY is true (poses as they were), typical (a Pioneer's in an office), perfect (no error), or one of the
last two followed by numbers that differ: typical,drift_rad_per_m=0.02,lag_s=0.08 or perfect,turn_scale=0.03. Numbers:
distance_per_m, distance_per_rad, turn_per_m, turn_per_rad (standard deviations after one metre or radian),
distance_scale, turn_scale, drift_rad_per_m (bias), slips_per_m, slip_m, slip_rad, lag_s."""

TRUE = "true"


def odometry_of(text: str) -> OdometryNoise | None:
    """The odometry that a text describes; None for ``true``.

    Raises:
        BadInput: an unknown word or name, or a number that makes no sense.
    """
    if text == TRUE:
        return None
    from bayesmap.sim.odometry import OdometryNoise

    known = [field.name for field in fields(OdometryNoise)]
    first, *rest = (part.strip() for part in text.split(","))
    if first not in ("typical", "perfect"):
        raise BadInput(f"odometry {text!r}: begin with {TRUE}, typical or perfect, got {first!r}")
    values = dict.fromkeys(known, 0.0) if first == "perfect" else {}
    for part in rest:
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or name not in known:
            raise BadInput(f"odometry {text!r}: {part!r} is not name=value with one of {', '.join(known)}")
        try:
            values[name] = float(value)
        except ValueError:
            raise BadInput(f"odometry {text!r}: {value!r} is not a number") from None
    return OdometryNoise(**values)
