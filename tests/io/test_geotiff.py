import builtins
import zlib

import numpy as np
import pytest
from map_case import GRID, observed, occupancy
from PIL import Image

from bayesmap.errors import BadInput
from bayesmap.io.layers import write_geotiff

LAYERS = {"mean": occupancy(), "entropy": 1 - occupancy()}


def expected(values):
    """Rows from the top, NaN where no beam reached."""
    return np.where(observed(), values, np.nan).T[::-1].astype(np.float32)


def test_rasterio_finds_every_value_at_its_place(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    path = write_geotiff(tmp_path / "floor.tif", LAYERS, GRID, observed())
    with rasterio.open(path) as file:
        assert file.descriptions == ("mean", "entropy")
        assert file.dtypes == ("float32", "float32")
        assert np.isnan(file.nodata)
        assert tuple(file.bounds) == (-1.5, 2.0, -0.25, 2.75)
        assert file.crs is None
        places = [(x, y) for x in GRID.centers_m()[0] for y in GRID.centers_m()[1]]
        found = np.array(list(file.sample(places))).reshape(5, 3, 2)
        np.testing.assert_array_equal(file.read_masks(1), np.where(np.isnan(expected(occupancy())), 0, 255))
    for band, values in enumerate(LAYERS.values()):
        np.testing.assert_array_equal(found[..., band], np.where(observed(), values, np.nan).astype(np.float32))


def test_the_same_without_the_library_that_wrote_it(tmp_path):
    """Pillow reads the tags, zlib the strips."""
    pytest.importorskip("rasterio")
    path = write_geotiff(tmp_path / "floor.tif", LAYERS, GRID, observed())
    with open(path, "rb") as file:
        assert file.read(4) in (b"II*\0", b"MM\0*")
    content = path.read_bytes()
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


def test_without_rasterio_the_remedy_is_named(tmp_path, monkeypatch):
    real = builtins.__import__

    def absent(name, *rest, **named):
        if name.split(".")[0] == "rasterio":
            raise ImportError(name)
        return real(name, *rest, **named)

    monkeypatch.setattr(builtins, "__import__", absent)
    with pytest.raises(BadInput, match=r"pip install 'bayesmap\[geotiff\]'"):
        write_geotiff(tmp_path / "floor.tif", LAYERS, GRID)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_not_there_is_named(tmp_path):
    pytest.importorskip("rasterio")
    with pytest.raises(BadInput, match="cannot be written"):
        write_geotiff(tmp_path / "nowhere" / "floor.tif", LAYERS, GRID)
