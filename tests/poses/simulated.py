"""A small simulated building for tests of pose inference: two rooms and a corridor around a block, with exact rays."""

import numpy as np

from bayesmap.kernels.walk import cast_beams
from bayesmap.space.planar import between, chain_motions
from bayesmap.space.scans import Scans

RESOLUTION = 0.02


def ring(width_m=9.0, depth_m=7.0, corridor_m=2.0):
    """Walls of a ring-shaped corridor around a block, with niches and pillars that make places different."""
    nx, ny = round(width_m / RESOLUTION), round(depth_m / RESOLUTION)
    walls = np.zeros((nx, ny), dtype=bool)
    walls[:3], walls[-3:], walls[:, :3], walls[:, -3:] = True, True, True, True
    c = round(corridor_m / RESOLUTION)
    walls[c:-c, c:-c] = True
    walls[c + 40 : c + 70, c : c + 25] = False  # a niche
    walls[-c - 30 : -c, -c - 60 : -c - 20] = False
    walls[60:70, 3:20] = True  # pillars
    walls[-20:-3, 200:215] = True
    walls[200:230, -15:-3] = True
    walls[3:12, 120:150] = True
    return walls


def path_around(laps=1.2, step_m=0.15, width_m=9.0, depth_m=7.0, corridor_m=2.0):
    """Poses along the middle of the ring, (S, 3)."""
    half = corridor_m / 2
    corners = np.array([[half, half], [width_m - half, half], [width_m - half, depth_m - half], [half, depth_m - half]])
    poses = []
    for k in range(int(np.ceil(4 * laps))):
        a, b = corners[k % 4], corners[(k + 1) % 4]
        length = np.hypot(*(b - a))
        steps = int(length / step_m) if k < int(4 * laps) else int(length / step_m * (4 * laps % 1))
        heading = np.arctan2(*(b - a)[::-1])
        poses += [[*(a + (b - a) * t / max(1, int(length / step_m))), heading] for t in range(steps)]
        if k < int(4 * laps):
            poses += [[*b, heading + np.pi / 2 * t / 6] for t in range(1, 6)]
    return np.array(poses)


def scans_of(walls, poses, beams=180, noise_m=0.01, seed=0, max_range_m=12.0, full=False):
    rng = np.random.default_rng(seed)
    step, first = (2 * np.pi / beams, -np.pi) if full else (np.pi / beams, -np.pi / 2)
    angles = first + step * np.arange(beams)
    starts = np.repeat(poses[:, :2], beams, axis=0) / RESOLUTION
    distance, _ = cast_beams(walls, starts, (poses[:, 2:3] + angles).ravel(), max_range_m / RESOLUTION)
    ranges = distance.reshape(len(poses), beams) * RESOLUTION
    ranges = np.where(ranges < max_range_m - 0.01, ranges + noise_m * rng.normal(size=ranges.shape), np.inf)
    return angles, ranges


def poses_along(start, motions):
    """Return the poses of a way, (motions + 1, 3): the start, and the pose after each motion."""
    return np.vstack([start, chain_motions(start, motions)])


def odometry_of(poses, seed=1, noise=1.0, turn_bias=0.0, scale=1.0):
    """Raw odometry of a true path: noise per metre and per radian, a bias of the heading in radians a metre."""
    rng = np.random.default_rng(seed)
    motions = between(poses[:-1], poses[1:])
    travelled = np.hypot(motions[:, 0], motions[:, 1])
    wrong = motions * np.array([scale, scale, 1.0])
    wrong[:, 2] += turn_bias * travelled
    along = 0.05 * travelled + 0.002
    sigma = np.stack([along, along, 0.05 * np.abs(motions[:, 2]) + 0.03 * travelled + 0.001], -1)
    return poses_along(np.array([1.0, 2.0, 0.5]), wrong + noise * sigma * rng.normal(size=wrong.shape))


def recording(laps=1.2, hz=5.0, laser_noise_m=0.01, **kwargs):
    """Scans with raw odometry, and the true poses."""
    truth = path_around(laps)
    angles, ranges = scans_of(ring(), truth, noise_m=laser_noise_m)
    stamps = 1000.0 + np.arange(len(truth)) / hz
    return Scans(odometry_of(truth, **kwargs), angles, ranges, max_range_m=12.0, stamps_s=stamps), truth


def off(poses, truth):
    """Errors of poses relative to the first, (S, 3)."""
    mine, theirs = between(poses[:1], poses), between(truth[:1], truth)
    return between(theirs, mine)


def worst_m(poses, truth):
    return np.hypot(*off(poses, truth)[:, :2].T).max()
