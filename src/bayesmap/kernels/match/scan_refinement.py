"""Refining the poses of scans against other scans that stay where they are: Gauss-Newton, one thread a scan."""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.match.line_pairs import Scene, pair_scans, scene_of

wp.set_module_options({"enable_backward": False})

STILL = wp.constant(wp.float64(1.0e-5))  # metres plus radians: steps below this end the iteration


@wp.func
def turn_of(yaw: wp.float64) -> wp.mat33d:
    """The matrix that turns steps (x, y, yaw) given in a frame at this yaw into the outer frame's axes."""
    c = wp.cos(yaw)
    s = wp.sin(yaw)
    o = wp.float64(0.0)
    return wp.mat33d(c, -s, o, s, c, o, o, o, wp.float64(1.0))


@wp.func
def pose_between(a: wp.vec3d, b: wp.vec3d) -> wp.vec3d:
    """The pose b in the frame of a."""
    c = wp.cos(a[2])
    s = wp.sin(a[2])
    dx = b[0] - a[0]
    dy = b[1] - a[1]
    return wp.vec3d(c * dx + s * dy, -s * dx + c * dy, b[2] - a[2])


@wp.func
def wrapped(angle: wp.float64) -> wp.float64:
    """In [-pi, pi]."""
    return wp.atan2(wp.sin(angle), wp.cos(angle))


@wp.kernel
def refine(
    first: int,
    scene: Scene,
    weights: wp.array2d(dtype=wp.float32),
    job_scan: wp.array(dtype=wp.int32),
    offsets: wp.array(dtype=wp.int32),
    other: wp.array(dtype=wp.int32),
    other_pose: wp.array(dtype=wp.vec3d),
    start: wp.array(dtype=wp.vec3d),
    prior: wp.array(dtype=wp.vec3d),
    prior_information: wp.array(dtype=wp.mat33d),
    sigma: wp.float64,
    steps: int,
    reach: wp.vec2f,
    scale: wp.vec2f,
    alike: float,
    pose: wp.array(dtype=wp.vec3d),
    information: wp.array(dtype=wp.mat33d),
    totals: wp.array2d(dtype=wp.float64),
):
    """One thread a job: minimise the cost of prior and pairs; reach and scale shrink from the first step to the last.

    While they shrink every other point is enough. Coordinates are x, y and yaw in the world's axes. Information is that
    of the pairs alone, less slack.
    """
    k = first + wp.tid()
    i = job_scan[k]
    x = start[k]
    count = wp.float64(offsets[k + 1] - offsets[k])
    converged = int(0)
    found = wp.mat33d()
    for step in range(steps):
        if converged >= 1:
            continue
        share = wp.min(1.0, 1.5 * float(step) / float(wp.max(steps - 1, 1)))
        r = reach[0] * wp.pow(reach[1] / reach[0], share)
        c = scale[0] * wp.pow(scale[1] / scale[0], share)
        sparse = wp.where(share < 1.0, 2, 1)
        gain = wp.float64(sparse) / (sigma * sigma * (count + wp.float64(1.0)))
        second = wp.mat33d()
        slack = wp.mat33d()
        gradient = wp.vec3d()
        cost = wp.float64(0.0)
        weight = wp.float64(0.0)
        matched = int(0)
        seen = int(0)
        for q in range(offsets[k], offsets[k + 1]):
            frame = other_pose[q]
            sums = pair_scans(scene, weights, i, other[q], pose_between(frame, x), r, c, alike, sparse * scene.stride)
            turn = turn_of(frame[2])
            second += turn * sums.second * wp.transpose(turn)
            slack += turn * sums.slack * wp.transpose(turn)
            gradient += turn * sums.first
            cost += sums.cost
            weight += sums.weight
            matched += sums.matched
            seen += sums.seen
        off = x - prior[k]
        off = wp.vec3d(off[0], off[1], wrapped(off[2]))
        # H (H + s^2 S)^-1 H: H where slack is small against it, and never negative where it is not.
        ridge = wp.identity(n=3, dtype=wp.float64) * wp.float64(1.0e-6)
        trusted = second * wp.inverse(second + slack * (sigma * sigma) + ridge)
        laser_information = trusted * second * gain
        pull = trusted * gradient * gain
        whole = laser_information + prior_information[k]
        move = wp.inverse(whole) * (pull + prior_information[k] * off)
        length = wp.abs(move[0]) + wp.abs(move[1]) + wp.abs(move[2])
        if not wp.isfinite(length):
            move = wp.vec3d()
            length = wp.float64(0.0)
        if length > wp.float64(0.5):
            move = move * (wp.float64(0.5) / length)
        x = x - move
        found = laser_information
        totals[k, 0] = cost
        totals[k, 1] = weight
        totals[k, 2] = wp.float64(matched)
        totals[k, 3] = wp.float64(seen)
        if share >= 1.0 and length < STILL:
            converged = 1
    pose[k] = wp.vec3d(x[0], x[1], wrapped(x[2]))
    information[k] = found


def refine_scans(
    geometry: Any,
    weights: NDArray[np.float32] | None,
    scans: NDArray[np.int32],
    offsets: NDArray[np.int32],
    others: NDArray[np.int32],
    other_poses: NDArray[np.float64],
    starts: NDArray[np.float64],
    priors: NDArray[np.float64],
    prior_information: NDArray[np.float64],
    sigma_m: float,
    steps: int,
    reach_m: tuple[float, float],
    scale_m: tuple[float, float],
    alike: float,
    stride: int = 1,
    threads: int | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Poses (J, 3), information of the pairs (J, 3, 3) and totals (J, 4) as those of `line_pairs.pair_sums`.

    Job k moves scan ``scans[k]`` against ``others[offsets[k]:offsets[k + 1]]``, which stay at ``other_poses``, and
    under a Gaussian prior. Information is in the world's axes.
    """
    device, jobs = geometry.device, len(scans)
    if weights is None:
        weights = _ones(len(geometry), geometry.beams, device)
    pose = wp.empty(jobs, dtype=wp.vec3d, device=device)
    information = wp.empty(jobs, dtype=wp.mat33d, device=device)
    totals = wp.zeros((jobs, 4), dtype=wp.float64, device=device)
    ints = [devices.to_device(a, wp.int32, device) for a in (scans, offsets, others)]
    vectors = [devices.to_device(a, wp.vec3d, device) for a in (other_poses, starts, priors)]
    inputs = [scene_of(geometry, stride), weights, *ints, *vectors]
    inputs += [devices.to_device(prior_information, wp.mat33d, device), wp.float64(sigma_m), steps]
    inputs += [wp.vec2f(*reach_m), wp.vec2f(*scale_m), alike, pose, information, totals]
    devices.launch(refine, jobs, inputs, device, threads)
    return pose.numpy(), information.numpy(), totals.numpy()


_ONES: dict[tuple[int, int, str], Any] = {}


def _ones(scans: int, beams: int, device: str) -> Any:
    """Equal weights of all beams; kept, because front ends ask for them with every scan."""
    key = (scans, beams, device)
    if key not in _ONES:
        _ONES.clear()
        _ONES[key] = wp.full((scans, beams), 1.0, dtype=wp.float32, device=device)
    return _ONES[key]
