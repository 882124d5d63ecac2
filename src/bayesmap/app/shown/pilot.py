"""The short chain that fits sensor and prior of reflectivities and surfaces, watched while it runs.

It draws cells given all readings, as the chains that follow do, but under a sensor and a prior that still move. Both
are near their place after a few sweeps: so the latter half of its draws is the first that is known of the posterior,
long before those chains have begun. docs/app.md says how near that is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import Document
from bayesmap.app.scene import Scene
from bayesmap.app.shown.chains import joined
from bayesmap.app.shown.result import Figures, Floats, Found, OneMap
from bayesmap.cells.arrays import Draws
from bayesmap.cells.kinds import BUILT_IN
from bayesmap.model import Model
from bayesmap.samplers.fit import PILOT_SWEEPS, first_sensor, pilot_sweeps
from bayesmap.samplers.methods import Gibbs, sampler_of
from bayesmap.samplers.sampler import Keep


class Pilot(Found):
    """Where the chain stands that fits sensor and prior, before the chains that are kept begin.

    Attributes:
        model: under the sensor and the prior that are fitted so far.
        draws: the latter half of those that it has made, one chain.
        total: sweeps that it will make.
    """

    approximate = True

    def __init__(self, model: Model, draws: Draws, sweep: int, total: int, touched: NDArray[np.bool_]) -> None:
        self.model: Model = model
        self.draws, self.total, self.averaged = draws, total, draws.count
        self._sweep, self._touched = sweep, touched

    @property
    def sweep(self) -> int:
        """Sweeps done."""
        return self._sweep

    @property
    def at_hand(self) -> Draws:
        """The latter half of its draws."""
        return self.draws

    def figures(self, over: bool) -> Figures:
        """Return the sweeps done."""
        return Figures(self.sweep, self.total)

    @cached_property
    def _mean(self) -> Floats:
        return self.model.cells.mean_map(self.draws)

    def mean(self) -> Floats:
        """Return the mean over the draws, (nx, ny)."""
        return self._mean

    def observed(self) -> NDArray[np.bool_]:
        """Return the cells that a beam touches, (nx, ny)."""
        return self._touched

    def draw(self, chain: int | None, number: int | None) -> OneMap:
        """Return its last draw."""
        return self.model.cells.map_of(self.draws, 0, -1), 0, 0


Fitted = tuple[Model, Any, Any]
"""A model under what was fitted, its sampler, and what the sampler has prepared."""


def depends_on(document: Document) -> Document:
    """The document without what no pilot depends on: two that are alike in this have the same one."""
    return replace(
        document, prior=0.5, pose_sigma=0.0, heading_sigma=0.0, method="gibbs", order="radial", start="auto", sweeps=1
    )  # fmt: skip


def fit_by_pilot(scene: Scene, document: Document, show: Callable[[Pilot], None]) -> Generator[None, None, Fitted]:
    """Fit sensor and prior to the readings in short pieces.

    Args:
        scene: the readings.
        document: what kind of cells explains them, and the seed.
        show: told where the pilot stands, after every sweep.

    Returns:
        The model under what was found, its sampler, and what the sampler has prepared.
    """
    prior = BUILT_IN[document.cells]()
    first = first_sensor(prior, document.grid.resolution)
    model = replace(scene.model(prior), sensor=first, hit_depth=prior.hit_depth)
    sampler, _ = sampler_of(prior.methods["gibbs"], model.grid, Gibbs())
    problem = sampler.prepare(model, "cpu")
    yield
    pilot = pilot_sweeps(problem, document.seed, PILOT_SWEEPS, keep=Keep(every=1))
    draws: Draws | None = None
    touched = scene.problem.touched()
    for sweep, (now, info) in enumerate(pilot, 1):
        problem, model = problem.under(now.sensor, now.prior), replace(model, sensor=now.sensor, cells=now.prior)
        latest = Draws(model.grid, now.prior.arrays, info.draws, problem.coordinates)
        draws = joined(draws, latest, math.ceil(sweep / 2))
        show(Pilot(model, draws, sweep, PILOT_SWEEPS, touched))
        yield
    return model, sampler, sampler.prepare(model, "cpu")  # beams are followed as far as the fitted noise reaches
