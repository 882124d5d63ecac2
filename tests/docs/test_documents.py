"""The documents: their links lead somewhere, and the sensor model of CONTRIBUTING infers."""

import re

import numpy as np
from examples import PAGES, ROOT, python_examples

import bayesmap as bm


def prose_of(document):
    """The text of a document without its blocks of code, where `f[k](x)` is no link."""
    return re.sub(r"^```.*?^```", "", document.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)


def test_links_between_documents_lead_somewhere():
    links = [
        (document, target)
        for document in PAGES
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", prose_of(document))
        if "://" not in target
    ]
    broken = [f"{d.relative_to(ROOT)}: {target}" for d, target in links if not (d.parent / target).exists()]
    assert broken == []


def test_no_page_has_a_place_that_somebody_meant_to_fill():
    found = [
        f"{page.relative_to(ROOT)}: {word}"
        for page in PAGES
        for word in re.findall(r"\b(?:FIGURES?|TODO|TBD|FIXME|XXX+)\b", page.read_text(encoding="utf-8"))
    ]
    assert found == []


def test_the_sensor_model_of_contributing_infers_what_enumeration_does():
    """The example says: three methods, and every sampler, score and simulation works."""
    page = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    (example,) = (example for example in python_examples(page) if "class Sonar" in example.text)
    names = {"__name__": __name__}
    exec(example.text, names)
    sonar = names["Sonar"](0.3)
    grid = bm.Grid(shape=(4, 4), resolution=1.0)
    walls = np.zeros((4, 4), bool)
    walls[3, :] = True
    angles = np.linspace(-np.pi, np.pi, 24, endpoint=False)
    scans = bm.simulate(walls, grid, (1.5, 1.5, 0.0), angles, sensor=sonar, max_range_m=6.0, seed=1)
    problem = {"scans": scans, "grid": grid, "prior": bm.Independent(0.3), "sensor": sonar}
    exact = bm.infer(**problem, method="exact", schedule=bm.Schedule(draws=1))
    block_gibbs = bm.infer(**problem, method="block", schedule=bm.Schedule(draws=5_000))
    np.testing.assert_allclose(block_gibbs.occupancy, exact.occupancy, atol=0.03)
    assert np.isfinite(block_gibbs.log_score(scans))
