"""Sensor models as plain JSON values, and back: for saved runs and for the command line's options."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.model import SensorModel
from bayesmap.sensors.noise import AdditiveNoise, Gaussian, StudentT

KINDS: dict[str, type[Any]] = {"gaussian": Gaussian, "student-t": StudentT, "mixture": BeamMixture}


def describe(sensor: SensorModel) -> dict[str, Any]:
    """The model's kind and parameters. A model that is not one of ours is described by its name alone."""
    for kind, cls in KINDS.items():
        if type(sensor) is cls:
            values: dict[str, Any] = {f.name: _plain(getattr(sensor, f.name)) for f in fields(cls)}  # type: ignore[arg-type]
            if isinstance(sensor, BeamMixture):
                values["noise"] = describe(sensor.noise)
            return {"kind": kind, **values}
    return {"kind": type(sensor).__name__}


def _plain(value: Any) -> Any:
    """NumPy's numbers as Python's, which JSON can hold."""
    return value.item() if isinstance(value, np.generic) else value


def from_description(description: dict[str, Any]) -> SensorModel | None:
    """The model of a description; None for one that is not ours.

    Raises:
        BadInput: a parameter that the model does not have, or a value that it refuses.
    """
    values = dict(description)
    kind = values.pop("kind", None)
    cls = KINDS.get(str(kind))
    if cls is None:
        return None
    known = [f.name for f in fields(cls)]
    unknown = sorted(set(values) - set(known))
    if unknown:
        raise BadInput(f"sensor: {kind!r} has no parameter {unknown[0]!r}; it has: {', '.join(known)}")
    if cls is BeamMixture and "noise" in values:
        noise = from_description(values["noise"])
        if not isinstance(noise, AdditiveNoise):
            raise BadInput(f"sensor: a mixture's noise is 'gaussian' or 'student-t', got {values['noise']!r}")
        values["noise"] = noise
    model: SensorModel = cls(**values)
    return model
