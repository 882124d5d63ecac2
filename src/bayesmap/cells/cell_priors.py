"""Priors of cells that stop some of the beams: how many, and where.

A wall that is there or not is too stiff for glass, chair legs, people and cells that a wall fills in part. Here a cell
has a reflectivity m in [0, 1], the chance that it stops a beam, and, with `Surface`, the place where it does: a normal
distribution of the points where beams stop, as normal-distributions-transform maps keep it (Biber and Strasser, 2003),
but inferred. What it means for a beam is in `bayesmap.kernels.meeting`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

MOST_SPREAD = 3.0


@dataclass(frozen=True)
class Beta:
    """A reflectivity in each cell, Beta(a, b), independently; a stopped beam stops at the cell's hit depth.

    Attributes:
        a, b: pseudo-counts of beams that were stopped, and of beams that were not.

    Raises:
        BadInput: a count that is not positive.
    """

    a: float = 0.02
    b: float = 0.2

    def __post_init__(self) -> None:
        _check_counts("Beta", self.a, self.b)

    @property
    def mean(self) -> float:
        """Prior mean of the reflectivity."""
        return self.a / (self.a + self.b)

    def describe(self) -> dict[str, object]:
        """The prior as plain JSON values."""
        return {"kind": "beta", "a": self.a, "b": self.b}


@dataclass(frozen=True)
class Surface:
    """A reflectivity in each cell as in `Beta`, and a surface: mu ~ N(centre, tau^2 I), Sigma ~ InverseWishart(nu, psi
    I).

    Lengths are in edges of a cell, so that one prior serves all resolutions.

    Attributes:
        a, b: of the reflectivity of what a beam meets.
        wander: tau, how far a surface's mean may lie from its cell's centre.
        spread: sqrt(psi), the size of surfaces.
        dof: nu, how sure that is; more than 1.
        extent: kappa, the size beyond which surfaces are unlikely: about that of a cell.

    Raises:
        BadInput: a number that is not positive, too few degrees of freedom, or surfaces much larger than their extent.
    """

    a: float = 0.02
    b: float = 0.2
    wander: float = 0.4
    spread: float = 0.28
    dof: float = 3.0
    extent: float = 0.35

    def __post_init__(self) -> None:
        _check_counts("Surface", self.a, self.b)
        for name in ("wander", "spread", "extent"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise BadInput(f"Surface: {name} must be a positive number of cells, got {value!r}")
        if not (math.isfinite(self.dof) and self.dof > 1):
            raise BadInput(f"Surface: dof must exceed 1, got {self.dof!r}")
        if self.spread > MOST_SPREAD * self.extent:  # next to no draw would be small enough
            raise BadInput(
                f"Surface: spread must not exceed {MOST_SPREAD:g} times extent, got {self.spread!r} and {self.extent!r}"
            )

    @property
    def mean(self) -> float:
        """Prior mean of the reflectivity."""
        return self.a / (self.a + self.b)

    def describe(self) -> dict[str, object]:
        """The prior as plain JSON values."""
        return {
            "kind": "surface", "a": self.a, "b": self.b, "wander": self.wander, "spread": self.spread, "dof": self.dof,
            "extent": self.extent,
        }  # fmt: skip

    def sample_surfaces(self, rng: np.random.Generator, count: int) -> NDArray[np.float64]:
        """Draw surfaces: mean x, y less the centre, and l11, l21, l22 of Sigma = L L', in edges, (count, 5)."""
        out = np.zeros((count, 5))
        left = np.arange(count)
        while len(left):
            drawn = self._sample_unbounded(rng, len(left))
            with np.errstate(over="ignore"):  # what is too large for a number is too large
                size = (drawn[:, 2:] ** 2).sum(axis=1) / self.extent**2
            accepted = rng.random(len(left)) < np.exp(-0.5 * size)
            out[left[accepted]] = drawn[accepted]
            left = left[~accepted]
        return out

    def _sample_unbounded(self, rng: np.random.Generator, count: int) -> NDArray[np.float64]:
        """The same without the factor that bounds their size: Bartlett's factor of the Wishart, inverted."""
        a11 = np.sqrt(rng.chisquare(self.dof, count))
        a22 = np.sqrt(rng.chisquare(self.dof - 1.0, count))
        a21 = rng.standard_normal(count)
        mean = self.wander * rng.standard_normal((2, count))
        with np.errstate(divide="ignore", over="ignore"):
            shape = (self.spread / a22, -self.spread * a21 / (a11 * a22), self.spread / a11)
        return np.stack([*mean, *shape], axis=-1)


CellPrior = Beta | Surface


def prior_from(description: dict[str, Any]) -> CellPrior:
    """The prior of a description."""
    values = dict(description)
    kind: type[Beta] | type[Surface] = Surface if values.pop("kind") == "surface" else Beta
    return kind(**values)


def _check_counts(name: str, a: float, b: float) -> None:
    for which, value in (("a", a), ("b", b)):
        if not (math.isfinite(value) and value > 0):
            raise BadInput(f"{name}: {which} must be a positive number, got {value!r}")
