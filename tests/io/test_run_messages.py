"""Occupancy grids and grid maps in recordings, read back without bayesmap."""

import numpy as np
import pytest
from recorded import GRID, READERS, observed, occupancy

from bayesmap.errors import BadInput
from bayesmap.io.ros.maps import in_percent
from bayesmap.io.ros.writer import write_grid_map, write_occupancy_grid
from bayesmap.space.grid import Grid


@pytest.mark.parametrize("ending", READERS)
def test_others_read_the_map_in_every_container(tmp_path, ending):
    path = tmp_path / f"floor{ending}"
    assert write_occupancy_grid(path, occupancy(), GRID, observed(), stamp_s=976052857.25) == path
    (found,) = READERS[ending](path)
    assert found.topic == "/map"
    assert found.type_name in ("nav_msgs/msg/OccupancyGrid", "nav_msgs/OccupancyGrid")
    assert found.time_ns == 976052857_250_000_000
    message = found.message
    assert message.header.frame_id == "map"
    info = message.info
    assert (info.width, info.height, info.resolution) == (5, 3, 0.25)
    assert (info.origin.position.x, info.origin.position.y, info.origin.position.z) == (-1.5, 2.0, 0.0)
    turn = info.origin.orientation
    assert (turn.x, turn.y, turn.z, turn.w, len(message.data)) == (0, 0, 0, 1, 15)
    for i in range(5):
        for j in range(3):
            expected = round(100 * occupancy()[i, j]) if observed()[i, j] else -1
            assert message.data[j * info.width + i] == expected, (i, j)
    seconds = message.header.stamp
    assert (getattr(seconds, "sec", None) or seconds.secs) == 976052857
    assert list(tmp_path.iterdir()) == [path], "something was left behind"
    # Who subscribes late gets the map, too.
    (late,) = READERS[ending](write_occupancy_grid(tmp_path / f"late{ending}", occupancy(), GRID))
    if ending == ".bag":
        assert late.qos == 1
    else:
        (qos,) = late.qos
        assert (qos["durability"], qos["reliability"], qos["history"], qos["depth"]) == (1, 1, 1, 1)
    assert late.time_ns > 0  # ROS 1 refuses a message of time zero


def test_trinary_and_thresholds(tmp_path):
    np.testing.assert_array_equal(in_percent([[np.nan, 0.5]], Grid((1, 2))), [[-1, 50]])
    p = np.array([[0.1, 0.3, 0.6, 0.7]])
    for options, expected in (
        ({"mode": "trinary"}, [0, -1, -1, 100]),
        ({"mode": "trinary", "occupied_thresh": 0.5, "free_thresh": 0.4}, [0, 0, 100, 100]),
        ({"mode": "scale"}, [10, 30, 60, 70]),
        ({"mode": "scale", "occupied_thresh": 0.65, "free_thresh": 0.25}, [0, 12, 88, 100]),
        ({"mode": "raw", "occupied_thresh": 0.65, "free_thresh": 0.25}, [10, 30, 60, 70]),
    ):
        np.testing.assert_array_equal(in_percent(p, Grid((1, 4)), **options)[0], expected)
    (found,) = READERS[".mcap"](write_occupancy_grid(tmp_path / "t.mcap", p, Grid((1, 4)), mode="trinary"))
    assert list(found.message.data) == [0, -1, -1, 100]


def test_a_bag_in_a_folder_is_replaced_but_nothing_else_is(tmp_path):
    folder = tmp_path / "floor"
    folder.mkdir()  # an empty folder is as good as none
    write_occupancy_grid(folder, occupancy(), GRID)
    write_occupancy_grid(folder, 1 - occupancy(), GRID)
    assert READERS[""](folder)[0].message.data[0] == round(100 * (1 - occupancy()[0, 0]))
    (folder / "thesis.tex").write_text("years of work")
    with pytest.raises(BadInput, match="holds other things"):
        write_occupancy_grid(folder, occupancy(), GRID)
    assert (folder / "thesis.tex").read_text() == "years of work"
    assert [path.name for path in tmp_path.iterdir()] == ["floor"]


def test_a_failure_on_the_way_keeps_the_old_file(tmp_path, monkeypatch):
    import bayesmap.io.ros.writer as writer

    for name in ("floor.mcap", "floor"):
        write_occupancy_grid(tmp_path / name, occupancy(), GRID)
    before = (tmp_path / "floor.mcap").read_bytes(), (tmp_path / "floor" / "floor.db3").read_bytes()
    monkeypatch.setattr(writer, "_write_ros2", lambda path, *rest: (path.mkdir(), 1 / 0))
    for name in ("floor.mcap", "floor"):
        with pytest.raises(ZeroDivisionError):
            write_occupancy_grid(tmp_path / name, 1 - occupancy(), GRID)
    assert before == ((tmp_path / "floor.mcap").read_bytes(), (tmp_path / "floor" / "floor.db3").read_bytes())
    assert sorted(path.name for path in tmp_path.iterdir()) == ["floor", "floor.mcap"]


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
    assert (header.frame_id, found.time_ns, info.resolution) == ("map", 12_500_000_000, 0.25)
    assert (info.length_x, info.length_y) == (1.25, 0.75)
    assert (info.pose.position.x, info.pose.position.y) == (-1.5 + 0.625, 2.0 + 0.375)
    assert info.pose.orientation.w == 1.0
    assert (message.outer_start_index, message.inner_start_index) == (0, 0)
    assert (list(message.layers), list(message.basic_layers)) == (list(LAYERS), ["mean"])
    xs, ys = GRID.centers_m()
    for values, layer in zip(message.data, LAYERS.values(), strict=True):
        for i, x in enumerate(xs):
            for j, y in enumerate(ys):
                expected = np.float32(layer[i, j]) if observed()[i, j] else np.float32(np.nan)
                np.testing.assert_equal(grid_map_at(info, values, x, y), expected)


def test_the_matrices_are_labelled_as_grid_map_labels_eigens_and_ros_1_knows_the_message_by_its_checksum(tmp_path):
    (found,) = READERS[".bag"](write_grid_map(tmp_path / "floor.bag", LAYERS, GRID))
    layout = found.message.data[0].layout
    assert [(d.label, d.size, d.stride) for d in layout.dim] == [("column_index", 3, 15), ("row_index", 5, 5)]
    assert layout.data_offset == 0
    assert found.message._md5sum == "95681e052b1f73bf87b7eb984382b401"  # of grid_map_msgs 1.6
    assert found.type_name == "grid_map_msgs/GridMap"


CELLS, MAP = (occupancy(), GRID), "floor.mcap"


@pytest.mark.parametrize(("write", "name", "arguments", "options", "says"), [
    (write_occupancy_grid, MAP, (np.zeros((3, 5)), GRID), {}, r"has shape \(3, 5\), but the grid has \(5, 3\)"),
    (write_occupancy_grid, MAP, CELLS, {"mode": "fuzzy"}, "use one of trinary, scale, raw"),
    (write_occupancy_grid, "floor.txt", CELLS, {}, r"\.bag \(ROS 1\), \.mcap or \.db3 \(ROS 2\)"),
    (write_occupancy_grid, "nowhere/floor", CELLS, {}, "cannot be written .*name a folder inside one"),
    (write_grid_map, MAP, ({}, GRID), {}, "no layer to write"),
    (write_grid_map, MAP, ({"": occupancy()}, GRID), {}, "needs a name"),
    (write_grid_map, MAP, ({"mean": occupancy().T}, GRID), {}, r"layer 'mean' has shape \(3, 5\)"),
    (write_grid_map, MAP, ({"mean": np.full(GRID.shape, np.inf)}, GRID), {}, r"layer 'mean'\[0, 0\] is inf"),
])  # fmt: skip
def test_what_cannot_be_written_leaves_no_file(tmp_path, write, name, arguments, options, says):
    with pytest.raises(BadInput, match=says):
        write(tmp_path / name, *arguments, **options)
    assert list(tmp_path.iterdir()) == []
