import os
from typing import get_args

import numpy as np
import pytest
from map_case import BinaryRun, ReflectivityRun, observed, occupancy, scans
from recorded import READERS

from bayesmap.cli.keys import Export
from bayesmap.errors import BadInput
from bayesmap.io.exports import FORMATS, existing, export_format, export_run, layers_of

NEEDS = {"geotiff": "rasterio", "rerun": "rerun"}


@pytest.mark.parametrize(
    ("path", "format"),
    [
        ("map.yaml", "map-server"), ("map.YML", "map-server"), ("map.bag", "occupancy-grid"),
        ("map.mcap", "occupancy-grid"), ("map.db3", "occupancy-grid"), ("map", "occupancy-grid"),
        ("map.d" + os.sep, "occupancy-grid"), ("map.rrd", "rerun"), ("map.tum", "tum"), ("map.tif", "geotiff"),
        ("map.tiff", "geotiff"),
    ],
)  # fmt: skip
def test_the_ending_chooses_the_format(path, format):
    assert export_format(path) == format


def test_a_named_format_wins_and_the_command_line_knows_the_same():
    assert export_format("map.mcap", "gridmap") == "gridmap"
    assert export_format("poses.txt", "tum") == "tum"
    assert ("auto", *FORMATS) == get_args(Export)


@pytest.mark.parametrize("path", ["map.txt", "map.pgm", "map.2024"])
def test_an_unknown_ending_is_told_the_known_ones(path):
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
    assert existing(target) == target
    assert export_run(target, BinaryRun(), scans()) == outputs
    assert outputs[0] == target
    assert set(tmp_path.iterdir()) == set(outputs)


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
