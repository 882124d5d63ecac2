import numpy as np
import pytest
from map_case import GRID, observed, occupancy
from recorded import READERS

from bayesmap.errors import BadInput
from bayesmap.io.ros.maps import in_percent
from bayesmap.io.ros.run_messages import write_occupancy_grid
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
    assert (info.width, info.height) == (5, 3)
    assert info.resolution == 0.25
    assert (info.origin.position.x, info.origin.position.y, info.origin.position.z) == (-1.5, 2.0, 0.0)
    turn = info.origin.orientation
    assert (turn.x, turn.y, turn.z, turn.w) == (0, 0, 0, 1)
    assert len(message.data) == 15
    for i in range(5):
        for j in range(3):
            expected = round(100 * occupancy()[i, j]) if observed()[i, j] else -1
            assert message.data[j * info.width + i] == expected, (i, j)
    seconds = message.header.stamp
    assert (getattr(seconds, "sec", None) or seconds.secs) == 976052857
    assert list(tmp_path.iterdir()) == [path], "something was left behind"


@pytest.mark.parametrize("ending", READERS)
def test_who_subscribes_late_gets_the_map_too(tmp_path, ending):
    (found,) = READERS[ending](write_occupancy_grid(tmp_path / f"floor{ending}", occupancy(), GRID))
    if ending == ".bag":
        assert found.qos == 1
    else:
        (qos,) = found.qos
        assert (qos["durability"], qos["reliability"], qos["history"], qos["depth"]) == (1, 1, 1, 1)
    assert found.time_ns > 0  # ROS 1 refuses a message of time zero


def test_trinary_and_thresholds(tmp_path):
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


def test_nan_is_unknown():
    np.testing.assert_array_equal(in_percent([[np.nan, 0.5]], Grid((1, 2))), [[-1, 50]])


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"occupancy": np.full((5, 3), -0.1)}, r"occupancy\[0, 0\] is -0.1"),
        ({"occupancy": np.zeros((3, 5))}, r"occupancy has shape \(3, 5\), but the grid has \(5, 3\)"),
        ({"mode": "fuzzy"}, "use one of trinary, scale, raw"),
        ({"path": "floor.txt"}, r"\.bag \(ROS 1\), \.mcap or \.db3 \(ROS 2\)"),
        ({"path": "nowhere/floor.mcap"}, "cannot be written"),
        ({"path": "nowhere/floor"}, "cannot be written .*name a folder inside one"),
    ],
)
def test_what_cannot_be_written_leaves_no_file(tmp_path, change, says):
    arguments = {"path": "floor.mcap", "occupancy": occupancy(), "grid": GRID, **change}
    arguments["path"] = tmp_path / arguments["path"]
    with pytest.raises(BadInput, match=says):
        write_occupancy_grid(**arguments)
    assert list(tmp_path.iterdir()) == []


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
