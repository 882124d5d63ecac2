"""Sensor models as a user types them: ``kind:first,name=value,...``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.sensors.model import SensorModel

HELP = """MODEL is default, or a kind with parameters: gaussian:0.2 (sigma in metres), gaussian:0.02,sigma_per_m=0.005,
student-t:0.05,dof=4 or mixture:0.05,p_random=0.05,p_no_return=0.02,p_short=0.1,rate_short_per_m=0.5 (the beam model,
Gaussian noise inside; with noise=student-t heavier tails)."""

_FIRST = {"gaussian": "sigma_m", "student-t": "scale_m"}


def sensor_of(text: str) -> SensorModel | None:
    """The model that a text describes; None for ``default``.

    Raises:
        BadInput: an unknown kind or parameter, something that is not a number, or a value that the model refuses.
    """
    if text == "default":
        return None
    from bayesmap.sensors.describe import KINDS, from_description

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
    """Numbers by name; the first may go without one."""
    values: dict[str, Any] = {}
    for position, part in enumerate(rest.split(",") if rest else []):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals:
            name, value = "", name
            if position:
                raise BadInput(f"sensor {text!r}: write {value!r} as name=value; only the first goes without a name")
        if name == "noise":
            values[name] = value
            continue
        try:
            values[name] = float(value)
        except ValueError:
            raise BadInput(f"sensor {text!r}: {value!r} is not a number") from None
    return values
