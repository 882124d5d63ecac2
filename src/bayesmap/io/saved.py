"""The saved posterior: one netCDF-4 file in the arviz layout, that opens in arviz and xarray anywhere.

Groups: ``posterior`` (walls by chain, draw, x, y), ``sample_stats`` (log joint and its parts), ``observed_data``
(ranges), ``constant_data`` (poses, angles, marginals, where the chains stand), ``warmup_sample_stats``. Settings, grid
and timings are attributes of the root, as JSON. Draws are stored as deflated bytes, 0 or 1, so that any reader sees
plain arrays; a checksum over all of it tells a damaged file from a whole one.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.packing import pack, unpack
from bayesmap.errors import BadInput
from bayesmap.io.atomic import write_whole
from bayesmap.io.checksum import checksum_of
from bayesmap.posterior.field import FieldPosterior
from bayesmap.posterior.posterior import Posterior
from bayesmap.sensors.describe import from_description
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans
from bayesmap.version import __version__

FORMAT = "bayesmap run"
FORMAT_VERSION = 3  # 2 has fields too, 3 their expected reflectivities; walls are written as in 1
CHUNK_BYTES = 16 << 20  # of draws that are unpacked, and compressed, at a time


def save(
    posterior: Posterior,
    path: str | os.PathLike[str],
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> None:
    """Write a posterior, whole or not at all.

    Args:
        posterior: what to write.
        path: where.
        on_progress: told how many of all draws have been written.

    Raises:
        BadInput: the folder cannot be written to.
    """
    with write_whole(Path(path)) as partial, netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
        _write(posterior, file, on_progress)


def _write(posterior: Posterior, file: Any, on_progress: Callable[[int, int], None]) -> None:
    grid, scans = posterior.grid, posterior.scans
    chains, draws, _ = posterior.packed.shape
    nx, ny = grid.shape
    x, y = grid.centers_m()
    header = {
        "settings": posterior.settings,
        "grid": {"shape": grid.shape, "resolution": grid.resolution, "origin": grid.origin},
        "limits": [scans.min_range_m, scans.max_range_m],
        "seconds": posterior.seconds,
        "counts": posterior.counts,
        "sweep": posterior.sweep,
        "finished": posterior.finished,
        "log_evidence": posterior.log_evidence,
        "notes": posterior.notes,
    }
    file.setncatts(
        {
            "format": FORMAT,
            "format_version": FORMAT_VERSION,
            "inference_library": "bayesmap",
            "inference_library_version": __version__,
            "bayesmap": json.dumps(header),
            "checksum": _checksum(posterior, header),
        }
    )
    group = file.createGroup("posterior")
    sizes = {"chain": chains, "draw": draws, "x": nx, "y": ny}
    for name, size in sizes.items():
        group.createDimension(name, size)
    for name, values in (("chain", np.arange(chains)), ("draw", np.arange(draws)), ("x", x), ("y", y)):
        group.createVariable(name, values.dtype, (name,))[:] = values
    at_once = _draws_at_once(grid)
    walls = group.createVariable(
        "walls", "i1", tuple(sizes), zlib=True, complevel=1, shuffle=False,
        chunksizes=(1, max(1, min(draws, at_once)), nx, ny),
    )  # fmt: skip
    walls.setncatts({"dtype": "bool", "long_name": "wall in this cell"})
    for chain in range(chains):
        for i in range(0, draws, at_once):
            walls[chain, i : i + at_once] = unpack(posterior.packed[chain, i : i + at_once], grid.shape).view(np.int8)
            on_progress(chain * draws + min(i + at_once, draws), chains * draws)

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
    write_arrays(constant, ("chain", "cell"), state=posterior.walls)
    if posterior.log_weights is not None:
        write_arrays(constant, ("particle",), log_weight=posterior.log_weights)
    if posterior.belief_changes is not None:
        write_arrays(constant, ("round",), belief_change=posterior.belief_changes)


def _draws_at_once(grid: Grid) -> int:
    return max(1, CHUNK_BYTES // grid.n_cells)


def write_scans(file: Any, scans: Scans) -> Any:
    """Write what was conditioned on; the group of constants, for more of them."""
    write_arrays(file.createGroup("observed_data"), ("scan", "beam"), range_m=scans.ranges_m)
    constant = file.createGroup("constant_data")
    write_arrays(constant, ("scan", "pose_part"), pose_world=scans.poses)
    write_arrays(constant, ("beam",), angle_rad=scans.angles_rad)
    if scans.stamps_s is not None:
        write_arrays(constant, ("scan",), stamp_s=scans.stamps_s)
    if scans.beam_poses is not None:
        write_arrays(constant, ("scan", "beam", "pose_part"), beam_pose_world=scans.beam_poses)
    return constant


def write_arrays(group: Any, dimensions: tuple[str, ...], compressed: bool = True, **arrays: NDArray[Any]) -> None:
    """Write arrays of the same dimensions; dimensions that are new get the arrays' sizes."""
    for name, values in arrays.items():
        for dimension, size in zip(dimensions, values.shape, strict=True):
            if dimension not in group.dimensions:
                group.createDimension(dimension, size)
        group.createVariable(name, values.dtype, dimensions, zlib=compressed, complevel=1)[:] = values


def load_posterior(path: str | os.PathLike[str]) -> Posterior | FieldPosterior:
    """Read a posterior back.

    Raises:
        BadInput: no such file; not netCDF, or not a run of bayesmap's; a newer format; or damaged.
    """
    path = Path(path)
    if not path.is_file():
        raise BadInput(f"{path}: a folder; give the run.nc in it" if Path(path).is_dir() else f"{path}: no such file")
    posterior: Posterior | FieldPosterior
    try:
        with netCDF4.Dataset(path, "r") as file:
            file.set_auto_mask(False)
            attributes = {name: file.getncattr(name) for name in file.ncattrs()}
            stranger = _stranger(attributes)
            if stranger is None:
                header = json.loads(attributes["bayesmap"])
                if "cells" in header:
                    from bayesmap.io import saved_field

                    field = saved_field.read_field(file, header)
                    posterior, found = field, saved_field.checksum(field, header)
                else:
                    posterior = walls = _read(file, header)
                    found = _checksum(walls, header)
                whole = found == attributes["checksum"]
    except (ArithmeticError, AttributeError, LookupError, OSError, RuntimeError, TypeError, ValueError) as error:
        raise BadInput(f"{path}: not a readable saved run; damaged or truncated? ({error})") from None
    if stranger is not None:
        raise BadInput(f"{path}: {stranger}")
    if not whole:
        raise BadInput(f"{path}: the saved run is damaged (its checksum does not match); use a backup or run again")
    return posterior


def _stranger(attributes: dict[str, Any]) -> str | None:
    """Why a sound netCDF file is not one that we can read, or None."""
    if attributes.get("format") != FORMAT:
        return "a netCDF file, but not a saved run of bayesmap's"
    version = int(attributes["format_version"])
    if version <= FORMAT_VERSION:
        return None
    return (
        f"saved by bayesmap {attributes.get('inference_library_version')}, in a newer format ({version}) "
        f"than this version reads ({FORMAT_VERSION}); update bayesmap"
    )


def _read(file: Any, header: dict[str, Any]) -> Posterior:
    grid = Grid(tuple(header["grid"]["shape"]), header["grid"]["resolution"], tuple(header["grid"]["origin"]))
    walls = file["posterior"]["walls"]
    chains, draws = walls.shape[:2]
    at_once = _draws_at_once(grid)
    packed = np.zeros((chains, draws, (grid.n_cells + 7) // 8), dtype=np.uint8)
    for chain in range(chains):
        for i in range(0, draws, at_once):
            packed[chain, i : i + at_once] = pack(walls[chain, i : i + at_once] != 0)
    stats, constant = file["sample_stats"], file["constant_data"]

    def optional(name: str) -> NDArray[np.float64] | None:
        return constant[name][:] if name in constant.variables else None

    return Posterior(
        grid=grid,
        scans=scans_from(file, header),
        sensor=from_description(header["settings"]["sensor"]),
        settings=header["settings"],
        occupancy=constant["occupancy"][:],
        observed=constant["observed"][:] != 0,
        packed=packed,
        log_likelihood=stats["log_likelihood"][:],
        log_prior=stats["log_prior"][:],
        warmup_log_joint=file["warmup_sample_stats"]["lp"][:],
        walls=constant["state"][:],
        sweep=header["sweep"],
        finished=header["finished"],
        seconds=header["seconds"],
        counts=header["counts"],
        log_weights=optional("log_weight"),
        belief_changes=optional("belief_change"),
        log_evidence=header["log_evidence"],
        notes=tuple(header["notes"]),
    )


def scans_from(file: Any, header: dict[str, Any]) -> Scans:
    """What was conditioned on."""
    constant = file["constant_data"]

    def optional(name: str) -> NDArray[np.float64] | None:
        return constant[name][:] if name in constant.variables else None

    return Scans(
        poses=constant["pose_world"][:],
        angles_rad=constant["angle_rad"][:],
        ranges_m=file["observed_data"]["range_m"][:],
        min_range_m=header["limits"][0],
        max_range_m=header["limits"][1],
        stamps_s=optional("stamp_s"),
        beam_poses=optional("beam_pose_world"),
    )


def _checksum(posterior: Posterior, header: dict[str, Any]) -> str:
    scans = posterior.scans
    arrays = (
        posterior.packed, posterior.log_likelihood, posterior.log_prior, posterior.warmup_log_joint, posterior.walls,
        posterior.occupancy, posterior.observed, scans.poses, scans.angles_rad, scans.ranges_m,
        posterior.log_weights, posterior.belief_changes, scans.stamps_s, scans.beam_poses,
    )  # fmt: skip
    return checksum_of(json.dumps(header, sort_keys=True), arrays)
