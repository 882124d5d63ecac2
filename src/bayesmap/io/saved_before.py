"""Saved runs of formats 1 to 3, in which walls and reflectivities had files of their own.

1 has walls alone; 2 has reflectivities and surfaces, too; 3 their expected reflectivities. Such runs can be looked at,
scored and exported, but not resumed: their random numbers were others.
"""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.binary import Independent
from bayesmap.cells.kinds import prior_from
from bayesmap.cells.reflectivity import EXPECTED
from bayesmap.cells.surface import PARTS
from bayesmap.io.checksum import checksum_of
from bayesmap.io.saved_content import assemble, flat_index
from bayesmap.posterior.posterior import Posterior
from bayesmap.samplers.sampler import Snapshot
from bayesmap.space.grid import Grid

UNKNOWN_PRIOR = 0.5
"""Of walls with a probability for each cell, which these formats do not hold. Nothing is computed from it."""


def read(file: Any, header: dict[str, Any]) -> tuple[Posterior, str]:
    """The posterior of an open file, and its checksum."""
    return _read_walls(file, header) if "cells" not in header else _read_reflectivities(file, header)


def _read_walls(file: Any, header: dict[str, Any]) -> tuple[Posterior, str]:
    p_wall = header["settings"]["prior"]["p_wall"]
    constant = file["constant_data"]
    changes = {"belief_changes": constant["belief_change"][:]} if "belief_change" in constant.variables else {}
    state = constant["state"][:]
    posterior = assemble(
        file,
        header,
        Independent(UNKNOWN_PRIOR if isinstance(p_wall, str) else p_wall),
        Snapshot(header["sweep"], {"walls": state} if header["sweep"] else {}),
        statistics=changes,
    )
    scans = posterior.scans
    arrays = (
        posterior.draws.arrays["walls"], posterior.log_likelihood, posterior.log_prior, posterior.warmup_log_joint,
        state, posterior.occupancy, posterior.observed, scans.poses, scans.angles_rad, scans.ranges_m,
        posterior.log_weights, changes.get("belief_changes"), scans.stamps_s, scans.beam_poses,
    )  # fmt: skip
    return posterior, checksum_of(json.dumps(header, sort_keys=True), arrays)


def _read_reflectivities(file: Any, header: dict[str, Any]) -> tuple[Posterior, str]:
    draws, constant = file["posterior"], file["constant_data"]
    grid = Grid(tuple(header["grid"]["shape"]), header["grid"]["resolution"], tuple(header["grid"]["origin"]))
    touched, place = flat_index(draws["cell_x"][:], draws["cell_y"][:], grid), draws["surface_of"][:]
    prior = prior_from(header["prior"])
    has_expected = "expected" in draws.variables
    # Where there are no expected reflectivities the drawn ones take their place.
    present = tuple(spec for spec in prior.arrays if spec.name in draws.variables)
    state = {name: constant[name][:] for name in ("state", "last_counts", "informed")}
    posterior = assemble(
        file,
        header,
        prior,
        Snapshot(header["sweep"], {"state": state["state"]}),
        specs=present,
        index={"cell": touched} | ({"surface_cell": touched[place]} if prior.has_surfaces else {}),
        statistics={},
    )
    arrays = posterior.draws.arrays
    if not has_expected:
        specs = tuple(spec for spec in prior.arrays if spec in present or spec == EXPECTED)
        whole = replace(posterior.draws, specs=specs, arrays={**arrays, "expected": arrays["reflectivity"]})
        posterior = replace(posterior, draws=whole)
    scans = posterior.scans
    by_cell = [arrays[name] for name in ("reflectivity", "expected") if name in arrays]
    hashed = (
        touched, place, *by_cell, _surfaces(draws, arrays), posterior.log_likelihood, posterior.log_prior,
        posterior.warmup_log_joint, *state.values(), posterior.occupancy, posterior.observed, scans.poses,
        scans.angles_rad, scans.ranges_m, scans.stamps_s, scans.beam_poses,
    )  # fmt: skip
    return posterior, checksum_of(json.dumps(header, sort_keys=True), hashed)


def _surfaces(draws: Any, arrays: Any) -> NDArray[np.float16]:
    """All parts of the surfaces together, as these formats' checksums take them."""
    if "surface_l11" in arrays:
        return np.stack([arrays[f"surface_{part}"] for part in PARTS], axis=-1)
    return np.zeros((*draws["surface_l11"].shape, len(PARTS)), dtype=np.float16)
