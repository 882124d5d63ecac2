"""Where a point lies with respect to a surface: across it and along it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SurfaceOffset:
    """A point in the frame of a surface, whose normal is the direction of its least extent, towards the sensor.

    Attributes:
        across_m: along the normal from the surface's mean: positive in front of it, negative behind.
        along_m: along the wall from the mean: positive to the left as the sensor sees it.
        thickness_m, length_m: standard deviations of the surface along the two.
        incidence_rad: between the normal and the way from the surface's mean to the sensor, in [0, pi / 2].
    """

    across_m: float
    along_m: float
    thickness_m: float
    length_m: float
    incidence_rad: float


def surface_offset(mean: Floats, covariance: Floats, point: Floats, sensor: Floats) -> SurfaceOffset:
    """Split the way from a surface's mean to a point into its parts across and along the surface.

    Args:
        mean: of the points where beams stop, (2,), metres.
        covariance: of the same, (2, 2).
        point: for instance where a reading ends, (2,).
        sensor: where the beam comes from, (2,).
    """
    values, vectors = np.linalg.eigh(covariance)
    normal, towards = vectors[:, 0], sensor - mean
    if normal @ towards < 0:
        normal = -normal
    # seen from the sensor, which looks against the normal, left is the normal turned clockwise
    left = np.array([normal[1], -normal[0]])
    away = point - mean
    distance = float(np.hypot(*towards))
    cosine = float(normal @ towards) / distance if distance > 0 else 1.0
    thickness, length = np.sqrt(np.maximum(values, 0.0))
    return SurfaceOffset(
        float(normal @ away), float(left @ away), float(thickness), float(length), math.acos(min(1.0, cosine))
    )
