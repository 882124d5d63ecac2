"""``bayesmap export``: a saved run as a file that robots, and other programs, read."""

from __future__ import annotations

from pathlib import Path

import click

from bayesmap.cli.command import Call, takes
from bayesmap.errors import BadInput
from bayesmap.version import __version__


@takes("export")
@click.argument("run_file", metavar="RUN.nc")
@click.option("-o", "--output", metavar="FILE", help="Its ending chooses the format. [default: map.yaml beside RUN.nc]")
@click.option("--force", is_flag=True, help="Replace an existing file, or the folder of a bag.")
def command(call: Call, run_file: str, output: str | None, force: bool) -> None:
    r"""Write the map of a saved run, or its trajectory, for robots and other programs.

    Cells that no beam reached are unknown.

    \b
    .yaml               map_server: YAML and image (--mode trinary, scale, raw)
    .bag, .mcap, .db3   occupancy grid in a recording, ROS 1 or 2; a name
                        without ending is a ROS 2 bag's folder;
                        --format gridmap: all layers, as grid_map has them
    .tif                GeoTIFF, a band a layer (needs bayesmap[geotiff])
    .rrd                layers and scans for rerun (needs bayesmap[rerun])
    .tum                the poses, as evo reads them; covariances beside them
    .g2o                the poses as a graph with information matrices
    --format trajectory nav_msgs/Path, and PoseWithCovarianceStamped, in a
                        recording

    The layers are mean, entropy and, where a cell's state is a number, the bounds of its 90 % interval.
    """
    import numpy as np

    from bayesmap.io.exports import existing
    from bayesmap.result import load

    values = call.values()
    values["format"] = None if values["format"] == "auto" else values["format"]
    target = output or str(Path(run_file).with_name("map.yaml"))
    there = existing(target, values["format"])
    if there is not None and not force:
        raise BadInput(f"{there}: exists already; --force replaces it, -o takes another name")
    if not Path(target).parent.is_dir():
        raise BadInput(f"{Path(target).parent}: no such folder; make it first, or choose another with -o")
    run = load(run_file)
    if np.isnan(run.occupancy).any():
        raise BadInput(f"{run_file}: the run has no draws yet; go on with it by bayesmap infer --resume")
    outputs = run.export(target, **values)
    document = {"version": __version__, "run": run_file, "outputs": {path.name: str(path) for path in outputs}}
    call.console.result(document, outputs)
