"""Refine the poses of scans against fixed scans by Gauss-Newton, one thread per scan (`refine_scans`).

The cost of a pose is that of a Gaussian prior and of the pairs of `bayesmap.kernels.match.line_pairs`. Reach and scale
of the pairs shrink from step to step, so that a scan first finds the walls, then their exact place.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import ZERO, Float32Rows, Floats, Int32s, Ints, Vec3ds
from bayesmap.kernels.match.line_pairs import Mat33ds, PairRulesArrays, Totals64, Totals64s, sum_over_points, symmetric
from bayesmap.kernels.match.scan_geometry import ScanArrays, equal_weights, scan_arrays

wp.set_module_options({"enable_backward": False})
MAX_STEP = wp.constant(wp.float64(0.5))  # metres plus radians
MIN_STEP = wp.constant(wp.float64(1.0e-5))  # metres plus radians: steps below this end the iteration


@wp.func
def turn_of(yaw: wp.float64) -> wp.mat33d:
    """Return the matrix that turns steps (x, y, yaw) in a frame at this yaw into the axes of the outer frame."""
    c, s = wp.cos(yaw), wp.sin(yaw)
    return wp.mat33d(c, -s, ZERO, s, c, ZERO, ZERO, ZERO, wp.float64(1.0))


@wp.func
def pose_between(a: wp.vec3d, b: wp.vec3d) -> wp.vec3d:
    """Return the pose b in the frame of a."""
    c, s = wp.cos(a[2]), wp.sin(a[2])
    dx, dy = b[0] - a[0], b[1] - a[1]
    return wp.vec3d(c * dx + s * dy, -s * dx + c * dy, b[2] - a[2])


@wp.func
def wrap_yaw(pose: wp.vec3d) -> wp.vec3d:
    """Return a pose, or a difference of poses, with yaw in [-pi, pi]."""
    return wp.vec3d(pose[0], pose[1], wp.atan2(wp.sin(pose[2]), wp.cos(pose[2])))


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
    min_cosine: float  # least cosine between the normals of a pair


class RefinedScans(NamedTuple):
    """The results of J jobs."""

    poses: Floats  # poses in the world frame, (J, 3)
    information: Floats  # information of the pairs alone, in the world's axes, (J, 3, 3)
    totals: Floats  # sums of `bayesmap.kernels.match.line_pairs.Totals` over all pairs in the last step, (J, 5)


RefinementArrays = devices.struct_like(Refinement, Int32s, Int32s, Int32s, Vec3ds, Vec3ds, Vec3ds, Mat33ds)
ConvergenceArrays = devices.struct_like(Convergence, wp.float64, int, wp.vec2f, wp.vec2f, float)
RefinedScansArrays = devices.struct_like(RefinedScans, Vec3ds, Mat33ds, Totals64s)


@wp.struct
class JobSums:
    """Sums of the `NormalEquations` of a moving scan with each of its fixed scans, in the world's axes."""

    hessian: wp.mat33d
    slack: wp.mat33d
    gradient: wp.vec3d
    totals: Totals64


@wp.func
def sum_fixed_scans(
    scans: ScanArrays, weights: Float32Rows, jobs: RefinementArrays, job: int, pose: wp.vec3d, rules: PairRulesArrays
) -> JobSums:
    """Sum over the pairs of a job's moving scan, at a pose, with its fixed scans."""
    total = JobSums()
    for entry in range(jobs.offsets[job], jobs.offsets[job + 1]):
        frame = jobs.other_poses[entry]
        relative = pose_between(frame, pose)
        equations = sum_over_points(scans, weights, jobs.scans[job], jobs.others[entry], relative, rules)
        turn = turn_of(frame[2])
        total.hessian += turn * symmetric(equations.hessian) * wp.transpose(turn)
        total.slack += turn * symmetric(equations.slack) * wp.transpose(turn)
        total.gradient += turn * wp.vec3d(equations.gradient)
        total.totals += Totals64(equations.totals)
    return total


@wp.func
def step_size(step: wp.vec3d) -> wp.float64:
    """Return the size of a step of a pose, metres plus radians."""
    return wp.abs(step[0]) + wp.abs(step[1]) + wp.abs(step[2])


@wp.kernel
def refine(
    first: int, scans: ScanArrays, weights: Float32Rows, jobs: RefinementArrays, schedule: ConvergenceArrays,
    out: RefinedScansArrays,
):  # fmt: skip
    """One thread per job: minimise the cost of prior and pairs, with a reach and a scale that shrink step by step."""
    job = first + wp.tid()
    pose = jobs.starts[job]
    count = wp.float64(jobs.offsets[job + 1] - jobs.offsets[job])
    is_converged = int(0)
    for step in range(schedule.steps):
        if is_converged >= 1:
            continue
        # While reach and scale shrink, during two thirds of the steps, only every other point is used.
        share = wp.min(1.0, 1.5 * float(step) / float(wp.max(schedule.steps - 1, 1)))
        reach = schedule.reach_m[0] * wp.pow(schedule.reach_m[1] / schedule.reach_m[0], share)
        scale = schedule.scale_m[0] * wp.pow(schedule.scale_m[1] / schedule.scale_m[0], share)
        sparse = wp.where(share < 1.0, 2, 1)
        rules = PairRulesArrays(reach, scale, schedule.min_cosine, sparse * scans.stride)
        gain = wp.float64(sparse) / (schedule.sigma_m * schedule.sigma_m * (count + wp.float64(1.0)))
        sums = sum_fixed_scans(scans, weights, jobs, job, pose, rules)
        # The information of the pairs is H (H + s^2 S)^-1 H: about H if the slack S is small, and never negative.
        ridge = wp.identity(n=3, dtype=wp.float64) * wp.float64(1.0e-6)
        trusted = sums.hessian * wp.inverse(sums.hessian + sums.slack * (schedule.sigma_m * schedule.sigma_m) + ridge)
        information = trusted * sums.hessian * gain
        pull = trusted * sums.gradient * gain
        # Solve for the step under pairs and prior, and limit its size.
        offset = wrap_yaw(pose - jobs.priors[job])
        prior = jobs.prior_information[job]
        change = wp.inverse(information + prior) * (pull + prior * offset)
        if not wp.isfinite(step_size(change)):
            change = wp.vec3d()
        if step_size(change) > MAX_STEP:
            change = change * (MAX_STEP / step_size(change))
        pose = pose - change
        out.information[job] = information
        out.totals[job] = sums.totals
        if share >= 1.0 and step_size(change) < MIN_STEP:
            is_converged = 1
    out.poses[job] = wrap_yaw(pose)


def refine_scans(
    geometry: Any, refinement: Refinement, convergence: Convergence, threads: int | None = None
) -> RefinedScans:
    """Refine the poses of the J scans of a job each, by points of other scans that stay where they are."""
    device, count = geometry.device, len(refinement.scans)
    jobs = devices.pack(RefinementArrays, device, **vars(refinement))
    schedule = devices.pack(ConvergenceArrays, device, **vars(convergence))
    out = devices.pack(RefinedScansArrays, device, poses=(count,), information=(count,), totals=(count,))
    inputs = [scan_arrays(geometry), equal_weights(geometry), jobs, schedule, out]
    devices.launch(refine, count, inputs, device, threads)
    return RefinedScans(out.poses.numpy(), out.information.numpy(), out.totals.numpy())
