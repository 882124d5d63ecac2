"""Compute the likelihood of whole scans at any poses, given the cells.

Beams walk the grid from the pose, so no rays are traced beforehand. The law is that of
`bayesmap.kernels.predict.density` under one map: the stops of beams are summed out.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float64Rows, Float64s, Floats, Int32s, Singles
from bayesmap.kernels.predict import density
from bayesmap.kernels.predict.density import DeviceMaps, Frame, MapArrays
from bayesmap.kernels.rays import walk_along
from bayesmap.kernels.sensor_law import SensorLaw64, object_decay, sensor_law
from bayesmap.kernels.walk import is_inside, walk_next
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})


@wp.kernel
def beam_log_likelihoods(
    first: int, law: SensorLaw64, frame: Frame, maps: MapArrays, poses: Float64Rows, scan: Int32s, chain: Int32s,
    beams: int, mounts: Float64Rows, range_m: Float64s, out: Float64s,
):  # fmt: skip
    """One thread per beam of a pose: compute log p(reading | cells, pose). A mount is a beam's start and angle in its
    scan's frame; ``mounts`` has one row per angle, or one per beam.
    """
    # b: thread; row: pose; reading: beam of the scan; z: its reading; m: its mount; w: its walk.
    b = first + wp.tid()
    row = b / beams
    reading = scan[row] * beams + b % beams
    z = range_m[reading]
    if wp.isnan(z):
        return
    m = b % beams
    if mounts.shape[0] > beams:
        m = reading
    one = wp.float64(1.0)
    yaw = poses[row, 2]
    x = poses[row, 0] + wp.cos(yaw) * mounts[m, 0] - wp.sin(yaw) * mounts[m, 1]
    y = poses[row, 1] + wp.sin(yaw) * mounts[m, 0] + wp.cos(yaw) * mounts[m, 1]
    line = density.line_in(frame, x, y, yaw + mounts[m, 2])
    gone = density.weight_of_nothing(law)
    decay = object_decay(law, z)
    sums = density.no_sum(law)
    survive = wp.float64(1.0)
    w = walk_along(line, frame.nx, law.max_m)
    while w.distance <= w.end and survive >= gone:
        if is_inside(w, frame.nx, frame.ny):
            stop = density.stop_on_walk(maps, chain[row], line, w)
            weight = survive * stop[0]
            survive = survive * (one - stop[0])
            if weight > wp.float64(0.0):
                known = wp.vec3d(weight, stop[1], stop[2] * stop[2])
                sums = density.add_stop(law, sums, weight, z, decay, known)
        w = walk_next(w)
    if survive > wp.float64(0.0):
        sums = density.add_stop(law, sums, survive, z, decay, wp.vec3d(survive, wp.float64(wp.inf), wp.float64(0.0)))
    out[b] = sums[0] + wp.log(sums[1])


@dataclass(frozen=True, eq=False)
class ScanLikelihood:
    """The likelihood of scans at any poses under any cells, which stop beams at the part ``hit_depth`` of their chords
    unless they have surfaces. Beams keep their starts and angles relative to the scan's pose.
    """

    scans: Scans
    grid: Grid
    sensor: SensorModel
    hit_depth: float
    device: str = "cpu"

    def beams(
        self, cells: Singles | DeviceMaps, poses: Floats, scan: NDArray[np.intp], chain: NDArray[np.intp]
    ) -> Floats:
        """Compute the log density of each reading at poses in the world frame, invalid ones 0, in nats, (P, A).

        ``cells`` holds a map of the whole grid per chain, see `density.StopStates`; `DeviceMaps` are not copied.
        ``scan`` and ``chain`` are the indices of the scan and of the map at each pose, (P,).
        """
        device, beams = devices.resolve(self.device), self.scans.ranges_m.shape[1]
        limits = RangeLimits(self.scans.min_range_m, self.scans.max_range_m)
        law, size = sensor_law(self.sensor, limits, device), len(poses) * beams
        maps = cells.arrays if isinstance(cells, DeviceMaps) else density.maps_to_device(cells, self.hit_depth, device)
        inputs = [law, density.grid_frame(self.grid), maps, poses, scan, chain, beams, *self._on_device, (size,)]
        (out,) = devices.launch(beam_log_likelihoods, size, inputs, device, devices.threads_for(size))
        return np.asarray(out.reshape(len(poses), beams))

    def __call__(self, cells: Singles, poses: Floats, scan: NDArray[np.intp], chain: NDArray[np.intp]) -> Floats:
        """Compute the log-likelihood of each scan at its pose, (P,): the sum of `beams`."""
        return np.asarray(self.beams(cells, poses, scan, chain).sum(axis=1))

    @cached_property
    def _on_device(self) -> tuple[Any, Any]:
        scans = self.scans
        readings = devices.to_device(scans.ranges_m.ravel(), wp.float64, self.device)
        mounts = np.zeros((len(scans.angles_rad), 3))
        mounts[:, 2] = scans.angles_rad
        if scans.own_angles_rad is not None:
            mounts = np.zeros((*scans.ranges_m.shape, 3))
            mounts[..., 2] = scans.angles_by_scan()
            mounts = mounts.reshape(-1, 3)
        if scans.beam_poses is not None:
            dx, dy = np.moveaxis(scans.beam_poses[..., :2] - scans.poses[:, None, :2], -1, 0)
            yaw = scans.poses[:, 2:3]
            x, y = np.cos(yaw) * dx + np.sin(yaw) * dy, np.cos(yaw) * dy - np.sin(yaw) * dx
            mounts = np.stack([x, y, scans.beam_angles_world() - yaw], axis=-1).reshape(-1, 3)
        return devices.to_device(mounts, wp.float64, self.device), readings
