"""The beam table holds the sensor's likelihood at the oracle's distances; its index is the table turned round."""

import numpy as np
import pytest
from oracle.enumeration import all_maps, beams, distances
from oracle.worlds import OwnSensor, make_case
from test_rays import GRID, random_scans

import bayesmap as bm
from bayesmap.kernels import device as devices
from bayesmap.kernels.walls import table as tracing
from bayesmap.kernels.walls.table import index_by_cell, trace
from bayesmap.sensors.model import FLAT_NATS, RangeLimits

SENSORS = {
    "gaussian": bm.Gaussian(0.3), "growing": bm.Gaussian(0.1, 0.1), "student-t": bm.StudentT(0.2, 3.0, 0.02),
    "mixture": bm.BeamMixture(bm.Gaussian(0.05)),
    "wide mixture": bm.BeamMixture(bm.Gaussian(0.5, 0.05), 0.1, 0.1, 0.3, 1.0),
    "student-t mixture": bm.BeamMixture(bm.StudentT(0.05, 4.0)),
}  # fmt: skip
FLOAT32 = 2e-5
"""Likelihoods, and the distances that NumPy is given, are in single precision: 3e-7 of 3 m, times slopes of some tens
of nats a metre."""


@pytest.mark.parametrize("name", SENSORS)
def test_the_log_likelihood_of_a_map_is_the_sum_over_beams_at_the_oracle_s_distances(name, monkeypatch):
    """The compiled likelihood, and that of NumPy for a sensor without formulas for kernels."""
    monkeypatch.setattr(tracing, "SLICE", 100)  # several slices, not one
    sensor = SENSORS[name]
    for seed in range(10):
        scans = random_scans(seed)
        table, plain = trace(scans, GRID, sensor), trace(scans, GRID, OwnSensor(sensor))
        np.testing.assert_array_equal(table.offsets, plain.offsets)
        np.testing.assert_array_equal(table.cells, plain.cells)
        np.testing.assert_allclose(table.loglik, plain.loglik, rtol=FLOAT32, atol=FLOAT32)
        np.testing.assert_allclose(table.no_hit, plain.no_hit, rtol=1e-6, atol=1e-6)
        walls = np.random.default_rng([seed, 1]).random(GRID.shape) < [0.02, 0.1, 0.3, 0.9][seed % 4]
        starts, angles = beams(scans.poses, scans.angles_rad, GRID)
        d = distances(walls, starts, angles) * GRID.resolution
        z, limits = scans.ranges_m.ravel(), RangeLimits(scans.min_range_m, scans.max_range_m)
        expected = sensor.log_likelihood(z, d, limits)
        np.testing.assert_allclose(table.beam_log_likelihoods(walls), expected, atol=FLAT_NATS + FLOAT32, rtol=1e-5)
        assert table.log_likelihood(walls) == pytest.approx(expected.sum(), abs=len(z) * (FLAT_NATS + FLOAT32))


def test_a_robust_table_is_much_smaller_and_a_map_of_another_shape_is_refused():
    scans = bm.Scans([3.1, 0.1, 0.0], np.linspace(-0.5, 0.5, 50), np.full((1, 50), 0.5), max_range_m=10.0)
    robust, stiff = (trace(scans, GRID, s) for s in (bm.BeamMixture(bm.Gaussian(0.02)), bm.Gaussian(0.02)))
    assert robust.n_incidences < 0.5 * stiff.n_incidences
    table = trace(random_scans(0), GRID, bm.Gaussian(0.1))
    with pytest.raises(bm.BadInput, match=r"walls have shape \(9, 13\), but the grid is \(13, 9\)"):
        table.log_likelihood(np.zeros((9, 13)))


@pytest.mark.parametrize("depth", [0.25, 0.5, 1.0])
def test_hit_depth_moves_hits_into_the_cell_by_that_share_of_the_chord(depth):
    scans = bm.Scans([3.0, -0.875, 0.0], [0.0], [[1.5]], max_range_m=10.0)  # along the middle of the lowest row
    table = trace(scans, GRID, bm.Gaussian(0.3), hit_depth=depth)
    limits = RangeLimits(0.0, 10.0)
    into = bm.Gaussian(0.3).log_likelihood(np.float64(1.5), (np.arange(13) + depth) * 0.25, limits)
    # the first cell is left, not entered: from inside, the hit is its exit
    np.testing.assert_allclose(table.loglik[-12:], into[1:], atol=FLOAT32)


@pytest.mark.parametrize("name", SENSORS)
def test_the_index_is_a_permutation_of_the_table_in_which_incidences_that_could_gain_come_first(name):
    table = trace(random_scans(1), GRID, SENSORS[name])
    index = index_by_cell(table)
    np.testing.assert_array_equal(np.sort(index.entry), np.arange(table.n_incidences))
    cell = np.repeat(np.arange(GRID.n_cells), np.diff(index.offsets))
    np.testing.assert_array_equal(table.cells[index.entry], cell)
    np.testing.assert_array_equal(table.loglik[index.entry], index.loglik)
    assert (table.offsets[index.beam] <= index.entry).all()
    assert (index.entry < table.offsets[index.beam + 1]).all()
    for c in range(GRID.n_cells):
        gain = -np.diff(np.append(index.gain_bound[index.offsets[c] : index.offsets[c + 1]], 0.0))
        first_small = np.append(np.flatnonzero(gain < 5e-4), len(gain))[0]  # the kernel's limit is 1e-3 nats
        assert (gain[first_small:] < 2e-3).all()


@pytest.mark.parametrize("sensor", [bm.Gaussian(0.3), bm.BeamMixture(bm.Gaussian(0.1))], ids=["gaussian", "mixture"])
@pytest.mark.parametrize("seed", range(4))
def test_the_index_bounds_what_walls_can_add(sensor, seed):
    """Over all 512 maps of 3 x 3 cells.

    The gains of an incidence and of those after it in its cell never exceed the bound. The advantage is the least that
    a wall is worth to a beam that hits it, in some map.
    """
    case = make_case(seed, shape=(3, 3), n_poses=3, sensor=sensor)
    table = case.problem().table
    index = index_by_cell(table)
    for b, e, advantage in zip(index.beam, index.entry, index.advantage, strict=True):
        behind = np.append(table.loglik[e + 1 : table.offsets[b + 1]], table.no_hit[b])
        assert advantage == pytest.approx(table.loglik[e] - behind.max(), abs=1e-5)
    maps = all_maps(9)
    for c in range(9):
        gains = np.zeros((len(maps), index.offsets[c + 1] - index.offsets[c]))
        put, removed = maps.copy(), maps.copy()
        put[:, c], removed[:, c] = True, False
        for m in range(len(maps)):
            with_wall, without = (table.beam_log_likelihoods(w[m].reshape(3, 3)) for w in (put, removed))
            gains[m] = (with_wall - without)[index.beam[index.offsets[c] : index.offsets[c + 1]]]
        rest = np.cumsum(gains[:, ::-1], axis=1)[:, ::-1]
        bound = index.gain_bound[index.offsets[c] : index.offsets[c + 1]]
        assert (rest <= bound + 1e-4).all()  # sums of some dozen single-precision terms of up to some hundred nats


def test_table_and_index_do_not_depend_on_the_number_of_threads(monkeypatch):
    scans, found = random_scans(3), []
    for threads in (1, 2, 3, 8):
        monkeypatch.setattr(devices, "available_cores", lambda threads=threads: threads)
        table = trace(scans, GRID, SENSORS["mixture"])
        parts = (table, index_by_cell(table))
        found.append([a for part in parts for a in vars(part).values() if isinstance(a, np.ndarray)])
    for other in found[1:]:
        for mine, theirs in zip(other, found[0], strict=True):
            np.testing.assert_array_equal(mine, theirs)
