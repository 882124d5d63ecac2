"""Sensor models as they are typed."""

import re

import pytest

from bayesmap import BadInput, BeamMixture, Gaussian, StudentT
from bayesmap.cli.translation import sensor_of


@pytest.mark.parametrize(
    ("text", "model"),
    [
        ("default", None),
        ("gaussian:0.2", Gaussian(0.2)),
        ("gaussian:0.02,sigma_per_m=0.005", Gaussian(0.02, 0.005)),
        ("gaussian:sigma_m=0.1", Gaussian(0.1)),
        ("student-t:0.1,dof=3", StudentT(0.1, 3.0)),
        ("mixture", BeamMixture()),
        ("mixture:0.1,p_random=0.2", BeamMixture(Gaussian(0.1), p_random=0.2)),
        ("mixture:0.1,noise=student-t,dof=2", BeamMixture(StudentT(0.1, 2.0))),
    ],
)
def test_models(text, model):
    assert sensor_of(text) == model


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("laser", "unknown kind 'laser'; known: default, fit (of infer), gaussian"),
        ("gaussian", "gaussian needs its sigma_m, as in gaussian:0.05"),
        ("gaussian:-0.2", "sigma_m must be a positive number of metres, got -0.2"),
        ("gaussian:nan", "sigma_m must be a positive number"),
        ("gaussian:wide", "'wide' is not a number"),
        ("gaussian:0.1,0.2", "write '0.2' as name=value"),
        ("gaussian:0.1,sigma=2", "no parameter 'sigma'"),
        ("mixture:0.1,noise=pink", "noise must be gaussian or student-t"),
        ("mixture:0.1,p_random=2", "p_random must lie inside"),
    ],
)
def test_mistakes_are_named(text, message):
    with pytest.raises(BadInput, match=re.escape(message)):
        sensor_of(text)
