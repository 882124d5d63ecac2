"""The documentation runs: the tutorial with all its assertions, and the examples of README and CONTRIBUTING."""

import importlib.util
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import laplace

import bayesmap as bm
from bayesmap.sensors.model import SensorModel

ROOT = Path(__file__).parents[2]
TUTORIAL = ROOT / "docs" / "tutorial"
PAGE = TUTORIAL / "README.md"
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def python_blocks(document):
    return re.findall(r"^```python\n(.*?)^```$", document.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def figures(page):
    return re.findall(r"!\[[^]]*\]\(figures/([^)]+)\)", page)


@pytest.fixture(scope="module")
def render():
    spec = importlib.util.spec_from_file_location("tutorial_render", TUTORIAL / "render.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_tutorial_runs_and_draws_the_figures_of_its_page(tmp_path):
    """Its cells assert what its prose says."""
    environment = os.environ | {
        "BAYESMAP_TUTORIAL_FIGURES": str(tmp_path),
        "PYTHONPATH": os.pathsep.join([str(ROOT / "src"), os.environ.get("PYTHONPATH", "")]),
    }
    command = [sys.executable, str(TUTORIAL / "tutorial.py")]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    drawn = {path.name for path in tmp_path.glob("*.png")}
    assert drawn == set(figures(PAGE.read_text(encoding="utf-8")))


def test_the_page_is_made_of_the_notebook(render):
    """A change of the notebook needs `python docs/tutorial/render.py`."""
    cells = render.cells((TUTORIAL / "tutorial.py").read_text(encoding="utf-8"))
    assert [block.rstrip("\n") for block in python_blocks(PAGE)] == [cell.text for cell in cells if cell.is_code]
    page = PAGE.read_text(encoding="utf-8")
    assert [cell.text for cell in cells if not cell.is_code and cell.text not in page] == []


def test_the_page_names_figures_that_exist():
    names = figures(PAGE.read_text(encoding="utf-8"))
    assert len(names) > 10
    assert [name for name in names if not (TUTORIAL / "figures" / name).is_file()] == []
    assert {path.name for path in (TUTORIAL / "figures").iterdir()} == set(names)


def test_links_between_documents_lead_somewhere():
    links = [
        (document, target)
        for document in DOCUMENTS
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", document.read_text(encoding="utf-8"))
        if "://" not in target
    ]
    broken = [f"{d.relative_to(ROOT)}: {target}" for d, target in links if not (d.parent / target).exists()]
    assert broken == []


def test_times_are_masked(render):
    assert render.masked("time: 123 sweeps, 0.002 s") == "time: 10^2 sweeps, 10^-3 s"
    assert render.masked("123 sweeps") == "123 sweeps"


def test_rendering_executes_in_order_and_places_figures(render):
    source = (
        '# %% [markdown]\n# One\n#\n# two\n\n# %%\na = 3\nprint(a)\n\n# %%\nprint(a + 1)\nprint("figure: f.png: F")\n'
    )
    outputs = render.execute(source)
    assert outputs == ["3\n", "4\nfigure: f.png: F\n"]
    page = render.page(source, outputs)
    assert "One\n\ntwo\n\n```python\na = 3\nprint(a)\n```\n\n```text\n3\n```" in page
    assert page.endswith("```text\n4\n```\n\n![F](figures/f.png)\n\n*F*\n")


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
