"""The approximation of a trajectory (`bayesmap.poses.trajectory`) in a saved run: arrays by name, and a few numbers.

All that the approximation was made from is kept: covariances of relative poses and draws are computed when they are
asked for.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.calibration import MotionNoise, OdometryFit
from bayesmap.poses.graph import Factors
from bayesmap.poses.pose_gaussian import PoseGaussian
from bayesmap.poses.prior import Odometry
from bayesmap.poses.trajectory import NO_ALTERNATIVES, Alternatives, Calibration, LoopClosures, Trajectory

VECTOR, MATRIX = ("pose_part",), ("pose_part", "other_pose_part")

FIELDS: dict[str, tuple[str, ...]] = {
    "poses": ("scan", *VECTOR), "stamps_s": ("scan",), "nearest_key": ("scan",), "own_covariance": ("scan", *MATRIX),
    "explained": ("scan",), "flagged": ("scan",), "order": ("scan",), "keys": ("key",), "breaks": ("break",),
    "leaps": ("leap",),
}  # fmt: skip
"""Arrays of the trajectory itself, with their dimensions."""

PARTS: dict[str, dict[str, tuple[str, ...]]] = {
    "gaussian": {
        "poses": ("key", *VECTOR), "first": ("pair",), "second": ("pair",), "relative": ("pair", *VECTOR),
        "curvature": ("pair", *MATRIX), "force": ("pair", *VECTOR), "elsewhere": ("alternative", "key", *VECTOR),
    },
    "alternatives": {
        "first": ("alternative",), "last": ("alternative",), "probabilities": ("alternative",),
        "poses": ("alternative", "key", *VECTOR),
    },
    "closures": {
        "first": ("closure",), "second": ("closure",), "relative": ("closure", *VECTOR),
        "residuals": ("closure", *VECTOR), "weights": ("closure",),
    },
    "odometry": {
        "first": ("step",), "second": ("step",), "relative": ("step", *VECTOR), "information": ("step", *MATRIX),
    },
    "calibration": {"angles_rad": ("beam",)},
}  # fmt: skip
"""Arrays of its parts, saved as part_name."""


def arrays_of(found: Trajectory) -> dict[str, tuple[tuple[str, ...], NDArray[Any]]]:
    """Return all arrays by the names under which they are saved, with their dimensions."""
    every = [(name, dims, getattr(found, name)) for name, dims in FIELDS.items()]
    for part, fields in PARTS.items():
        of = getattr(found, part)
        if of is not None and (part != "alternatives" or len(of)):
            every += [(f"{part}_{name}", dims, getattr(of, name)) for name, dims in fields.items()]
    return {name: (dims, _stored(values)) for name, dims, values in every if values is not None}


def numbers_of(found: Trajectory) -> dict[str, Any]:
    """Return what is no array, as JSON values."""
    about = found.calibration
    fit = about.odometry
    odometry = None if fit is None else {
        "slope": fit.slope.tolist(), "slope_sigma": fit.slope_sigma.tolist(), "lag_s": float(fit.lag_s),
        "lag_sigma_s": float(fit.lag_sigma_s), "rates": fit.noise.rates.tolist(),
    }  # fmt: skip
    return {
        "dof": found.gaussian.dof, "angle_step_ratio": about.angle_step_ratio, "point_sigma_m": about.point_sigma_m,
        "noise": None if about.noise is None else asdict(about.noise), "odometry": odometry,
    }  # fmt: skip


def trajectory_from(arrays: Mapping[str, NDArray[Any]], numbers: Mapping[str, Any]) -> Trajectory:
    """Return the trajectory of which `arrays_of` and `numbers_of` said all."""

    def part(name: str) -> dict[str, Any]:
        return {field: arrays.get(f"{name}_{field}") for field in PARTS[name]}

    own: dict[str, Any] = {name: arrays.get(name) for name in FIELDS}
    own["flagged"] = own["flagged"] != 0
    about, noise = numbers["odometry"], numbers["noise"]
    fit = None
    if about is not None:
        slope, sigma, rates = (np.array(about[name]) for name in ("slope", "slope_sigma", "rates"))
        fit = OdometryFit(slope, sigma, about["lag_s"], about["lag_sigma_s"], MotionNoise(rates))
    calibration = Calibration(
        angle_step_ratio=numbers["angle_step_ratio"], odometry=fit, noise=None if noise is None else Odometry(**noise),
        point_sigma_m=numbers["point_sigma_m"], **part("calibration"),
    )  # fmt: skip
    return Trajectory(
        **own,
        gaussian=PoseGaussian(**part("gaussian"), dof=numbers["dof"]),
        closures=LoopClosures(**part("closures")),
        alternatives=Alternatives(**part("alternatives")) if "alternatives_first" in arrays else NO_ALTERNATIVES,
        odometry=Factors(**part("odometry")) if "odometry_first" in arrays else None,
        calibration=calibration,
    )


def _stored(values: NDArray[Any]) -> NDArray[Any]:
    """Return truth values as bytes, and indices with 64 bits on every machine."""
    if values.dtype == np.bool_:
        return values.astype(np.int8)
    return values.astype(np.int64) if values.dtype.kind == "i" else np.asarray(values, dtype=np.float64)
