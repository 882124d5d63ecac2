"""Read the scans of g2o and TORO files, graphs of poses in the plane, and write such graphs.

    VERTEX_SE2 id x y yaw                                (TORO: VERTEX2)
    ROBOTLASER1 ...                                      (or FLASER: CARMEN's lines, see `bayesmap.io.text.carmen`)
    EDGE_SE2 i j dx dy dyaw  xx xy xyaw yy yyaw yawyaw   (TORO: EDGE2)

A laser line belongs to the last vertex before it: the laser's pose is vertex * robot^-1 * laser. An edge is a
measurement of pose j in the frame of pose i, with the upper triangle of its information matrix in that frame. No line
``FIX 0`` is written (docs/file-formats.md). `write_g2o` writes the `Edges` of `chain_edges` or `slam_edges`.
"""

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_file
from bayesmap.io.log_reading import LogAccount, LogOptions, ScanLog
from bayesmap.io.text.carmen import LASERS, LaserLine, MalformedLine, PlacedScan, parse_floats, parse_laser, scan_log_of
from bayesmap.io.text.lines import log_lines
from bayesmap.space.planar import Floats, between, between_jacobians, compose, inverse, mount_jacobians, rotation
from bayesmap.space.trajectory import Trajectory

if TYPE_CHECKING:
    from bayesmap.poses.graph import PoseStudentT
    from bayesmap.poses.trajectory import InferredTrajectory


VERTICES = (b"VERTEX_SE2", b"VERTEX2")
G2O_TAGS = (*VERTICES, b"EDGE_SE2", b"VERTEX_SE3:QUAT", b"VERTEX_XY", b"PARAMS_SE2OFFSET", b"VERTEX_SE2_XY")
"""Words by which a g2o file is recognised."""
MAX_COORDINATE_M = 1e7  # larger coordinates are malformed
MIN_INFORMATION = 1e-3  # least information of an edge, 1 / m^2 and 1 / rad^2: other programs invert its matrix
MIN_VARIANCE = 1e-12  # added to the variances of an edge, m^2 and rad^2, which may be 0
SAMPLED_PAIRS = 300  # random pairs of key scans that measure the effect of common errors
SEED = 1  # seed of the choice of these pairs


def read_g2o(path: str | os.PathLike[str], options: LogOptions) -> ScanLog:
    """Read the scans of a g2o file, plain or gzipped. Errors are as in `bayesmap.io.text.carmen.read_carmen`."""
    account = LogAccount(os.fspath(path), "g2o", options)
    scans_by_kind: dict[str, list[PlacedScan]] = {kind: [] for kind in LASERS}
    vertex: Floats | None = None
    number = 0
    for number, line in log_lines(account):
        words = line.split()
        if not words or words[0].startswith(b"#"):
            continue
        kind = words[0][:64].decode("ascii", "backslashreplace")
        account.counts[kind] += 1
        try:
            if words[0] in VERTICES:
                vertex = None  # scans after a malformed vertex do not belong to the vertex before it
                vertex = _vertex(kind, words)
            elif kind in LASERS:
                scan = parse_laser(kind, words)
                if vertex is None:
                    remedy = "(a file without vertices is read by the poses in its laser lines)"
                    vertices = " or ".join(word.decode() for word in VERTICES)
                    raise MalformedLine(f"{kind} does not follow a {vertices} that says where it was taken {remedy}")
                mount = _mount(scan) if options.laser is None else np.array(options.laser)
                pose = compose(vertex, mount)
                pose[2] = vertex[2] + mount[2]  # not wrapped: yaw beyond a turn may be in degrees, which a note says
                scans_by_kind[kind].append((scan, pose))
        except MalformedLine as problem:
            account.reject(number, str(problem))
    if not any(scans_by_kind.values()):
        contents = f"{number} lines; it holds {account.counts_in_words()}{account.skipped_in_words()}"
        raise BadInput(f"{account.name}: no vertex of the graph carries a scan ({', '.join(LASERS)}) in {contents}")
    log, _ = scan_log_of(account, scans_by_kind)
    return replace(log, pose_source=max((v.decode() for v in VERTICES), key=lambda word: account.counts[word]))


def _vertex(kind: str, words: list[bytes]) -> Floats:
    """Return the pose in the words of a vertex, (3,). Raises `MalformedLine`."""
    if len(words) != 5:
        raise MalformedLine(f"{kind} has {len(words)} fields where 5 are needed: an id, x, y and yaw")
    pose = parse_floats(kind, words[2:5], 2)
    if not (np.isfinite(pose).all() and np.abs(pose).max() < MAX_COORDINATE_M):
        raise MalformedLine(f"{kind} has the pose {pose.tolist()}")
    return pose


def _mount(scan: LaserLine) -> Floats:
    """Return the pose of the laser on the robot, robot^-1 * laser, (3,), from the poses in a line."""
    laser, robot = scan.laser_pose, scan.robot_pose
    if np.abs([laser, robot]).max() >= MAX_COORDINATE_M:
        raise MalformedLine(f"the laser is at {laser.tolist()} and the robot at {robot.tolist()}")
    return between(robot, laser)


@dataclass(frozen=True, eq=False)
class Edges:
    """The E edges of a pose graph. Raises `BadInput` for shapes that do not fit, or a matrix not positive definite."""

    first: NDArray[np.intp]  # indices of the first poses, (E,)
    second: NDArray[np.intp]  # indices of the second poses, (E,)
    relative: Floats  # the second poses in the frames of the first, (E, 3)
    information: Floats  # inverse covariances of the measurements in the frames of the first, (E, 3, 3)

    def __post_init__(self) -> None:
        count = len(self.first)
        shapes = (np.shape(self.second), np.shape(self.relative), np.shape(self.information))
        if shapes != ((count,), (count, 3), (count, 3, 3)):
            raise BadInput(f"graph: {count} edges need shapes ({count},), ({count}, 3), ({count}, 3, 3), got {shapes}")
        if count and not (np.linalg.eigvalsh(self.information) > 0).all():
            edge = int(np.argmin(np.linalg.eigvalsh(self.information).min(axis=1)))
            raise BadInput(f"graph: the information matrix of edge {edge} is not positive definite")

    def of_frame(self, mount: Floats) -> "Edges":
        """Return the edges between poses of another frame, which lies at ``mount``, (3,), in this frame."""
        # Information transforms by the derivative of the old relative pose with respect to the new one.
        jacobian = np.linalg.inv(mount_jacobians(self.relative[:, 2], mount))
        relative = compose(inverse(mount), compose(self.relative, mount))
        return replace(self, relative=relative, information=np.swapaxes(jacobian, 1, 2) @ self.information @ jacobian)


def write_g2o(path: str | os.PathLike[str], poses_world: Floats, edges: Edges) -> Path:
    """Write a graph of poses, (S, 3), whole or not at all. Raises `BadInput` for an edge to a missing pose."""
    count = len(poses_world)
    indices = np.concatenate([edges.first, edges.second])
    if len(indices) and (indices.min() < 0 or indices.max() >= count):
        raise BadInput(f"graph: an edge names pose {indices.max()}, but there are {count}")
    lines = [f"VERTEX_SE2 {i} {x:.9f} {y:.9f} {yaw:.9f}" for i, (x, y, yaw) in enumerate(poses_world)]
    upper = np.triu_indices(3)
    for i, j, relative, information in zip(edges.first, edges.second, edges.relative, edges.information, strict=True):
        numbers = [f"{v:.9f}" for v in relative] + [f"{v:.17g}" for v in information[upper]]
        lines.append(f"EDGE_SE2 {i} {j} " + " ".join(numbers))
    return write_file(path, lines)


def chain_edges(trajectory: Trajectory) -> Edges:
    """Return the graph of successive poses of a trajectory: each pose in the frame of the pose before.
    The covariance of a step comes from the law of relative poses, or else from the draws. Without both, it is the sum
    of the covariances of both poses, as if they were independent, which is too large. Raises `BadInput` for a
    trajectory without draws and without covariances, or of a single pose.
    """
    steps = len(trajectory) - 1
    if steps < 1:
        raise BadInput("graph: a single pose has no edge")
    relative = between(trajectory.poses[:-1], trajectory.poses[1:])
    if trajectory.relative is not None:
        covariance = trajectory.relative.covariances(np.arange(steps), np.arange(1, steps + 1))
    elif trajectory.draws is not None and len(trajectory.draws) > 3:
        step_draws = between(trajectory.draws[:, :-1], trajectory.draws[:, 1:])
        error = between(np.broadcast_to(relative, step_draws.shape), step_draws)
        covariance = np.einsum("dsi,dsj->sij", error, error) / (len(step_draws) - 1)
    elif trajectory.covariances is not None:
        to_own_axes = rotation(-trajectory.poses[:, 2])  # turns world axes into the axes of each pose
        in_own_axes = to_own_axes @ trajectory.covariances @ np.swapaxes(to_own_axes, 1, 2)
        covariance = in_own_axes[:-1] + in_own_axes[1:]
    else:
        raise BadInput("graph: nothing is known of how sure these poses are; a graph needs covariances or draws")
    information = np.asarray(np.linalg.inv(covariance + MIN_VARIANCE * np.eye(3)), np.float64)
    return Edges(np.arange(steps), np.arange(1, steps + 1), relative, information)


def slam_edges(trajectory: "InferredTrajectory") -> Edges:
    """Return the pose graph of `bayesmap.slam`: its constraints between key scans, and each other scan with its key.
    Informations are the curvatures of the cost, divided by two factors: the ratio of Student's t covariances to scales,
    and the mean growth of covariances by common errors of pairs. A pose graph can represent neither.
    """
    gaussian, keys = trajectory.gaussian, trajectory.keys
    student_ratio = gaussian.dof / (gaussian.dof - 2.0)
    values, vectors = np.linalg.eigh(gaussian.curvature / (student_ratio * _covariance_growth(gaussian)))
    key_information = (vectors * np.maximum(values, MIN_INFORMATION)[:, None, :]) @ np.swapaxes(vectors, 1, 2)
    # Edges from every other scan to its nearest key scan.
    others = np.setdiff1d(np.arange(len(trajectory)), keys)
    nearest = keys[trajectory.nearest_key[others]]
    from_nearest = between(trajectory.poses[nearest], trajectory.poses[others])
    _, by_other = between_jacobians(from_nearest)
    covariance = student_ratio * by_other @ trajectory.own_covariance[others] @ np.swapaxes(by_other, 1, 2)
    return Edges(
        np.concatenate([keys[gaussian.first], nearest]),
        np.concatenate([keys[gaussian.second], others]),
        np.concatenate([gaussian.relative, from_nearest]),
        np.concatenate([key_information, np.linalg.inv(covariance + MIN_VARIANCE * np.eye(3))]),
    )


def _covariance_growth(gaussian: "PoseStudentT") -> float:
    """Return the geometric mean ratio of relative covariances with common errors to those without."""
    from bayesmap.poses.graph import relative_covariances

    first, second = np.random.default_rng(SEED).integers(0, len(gaussian.poses), (2, SAMPLED_PAIRS))
    first, second = first[first != second], second[first != second]
    if not len(first):
        return 1.0
    without_common = relative_covariances(gaussian.precision, gaussian.poses, first, second)
    log_ratio = np.linalg.slogdet(gaussian.relative_scales(first, second))[1] - np.linalg.slogdet(without_common)[1]
    return float(np.exp(log_ratio.mean() / 3.0))  # the third root: covariances are 3 x 3
