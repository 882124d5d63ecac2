"""The joint law in plain NumPy is what its formula says, for walls, reflectivities and surfaces."""

import numpy as np
import pytest
import scipy
from oracle.stop_law import log_likelihoods, paths_of
from oracle.stop_worlds import beam_rays, scans_of_all_kinds

import bayesmap as bm
from bayesmap.kernels.walls.table import trace
from bayesmap.model import Model, State

GRID = bm.Grid((6, 5), 0.5, (-1.0, 2.0))
DEPTH = 0.3
SENSOR = bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_random=0.05, p_no_return=0.1, p_short=0.1, rate_short_per_m=0.6)
SENSORS = {"mixture": SENSOR, "student-t mixture": bm.BeamMixture(bm.StudentT(0.1, 3.0)), "gaussian": bm.Gaussian(0.3)}


def scans(seed, lattice=False):
    return scans_of_all_kinds(seed, GRID, lattice=lattice)


@pytest.mark.parametrize("lattice", [False, True])
@pytest.mark.parametrize("name", SENSORS)
def test_walls_have_the_likelihood_of_their_first_hits(name, lattice):
    """The beam table's plain reference looks for the first wall of each beam; here one weight of all stops is 1."""
    sensor, rng = SENSORS[name], np.random.default_rng(1)
    model = Model(scans(1, lattice), GRID, bm.Independent(0.2), sensor, hit_depth=DEPTH)
    table = trace(model.scans, GRID, sensor, hit_depth=DEPTH)
    for density in (0.0, 0.1, 0.5):
        walls = rng.random(GRID.shape) < density
        state = model.state({"walls": walls})
        expected = table.beam_log_likelihoods(walls)
        np.testing.assert_allclose(model.beam_log_likelihoods(state), expected, atol=2e-4, rtol=1e-5)
        prior = np.log(0.2) * walls.sum() + np.log(0.8) * (~walls).sum()
        assert model.log_joint(state) == pytest.approx(prior + model.log_likelihood(state))


def map_of(prior, seed):
    return prior.sample_cells(np.random.default_rng(seed), GRID)


@pytest.mark.parametrize("prior", [bm.Beta(0.5, 1.0), bm.Surface(0.5, 1.0)], ids=["reflectivities", "surfaces"])
def test_reflectivities_and_surfaces_have_the_likelihood_of_the_definition(prior):
    """The other reference works with covariances and knows nothing of this one."""
    for seed in range(4):
        model, cells = Model(scans(seed), GRID, prior, SENSOR, hit_depth=DEPTH), map_of(prior, seed)
        state = model.state(cells)
        rays = beam_rays(model.scans, GRID, whole=True)
        stops = np.zeros((len(rays.touched), 6))
        stops[:, : 6 if prior.has_surfaces else 1] = prior.stops(cells, GRID).reshape(GRID.n_cells, -1)[rays.touched]
        expected = log_likelihoods(paths_of(rays, far=False, hit_depth=DEPTH), stops, SENSOR, not prior.has_surfaces)
        np.testing.assert_allclose(model.beam_log_likelihoods(state), expected, atol=1e-5)
        assert model.log_joint(state) == pytest.approx(prior.log_prob(cells, GRID) + expected.sum(), abs=1e-3)


@pytest.mark.parametrize(
    "prior",
    [bm.Independent(0.2), bm.Beta(0.5, 1.0), bm.Surface(0.5, 1.0), bm.Beta(coupling=1.0), bm.Surface(coupling=1.0)],
    ids=lambda prior: f"{type(prior).__name__} {getattr(prior, 'coupling', 0)}",
)
def test_a_run_s_draw_is_a_state(prior):
    """Draws keep some cells only, in half precision; the others are as the prior has them."""
    short = bm.Schedule(chains=1, warmup=10, draws=3)
    run = bm.infer(scans(2), GRID, prior=prior, sensor=SENSOR, schedule=short, hit_depth=DEPTH)
    model, draws = Model(scans(2), GRID, prior, SENSOR, hit_depth=DEPTH), run.posterior.draws
    for number in range(3):
        cells = draws.cells(0, number)
        assert {values.shape for values in cells.values()} == {GRID.shape}
        state = model.state(cells)
        assert np.isfinite(model.log_joint(state))
        reported = run.posterior.log_likelihood[0, number]
        slack = 1e-3 if not prior.has_surfaces else 0.05 * abs(reported)  # where no reading ends surfaces are others
        assert model.log_likelihood(state) == pytest.approx(reported, abs=max(slack, 1e-3 * model.scans.n_beams))


def test_poses_that_move_are_weighed_where_they_are_and_many_beams_some_at_a_time(monkeypatch):
    there = scans(3)
    poses = there.poses + np.random.default_rng(4).normal(0, 0.1, there.poses.shape)
    prior, cells = bm.Surface(0.5, 1.0), map_of(bm.Surface(0.5, 1.0), 4)
    model = Model(there, GRID, prior, SENSOR, bm.UncertainPoses(0.1, 0.1))
    moved = Model(there.at(poses), GRID, prior, SENSOR)
    at = State(cells, SENSOR, poses)
    assert model.log_likelihood(at) == pytest.approx(moved.log_likelihood(moved.state(cells)))
    of_poses = scipy.stats.norm.logpdf(poses - there.poses, 0, 0.1).sum()
    assert model.log_joint(at) == pytest.approx(of_poses + prior.log_prob(cells, GRID) + model.log_likelihood(at))
    fixed = Model(there, GRID, prior, SENSOR)
    assert fixed.log_joint(at) == -np.inf
    assert np.isfinite(fixed.log_joint(fixed.state(cells)))
    with pytest.raises(bm.BadInput, match=r"state: poses has shape \(1, 3\)"):
        fixed.log_joint(State(cells, SENSOR, poses[:1]))

    whole = moved.beam_log_likelihoods(moved.state(cells))  # many beams are weighed some at a time
    monkeypatch.setattr("bayesmap.model.BEAMS_AT_ONCE", 1)
    np.testing.assert_allclose(moved.beam_log_likelihoods(moved.state(cells)), whole)
