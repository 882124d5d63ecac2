"""What a job has found so far, and the field that shows it."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.document import Document
from bayesmap.app.hit_maps import Counted
from bayesmap.app.scene import Scene
from bayesmap.app.shown.beliefs import Preview
from bayesmap.app.shown.chains import Stream
from bayesmap.app.shown.pilot import Pilot
from bayesmap.app.shown.verdict import Verdict, difference, judge_chains, judge_particles
from bayesmap.app.tasks import OWN_LAYERS, View
from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.kinds import BUILT_IN
from bayesmap.posterior.diagnostics import bulk_ess
from bayesmap.posterior.diagnostics import rhat as split_rhat
from bayesmap.result import Run
from bayesmap.samplers.importance import Particles

Floats = NDArray[np.float64]
LEVELS = 255
HITS, COUNTS = "hits", "counts"
"""Methods of maps of hits and passes: along the poses that the map is to have, and along poses still in doubt."""

APPROXIMATE = (HITS, COUNTS, "propagate", "pilot")
"""Methods whose answers are quick and not the posterior's."""

TRACED = 300
FIRST_SWEEPS = 100
"""Points of a trace that are sent with every picture: so many over all of it, and each of the first sweeps."""

INTERVAL_DRAWS = 60
"""Draws of which intervals are made."""

LEAST_REFLECTIVITY = 0.1
"""Of surfaces that are drawn as strokes."""

WEIGHT_BINS = 24
MOST_NATS = 60.0
"""Weights that are less than exp(-60) of the largest are counted there."""


@dataclass(frozen=True, eq=False)
class Result:
    """One of: beliefs, a pilot, chains, weighted particles, a saved run, hits and passes, or nothing (the prior).

    Attributes:
        scene: the readings.
        document: what was asked.
        method: what found it: a method's name, or "none".
        total: of particles, those that are still to be weighed included.
        counted: a map of hits and passes.
        pilot: where the chain stands that fits the sensor.
        over: whether chains were cancelled, and will not go on.
    """

    scene: Scene
    document: Document
    method: str
    preview: Preview | None = None
    stream: Stream | None = None
    particles: Particles | None = None
    total: int = 0
    run: Run | None = None
    counted: Counted | None = None
    pilot: Pilot | None = None
    over: bool = False

    def mean(self) -> NDArray[np.float64]:
        """Posterior wall probability, (nx, ny)."""
        if self.stream is not None:
            return self.stream.mean()
        if self.preview is not None:
            return self.preview.p_wall()
        if self.particles is not None:
            return self.particles.occupancy()
        if self.run is not None:
            return np.nan_to_num(self.run.occupancy, nan=0.5)
        if self.pilot is not None:
            return self.pilot.mean
        if self.counted is not None:
            return self.counted.p_wall
        return self.prior.mean_stop(self.scene.grid)

    def observed(self) -> NDArray[np.bool_]:
        """Cells that a beam reaches, (nx, ny)."""
        if self.stream is not None:
            return self.stream.observed()
        if self.preview is not None:
            return self.preview.observed()
        if self.run is not None:
            return self.run.observed
        if self.pilot is not None:
            return self.scene.problem.touched()
        if self.counted is not None:
            return self.counted.observed
        if self.particles is not None:
            from bayesmap.kernels.walls.reach import reach_frequency

            return reach_frequency(self.scene.problem.table, self.mean()[None] > 0.5) > 0
        return np.zeros(self.document.grid.shape, dtype=np.bool_)

    @property
    def kept(self) -> Draws | None:
        """The kept maps, if this method has any."""
        kept = self.stream.draws if self.stream is not None else None if self.run is None else self.run.posterior.draws
        return kept if kept is not None and kept.count else None

    @property
    def at_hand(self) -> Draws | None:
        """The kept maps, or the latest of chains that keep none."""
        if self.kept is not None:
            return self.kept
        if self.pilot is not None:
            return self.pilot.draws
        return self.stream.recent if self.stream is not None and self.stream.recent.count else None

    @property
    def prior(self) -> CellPrior:
        """Of the cells on show: it has the words for them."""
        if self.stream is not None:
            return self.stream.model.cells
        if self.pilot is not None:
            return self.pilot.model.cells
        if self.counted is not None and self.counted.prior is not None:
            return self.counted.prior
        if self.run is not None:
            return self.run.posterior.prior
        if self.method == "none" and self.document.cells != self.scene.prior.words.kind:
            return BUILT_IN[self.document.cells]()  # fitted once there are chains
        return self.scene.prior

    @cached_property
    def width(self) -> NDArray[np.float64] | None:
        """Width of each cell's central 90 % interval, (nx, ny); None for walls, which have none, or without draws."""
        draws = self.at_hand
        if draws is None or not self.prior.has_interval:
            return None
        lower, upper = self.prior.interval(draws.thinned(INTERVAL_DRAWS), 0.9)
        return np.asarray(upper - lower)

    def quantity(self) -> dict[str, Any]:
        """What the numbers of the map are: the kind of cells, and the words for their mean and for one draw's."""
        words = self.prior.words
        return {"kind": words.kind, "mean": words.mean, "value": words.value, "interval": self.prior.has_interval}

    def overlay(self) -> dict[str, NDArray[np.float32]] | None:
        """What is drawn over a run or a log: surfaces as strokes, (U, 5), from x, y to x, y in metres with their
        reflectivity; and the places of all scans, (S, 2). None for a simulation.
        """
        if self.document.simulated:
            return None
        strokes = np.zeros((0, 5), dtype=np.float32)
        if self.surfaces is not None:
            _, mean, covariance, reflectivity = self.surfaces
            values, vectors = np.linalg.eigh(covariance)
            half = 2.0 * np.sqrt(np.maximum(values[:, 1], 0.0))[:, None] * vectors[:, :, 1]
            strokes = np.column_stack([mean - half, mean + half, reflectivity])
            strokes = strokes[reflectivity >= LEAST_REFLECTIVITY].astype(np.float32)
        return {"strokes": strokes, "trajectory": self.scan_poses[:, :2].astype(np.float32)}

    @cached_property
    def surfaces(self) -> tuple[NDArray[np.int32], Floats, Floats, Floats] | None:
        """Mean surfaces: their cells, means in the world frame (U, 2), covariances (U, 2, 2), reflectivities (U,).

        None without draws, or where cells have none.
        """
        draws = self.at_hand
        if draws is None or not self.prior.has_surfaces:
            return None
        return draws.index["surface_cell"], *self.prior.surfaces(draws)

    @cached_property
    def scan_poses(self) -> NDArray[np.float64]:
        """Where the scans were taken, (S, 3): the mean over draws where poses were inferred."""
        if self.run is None or not self.run.n_draws or "poses" not in self.run.posterior.draws.arrays:
            return self.scene.scans.poses
        x, y, yaw = np.moveaxis(self.run.poses, -1, 0).reshape(3, -1, len(self.scene.scans))
        heading = np.arctan2(np.sin(yaw).mean(axis=0), np.cos(yaw).mean(axis=0))
        return np.column_stack([x.mean(axis=0), y.mean(axis=0), heading])

    def draws(self) -> dict[str, int]:
        """How many maps are kept: {"chains", "count"}."""
        return (
            {"chains": 0, "count": 0} if self.kept is None else {"chains": self.kept.chains, "count": self.kept.count}
        )

    def packed(self) -> NDArray[np.uint8]:
        """Kept maps of walls, (chains, count, bytes); none where a map's cells are numbers."""
        if self.kept is not None and self.kept.specs[0].storage == "bits":
            return self.kept.arrays[self.kept.specs[0].name]
        return np.zeros((0, 0, 0), dtype=np.uint8)

    def log_joint(self) -> NDArray[np.float64]:
        """Of every sweep or kept draw, (chains, n)."""
        if self.stream is not None:
            return self.stream.log_joint()
        if self.run is not None:
            return self.run.log_joint
        return np.zeros((0, 0))

    def draw(self, view: View) -> tuple[NDArray[Any], int, int] | None:
        """One map of walls or of reflectivities, its chain and its number; None where this method has none."""
        if self.stream is not None:
            return self.stream.draw(view.chain, view.draw)
        if self.run is not None and self.run.n_draws:
            last = self.run.n_draws - 1
            chain = min(view.chain or 0, len(self.run.log_joint) - 1)
            number = last if view.draw is None else min(view.draw, last)
            return self.run.map_of(chain, number), chain, number
        if self.pilot is not None:
            return self.pilot.model.cells.map_of(self.pilot.draws, 0, -1), 0, 0
        return None

    def statistics(self) -> dict[str, Any]:
        """Sweeps, effective sample size, R-hat, log joint and verdict of the field's header."""
        sweeps, total, ess, rhat, joint = 0, 0, math.nan, math.nan, math.nan
        verdict: Verdict | None = None
        if self.stream is not None:
            sweeps, total = self.stream.sweep, self.stream.total
            mixing = self.stream.mixing()
            ess, rhat, joint = mixing.ess, mixing.rhat, mixing.log_joint
            apart = difference(self.stream.means(), self.stream.observed())
            verdict = judge_chains(rhat, ess, sweeps, apart, over=self.over or self.stream.done)
        elif self.preview is not None:
            sweeps = self.preview.rounds
        elif self.pilot is not None:
            sweeps, total = self.pilot.sweep, self.pilot.total
        elif self.particles is not None:
            sweeps, total = len(self.particles.log_weights), self.total
            ess = self.particles.effective_sample_size
            verdict = judge_particles(ess)
        elif self.run is not None:
            sweeps = total = self.run.posterior.sweep
            if self.run.log_joint.size:
                joint = float(self.run.log_joint[:, -1].mean())
                if np.ptp(self.run.log_joint) > 0:
                    ess, rhat = bulk_ess(self.run.log_joint), split_rhat(self.run.log_joint)
                verdict = judge_chains(rhat, ess, sweeps, None, over=True)
        numbers = {"ess": ess, "rhat": rhat, "log_joint": joint}
        finite = {name: float(value) if math.isfinite(value) else None for name, value in numbers.items()}
        return {"sweeps": sweeps, "total": total, **finite, "verdict": None if verdict is None else asdict(verdict)}

    def trace(self) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Log joint of every chain, (chains, n), and the sweeps or kept draws that these are of, counted from 1, (n,).

        The first sweeps are all there; the later ones are evenly spread.
        """
        joint = self.log_joint()
        count = joint.shape[1]
        later = np.linspace(1, count, min(count, TRACED)).round().astype(int) if count else np.zeros(0, dtype=int)
        some = np.union1d(np.arange(1, min(count, FIRST_SWEEPS) + 1), later)
        return joint[:, some - 1].astype(np.float32), some.astype(np.float32)

    def weights(self) -> tuple[NDArray[np.float32], float] | None:
        """How many particles weigh how much, or None without particles.

        Counts in bins of equal width up to the largest log weight, and where the first begins, relative to it (nats).
        """
        if self.particles is None:
            return None
        below = self.particles.log_weights - self.particles.log_weights.max()
        lowest = -float(min(MOST_NATS, max(1.0, -below.min())))
        counts, _ = np.histogram(np.maximum(below, lowest), WEIGHT_BINS, (lowest, 0.0))
        return counts.astype(np.float32), lowest

    def field(self, view: View) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        """Header and buffers of the message `field`, but for its generation and its time."""
        trace, traced = self.trace()
        header: dict[str, Any] = {
            "layer": view.layer,
            "method": self.method,
            "approximate": self.method in APPROXIMATE,
            **self.statistics(),
            "draws": self.draws(),
            "quantity": self.quantity(),
        }
        if self.pilot is not None:
            header["averaged"] = self.pilot.draws.count
        buffers: dict[str, NDArray[Any]] = {"trace": trace, "traced": traced}
        if (weights := self.weights()) is not None:
            buffers["weights"], header["lowest"] = weights
        one = self.draw(view) if view.layer == "draw" else None
        if one is not None:
            drawn, header["chain"], header["draw"] = one
            p = np.rint(drawn.astype(np.float32) * LEVELS).astype(np.uint8)
        elif view.layer == "width" and self.width is not None:
            p = np.rint(self.width * LEVELS).astype(np.uint8)
        else:
            header["layer"] = "mean" if view.layer in OWN_LAYERS else view.layer
            p = np.rint(self.mean() * LEVELS).astype(np.uint8)
        return header, {"p": p, "observed": np.packbits(self.observed().ravel()), **buffers}
