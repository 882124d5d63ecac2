"""``bayesmap export``: a saved run as a map for nav2's map_server."""

from __future__ import annotations

from pathlib import Path

import click

from bayesmap.cli.command import Call, takes
from bayesmap.errors import BadInput
from bayesmap.version import __version__


@takes("export")
@click.argument("run_file", metavar="RUN.nc")
@click.option("-o", "--output", metavar="MAP.yaml", help="The YAML file. [default: map.yaml beside RUN.nc]")
def command(call: Call, run_file: str, output: str | None) -> None:
    """Write the map of a saved run as nav2 and map_server read it: a YAML file, and an image beside it.

    Cells that no beam reached are unknown. With --mode scale nav2 reads probabilities in per cent; where some cells are
    unknown the image is a PNG, since a PGM has no transparency. An older map of the same name is replaced.
    """
    import numpy as np

    from bayesmap.run import load

    target = Path(output) if output else Path(run_file).with_name("map.yaml")
    if not target.parent.is_dir():
        raise BadInput(f"{target.parent}: no such folder; make it first, or choose another with -o")
    run = load(run_file)
    if np.isnan(run.occupancy).any():
        raise BadInput(f"{run_file}: the run has no draws yet; go on with it by bayesmap infer --resume")
    outputs = run.export(target, **call.values())
    document = {"version": __version__, "run": run_file, "outputs": {path.name: str(path) for path in outputs}}
    call.talk.result(document, outputs)
