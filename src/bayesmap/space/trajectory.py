"""A trajectory: poses over time with their uncertainty, as plain data.

`Trajectory` is the result of SLAM and localization, and the reference of scores. `RelativeLaw` is the distribution of
a scan's pose in the frame of another scan. `step_to` chooses whose poses are returned: the robot's or the laser's.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Indices, Mask, bracketing_indices
from bayesmap.space.planar import Floats, between, compose, frame_jacobians, interpolate, mount_jacobians, wrap_yaw
from bayesmap.space.scans import as_poses, path_words

SLACK_S = 0.002  # a time outside a trajectory by less is at its end: logs are written with few digits
MAX_INTERPOLATED_S = 0.3  # longest time between two poses with interpolation: in a longer time a robot turns corners
FRAMES = ("base", "laser")  # frames on a robot whose poses a trajectory may have


@dataclass(frozen=True, eq=False)
class RelativeLaw:
    """Student's t distribution of the relative poses of a trajectory, with ``dof`` degrees of freedom.
    ``scales`` takes the indices of the first and the second pose of N pairs. It returns the scale matrices of x, y and
    yaw of the second pose in the frame of the first, (N, 3, 3). A covariance is dof / (dof - 2) times a scale matrix.
    """

    scales: Callable[[Indices, Indices], Floats]
    dof: float

    def covariances(self, first: Indices, second: Indices) -> Floats:
        """Return the covariances of the second poses in the frames of the first, (N, 3, 3)."""
        return self.dof / (self.dof - 2.0) * self.scales(first, second)

    def of_frame(self, poses: Floats, mount: Floats) -> "RelativeLaw":
        """Return the distribution for a frame at ``mount``, (3,), given the ``poses`` of this frame, (S, 3)."""

        def scales(first: Indices, second: Indices) -> Floats:
            jacobians = mount_jacobians(between(poses[first], poses[second])[:, 2], mount)
            return np.asarray(jacobians @ self.scales(first, second) @ np.swapaxes(jacobians, 1, 2))

        return RelativeLaw(scales, self.dof)


def step_to(frame: str | None, mount: Floats | None, own: str) -> tuple[str, Floats | None]:
    """Return the frame that a user requested, and the pose of this frame in the frame ``own``, (3,).
    ``frame`` is one of `FRAMES`. By default it is the base if ``mount``, the laser's pose on the base, is known, else
    the laser. ``own`` is the frame of the known poses: for this frame, the pose is None. Raises `BadInput` for another
    name, or if the mount is needed and not known.
    """
    requested = frame or ("laser" if mount is None else "base")
    if requested not in FRAMES:
        raise BadInput(f"trajectory: frame must be one of {', '.join(FRAMES)}, got {frame!r}")
    if requested == own:
        return requested, None
    if mount is None:
        raise BadInput(
            f"trajectory: it has poses of the {own}; those of the {requested} need to know where the laser sits, which "
            "the log does not say; give it by --laser X,Y,DEGREES (read_log: laser), when the log is read"
        )
    return requested, np.asarray(mount) if own == "base" else between(np.asarray(mount), np.zeros(3))


@dataclass(frozen=True, eq=False)
class Trajectory:
    """The poses over time of one frame on a robot, such as its laser's, with their uncertainty. None is unknown.
    Raises `BadInput` for shapes that do not fit, numbers that are not finite, or stamps that descend.
    """

    poses: Floats  # x, y in metres and yaw in radians in the world frame, (S, 3)
    stamps_s: Floats | None = None  # time of each pose in seconds, (S,), ascending
    covariances: Floats | None = None  # covariances of x, y and yaw in world axes, (S, 3, 3)
    draws: Floats | None = None  # poses of whole trajectories drawn from a posterior, (D, S, 3)
    relative: RelativeLaw | None = None  # law of relative poses; None if it follows from the draws, too
    known_by: str = ""  # source of the uncertainty, in words
    frame: str | None = None  # frame on the robot whose poses these are, "base" or "laser"

    def __post_init__(self) -> None:
        poses = as_poses(self.poses)
        object.__setattr__(self, "poses", poses)
        if self.stamps_s is not None:
            stamps = np.asarray(self.stamps_s, dtype=np.float64)
            if stamps.shape != (len(poses),) or not np.isfinite(stamps).all() or (np.diff(stamps) < 0).any():
                raise BadInput(f"trajectory: give one finite stamp a pose, ascending, ({len(poses)},)")
            object.__setattr__(self, "stamps_s", stamps)
        for name, shape in (("covariances", (len(poses), 3, 3)), ("draws", (-1, len(poses), 3))):
            value = getattr(self, name)
            if value is None:
                continue
            array = np.asarray(value, dtype=np.float64)
            if array.ndim != 3 or array.shape[-2:] != shape[-2:] or shape[0] not in (-1, len(array)):
                raise BadInput(f"trajectory: {name} has shape {array.shape}, expected {shape}".replace("(-1", "(D"))
            if not np.isfinite(array).all():
                raise BadInput(f"trajectory: {name} has a number that is not finite")
            object.__setattr__(self, name, array)

    def __len__(self) -> int:
        return len(self.poses)

    def __repr__(self) -> str:
        """Return three lines: size, path and uncertainty."""
        draws = "" if self.draws is None else f", {len(self.draws):,} draws"
        known = "unknown"
        if self.covariances is not None and len(self):
            sigma = np.sqrt(np.median(np.linalg.eigvalsh(self.covariances[:, :2, :2])[:, 1]))
            source = f", {self.known_by}" if self.known_by else ""
            known = f"median {sigma:.2g} m{draws}{source}"
        return (
            f"Trajectory: {len(self):,} poses\n  path: {path_words(self.poses, self.stamps_s)}\n"
            f"  standard deviation of position: {known}"
        )

    @classmethod
    def of_draws(cls, draws: Floats, stamps_s: Floats | None = None, known_by: str = "") -> "Trajectory":
        """Return the mean and covariance of each pose over draws, (D, S, 3) or (chains, D, S, 3), and the draws."""
        flat = np.asarray(draws, dtype=np.float64)
        flat = flat.reshape(-1, *flat.shape[-2:])
        if len(flat) == 0:
            raise BadInput("trajectory: there is no draw")
        # Average differences from the first draw: a mean of yaws themselves fails where they wrap around.
        differences = wrap_yaw(flat - flat[0])
        mean = differences.mean(axis=0)
        errors = differences - mean
        covariances = np.einsum("dsi,dsj->sij", errors, errors) / max(len(flat) - 1, 1)
        return cls(wrap_yaw(flat[0] + mean), stamps_s, covariances, flat, known_by=known_by)

    def at(self, at_s: Floats) -> tuple[Floats, Mask]:
        """Return interpolated poses at times ``at_s``, (N, 3), and the mask of times within the trajectory, (N,)."""
        if self.stamps_s is None or len(self) == 0:
            raise BadInput("trajectory: it has no stamps, so that its pose at a time is not known")
        at = np.asarray(at_s, dtype=np.float64)
        inside = (at >= self.stamps_s[0] - SLACK_S) & (at <= self.stamps_s[-1] + SLACK_S)
        return interpolate(self.stamps_s, self.poses, at), inside

    def placed(self, at_s: Floats) -> tuple[Floats, Mask, Mask]:
        """Return poses at times as `at` does, (N, 3), and two masks, (N,) each: times within, and times in no gap.
        A gap lies between two poses more than `MAX_INTERPOLATED_S` apart, and begins and ends `SLACK_S` from the poses.
        """
        poses, inside = self.at(at_s)
        assert self.stamps_s is not None
        before, after = self.stamps_s[list(bracketing_indices(self.stamps_s, at_s))]
        is_near = np.minimum(np.abs(at_s - before), np.abs(at_s - after)) <= SLACK_S
        return poses, inside, is_near | (after - before <= MAX_INTERPOLATED_S + SLACK_S)

    def of(self, frame: str | None, mount: Floats | None) -> "Trajectory":
        """Return the trajectory of the frame "base" or "laser"; ``mount`` is the laser's pose on the base, (3,).
        None is the default of `step_to`, both for ``frame`` and for a trajectory that does not name its frame.
        """
        new_frame, step = step_to(frame, mount, self.frame or ("laser" if mount is None else "base"))
        return replace(self if step is None else self.of_frame(step), frame=new_frame)

    def of_frame(self, mount: Floats) -> "Trajectory":
        """Return the trajectory of another frame, which lies at ``mount``, (3,), in this frame."""
        poses = compose(self.poses, mount)
        covariances = self.covariances
        if covariances is not None:
            jacobians = frame_jacobians(self.poses[:, 2], np.asarray(mount))
            covariances = jacobians @ covariances @ np.swapaxes(jacobians, 1, 2)
        draws = None if self.draws is None else compose(self.draws, mount)
        relative = None if self.relative is None else self.relative.of_frame(self.poses, np.asarray(mount))
        return Trajectory(poses, self.stamps_s, covariances, draws, relative, self.known_by)


def ellipses(centres: Floats, covariances: Floats, level: float = 0.95, points: int = 32) -> Floats:
    """Return the closed outlines of credible ellipses of normal positions, (S, points, 2), in the units of the means.
    Means are (S, 2), covariances (S, 2, 2). A squared Mahalanobis distance is below -2 log(1 - level) with this level.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, points)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * np.sqrt(-2.0 * np.log1p(-level))
    values, vectors = np.linalg.eigh(np.asarray(covariances))
    axes = vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :]
    return np.asarray(np.asarray(centres)[:, None] + circle @ np.swapaxes(axes, 1, 2))
