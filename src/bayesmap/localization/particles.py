"""Importance sampling of poses: a mixture of proposals, adapted until it lies where the posterior does.

Each round draws from a mixture of Student distributions about the present places, weights the draws by
target / proposal, and moves the places to the weighted means (population Monte Carlo; Cappe, Guillin, Marin and
Robert 2004). The last round's weights are unbiased for the posterior, and their mean for its normaliser. Draws are
spread evenly: they are points of a lattice with a random shift, so that each point has the law of a single draw.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaincinv, gammaln, ndtri

from bayesmap.space.planar import Floats, wrap_angle

DOF = 5.0
STUDENT_CONSTANT = gammaln((DOF + 3) / 2) - gammaln(DOF / 2) - 1.5 * np.log(DOF * np.pi)
LATTICE = 1.1673039782614187 ** -np.arange(1.0, 5.0)
LEAST_SD = np.array([0.004, 0.004, np.radians(0.1)])  # least standard deviations of a proposal
OVERLAP, SAME = 2.0, np.array([0.2, 0.2, np.radians(7.0)])  # nearer places are one mode: sigmas; x, y, yaw
COUNTING, ENOUGH = 0.3, 16.0  # weights are tempered until this share of a place's draws, or this number, is effective
NEGLIGIBLE_NATS = 15.0  # difference in log mass from the greatest beyond which places are dropped


def log_sum(logs: Floats) -> Floats:
    """Compute log sum exp over the last axis. SciPy's function is far slower for small arrays."""
    most = logs.max(axis=-1, keepdims=True)
    most = np.where(np.isfinite(most), most, 0.0)
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(np.exp(logs - most).sum(axis=-1)) + most[..., 0])


@dataclass(frozen=True, eq=False)
class PoseMixture:
    """K places, each with a mean pose, a covariance and a mass."""

    means: Floats  # (K, 3)
    covariances: Floats  # (K, 3, 3)
    log_mass: Floats  # log of each place's share of the target, up to a constant, (K,)

    def best(self, most: int, within_nats: float = NEGLIGIBLE_NATS) -> PoseMixture:
        """Return the ``most`` places of greatest mass, without those more than ``within_nats`` below the first."""
        order = np.argsort(-self.log_mass, kind="stable")[:most]
        order = order[self.log_mass[order] > self.log_mass[order[0]] - within_nats]
        return self.select(order)

    def select(self, places: Sequence[int] | NDArray[np.intp]) -> PoseMixture:
        """Return some of the places, by number."""
        return PoseMixture(self.means[places], self.covariances[places], self.log_mass[places])

    def draw(
        self, target: Callable[[Floats], Floats], each: int | NDArray[np.intp], rng: np.random.Generator
    ) -> Population:
        """Draw ``each`` poses from each place, one number or (K,), and weight them. Masses of places are not used.
        ``target`` is the log density of poses (P, 3), not normalised, (P,).
        """
        counts = np.broadcast_to(each, len(self.means))
        place = np.repeat(np.arange(len(counts)), counts)
        roots = np.linalg.cholesky(self.covariances)
        poses = self.means[place] + np.matmul(roots[place], student_draws(len(place), rng)[..., None])[..., 0]
        poses[:, 2] = wrap_angle(poses[:, 2])
        log_target = target(poses)
        log_weights = log_target - log_sum(self._student_logs(poses) + np.log(counts / counts.sum()))
        # Truncated importance sampling (Ionides 2008): no weight exceeds the mean by more than the root of their count.
        most = log_sum(log_weights) - 0.5 * np.log(len(poses))
        return Population(poses, np.minimum(log_weights, most), place, log_target)

    def shared_out(self, most: int, least: float = 1 / 3) -> NDArray[np.intp]:
        """Return the number of draws of each place, (K,): by the root of its mass, at least ``least * most``."""
        shares = np.exp(0.5 * (self.log_mass - self.log_mass.max()))
        return np.asarray(np.maximum(np.round(most * shares), int(most * least)), dtype=np.intp)

    def groups_of(self, poses: Floats) -> NDArray[np.intp]:
        """Label poses by place, (P,); places closer than `OVERLAP` standard deviations, or `SAME`, share a label."""
        from scipy.sparse.csgraph import connected_components

        if len(self.means) == 1:
            return np.zeros(len(poses), dtype=np.intp)
        off = self.means[:, None] - self.means
        off[..., 2] = wrap_angle(off[..., 2])
        both = np.linalg.inv(self.covariances[:, None] + self.covariances)
        near = np.einsum("kli,klij,klj->kl", off, both, off) < OVERLAP**2
        near |= (np.abs(off) < SAME).all(axis=2)
        _, group = connected_components(near, directed=False)
        return np.asarray(group[self._student_logs(poses).argmax(axis=1)], dtype=np.intp)

    def squared_distances(self, poses: Floats) -> tuple[Floats, Floats]:
        """Return squared Mahalanobis distances of poses from the places, (P, K), and half of log determinants, (K,)."""
        off = poses - self.means[:, None]
        off[..., 2] = wrap_angle(off[..., 2])
        inverse = np.linalg.inv(self.covariances)
        squared = (np.matmul(off, inverse) * off).sum(axis=-1)
        return np.ascontiguousarray(squared.T), -0.5 * np.linalg.slogdet(inverse)[1]

    def _student_logs(self, poses: Floats) -> Floats:
        """Return the log density of each place's Student distribution, (P, K)."""
        squared, half_log_det = self.squared_distances(poses)
        return np.asarray(STUDENT_CONSTANT - half_log_det - 0.5 * (DOF + 3) * np.log1p(squared / DOF))

    def weighed(self, population: Population) -> PoseMixture:
        """Return the places with new masses: the sums of the weights of the draws from each."""
        masses = [log_sum(population.log_weights[population.place == k]) for k in range(len(self.means))]
        return PoseMixture(self.means, self.covariances, np.array(masses))

    def adapted(self, population: Population, widen: float = 1.5) -> tuple[PoseMixture, float]:
        """Return the places at the weighted moments of their draws, and the least power by which weights were tempered.
        With a power of 1 the proposals are near the target. With a lower power, another round will improve them.
        """
        count, least = len(self.means), 1.0
        means, covariances, log_mass = self.means.copy(), self.covariances.copy(), np.full(count, -np.inf)
        for k in range(count):
            own = population.place == k
            logs = population.log_weights[own]
            most = logs.max()
            if not np.isfinite(most):
                continue
            # Temper the weights until several draws are effective: a single dominant draw has no spread.
            power = 1.0
            less = logs - most
            weights = np.exp(less)
            top = most + np.log(weights.sum())
            while weights.sum() ** 2 < min(COUNTING * len(logs), ENOUGH) * (weights @ weights) and power > 1e-3:
                power *= 0.8
                weights = np.exp(power * less)
            weights /= weights.sum()
            off = population.poses[own] - means[k]
            off[:, 2] = wrap_angle(off[:, 2])
            shift = weights @ off
            error = off - shift
            covariances[k] = widen * np.einsum("n,ni,nj->ij", weights, error, error) + np.diag(LEAST_SD**2)
            means[k] += shift
            log_mass[k] = top
            least = min(least, power)
        return PoseMixture(means, covariances, log_mass), least


@dataclass(frozen=True, eq=False)
class Population:
    """N weighted poses. Their mean weight, of target / proposal, estimates the target's normaliser."""

    poses: Floats  # (N, 3)
    log_weights: Floats  # log of target / proposal, not normalised, (N,)
    place: NDArray[np.intp]  # number of the place from which each pose was drawn, (N,)
    log_target: Floats  # (N,)

    @property
    def log_evidence(self) -> float:
        """Log of the integral of the target."""
        return float(log_sum(self.log_weights) - np.log(len(self.poses)))

    @property
    def weights(self) -> Floats:
        """Normalised weights, (N,)."""
        return np.asarray(np.exp(self.log_weights - log_sum(self.log_weights)))


def student_draws(count: int, rng: np.random.Generator) -> Floats:
    """Draw from the standard Student distribution in three dimensions, evenly spread, (N, 3). The lattice is Roberts'
    (2018), powers of the root of x^5 = x + 1, shifted at random (Cranley and Patterson 1976).
    """
    even = (rng.random(4) + np.arange(count)[:, None] * LATTICE) % 1.0
    even = np.clip(even, 1e-12, 1.0 - 1e-12)
    stretch = np.sqrt(0.5 * DOF / gammaincinv(0.5 * DOF, even[:, 3:]))
    return np.asarray(stretch * ndtri(even[:, :3]))
