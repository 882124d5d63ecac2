"""Exports: endings, formats, GeoTIFF, recordings for rerun, occupancy grids, grid maps; read without bayesmap."""

import builtins
import os
import zlib
from typing import get_args
from unittest.mock import Mock

import numpy as np
import pytest
from PIL import Image
from recorded import GRID, READERS, binary_run, observed, occupancy, reflectivity_run, scans

from bayesmap.cli.keys import Export
from bayesmap.errors import BadInput
from bayesmap.io import exports
from bayesmap.io.exports import export_format, export_run, layers_of, path_to_replace
from bayesmap.io.geotiff import write_geotiff
from bayesmap.io.rerun import UNKNOWN_COLOR, to_pixels, write_rerun
from bayesmap.io.ros import writer
from bayesmap.io.ros.maps import in_percent
from bayesmap.io.ros.writer import write_grid_map, write_occupancy_grid
from bayesmap.space.grid import Grid
from bayesmap.space.trajectory import Trajectory

NEEDS = {"geotiff": "rasterio", "rerun": "rerun"}


@pytest.mark.parametrize(("path", "format"), [
    ("map.yaml", "map-server"), ("map.YML", "map-server"), ("map.bag", "occupancy-grid"),
    ("map.mcap", "occupancy-grid"), ("map.db3", "occupancy-grid"), ("map", "occupancy-grid"),
    ("map.d" + os.sep, "occupancy-grid"), ("map.rrd", "rerun"), ("map.tum", "tum"), ("map.tif", "geotiff"),
    ("map.tiff", "geotiff"),
])  # fmt: skip
def test_the_ending_chooses_the_format(path, format):
    assert export_format(path) == format


def test_a_named_format_wins_and_an_unknown_ending_is_told_the_known_ones():
    assert export_format("map.mcap", "gridmap") == "gridmap"
    assert (export_format("poses.txt", "tum"), ("auto", *exports.FORMATS)) == ("tum", get_args(Export))
    for path in ("map.txt", "map.pgm", "map.2024"):
        with pytest.raises(BadInput) as refusal:
            export_format(path)
        for ending in (".yaml", ".yml", ".bag", ".mcap", ".db3", ".rrd", ".tum", ".tif", ".tiff", "without ending"):
            assert ending in str(refusal.value)
    with pytest.raises(BadInput, match="use one of map-server, occupancy-grid, gridmap"):
        export_format("map.yaml", "png")


@pytest.fixture(params=["m.yaml", "m.bag", "m.mcap", "m.db3", "m", "m.rrd", "m.tum", "m.tif"])
def name(request):
    """A name with each ending whose library is installed."""
    if export_format(request.param) in NEEDS:
        pytest.importorskip(NEEDS[export_format(request.param)])
    return request.param


def test_every_ending_writes_whole_files_and_replaces_old_ones(tmp_path, name):
    target = tmp_path / name
    assert path_to_replace(target) is None
    outputs = export_run(target, binary_run(), scans())
    assert (path_to_replace(target), export_run(target, binary_run(), scans())) == (target, outputs)
    assert (outputs[0], set(tmp_path.iterdir())) == (target, set(outputs))


def test_an_image_that_would_be_replaced_counts_as_existing(tmp_path):
    (tmp_path / "map.pgm").write_text("another map's")
    assert path_to_replace(tmp_path / "map.yaml") == tmp_path / "map.pgm"
    assert path_to_replace(tmp_path / "map.mcap") is None
    (tmp_path / "folder").mkdir()
    assert path_to_replace(tmp_path / "folder") is None


def test_walls_have_no_interval_and_reflectivities_do(tmp_path):
    for run in (binary_run(), binary_run(interval=Mock(side_effect=BadInput("walls have none")))):
        assert list(layers_of(run)) == ["mean", "entropy"]
    (path,) = export_run(tmp_path / "m.mcap", reflectivity_run(), scans(), format="gridmap")
    (found,) = READERS[".mcap"](path)
    assert list(found.message.layers) == ["mean", "entropy", "lower", "upper"]
    assert found.time_ns == 103_000_000_000  # of the last scan
    lower = np.array(found.message.data[2].data, dtype=np.float32).reshape(3, 5).T[::-1, ::-1]
    np.testing.assert_array_equal(lower, np.where(observed(), occupancy() / 2, np.nan).astype(np.float32))


def test_recordings_are_in_per_cent_and_yaml_is_trinary_unless_told(tmp_path):
    for options, values in (({}, {-1, 1, 6, 11, 21}), ({"mode": "trinary"}, {-1, 0, 100})):
        (path,) = export_run(tmp_path / "m.mcap", binary_run(), scans(), **options)
        assert values <= set(READERS[".mcap"](path)[0].message.data)
    assert "mode: trinary" in export_run(tmp_path / "m.yaml", binary_run(), scans())[0].read_text()
    assert "mode: raw" in export_run(tmp_path / "m.yaml", binary_run(), scans(), mode="raw")[0].read_text()


@pytest.mark.parametrize("option", [{"mode": "scale"}, {"free_thresh": 0.1}, {"occupied_thresh": 0.9}])
@pytest.mark.parametrize(("path", "format"), [("m.tif", None), ("m.tum", None), ("m.rrd", None), ("m.bag", "gridmap")])
def test_formats_that_keep_the_numbers_take_no_thresholds(tmp_path, path, format, option):
    with pytest.raises(BadInput, match=f"takes no {next(iter(option))}; leave it out, or choose map-server"):
        export_run(tmp_path / path, binary_run(), scans(), format=format, **option)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_none_is_named(tmp_path, name):
    (tmp_path / "file").write_text("no folder")
    for folder in (tmp_path / "file", tmp_path / "nowhere"):
        with pytest.raises(BadInput, match="cannot be written"):
            export_run(folder / name, binary_run(), scans())
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


LAYERS = {"mean": occupancy(), "entropy": 1 - occupancy()}


def expected(values):
    """Return rows from the top, NaN where no beam reached."""
    return np.where(observed(), values, np.nan).T[::-1].astype(np.float32)


def test_a_geotiff_is_right_for_other_libraries_than_the_one_that_wrote_it(tmp_path):
    """Pillow reads the tags, zlib the strips; rasterio names the bands."""
    rasterio = pytest.importorskip("rasterio")
    path = write_geotiff(tmp_path / "floor.tif", LAYERS, GRID, observed())
    with rasterio.open(path) as file:
        assert (file.descriptions, file.crs) == (("mean", "entropy"), None)
    content = path.read_bytes()
    assert content[:4] in (b"II*\0", b"MM\0*")
    with Image.open(path) as image:
        tags = dict(image.tag_v2)
    assert (tags[256], tags[257], tags[258], tags[339]) == (5, 3, (32, 32), (3, 3))  # width, height, bits, floats
    assert tags[284] == 2  # band after band
    assert tags[33550] == (0.25, 0.25, 0.0)  # ModelPixelScale
    assert tags[33922] == (0.0, 0.0, 0.0, -1.5, 2.75, 0.0)  # ModelTiepoint: the upper-left corner
    assert tags[42113] == "nan"  # GDAL_NODATA
    strips = [zlib.decompress(content[at : at + size]) for at, size in zip(tags[273], tags[279], strict=True)]
    values = np.frombuffer(b"".join(strips), dtype="<f4" if content[:2] == b"II" else ">f4").reshape(2, 3, 5)
    np.testing.assert_array_equal(values, [expected(layer) for layer in LAYERS.values()])


def columns_of(path):
    """Return every column of the recording, by entity and component, as lists of rows."""
    chunk = pytest.importorskip("rerun.chunk")
    columns = {}
    for piece in chunk.RrdReader(path).stream():
        batch = piece.to_record_batch()
        for name, column in zip(batch.schema.names, batch.columns, strict=True):
            columns.setdefault((piece.entity_path, name), []).extend(column.to_pylist())
    return columns


def find(columns, entity, ending):
    (rows,) = [rows for (at, name), rows in columns.items() if at == entity and name.endswith(ending)]
    return rows


def test_numbers_come_back_and_pictures_are_upright_walls_dark_uncertainty_bright_and_the_unknown_neither(tmp_path):
    columns = columns_of(write_rerun(tmp_path / "floor.rrd", LAYERS, GRID, observed()))
    for name, values in LAYERS.items():
        ((tensor,),) = find(columns, f"/values/{name}", "Tensor:data")
        assert tensor["shape"] == [3, 5]
        np.testing.assert_array_equal(np.reshape(tensor["buffer"], (3, 5)), expected(values))
    pictures = {}
    for name in LAYERS:
        ((buffer,),) = find(columns, f"/map/{name}", "Image:buffer")
        ((about,),) = find(columns, f"/map/{name}", "Image:format")
        assert (about["width"], about["height"]) == (5, 3)
        pictures[name] = np.array(buffer, dtype=np.uint8).reshape(3, 5, 3).astype(int)
    seen, values = observed().T[::-1], occupancy().T[::-1]
    rising = np.argsort(values[seen])
    assert (np.diff(pictures["mean"].sum(axis=-1)[seen][rising]) < 0).all()
    assert (np.diff(pictures["entropy"][..., 0][seen][rising]) < 0).all()  # of 1 - p
    for picture in pictures.values():
        np.testing.assert_array_equal((picture == UNKNOWN_COLOR).all(axis=-1), ~seen)


def test_scans_lie_on_the_picture_at_their_numbers_and_times(tmp_path):
    log = scans()
    columns = columns_of(write_rerun(tmp_path / "floor.rrd", LAYERS, GRID, scans=log))
    at = find(columns, "/sensor", "Points2D:positions")
    np.testing.assert_allclose(np.concatenate(at), to_pixels(log.poses[:, :2], GRID), atol=1e-6)
    ends = find(columns, "/scan", "Points2D:positions")
    assert [len(points) for points in ends] == [1, 2, 0]
    np.testing.assert_allclose(np.concatenate(ends[:2]), to_pixels(log.hit_points_world(), GRID), atol=1e-6)
    assert find(columns, "/scan", "scan") == [0, 1, 2]
    ((line,),) = find(columns, "/trajectory", "LineStrips2D:strips")
    assert len(line) == 3
    # From the numbers alone: the first pose is 0.1 m from the left edge and 0.65 m under the top.
    np.testing.assert_allclose(line[0], [0.4, 2.6], atol=1e-6)


def test_stamps_that_count_from_a_start_are_durations(tmp_path):
    chunk = pytest.importorskip("rerun.chunk")
    for stamps, kind in (((1.0, 2.0, 3.0), "duration"), ((1e9, 1e9 + 1, 1e9 + 2), "timestamp"), (None, None)):
        path = write_rerun(tmp_path / "floor.rrd", LAYERS, GRID, scans=scans(stamps))
        fields = [field for piece in chunk.RrdReader(path).stream() for field in piece.to_record_batch().schema]
        types = {str(field.type) for field in fields if field.name == "stamp"}
        assert (len(types), all(kind in text for text in types)) == (int(kind is not None), True)


def test_a_trajectory_is_drawn_with_its_ellipses(tmp_path):
    poses = np.array([[-1.0, 2.2, 0.0], [-0.5, 2.6, 1.0]])
    trajectory = Trajectory(poses, covariances=np.stack([np.diag([0.01, 0.04, 0.01]), np.diag([0.01, 0.01, 0.01])]))
    columns = columns_of(write_rerun(tmp_path / "walk.rrd", LAYERS, GRID, trajectory=trajectory))
    ((line,),) = find(columns, "/trajectory", "LineStrips2D:strips")
    np.testing.assert_allclose(line, to_pixels(poses[:, :2], GRID), rtol=1e-6)
    (outlines,) = find(columns, "/ellipses", "LineStrips2D:strips")
    assert len(outlines) == 2
    assert np.divide(*np.ptp(np.array(outlines[0]), axis=0)) == pytest.approx(0.5, rel=0.02)  # width over height


@pytest.mark.parametrize(
    ("library", "extra", "write"), [("rasterio", "geotiff", write_geotiff), ("rerun", "rerun", write_rerun)]
)
def test_a_missing_library_is_named_with_the_remedy(tmp_path, monkeypatch, library, extra, write):
    real = builtins.__import__

    def absent(name, *rest, **named):
        if name.split(".")[0] == library:
            raise ImportError(name)
        return real(name, *rest, **named)

    monkeypatch.setattr(builtins, "__import__", absent)
    with pytest.raises(BadInput, match=rf"pip install 'bayesmap\[{extra}\]'"):
        write(tmp_path / "floor", LAYERS, GRID)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", READERS)
def test_other_libraries_read_the_map_in_every_container(tmp_path, ending):
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
    percent = np.where(observed(), np.rint(100 * occupancy()), -1)
    np.testing.assert_array_equal(np.reshape(message.data, (3, 5)).T, percent)
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
    for name in ("floor.mcap", "floor"):
        write_occupancy_grid(tmp_path / name, occupancy(), GRID)
    before = (tmp_path / "floor.mcap").read_bytes(), (tmp_path / "floor" / "floor.db3").read_bytes()
    monkeypatch.setattr(writer.Recorder, "_write", lambda self, path, channels: (path.mkdir(), 1 / 0))
    for name in ("floor.mcap", "floor"):
        with pytest.raises(ZeroDivisionError):
            write_occupancy_grid(tmp_path / name, 1 - occupancy(), GRID)
    assert before == ((tmp_path / "floor.mcap").read_bytes(), (tmp_path / "floor" / "floor.db3").read_bytes())
    assert sorted(path.name for path in tmp_path.iterdir()) == ["floor", "floor.mcap"]


GRID_MAP_LAYERS = {"mean": occupancy(), "entropy": 1 - occupancy(), "lower": occupancy() / 2}


def grid_map_at(info, values, x, y):
    """GridMap::atPosition, by grid_map's rules: rows run from the largest x down, columns from the largest y."""
    (columns, rows) = (dim.size for dim in values.layout.dim)
    matrix = np.array(values.data, dtype=np.float32).reshape(columns, rows).T  # column by column
    row = int((info.pose.position.x + info.length_x / 2 - x) / info.resolution)
    return matrix[row, int((info.pose.position.y + info.length_y / 2 - y) / info.resolution)]


@pytest.mark.parametrize("ending", READERS)
def test_grid_map_finds_every_layer_at_every_place(tmp_path, ending):
    path = write_grid_map(tmp_path / f"floor{ending}", GRID_MAP_LAYERS, GRID, observed(), stamp_s=12.5)
    (found,) = READERS[ending](path)
    assert found.topic == "/grid_map"
    message, info = found.message, found.message.info
    header = info.header if ending == ".bag" else message.header
    assert (header.frame_id, found.time_ns, info.resolution) == ("map", 12_500_000_000, 0.25)
    assert (info.length_x, info.length_y) == (1.25, 0.75)
    assert (info.pose.position.x, info.pose.position.y) == (-1.5 + 0.625, 2.0 + 0.375)
    assert info.pose.orientation.w == 1.0
    assert (message.outer_start_index, message.inner_start_index) == (0, 0)
    assert (list(message.layers), list(message.basic_layers)) == (list(GRID_MAP_LAYERS), ["mean"])
    xs, ys = GRID.centers_m()
    for values, layer in zip(message.data, GRID_MAP_LAYERS.values(), strict=True):
        at_centers = [[grid_map_at(info, values, x, y) for y in ys] for x in xs]
        np.testing.assert_array_equal(at_centers, np.where(observed(), layer, np.nan).astype(np.float32))


def test_the_matrices_are_labelled_as_grid_map_labels_eigens_and_ros_1_knows_the_message_by_its_checksum(tmp_path):
    (found,) = READERS[".bag"](write_grid_map(tmp_path / "floor.bag", GRID_MAP_LAYERS, GRID))
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
def test_a_map_that_no_recording_can_hold_leaves_no_file(tmp_path, write, name, arguments, options, says):
    with pytest.raises(BadInput, match=says):
        write(tmp_path / name, *arguments, **options)
    assert list(tmp_path.iterdir()) == []
