"""Refine the poses of scans against fixed scans by Gauss-Newton, one thread per scan."""

from dataclasses import dataclass
from typing import Any

import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float64Rows, Floats, Int32s, Ints, Vec3ds
from bayesmap.kernels.match.line_pairs import PairRule, pair_scans, symmetric
from bayesmap.kernels.match.scan_geometry import ScanArrays, equal_weights, scan_arrays

wp.set_module_options({"enable_backward": False})

LONGEST_STEP = wp.constant(wp.float64(0.5))  # metres plus radians
STILL = wp.constant(wp.float64(1.0e-5))  # metres plus radians: steps below this end the iteration


@wp.func
def turn_of(yaw: wp.float64) -> wp.mat33d:
    """Return the matrix that turns steps (x, y, yaw) in a frame at this yaw into the axes of the outer frame."""
    c = wp.cos(yaw)
    s = wp.sin(yaw)
    zero = wp.float64(0.0)
    return wp.mat33d(c, -s, zero, s, c, zero, zero, zero, wp.float64(1.0))


@wp.func
def pose_between(a: wp.vec3d, b: wp.vec3d) -> wp.vec3d:
    """Return the pose b in the frame of a."""
    c = wp.cos(a[2])
    s = wp.sin(a[2])
    dx = b[0] - a[0]
    dy = b[1] - a[1]
    return wp.vec3d(c * dx + s * dy, -s * dx + c * dy, b[2] - a[2])


@wp.func
def wrap_angle(angle: wp.float64) -> wp.float64:
    """Wrap an angle to [-pi, pi]."""
    return wp.atan2(wp.sin(angle), wp.cos(angle))


@wp.struct
class RefinementArrays:
    """A `Refinement` on a device."""

    scans: Int32s
    offsets: Int32s
    others: Int32s
    other_poses: Vec3ds
    starts: Vec3ds
    priors: Vec3ds
    prior_information: wp.array(dtype=wp.mat33d)


@wp.struct
class ConvergenceNumbers:
    """A `Convergence` on a device."""

    sigma_m: wp.float64
    steps: int
    reach_m: wp.vec2f
    scale_m: wp.vec2f
    alike: float


@wp.struct
class Refined:
    """Results of all jobs, on a device."""

    pose: Vec3ds
    information: wp.array(dtype=wp.mat33d)
    totals: Float64Rows  # cost, weight, matched, seen of `line_pairs.Sums`


@wp.kernel
def refine(
    first: int, scene: ScanArrays, weights: Float32Rows, jobs: RefinementArrays, schedule: ConvergenceNumbers,
    out: Refined,
):  # fmt: skip
    """One thread per job: minimise the cost of prior and pairs, with a reach and a scale that shrink step by step."""
    # k: job; i: its scan; x: its pose along the world's axes; q: entry of a fixed scan. While reach and scale shrink,
    # only every other point is used. The information comes from the pairs alone, less slack.
    k = first + wp.tid()
    i = jobs.scans[k]
    x = jobs.starts[k]
    count = wp.float64(jobs.offsets[k + 1] - jobs.offsets[k])
    converged = int(0)
    information = wp.mat33d()
    for step in range(schedule.steps):
        if converged >= 1:
            continue
        share = wp.min(1.0, 1.5 * float(step) / float(wp.max(schedule.steps - 1, 1)))
        reach = schedule.reach_m[0] * wp.pow(schedule.reach_m[1] / schedule.reach_m[0], share)
        scale = schedule.scale_m[0] * wp.pow(schedule.scale_m[1] / schedule.scale_m[0], share)
        rule = PairRule(reach, scale, schedule.alike)
        sparse = wp.where(share < 1.0, 2, 1)
        gain = wp.float64(sparse) / (schedule.sigma_m * schedule.sigma_m * (count + wp.float64(1.0)))
        second = wp.mat33d()
        slack = wp.mat33d()
        gradient = wp.vec3d()
        cost = wp.float64(0.0)
        weight = wp.float64(0.0)
        matched = int(0)
        seen = int(0)
        for q in range(jobs.offsets[k], jobs.offsets[k + 1]):
            frame = jobs.other_poses[q]
            relative = pose_between(frame, x)
            sums = pair_scans(scene, weights, i, jobs.others[q], relative, rule, sparse * scene.stride)
            turn = turn_of(frame[2])
            second += turn * symmetric(sums.second) * wp.transpose(turn)
            slack += turn * symmetric(sums.slack) * wp.transpose(turn)
            gradient += turn * wp.vec3d(sums.first)
            cost += wp.float64(sums.cost)
            weight += wp.float64(sums.weight)
            matched += sums.matched
            seen += sums.seen
        offset = x - jobs.priors[k]
        offset = wp.vec3d(offset[0], offset[1], wrap_angle(offset[2]))
        # H (H + s^2 S)^-1 H: about H if the slack S is small, and never negative.
        ridge = wp.identity(n=3, dtype=wp.float64) * wp.float64(1.0e-6)
        trusted = second * wp.inverse(second + slack * (schedule.sigma_m * schedule.sigma_m) + ridge)
        laser_information = trusted * second * gain
        pull = trusted * gradient * gain
        whole = laser_information + jobs.prior_information[k]
        move = wp.inverse(whole) * (pull + jobs.prior_information[k] * offset)
        length = wp.abs(move[0]) + wp.abs(move[1]) + wp.abs(move[2])
        if not wp.isfinite(length):
            move = wp.vec3d()
            length = wp.float64(0.0)
        if length > LONGEST_STEP:
            move = move * (LONGEST_STEP / length)
        x = x - move
        information = laser_information
        out.totals[k, 0] = cost
        out.totals[k, 1] = weight
        out.totals[k, 2] = wp.float64(matched)
        out.totals[k, 3] = wp.float64(seen)
        if share >= 1.0 and length < STILL:
            converged = 1
    out.pose[k] = wp.vec3d(x[0], x[1], wrap_angle(x[2]))
    out.information[k] = information


@dataclass(frozen=True, eq=False)
class Refinement:
    """Scans to move, each against fixed scans, under a Gaussian prior."""

    scans: Ints  # the scan that job k moves, (J,)
    offsets: Ints  # job k has the fixed scans offsets[k] to offsets[k + 1] of others, (J + 1,)
    others: Ints  # the fixed scans, (N,)
    other_poses: Floats  # poses of the fixed scans, (N, 3)
    starts: Floats  # first poses of the moving scans, (J, 3)
    priors: Floats  # means of the priors of the moving scans, (J, 3)
    prior_information: Floats  # information of these priors, in the world's axes, (J, 3, 3)


@dataclass(frozen=True)
class Convergence:
    """Rules of pairs and weights; of two numbers the first is for the first step, the second for the last."""

    sigma_m: float  # standard deviation of a point
    steps: int  # most Gauss-Newton steps
    reach_m: tuple[float, float]  # largest distance between paired points
    scale_m: tuple[float, float]  # c of Geman and McClure's weight
    alike: float  # least cosine between the normals of a pair


def refine_scans(
    geometry: Any, refinement: Refinement, convergence: Convergence, threads: int | None = None
) -> tuple[Floats, Floats, Floats]:
    """Refine poses. Returns poses (J, 3), information by pairs in the world's axes (J, 3, 3), and totals (J, 4)."""
    device, count = geometry.device, len(refinement.scans)
    jobs = devices.pack(RefinementArrays, device, **vars(refinement))
    schedule = devices.pack(ConvergenceNumbers, device, **vars(convergence))
    out = devices.pack(Refined, device, pose=(count,), information=(count,), totals=(count, 4))
    inputs = [scan_arrays(geometry), equal_weights(geometry), jobs, schedule, out]
    devices.launch(refine, count, inputs, device, threads)
    return out.pose.numpy(), out.information.numpy(), out.totals.numpy()
