"""Kinds of cells: what they refuse, describe and draw; draws survive eight cells to a byte, and halves are NumPy's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import bayesmap as bm
from bayesmap.cells import arrays as cell_arrays
from bayesmap.cells.arrays import as_halves, count_walls, pack, unpack
from bayesmap.cells.kinds import prior_from
from bayesmap.cells.reflectivity import counts_behind
from bayesmap.io.ros.maps import read_map

PRIORS = [bm.Beta(), bm.Beta(0.5, 3.0), bm.Surface(), bm.Surface(0.1, 2, 0.3, 0.2, 4.5)]


@pytest.mark.parametrize("prior", [*PRIORS, bm.Independent(0.2), bm.Ising(0.2, 0.75)])
def test_a_prior_comes_back_from_its_description(prior):
    again = prior_from(prior.describe())
    assert (type(again), vars(again), repr(again)) == (type(prior), vars(prior), repr(prior))


@pytest.mark.parametrize("prior", [bm.Beta(0.5, 1.5), bm.Surface(0.5, 1.5)])
def test_the_mean_is_the_share_of_stopped_beams(prior):
    assert prior.mean == 0.25


BAD = [0.0, -1.0, np.nan, np.inf]
REFUSED = [
    *((kind, {which: value}, f"{kind.__name__}: {which} must be a positive number")
      for kind in (bm.Beta, bm.Surface) for which in ("a", "b") for value in BAD),
    *((bm.Surface, {which: value}, f"{which} must be a positive number of cells")
      for which in ("mean_scale", "spread", "size_scale") for value in BAD),
    *((bm.Surface, {"dof": value}, "dof must exceed 1") for value in (1.0, 0.5, np.nan, np.inf)),
    (bm.Surface, {"coupling": -0.1}, r"Surface: coupling must be a number in \[0, 50\], got -0.1"),
    (bm.Surface, {"coupling": np.nan}, "coupling must be a number"),
    (bm.Beta, {"coupling": "fit"}, "Beta: coupling must be a number in .* got 'fit'"),
    (bm.Surface, {"coupling": 1.0, "a_solid": 0.0}, "Surface: a_solid must be a positive number"),
    (bm.Ising, {"p_wall": 1.5, "coupling": 0.5}, r"Ising: p_wall must lie in \[0, 1\], got 1.5"),
    (bm.Ising, {"p_wall": 0.5, "coupling": -0.1}, r"Ising: coupling must lie in \[0, 50\], got -0.1"),
    *((bm.Ising, {"p_wall": 0.5, "coupling": value}, "coupling must lie in") for value in (np.nan, np.inf)),
    (bm.Ising, {"p_wall": 0.5, "coupling": "strong"}, "coupling must be a number or 'fit', got 'strong'"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "arguments", "message"), REFUSED)
def test_parameters_that_make_no_sense_are_refused(kind, arguments, message):
    with pytest.raises(bm.BadInput, match=message):
        kind(**arguments)


def test_walls_of_another_grid_a_coupling_not_fitted_and_surfaces_hardly_ever_small_enough_are_refused():
    with pytest.raises(bm.BadInput, match="coupling is not fitted yet"):
        bm.Ising(0.5, "fit").log_prob(np.zeros((2, 2), bool), bm.Grid((2, 2)))
    with pytest.raises(bm.BadInput, match="Ising: p_wall has shape"):
        bm.Ising(np.full((2, 3), 0.5), 1.0).probabilities(bm.Grid((2, 2)))
    with pytest.raises(bm.BadInput, match="spread must not exceed 3 times size_scale"):
        bm.Surface(spread=1.0, size_scale=0.2)
    assert bm.Surface(spread=0.9, size_scale=0.31).sample_surfaces(np.random.default_rng(1), 100).shape == (100, 5)


@pytest.fixture(scope="module", params=[bm.Independent(0.2), bm.Beta(), bm.Surface()], ids=lambda p: p.words.kind)
def run(request):
    grid = bm.Grid((8, 6), 0.5)
    walls = np.zeros(grid.shape, dtype=bool)
    walls[6] = True
    sensor = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.01, p_no_return=0.01)
    angles = np.linspace(-0.3, 0.3, 9)
    scans = bm.simulate(walls, grid, [1.2, 1.4, 0.0], angles, sensor=sensor, max_range_m=6.0, seed=1)
    return bm.infer(
        scans, grid, prior=request.param, sensor=sensor, schedule=bm.Schedule(chains=2, warmup=5, draws=12), seed=2
    )


def test_drawn_stops_are_the_draws_themselves_and_not_what_they_expect(run):
    posterior = run.posterior
    stops = np.concatenate(list(posterior.prior.drawn_stops(posterior.draws)))
    chance = stops if stops.ndim == 2 else stops[..., 0]
    assert chance.shape == (24, run.grid.n_cells)
    known = posterior.draws.index.get("cell", np.arange(run.grid.n_cells))
    for number, (chain, draw) in enumerate(posterior.draws.numbers()):
        drawn = posterior.draws.cells(chain, draw)
        state = (drawn["walls"] if "walls" in drawn else drawn["reflectivity"]).ravel().astype(np.float32)
        np.testing.assert_array_equal(chance[number, known], state[known])
        assert np.isnan(np.delete(state, known)).all()
    some = np.array([3, 17, 40], dtype=np.int32)
    np.testing.assert_array_equal(
        np.concatenate(list(posterior.prior.drawn_stops(posterior.draws, some))), stops[:, some]
    )


def test_cells_that_no_beam_touched_are_drawn_from_the_prior(run):
    """Their mean is the prior's: five standard errors, a false alarm in 1 700 000."""
    posterior = run.posterior
    if posterior.kind == "binary":
        pytest.skip("binary draws hold all cells")
    untouched = np.setdiff1d(np.arange(run.grid.n_cells), posterior.draws.index["cell"]).astype(np.int32)
    assert len(untouched) > 5
    stops = np.concatenate(list(posterior.prior.drawn_stops(posterior.draws, untouched)))
    chance = stops if stops.ndim == 2 else stops[..., 0]
    a, b = posterior.prior.a, posterior.prior.b
    error = np.sqrt(a * b / ((a + b) ** 2 * (a + b + 1)) / chance.size)
    assert abs(chance.mean() - posterior.prior.mean) < 5 * error
    assert chance.std() > 0.1


def test_thinned_draws_are_some_of_each_chain(run):
    draws = run.posterior.draws
    few = draws.thinned(7)
    assert (few.chains, few.count) == (2, 3)
    name = draws.specs[0].name
    np.testing.assert_array_equal(few.arrays[name], draws.arrays[name][:, [0, 6, 11]])
    assert (draws.thinned(1).count, draws.thinned(1000).count) == (1, 12)


@pytest.mark.parametrize(("a", "b"), [(0.0213, 0.187), (0.0089, 0.0949)])
def test_counts_of_beams_are_read_off_expected_chances(a, b):
    stopped, passed = (counts.ravel().astype(float) for counts in np.mgrid[0:8, 0:12])
    expected = ((a + stopped) / (a + b + stopped + passed)).astype(np.float16).astype(float)
    found = counts_behind(expected, np.full_like(stopped, a), np.full_like(stopped, b))
    np.testing.assert_array_equal(found, [stopped, passed])


@pytest.mark.parametrize(
    "prior", [bm.Beta(), bm.Surface(), bm.Beta(0.02, 0.2, coupling=0.5)], ids=["beta", "surface", "labels"]
)
def test_a_cell_is_free_and_certain_only_if_enough_beams_passed_it(prior, tmp_path):
    sensor = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01)
    schedule = bm.Schedule(chains=2, warmup=20, draws=20)
    for beams, free, certain in ((1, False, False), (3, False, False), (8, True, True)):
        ranges = np.full((beams, 1), 1.75)
        scans = bm.Scans(np.tile([0.25, 0.25, 0.0], (beams, 1)), [0.0], ranges, max_range_m=5.0)
        run = bm.infer(scans, bm.Grid((5, 1), 0.5), prior=prior, sensor=sensor, schedule=schedule)
        run.export(tmp_path / "map.yaml")
        occupancy, _ = read_map(tmp_path / "map.yaml")
        passed = (slice(1, 3), 0)
        assert prior.has_labels or (run.occupancy[passed] < 0.1).all()
        assert ((occupancy[passed] == 0).all(), np.isnan(occupancy[passed]).all()) == (free, not free)
        assert (run.posterior.prior.width(run.posterior.draws, 0.9)[passed] < 0.4).all() == certain


boolean_maps = st.tuples(st.integers(0, 3), st.integers(0, 5), st.integers(1, 9), st.integers(1, 9)).flatmap(
    lambda shape: arrays(np.bool_, shape)
)


@given(boolean_maps)
def test_unpacking_gives_back_what_was_packed(walls):
    packed = pack(walls)
    assert packed.dtype == np.uint8
    assert packed.shape == (*walls.shape[:2], -(-walls.shape[2] * walls.shape[3] // 8))
    back = unpack(packed, walls.shape[2:])
    assert back.dtype == np.bool_
    np.testing.assert_array_equal(back, walls)


@given(boolean_maps)
def test_a_single_map_packs_like_one_of_many(walls):
    for chain, packed in zip(walls, pack(walls), strict=True):
        for one, bits in zip(chain, packed, strict=True):
            np.testing.assert_array_equal(pack(one), bits)


@given(arrays(np.bool_, st.tuples(st.integers(0, 30), st.integers(1, 6), st.integers(1, 6))))
def test_counting_walls_needs_no_unpacking(walls):
    cells = walls.shape[1] * walls.shape[2]
    np.testing.assert_array_equal(count_walls(pack(walls), cells), walls.reshape(-1, cells).sum(axis=0))


def test_counting_in_batches_gives_the_same_and_numbers_of_which_halves_hold_some_bits_are_numpy_s(monkeypatch):
    walls = np.random.default_rng(1).random((100, 5, 7)) < 0.3
    monkeypatch.setattr(cell_arrays, "BATCH_BITS", 100)
    np.testing.assert_array_equal(count_walls(pack(walls), 35), walls.reshape(100, -1).sum(axis=0))
    steps = np.arange(2**12) / 2.0**26
    values = np.concatenate([sign * steps * (1 + e) for sign in (-1, 1) for e in (-1e-9, 0, 1e-9)])
    np.testing.assert_array_equal(as_halves(values).view(np.uint16), values.astype(np.float16).view(np.uint16))
    assert len(np.unique(as_halves(values))) > 2000


@given(arrays(np.uint32, st.integers(0, 50)), st.sampled_from([np.float32, np.float64]))
def test_halves_are_those_of_numpy(bits, dtype):
    values = bits.view(np.float32).astype(dtype)
    with np.errstate(all="ignore"):
        np.testing.assert_array_equal(as_halves(values).view(np.uint16), values.astype(np.float16).view(np.uint16))
