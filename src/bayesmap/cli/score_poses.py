"""The part of ``bayesmap score`` that holds trajectories against true relations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.world import pose_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.posterior.trajectory_scores import TrajectoryScore
    from bayesmap.space.trajectory import Trajectory

FRAMES = ("base", "laser")


@dataclass(frozen=True)
class Frames:
    """Which frame's relations are known, and where the laser sits.

    Attributes:
        frame: base or laser, or None where the user says nothing: the base's, if it is known where the laser sits.
        laser: its pose on the robot as typed, or None.
    """

    frame: str | None
    laser: str | None

    def mount(self, log: str | None, options: dict[str, Any]) -> NDArray[np.float64] | None:
        """The pose of the laser on the robot, as typed or as the log says; None where neither does.

        Raises:
            click.BadParameter: something that is not a pose.
            BadInput: a log that cannot be read.
        """
        import numpy as np

        if self.laser is not None:
            return np.array(pose_of(self.laser, "--laser"))
        if log is None or self.frame == "laser":
            return None
        from bayesmap.io.logs import describe_log

        return np.array(describe_log(log, **options).laser_offset)

    def base_in_laser(self, mount: NDArray[np.float64] | None) -> NDArray[np.float64] | None:
        """Where the frame whose relations are known is, as seen from the laser; None if they are the laser's.

        Raises:
            BadInput: relations of the base, and nobody knows where the laser sits.
        """
        from bayesmap.space.planar import inverse

        if self.frame == "laser" or (self.frame is None and mount is None):
            return None
        if mount is None:
            raise BadInput("score: --frame base needs to know where the laser sits: give LOG, or --laser X,Y,DEGREES")
        return inverse(mount)


def check_frames(frame: str | None, laser: str | None, relations: str | None) -> Frames:
    """The frames as typed.

    Raises:
        click.UsageError: a frame without relations.
    """
    if frame is not None and relations is None:
        raise click.UsageError("--frame says whose --relations are known; give both")
    return Frames(frame, laser)


def score_poses(
    trajectory: Trajectory, path: str, base_in_laser: NDArray[np.float64] | None, *, exact: bool
) -> TrajectoryScore:
    """Hold a laser's trajectory against a file of relations."""
    from bayesmap.io.text.relations import read_relations
    from bayesmap.posterior.trajectory_scores import score_trajectory

    return score_trajectory(trajectory, read_relations(path), base_in_laser, exact=exact)


def lines_of(found: TrajectoryScore, frame: str, *, exact: bool, of_run: bool) -> list[str]:
    """The score as lines of text.

    Args:
        found: the score.
        frame: whose relations they are.
        exact: whether only times of poses count.
        of_run: whether the poses are those of a saved run, for advice where nothing is known of how sure they are.
    """
    from bayesmap.poses.relations import LONGEST_GAP_S

    figures = found.as_json()
    missing = ""
    if figures["in_gaps"]:
        where = "not at times of poses" if exact else f"between poses over {LONGEST_GAP_S:g} s apart"
        missing = f"; {figures['in_gaps']:,} more are {where}, and left out"
    if outside := figures["not_covered"] - figures["in_gaps"]:
        missing += f"; {outside:,} more are of other times"
    lines = [
        f"relations    {figures['relations']:,}, of the {frame}{missing}",
        f"translation  {figures['translation_m_mean']:.4f} +- {figures['translation_m_std']:.4f} m, "
        f"median {figures['translation_m_median']:.4f}",
        f"rotation     {figures['rotation_deg_mean']:.3f} +- {figures['rotation_deg_std']:.3f} degrees, "
        f"median {figures['rotation_deg_median']:.3f}",
    ]
    if figures["coverage"] is not None:
        held = ", ".join(f"{100 * c['share']:.1f} of {100 * c['level']:g}" for c in figures["coverage"])
        nees = figures["nees"]
        lines.append(
            f"regions      hold {held} %, if relations are exact; "
            f"NEES {nees['mean']:.2f}, median {nees['median']:.2f} (3 is right)"
        )
        lines += [f"by           {found.known_by}"] if found.known_by else []
    elif of_run:
        lines.append(
            "regions      unknown: the run takes its poses as known, or was saved by an earlier version, and has no "
            "covariances of them; slam saves them"
        )
    else:
        lines.append(
            "regions      unknown: the poses come without covariances; "
            "--trajectory FILE.tum with FILE-covariances.txt beside it has them"
        )
    return lines
