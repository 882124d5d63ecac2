"""The predictive density of a beam is one kernel's, wherever it is asked for."""

import numpy as np
import pytest
from oracle.stop_worlds import scans_of_all_kinds

import bayesmap as bm
from bayesmap.posterior.predictor import predictor_of, residuals_of
from bayesmap.posterior.scores import beam_log_scores

KINDS = [bm.Independent(0.2), bm.Beta(0.5, 1.0), bm.Surface(0.5, 1.0)]


@pytest.mark.parametrize("prior", KINDS, ids=lambda prior: prior.words.kind)
def test_all_scores_give_equal_densities_bit_for_bit(prior):
    """The log score, the whole score, and the surprise of residuals are one kernel's, for every kind of cells."""
    grid, sensor = bm.Grid((4, 3), 0.5, (-1.0, 2.0)), bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_no_return=0.1)
    train, held = scans_of_all_kinds(5, grid, poses=20), scans_of_all_kinds(6, grid, poses=7)
    run = bm.infer(train, grid, prior=prior, sensor=sensor, schedule=bm.Schedule(chains=2, warmup=5, draws=8))
    for other in (None, bm.BeamMixture(bm.StudentT(0.1)), bm.Gaussian(0.2)):
        assert run.log_score(held, sensor=other) == bm.score(run, held, sensor=other).nats_per_beam
    predictor = predictor_of(run.posterior)
    found = residuals_of(predictor, held)
    np.testing.assert_array_equal(found.surprise_nats, -beam_log_scores(predictor, held)[found.beams])
