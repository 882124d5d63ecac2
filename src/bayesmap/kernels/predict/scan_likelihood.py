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
from bayesmap.kernels.predict.density import DeviceMaps, MapArrays, add_stop, maps_to_device, no_sum, weight_of_nothing
from bayesmap.kernels.sensor_law import SensorLaw64, object_decay, sensor_law
from bayesmap.kernels.surfaces.cell import cross_surface, ray_from
from bayesmap.kernels.walk import NEVER, is_inside, walk_begin, walk_next
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})


@wp.struct
class Frame:
    """The grid that beams walk."""

    nx: int
    ny: int
    origin_x: wp.float64
    origin_y: wp.float64
    resolution: wp.float64


@wp.func
def stop_on_walk(
    maps: MapArrays, row: int, cell: int, start: wp.vec2, direction: wp.vec2, distance: wp.float64
) -> wp.vec3d:
    """Return the chance that a beam which reaches a cell stops in it, and distance and spread of the stop, metres."""
    if maps.surfaces != 0:
        state = maps.surface[row, cell]
        met = cross_surface(state, ray_from(start, direction))
        return wp.vec3d(
            wp.float64(state[0]) * wp.float64(met.chance), wp.float64(met.distance_m), wp.sqrt(wp.float64(met.variance))
        )
    return wp.vec3d(wp.float64(maps.stop[row, cell]), distance, wp.float64(0.0))


@wp.kernel
def beam_log_likelihoods(
    first: int, law: SensorLaw64, frame: Frame, maps: MapArrays, poses: Float64Rows, scan: Int32s, chain: Int32s,
    beams: int, mounts: Float64Rows, range_m: Float64s, out: Float64s,
):  # fmt: skip
    """One thread per beam of a pose: compute log p(reading | cells, pose).

    A mount is a beam's start and angle in its scan's frame; ``mounts`` has one row per angle, or one per beam.
    """
    # b: thread; row: pose; reading: beam of the scan; z: its reading; m: its mount; w: its walk.
    b = first + wp.tid()
    row = b / beams
    reading = scan[row] * beams + b % beams
    z = range_m[reading]
    out[b] = wp.float64(0.0)
    if wp.isnan(z):
        return
    m = b % beams
    if mounts.shape[0] > beams:
        m = reading
    one = wp.float64(1.0)
    yaw = poses[row, 2]
    x = poses[row, 0] + wp.cos(yaw) * mounts[m, 0] - wp.sin(yaw) * mounts[m, 1] - frame.origin_x
    y = poses[row, 1] + wp.sin(yaw) * mounts[m, 0] + wp.cos(yaw) * mounts[m, 1] - frame.origin_y
    angle = yaw + mounts[m, 2]
    ux = wp.cos(angle)
    uy = wp.sin(angle)
    start = wp.vec2(wp.float32(x), wp.float32(y))
    direction = wp.vec2(wp.float32(ux), wp.float32(uy))
    gone = weight_of_nothing(law)
    decay = object_decay(law, z)
    sums = no_sum(law)
    survive = wp.float64(1.0)
    w = walk_begin(x / frame.resolution, y / frame.resolution, ux, uy, frame.nx, frame.ny, law.max_m / frame.resolution)
    while w.distance <= w.end and survive >= gone:
        if is_inside(w, frame.nx, frame.ny):
            # Length of the beam inside the cell: 0 if it only touches a corner.
            chord = wp.min(wp.min(w.next_x, w.next_y), NEVER) - w.distance
            if w.cell_x != w.x or w.cell_y != w.y:
                chord = wp.where(w.along_line != 0, chord, wp.float64(0.0))
            distance = wp.float64(wp.float32((w.distance + maps.depth * chord) * frame.resolution))
            stop = stop_on_walk(maps, chain[row], w.cell_x * frame.ny + w.cell_y, start, direction, distance)
            weight = survive * stop[0]
            survive = survive * (one - stop[0])
            if weight > wp.float64(0.0):
                known = wp.vec3d(weight, stop[1], stop[2] * stop[2])
                sums = add_stop(law, sums, weight, z, decay, known)
        w = walk_next(w)
    if survive > wp.float64(0.0):
        sums = add_stop(law, sums, survive, z, decay, wp.vec3d(survive, wp.float64(wp.inf), wp.float64(0.0)))
    out[b] = sums[0] + wp.log(sums[1])


@dataclass(frozen=True, eq=False)
class ScanLikelihood:
    """The likelihood of scans at any poses under any cells.

    If the sensor moved during a scan, starts and angles of its beams are relative to the scan's own pose. In a cell
    without a surface a beam stops at the part ``hit_depth`` of its chord.
    """

    scans: Scans
    grid: Grid
    sensor: SensorModel
    hit_depth: float
    device: str = "cpu"

    def beams(
        self, cells: Singles | DeviceMaps, poses: Floats, scan: NDArray[np.intp], chain: NDArray[np.intp]
    ) -> Floats:
        """Compute the log density of each reading, invalid ones 0, in nats, (P, A).

        Args:
            cells: one map per chain, N cells of the whole grid: stop probabilities (C, N), or surfaces (C, N, 6) in
                metres from the grid's corner (`bayesmap.kernels.predict.density`). `DeviceMaps` are not copied.
            poses: P poses in the world frame, (P, 3).
            scan: index of the scan at each pose, (P,).
            chain: index of the chain whose cells are used, (P,).
        """
        device, beams = devices.resolve(self.device), self.scans.ranges_m.shape[1]
        limits = RangeLimits(self.scans.min_range_m, self.scans.max_range_m)
        out = wp.zeros(len(poses) * beams, dtype=wp.float64, device=device)
        mounts, readings = self._on_device
        law, frame = sensor_law(self.sensor, limits, device), grid_frame(self.grid)
        maps = cells.maps if isinstance(cells, DeviceMaps) else maps_to_device(cells, self.hit_depth, device)
        inputs = [law, frame, maps, poses, scan, chain, beams, mounts, readings, out]
        devices.launch(beam_log_likelihoods, len(out), inputs, device, devices.threads_for(len(out)))
        return np.asarray(out.numpy().reshape(len(poses), beams))

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


def grid_frame(grid: Grid) -> Frame:
    """Return a grid as kernels read it."""
    (nx, ny), (x, y) = grid.shape, grid.origin
    return devices.pack(Frame, "cpu", nx=nx, ny=ny, origin_x=x, origin_y=y, resolution=grid.resolution)
