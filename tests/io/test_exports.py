"""Exports: endings and formats; GeoTIFF by rasterio and without it; recordings for rerun by rerun's own reader."""

import builtins
import os
import zlib
from typing import get_args

import numpy as np
import pytest
from PIL import Image
from recorded import GRID, READERS, BinaryRun, ReflectivityRun, observed, occupancy, scans

from bayesmap.cli.keys import Export
from bayesmap.errors import BadInput
from bayesmap.io import exports
from bayesmap.io.exports import existing, export_format, export_run, layers_of, write_geotiff, write_rerun
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
    assert existing(target) is None
    outputs = export_run(target, BinaryRun(), scans())
    assert (existing(target), export_run(target, BinaryRun(), scans())) == (target, outputs)
    assert (outputs[0], set(tmp_path.iterdir())) == (target, set(outputs))


def test_an_image_that_would_be_replaced_counts_as_existing(tmp_path):
    (tmp_path / "map.pgm").write_text("another map's")
    assert existing(tmp_path / "map.yaml") == tmp_path / "map.pgm"
    assert existing(tmp_path / "map.mcap") is None
    (tmp_path / "folder").mkdir()
    assert existing(tmp_path / "folder") is None


class Refusing(BinaryRun):
    def interval(self, level):
        raise BadInput("walls have none")


def test_walls_have_no_interval_and_reflectivities_do(tmp_path):
    assert list(layers_of(BinaryRun())) == list(layers_of(Refusing())) == ["mean", "entropy"]
    (path,) = export_run(tmp_path / "m.mcap", ReflectivityRun(), scans(), format="gridmap")
    (found,) = READERS[".mcap"](path)
    assert list(found.message.layers) == ["mean", "entropy", "lower", "upper"]
    assert found.time_ns == 103_000_000_000  # of the last scan
    lower = np.array(found.message.data[2].data, dtype=np.float32).reshape(3, 5).T[::-1, ::-1]
    np.testing.assert_array_equal(lower, np.where(observed(), occupancy() / 2, np.nan).astype(np.float32))


def test_recordings_are_in_per_cent_and_yaml_is_trinary_unless_told(tmp_path):
    for options, values in (({}, {-1, 1, 6, 11, 21}), ({"mode": "trinary"}, {-1, 0, 100})):
        (path,) = export_run(tmp_path / "m.mcap", BinaryRun(), scans(), **options)
        assert values <= set(READERS[".mcap"](path)[0].message.data)
    assert "mode: trinary" in export_run(tmp_path / "m.yaml", BinaryRun(), scans())[0].read_text()
    assert "mode: raw" in export_run(tmp_path / "m.yaml", BinaryRun(), scans(), mode="raw")[0].read_text()


@pytest.mark.parametrize("option", [{"mode": "scale"}, {"free_thresh": 0.1}, {"occupied_thresh": 0.9}])
@pytest.mark.parametrize(("path", "format"), [("m.tif", None), ("m.tum", None), ("m.rrd", None), ("m.bag", "gridmap")])
def test_formats_that_keep_the_numbers_take_no_thresholds(tmp_path, path, format, option):
    with pytest.raises(BadInput, match=f"takes no {next(iter(option))}; leave it out, or choose map-server"):
        export_run(tmp_path / path, BinaryRun(), scans(), format=format, **option)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_none_is_named(tmp_path, name):
    (tmp_path / "file").write_text("no folder")
    for folder in (tmp_path / "file", tmp_path / "nowhere"):
        with pytest.raises(BadInput, match="cannot be written"):
            export_run(folder / name, BinaryRun(), scans())
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


LAYERS = {"mean": occupancy(), "entropy": 1 - occupancy()}


def expected(values):
    """Rows from the top, NaN where no beam reached."""
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
    """Every column of the recording, by entity and component, as lists of rows."""
    chunk = pytest.importorskip("rerun.chunk")
    found = {}
    for piece in chunk.RrdReader(path).stream():
        batch = piece.to_record_batch()
        for name, column in zip(batch.schema.names, batch.columns, strict=True):
            found.setdefault((piece.entity_path, name), []).extend(column.to_pylist())
    return found


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
        np.testing.assert_array_equal((picture == exports.UNKNOWN_COLOR).all(axis=-1), ~seen)


def test_scans_lie_on_the_picture_at_their_numbers_and_times(tmp_path):
    log = scans()
    columns = columns_of(write_rerun(tmp_path / "floor.rrd", LAYERS, GRID, scans=log))
    at = find(columns, "/sensor", "Points2D:positions")
    np.testing.assert_allclose(np.concatenate(at), exports.to_pixels(log.poses[:, :2], GRID), atol=1e-6)
    ends = find(columns, "/scan", "Points2D:positions")
    assert [len(points) for points in ends] == [1, 2, 0]
    np.testing.assert_allclose(np.concatenate(ends[:2]), exports.to_pixels(log.hit_points_world(), GRID), atol=1e-6)
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
        assert len(types) == (kind is not None)
        assert all(kind in text for text in types)


def test_a_trajectory_is_drawn_with_its_ellipses(tmp_path):
    poses = np.array([[-1.0, 2.2, 0.0], [-0.5, 2.6, 1.0]])
    covariances = np.stack([np.diag([0.01, 0.04, 0.01]), np.diag([0.01, 0.01, 0.01])])
    there = Trajectory(poses, covariances=covariances)
    columns = columns_of(write_rerun(tmp_path / "walk.rrd", LAYERS, GRID, trajectory=there))
    ((line,),) = find(columns, "/trajectory", "LineStrips2D:strips")
    np.testing.assert_allclose(line, exports.to_pixels(poses[:, :2], GRID), rtol=1e-6)
    (outlines,) = find(columns, "/ellipses", "LineStrips2D:strips")
    assert len(outlines) == 2
    width, height = np.ptp(np.array(outlines[0]), axis=0)
    assert height / width == pytest.approx(2.0, rel=0.02)


@pytest.mark.parametrize(
    ("library", "extra", "write"), [("rasterio", "geotiff", write_geotiff), ("rerun", "rerun", write_rerun)]
)
def test_without_the_library_the_remedy_is_named(tmp_path, monkeypatch, library, extra, write):
    real = builtins.__import__

    def absent(name, *rest, **named):
        if name.split(".")[0] == library:
            raise ImportError(name)
        return real(name, *rest, **named)

    monkeypatch.setattr(builtins, "__import__", absent)
    with pytest.raises(BadInput, match=rf"pip install 'bayesmap\[{extra}\]'"):
        write(tmp_path / "floor", LAYERS, GRID)
    assert list(tmp_path.iterdir()) == []
