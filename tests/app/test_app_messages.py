"""Whatever is sent, the answer is a message or a refusal, never another exception; and frames hold what was put in."""

import json

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from bayesmap.app.protocol.document import Refused
from bayesmap.app.protocol.wire import ACTIONS, MAX_BYTES, check, frame, parse, seq_of, unframe

JSON = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=8), st.sampled_from([*ACTIONS])),
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(st.text(max_size=6), inner, max_size=4)),
    max_leaves=12,
)
NAMES = ("patch", "cells", "wall", "stroke", "op", "id", "x", "y", "yaw", "drag", "what", "shape", "world", "on",
         "layer", "chain", "draw", "index", "document", "seq")  # fmt: skip


def understood(data):
    try:
        return parse(data)
    except Refused:
        seq_of(data)
        return None


@given(st.binary(max_size=200))
@example(b"\xff\xfe")
@example(b"[" * 100_000)
@example(b'{"type": "run", "seq": ' + b"9" * 5000 + b"}")
def test_random_bytes_are_refused(data):
    understood(data)


@given(st.text(max_size=200))
@example('{"type": "set", "patch": {"prior": NaN}}')
@example('{"type": "set", "patch": {"prior": 1e999}}')
@example('{"type": "\\ud800"}')
def test_random_text_is_refused(text):
    understood(text)


@given(st.sampled_from([*ACTIONS]), st.dictionaries(st.sampled_from(NAMES), JSON, max_size=6))
def test_random_fields_are_refused_or_make_a_message(kind, fields):
    message = understood(json.dumps({"type": kind, **fields}))
    assert message is None or message.__struct_config__.tag == kind


GOOD = [
    {"type": "set", "patch": {"prior": 0.05, "method": "block"}, "drag": 3},
    {"type": "walls", "cells": [[1, 2], [3, 4]], "wall": True, "stroke": 1},
    {"type": "add_sensor", "x": 1, "y": 2.5, "yaw": 0},
    {"type": "move_sensor", "id": 1, "yaw": 1.5},
    {"type": "remove_sensor", "id": 2},
    {"type": "clear", "what": "inference"},
    {"type": "new", "shape": [500, 2], "world": "blank"},
    {"type": "view", "layer": "draw", "chain": None, "draw": 7},
    {"type": "hello"},
    {"type": "export", "what": "html"},
]


@pytest.mark.parametrize("message", GOOD, ids=lambda m: m["type"])
def test_good_messages_are_understood(message):
    assert check({**message, "seq": 5}).seq == 5


@pytest.mark.parametrize(
    ("message", "named"),
    [
        ([], "not an object"),
        ({"type": "shutdown"}, "unknown type"),
        ({"type": "set", "patch": {"colour": 1}}, "colour"),
        ({"type": "set", "patch": {"prior": "0.5"}}, "prior"),
        ({"type": "set"}, "set.patch: missing"),
        ({"type": "walls", "cells": [[1, 2.5]], "wall": True}, r"cells\[0\]\[1\]: 2.5 is not a whole number"),
        ({"type": "walls", "cells": [[3, 4], [-1, 2]], "wall": True}, r"cells\[1\]\[0\]: -1 is not"),
        ({"type": "walls", "cells": [[True, 2]], "wall": True}, r"cells\[0\]\[0\]: True"),
        ({"type": "walls", "cells": [[1, 2, 3]], "wall": True}, "a list of 2"),
        ({"type": "walls", "cells": [], "wall": True}, "cells"),
        ({"type": "walls", "cells": [[1, 2]], "wall": 1}, "wall"),
        ({"type": "move_sensor", "x": 1, "y": 1}, "id"),
        ({"type": "add_sensor", "x": 1}, "y"),
        ({"type": "move_sensor", "id": 1, "x": 1e7}, "x: 10000000.0 is not a number from -1,000,000 to 1,000,000"),
        ({"type": "new", "shape": [501, 21], "world": "blank"}, "shape"),
        ({"type": "view", "layer": "draw", "draw": -1}, "draw"),
        ({"type": "export", "what": "/etc/passwd"}, "what"),
        ({"type": "run", "seq": -1}, "seq"),
    ],
)
def test_bad_messages_are_refused_by_name(message, named):
    with pytest.raises(Refused, match=named):
        check(message)


def test_a_message_that_is_too_long_is_refused_unread():
    with pytest.raises(Refused, match="more than"):
        parse(" " * (MAX_BYTES + 1))
    with pytest.raises(Refused, match="more than"):
        parse("é" * (MAX_BYTES // 2 + 1))


@given(st.lists(st.tuples(st.sampled_from(["uint8", "float32", "float64", "int32"]), st.integers(0, 5)), max_size=4))
def test_frames_hold_what_was_put_in(kinds):
    rng = np.random.default_rng(0)
    arrays = {f"a{i}": rng.integers(0, 99, (2, n)).astype(kind) for i, (kind, n) in enumerate(kinds)}
    data = frame({"type": "field", "generation": 3}, arrays)
    if not arrays:
        assert json.loads(data) == {"type": "field", "generation": 3}
        return
    header, back = unframe(data)
    assert header == {"type": "field", "generation": 3}
    assert all(np.array_equal(back[name], array) and back[name].dtype == array.dtype for name, array in arrays.items())


def test_frames_are_laid_out_as_the_page_s_description_says():
    data = frame({"type": "t"}, {"p": np.array([[7, 8]], np.uint8), "q": np.array([1.5])})
    length = int.from_bytes(data[:4], "little")
    header = json.loads(data[4 : 4 + length])
    assert header["buffers"] == [
        {"name": "p", "dtype": "uint8", "shape": [1, 2]},
        {"name": "q", "dtype": "float64", "shape": [1]},
    ]
    body = data[4 + length :]
    assert body[:8] == b"\x07\x08" + b"\0" * 6
    assert np.frombuffer(body[8:], "<f8") == [1.5]
