import numpy as np
import pytest
from map_case import GRID, observed, occupancy
from recorded import READERS

from bayesmap.errors import BadInput
from bayesmap.io.ros.run_messages import write_grid_map

LAYERS = {"mean": occupancy(), "entropy": 1 - occupancy(), "lower": occupancy() / 2}


def grid_map_at(info, values, x, y):
    """GridMap::atPosition, by grid_map's rules: rows run from the largest x down, columns from the largest y."""
    (columns, rows) = (dim.size for dim in values.layout.dim)
    matrix = np.array(values.data, dtype=np.float32).reshape(columns, rows).T  # column by column
    row = int((info.pose.position.x + info.length_x / 2 - x) / info.resolution)
    column = int((info.pose.position.y + info.length_y / 2 - y) / info.resolution)
    return matrix[row, column]


@pytest.mark.parametrize("ending", READERS)
def test_grid_map_finds_every_layer_at_every_place(tmp_path, ending):
    path = write_grid_map(tmp_path / f"floor{ending}", LAYERS, GRID, observed(), stamp_s=12.5)
    (found,) = READERS[ending](path)
    assert found.topic == "/grid_map"
    message, info = found.message, found.message.info
    header = info.header if ending == ".bag" else message.header
    assert header.frame_id == "map"
    assert found.time_ns == 12_500_000_000
    assert info.resolution == 0.25
    assert (info.length_x, info.length_y) == (1.25, 0.75)
    assert (info.pose.position.x, info.pose.position.y) == (-1.5 + 0.625, 2.0 + 0.375)
    assert info.pose.orientation.w == 1.0
    assert (message.outer_start_index, message.inner_start_index) == (0, 0)
    assert list(message.layers) == list(LAYERS)
    assert list(message.basic_layers) == ["mean"]
    xs, ys = GRID.centers_m()
    for values, layer in zip(message.data, LAYERS.values(), strict=True):
        for i, x in enumerate(xs):
            for j, y in enumerate(ys):
                expected = np.float32(layer[i, j]) if observed()[i, j] else np.float32(np.nan)
                np.testing.assert_equal(grid_map_at(info, values, x, y), expected)


def test_the_matrices_are_labelled_as_grid_map_labels_eigens(tmp_path):
    (found,) = READERS[".mcap"](write_grid_map(tmp_path / "floor.mcap", LAYERS, GRID))
    outer, inner = found.message.data[0].layout.dim
    assert (outer.label, outer.size, outer.stride) == ("column_index", 3, 15)
    assert (inner.label, inner.size, inner.stride) == ("row_index", 5, 5)
    assert found.message.data[0].layout.data_offset == 0


def test_ros_1_knows_the_message_by_its_checksum(tmp_path):
    (found,) = READERS[".bag"](write_grid_map(tmp_path / "floor.bag", LAYERS, GRID))
    assert found.message._md5sum == "95681e052b1f73bf87b7eb984382b401"  # of grid_map_msgs 1.6
    assert found.type_name == "grid_map_msgs/GridMap"


@pytest.mark.parametrize(
    ("layers", "says"),
    [
        ({}, "no layer to write"),
        ({"": occupancy()}, "needs a name"),
        ({"mean": occupancy().T}, r"layer 'mean' has shape \(3, 5\)"),
        ({"mean": np.full(GRID.shape, np.inf)}, r"layer 'mean'\[0, 0\] is inf"),
    ],
)
def test_layers_that_do_not_fit_are_named(tmp_path, layers, says):
    with pytest.raises(BadInput, match=says):
        write_grid_map(tmp_path / "floor.mcap", layers, GRID)
    assert list(tmp_path.iterdir()) == []


def test_the_callers_arrays_stay_as_they_are(tmp_path):
    mean = occupancy().astype(np.float32)
    write_grid_map(tmp_path / "floor.mcap", {"mean": mean}, GRID, observed())
    np.testing.assert_array_equal(mean, occupancy().astype(np.float32))
