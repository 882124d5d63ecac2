"""A fourth kind of cells, defined here, goes through the whole package; its law is enumerated (false alarms: 1e-4)."""

import itertools
import subprocess
import sys
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from cells.glass import Glass
from flat_options import grouped
from oracle.verdict import ALPHA, goodness_of_fit
from tiers import full_but

import bayesmap as bm
from bayesmap.cells.kinds import prior_from
from bayesmap.kernels.rays import trace_rays
from bayesmap.model import Model, log_likelihoods
from bayesmap.run import runner
from bayesmap.samplers.metropolis import Metropolis, _sweep

GRID = bm.Grid((2, 2), 0.5)
SENSOR = bm.BeamMixture(bm.Gaussian(0.15), p_random=0.1, p_no_return=0.1, p_short=0.05)
SCANS = bm.Scans(
    [[-0.4, 0.2, 0.05], [0.45, -0.5, 1.4], [1.3, 0.8, -2.6]], [-0.1, 0.15],
    [[0.65, 1.1], [np.inf, 0.72], [0.9, 0.5]], max_range_m=2.0, min_range_m=0.15,
)  # fmt: skip
CHAINS = 300


MAPS = np.array(list(itertools.product(range(3), repeat=4)), dtype=np.int8)


@cache
def law(beta):
    """The posterior of all 81 maps, (81,), by the joint law in plain NumPy, the sensor's law to the power of beta."""
    prior, rays, log_p = Glass(), trace_rays(SCANS, GRID), []
    for cells in ({"material": materials.reshape(2, 2)} for materials in MAPS):
        readings = log_likelihoods(rays, prior.stops(cells, GRID), SENSOR, 0.5, beta)
        log_p.append(prior.log_prob(cells, GRID) + readings.sum())
    p = np.exp(np.array(log_p) - np.max(log_p))
    return p / p.sum()


@pytest.mark.parametrize("beta", full_but([1.0, 0.3, 0.0], 0.3))
def test_metropolis_follows_the_exact_posterior_tempered_or_not(beta):
    sampler = Metropolis()
    problem = sampler.prepare(Model(SCANS, GRID, Glass(), SENSOR, hit_depth=0.5), "cpu")
    state, _ = sampler.step(sampler.init(problem, range(CHAINS), 3), 6, beta)
    counts = np.bincount(sampler.snapshot(state).arrays["material"].reshape(-1, 4) @ [27, 9, 3, 1], minlength=81)
    assert goodness_of_fit(counts, law(beta)) > ALPHA / 6
    assert goodness_of_fit(counts, law(beta + 0.5)) < ALPHA / 6  # the twin


def infer(**options):
    chosen = {"prior": Glass(), "sensor": SENSOR, "chains": 2, "warmup": 10, "draws": 80, "hit_depth": 0.5} | options
    return bm.infer(SCANS, GRID, **grouped(**chosen))


@pytest.fixture(scope="module")
def run():
    return infer()


def test_infer_takes_a_kind_of_cells_of_the_user_s_own(run):
    assert (run.posterior.kind, run.posterior.settings["method"]) == ("glass", "metropolis")
    assert run.draws.shape == (2, 80, 2, 2)
    np.testing.assert_allclose(run.occupancy.ravel(), law(1.0) @ np.array([0.0, 0.3, 1.0])[MAPS], atol=0.15)
    np.testing.assert_allclose(run.draws.mean(axis=(0, 1)), run.occupancy, atol=1e-6)
    assert run.observed.all()
    assert run.summary().finished
    assert "free, glass or wall" in repr(run)
    with pytest.raises(bm.BadInput, match="Glass has one method, 'metropolis', got 'gibbs'"):
        infer(method="gibbs")


def test_it_is_saved_loaded_and_resumed_bit_for_bit(run, tmp_path, monkeypatch):
    run.save(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    assert loaded.posterior.prior == Glass() == prior_from(Glass().describe())
    np.testing.assert_array_equal(loaded.posterior.draws.arrays["material"], run.posterior.draws.arrays["material"])
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    stops = []
    whole = infer(draws=5, on_checkpoint=stops.append, checkpoint_every_s=0.0)
    stops[11].save(tmp_path / "part.nc")
    resumed = infer(draws=5, resume=bm.load(tmp_path / "part.nc"))
    np.testing.assert_array_equal(resumed.draws, whole.draws)
    np.testing.assert_array_equal(resumed.log_joint, whole.log_joint)


def test_it_is_scored_by_the_joint_law_and_its_dataset_has_its_own_array(run):
    held = bm.Scans([[-0.3, 0.3, 0.0], [1.2, 0.1, 2.7]], [-0.2, 0.1], [[0.6, np.inf], [1.2, 0.9]], max_range_m=2.0)
    model, draws = Model(held, GRID, Glass(), SENSOR, hit_depth=0.5), run.posterior.draws
    beams = [model.beam_log_likelihoods(model.state(draws.cells(*number))) for number in draws.numbers()]
    expected = np.log(np.mean(np.exp(beams), axis=0)).mean()
    assert (run.log_score(held), bm.score(run, held).nats_per_beam) == pytest.approx((expected,) * 2, abs=2e-3)
    dataset = run.dataset()
    assert dataset["material"].dims == ("chain", "draw", "x", "y")
    assert dataset["material"].attrs["long_name"] == "free, glass or wall"


def test_it_is_drawn_and_exported(run, tmp_path):
    assert any(Glass.words.value in axes.get_xlabel() + str(axes.get_label()) for axes in run.plot().axes)
    assert "<img" in run._repr_html_()
    lower, upper = run.interval(0.8)
    assert (lower <= upper).all()
    for name in ("map.yaml", "map.tif"):
        assert run.export(tmp_path / name)
    with pytest.raises(bm.BadInput, match="free, glass or wall, without surfaces"):
        run.surfaces()


def test_the_command_line_draws_and_describes_it_and_without_its_module_refuses_it_by_name(run, tmp_path):
    run.save(tmp_path / "run.nc")
    path = str(tmp_path / "run.nc")
    commands = [["info", path], ["render", path, "--what", "mean"], ["render", path], ["export", path]]
    script = (
        f"import sys; sys.path.insert(0, {str(Path(__file__).parents[1])!r}); import cells.glass\n"
        "from bayesmap.cli.main import main\n"
        f"for arguments in {commands!r}:\n"
        "    sys.argv = ['bayesmap', *arguments]\n"
        "    try:\n"
        "        main()\n"
        "    except SystemExit as end:\n"
        "        assert not end.code, (arguments, end.code)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "free, glass or wall" in done.stdout
    script = f"import bayesmap as bm; bm.load({str(tmp_path / 'run.nc')!r})"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert "cells of kind 'glass' are not known here" in done.stderr


@pytest.mark.parametrize(("log_ratio", "accepted"), [(-0.1, False), (0.0, True), (-0.01, True)])
def test_a_proposal_is_accepted_with_the_probability_of_its_ratio(log_ratio, accepted):
    """The uniform number is e^-0.05: what enumeration of few chains cannot see of the ratio is seen here."""
    cells = {"material": np.zeros((1, 1), dtype=np.int8)}
    kind = SimpleNamespace(propose=lambda cells, site, rng, grid: ({"material": np.int8(2)}, log_ratio))
    problem = SimpleNamespace(grid=bm.Grid((1, 1), 0.5), beams_by_cell=[()], model=SimpleNamespace(cells=kind))
    _sweep(problem, cells, np.zeros(0), 1.0, SimpleNamespace(random=lambda: np.exp(-0.05)))
    assert (cells["material"][0, 0] == 2) == accepted
