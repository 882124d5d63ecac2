import numpy as np
from flat_options import infer

import bayesmap as bm


def run_of(method, **options):
    grid, noisy = bm.Grid((4, 3)), bm.Gaussian(2.0)
    angles = np.linspace(0, 6, 20)
    scans = bm.simulate(np.eye(4, 3), grid, [2.5, 1.5, 0.0], angles, sensor=noisy, max_range_m=5.0)
    return infer(scans, grid, prior=bm.Independent(0.3), sensor=noisy, method=method, **options)


def test_a_sound_run_has_no_problems_and_prints_a_line_for_each_of_its_diagnostics():
    summary = run_of("gibbs", draws=4000).summary()
    assert summary.problems() == []
    assert "rhat log joint" in str(summary)
    assert "effective sample size" not in str(summary)  # of weights, which chains do not have


def test_a_collapsed_importance_sampler_says_so():
    summary = run_of("importance", particles=3, draws=10).summary()
    assert summary.effective_sample_size <= 3
    assert any("importance" in problem for problem in summary.problems())
    assert "! importance sampling" in str(summary)


def test_a_run_too_short_to_judge_is_not_called_converged():
    summary = run_of("gibbs", draws=20).summary()
    assert any("effective sample size" in problem for problem in summary.problems())
    assert summary.as_json()["effective_sample_size"] is None
