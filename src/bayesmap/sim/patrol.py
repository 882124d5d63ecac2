"""A robot's round through a building: into every room that it can reach, along paths clear of the walls."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput, check_count
from bayesmap.sim.building import Building
from bayesmap.sim.clearance import lattice_stride, passage_m, wall_distance_m

if TYPE_CHECKING:
    from scipy import sparse

WALL_DISLIKE = 4.0
"""How many times dearer a path is close to the walls than in the open: robots keep to the middle."""

SMOOTHING_M = 0.5
HEADING_M = 0.2


def patrol(building: Building, n_scans: int, seed: int = 0) -> NDArray[np.float64]:
    """Simulate the poses of a robot that goes round a building and enters its rooms.

    From the first corridor it goes to the nearest room that it has not seen, again and again, by shortest
    paths that prefer open floor. Scans are taken at equal distances along the way.

    Args:
        building: the building.
        n_scans: number of poses; a round needs about one for every metre to enter every room visibly.
        seed: chooses where in each room the robot goes.

    Returns:
        Poses in the world frame, shape (n_scans, 3): x and y in metres, yaw in radians along the direction of
        travel. None is within `ROBOT_CLEARANCE_M` of a wall.

    Raises:
        BadInput: no scans asked for, or a building without floor that a robot can pass.
    """
    if n_scans < 1:
        raise BadInput(f"patrol: n_scans must be at least 1, got {n_scans!r}")
    lattice = _Lattice(building)
    stops = lattice.stops(np.random.default_rng(check_count("patrol", "seed", seed, 0)))
    path = _smooth(lattice.tour(stops), lattice)
    steps = np.hypot(*np.diff(path, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(0.0, along[-1], n_scans)
    xy = _along(path, along, at)
    # The direction of travel over the next few steps, not of one step of the lattice.
    heading = _along(path, along, at + HEADING_M) - xy
    arrived = np.hypot(*heading.T) < 1e-9
    heading[arrived] = (xy - _along(path, along, at - HEADING_M))[arrived]
    return np.column_stack([xy, np.arctan2(heading[:, 1], heading[:, 0])])


def _along(
    path_m: NDArray[np.float64], length_m: NDArray[np.float64], at_m: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return points of a path at the given lengths along it, held at its ends."""
    return np.stack([np.interp(at_m, length_m, path_m[:, k]) for k in (0, 1)], axis=1)


class _Lattice:
    """Every k-th cell where a robot fits, linked to its eight neighbours: the largest connected part."""

    def __init__(self, building: Building) -> None:
        from scipy import ndimage

        self.building, self.resolution = building, building.grid.resolution
        stride = lattice_stride(self.resolution)
        self.clearance_m = wall_distance_m(building.walls, self.resolution)
        start = stride // 2
        clearance = self.clearance_m[start::stride, start::stride].copy()
        centers = building.grid.centers_m()
        x, y = centers[0][start::stride], centers[1][start::stride]
        inside = _inside(building, x, y)
        fits = inside & (clearance >= passage_m(self.resolution))
        labels, count = ndimage.label(fits, structure=np.ones((3, 3)))
        if count == 0:
            raise BadInput("patrol: there is no floor wide enough for a robot")
        largest = 1 + int(np.argmax(np.bincount(labels[labels > 0])[1:]))
        self.nodes = np.argwhere(labels == largest)
        self.points_m = np.column_stack([x[self.nodes[:, 0]], y[self.nodes[:, 1]]])
        self.node_clearance_m = clearance[tuple(self.nodes.T)]
        self.graph = self._links(fits.shape, stride * self.resolution)

    def _links(self, shape: tuple[int, ...], spacing_m: float) -> sparse.csr_array:
        from scipy import sparse

        number = np.full(shape, -1)
        number[tuple(self.nodes.T)] = np.arange(len(self.nodes))
        padded = np.pad(number, 1, constant_values=-1)
        dislike = 1 + WALL_DISLIKE * np.exp(-(self.node_clearance_m - passage_m(self.resolution)) / 0.2)
        rows, columns, costs = [], [], []
        for di, dj in ((1, 0), (0, 1), (1, 1), (1, -1)):
            other = padded[1 + di : 1 + di + shape[0], 1 + dj : 1 + dj + shape[1]]
            linked = (number >= 0) & (other >= 0)
            a, b = number[linked], other[linked]
            rows.append(a)
            columns.append(b)
            costs.append(spacing_m * np.hypot(di, dj) * (dislike[a] + dislike[b]) / 2)
        entries = (np.concatenate(costs), (np.concatenate(rows), np.concatenate(columns)))
        return sparse.csr_array(entries, shape=(len(self.nodes), len(self.nodes)))

    def stops(self, rng: np.random.Generator) -> list[int]:
        """Choose one node in each room within reach, in the open and near a random point of the room's middle."""
        stops = []
        x, y = self.points_m.T
        for room in sorted(self.building.rooms, key=lambda room: room.kind != "corridor"):
            x0, x1, y0, y1 = room.extent_m
            here = np.nonzero((x > x0) & (x < x1) & (y > y0) & (y < y1))[0]
            if len(here) == 0:
                continue
            aim = np.array([x0, y0]) + rng.uniform(0.3, 0.7, 2) * (x1 - x0, y1 - y0)
            distance = np.hypot(*(self.points_m[here] - aim).T)
            stops.append(int(here[np.argmin(distance - np.minimum(self.node_clearance_m[here], 0.8))]))
        return stops

    def tour(self, stops: list[int]) -> NDArray[np.float64]:
        """Return the points of a path through all stops, from the first: always to the nearest that is left."""
        from scipy.sparse import csgraph

        if not stops:
            return self.points_m[:1]
        cost, before = csgraph.dijkstra(self.graph, directed=False, indices=stops, return_predecessors=True)
        left, here = set(range(1, len(stops))), 0
        nodes = [stops[0]]
        while left:
            nearest = min(left, key=lambda k: cost[here, stops[k]])
            leg = [stops[nearest]]
            while leg[-1] != stops[here]:
                leg.append(int(before[here, leg[-1]]))
            nodes.extend(leg[-2::-1])
            left.discard(nearest)
            here = nearest
        return np.asarray(self.points_m[nodes])


def _inside(building: Building, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Select the lattice points that the ground around the building does not reach."""
    from scipy import ndimage

    labels, _ = ndimage.label(~building.walls)
    cells = [
        np.floor((v - o) / building.grid.resolution).astype(int)
        for v, o in zip((x, y), building.grid.origin, strict=True)
    ]
    return np.asarray(labels[np.ix_(*cells)] != labels[0, 0])


def _smooth(path_m: NDArray[np.float64], lattice: _Lattice) -> NDArray[np.float64]:
    """Round the lattice's corners of a path, wherever that keeps it as clear of the walls."""
    from scipy import ndimage

    spacing = lattice_stride(lattice.resolution) * lattice.resolution
    if len(path_m) < 3:
        return path_m
    smooth = ndimage.gaussian_filter1d(path_m, SMOOTHING_M / spacing / 2, axis=0, mode="nearest")
    cells = np.floor(lattice.building.grid.to_cells(smooth)).astype(int)
    clear = lattice.clearance_m[cells[:, 0], cells[:, 1]] >= passage_m(lattice.resolution)
    # A point that must stay keeps its neighbours too: no new step may cut a corner.
    clear = ndimage.binary_erosion(clear, iterations=2, border_value=1)
    return np.where(clear[:, None], smooth, path_m)
