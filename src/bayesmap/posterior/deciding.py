"""What a run is asked when something is to be decided; the answers are computed in `bayesmap.posterior.decisions`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from bayesmap.posterior.information import Information
    from bayesmap.posterior.passage import FreeProbability
    from bayesmap.posterior.posterior import Posterior
    from bayesmap.posterior.route import Route
    from bayesmap.sensors.model import SensorModel


class Deciding:
    """Decisions from the draws of a posterior, for results that hold one."""

    posterior: Posterior

    def free_probability(self, path: ArrayLike, radius_m: float) -> FreeProbability:
        """The probability that a disc can go along a path without touching anything, counted over joint draws.

        Args:
            path: of the disc's centre: corners in the world frame, metres, (P, 2); one point for a place.
            radius_m: of the disc.

        Returns:
            ``.probability`` with its Monte Carlo ``.standard_error``, and ``.independent``: what the product over
            independent cells would say.

        Raises:
            BadInput: a run without draws, a path that is none or leaves the map, or a radius that is not positive.
        """
        from bayesmap.posterior.decisions import path_is_free

        return path_is_free(self.posterior, path, radius_m)

    def plan(self, start: ArrayLike, goal: ArrayLike, radius_m: float, risk: float = 0.01) -> Route:
        """The shortest path of a disc from start to goal whose risk of touching something stays under a bound.

        Args:
            start: in the world frame, metres, (2,).
            goal: likewise.
            radius_m: of the disc.
            risk: the most that the probability of touching something may be.

        Returns:
            The path with its `free_probability`; the safest that was found if none is ``.within_risk``.

        Raises:
            BadInput: a run without draws; start or goal outside the map or blocked in nearly every draw; no path.
        """
        from bayesmap.posterior.decisions import shortest_safe_path

        return shortest_safe_path(self.posterior, start, goal, radius_m, risk)

    def information_gain(
        self,
        poses: ArrayLike,
        angles_rad: ArrayLike | None = None,
        *,
        max_range_m: float | None = None,
        sensor: SensorModel | None = None,
        draws: int | None = None,
        seed: int = 0,
    ) -> Information:
        """How much one more scan from each pose is expected to tell about the map, in nats.

        Args:
            poses: in the world frame, (P, 3).
            angles_rad: of the beams in the sensor's frame, (A,); those of the run's scans unless given.
            max_range_m: of the sensor; that of the run's scans unless given.
            sensor: the law of the new readings; the run's unless given.
            draws: of the map that are compared: the more, the closer the bounds; the work grows with their square.
            seed: of the simulated scans.

        Returns:
            Bounds from joint draws, ``.at_least`` and ``.at_most`` with Monte Carlo errors, and ``.independent``: the
            formula for independent cells and beams (FSMI; Zhang et al., ICRA 2019).

        Raises:
            BadInput: fewer than two draws, or poses, angles or a range that are none.
        """
        from bayesmap.posterior.decisions import information_of

        return information_of(
            self.posterior, poses, angles_rad, max_range_m=max_range_m, sensor=sensor, draws=draws, seed=seed
        )
