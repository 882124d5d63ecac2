"""Half a sweep: beams' stops follow their exact conditional, and points of stops their law given the readings.

Many copies of one little world in a known state, swept once, are independent draws of its stops. False alarms: `ALPHA`
= 1e-4 over the stops, and over the points.
"""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import scipy
import warp as wp
from oracle.stop_law import joint, paths_of, reading_law, stops
from oracle.stop_worlds import centres_of, copies, draw_worlds
from oracle.verdict import ALPHA, goodness_of_fit
from oracle.worlds import OwnSensor
from tiers import full_but

import bayesmap as bm
from bayesmap.kernels import device
from bayesmap.kernels.device import Float64s
from bayesmap.kernels.random import mix
from bayesmap.kernels.sensor_law import SensorLaw32, object_decay, sensor_law
from bayesmap.kernels.surfaces.cell_draws import CANDIDATE_EVERY
from bayesmap.kernels.surfaces.square_counts import draw_stop_point_m
from bayesmap.samplers.stop_problem import update_periods
from bayesmap.sensors.model import RangeLimits

wp.set_module_options({"enable_backward": False})

GRID = bm.Grid((8, 2), 0.25)
SENSOR = bm.BeamMixture(bm.Gaussian(0.04, 0.01), p_random=0.2, p_no_return=0.1, p_short=0.1, rate_short_per_m=0.6)
PRIORS = {"plain": bm.Beta(1.0, 2.0), "surfaces": bm.Surface(1.0, 2.0, dof=5.0)}
COPIES, SEEDS = 5000, range(5, 9)  # four times as many copies at once take a gigabyte
TESTS = 200  # of counts by squares
LIMIT = -scipy.special.ndtri(ALPHA / TESTS / 2)
READINGS = [0.5, 1.1, 1.75, 1.9, np.inf, -np.inf]


def scans_of(readings):
    angles = np.linspace(-0.08, 0.08, len(readings))
    return bm.Scans([-0.1, 0.22, 0.03], angles, [readings], max_range_m=2.2, min_range_m=0.05)


def state_of(kind, off_m=0.07, thinnest_m=0.03):
    """The cells of one world, (cells, 6): reflectivities of many sizes, surfaces anywhere about their centres."""
    rng, cells = np.random.default_rng(1), GRID.n_cells
    one = np.zeros((cells, 6))
    one[:, 0] = rng.choice([0.02, 0.15, 0.4, 0.8], cells)
    if kind == "surfaces":
        one[:, 1:3] = rng.normal(0, off_m, (cells, 2))
        one[:, 3], one[:, 5] = rng.uniform(thinnest_m, 0.09, (2, cells))
        one[:, 4] = rng.normal(0, 0.05, cells)
    return one


def states_of(worlds, kind, one):
    """The states of the touched cells of all copies, (T, 6), as kernels hold them."""
    states = np.zeros((len(worlds.problem.rays.touched), 6))
    if kind == "surfaces":
        states[:, 1:3] = centres_of(worlds.problem.rays)[0]
    states[worlds.cells()] += one
    return states.astype(np.float32).astype(float)


def swept(kind, count=COPIES, sweep=0, seed=5, one=None, scans=None, sensor=SENSOR):
    """Copies of a world, their state, and the chain after one sweep from it."""
    worlds = copies(scans or scans_of(READINGS), GRID, PRIORS[kind], sensor, count)
    states = states_of(worlds, kind, state_of(kind) if one is None else one)
    sampler = worlds.sampler(seed, states, sweep)
    sampler.sweep()
    return worlds, states, sampler


def chosen(worlds, field):
    """Each beam's stop, counted along the beam; its number of entries for nowhere; (copies, beams)."""
    return (field.stop.numpy() - worlds.problem.rays.offsets[:-1]).reshape(worlds.count, -1)


@cache
def stops_counted(kind):
    """Paths and state of one copy, and the stops of each beam over all copies, (beams, entries)."""
    one = copies(scans_of(READINGS), GRID, PRIORS[kind], SENSOR, 1)
    paths, counts = paths_of(one.problem.rays), 0
    for seed in SEEDS:
        worlds, _, sampler = swept(kind, seed=seed)
        entries = np.arange(paths.cell.shape[1] + 1)[:, None, None]
        counts = counts + (chosen(worlds, sampler.arrays) == entries).sum(axis=1).T
    return paths, states_of(one, kind, state_of(kind)), counts


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
    # Another twin: a beam that forgets to lose weight on the way.
    stopped, distance, variance = stops(paths, states, kind == "plain")
    readings = reading_law(paths.range_m[:, None], distance, variance, SENSOR, paths.limits)
    n = paths.there[1].sum()
    wrong = np.append((stopped * readings)[1, :n], joint(paths, states, SENSOR, kind == "plain")[1, -1])
    assert goodness_of_fit(found[1, : n + 1], wrong / wrong.sum()) < ALPHA / 40


@pytest.mark.parametrize("kind", PRIORS)
def test_the_density_and_place_of_the_stop_are_kept(kind):
    worlds, states, sampler = swept(kind, count=200)
    field = sampler.arrays
    paths = paths_of(worlds.problem.rays)
    _, distance, variance = stops(paths, states, kind == "plain")
    beams, stop = np.arange(len(paths.range_m)), chosen(worlds, field).ravel()
    some = stop < paths.there.sum(axis=1)
    at = (beams[some], stop[some])
    moments = field.stop_moments.numpy()[some]
    np.testing.assert_allclose(moments[:, 0], distance[at], atol=1e-4)
    np.testing.assert_allclose(moments[:, 1], variance[at], rtol=1e-3, atol=1e-7)


def turn_of(worlds, sweep):
    """Cells whose turn to try a candidate a sweep is."""
    every, cells = update_periods(worlds.problem.estimate).astype(int), worlds.problem.rays.touched
    length = np.maximum(every, 1)
    return (every > 0) & (sweep % length == 0) & ((sweep // length + cells) % CANDIDATE_EVERY == 0)


@pytest.mark.parametrize("kind", PRIORS)
def test_hits_are_the_stops_and_met_beams_are_binomial(kind):
    """Given that it passed, a beam met the surface with probability g (1 - m) / (1 - m g): always, if there is none.

    Cells in which readings end and others have kernels of their own: both are looked at.
    """
    for sweep in (0, 8):  # in which cells without readings have their turn
        found = {True: [], False: []}
        for seed in (5, 6):
            worlds, states, sampler = swept(kind, 6000, sweep, seed)
            rays, paths, stop = worlds.problem.rays, paths_of(worlds.problem.rays), sampler.arrays.stop.numpy()
            hits, met = sampler.counts()
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
        entry, stays = np.arange(stopped.shape[1]), np.log(stopped * law + 1e-300)
        terms.append(np.where(entry < stop, np.log1p(-stopped), np.where(entry == stop, stays, 0.0)))
    return np.bincount(paths.cell.ravel(), np.where(paths.there, terms[1] - terms[0], 0.0).ravel(), len(rays.touched))


def test_a_candidate_s_gain_is_the_ratio_of_what_all_beams_say():
    """A far stop also takes back the counts of the cells behind it: every beam here may stop far."""
    one = copies(scans_of(READINGS), GRID, PRIORS["surfaces"], SENSOR, 300)
    turns = [sweep for sweep in range(32) if turn_of(one, sweep).any()]
    for sweep in turns[:6]:
        worlds, states, sampler = swept("surfaces", 300, sweep)
        field = sampler.arrays
        some = turn_of(worlds, sweep)
        candidates = field.candidates.numpy()[worlds.problem.rays.touched, :6].astype(float)
        gain = field.gain.numpy().sum(axis=0)[worlds.problem.rays.touched] / 2**24
        assert some.any()
        assert (gain[~some] == 0).all()
        candidates[~some] = states[~some]
        expected = reference_gains(worlds, states, candidates, field)
        np.testing.assert_allclose(gain[some], expected[some], rtol=2e-3, atol=2e-3)
        assert (abs(expected[some]) > 0.1).any()


def test_invalid_readings_and_empty_beams_say_nothing_and_draws_do_not_repeat_in_the_next_sweep():
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
    worlds, _ = draw_worlds(3, GRID, PRIORS["plain"], SENSOR, 50)
    sampler = worlds.sampler(1)
    seen = []
    for _ in range(2):
        sampler.sweep()
        seen.append(sampler.arrays.stop.numpy().copy())
    assert (seen[0] != seen[1]).mean() > 0.05


def law_of_points(worlds, states, given_reading=True):
    """Chances that the point of a beam's stop lies in each entry's square, and that the beam passes it; (B, K) each."""
    rays, paths = worlds.problem.rays, paths_of(worlds.problem.rays)
    enter, leave = rays.chords()
    beams = len(READINGS)
    _, distance, variance = stops(paths, states, False)
    chances = joint(paths, states, SENSOR, False)
    chances /= chances.sum(axis=-1, keepdims=True)
    inside, passed = (np.zeros((beams, paths.cell.shape[1])) for _ in range(2))
    for b in range(beams):
        n, first, z = paths.there[b].sum(), rays.offsets[b], rays.range_m[b]
        edges = np.concatenate([[-np.inf], enter[first + 1 : first + n], [leave[first + n - 1]], [np.inf]])
        for k in range(n):
            t, v = distance[b, k], variance[b, k]
            echo, post, post_v = 0.0, t, v
            if np.isfinite(z) and given_reading:
                known, rate = 1 - SENSOR.p_random, SENSOR.rate_short_per_m
                other = SENSOR.p_random / (paths.limits.max_m - paths.limits.min_m)
                other += known * SENSOR.p_short * rate * np.exp(-rate * z) * (z < min(t, paths.limits.max_m))
                echo = 1 - other / reading_law(z, t, v, SENSOR, paths.limits)
                noise = (SENSOR.noise.sigma_m + SENSOR.noise.sigma_per_m * t) ** 2
                post, post_v = t + v / (v + noise) * (z - t), v * noise / (v + noise)
            below = echo * scipy.stats.norm.cdf(edges, post, np.sqrt(post_v))
            below = below + (1 - echo) * scipy.stats.norm.cdf(edges, t, np.sqrt(v))
            inside[b, :n] += chances[b, k] * np.diff(below)[:n]
            passed[b, :n] += chances[b, k] * (1 - below[1 : n + 1])
        passed[b, :n] += chances[b, -1]
    return inside, passed


def z_of(worlds, counts, law):
    """How far each square's mean count over the copies lies from the law's, in its standard errors."""
    paths = paths_of(worlds.problem.rays)
    cells = worlds.cells()
    numbers = {int(cell): i for i, cell in enumerate(cells[0])}
    mean, variance = (np.zeros(GRID.n_cells) for _ in range(2))
    for b, row in enumerate(law):
        for k in np.flatnonzero(paths.there[b]):
            mean[numbers[int(paths.cell[b, k])]] += row[k]
            variance[numbers[int(paths.cell[b, k])]] += row[k] * (1 - row[k])
    some = variance > 1e-3
    off = counts[cells].mean(axis=0) - mean
    assert abs(off[~some]).max(initial=0) < 5e-3
    return off[some] / np.sqrt(variance[some] / len(cells))


@pytest.fixture(scope="module")
def in_squares():
    """Copies of a world whose surfaces may lie outside their own squares, and the squares of one sweep's stops."""
    worlds, states, sampler = swept("surfaces", 6000, one=state_of("surfaces", 0.12, 0.02))
    return worlds, states, sampler.state.chains.in_squares(0, 0, is_kept=False)


def test_beams_are_counted_where_their_points_lie(in_squares):
    worlds, states, found = in_squares
    inside, passed = law_of_points(worlds, states)
    assert abs(z_of(worlds, found.stopped, inside)).max() < LIMIT
    assert abs(z_of(worlds, found.passed, passed)).max() < LIMIT
    # the twin: points that know nothing of the reading
    inside, passed = law_of_points(worlds, states, given_reading=False)
    assert abs(z_of(worlds, found.stopped, inside)).max() > LIMIT
    assert abs(z_of(worlds, found.passed, passed)).max() > LIMIT


def test_the_chance_is_a_beta_of_the_counts(in_squares):
    _, _, found = in_squares
    a, b = 1.0 + found.stopped, 2.0 + found.passed
    np.testing.assert_allclose(found.expected, a / (a + b), rtol=1e-5)
    assert scipy.stats.kstest(scipy.stats.beta.cdf(found.drawn, a, b), "uniform").pvalue > ALPHA / TESTS
    assert scipy.stats.kstest(scipy.stats.beta.cdf(found.drawn, a, b + 0.3), "uniform").pvalue < ALPHA / TESTS


LIMITS = RangeLimits(0.05, 8.0)
DRAWS, POINT_TESTS = 3000, 20


@wp.kernel
def points(
    law: SensorLaw32, reading: wp.float32, distance: wp.float32, variance: wp.float32, key: wp.uint64, out: Float64s
):
    i = wp.tid()
    decay = object_decay(law, reading)
    out[i] = draw_stop_point_m(law, reading, decay, distance, variance, key, wp.uint64(i) * wp.uint64(4))


law_of = cache(sensor_law)
"""The law of a model of the user's own is tabulated, which takes seconds."""


def draw_points(sensor, limits, reading_m, distance_m, spread_m, count, seed=0):
    """Distances at which a beam with this reading was stopped by a surface at about the distance, (count,), metres."""
    device.start()
    out = wp.zeros(count, dtype=wp.float64, device="cpu")
    law = law_of(sensor, limits, "cpu", SensorLaw32)
    inputs = [law, reading_m, distance_m, spread_m**2, mix(seed, math.floor(1e6 * spread_m)), out]
    wp.launch(points, dim=count, inputs=inputs, device="cpu")
    return np.array(out.numpy())


@cache
class Late(OwnSensor):
    """Readings come late by a third of the noise, so that the law is not symmetric."""

    def __init__(self, sigma_m):
        super().__init__(bm.BeamMixture(bm.Gaussian(sigma_m), p_random=0.1, p_no_return=0.1, p_short=0.1))
        self.late_m = sigma_m / 3.0

    def log_likelihood(self, range_m, distance_m, limits):
        return super().log_likelihood(range_m, distance_m + self.late_m, limits)


def plain_law(sensor, reading_m, distance_m, spread_m, given_reading=True):
    """Distances, and the cumulative distribution there: a normal law times the reading's likelihood, added up."""
    t = np.linspace(distance_m - 7 * spread_m, distance_m + 7 * spread_m, 20_001)
    log_p = scipy.stats.norm.logpdf(t, distance_m, spread_m)
    if given_reading:
        log_p = log_p + sensor.log_likelihood(np.full_like(t, reading_m), t, LIMITS)
    below = np.cumsum(np.exp(log_p - log_p.max()))
    return t, below / below[-1]


CASES = {
    "a thick surface and a sharp sensor": (0.02, 3.05, 3.0, 0.06),
    "a thin surface and a blunt sensor": (0.3, 3.05, 2.95, 0.02), "both alike": (0.1, 2.1, 2.0, 0.1),
    "the surface's far end": (0.05, 3.25, 3.0, 0.08), "a reading from elsewhere": (0.05, 6.0, 2.0, 0.08),
    "a reading before the surface": (0.05, 1.0, 2.0, 0.08), "no return": (0.05, np.inf, 4.0, 0.1),
}  # fmt: skip


@pytest.mark.parametrize("case", full_but(CASES, "the surface's far end", "no return"))
def test_points_follow_the_surface_times_the_likelihood_of_the_reading(case):
    sigma_m, reading_m, distance_m, spread_m = CASES[case]
    sensor = Late(sigma_m)
    found = draw_points(sensor, LIMITS, reading_m, distance_m, spread_m, DRAWS)

    def p_value(given_reading):
        t, below = plain_law(sensor, reading_m, distance_m, spread_m, given_reading)
        return scipy.stats.kstest(found, lambda x: np.interp(x, t, below)).pvalue

    assert p_value(True) > ALPHA / POINT_TESTS
    if abs(reading_m - distance_m) < 4 * spread_m:  # else it says nothing of the point
        assert p_value(False) < ALPHA / POINT_TESTS


def test_points_of_a_mixture_lie_between_surface_and_reading_if_it_came_from_there():
    """A surface without thickness has one point, and no point lies behind the beam's start."""
    assert (draw_points(Late(0.05), LIMITS, 3.0, 2.9, 0.0, 10) == np.float32(2.9)).all()
    assert draw_points(Late(0.05), LIMITS, 0.1, 0.02, 0.05, 500).min() >= 0
    sensor = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.2, p_no_return=0.1)
    found = draw_points(sensor, LIMITS, 3.1, 3.0, 0.05, DRAWS)
    density = sensor.stop_log_likelihood(np.array([3.1]), np.array([3.0]), np.array([0.05]), LIMITS)
    by_chance = 0.2 / (LIMITS.max_m - LIMITS.min_m) / np.exp(density[0])

    def below(x):
        there = scipy.stats.norm.cdf(x, 3.05, 0.05 / np.sqrt(2))
        return by_chance * scipy.stats.norm.cdf(x, 3.0, 0.05) + (1 - by_chance) * there

    assert scipy.stats.kstest(found, below).pvalue > ALPHA / POINT_TESTS
    assert scipy.stats.kstest(found, lambda x: scipy.stats.norm.cdf(x, 3.0, 0.05)).pvalue < ALPHA / POINT_TESTS
