"""Select the scans that a map is made from, once the trajectory of a log is known.

`select_key_scans` returns the key scans with the prior of their poses and the poses from which chains start.
`thin_for_map` drops beams and scans that see walls with many hits.
"""

from dataclasses import dataclass, replace

import numpy as np

from bayesmap.poses.front_end import KEY_DISTANCE_M, KEY_TURN_RAD
from bayesmap.poses.prior import FREE_SIGMA, Motions, PosePrior
from bayesmap.poses.trajectory import InferredTrajectory, calibrated
from bayesmap.space.planar import Floats, between, compose, wrap_angle
from bayesmap.space.scans import Scans

MAX_SAMPLED_KEYS = 100  # key scans whose poses are sampled with the map: chains over more do not mix
MANY_BEAMS = 100_000  # number of beams above which beams and scans are dropped
MIN_STEP_RAD = np.radians(1.0)  # least angle between beams, if beams are dropped
ENOUGH_HITS = 20  # a cell with fewer hits counts as new
MIN_NEW_SHARE = 0.2  # a scan is left out if a smaller share of its hits is in new cells
SCANS_PER_KEY = 7  # scans for each key scan at 10 Hz and half a metre a second: 3000 scans had 426 key scans
P_SLIP = 0.01
"""Probability that odometry is no evidence of a motion. In the Intel log eight motions of 891 are off by 200 to 350
standard deviations, since a pose is repeated while the robot turns by 30 degrees. A normal law alone would turn the
scans there until they contradict the walls."""


@dataclass(frozen=True, eq=False)
class KeyScans:
    """The K scans that the map is made from, and the prior of their poses."""

    scans: Scans  # the key scans at their most probable poses, beam angles calibrated
    prior: PosePrior  # prior of their poses: odometry, corrected for its systematic error
    starts: Floats  # poses from which chains start, one trajectory each, (chains, K, 3)


def select_key_scans(log: Scans, trajectory: InferredTrajectory, chains: int, seed: int) -> KeyScans:
    """Select the key scans of a log with raw odometry. The trajectory gives their prior, and starts of the chains."""
    scans = calibrated_keys(log, trajectory)
    # All trajectories share the first pose: it is the frame of the map.
    draws = trajectory.draw(chains, seed)[:, trajectory.keys]
    return KeyScans(scans, _prior_of(trajectory), compose(scans.poses[0], between(draws[:, :1], draws)))


def select_keys_by_odometry(log: Scans, *, no_odometry: bool) -> Scans:
    """Select about as many scans as there will be key scans, by odometry: for use before the trajectory is known."""
    if no_odometry or len(log) < 2:
        return log.select(slice(None, None, SCANS_PER_KEY))
    keys = [0]
    for number, pose in enumerate(log.poses):
        since_key = pose - log.poses[keys[-1]]
        if np.hypot(since_key[0], since_key[1]) > KEY_DISTANCE_M or abs(wrap_angle(since_key[2])) > KEY_TURN_RAD:
            keys.append(number)
    return log.select(np.array(keys, np.intp))


def calibrated_keys(log: Scans, trajectory: InferredTrajectory) -> Scans:
    """Return the key scans of a log at their most probable poses, beam angles calibrated."""
    keys, ratio = trajectory.keys, trajectory.calibration.angle_step_ratio
    return calibrated(log.select(trajectory.order), ratio).select(keys).at(trajectory.poses[keys])


def _prior_of(trajectory: InferredTrajectory) -> PosePrior:
    """Return the prior of motions between key scans: odometry, or a wide prior without odometry."""
    relative = np.zeros((len(trajectory.keys) - 1, 3))
    sigmas = relative + FREE_SIGMA
    factors = trajectory.odometry
    if factors is not None:
        relative[factors.first] = factors.relative
        sigmas[factors.first] = np.sqrt(np.diagonal(np.linalg.inv(factors.information), axis1=1, axis2=2))
    return Motions(relative, sigmas, P_SLIP)


def thin_for_map(scans: Scans, resolution: float) -> Scans:
    """Keep beams and scans that see walls with few hits, so that cost follows the area seen. Few beams are all kept."""
    if scans.ranges_m.size <= MANY_BEAMS:
        return scans
    stride = int(MIN_STEP_RAD / max(float(np.nanmedian(scans.steps_rad)), 1e-6) + 1e-3)  # 1e-3: against rounding down
    if stride > 1 and scans.own_angles_rad is None:
        beam_poses = None if scans.beam_poses is None else scans.beam_poses[:, ::stride]
        angles, ranges = scans.angles_rad[::stride], scans.ranges_m[:, ::stride]
        scans = replace(scans, angles_rad=angles, ranges_m=ranges, beam_poses=beam_poses)
    cells = np.floor(scans.hit_points_world() / resolution).astype(np.int64)
    cell = np.unique(cells, axis=0, return_inverse=True)[1].ravel()
    hit_cells = np.split(cell, np.cumsum(np.isfinite(scans.ranges_m).sum(axis=1))[:-1])
    # Select a scan if enough of its hits are in cells with few hits of the scans selected so far.
    hits, selected = np.zeros(cell.max(initial=0) + 1, np.int64), []
    for number, scan_cells in enumerate(hit_cells):
        if not len(scan_cells) or (hits[scan_cells] < ENOUGH_HITS).mean() >= MIN_NEW_SHARE:
            selected.append(number)
            hits += np.bincount(scan_cells, minlength=len(hits))
    return scans.select(np.array(selected, np.intp))
