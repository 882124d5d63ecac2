"""Match points to likelihood grids: the matcher of front end and loop closure.

`likelihood_grids` makes grids from scans. A cell has the value 255 exp(-d^2 / (2 sigma^2)), where d is its distance
from the nearest point (Olson 2009, "Real-time correlative scan matching"; the likelihood field of Thrun, Burgard and
Fox 2005, section 6.4, without the logarithm). Level h of the pyramid holds at (x, y) the largest value of the cells
(x .. x + 2^h - 1, y .. y + 2^h - 1) (Hess et al. 2016).

`match` finds the best poses by branch and bound. The score of a pose is the mean value of the cells in which the points
fall, from 0 to 1, less a penalty for the distance from the centre of the window.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.arrays import Indices, Mask, offsets_of
from bayesmap.space.planar import Floats, transform, wrap_angle

ROUNDING = 1e-9  # added before a quotient is rounded down, so that whole quotients stay whole
ANY_SCORE = -9.0  # minimum score that accepts any pose: a score less the penalty is above it


@dataclass(frozen=True, eq=False)
class LikelihoodGrids:
    """Likelihood grids of one shape and resolution."""

    pyramid: Any  # bytes on the device, (grids, levels, nx, ny); level 0 is the likelihood
    origins: Floats  # corner of each grid, metres in the grids' frame, (grids, 2)
    resolution: float  # width of a cell, metres
    device: str = "cpu"  # device of the pyramid
    threads: int | None = None  # number of threads that search the grids; all cores if None

    def __len__(self) -> int:
        return len(self.origins)


def point_likelihood(resolution: float, sigma_m: float) -> NDArray[np.uint8]:
    """Return the likelihood around a single point, an odd square of bytes, out to about two standard deviations."""
    radius = max(1, int(np.ceil(2.0 * sigma_m / resolution)))
    offsets = np.arange(-radius, radius + 1) * resolution
    squared = offsets[:, None] ** 2 + offsets[None, :] ** 2
    return np.round(255.0 * np.exp(-squared / (2.0 * sigma_m**2))).astype(np.uint8)


def likelihood_grids(
    geometry: ScanGeometry, scans: Sequence[Indices], scan_poses: Sequence[Floats], centres: Floats,
    half_width_m: float, *, resolution: float = 0.05, sigma_m: float = 0.07, levels: int = 4,
    reuse: LikelihoodGrids | None = None,
) -> LikelihoodGrids:  # fmt: skip
    """Compute square likelihood grids about ``centres``, (grids, 2), each from scans at poses in the grids' frame.

    ``half_width_m`` is the distance from a centre to each side. The search bounds blocks of up to 2^(levels - 1)
    cells at once. ``reuse`` are grids of the same number, size and levels, whose memory is overwritten. Between
    neighbouring beams on one wall points are filled in, so that grids do not depend on the number of beams.
    """
    from bayesmap.kernels.match.likelihood_grid import GridScans, render_grids

    cells = int(np.ceil(2.0 * half_width_m / resolution))
    scan = np.concatenate([np.zeros(0, np.int32), *(np.asarray(indices, np.int32) for indices in scans)])
    poses = np.concatenate([np.zeros((0, 3)), *(np.reshape(rows, (-1, 3)) for rows in scan_poses)])
    origins = np.asarray(centres, np.float64).reshape(-1, 2) - half_width_m
    grids = GridScans(
        origins, resolution, offsets_of(scans), scan, poses, point_likelihood(resolution, sigma_m), spacing_m=sigma_m
    )
    overwritten = None if reuse is None else reuse.pyramid
    pyramid = render_grids(geometry, grids, (cells, cells), levels, geometry.threads, overwritten)
    return LikelihoodGrids(pyramid, origins, resolution, geometry.device, geometry.threads)


@dataclass(frozen=True)
class Pull:
    """The penalty in score for leaving the window's centre: weight (d^2 / sigma_m^2 + turn^2 / sigma_rad^2) / 2."""

    sigma_m: float
    sigma_rad: float
    weight: float = 0.01  # twice the penalty at one standard deviation


@dataclass(frozen=True, eq=False)
class SearchWindows:
    """The windows of poses, in the grids' frame, in which J jobs search."""

    centres: Floats  # poses of the middles, (J, 3)
    half_m: Floats | float  # half widths, metres: one for all, one per job (J,), or x and y per job (J, 2)
    half_rad: Floats | float  # half ranges of headings: one for all, or one per job (J,); pi or more is the full circle
    step_rad: float = np.radians(0.5)  # step between headings


@dataclass(frozen=True)
class ModeRule:
    """The rule for several poses of one window: each is the best that is apart from all before it."""

    max_modes: int = 1
    min_score_ratio: float = 0.0  # score of a further pose, divided by the first pose's score
    apart_m: float = 0.5  # poses are apart if they differ by more than this in x or in y,
    apart_rad: float = np.radians(10.0)  # or by more than this in heading


@dataclass(frozen=True, eq=False)
class Matches:
    """The best poses of J jobs, up to M each, best first."""

    scores: Floats  # scores of the poses, (J, M); -inf where no further pose reaches the minimum score
    poses: Floats  # poses in the grids' frame, (J, M, 3); NaN where there is none

    @property
    def has_pose(self) -> Mask:
        """Mask of the entries with a pose, (J, M)."""
        return np.isfinite(self.scores)


def match(
    grids: LikelihoodGrids, points: Sequence[Floats], windows: SearchWindows, *, grid_of: Indices | None = None,
    min_score: Floats | float = 0.0, pull: Pull | None = None, modes: ModeRule | None = None, threads_per_job: int = 1,
) -> Matches:  # fmt: skip
    """Match points to grids, J jobs at once, and return the best poses of each job.

    ``points`` are the points of each job in the sensor's frame, (N, 2). ``grid_of`` is the grid of each job, (J,), by
    default grid j for job j, or the only grid. Scores must exceed ``min_score``, a number or (J,): high values end
    searches early. ``pull`` is the penalty for leaving the centre. The result does not depend on ``threads_per_job``,
    which share a job. Raises `BadInput` if a centre is not finite.
    """
    from bayesmap.kernels.match.branch_and_bound import Modes, Windows, search_grids

    modes = ModeRule() if modes is None else modes
    jobs, step_rad = len(points), windows.step_rad
    if jobs == 0:
        return Matches(np.empty((0, modes.max_modes)), np.empty((0, modes.max_modes, 3)))
    centres = np.asarray(windows.centres, np.float64).reshape(-1, 3)
    if not np.isfinite(centres).all():
        raise BadInput("match: a window's centre is not finite")
    if grid_of is None:
        grid_of = np.zeros(jobs, np.intp) if len(grids) == 1 else np.arange(jobs)
    half_m = np.asarray(windows.half_m, np.float64)
    half_m = np.broadcast_to(half_m[:, None] if half_m.ndim == 1 else half_m, (jobs, 2))
    # List all angles of all jobs as rows, with the penalty of each angle and per cell of distance.
    half_rad = np.broadcast_to(np.asarray(windows.half_rad), (jobs,))
    deviations = [_deviations(float(half_range), step_rad) for half_range in half_rad]
    row_offsets, off_rad = offsets_of(deviations), np.concatenate(deviations)
    angles = np.repeat(centres[:, 2], np.diff(row_offsets)) + off_rad
    cell_cost, angle_costs = 0.0, np.zeros(len(off_rad))
    if pull is not None:
        cell_cost = pull.weight * grids.resolution**2 / (2.0 * pull.sigma_m**2)
        angle_costs = pull.weight * off_rad**2 / (2.0 * pull.sigma_rad**2)
    apart_cells = int(modes.apart_m / grids.resolution + ROUNDING)
    apart = (int(modes.apart_rad / step_rad + ROUNDING), apart_cells, apart_cells)
    rule = Modes(modes.max_modes, modes.min_score_ratio, apart)
    searches = Windows(
        points=np.concatenate([np.reshape(xy, (-1, 2)) for xy in points]), point_offsets=offsets_of(points),
        grid=np.asarray(grid_of, np.int32), centres=np.ascontiguousarray(centres[:, :2]),
        half_cells=np.round(half_m / grids.resolution).astype(np.int32), angles_rad=angles, angle_costs=angle_costs,
        row_offsets=row_offsets, min_scores=np.array(np.broadcast_to(np.asarray(min_score, np.float64), (jobs,))),
        off_centre_costs=np.full(jobs, cell_cost),
    )  # fmt: skip
    scores, nodes = search_grids(grids, searches, rule, threads_per_job, grids.threads)
    # Convert the best rows and shifts to poses.
    poses = np.full((jobs, modes.max_modes, 3), np.nan)
    job, mode = np.nonzero(nodes[..., 0] >= 0)
    row, shift = nodes[job, mode, 0], nodes[job, mode, 1:]
    poses[job, mode, :2] = centres[job, :2] + shift * grids.resolution
    poses[job, mode, 2] = wrap_angle(angles[row])
    return Matches(scores, poses)


def score_at(grids: LikelihoodGrids, grid: int, points: Floats, poses: Floats) -> Floats:
    """Compute the score of points, (N, 2) in the sensor's frame, at poses (P, 3) of one grid, (P,), without search."""
    poses = np.atleast_2d(poses)
    values = grids.pyramid.numpy()[grid, 0]
    cells = np.floor((transform(poses[:, None], points[None]) - grids.origins[grid]) / grids.resolution).astype(int)
    inside = (cells >= 0).all(axis=-1) & (cells < values.shape).all(axis=-1)
    cells = np.where(inside[..., None], cells, 0)
    point_values = np.where(inside, values[cells[..., 0], cells[..., 1]], 0)
    return np.asarray(point_values.sum(axis=1, dtype=np.int64) / (255.0 * max(1, len(points))))


def _deviations(half_rad: float, step_rad: float) -> Floats:
    """Return the angles from the centre: whole steps in the window, or steps around the full circle."""
    if half_rad >= np.pi:
        count = int(np.ceil(2.0 * np.pi / step_rad))
        return np.asarray(-np.pi + np.arange(count) * (2.0 * np.pi / count))
    steps = int(half_rad / step_rad + ROUNDING)
    return np.asarray(np.arange(-steps, steps + 1) * step_rad)
