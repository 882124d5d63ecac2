"""The engine gives the library's numbers, however it was interrupted, and frames that say what they are."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from acted import Heard
from flat_options import infer

import bayesmap as bm
from bayesmap.app.edits import new_document, tutorial_document
from bayesmap.app.protocol.actions import Cancel, Inspect
from bayesmap.app.protocol.notices import DrawCount, View
from bayesmap.app.scene import simulate_document, simulated_scene
from bayesmap.app.shown.chains import MAX_DRAW_BYTES, RunningChains
from bayesmap.app.shown.verdicts import VERDICT_LIMITS
from bayesmap.model import Model
from bayesmap.posterior.summary import bulk_ess
from bayesmap.run.chains import SweepPlan
from bayesmap.run.runner import Job, run_chains
from bayesmap.samplers.fit import PILOT_SWEEPS, fit, initial_sensor
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.walls import WallGibbs
from bayesmap.samplers.without_chains import sample_importance


def probability(field):
    return field[1]["p"] / 255


@pytest.mark.parametrize("prior", [0.0, 1.0])
def test_a_prior_that_fixes_every_cell_is_the_answer(prior):
    assert (Heard().infer(replace(tutorial_document(), prior=prior, sweeps=5))[1]["p"] == 255 * prior).all()


def test_a_job_is_a_preview_and_then_chains_to_their_last_sweep(heard):
    heard.infer(tutorial_document(), "preview")
    assert {field["method"] for field in heard.all("field")} == {"propagate"}  # a preview alone stops there
    heard.reports.clear()
    heard.infer(tutorial_document())
    fields = heard.all("field")
    assert [f["approximate"] for f in fields] == sorted((f["approximate"] for f in fields), reverse=True)
    assert fields[0]["approximate"]
    assert fields[-1]["sweeps"] == fields[-1]["total"] == 1000
    assert 0.9 < fields[-1]["rhat"] < 1.1
    assert fields[-1]["ess"] == pytest.approx(bulk_ess(heard.engine._result.estimate.log_joint()[:, 100:]))
    assert heard.all("finished")[-1]["draws"] == DrawCount(2, 1000)


def test_interruptions_do_not_change_the_posterior_of_a_document(heard):
    document = replace(tutorial_document(), sweeps=300)
    alone = probability(Heard().infer(document))
    for steps, other in ((3, 0.1), (1, 0.2), (7, 0.3)):
        heard.infer(replace(document, prior=other), steps=steps)
        heard.infer(document, steps=steps)
    assert np.array_equal(probability(heard.infer(document)), alone)
    assert not np.array_equal(probability(heard.infer(replace(document, seed=1))), alone)


@pytest.mark.parametrize("burn_in", [0.0, 0.3, 0.9])
@pytest.mark.parametrize("mode", ["live", "run"])
def test_the_burn_in_is_left_out_of_mean_diagnostics_and_saved_runs(heard, burn_in, mode, tmp_path):
    heard.infer(replace(tutorial_document(), sweeps=100, start="empty", burn_in=burn_in), mode)
    fields = [(header, buffers) for header, buffers in heard.every("field") if not header["approximate"]]
    assert all(header["burned"] <= burn_in * header["sweeps"] for header, _ in fields)
    header, buffers = fields[-1]
    first = header["burned"]
    assert first == round(100 * burn_in)
    found = heard.engine._result.estimate
    assert header["ess"] == pytest.approx(bulk_ess(found.log_joint()[:, first:]))
    if mode == "run":
        saved = heard.saved_run(tmp_path)
        touched = found.problem.touched_map()  # other cells show the prior mean, to which the mean of draws converges
        np.testing.assert_allclose(buffers["p"][touched], 255 * saved.occupancy[touched], atol=0.5001)
        assert (saved.posterior.settings["warmup"], saved.posterior.warmup_log_joint.shape[1]) == (first, first)
        assert np.array_equal(saved.log_joint, found.log_joint()[:, first:])


@pytest.mark.parametrize("method", ["gibbs", "block"])
def test_a_run_is_that_of_the_library(heard, method):
    document = replace(tutorial_document(), sweeps=40, method=method, prior=0.25)
    header, buffers = heard.infer(document, "run")
    run = infer(
        simulate_document(document)[0], document.grid, prior=bm.Independent(0.25), sensor=bm.Gaussian(0.2),
        method=method, chains=2, warmup=0, draws=40, seed=0, start="prior",
    )  # fmt: skip
    assert header["draws"] == {"chains": 2, "count": 40}
    assert header["burned"] == 4  # a tenth is left out of the mean
    touched = heard.engine._result.estimate.problem.touched_map()
    np.testing.assert_allclose(buffers["p"][touched], 255 * run.draws[:, 4:].mean(axis=(0, 1))[touched], atol=0.5001)
    assert (buffers["p"][~touched] == 64).all()  # cells that no beam touches follow the prior
    for chain, draw in ((0, 0), (1, 39), (0, 17)):
        header, buffers = heard.answer(View("draw", chain, draw))
        assert (header["chain"], header["draw"]) == (chain, draw)
        assert np.array_equal(buffers["p"] > 0, run.draws[chain, draw])
    assert heard.answer(View("draw", 7, 99))[0]["draw"] == 39  # past the end is the last


@pytest.mark.parametrize("burn_in", [0.0, 0.3])
@pytest.mark.parametrize(("most", "steps"), [(7, None), (60, None), (60, 0), (60, 4)])
def test_run_goes_on_from_the_draws_of_live_and_of_a_run(heard, most, steps, burn_in, monkeypatch):
    document = replace(tutorial_document(), sweeps=20, burn_in=burn_in)
    whole = Heard()
    whole.infer(replace(document, sweeps=60), "live")
    reference = whole.engine._result.estimate
    monkeypatch.setattr("bayesmap.app.shown.chains.MAX_DRAW_BYTES", most * reference._draw_bytes)
    heard.infer(document, "live", steps=steps)
    for _ in range(2):
        header, _ = heard.infer(document, "run")
    found = heard.engine._result.estimate
    assert header["sweeps"] == header["total"] == found.total >= 60
    assert header["draws"]["count"] == found.draws.count == found.total // found.thin <= most
    assert np.array_equal(found.log_joint()[:, :60], reference.log_joint())
    same = found.draws.select(slice(60 // found.thin)).arrays["walls"]
    assert np.array_equal(same, reference.draws.arrays["walls"][:, found.thin - 1 : 60 : found.thin])
    assert header["burned"] == int(burn_in * found.total) // found.thin * found.thin
    assert header["generation"] == 3
    if found.thin == 1:
        np.testing.assert_allclose(found.mean(), reference.mean(), atol=1e-12)


def test_run_starts_anew_for_another_document_or_after_clearing():
    heard, document = Heard(), replace(tutorial_document(), sweeps=20)
    heard.infer(document, "live")
    assert heard.infer(replace(document, seed=1), "run")[0]["total"] == 20
    heard.infer(document, "live")
    heard.infer(document, "clear")
    assert heard.infer(document, "run")[0]["total"] == 20


def test_cancelled_and_few_sweeps_are_kept_and_judged_once_they_are_over(heard):
    heard.infer(replace(tutorial_document(), sweeps=10), "run")
    *before, last = [field for field in heard.all("field") if not field["approximate"]]
    assert all(field["verdict"] is None for field in before)
    assert (last["sweeps"], last["verdict"]["level"]) == (10, "bad")
    heard, large = Heard(), new_document("building", (120, 80), tutorial_document())
    heard.infer(replace(large, sweeps=50_000), "run", steps=3)
    assert heard.last("field")[0]["verdict"] is None
    heard.ask(Cancel())
    assert not heard.engine.busy
    field, count = heard.last("field")[0], heard.all("finished")[-1]["draws"].count
    assert 0 < count == field["sweeps"] < VERDICT_LIMITS.fewest_sweeps
    assert field["verdict"]["level"] == "bad"
    assert heard.answer(View("mean"))[0]["verdict"] == field["verdict"]
    assert heard.answer(View("draw", 0, count - 1))[0]["draw"] == count - 1
    assert heard.ask(Cancel()) == []


@pytest.mark.parametrize(("mode", "method"), [("run", "gibbs"), ("live", "gibbs"), ("run", "importance")])
def test_cancel_before_there_is_anything_shows_the_preview(heard, mode, method):
    heard.infer(replace(tutorial_document(), method=method), mode, steps=0)
    heard.ask(Cancel())
    assert not heard.engine._has_live_chains_of(heard.engine._task.document)
    heard.finish()
    assert (heard.last("field")[0]["method"], len(heard.all("finished"))) == ("propagate", 1)


@pytest.mark.parametrize("mode", ["run", "live"])
def test_importance_sampling_is_that_of_the_library(mode):
    document = replace(tutorial_document(), method="importance", sweeps=500, noise=5.0)
    field = Heard().infer(document, mode)
    whole = sample_importance(simulated_scene(document).problem, 500, 0)
    assert np.array_equal(field[1]["p"], np.rint(255 * whole.occupancy()))
    assert field[0]["ess"] == pytest.approx(whole.effective_sample_size)
    assert field[0]["sweeps"] == field[0]["total"] == 500


def test_a_fault_is_told_and_the_engine_goes_on(heard, monkeypatch, capsys):
    with monkeypatch.context() as broken:
        broken.setattr("bayesmap.app.engine.simulated_scene", lambda document: 1 / 0)
        heard.infer(tutorial_document(), steps=1)
    assert "ZeroDivisionError" in heard.all("failed")[0]["reason"]
    assert "ZeroDivisionError" in capsys.readouterr().err
    assert heard.infer(tutorial_document())[0]["sweeps"] == 1000


def test_the_worker_loads_neither_jax_nor_matplotlib():
    load = "import bayesmap.app.worker as w, sys; w._load_kernels()"
    code = f"{load}; print({{'jax', 'matplotlib', 'netCDF4'}} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"


def test_the_scan_says_where_beams_truly_end_and_a_cell_counts_its_beams(heard):
    heard.infer(replace(tutorial_document(), noise=0.01), "preview")
    header, buffers = heard.last("scan")
    assert header["ids"] == [1]
    assert {name: a.shape for name, a in buffers.items()} == {
        "pose": (1, 3), "angles": (100,), "ranges": (1, 100), "exact": (1, 100), "hit": (1, 100)
    }  # fmt: skip
    assert np.abs(buffers["ranges"] - buffers["exact"]).max() < 0.06
    assert [heard.answer(Inspect(at, at))[0]["beams"] for at in (10, 999)] == [100, 0]


def test_many_sweeps_of_a_large_map_are_thinned_to_fit():
    scene = simulated_scene(new_document("blank", (500, 500), tutorial_document()))
    model, start = scene.model(scene.problem.prior), np.zeros((2, 500, 500), dtype=bool)
    stream = RunningChains(model, WallGibbs("radial", start), scene.problem, replace(tutorial_document(), sweeps=6000))
    assert (stream.thin, stream.total) == (3, 6000)
    assert stream._record._arrays["walls"].nbytes <= MAX_DRAW_BYTES


@pytest.mark.parametrize("cells", ["reflectivity", "surface"])
def test_other_kinds_of_cells_run_on_the_page_as_in_the_library_and_are_saved(heard, cells, tmp_path):
    """A pilot fits the sensor, and the draws are those of the library's chains under it."""
    document = replace(tutorial_document(), cells=cells, sweeps=8, noise=0.1, angles=40, burn_in=0.0)
    header, field = heard.infer(document, "run")
    assert header["sweeps"] == header["total"] == 8
    assert header["draws"] == {"chains": 2, "count": 8}
    assert not any(f["approximate"] for f in heard.all("field") if f["method"] != "pilot")
    prior, scans = {"reflectivity": bm.Beta(), "surface": bm.Surface()}[cells], simulate_document(document)[0]
    model = Model(scans, document.grid, prior, initial_sensor(prior, document.grid.resolution), hit_depth=0.5)
    found = fit(StopGibbs().prepare(model, "cpu"), document.seed, PILOT_SWEEPS)
    assert found.prior != prior
    chains = run_chains(Job(model, StopGibbs(), SweepPlan(0, 8), document.seed, (0, 1), parameters=found))
    assert np.array_equal(field["p"], np.rint(255 * found.prior.mean_map(chains.draws)))
    header, drawn = heard.answer(View("draw", 1, 7))
    assert (header["chain"], header["draw"]) == (1, 7)
    one = found.prior.map_of(chains.draws, 1, 7).astype(np.float32)
    assert np.array_equal(drawn["p"], np.rint(np.float32(255) * one))
    run = heard.saved_run(tmp_path)
    assert (run.posterior.kind, run.n_draws, run.posterior.sweep) == (cells, 8, 8)
    assert np.isfinite(run.log_joint).all()
