"""Priors of the poses of a log: known, uncertain, or odometry through a motion model.

A prior (`KnownPoses`, `UncertainPoses`, `Odometry`, `Motions`) is a value that users pass. With the poses that the log
states it becomes a *law*, a density over the poses of all scans (`PoseLaw`), which samplers use. Laws follow priors.
"""

import hashlib
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Indices
from bayesmap.space.planar import Floats, between, chain_motions, lengths_and_turns, rotation, wrap_yaw
from bayesmap.space.scans import check_sigma_rad

LOG_ROOT_TWO_PI = 0.5 * math.log(2 * math.pi)
FREE_SIGMA = np.ones(3)  # standard deviations of a motion that odometry does not know, metres and radians


class PoseLaw(Protocol):
    """A density over the poses of S scans, (S, 3) in the world frame; leading dimensions broadcast."""

    def log_prob(self, poses: Floats) -> Floats:
        """Compute the log density of whole trajectories, (..., S, 3) to (...)."""

    def log_change(self, poses: Floats, proposed: Floats) -> Floats:
        """Compute the change of `log_prob` if one scan alone moves to its proposed pose, for each scan, (..., S)."""

    def precision(self, poses: Floats) -> Floats:
        """Return the precision of each pose given the others, in world axes, (S, 3, 3)."""

    def independent_groups(self) -> tuple[Indices, ...]:
        """Return groups of the scans that may move. Scans of one group are independent given all others."""

    def sample(self, rng: np.random.Generator) -> Floats:
        """Draw the poses of all scans, (S, 3)."""


class PosePrior(ABC):
    """A prior of the poses of a log."""

    kind: ClassVar[str]  # name of the prior in descriptions
    unknown: ClassVar[bool] = True  # True if the poses are to be inferred

    @abstractmethod
    def law(self, log_poses: Floats) -> PoseLaw:
        """Return the prior as a density, given the poses that the log states, (S, 3)."""

    def describe(self) -> dict[str, object]:
        """Return the prior as plain JSON values."""
        return {"kind": self.kind, **vars(self)}


@dataclass(frozen=True)
class KnownPoses(PosePrior):
    """The prior that fixes the poses at those of the log."""

    kind: ClassVar[str] = "known"
    unknown: ClassVar[bool] = False

    def law(self, log_poses: Floats) -> PoseLaw:
        """Return a law under which no pose moves."""
        return _FixedLaw(log_poses)


@dataclass(frozen=True)
class UncertainPoses(PosePrior):
    """The prior under which each pose is normal about the log's, independently.

    Attributes:
        sigma_m: standard deviation of x and of y, metres.
        sigma_rad: standard deviation of the heading, radians.

    Raises `BadInput` for a number that is not positive.
    """

    kind: ClassVar[str] = "uncertain"
    sigma_m: float
    sigma_rad: float

    def __post_init__(self) -> None:
        _check_positive("UncertainPoses", sigma_m=self.sigma_m, sigma_rad=self.sigma_rad)
        check_sigma_rad("UncertainPoses", self.sigma_rad)

    def law(self, log_poses: Floats) -> PoseLaw:
        """Return independent normal distributions about the log's poses."""
        return _IndependentLaw(log_poses, np.array([self.sigma_m, self.sigma_m, self.sigma_rad]))


@dataclass(frozen=True)
class Odometry(PosePrior):
    """The prior of a log whose poses are wheel odometry: each motion is normal about the stated one.

    In the frame of the earlier pose the motion from scan to scan has an error of zero mean, independent from motion to
    motion. Its standard deviations grow with the distance travelled and the angle turned, with the parameters of Thrun,
    Burgard and Fox (Probabilistic Robotics, 2005, section 5.4), as a normal distribution of the motion itself:

        sigma_xy^2  = (m_per_m d)^2 + (m_per_rad |turn|)^2 + still_m^2
        sigma_yaw^2 = (rad_per_m d)^2 + (rad_per_rad |turn|)^2 + still_rad^2

    The first pose is the log's: it is the frame of the map.

    Attributes:
        m_per_m, m_per_rad: error of the position in metres, per metre travelled and per radian turned.
        rad_per_m, rad_per_rad: error of the heading in radians, per metre travelled and per radian turned.
        still_m, still_rad: error of a robot that stands still.

    Raises `BadInput` for a number that is negative, or a standing error that is not positive.
    """

    kind: ClassVar[str] = "odometry"
    m_per_m: float = 0.1
    m_per_rad: float = 0.05
    rad_per_m: float = 0.05
    rad_per_rad: float = 0.1
    still_m: float = 0.005
    still_rad: float = 0.003

    def __post_init__(self) -> None:
        _check_positive("Odometry", still_m=self.still_m, still_rad=self.still_rad)
        for name in ("m_per_m", "m_per_rad", "rad_per_m", "rad_per_rad"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise BadInput(f"Odometry: {name} must be a number that is not negative, got {value!r}")

    def law(self, log_poses: Floats) -> PoseLaw:
        """Return a Markov chain of poses whose motions are normal about the log's."""
        motions = between(log_poses[:-1], log_poses[1:])
        return _MarkovLaw(log_poses[0], motions, self.sigmas(motions))

    def sigmas(self, motions: Floats) -> Floats:
        """Return standard deviations of x, y and yaw of the error of each motion, (..., 3)."""
        lengths_m, turns_rad = lengths_and_turns(motions)
        xy = np.sqrt((self.m_per_m * lengths_m) ** 2 + (self.m_per_rad * turns_rad) ** 2 + self.still_m**2)
        yaw = np.sqrt((self.rad_per_m * lengths_m) ** 2 + (self.rad_per_rad * turns_rad) ** 2 + self.still_rad**2)
        return np.stack([xy, xy, yaw], axis=-1)


@dataclass(frozen=True, eq=False)
class Motions(PosePrior):
    """The prior under which each motion from scan to scan is normal about a stated one, such as corrected odometry.

    With probability ``p_slip`` the stated motion does not depend on the true one: a wheel slipped, or the log repeats a
    pose while the robot turns. The true motion is then normal about the stated one with `FREE_SIGMA` deviations.

    Raises `BadInput` for shapes that do not fit, deviations that are not positive, or a probability outside [0, 1).
    """

    kind: ClassVar[str] = "motions"
    relative: Floats  # each scan's pose in the frame of the one before, (S - 1, 3)
    sigmas: Floats  # standard deviations of their x, y and yaw, (S - 1, 3)
    p_slip: float = 0.0  # probability of a slip

    def __post_init__(self) -> None:
        if not 0 <= self.p_slip < 1:
            raise BadInput(f"Motions: p_slip must lie in [0, 1), got {self.p_slip!r}")
        if self.relative.shape != self.sigmas.shape or self.relative.shape[1:] != (3,):
            raise BadInput(f"Motions: shapes {self.relative.shape} and {self.sigmas.shape}, expected (S - 1, 3) twice")
        if not (np.isfinite(self.sigmas).all() and (self.sigmas > 0).all()):
            raise BadInput("Motions: all standard deviations must be positive numbers")

    def law(self, log_poses: Floats) -> PoseLaw:
        """Return a Markov chain of poses from the log's first. Raises `BadInput` for another number of scans."""
        if len(log_poses) != len(self.relative) + 1:
            raise BadInput(f"Motions: {len(self.relative)} motions, but {len(log_poses)} scans")
        return _MarkovLaw(log_poses[0], self.relative, self.sigmas, self.p_slip)

    def describe(self) -> dict[str, object]:
        """Return the prior as plain JSON values, with the checksum of motions."""
        digest = hashlib.blake2b(self.relative.tobytes() + self.sigmas.tobytes(), digest_size=8)
        description = {"kind": self.kind, "count": len(self.relative), "checksum": digest.hexdigest()}
        return description | ({"p_slip": self.p_slip} if self.p_slip else {})


@dataclass(frozen=True, eq=False)
class _FixedLaw:
    """The law that holds all mass at one trajectory."""

    poses: Floats  # (S, 3)

    def log_prob(self, poses: Floats) -> Floats:
        return np.where((poses == self.poses).all(axis=(-2, -1)), 0.0, -np.inf)

    def log_change(self, poses: Floats, proposed: Floats) -> Floats:
        return np.where((proposed == self.poses).all(axis=-1), 0.0, -np.inf)

    def precision(self, poses: Floats) -> Floats:
        return np.broadcast_to(np.eye(3) * 1e30, (len(self.poses), 3, 3))  # no pose can move

    def independent_groups(self) -> tuple[Indices, ...]:
        return ()

    def sample(self, rng: np.random.Generator) -> Floats:
        return self.poses.copy()


@dataclass(frozen=True, eq=False)
class _IndependentLaw:
    """The law of independent, normal poses."""

    mean: Floats  # (S, 3)
    sigma: Floats  # standard deviations of x, y and yaw, (3,)

    def _log_densities(self, poses: Floats) -> Floats:
        return _log_normal(wrap_yaw(poses - self.mean), self.sigma)

    def log_prob(self, poses: Floats) -> Floats:
        return np.asarray(self._log_densities(poses).sum(axis=-1))

    def log_change(self, poses: Floats, proposed: Floats) -> Floats:
        return self._log_densities(proposed) - self._log_densities(poses)

    def precision(self, poses: Floats) -> Floats:
        return np.broadcast_to(np.diag(self.sigma**-2.0), (len(self.mean), 3, 3))

    def independent_groups(self) -> tuple[Indices, ...]:
        return (np.arange(len(self.mean)),)

    def sample(self, rng: np.random.Generator) -> Floats:
        return np.asarray(self.mean + self.sigma * rng.standard_normal(self.mean.shape))


@dataclass(frozen=True, eq=False)
class _MarkovLaw:
    """The law of a Markov chain of poses: normal motions, from a fixed first pose."""

    first: Floats  # (3,)
    motions: Floats  # mean motions from scan to scan, in the earlier one's frame, (S - 1, 3)
    sigmas: Floats  # standard deviations of their errors, (S - 1, 3)
    p_slip: float = 0.0  # probability that a motion has errors of the size of `FREE_SIGMA` instead

    def _log_densities(self, before: Floats, after: Floats) -> Floats:
        """Return the log density of each motion, (..., S - 1)."""
        error = wrap_yaw(between(before, after) - self.motions)
        return np.logaddexp(*self._joint(error)) if self.p_slip else _log_normal(error, self.sigmas)

    def _joint(self, error: Floats) -> tuple[Floats, Floats]:
        """Return log joint densities of errors and no slip, and of errors and a slip, (..., S - 1) each."""
        no_slip, slip = _log_normal(error, self.sigmas), _log_normal(error, np.maximum(self.sigmas, FREE_SIGMA))
        return no_slip + math.log1p(-self.p_slip), slip + math.log(self.p_slip)

    def log_prob(self, poses: Floats) -> Floats:
        chain = self._log_densities(poses[..., :-1, :], poses[..., 1:, :]).sum(axis=-1)
        return np.where((poses[..., 0, :] == self.first).all(axis=-1), chain, -np.inf)

    def log_change(self, poses: Floats, proposed: Floats) -> Floats:
        present = self._log_densities(poses[..., :-1, :], poses[..., 1:, :])
        change = np.zeros(poses.shape[:-1])
        change[..., 1:] += self._log_densities(poses[..., :-1, :], proposed[..., 1:, :]) - present
        change[..., :-1] += self._log_densities(proposed[..., :-1, :], poses[..., 1:, :]) - present
        change[..., 0] = -np.inf  # the first pose is fixed
        return change

    def precision(self, poses: Floats) -> Floats:
        motions, weights = between(poses[:-1], poses[1:]), self.sigmas**-2.0
        if self.p_slip:
            no_slip, slip = self._joint(wrap_yaw(motions - self.motions))
            p_slipped = np.exp(slip - np.logaddexp(no_slip, slip))[:, None]
            weights = (1.0 - p_slipped) * weights + p_slipped * np.maximum(self.sigmas, FREE_SIGMA) ** -2.0
        # Add J^T W J of both poses. The error of a motion, in the earlier pose's frame, is R(-yaw) (p' - p) - motion.
        by_later = rotation(-poses[:-1, 2])
        by_earlier = -by_later
        by_earlier[:, 0, 2], by_earlier[:, 1, 2] = motions[:, 1], -motions[:, 0]
        precision = np.zeros((len(poses), 3, 3))
        precision[1:] += np.einsum("sji,sj,sjk->sik", by_later, weights, by_later)
        precision[:-1] += np.einsum("sji,sj,sjk->sik", by_earlier, weights, by_earlier)
        return precision if len(poses) > 1 else np.eye(3)[None]

    def independent_groups(self) -> tuple[Indices, ...]:
        n_scans = len(self.motions) + 1
        groups = np.arange(1, n_scans, 2), np.arange(2, n_scans, 2)
        return tuple(group for group in groups if len(group))

    def sample(self, rng: np.random.Generator) -> Floats:
        sigmas = self.sigmas
        if self.p_slip:
            slipped = rng.random(len(sigmas)) < self.p_slip
            sigmas = np.where(slipped[:, None], np.maximum(sigmas, FREE_SIGMA), sigmas)
        noisy = self.motions + sigmas * rng.standard_normal(self.motions.shape)
        return np.vstack([self.first, chain_motions(self.first, noisy)])


def _log_normal(error: Floats, sigma: Floats) -> Floats:
    """Return the log density of independent normal errors of x, y and yaw, (..., 3) to (...)."""
    return np.asarray((-0.5 * (error / sigma) ** 2 - np.log(sigma) - LOG_ROOT_TWO_PI).sum(axis=-1))


def _check_positive(name: str, **values: float) -> None:
    """Raise `BadInput` for a field of the prior ``name`` that is not a positive number."""
    for field, value in values.items():
        if not (math.isfinite(value) and value > 0):
            raise BadInput(f"{name}: {field} must be a positive number, got {value!r}")
