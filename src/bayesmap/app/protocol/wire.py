"""Messages as bytes on the wire, read and written.

`parse_action` reads a message of a page. msgspec checks its values, and `_explain` puts msgspec's errors into the
words of the page. `encode_frame` writes a message of the library, with its arrays, as text or as one binary frame.
"""

import json
import re
import struct
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar, get_args

import msgspec
import numpy as np
from msgspec import ValidationError, inspect
from numpy.typing import NDArray

from bayesmap.app.protocol.actions import AnyAction
from bayesmap.app.protocol.document import Document, Refused, Source, check_document, encode_json, to_plain_number
from bayesmap.app.protocol.tasks import Buffers

MAX_BYTES = 1 << 20  # length of a page's message
ALIGNMENT = 8  # arrays in a frame begin at multiples of this many bytes, counted from the end of the header
ACTIONS: Mapping[str, type] = {str(kind.__struct_config__.tag): kind for kind in get_args(AnyAction)}
T = TypeVar("T")


def parse_action(data: str | bytes) -> AnyAction:
    """Read a message from the page; unknown fields are left out. Raises `Refused` if the message is invalid."""
    if len(data) > MAX_BYTES or (isinstance(data, str) and len(data.encode("utf-8", "replace")) > MAX_BYTES):
        raise Refused(f"a message of more than {MAX_BYTES:,} bytes", "send it in parts")
    try:
        return _ACTION.decode(data)
    except ValidationError:
        return check_action(_decoded(data))
    except (msgspec.DecodeError, UnicodeEncodeError, RecursionError):
        raise Refused("a message that is not JSON", "send one as in docs/app.md") from None


def check_action(value: object) -> AnyAction:
    """Read a message that has been decoded to JSON values. Raises `Refused` as `parse_action` does."""
    if not isinstance(value, dict):
        raise Refused("a message that is not an object", "send one as in docs/app.md")
    kind = value.get("type")
    if not isinstance(kind, str) or kind not in ACTIONS:
        raise Refused(f"a message of unknown type {str(kind)[:40]!r}", f"there are: {', '.join(ACTIONS)}")
    action: AnyAction = convert(value, ACTIONS[kind], kind)
    return action


def read_seq(data: str | bytes | Mapping[str, Any]) -> int | None:
    """Return the number ``seq`` of an invalid message; None if no valid number can be read."""
    value = data if isinstance(data, Mapping) else _decoded(data[:MAX_BYTES])
    seq = value.get("seq") if isinstance(value, Mapping) else None
    return seq if isinstance(seq, int) and not isinstance(seq, bool) and seq >= 0 else None


def parse_document(value: object) -> Document:
    """Read a document.
    A document that shows a file has only the file's name, its grid and the settings that can be changed; how it is used
    is decided by `bayesmap.app.edits.adopt_document`. Raises `Refused`, with the place of the value, if one is invalid.
    """
    if not isinstance(value, Mapping):
        raise Refused("document: not an object", "send one as in docs/app.md")
    source = convert(value.get("source", {}), Source, "source")
    fields = {name: field for name, field in value.items() if name not in source.fixed_settings}
    if source.kind != "simulation":
        fields |= {"walls": "", "sensors": []}
    document = convert(fields, Document)
    # Rebuild sensors and source: as decoded, they would be written without their default values.
    document = replace(document, sensors=tuple(map(replace, document.sensors)), source=replace(document.source))
    check_document(document)
    return document if document.simulated else document.without_walls()


def parse_simulation(value: object) -> Document:
    """Read the document of a simulation. Raises `Refused` as `parse_document` does, or if the document shows a file."""
    document = parse_document(value)
    if not document.simulated:
        raise Refused(f"document: shows the file {document.source.name}", "start bayesmap app with that file")
    return document


def convert(value: object, kind: type[T], place: str = "") -> T:
    """Convert JSON values to a type of the protocol. `Refused` names an invalid value's place, under ``place``."""
    try:
        return msgspec.convert(value, kind)
    except (ValidationError, RecursionError) as error:
        raise _explain(str(error), value, inspect.type_info(kind), place) from None


def _explain(text: str, value: Any, kind: inspect.Type, place: str) -> Refused:
    """Explain msgspec's error about a value in the words of the page: "noise (m): 7 is not a number from 0 to 5"."""
    # A message of msgspec is a fault, then a path such as "$.sensors[2].yaw" to the invalid part of the value.
    fault, _, path = text.partition(" - at `$")
    if not re.match("Expected|Invalid|Object|Number|Integer", fault):
        return Refused(fault)  # raised by a type's own check
    missing = re.fullmatch(r"Object missing required field `(\w+)`", fault)
    unknown = re.fullmatch(r"Object contains unknown field `(\w+)`", fault)
    keys: list[str | int] = [int(index) if index else name for name, index in _KEY.findall(path)]
    if missing:
        keys.append(missing[1])
    # Follow the path from field to field, to the type and value at its end.
    for key in keys:
        field = next((field for field in _fields(kind) if field.encode_name == key), None)
        kind, title = (_item_type(kind, key), "") if field is None else (field.type, _title(field.type))
        place = f"{place}[{key}]" if isinstance(key, int) else title or ".".join(filter(None, (place, key)))
        value = None if missing and key == missing[1] else value[key]
    if missing:
        return Refused(f"{place}: missing", f"give {_describe(kind)}")
    if unknown:
        names = ", ".join(field.encode_name for field in _fields(kind))
        return Refused(f"{place}: there is no {unknown[1]}", f"there are: {names}")
    shown = repr(value)
    return Refused(f"{place}: {shown if len(shown) <= 40 else shown[:37] + '...'} is not {_describe(kind)}")


def _fields(kind: inspect.Type) -> tuple[inspect.Field, ...]:
    """Return the fields of an object's type; none for other types."""
    return getattr(_without_null(kind), "fields", ())


def _item_type(kind: inspect.Type, key: str | int) -> inspect.Type:
    """Return the type of one item of a tuple or a list; the type itself if it has no items."""
    inner = _without_null(kind)
    return inner.item_types[int(key)] if isinstance(inner, inspect.TupleType) else getattr(inner, "item_type", inner)


def _without_null(kind: inspect.Type) -> inspect.Type:
    """Return a type without its title, and without null as another choice."""
    if isinstance(kind, inspect.Metadata):
        return _without_null(kind.type)
    if isinstance(kind, inspect.UnionType):
        return _without_null(next(choice for choice in kind.types if not isinstance(choice, inspect.NoneType)))
    return kind


def _title(kind: inspect.Type) -> str:
    """Return the name of a setting on the page, as its type declares it; empty if there is none."""
    if isinstance(kind, inspect.UnionType):
        return "".join(map(_title, kind.types))
    return str((kind.extra_json_schema or {}).get("title", "")) if isinstance(kind, inspect.Metadata) else ""


def _describe(kind: inspect.Type) -> str:
    """Describe the values of a type in words."""
    kind = _without_null(kind)
    if isinstance(kind, inspect.IntType | inspect.FloatType):
        maximum = kind.le if kind.lt is None else kind.lt - 1
        noun = "a whole number" if isinstance(kind, inspect.IntType) else "a number"
        if kind.ge is None or maximum is None:
            return noun
        return f"{noun} from {kind.ge:,.7g} " + ("on" if maximum >= 2**31 - 1 else f"to {maximum:,.7g}")
    if isinstance(kind, inspect.LiteralType):
        return ("one of " if len(kind.values) > 1 else "") + ", ".join(map(str, kind.values))
    if isinstance(kind, inspect.TupleType):
        return f"a list of {len(kind.item_types)}, each {_describe(kind.item_types[0])}"
    if isinstance(kind, inspect.CollectionType):
        from_length = f"{kind.min_length:,} to" if kind.min_length else "at most"
        return f"a list of {from_length} {kind.max_length:,}" if kind.max_length else "a list"
    names = {inspect.BoolType: "true or false", inspect.StrType: "a text", inspect.BytesType: "bytes in base64"}
    return names.get(type(kind), "an object")


_KEY = re.compile(r"\.(\w+)|\[(\d+)\]")  # one key of a path: a field's name, or an index
_ACTION: msgspec.json.Decoder[AnyAction] = msgspec.json.Decoder(AnyAction)


def _decoded(data: str | bytes) -> Any:
    """Return the JSON values; None if the data is not JSON."""
    try:
        return json.loads(data)
    except (ValueError, RecursionError):
        return None


def encode_frame(message: object, buffers: Buffers) -> str | bytes:
    """Return a message in the socket's format: JSON text, or a binary frame if it has buffers."""
    if not buffers:
        return encode_json(message).decode()
    # A frame is the header's length (uint32, little-endian), the header as JSON, and the arrays, padded with zeros.
    header, arrays = separate_arrays(message, buffers)
    header_json = msgspec.json.encode(header)
    chunks = [struct.pack("<I", len(header_json)), header_json]
    for array in arrays:
        data = array.tobytes()
        chunks += [data, b"\0" * (-len(data) % ALIGNMENT)]
    return b"".join(chunks)


def separate_arrays(message: object, buffers: Buffers) -> tuple[dict[str, Any], list[NDArray[Any]]]:
    """Return a message as JSON values, with the types and shapes of its buffers, and the buffers as plain arrays."""
    arrays = {name: _as_array(value) for name, value in buffers.items()}
    entries = [{"name": name, "dtype": str(a.dtype), "shape": list(a.shape)} for name, a in arrays.items()]
    return {**msgspec.to_builtins(message, enc_hook=to_plain_number), "buffers": entries}, list(arrays.values())


def decode_frame(data: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return the message and the buffers of a binary frame, as `encode_frame` writes it."""
    (length,) = struct.unpack_from("<I", data)
    header = json.loads(data[4 : 4 + length])
    offset = 4 + length
    buffers = {}
    for entry in header.pop("buffers"):
        count = int(np.prod(entry["shape"], dtype=np.int64))
        array = np.frombuffer(data, dtype=np.dtype(entry["dtype"]).newbyteorder("<"), count=count, offset=offset)
        buffers[entry["name"]] = array.reshape(entry["shape"])
        offset += array.nbytes + -array.nbytes % ALIGNMENT
    return header, buffers


def _as_array(value: NDArray[Any] | bytes) -> NDArray[Any]:
    if isinstance(value, bytes):
        return np.frombuffer(value, dtype=np.uint8)
    return np.ascontiguousarray(value, dtype=value.dtype.newbyteorder("<"))
