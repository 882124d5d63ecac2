"""A saved field: the same kind of netCDF file as `bayesmap.io.saved`, with reflectivities and surfaces by cell.

Cells that no beam touches are not in it: the dimension ``cell`` counts the touched ones, whose indices are in
``cell_x`` and ``cell_y``; ``surface_cell`` counts those with surfaces. Draws are kept in half precision, and written as
32-bit floats, whose last bits are zero and compress well. Files of format 2 have no ``expected`` reflectivities: the
drawn ones take their place.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.kind import prior_from
from bayesmap.cells.reflectivity import Reflective
from bayesmap.io.atomic import write_whole
from bayesmap.io.checksum import checksum_of
from bayesmap.io.half_draws import read_half, write_half
from bayesmap.io.saved import FORMAT, FORMAT_VERSION, scans_from, write_arrays, write_scans
from bayesmap.posterior.field import FieldPosterior
from bayesmap.sensors.describe import describe, from_description
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.space.grid import Grid
from bayesmap.version import __version__

SURFACE = ("mean_x", "mean_y", "l11", "l21", "l22")
"""What a surface is made of, as the file calls it."""


def save_field(
    posterior: FieldPosterior,
    path: str | os.PathLike[str],
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> None:
    """Write a posterior, whole or not at all.

    Args:
        posterior: what to write.
        path: where.
        on_progress: told how many of all numbers of the draws have been written.

    Raises:
        BadInput: the folder cannot be written to.
    """
    with write_whole(Path(path)) as partial, netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
        _write(posterior, file, on_progress)


def _counter(total: int, on_progress: Callable[[int, int], None]) -> Callable[[int], None]:
    """Adds up counts, and tells the sum."""
    done = 0

    def told(count: int) -> None:
        nonlocal done
        done += count
        on_progress(done, total)

    return told


def _write(posterior: FieldPosterior, file: Any, on_progress: Callable[[int, int], None]) -> None:
    grid, scans = posterior.grid, posterior.scans
    header = {
        "cells": posterior.kind,
        "settings": posterior.settings,
        "sensor": describe(posterior.sensor),
        "prior": posterior.prior.describe(),
        "grid": asdict(grid),
        "limits": [scans.min_range_m, scans.max_range_m],
        "seconds": posterior.seconds,
        "counts": posterior.counts,
        "sweep": posterior.sweep,
        "finished": posterior.finished,
        "notes": posterior.notes,
    }
    file.setncatts(
        {
            "format": FORMAT,
            "format_version": FORMAT_VERSION,
            "inference_library": "bayesmap",
            "inference_library_version": __version__,
            "bayesmap": json.dumps(header),
            "checksum": checksum(posterior, header),
        }
    )
    draws = file.createGroup("posterior")
    write_arrays(draws, ("cell",), cell_x=posterior.touched // grid.shape[1], cell_y=posterior.touched % grid.shape[1])
    by_cell = _by_cell(posterior)
    told = _counter(sum(values.size for values in by_cell.values()) + posterior.surfaces.size, on_progress)
    for name, values in by_cell.items():
        write_half(draws, name, ("chain", "draw", "cell"), values, told)
    write_arrays(draws, ("surface_cell",), surface_of=posterior.busy)
    for i, name in enumerate(SURFACE):
        write_half(draws, f"surface_{name}", ("chain", "draw", "surface_cell"), posterior.surfaces[..., i], told)
    write_arrays(
        file.createGroup("sample_stats"),
        ("chain", "draw"),
        lp=posterior.log_likelihood + posterior.log_prior,
        log_likelihood=posterior.log_likelihood,
        log_prior=posterior.log_prior,
    )
    write_arrays(file.createGroup("warmup_sample_stats"), ("chain", "draw"), lp=posterior.warmup_log_joint)
    constant = write_scans(file, scans)
    write_arrays(constant, ("x", "y"), occupancy=posterior.occupancy, observed=posterior.observed.astype(np.int8))
    # Random numbers to the last bit, and many of them at a checkpoint: compression would only take time.
    write_arrays(constant, ("chain", "cell", "state_part"), compressed=False, state=posterior.states)
    write_arrays(constant, ("informed_part", "cell"), informed=posterior.informed)
    write_arrays(constant, ("count_part", "chain", "cell"), last_counts=posterior.last_counts)


def _by_cell(posterior: FieldPosterior) -> dict[str, NDArray[np.float16]]:
    """What there is of every touched cell; a posterior from a file without ``expected`` has nothing else instead."""
    out = {"reflectivity": posterior.reflectivity}
    return out if posterior.expected is posterior.reflectivity else {**out, "expected": posterior.expected}


def read_field(file: Any, header: dict[str, Any]) -> FieldPosterior:
    """The posterior of an open file."""
    grid = Grid(tuple(header["grid"]["shape"]), header["grid"]["resolution"], tuple(header["grid"]["origin"]))
    draws, stats, constant = file["posterior"], file["sample_stats"], file["constant_data"]
    reflectivity = _read_draws(draws["reflectivity"])
    expected = _read_draws(draws["expected"]) if "expected" in draws.variables else reflectivity
    surfaces = np.empty((*draws["surface_l11"].shape, len(SURFACE)), dtype=np.float16)
    for i, name in enumerate(SURFACE):
        read_half(draws[f"surface_{name}"], surfaces[..., i])
    sensor, prior = from_description(header["sensor"]), prior_from(header["prior"])
    assert isinstance(prior, Reflective)
    assert isinstance(sensor, BeamMixture)
    return FieldPosterior(
        grid=grid,
        scans=scans_from(file, header),
        sensor=sensor,
        prior=prior,
        settings=header["settings"],
        touched=(draws["cell_x"][:] * grid.shape[1] + draws["cell_y"][:]).astype(np.int32),
        busy=draws["surface_of"][:],
        reflectivity=reflectivity,
        expected=expected,
        surfaces=surfaces,
        occupancy=constant["occupancy"][:],
        observed=constant["observed"][:] != 0,
        log_likelihood=stats["log_likelihood"][:],
        log_prior=stats["log_prior"][:],
        warmup_log_joint=file["warmup_sample_stats"]["lp"][:],
        states=constant["state"][:],
        last_counts=constant["last_counts"][:],
        informed=constant["informed"][:],
        sweep=header["sweep"],
        finished=header["finished"],
        seconds=header["seconds"],
        counts=header["counts"],
        notes=tuple(header["notes"]),
    )


def _read_draws(variable: Any) -> NDArray[np.float16]:
    out = np.empty(variable.shape, dtype=np.float16)
    read_half(variable, out)
    return out


def checksum(posterior: FieldPosterior, header: dict[str, Any]) -> str:
    """Of everything in the file."""
    scans = posterior.scans
    arrays = (
        posterior.touched, posterior.busy, *_by_cell(posterior).values(), posterior.surfaces, posterior.log_likelihood,
        posterior.log_prior, posterior.warmup_log_joint, posterior.states, posterior.last_counts, posterior.informed,
        posterior.occupancy, posterior.observed, scans.poses, scans.angles_rad, scans.ranges_m, scans.stamps_s,
        scans.beam_poses,
    )  # fmt: skip
    return checksum_of(json.dumps(header, sort_keys=True), arrays)
