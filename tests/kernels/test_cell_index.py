"""The index by cells is the beam table turned round, and its bounds bound."""

import numpy as np
import pytest
from oracle.enumeration import all_maps
from oracle.worlds import make_case
from test_beam_table import GRID, SENSORS, random_scans

import bayesmap as bm
from bayesmap.kernels import device as devices
from bayesmap.kernels.walls.table import index_by_cell, trace

FIELDS = ("offsets", "entry", "beam", "loglik", "gain_bound", "advantage")


@pytest.mark.parametrize("name", SENSORS)
def test_the_index_is_a_permutation_of_the_table(name):
    table = trace(random_scans(1, GRID), GRID, SENSORS[name])
    index = index_by_cell(table)
    np.testing.assert_array_equal(np.sort(index.entry), np.arange(table.n_incidences))
    cell = np.repeat(np.arange(GRID.n_cells), np.diff(index.offsets))
    np.testing.assert_array_equal(table.cells[index.entry], cell)
    np.testing.assert_array_equal(table.loglik[index.entry], index.loglik)
    assert (table.offsets[index.beam] <= index.entry).all()
    assert (index.entry < table.offsets[index.beam + 1]).all()


@pytest.mark.parametrize("sensor", [bm.Gaussian(0.3), bm.BeamMixture(bm.Gaussian(0.1))], ids=["gaussian", "mixture"])
@pytest.mark.parametrize("seed", range(4))
def test_the_gain_bound_bounds_what_the_rest_of_a_cell_can_add(sensor, seed):
    """Over all 512 maps of 3 x 3 cells: the gains of an incidence and those after it never add up to more."""
    case = make_case(seed, shape=(3, 3), n_poses=3, sensor=sensor)
    table = case.problem().table
    index = index_by_cell(table)
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


@pytest.mark.parametrize("seed", range(4))
def test_the_lead_is_the_least_that_a_wall_can_be_worth(seed):
    """To a beam that hits it, over all maps of 3 x 3 cells; and some map has just that."""
    table = make_case(seed, shape=(3, 3), n_poses=3, sensor=bm.BeamMixture(bm.Gaussian(0.2))).problem().table
    index = index_by_cell(table)
    for b, e, advantage in zip(index.beam, index.entry, index.advantage, strict=True):
        behind = np.append(table.loglik[e + 1 : table.offsets[b + 1]], table.no_hit[b])
        assert advantage == pytest.approx(table.loglik[e] - behind.max(), abs=1e-5)


def test_incidences_that_could_gain_come_first():
    index = index_by_cell(trace(random_scans(2, GRID), GRID, SENSORS["mixture"]))
    for c in range(GRID.n_cells):
        bound = np.append(index.gain_bound[index.offsets[c] : index.offsets[c + 1]], 0.0)
        gain = -np.diff(bound)
        first_small = np.append(np.flatnonzero(gain < 5e-4), len(gain))[0]  # the kernel's limit is 1e-3 nats
        assert (gain[first_small:] < 2e-3).all()


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
def test_table_and_index_do_not_depend_on_the_number_of_threads(threads, monkeypatch):
    scans = random_scans(3, GRID)
    table = trace(scans, GRID, SENSORS["mixture"])
    index = index_by_cell(table)
    monkeypatch.setattr(devices, "available_cores", lambda: threads)
    again = trace(scans, GRID, SENSORS["mixture"])
    for name in ("offsets", "cells", "loglik", "no_hit"):
        np.testing.assert_array_equal(getattr(again, name), getattr(table, name))
    for name in FIELDS:
        np.testing.assert_array_equal(getattr(index_by_cell(again), name), getattr(index, name))
