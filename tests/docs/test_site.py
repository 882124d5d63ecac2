"""Pages and site: links lead somewhere, every public name has its place, and nothing is loaded from the internet."""

import re
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
from examples import PAGES, ROOT, python_examples, script

import bayesmap as bm
from bayesmap import gen

SOURCE = ROOT / "src" / "bayesmap"
TEXTS = {page: page.read_text(encoding="utf-8") for page in PAGES}
REFERENCE = [text for page, text in TEXTS.items() if page.parent.name == "reference"]
NAMED = re.findall(r"^::: (\S+)$", "\n".join(REFERENCE), re.MULTILINE)
ARCHITECTURE = TEXTS[ROOT / "docs" / "architecture.md"]


def test_links_between_documents_lead_somewhere_and_no_page_has_a_place_that_somebody_meant_to_fill():
    wrong = []
    for page, text in TEXTS.items():
        prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)  # in code `f[k](x)` is no link
        links = [target for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", prose) if "://" not in target]
        wrong += [(page, target) for target in links if not (page.parent / target).exists()]
        wrong += [(page, word) for word in re.findall(r"\b(?:FIGURES?|TODO|TBD|FIXME|XXX+)\b", text)]
    assert wrong == []


def test_the_sensor_model_of_contributing_infers_what_enumeration_does():
    """The example says: three methods, and every sampler, score and simulation works."""
    page = python_examples(TEXTS[ROOT / "CONTRIBUTING.md"])
    (example,) = (example for example in page if "class Sonar" in example.text)
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
    block_gibbs = bm.infer(**problem, method="block", schedule=bm.Schedule(draws=2_000))
    np.testing.assert_allclose(block_gibbs.occupancy, exact.occupancy, atol=0.03)
    assert np.isfinite(block_gibbs.log_score(scans))


@pytest.fixture(scope="module")
def picture():
    return script(ROOT / "docs" / "architecture.py")


def test_the_picture_is_up_to_date(picture):
    """A change of the steps needs `python docs/architecture.py`."""
    assert picture.PICTURE.read_text(encoding="utf-8") == picture.svg()


def test_files_and_folders_of_the_picture_and_of_its_page_are_there(picture):
    drawn = {path for step in picture.STEPS for path in (*step.where, *step.beside) if path.endswith((".py", "/"))}
    told = {path for path in re.findall(r"`([\w/]+(?:\.py|/))`", ARCHITECTURE) if not path.startswith("tests/")}
    assert len(drawn) > 15
    assert len(told) > 20
    assert sorted(path for path in drawn | told if not (SOURCE / path).exists()) == []


def test_every_room_is_in_the_page():
    rooms = {path.name for path in SOURCE.iterdir() if path.is_dir() and not path.name.startswith("_")}
    table = ARCHITECTURE[ARCHITECTURE.index("## The rooms") :]
    assert sorted(room for room in rooms if f"`{room}/`" not in table) == []


def test_a_step_fits_its_box_and_nothing_is_loaded(picture):
    assert {element.tag.rpartition("}")[2] for element in ElementTree.fromstring(picture.svg()).iter()} == {
        "svg", "title", "defs", "marker", "path", "rect", "text",
    }  # fmt: skip
    for step in picture.STEPS:
        for lines, (_, width) in zip((step.is_, step.does, step.beside), picture.COLUMNS, strict=True):
            assert len(lines) <= 4
            assert max(map(len, lines)) * 7.5 < width - 12  # a letter's mean width in pixels


@pytest.fixture(scope="module")
def site():
    pytest.importorskip("mkdocs", reason="the extra docs is not installed")
    return script(ROOT / "docs" / "site.py")


def test_every_public_name_is_in_the_reference_once_and_nothing_else():
    """A new name needs a line `::: bayesmap.NAME` on the page of docs/reference/ where one would look for it."""
    public = [f"bayesmap.{name}" for name in bm.__all__ if name != "__version__"]
    public += [f"bayesmap.gen.{name}" for name in gen.__all__]
    assert sorted(set(public) - set(NAMED)) == []
    assert len(NAMED) == len(set(NAMED))
    assert {name for name in NAMED if not name.startswith("bayesmap.gen.")} <= {f"bayesmap.{n}" for n in bm.__all__}


def test_every_page_is_in_the_contents():
    """A new page needs a line in mkdocs.yml."""
    contents = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    pages = [str(page.relative_to(ROOT / "docs")) for page in PAGES if (ROOT / "docs") in page.parents]
    assert [page for page in pages if not re.search(rf"[ :]{re.escape(page)}$", contents, re.MULTILINE)] == []


def test_links_of_the_readme_are_turned(site):
    assert site.site_links("[a](docs/app.md), [b](CONTRIBUTING.md)") == "[a](app.md), [b](contributing.md)"
    assert site.site_links("![c](docs/images/app.webp) [d](docs/tutorial)") == (
        "![c](images/app.webp) [d](tutorial/README.md)"
    )


LOADED = (
    '<script src="https://unpkg.com/x.js"></script>', '<link rel="stylesheet" href="https://fonts.googleapis.com/css">',
    "<img alt=a src=//host/a.png>", '<iframe src="http://host/">', "a { background: url('https://host/a.png') }",
    '@import "https://host/a.css";',
)  # fmt: skip
NOT_LOADED = (
    '<a href="https://www.ros.org/reps/rep-0117.html">REP-117</a>', '<link rel="canonical" href="https://host/">',
    '<script src="../assets/a.js"></script>', "a { background: url(data:image/png;base64,xx) }",
)  # fmt: skip


def test_elements_that_load_from_elsewhere_are_found(site):
    assert [len(site.loaded_from_elsewhere(text)) for text in LOADED] == [1] * len(LOADED)
    assert [site.loaded_from_elsewhere(text) for text in NOT_LOADED] == [[]] * len(NOT_LOADED)


def test_steps_of_the_story_stand_in_place_of_pictures(site):
    assert "data-figure>" in site.story()
    for (name, picture), step in site.STEPS.items():
        text = (ROOT / ("README.md" if name == "index.md" else f"docs/{name}")).read_text(encoding="utf-8")
        shown = site.on_page_markdown(text, page=SimpleNamespace(file=SimpleNamespace(src_uri=name)))
        assert shown.count(f'src="{"../" if "/" in name else ""}story.html#step={step}"') == 1
        assert "\n## Install\n" in shown if picture is None else f"figures/{picture}" not in shown


def test_the_tutorial_shows_the_live_page(site):
    page = (ROOT / "docs" / "tutorial" / re.search(r'src="([^"]+)"', site.FRAME)[1]).read_text(encoding="utf-8")
    assert "data-recording" in page
    assert site.loaded_from_elsewhere(page) == []
