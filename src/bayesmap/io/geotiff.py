"""Maps as GeoTIFF, one band a layer: what QGIS, GDAL and rasterio read. Needs the extra ``geotiff`` (rasterio).

Row 0 is the top (largest y). The affine transform takes (column, row) to metres of the map frame, from the upper-left
corner of the upper-left cell. The frame of a robot's map is nowhere on Earth, so no coordinate reference system is
written; a program that asks for one may be told any that counts in metres.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.io.layers import as_layers
from bayesmap.space.grid import Grid


def write_geotiff(
    path: str | os.PathLike[str],
    layers: Mapping[str, ArrayLike],
    grid: Grid,
    observed: ArrayLike | None = None,
) -> Path:
    """Write the layers of a map as bands of a GeoTIFF in single precision, whole or not at all.

    Args:
        path: the file to write.
        layers: by name, which describes the band; each of shape (nx, ny), NaN where unknown.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); the others are NaN, which is the bands' nodata value.

    Returns:
        The path.

    Raises:
        BadInput: rasterio is not installed, no layer, shapes that do not fit, infinite numbers, or a file that cannot
            be written.
    """
    try:
        from rasterio.io import MemoryFile  # type: ignore[import-untyped, import-not-found, unused-ignore]
        from rasterio.transform import Affine  # type: ignore[import-untyped, import-not-found, unused-ignore]
    except ImportError:
        raise BadInput(f"{path}: GeoTIFF needs rasterio: pip install 'bayesmap[geotiff]'") from None

    checked = as_layers(layers, grid, observed)
    x0, _, _, y1 = grid.extent_m
    target = Path(path)
    # In memory first: GDAL only prints what goes wrong on a full disk.
    with write_whole(target) as partial, MemoryFile() as memory:
        with memory.open(
            driver="GTiff",
            width=grid.shape[0],
            height=grid.shape[1],
            count=len(checked),
            dtype="float32",
            nodata=float("nan"),
            transform=Affine(grid.resolution, 0.0, x0, 0.0, -grid.resolution, y1),
            compress="deflate",
            interleave="band",
        ) as file:
            for band, (name, values) in enumerate(checked.items(), start=1):
                file.write(values.T[::-1], band)
                file.set_band_description(band, name)
        partial.write_bytes(memory.getbuffer())
    return target
