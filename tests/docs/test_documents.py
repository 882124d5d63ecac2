"""The documents: their links lead somewhere, their examples compile, and those of README and CONTRIBUTING run."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import laplace

import bayesmap as bm
from bayesmap.sensors.model import SensorModel

ROOT = Path(__file__).parents[2]
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def python_blocks(document):
    return re.findall(r"^```python\n(.*?)^```$", document.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_links_between_documents_lead_somewhere():
    links = [
        (document, target)
        for document in DOCUMENTS
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", document.read_text(encoding="utf-8"))
        if "://" not in target
    ]
    broken = [f"{d.relative_to(ROOT)}: {target}" for d, target in links if not (d.parent / target).exists()]
    assert broken == []


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_python_examples_compile(document):
    for number, block in enumerate(python_blocks(document)):
        compile(block, f"{document.name}, example {number + 1}", "exec")


def test_the_readme_example_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in python_blocks(ROOT / "README.md"):
        exec(block, names)
    assert names["run"].occupancy.shape == (21, 21)
    assert names["run"].draws.shape == (4, 1000, 21, 21)
    assert "rhat" in capsys.readouterr().out
    assert bm.load(tmp_path / "run.nc").finished


def test_the_sensor_model_of_contributing_infers_what_enumeration_does():
    """The example says: three methods, and every sampler, score and simulation works."""
    (block,) = (text for text in python_blocks(ROOT / "CONTRIBUTING.md") if "class Sonar" in text)
    names = {"dataclass": dataclass, "np": np, "laplace": laplace, "SensorModel": SensorModel, "__name__": __name__}
    exec(block, names)
    sonar = names["Sonar"](0.3)
    grid = bm.Grid(shape=(4, 4), resolution=1.0)
    walls = np.zeros((4, 4), bool)
    walls[3, :] = True
    angles = np.linspace(-np.pi, np.pi, 24, endpoint=False)
    scans = bm.simulate(walls, grid, (1.5, 1.5, 0.0), angles, sensor=sonar, max_range_m=6.0, seed=1)
    problem = {"scans": scans, "grid": grid, "prior": bm.Independent(0.3), "sensor": sonar}
    exact = bm.infer(**problem, method="exact", draws=1)
    block_gibbs = bm.infer(**problem, method="block", draws=5_000)
    np.testing.assert_allclose(block_gibbs.occupancy, exact.occupancy, atol=0.03)
    assert np.isfinite(block_gibbs.log_score(scans))
