"""Half a sweep: beams' stops follow their exact conditional, and the cells are told what those stops mean.

Many copies of one little world in a known state, swept once, are independent draws of its stops. False alarms: `ALPHA`
= 1e-4 over this module.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from oracle.stop_law import joint, paths_of, reading_law, stop_probabilities, stops
from oracle.stop_worlds import centres_of, copies, draw_worlds
from oracle.verdict import ALPHA, goodness_of_fit, two_sided

import bayesmap as bm
from bayesmap.kernels.surfaces.cell_draws import TRIES_EVERY
from bayesmap.samplers.initial_estimate import update_periods

GRID = bm.Grid((8, 2), 0.25)
SENSOR = bm.BeamMixture(bm.Gaussian(0.04, 0.01), p_random=0.2, p_no_return=0.1, p_short=0.1, rate_short_per_m=0.6)
PRIORS = {"plain": bm.Beta(1.0, 2.0), "surfaces": bm.Surface(1.0, 2.0, dof=5.0)}
COPIES, SEEDS = 5000, range(5, 9)  # four times as many copies at once take a gigabyte
READINGS = [0.5, 1.1, 1.75, 1.9, np.inf, -np.inf]


def scans_of(readings):
    angles = np.linspace(-0.08, 0.08, len(readings))
    return bm.Scans([-0.1, 0.22, 0.03], angles, [readings], max_range_m=2.2, min_range_m=0.05)


def state_of(worlds, kind, seed=1):
    """One state for all copies, (T, 6): reflectivities of many sizes, surfaces anywhere."""
    rng = np.random.default_rng(seed)
    cells, states = GRID.n_cells, np.zeros((len(worlds.problem.rays.touched), 6))
    one = np.zeros((cells, 6))
    one[:, 0] = rng.choice([0.02, 0.15, 0.4, 0.8], cells)
    if kind == "surfaces":
        one[:, 1:3] = rng.normal(0, 0.07, (cells, 2))
        one[:, 3], one[:, 5] = rng.uniform(0.03, 0.09, (2, cells))
        one[:, 4] = rng.normal(0, 0.05, cells)
        states[:, 1:3] = centres_of(worlds.problem.rays)[0]
    states[worlds.cells()] += one
    return states


def swept(kind, count=COPIES, sweep=0, seed=5):
    """Copies of a world, its state, the chain's arrays after one sweep from it, and hits and met beams by cell."""
    worlds = copies(scans_of(READINGS), GRID, PRIORS[kind], SENSOR, count)
    states = state_of(worlds, kind)
    sampler = worlds.sampler(seed, states, sweep)
    sampler.sweep()
    return worlds, states.astype(np.float32).astype(float), sampler.arrays, sampler.counts()


def chosen(worlds, field):
    """Each beam's stop, counted along the beam; its number of entries for nowhere; (copies, beams)."""
    rays = worlds.problem.rays
    return (field.stop.numpy() - rays.offsets[:-1]).reshape(worlds.count, -1)


@cache
def stops_counted(kind):
    """Paths and state of one copy, and the stops of each beam over all copies, (beams, entries)."""
    one = copies(scans_of(READINGS), GRID, PRIORS[kind], SENSOR, 1)
    paths, counts = paths_of(one.problem.rays), 0
    for seed in SEEDS:
        worlds, _, field, _ = swept(kind, seed=seed)
        entries = np.arange(paths.cell.shape[1] + 1)[:, None, None]
        counts = counts + (chosen(worlds, field) == entries).sum(axis=1).T
    return paths, state_of(one, kind).astype(np.float32).astype(float), counts


@pytest.mark.parametrize("kind", PRIORS)
def test_stops_follow_their_exact_conditional_far_ones_too(kind):
    paths, states, found = stops_counted(kind)
    assert paths.far.sum() > 4  # and some are
    for b, weight in enumerate(joint(paths, states, SENSOR, kind == "plain")):
        entries = paths.there[b].sum()
        law, counts = np.append(weight[:entries], weight[-1]), found[b, : entries + 1]
        assert counts.sum() == COPIES * len(SEEDS)
        assert goodness_of_fit(counts, law / law.sum()) > ALPHA / 40
        wrong = law * np.append(np.ones(entries), 1.25)
        if 0.05 < law[-1] / law.sum() < 0.95:
            assert goodness_of_fit(counts, wrong / wrong.sum()) < ALPHA / 40


def test_wrong_stop_probabilities_would_be_noticed():
    """The twin: a beam that forgets to lose weight on the way is told from the exact one by the same chi-square."""
    paths, states, found = stops_counted("plain")
    stopped, distance, variance = stops(paths, states, True)
    law = reading_law(paths.range_m[:, None], distance, variance, SENSOR, paths.limits)
    b, entries = 1, paths.there[1].sum()
    assert not np.allclose(stop_probabilities(stopped)[b, :-1], stopped[b])
    weight = np.append((stopped * law)[b, :entries], joint(paths, states, SENSOR, True)[b, -1])
    counts = found[b, : entries + 1]
    assert goodness_of_fit(counts, weight / weight.sum()) < ALPHA
    assert two_sided(counts[-1], counts.sum(), weight[-1] / weight.sum()) < ALPHA


@pytest.mark.parametrize("kind", PRIORS)
def test_the_density_and_place_of_the_stop_are_kept(kind):
    worlds, states, field, _ = swept(kind, count=200)
    paths = paths_of(worlds.problem.rays)
    _, distance, variance = stops(paths, states, kind == "plain")
    beams, stop = np.arange(len(paths.range_m)), chosen(worlds, field).ravel()
    some = stop < paths.there.sum(axis=1)
    at = (beams[some], stop[some])
    where = field.where.numpy()[some]
    np.testing.assert_allclose(where[:, 0], distance[at], atol=1e-4)
    np.testing.assert_allclose(where[:, 1], variance[at], rtol=1e-3, atol=1e-7)


def turn_of(worlds, sweep):
    """Cells whose turn to try a candidate a sweep is."""
    every, cells = update_periods(worlds.problem.estimate).astype(int), worlds.problem.rays.touched
    length = np.maximum(every, 1)
    return (every > 0) & (sweep % length == 0) & ((sweep // length + cells) % TRIES_EVERY == 0)


@pytest.mark.parametrize("kind", PRIORS)
def test_hits_are_the_stops_and_met_beams_are_binomial(kind):
    """Given that it passed, a beam met the surface with probability g (1 - m) / (1 - m g): always, if there is none.

    Cells in which readings end and others have kernels of their own: both are looked at.
    """
    for sweep in (0, 8):  # in which cells without readings have their turn
        found = {True: [], False: []}
        for seed in (5, 6):
            worlds, states, field, (hits, met) = swept(kind, 6000, sweep, seed)
            rays, paths, stop = worlds.problem.rays, paths_of(worlds.problem.rays), field.stop.numpy()
            counted = met >= 0  # the others learn nothing, or try a candidate
            stopped_in = np.bincount(rays.columns[stop[stop < rays.offsets[1:]]], minlength=len(rays.touched))
            np.testing.assert_array_equal(hits[counted], stopped_in[counted])
            passed = np.arange(rays.n_incidences) < np.repeat(stop, np.diff(rays.offsets))
            a, m = stops(paths, states, kind == "plain")[0][paths.there], states[rays.columns, 0]
            p = np.where(passed, a / m * (1 - m) / (1 - a), 0.0)
            expected, variance = (np.bincount(rays.columns, x, len(rays.touched)) for x in (p, p * (1 - p)))
            for ended, parts in found.items():
                group = counted & (worlds.problem.estimate.endpoint == ended)
                parts.append(np.stack([met[group], expected[group], variance[group]]))
        for parts in found.values():
            told, expected, variance = np.concatenate(parts, axis=1)
            assert expected.sum() > 2000
            if kind == "plain":
                np.testing.assert_array_equal(told, np.rint(expected).astype(int))
                continue
            off, spread = told - expected, np.sqrt(variance.sum())
            assert abs(off.sum()) < 4.5 * spread
            assert abs((off**2).sum() / spread**2 - 1) < 0.25
            assert abs(off.sum() + 0.2 * expected.sum()) > 4.5 * spread  # the twin: a fifth of them forgotten


def reference_gains(worlds, states, candidates, field):
    """The log ratio that every cell's stops and passes give its candidate, from the definition, (T,)."""
    rays, paths = worlds.problem.rays, paths_of(worlds.problem.rays)
    stop = (field.stop.numpy() - rays.offsets[:-1])[:, None]
    floor = SENSOR.p_random / (paths.limits.max_m - paths.limits.min_m)
    terms = []
    for cells in (states, candidates):
        stopped, distance, variance = stops(paths, cells, False)
        law = reading_law(paths.range_m[:, None], distance, variance, SENSOR, paths.limits)
        law = np.where(paths.far, floor, law)
        entry = np.arange(stopped.shape[1])
        terms.append(
            np.where(entry < stop, np.log1p(-stopped), np.where(entry == stop, np.log(stopped * law + 1e-300), 0.0))
        )
    ratio = np.where(paths.there, terms[1] - terms[0], 0.0)
    return np.bincount(paths.cell.ravel(), ratio.ravel(), len(rays.touched))


def test_a_candidate_s_gain_is_the_ratio_of_what_all_beams_say():
    """Also where a far stop takes back what the cells behind it were told: every beam here may stop far."""
    one = copies(scans_of(READINGS), GRID, PRIORS["surfaces"], SENSOR, 300)
    turns = [sweep for sweep in range(32) if turn_of(one, sweep).any()]
    for sweep in turns[:6]:
        worlds, states, field, _ = swept("surfaces", 300, sweep)
        some = turn_of(worlds, sweep)
        candidates = field.candidates.numpy()[worlds.problem.rays.touched, :6].astype(float)
        gain = field.gain.numpy().sum(axis=0)[worlds.problem.rays.touched] / 2**24
        assert some.any()
        assert (gain[~some] == 0).all()
        candidates[~some] = states[~some]
        expected = reference_gains(worlds, states, candidates, field)
        np.testing.assert_allclose(gain[some], expected[some], rtol=2e-3, atol=2e-3)
        assert (abs(expected[some]) > 0.1).any()


def test_invalid_readings_and_empty_beams_say_nothing():
    scans = replace(scans_of([np.nan, 0.7]), poses=np.array([[-0.1, 0.22, 3.1]]))  # looks away from the cells
    worlds = copies(scans, GRID, PRIORS["surfaces"], SENSOR, 3)
    sampler = worlds.sampler(1)
    total, _ = sampler.sweep()
    law = reading_law(np.array(0.7), np.inf, 0.0, SENSOR, worlds.problem.rays.limits)
    assert total[0] == pytest.approx(3 * np.log(law), rel=1e-5)
    assert not sampler.state.chains.stops(0)[0].any()
    hits, met = sampler.counts()
    assert hits.max() == 0
    assert met.max() <= 0


def test_draws_of_one_sweep_do_not_repeat_in_the_next():
    worlds, _ = draw_worlds(3, GRID, PRIORS["plain"], SENSOR, 50)
    sampler = worlds.sampler(1)
    seen = []
    for _ in range(2):
        sampler.sweep()
        seen.append(sampler.arrays.stop.numpy().copy())
    assert (seen[0] != seen[1]).mean() > 0.05
