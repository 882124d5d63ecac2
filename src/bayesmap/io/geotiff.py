"""Write layers of a map as a GeoTIFF. Its rows run from the top, the largest y."""

import os
from collections.abc import Mapping
from pathlib import Path

from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.space.grid import Grid, as_layers


def write_geotiff(
    path: str | os.PathLike[str], layers: Mapping[str, ArrayLike], grid: Grid, observed: ArrayLike | None = None
) -> Path:
    """Write layers (see `as_layers`) as bands of a GeoTIFF, whole or not at all. Returns the path.
    Cells that no beam reached are NaN, which is the bands' nodata value. Raises `BadInput` if rasterio is not
    installed, for layers that do not fit, or a file that cannot be written.
    """
    try:
        from rasterio.io import MemoryFile  # type: ignore[import-untyped, import-not-found, unused-ignore]
        from rasterio.transform import Affine  # type: ignore[import-untyped, import-not-found, unused-ignore]
    except ImportError:
        raise BadInput(f"{path}: GeoTIFF needs rasterio: pip install 'bayesmap[geotiff]'") from None

    checked = as_layers(grid, layers, observed)
    x0, _, _, y1 = grid.extent_m
    target = Path(path)
    # The file is made in memory first, because GDAL only prints errors of a full disk.
    with write_whole(target) as partial, MemoryFile() as memory:
        with memory.open(
            driver="GTiff", width=grid.shape[0], height=grid.shape[1], count=len(checked), dtype="float32",
            nodata=float("nan"), transform=Affine(grid.resolution, 0.0, x0, 0.0, -grid.resolution, y1),
            compress="deflate", interleave="band",
        ) as file:  # fmt: skip
            for band, (name, values) in enumerate(checked.items(), start=1):
                file.write(values.T[::-1], band)
                file.set_band_description(band, name)
        partial.write_bytes(memory.getbuffer())
    return target
