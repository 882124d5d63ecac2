"""The document: JSON there and back, limits, and readings that follow from it."""

import json
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bayesmap.app.edits import new_document, tutorial_document
from bayesmap.app.protocol.document import BOUNDS, Document, Refused, Sensor, packed
from bayesmap.app.protocol.wire import parse_document, parse_simulation
from bayesmap.app.scene import simulate_document, standard_noise
from bayesmap.sim.drawing import TUTORIAL_GRID
from bayesmap.space.grid import Grid


@st.composite
def documents(draw):
    shape = draw(st.tuples(st.integers(2, 9), st.integers(2, 9)))
    cells = np.array(draw(st.lists(st.booleans(), min_size=shape[0] * shape[1], max_size=shape[0] * shape[1])))
    cells = cells.reshape(shape)
    grid = Grid(shape, draw(st.sampled_from([0.05, 1.0, 2.5])), (draw(st.floats(-9, 9)), draw(st.floats(-9, 9))))
    places = draw(
        st.lists(st.tuples(st.integers(0, shape[0] - 1), st.integers(0, shape[1] - 1)), min_size=1, max_size=4)
    )
    x, y = grid.centers_m()
    sensors = tuple(
        Sensor(n + 1, float(x[i]), float(y[j]), draw(st.floats(-3.14, 3.14))) for n, (i, j) in enumerate(places)
    )
    for i, j in places:
        cells[i, j] = False
    return Document(
        grid,
        packed(cells),
        sensors,
        prior=draw(st.floats(0, 1)),
        noise=draw(st.floats(0, 5)),
        angles=draw(st.integers(10, 1000)),
        max_range=draw(st.floats(0.1, 10_000)),
        fov=draw(st.floats(0.1, 6.28)),
        readings=draw(st.sampled_from(["noisy", "exact"])),
        start=draw(st.sampled_from(["auto", "prior", "empty"])),
        method=draw(st.sampled_from(["auto", "gibbs", "block", "propagate", "importance"])),
        order=draw(st.sampled_from(["raster", "radial", "random"])),
        sweeps=draw(st.integers(1, 100_000)),
        seed=draw(st.integers(0, 2**31 - 1)),
    )


@given(documents())
def test_a_document_goes_through_json_and_through_a_pipe_unchanged(document):
    assert parse_document(json.loads(json.dumps(document.to_json()))) == document
    assert pickle.loads(pickle.dumps(document)) == document


def test_what_was_left_out_is_written_with_its_default():
    left_out = {name: GOOD[name] for name in ("grid", "walls")}
    assert parse_document({**left_out, "sensors": [{"id": 1, "x": 10, "y": 10}]}).to_json() == {
        **Document(TUTORIAL_GRID, tutorial_document().walls, (Sensor(1, 10.0, 10.0),)).to_json()
    }


def test_walls_are_packed_as_the_page_s_description_says():
    cells = np.zeros((3, 4), dtype=bool)
    cells[0, 0] = cells[2, 3] = True  # bits 0 and 11 of 12
    document = Document(Grid((3, 4)), packed(cells), (Sensor(1, 0.5, 1.5),))
    assert document.to_json()["walls"] == "gBA="  # 1000 0000 0001 0000
    assert np.array_equal(parse_document(document.to_json()).is_wall, cells)


def test_a_map_cannot_be_written_to():
    with pytest.raises(ValueError, match="read-only"):
        tutorial_document().is_wall[0, 0] = True


GOOD = tutorial_document().to_json()


@pytest.mark.parametrize(
    ("key", "value", "named"),
    [
        ("version", 2, "version"),
        ("grid", None, "grid"),
        ("grid", {"shape": [1, 21]}, "shape"),
        ("grid", {"shape": [501, 21]}, "shape"),
        ("grid", {"shape": [21.5, 21]}, "shape\\[0\\]: 21.5 is not a whole number"),
        ("grid", {"shape": [21, 21], "resolution": 0}, "resolution"),
        ("grid", {"shape": [21, 21], "origin": [1e300, 0]}, "origin"),
        ("walls", 5, "walls"),
        ("walls", "not base64!", "walls"),
        ("walls", "AAAA", "walls"),
        ("sensors", [], "sensors"),
        ("sensors", [{"id": 1, "x": 10, "y": 10}] * 33, "sensors"),
        ("sensors", [{"id": 1, "x": 10, "y": 10}] * 2, "same id"),
        ("sensors", [{"id": 1, "x": "10", "y": 10}], "sensors\\[0\\].x"),
        ("sensors", [{"id": 1, "x": 99, "y": 10}], "outside"),
        ("sensors", [{"id": 1, "x": 2, "y": 2}], "wall"),
        ("prior", True, "prior"),
        ("prior", 1.01, "prior"),
        ("noise", -0.1, "noise \\(m\\): -0.1 is not a number from 0 to 5"),
        ("angles", 9, "angles"),
        ("angles", 10.5, "angles"),
        ("sweeps", 10**400, "sweeps"),
        ("method", "exact", "method: 'exact' is not one of auto, block, gibbs"),
        ("method", ["gibbs"], "method"),
        ("order", None, "order"),
        ("source", {"kind": "log", "name": "/etc/passwd", "scans": -1}, "scans"),
        ("source", {"kind": "log", "name": "", "scans": 3}, "name"),
        ("source", {"kind": "folder"}, "kind"),
        ("fov", 7.0, "field of view"),
        ("max_range", -5, "longest range"),
        ("start", "here", "start"),
        ("readings", 3, "readings"),
    ],
)
def test_what_a_document_may_not_hold_is_refused_by_name(key, value, named):
    with pytest.raises(Refused, match=named):
        parse_document({**GOOD, key: value})


def test_a_document_of_a_file_names_it_and_holds_its_settings_alone():
    source = {"kind": "log", "name": "office.log", "scans": 7}
    found = parse_document({**GOOD, "source": source, "walls": "", "sensors": [], "prior": 0.25, "noise": 99})
    assert (found.source.name, found.source.scans, found.prior) == ("office.log", 7, 0.25)
    assert not found.is_wall.any()
    with pytest.raises(Refused, match="file"):
        parse_simulation({**GOOD, "source": source})


@pytest.mark.parametrize(("prior", "sampler"), [(0.5, "gibbs"), (0.21, "gibbs"), (0.2, "block"), (0.9, "block")])
def test_the_method_follows_the_prior_unless_it_is_named(prior, sampler):
    document = replace(tutorial_document(), prior=prior)
    assert document.sampler == sampler
    assert replace(document, method="gibbs").sampler == "gibbs"


@pytest.mark.parametrize("name", BOUNDS)
def test_limits_belong_to_what_is_allowed(name):
    for bound in BOUNDS[name]:
        assert getattr(parse_document({**GOOD, name: bound}), name) == bound


def test_moving_one_sensor_leaves_the_other_s_readings_alone():
    one = tutorial_document()
    two = replace(one, sensors=(*one.sensors, Sensor(2, 8.0, 8.0)))
    moved = replace(two, sensors=(Sensor(1, 10.4, 9.0, 1.0), two.sensors[1]))
    before, after = simulate_document(two)[0].ranges_m, simulate_document(moved)[0].ranges_m
    assert np.array_equal(before[1], after[1])
    assert not np.array_equal(before[0], after[0])
    assert np.array_equal(simulate_document(one)[0].ranges_m[0], before[0])


def test_a_beam_s_noise_depends_on_its_number_and_not_on_how_many_there_are():
    assert np.array_equal(standard_noise(3, 1, 1000)[:10], standard_noise(3, 1, 10))
    assert not np.array_equal(standard_noise(3, 2, 10), standard_noise(3, 1, 10))
    assert not np.array_equal(standard_noise(4, 1, 10), standard_noise(3, 1, 10))


@pytest.mark.parametrize(
    ("world", "shape"),
    [("blank", (2, 2)), ("blank", (500, 500)), ("tutorial", (21, 21)),
     ("tutorial", (5, 40)), ("tutorial", (4, 2)), ("tutorial", (60, 50)),
     ("building", (52, 36)),
     ("building", (200, 300))],
)  # fmt: skip
def test_new_maps_are_documents(world, shape):
    document = new_document(world, shape, tutorial_document())
    assert document.grid.shape == shape
    assert parse_document(document.to_json()) == document


def test_the_tutorial_s_world_is_the_tutorial_s():
    assert new_document("tutorial", (21, 21), tutorial_document()) == tutorial_document()


def test_a_building_that_does_not_fit_is_refused():
    with pytest.raises(Refused, match="52 x 36"):
        new_document("building", (21, 21), tutorial_document())
