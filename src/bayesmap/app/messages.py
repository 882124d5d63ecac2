"""What comes from the page, checked, and how messages look on the wire (docs/app.md)."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.document import LARGEST_COORDINATE_M, Refused
from bayesmap.app.parsing import number, parse_document, parse_setting, parse_shape
from bayesmap.app.worlds import WORLDS

MAX_BYTES = 1 << 20
MAX_CELLS = 250_000
LARGEST_ID = 2**53
ALIGNMENT = 8
Buffers = Mapping[str, NDArray[Any] | bytes]


def parse(data: str | bytes) -> dict[str, Any]:
    """A message of the page, with its fields checked and unknown ones left out.

    Raises:
        Refused: too long, not JSON, of no known type, or with a field that does not fit.
    """
    if len(data) > MAX_BYTES or (isinstance(data, str) and len(data.encode("utf-8", "replace")) > MAX_BYTES):
        raise Refused(f"a message of more than {MAX_BYTES:,} bytes", "send it in parts")
    try:
        value = json.loads(data, parse_constant=_no_constant)
    except (ValueError, RecursionError):
        raise Refused("a message that is not JSON") from None
    return check(value)


def check(value: object) -> dict[str, Any]:
    """The same for a message that is JSON already.

    Raises:
        Refused: see `parse`.
    """
    if not isinstance(value, dict):
        raise Refused("a message that is not an object")
    kind = value.get("type")
    if not isinstance(kind, str) or kind not in FIELDS:
        raise Refused(f"a message of unknown type {str(kind)[:40]!r}", f"there are: {', '.join(FIELDS)}")
    message: dict[str, Any] = {"type": kind, "seq": _whole("seq", value.get("seq", 0))}
    message.update(FIELDS[kind](value))
    return message


def seq_of(data: str | bytes | dict[str, Any]) -> int | None:
    """The number of a message that was refused, if it has one."""
    try:
        value = data if isinstance(data, dict) else json.loads(data[:MAX_BYTES])
        return _whole("seq", value["seq"])
    except (ValueError, RecursionError, LookupError, TypeError):
        return None


def frame(header: Mapping[str, Any], buffers: Buffers) -> str | bytes:
    """A message as it goes over the socket: text, or binary where it has buffers."""
    if not buffers:
        return json.dumps(header, allow_nan=False, separators=(",", ":"))
    arrays = {name: as_array(value) for name, value in buffers.items()}
    listed = [{"name": k, "dtype": str(a.dtype), "shape": list(a.shape)} for k, a in arrays.items()]
    text = json.dumps({**header, "buffers": listed}, allow_nan=False, separators=(",", ":")).encode()
    parts = [struct.pack("<I", len(text)), text]
    for array in arrays.values():
        raw = array.tobytes()
        parts += [raw, b"\0" * (-len(raw) % ALIGNMENT)]
    return b"".join(parts)


def unframe(data: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """What `frame` made of a message with buffers."""
    (length,) = struct.unpack_from("<I", data)
    header = json.loads(data[4 : 4 + length])
    at = 4 + length
    buffers = {}
    for entry in header.pop("buffers"):
        count = int(np.prod(entry["shape"], dtype=np.int64))
        array = np.frombuffer(data, dtype=np.dtype(entry["dtype"]).newbyteorder("<"), count=count, offset=at)
        buffers[entry["name"]] = array.reshape(entry["shape"])
        at += array.nbytes + -array.nbytes % ALIGNMENT
    return header, buffers


def as_array(value: NDArray[Any] | bytes) -> NDArray[Any]:
    """A buffer as an array, little-endian and contiguous."""
    if isinstance(value, bytes):
        return np.frombuffer(value, dtype=np.uint8)
    return np.ascontiguousarray(value, dtype=value.dtype.newbyteorder("<"))


def _no_constant(name: str) -> float:
    raise ValueError(f"{name} is not JSON")


def _whole(name: str, value: object, least: int = 0, most: int = LARGEST_ID) -> int:
    return int(number(name, value, least, most, whole=True))


def _optional(value: Mapping[str, Any], name: str, found: Callable[[object], Any]) -> dict[str, Any]:
    return {} if value.get(name) is None else {name: found(value[name])}


def _flag(name: str, value: object) -> bool:
    if not isinstance(value, bool):
        raise Refused(f"{name}: neither true nor false")
    return value


def _one_of(name: str, value: object, allowed: tuple[str, ...]) -> str:
    if not isinstance(value, str) or value not in allowed:
        raise Refused(f"{name}: {str(value)[:40]!r} is not known", f"there are: {', '.join(allowed)}")
    return value


def _metres(name: str, value: object) -> float:
    return number(name, value, -LARGEST_COORDINATE_M, LARGEST_COORDINATE_M)


def _hello(value: Mapping[str, Any]) -> dict[str, Any]:
    return _optional(value, "document", parse_document)


def _set(value: Mapping[str, Any]) -> dict[str, Any]:
    patch = value.get("patch")
    if not isinstance(patch, dict) or not patch:
        raise Refused("set: no patch", 'send {"patch": {"prior": 0.5}}')
    return {
        "patch": {name: parse_setting(name, v) for name, v in patch.items()},
        **_optional(value, "drag", lambda v: _whole("drag", v)),
        **_optional(value, "coarse", lambda v: _flag("coarse", v)),
    }


def _walls(value: Mapping[str, Any]) -> dict[str, Any]:
    given = value.get("cells")
    if not isinstance(given, list) or not 1 <= len(given) <= MAX_CELLS:
        raise Refused(f"walls: cells is not a list of 1 to {MAX_CELLS:,} pairs")
    good = all(isinstance(c, list) and len(c) == 2 and type(c[0]) is int and type(c[1]) is int for c in given)
    if not good or not all(0 <= v < 2**31 for c in given for v in c):
        raise Refused("walls: a cell is not a pair of whole numbers from 0 on")
    wall = _flag("wall", value.get("wall"))
    return {"cells": np.array(given, dtype=np.int64), "wall": wall, "stroke": _whole("stroke", value.get("stroke", 0))}


def _sensor(value: Mapping[str, Any]) -> dict[str, Any]:
    op = _one_of("op", value.get("op"), ("add", "move", "remove"))
    found: dict[str, Any] = {"op": op, **_optional(value, "drag", lambda v: _whole("drag", v))}
    if op != "add":
        found["id"] = _whole("id", value.get("id"), 1)
    if op == "add" or (op == "move" and not {"x", "y"}.isdisjoint(value)):
        found |= {name: _metres(name, value.get(name)) for name in ("x", "y")}
    if op != "remove":
        found |= _optional(value, "yaw", lambda v: number("yaw", v, -1e3, 1e3))
    return found


def _view(value: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "layer": _one_of("layer", value.get("layer"), ("mean", "draw", "entropy", "width")),
        **_optional(value, "chain", lambda v: _whole("chain", v)),
        **_optional(value, "draw", lambda v: _whole("draw", v)),
    }


def _point(name: str, value: object) -> list[float]:
    if not isinstance(value, list) or len(value) != 2:
        raise Refused(f"{name}: not a pair of metres", "send [x, y]")
    return [_metres(name, v) for v in value]


def _path(value: Mapping[str, Any]) -> dict[str, Any]:
    return {
        **{name: _point(name, value.get(name)) for name in ("start", "goal")},
        "radius": number("radius", value.get("radius"), 1e-3, 100.0),
        "risk": number("risk", value.get("risk"), 1e-6, 1.0 - 1e-6),
    }


FIELDS: dict[str, Callable[[Mapping[str, Any]], dict[str, Any]]] = {
    "hello": _hello,
    "set": _set,
    "walls": _walls,
    "sensor": _sensor,
    "clear": lambda value: {"what": _one_of("what", value.get("what"), ("walls", "inference"))},
    "new": lambda value: {
        "shape": parse_shape(value.get("shape")),
        "world": _one_of("world", value.get("world"), WORLDS),
    },
    "undo": lambda value: {},
    "redo": lambda value: {},
    "run": lambda value: {},
    "cancel": lambda value: {},
    "live": lambda value: {"on": _flag("on", value.get("on"))},
    "view": _view,
    "painted": lambda value: {"generation": _whole("generation", value.get("generation"))},
    "scan": lambda value: {"index": _whole("index", value.get("index"))},
    "inspect": lambda value: {
        **{name: _whole(name, value.get(name), 0, 2**31 - 1) for name in ("x", "y")},
        **_optional(value, "each", lambda v: _flag("each", v)),
    },
    "path": _path,
    "views": lambda value: {},
    "ghost": lambda value: {
        **{name: _metres(name, value.get(name)) for name in ("x", "y")},
        "yaw": number("yaw", value.get("yaw"), -1e3, 1e3),
        **_optional(value, "coarse", lambda v: _flag("coarse", v)),
    },
    "beam": lambda value: {name: _whole(name, value.get(name), 0, 2**31 - 1) for name in ("scan", "beam")},
    "where": lambda value: _optional(value, "sensor", lambda v: _whole("sensor", v, 1)),
    "export": lambda value: {"what": _one_of("what", value.get("what"), ("run", "map", "html", "document"))},
}
"""What a message of each type holds, checked."""
