"""The site: its reference has every public name, and its pages load nothing from the internet."""

import importlib.util
import re
from pathlib import Path

import pytest

import bayesmap as bm
from bayesmap import gen

ROOT = Path(__file__).parents[2]
PAGES = {path: path.read_text(encoding="utf-8") for path in (ROOT / "docs" / "reference").glob("*.md")}
NAMED = re.findall(r"^::: (\S+)$", "\n".join(PAGES.values()), re.MULTILINE)


@pytest.fixture(scope="module")
def site():
    pytest.importorskip("mkdocs", reason="the extra docs is not installed")
    spec = importlib.util.spec_from_file_location("site_hooks", ROOT / "docs" / "site.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_public_name_is_in_the_reference():
    """A new name needs a line `::: bayesmap.NAME` on the page of docs/reference/ where one would look for it."""
    public = [f"bayesmap.{name}" for name in bm.__all__ if name != "__version__"]
    public += [f"bayesmap.gen.{name}" for name in gen.__all__]
    assert sorted(set(public) - set(NAMED)) == []


def test_the_reference_names_nothing_twice_and_nothing_else():
    assert len(NAMED) == len(set(NAMED))
    assert {name for name in NAMED if not name.startswith("bayesmap.gen.")} <= {f"bayesmap.{n}" for n in bm.__all__}


def test_every_page_is_in_the_contents():
    """A new page needs a line in mkdocs.yml."""
    contents = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    pages = [str(path.relative_to(ROOT / "docs")) for path in (ROOT / "docs").rglob("*.md")]
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


def test_what_a_page_loads_from_elsewhere_is_found(site):
    assert [len(site.loaded_from_elsewhere(text)) for text in LOADED] == [1] * len(LOADED)
    assert [site.loaded_from_elsewhere(text) for text in NOT_LOADED] == [[]] * len(NOT_LOADED)


def test_the_tutorial_shows_the_live_page(site):
    name = re.search(r'src="([^"]+)"', site.FRAME)[1]
    page = (ROOT / "docs" / "tutorial" / name).read_text(encoding="utf-8")
    assert "data-recording" in page
    assert site.loaded_from_elsewhere(page) == []
