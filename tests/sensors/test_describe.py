"""A sensor model survives the way through JSON; what cannot be a sensor is refused by name."""

import json

import numpy as np
import pytest
from sensor_cases import ALL

import bayesmap as bm
from bayesmap.sensors.builtin import describe, from_description


def test_a_description_gives_the_model_back():
    assert {name: from_description(json.loads(json.dumps(describe(model)))) for name, model in ALL.items()} == ALL


def test_a_model_that_is_not_ours_is_known_by_its_name_alone():
    class Sonar(bm.Gaussian):
        pass

    assert describe(Sonar(0.1)) == {"kind": "Sonar"}
    assert from_description({"kind": "Sonar"}) is None


@pytest.mark.parametrize(("description", "message"), [
    ({"kind": "gaussian", "sigma": 1.0}, r"'gaussian' has no parameter 'sigma'; it has: sigma_m, sigma_per_m"),
    ({"kind": "mixture", "noise": {"kind": "mixture"}}, "noise is 'gaussian' or 'student-t'"),
    ({"kind": "gaussian", "sigma_m": -1.0}, "sigma_m must be a positive number"),
])  # fmt: skip
def test_a_wrong_description_is_refused(description, message):
    with pytest.raises(bm.BadInput, match=message):
        from_description(description)


@pytest.mark.parametrize(("make", "message"), [
    (lambda: bm.Gaussian(0.0), "Gaussian: sigma_m must be a positive number of metres, got 0.0"),
    (lambda: bm.Gaussian(np.inf), "sigma_m must be a positive"),
    (lambda: bm.Gaussian(np.nan), "sigma_m must be a positive"),
    (lambda: bm.Gaussian(0.1, -0.1), "growth of the noise per metre must be 0 or more"),
    (lambda: bm.StudentT(0.0), "StudentT: scale_m"),
    (lambda: bm.StudentT(0.1, 0.0), "dof must be a positive number"),
    (lambda: bm.BeamMixture(p_random=0.0), r"p_random must lie inside \(0, 1\), got 0.0"),
    (lambda: bm.BeamMixture(p_random=1.0), "p_random"),
    (lambda: bm.BeamMixture(p_short=1.0), r"p_short must lie in \[0, 1\)"),
    (lambda: bm.BeamMixture(p_no_return=-0.1), "p_no_return"),
    (lambda: bm.BeamMixture(p_no_return=np.nan), "p_no_return"),
    (lambda: bm.BeamMixture(rate_short_per_m=0.0), "rate_short_per_m must be positive"),
])  # fmt: skip
def test_parameters_outside_their_range_are_refused(make, message):
    with pytest.raises(bm.BadInput, match=message):
        make()
