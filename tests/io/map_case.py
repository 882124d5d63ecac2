"""A small map without symmetry and its posterior, so that a flip, a turn or a transpose cannot pass for it."""

from dataclasses import dataclass

import numpy as np

from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

GRID = Grid(shape=(5, 3), resolution=0.25, origin=(-1.5, 2.0))


def occupancy():
    """Every cell differs from every other."""
    return np.arange(15).reshape(5, 3)[::-1] / 20 + 0.01


def observed():
    seen = np.ones(GRID.shape, dtype=bool)
    seen[0, 2] = seen[3, 0] = False
    return seen


def scans(stamps=(100.5, 101.25, 103.0)):
    poses = np.array([[-1.4, 2.1, 0.0], [-1.0, 2.2, 0.5], [-0.5, 2.6, -3.0]])
    ranges = np.array([[0.5, np.inf], [0.25, 0.125], [np.nan, -np.inf]])
    return Scans(poses, np.array([0.0, 0.5]), ranges, 2.0, stamps_s=None if stamps is None else np.array(stamps))


@dataclass(frozen=True)
class BinaryRun:
    """What an export needs of a run on binary walls."""

    grid: Grid = GRID

    @property
    def occupancy(self):
        return occupancy()

    @property
    def entropy(self):
        p = occupancy()
        return -p * np.log2(p) - (1 - p) * np.log2(1 - p)

    @property
    def observed(self):
        return observed()


class ReflectivityRun(BinaryRun):
    """One whose cells hold a number, so that there are intervals."""

    def interval(self, level):
        assert level == 0.9
        return self.occupancy / 2, (1 + self.occupancy) / 2
