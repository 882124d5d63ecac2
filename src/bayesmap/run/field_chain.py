"""The chain runner for fields: all chains abreast, with fitting during warm-up, progress, checkpoints and a clean
stop.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.reflectivity import Reflective
from bayesmap.run.chain import Progress, Schedule, pause_after
from bayesmap.samplers import fit
from bayesmap.samplers.field_gibbs import FieldGibbs, FieldProblem
from bayesmap.samplers.fit import Parameters

TELL_EVERY_S = 0.25

HIGHEST = float(np.nextafter(np.float16(1), np.float16(0)))
"""The largest number below 1 in half precision, 0.9995. A mean that was rounded to 1 would say that no beam ever comes
past the cell, and then one that did costs any number of nats; this one costs less than 0.0005 nats a beam."""


@dataclass(frozen=True, eq=False)
class FieldResult:
    """What the chains have done so far.

    Attributes:
        reflectivity: of every touched cell in every kept draw, (chains, kept, T).
        expected: mean of the reflectivity given the surfaces of the draw and where the beams then stopped, likewise.
        surfaces: of the busy cells, mean x, y less the cell's centre and l11, l21, l22, all in edges of a cell,
            (chains, kept, U, 5); U is 0 where the prior has no surfaces.
        log_likelihood, log_prior: of every kept draw, (chains, kept); the prior in unconstrained coordinates.
        warmup_log_joint: of the states before each warm-up sweep, (chains, done warm-up sweeps).
        states: where the chains stand, (chains, T, 6).
        last_counts: hits and met of each cell when it last drew its reflectivity, (2, chains, T): cells of which no
            beam tells anything draw seldom, and the fit looks at what they counted then.
        parameters: sensor and prior as they are now: fitted, if they were to be.
        informed: in how many (kept sweep, chain) pairs some beam told each cell something, of those that counted, two
            rows, (2, T).
        sweep: sweeps made, warm-up included.
        seconds: time spent in sweeps.
        finished: whether all draws are there.
    """

    reflectivity: NDArray[np.float16]
    expected: NDArray[np.float16]
    surfaces: NDArray[np.float16]
    log_likelihood: NDArray[np.float64]
    log_prior: NDArray[np.float64]
    warmup_log_joint: NDArray[np.float64]
    states: NDArray[np.float32]
    last_counts: NDArray[np.int32]
    parameters: Parameters
    informed: NDArray[np.int32]
    sweep: int
    seconds: float
    finished: bool

    @property
    def log_joint(self) -> NDArray[np.float64]:
        """Log joint of every kept draw, (chains, kept)."""
        return self.log_likelihood + self.log_prior


def run_field(
    problem: FieldProblem,
    schedule: Schedule,
    chains: int,
    seed: int,
    *,
    fit_sensor: bool,
    fit_prior: bool,
    threads: int | None = None,
    resume: FieldResult | None = None,
    on_progress: Callable[[Progress], None] | None = None,
    on_checkpoint: Callable[[FieldResult], None] | None = None,
    checkpoint_every_s: float = 30.0,
    should_stop: Callable[[], bool] = lambda: False,
) -> FieldResult:
    """Run warm-up, with fitting, and draws of all chains.

    Args:
        problem: rays, prior and sensor to start from.
        schedule: how many sweeps, and which are kept.
        chains: how many.
        seed: of all random numbers.
        fit_sensor: whether warm-up fits the sensor.
        fit_prior: whether it fits the prior of the reflectivities.
        threads: as many as there are cores if None; the result does not depend on it.
        resume: go on with these chains, made with the same arguments: bit for bit as if they had never stopped.
        on_progress: told about four times a second.
        on_checkpoint: given the chains so far at the end of warm-up, and every ``checkpoint_every_s`` seconds; less
            often where it takes so long that it would hold the chains up.
        checkpoint_every_s: see above.
        should_stop: asked between two sweeps.
    """
    states, counts = (None, None) if resume is None else (resume.states, resume.last_counts)
    sampler = FieldGibbs(problem, chains, seed, threads=threads, states=states, counts=counts)
    record = _Record(problem, schedule, chains, resume)
    told = saved = time.monotonic()
    pause_s = checkpoint_every_s
    while record.sweep < schedule.sweeps and not should_stop():
        began = time.perf_counter()
        number, warming = record.sweep, record.sweep < schedule.warmup
        keep = not warming and (number - schedule.warmup) % schedule.thin == 0
        if keep:
            record.keep(sampler)
        parameters = record.parameters
        log_likelihood, log_prior = sampler.sweep(number, parameters.sensor, parameters.prior)
        if warming and number >= fit.FIRST_SWEEP:
            record.parameters = _refitted(sampler, parameters, number, fit_sensor, fit_prior)
        record.add(sampler, parameters.prior, log_likelihood, log_prior, warming, keep)
        record.seconds += time.perf_counter() - began
        now = time.monotonic()
        if on_progress is not None and (now - told > TELL_EVERY_S or record.sweep == schedule.sweeps):
            on_progress(Progress(record.sweep, schedule.sweeps, log_likelihood + log_prior, warming))
            told = now
        warmed_up = warming and record.sweep == schedule.warmup
        if on_checkpoint is not None and (warmed_up or now - saved > pause_s):
            on_checkpoint(record.result(sampler))
            saved = time.monotonic()
            pause_s = pause_after(saved - now, checkpoint_every_s)
    return replace(record.result(sampler), finished=record.sweep >= schedule.sweeps)


def _refitted(sampler: FieldGibbs, now: Parameters, sweep: int, fit_sensor: bool, fit_prior: bool) -> Parameters:
    step, sensor, prior = fit.gain(sweep), now.sensor, now.prior
    if fit_sensor:
        sensor = fit.refit_sensor(sensor, sampler.stops(), sampler.problem.rays.limits, step)
    if fit_prior and sweep % fit.PRIOR_EVERY == 0:
        prior = fit.refit_prior(prior, *sampler.counts(), fit.prior_gain(sweep))
    return Parameters(sensor, prior)


def expected_reflectivity(
    hits: NDArray[np.int32], met: NDArray[np.int32], prior: Reflective, drawn: NDArray[np.float16]
) -> NDArray[np.float32]:
    """Mean of each cell's reflectivity given its counts, (a + hits) / (a + b + hits + met), (T,).

    Given where all beams stopped, whom they met, and the surfaces, reflectivities are independent Betas, and the
    density of one more beam is linear in each: under these means it is what it is on average under draws of them
    (Rao and Blackwell). The counts are to be those of the sweep that began at the draw, with its surfaces.

    A cell that rested in that sweep (`bayesmap.kernels.cell_draws`; no reading ends in it) has the counts of its last
    draw. Its own mean stays right on average; how its reflectivity goes together with what has changed since, in a few
    sweeps of the others, is lost. That is nothing to speak of: what hundreds of beams say of such a cell is that it is
    free, whichever value near zero it happens to have. In a map of four cells and six beams it was under one per cent
    of a density.

    Args:
        hits: (T,).
        met: (T,), negative for cells that have not counted yet.
        prior: that the sweep was made with.
        drawn: reflectivities for the cells that have not, (T,).
    """
    counted = hits.astype(np.float32)
    total = counted + np.maximum(met, 0)
    counted += np.float32(prior.a)
    total += np.float32(prior.a + prior.b)
    return np.minimum(np.where(met >= 0, counted / total, drawn), np.float32(HIGHEST))


class _Record:
    """Draws and traces, growing as the chains go."""

    def __init__(self, problem: FieldProblem, schedule: Schedule, chains: int, resume: FieldResult | None) -> None:
        cells = problem.rays.n_cells
        self.busy = np.nonzero(problem.guess.busy)[0] if not problem.plain else np.zeros(0, dtype=np.intp)
        self.centres = problem.rays.centres_m()[self.busy]
        self.edge = problem.rays.grid.resolution
        self.reflectivity = np.zeros((chains, schedule.draws, cells), dtype=np.float16)
        self.expected = np.zeros_like(self.reflectivity)
        self.surfaces = np.zeros((chains, schedule.draws, len(self.busy), 5), dtype=np.float16)
        self.log_likelihood = np.zeros((chains, schedule.draws))
        self.log_prior = np.zeros((chains, schedule.draws))
        self.warmup_log_joint = np.zeros((chains, schedule.warmup))
        self.informed = np.zeros((2, cells), dtype=np.int32)
        self.parameters = Parameters(problem.sensor, problem.prior)
        self.kept = self.warmed = self.sweep = 0
        self.seconds = 0.0
        if resume is not None:
            self.kept, self.warmed = resume.reflectivity.shape[1], resume.warmup_log_joint.shape[1]
            self.reflectivity[:, : self.kept] = resume.reflectivity
            self.expected[:, : self.kept] = resume.expected
            self.surfaces[:, : self.kept] = resume.surfaces
            self.log_likelihood[:, : self.kept] = resume.log_likelihood
            self.log_prior[:, : self.kept] = resume.log_prior
            self.warmup_log_joint[:, : self.warmed] = resume.warmup_log_joint
            self.informed += resume.informed
            self.parameters, self.sweep, self.seconds = resume.parameters, resume.sweep, resume.seconds

    def keep(self, sampler: FieldGibbs) -> None:
        """Take the cells as they stand for the next draw, chain by chain: all of them at once are the size of a map."""
        for chain in range(len(self.reflectivity)):
            cells = sampler.cells(chain)
            self.reflectivity[chain, self.kept] = cells[:, 0]
            if len(self.busy):
                surfaces = cells[self.busy, 1:].astype(np.float64)
                surfaces[:, :2] -= self.centres
                self.surfaces[chain, self.kept] = surfaces / self.edge

    def add(
        self,
        sampler: FieldGibbs,
        prior: Reflective,
        log_likelihood: NDArray[np.float64],
        log_prior: NDArray[np.float64],
        warming: bool,
        kept: bool,
    ) -> None:
        """Note a sweep, under a prior: its densities and counts are of the cells before it, which is what was kept."""
        self.sweep += 1
        if warming:
            self.warmup_log_joint[:, self.warmed] = log_likelihood + log_prior
            self.warmed += 1
            return
        for chain in range(len(self.reflectivity)):
            hits, met = sampler.counted(chain)
            counted = met >= 0
            self.informed[0] += counted & (hits + met > 0)
            self.informed[1] += counted
            if kept:
                drawn = self.reflectivity[chain, self.kept]
                self.expected[chain, self.kept] = expected_reflectivity(hits, met, prior, drawn)
        if not kept:
            return
        self.log_likelihood[:, self.kept] = log_likelihood
        self.log_prior[:, self.kept] = log_prior
        self.kept += 1

    def result(self, sampler: FieldGibbs) -> FieldResult:
        return FieldResult(
            reflectivity=self.reflectivity[:, : self.kept],
            expected=self.expected[:, : self.kept],
            surfaces=self.surfaces[:, : self.kept],
            log_likelihood=self.log_likelihood[:, : self.kept],
            log_prior=self.log_prior[:, : self.kept],
            warmup_log_joint=self.warmup_log_joint[:, : self.warmed],
            states=sampler.states(),
            last_counts=np.stack(sampler.counts()),
            parameters=self.parameters,
            informed=self.informed.copy(),
            sweep=self.sweep,
            seconds=self.seconds,
            finished=False,
        )
