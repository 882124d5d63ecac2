"""Rigid motions of space over time, and the part of them in the plane.

Robots say where their frames are in three dimensions, and a map of walls needs the part of it in the plane. A motion is
SciPy's `RigidTransform`: where a frame is in another, p_parent = R p_child + t, once or at any number of times.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline
from scipy.spatial.transform import RigidTransform, Slerp

Floats = NDArray[np.float64]


def planar(motion: RigidTransform) -> Floats:
    """Return the pose in the plane, shape (..., 3): x, y, and the yaw of the child's x axis."""
    ahead = motion.rotation.apply([1.0, 0.0, 0.0])
    return np.concatenate([motion.translation[..., :2], np.arctan2(ahead[..., 1], ahead[..., 0])[..., None]], -1)


def upright(motion: RigidTransform) -> Floats:
    """Return the height of the child's z axis over the plane, shape (...): 1 upright, -1 upside down, 0 on its side."""
    return np.asarray(motion.rotation.apply([0.0, 0.0, 1.0])[..., 2])


@dataclass(frozen=True, eq=False)
class Track:
    """Where a frame is in another, over time.

    Attributes:
        stamps_ns: shape (T,), strictly ascending, in nanoseconds.
        motions: T of them.
    """

    stamps_ns: NDArray[np.int64]
    motions: Any

    def covers(self, stamps_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Select the times between the first and the last: elsewhere nothing is known."""
        return np.asarray((stamps_ns >= self.stamps_ns[0]) & (stamps_ns <= self.stamps_ns[-1]))

    def at(self, stamps_ns: NDArray[np.int64]) -> RigidTransform:
        """Interpolate: the position along a line, the rotation along the shorter arc. Outside, take the nearest end."""
        if len(self.stamps_ns) == 1:
            return self.motions[np.zeros(np.shape(stamps_ns), dtype=np.intp)]
        # Nanoseconds since 1970 are too many for a double, those since the track began are not.
        known = (self.stamps_ns - self.stamps_ns[0]).astype(np.float64)
        wanted = (np.clip(stamps_ns, self.stamps_ns[0], self.stamps_ns[-1]) - self.stamps_ns[0]).astype(np.float64)
        translation = make_interp_spline(known, self.motions.translation, k=1)(wanted)
        return RigidTransform.from_components(translation, Slerp(known, self.motions.rotation)(wanted))
