"""What saved runs of all formats have in common."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import ArraySpec
from bayesmap.cells.draws import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.io.saved_arrays import read_draws
from bayesmap.model import POSES
from bayesmap.posterior.posterior import Posterior
from bayesmap.samplers.sampler import Snapshot
from bayesmap.sensors.describe import from_description
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans


def assemble(
    file: Any,
    header: dict[str, Any],
    prior: CellPrior,
    snapshot: Snapshot,
    *,
    specs: tuple[ArraySpec, ...] | None = None,
    index: Mapping[str, NDArray[np.int32]] | None = None,
    statistics: Mapping[str, NDArray[np.float64]],
) -> Posterior:
    """The posterior of an open file of any format, but for what formats keep in different places."""
    grid = Grid(tuple(header["grid"]["shape"]), header["grid"]["resolution"], tuple(header["grid"]["origin"]))
    draws, stats, constant = file["posterior"], file["sample_stats"], file["constant_data"]
    # Earlier versions had fewer arrays.
    specs = tuple(spec for spec in prior.arrays if spec.name in draws.variables) if specs is None else specs
    if POSES.name in draws.variables:
        specs = (*specs, POSES)
    if index is None:
        some = {dim for spec in specs for dim in spec.dims} - {"x", "y"}
        index = {dim: _numbers(draws, dim, grid) for dim in sorted(some)}
    empty = Draws(grid, specs, {}, index)
    arrays = {spec.name: read_draws(draws[spec.name], spec, empty.shape_of(spec)) for spec in specs}
    described = header["settings"]["sensor"] if header.get("sensor") is None else header["sensor"]
    return Posterior(
        scans=_scans_from(file, header),
        sensor=from_description(described),
        prior=prior,
        settings=header["settings"],
        draws=Draws(grid, specs, arrays, index),
        occupancy=constant["occupancy"][:],
        observed=constant["observed"][:] != 0,
        log_likelihood=stats["log_likelihood"][:],
        log_prior=stats["log_prior"][:],
        warmup_log_joint=file["warmup_sample_stats"]["lp"][:],
        snapshot=snapshot,
        finished=header["finished"],
        seconds=header["seconds"],
        counts=header["counts"],
        log_weights=_optional(constant, "log_weight"),
        statistics=statistics,
        log_evidence=header.get("log_evidence"),
        notes=tuple(header["notes"]),
    )


def _numbers(draws: Any, dimension: str, grid: Grid) -> NDArray[np.int32]:
    """What a dimension counts: cells by their flat indices, or others by their numbers."""
    if dimension.endswith("cell"):
        return flat_index(draws[f"{dimension}_x"][:], draws[f"{dimension}_y"][:], grid)
    return np.asarray(draws[dimension][:], dtype=np.int32)


def flat_index(x: NDArray[Any], y: NDArray[Any], grid: Grid) -> NDArray[np.int32]:
    """Flat indices of cells."""
    return np.asarray(x * grid.shape[1] + y, dtype=np.int32)


def _optional(constant: Any, name: str) -> NDArray[np.float64] | None:
    return constant[name][:] if name in constant.variables else None


def _scans_from(file: Any, header: dict[str, Any]) -> Scans:
    """What was conditioned on."""
    constant = file["constant_data"]
    return Scans(
        poses=constant["pose_world"][:],
        angles_rad=constant["angle_rad"][:],
        ranges_m=file["observed_data"]["range_m"][:],
        min_range_m=header["limits"][0],
        max_range_m=header["limits"][1],
        stamps_s=_optional(constant, "stamp_s"),
        beam_poses=_optional(constant, "beam_pose_world"),
        own_angles_rad=_optional(constant, "own_angle_rad"),
    )
