"""The example of docs/mapping-model.md runs, and says what the page says."""

import re
from pathlib import Path

import numpy as np
import pytest

PAGE = Path(__file__).resolve().parents[2] / "docs" / "mapping-model.md"


@pytest.mark.full
def test_the_example_runs():
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL))
    names = {}
    exec(compile(code, str(PAGE), "exec"), names)
    model, run = names["model"], names["run"]
    np.testing.assert_allclose(names["score"], run.log_joint[0, -1], rtol=1e-5)
    change = names["edited"].get_score() - names["trace"].get_score()
    np.testing.assert_allclose(names["weight"], change, rtol=1e-3, atol=0.5)  # scores near -1e6, in float32
    moved = names["both"].assess(names["after"].get_choices(), ())[0]
    np.testing.assert_allclose(names["pose_weight"], moved - names["start"].get_score(), rtol=1e-3, atol=0.05)
    assert model.simulate(names["key"], ()).get_choices()["readings"].shape == (100,)
