"""The document and the messages: JSON and frames there and back, limits, refusals, and readings that follow."""

import json
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from bayesmap.app.edits import new_document, tutorial_document
from bayesmap.app.protocol.document import SETTING_BOUNDS, Document, Refused, Sensor, pack_walls
from bayesmap.app.protocol.wire import (
    ACTIONS,
    MAX_BYTES,
    check_action,
    decode_frame,
    encode_frame,
    parse_action,
    parse_document,
    parse_simulation,
    read_seq,
)
from bayesmap.app.scene import simulate_document, simulated_scene, standard_noise
from bayesmap.sim.drawing import TUTORIAL_GRID
from bayesmap.space.grid import Grid


@st.composite
def documents(draw):
    shape = draw(st.tuples(st.integers(2, 9), st.integers(2, 9)))
    size = shape[0] * shape[1]
    cells = np.array(draw(st.lists(st.booleans(), min_size=size, max_size=size))).reshape(shape)
    grid = Grid(shape, draw(st.sampled_from([0.05, 1.0, 2.5])), (draw(st.floats(-9, 9)), draw(st.floats(-9, 9))))
    indices = st.tuples(st.integers(0, shape[0] - 1), st.integers(0, shape[1] - 1))
    (x, y), sensors = grid.centers_m(), []
    for n, (i, j) in enumerate(draw(st.lists(indices, min_size=1, max_size=4)), 1):
        sensors.append(Sensor(n, float(x[i]), float(y[j]), draw(st.floats(-3.14, 3.14))))
        cells[i, j] = False
    settings = {
        "prior": st.floats(0.001, 0.999), "noise": st.floats(0.01, 5), "angles": st.integers(10, 1000),
        "max_range": st.floats(0.1, 10_000), "fov": st.floats(0.1, 6.28),
        "readings": st.sampled_from(["noisy", "exact"]), "start": st.sampled_from(["auto", "prior", "empty"]),
        "method": st.sampled_from(["auto", "gibbs", "block", "propagate", "importance"]),
        "order": st.sampled_from(["raster", "radial", "random"]), "sweeps": st.integers(1, 100_000),
        "seed": st.integers(0, 2**31 - 1),
    }  # fmt: skip
    return Document(grid, pack_walls(cells), tuple(sensors), **draw(st.fixed_dictionaries(settings)))


@given(documents())
def test_a_document_goes_through_json_and_through_a_pipe_unchanged(document):
    assert parse_document(json.loads(json.dumps(document.to_json()))) == document
    assert pickle.loads(pickle.dumps(document)) == document


def test_fields_that_are_left_out_are_written_with_their_defaults():
    left_out = {name: GOOD[name] for name in ("grid", "walls")}
    whole = Document(TUTORIAL_GRID, tutorial_document().walls, (Sensor(1, 10.0, 10.0),))
    assert parse_document({**left_out, "sensors": [{"id": 1, "x": 10, "y": 10}]}).to_json() == whole.to_json()


def test_walls_are_packed_as_the_page_s_description_says_and_cannot_be_written_to():
    cells = np.zeros((3, 4), dtype=bool)
    cells[0, 0] = cells[2, 3] = True  # bits 0 and 11 of 12
    document = Document(Grid((3, 4)), pack_walls(cells), (Sensor(1, 0.5, 1.5),))
    assert document.to_json()["walls"] == "gBA="  # 1000 0000 0001 0000
    assert np.array_equal(parse_document(document.to_json()).is_wall, cells)
    with pytest.raises(ValueError, match="read-only"):
        document.is_wall[0, 0] = True


GOOD = tutorial_document().to_json()


@pytest.mark.parametrize(("key", "value", "named"), [
    ("version", 2, "version"), ("grid", None, "grid"), ("grid", {"shape": [1, 21]}, "shape"),
    ("grid", {"shape": [501, 21]}, "shape"),
    ("grid", {"shape": [21.5, 21]}, "shape\\[0\\]: 21.5 is not a whole number"),
    ("grid", {"shape": [21, 21], "resolution": 0}, "resolution"),
    ("grid", {"shape": [21, 21], "origin": [1e300, 0]}, "origin"), ("walls", 5, "walls"),
    ("walls", "not base64!", "walls"), ("walls", "AAAA", "walls"), ("sensors", [], "sensors"),
    ("sensors", [{"id": 1, "x": 10, "y": 10}] * 33, "sensors"),
    ("sensors", [{"id": 1, "x": 10, "y": 10}] * 2, "same id"),
    ("sensors", [{"id": 1, "x": "10", "y": 10}], "sensors\\[0\\].x"),
    ("sensors", [{"id": 1, "x": 99, "y": 10}], "outside"), ("sensors", [{"id": 1, "x": 2, "y": 2}], "wall"),
    ("prior", True, "prior"), ("prior", 0, "prior: 0 is not a number from 0.001 to 0.999"),
    ("noise", -0.1, "noise \\(m\\): -0.1 is not a number from 0.01 to 5"), ("angles", 9, "angles"),
    ("angles", 10.5, "angles"), ("sweeps", 10**400, "sweeps"),
    ("method", "exact", "method: 'exact' is not one of auto, block, gibbs"), ("method", ["gibbs"], "method"),
    ("order", None, "order"), ("source", {"kind": "log", "name": "/etc/passwd", "scans": -1}, "scans"),
    ("source", {"kind": "log", "name": "", "scans": 3}, "name"), ("source", {"kind": "folder"}, "kind"),
    ("fov", 7.0, "field of view"), ("max_range", -5, "longest range"), ("start", "here", "start"),
    ("readings", 3, "readings"),
])  # fmt: skip
def test_wrong_values_in_a_document_are_refused_by_name(key, value, named):
    with pytest.raises(Refused, match=named):
        parse_document({**GOOD, key: value})


def test_a_document_of_a_file_names_it_and_holds_its_settings_alone():
    source = {"kind": "log", "name": "office.log", "scans": 7}
    document = parse_document({**GOOD, "source": source, "walls": "", "sensors": [], "prior": 0.25, "noise": 99})
    assert (document.source.name, document.source.scans, document.prior) == ("office.log", 7, 0.25)
    assert not document.is_wall.any()
    with pytest.raises(Refused, match="file"):
        parse_simulation({**GOOD, "source": source})


def test_the_method_follows_the_prior_unless_it_is_named():
    for prior, sampler in ((0.5, "gibbs"), (0.21, "gibbs"), (0.2, "block"), (0.9, "block")):
        document = replace(tutorial_document(), prior=prior)
        assert document.sampler == sampler
        assert replace(document, method="gibbs").sampler == "gibbs"


def test_limits_belong_to_what_is_allowed():
    for name, bounds in SETTING_BOUNDS.items():
        for bound in bounds:
            assert getattr(parse_document({**GOOD, name: bound}), name) == bound


def test_the_noise_of_a_beam_depends_on_seed_sensor_and_number_alone():
    one = tutorial_document()
    two = replace(one, sensors=(*one.sensors, Sensor(2, 8.0, 8.0)))
    moved = replace(two, sensors=(Sensor(1, 10.4, 9.0, 1.0), two.sensors[1]))
    alone, before, after = (simulate_document(document)[0].ranges_m for document in (one, two, moved))
    assert np.array_equal(before[1], after[1])
    assert not np.array_equal(before[0], after[0])
    assert np.array_equal(alone[0], before[0])
    assert np.array_equal(standard_noise(3, 1, 1000)[:10], standard_noise(3, 1, 10))
    assert not np.array_equal(standard_noise(3, 2, 10), standard_noise(3, 1, 10))
    assert not np.array_equal(standard_noise(4, 1, 10), standard_noise(3, 1, 10))


def test_readings_spread_by_the_noise_over_the_field_of_view_or_are_exact_at_a_choice():
    for noise in (0.2, 2.0):  # of some 80 readings within 20 m: 4 standard errors
        document = replace(tutorial_document(), noise=noise)
        exact_m = simulated_scene(document).exact_m.ravel()
        off_m = simulate_document(document)[0].ranges_m.ravel() - exact_m
        assert off_m[exact_m < 20].std() == pytest.approx(noise, rel=0.35)
        np.testing.assert_allclose(simulate_document(replace(document, readings="exact"))[0].ranges_m.ravel(), exact_m)
    fan, _ = simulate_document(replace(document, angles=11, fov=np.pi / 2))
    np.testing.assert_allclose(fan.angles_rad, np.linspace(-np.pi / 4, np.pi / 4, 11))


@pytest.mark.parametrize(
    ("world", "shape"),
    [("blank", (2, 2)), ("blank", (500, 500)), ("tutorial", (21, 21)), ("tutorial", (5, 40)), ("tutorial", (4, 2)),
     ("tutorial", (60, 50)), ("building", (52, 36)), ("building", (200, 300))],
)  # fmt: skip
def test_new_maps_are_documents(world, shape):
    document = new_document(world, shape, tutorial_document())
    assert document.grid.shape == shape
    assert parse_document(document.to_json()) == document
    if shape == (21, 21):
        assert document == tutorial_document()
        with pytest.raises(Refused, match="52 x 36"):
            new_document("building", shape, document)


JSON = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=8), st.sampled_from([*ACTIONS])),
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(st.text(max_size=6), inner, max_size=4)),
    max_leaves=12,
)
NAMES = ("patch", "cells", "wall", "stroke", "op", "id", "x", "y", "yaw", "drag", "what", "shape", "world", "on",
         "layer", "chain", "draw", "index", "document", "seq")  # fmt: skip


def understood(data):
    try:
        return parse_action(data)
    except Refused:
        read_seq(data)
        return None


@settings(max_examples=200)
@given(st.one_of(st.binary(max_size=200), st.text(max_size=200)))
@example(b"\xff\xfe")
@example(b"[" * 100_000)
@example(b'{"type": "run", "seq": ' + b"9" * 5000 + b"}")
@example('{"type": "set", "patch": {"prior": NaN}}')
@example('{"type": "set", "patch": {"prior": 1e999}}')
@example('{"type": "\\ud800"}')
def test_random_bytes_and_text_are_refused(data):
    understood(data)


@given(st.sampled_from([*ACTIONS]), st.dictionaries(st.sampled_from(NAMES), JSON, max_size=6))
def test_random_fields_are_refused_or_make_a_message(kind, fields):
    message = understood(json.dumps({"type": kind, **fields}))
    assert message is None or message.__struct_config__.tag == kind


PATH = {"type": "path", "start": [0, 0], "goal": [1, 2], "radius": 0.2, "risk": 0.1}
BAD_PATHS = [("start", [0]), ("goal", "here"), ("goal", [0, np.inf]), ("radius", 0), ("risk", 1), ("risk", None)]
MESSAGES = [
    PATH, {"type": "set", "patch": {"prior": 0.05, "method": "block"}, "drag": 3},
    {"type": "walls", "cells": [[1, 2], [3, 4]], "wall": True, "stroke": 1},
    {"type": "add_sensor", "x": 1, "y": 2.5, "yaw": 0}, {"type": "move_sensor", "id": 1, "yaw": 1.5},
    {"type": "remove_sensor", "id": 2}, {"type": "clear", "what": "inference"},
    {"type": "new", "shape": [500, 2], "world": "blank"}, {"type": "view", "layer": "draw", "chain": None, "draw": 7},
    {"type": "hello"}, {"type": "export", "what": "html"},
]  # fmt: skip


def test_good_messages_are_understood():
    for message in MESSAGES:
        assert check_action({**message, "seq": 5}).seq == 5


@pytest.mark.parametrize(("message", "named"), [
    ([], "not an object"), ({"type": "shutdown"}, "unknown type"), ({"type": "set", "patch": {"colour": 1}}, "colour"),
    ({"type": "set", "patch": {"prior": "0.5"}}, "prior"),
    *[({"type": "set", "patch": {"scans_used": scans}}, "scans used") for scans in (0, 1.5)],
    *[({"type": "set", "patch": {"resolution": size}}, "cell size") for size in (0, "fine")],
    ({"type": "set"}, "set.patch: missing"),
    ({"type": "walls", "cells": [[1, 2.5]], "wall": True}, r"cells\[0\]\[1\]: 2.5 is not a whole number"),
    ({"type": "walls", "cells": [[3, 4], [-1, 2]], "wall": True}, r"cells\[1\]\[0\]: -1 is not"),
    ({"type": "walls", "cells": [[True, 2]], "wall": True}, r"cells\[0\]\[0\]: True"),
    ({"type": "walls", "cells": [[1, 2, 3]], "wall": True}, "a list of 2"),
    ({"type": "walls", "cells": [], "wall": True}, "cells"), ({"type": "walls", "cells": [[1, 2]], "wall": 1}, "wall"),
    ({"type": "move_sensor", "x": 1, "y": 1}, "id"), ({"type": "add_sensor", "x": 1}, "y"),
    ({"type": "move_sensor", "id": 1, "x": 1e7}, "x: 10000000.0 is not a number from -1,000,000 to 1,000,000"),
    ({"type": "new", "shape": [501, 21], "world": "blank"}, "shape"),
    ({"type": "view", "layer": "draw", "draw": -1}, "draw"), ({"type": "export", "what": "/etc/passwd"}, "what"),
    ({"type": "run", "seq": -1}, "seq"), *[({**PATH, name: value}, name) for name, value in BAD_PATHS],
])  # fmt: skip
def test_bad_messages_are_refused_by_name(message, named):
    with pytest.raises(Refused, match=named):
        check_action(message)


def test_a_message_that_is_too_long_is_refused_unread():
    with pytest.raises(Refused, match="more than"):
        parse_action(" " * (MAX_BYTES + 1))
    with pytest.raises(Refused, match="more than"):
        parse_action("é" * (MAX_BYTES // 2 + 1))


@given(st.lists(st.tuples(st.sampled_from(["uint8", "float32", "float64", "int32"]), st.integers(0, 5)), max_size=4))
def test_frames_hold_what_was_put_in(kinds):
    rng, message = np.random.default_rng(0), {"type": "field", "generation": 3}
    arrays = {f"a{i}": rng.integers(0, 99, (2, n)).astype(kind) for i, (kind, n) in enumerate(kinds)}
    data = encode_frame(message, arrays)
    header, back = decode_frame(data) if arrays else (json.loads(data), {})
    assert header == message
    assert all(np.array_equal(back[name], array) and back[name].dtype == array.dtype for name, array in arrays.items())


def test_frames_are_laid_out_as_the_page_s_description_says():
    data = encode_frame({"type": "t"}, {"p": np.array([[7, 8]], np.uint8), "q": np.array([1.5])})
    length = int.from_bytes(data[:4], "little")
    listed = [{"name": "p", "dtype": "uint8", "shape": [1, 2]}, {"name": "q", "dtype": "float64", "shape": [1]}]
    assert json.loads(data[4 : 4 + length])["buffers"] == listed
    body = data[4 + length :]
    assert body[:8] == b"\x07\x08" + b"\0" * 6
    assert np.frombuffer(body[8:], "<f8") == [1.5]
