"""The tutorial: its notebooks run with all their checks, and its pages are made of them."""

import ast
import base64
import importlib
import re
import zlib

import pytest
from examples import TUTORIAL, script

from bayesmap.app.protocol.wire import decode_frame

FIGURES = TUTORIAL / "figures"
render = script(TUTORIAL / "render.py")
every_page = pytest.mark.parametrize("name", render.PAGES)
OFTEN = ("mapping", "odometry")  # in the landing run; the others take half a minute or more each


def source_of(name):
    return (TUTORIAL / f"{name}.py").read_text(encoding="utf-8")


def page_of(name):
    return (TUTORIAL / f"{name}.md").read_text(encoding="utf-8")


def figures_of(name):
    return re.findall(r"!\[[^]]*\]\(figures/([^)]+)\)", page_of(name))


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.xdist_group(name), *([] if name in OFTEN else [pytest.mark.full])])
        for name in render.PAGES
    ],
)
def test_a_notebook_runs_and_draws_the_figures_of_its_page(name, tmp_path, monkeypatch, capsys):
    """Its cells assert what its prose says."""
    monkeypatch.syspath_prepend(TUTORIAL)
    monkeypatch.setattr(importlib.import_module("drawing"), "FIGURES", tmp_path)
    render.execute(source_of(name), TUTORIAL / f"{name}.py")
    assert capsys.readouterr() == ("", "")
    assert {path.name for path in tmp_path.glob("*.png")} == set(figures_of(name))


@every_page
def test_a_page_is_made_of_its_notebook(name):
    """A change of a notebook needs `python docs/tutorial/render.py`."""
    cells, page = render.cells(source_of(name)), page_of(name)
    blocks = re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    assert [block.rstrip("\n") for block in blocks] == [cell.text for cell in cells if cell.is_code]
    assert [cell.text for cell in cells if not cell.is_code and cell.text not in page] == []
    in_prose = sum(cell.text.count("<details>") for cell in cells if not cell.is_code)
    assert page.count("<details>") == page.count("</details>") == in_prose + sum(bool(cell.folded) for cell in cells)


@every_page
def test_checks_and_figures_of_a_page_are_folded(name):
    """The code that a reader sees first draws no figure."""
    shown = [cell.text for cell in render.cells(source_of(name)) if cell.is_code and not cell.folded]
    assert [text for text in shown if re.search(r"\b(panels|show)\(", text)] == []


def test_the_figures_are_those_of_the_pages():
    named = [figure for name in render.PAGES for figure in figures_of(name)]
    assert len(named) == len(set(named)) > 15
    assert {path.name for path in FIGURES.iterdir()} == set(named)


def test_the_first_page_leads_to_all_others():
    contents = (TUTORIAL / "README.md").read_text(encoding="utf-8")
    assert re.findall(r"^\d\. \[[^]]+\]\((\w+)\.md\)", contents, re.MULTILINE) == list(render.PAGES)
    for path in TUTORIAL.glob("*.py"):
        assert path.stem in (*render.PAGES, "render", "drawing", "interactive")


def definitions(source):
    """Functions by name, as syntax trees without positions; `step` and the like, inside others, are not looked at."""
    return {node.name: ast.dump(node) for node in ast.parse(source).body if isinstance(node, ast.FunctionDef)}


def test_functions_that_two_pages_define_are_equal():
    """The second page says so of the model that it repeats."""
    first, second = definitions(source_of("mapping")), definitions(source_of("gibbs"))
    assert {"walls_prior", "distances_to_cells", "exact_range", "beam", "full_model"} <= first.keys() & second.keys()
    assert [name for name in first.keys() & second.keys() if first[name] != second[name]] == []


def prose_of(name):
    return "\n\n".join(cell.text for cell in render.cells(source_of(name)) if not cell.is_code)


@every_page
def test_a_page_begins_with_its_aims_and_a_reading_time(name):
    """The time is that of 130 words and 15 lines of shown code a minute, and the first page of all names it, too."""
    head = prose_of(name).split("\n## ")[0]
    aims = re.search(r"\n\n\*\*After this page you will be able to\*\*\n\n(.*?)\n\n", head, re.DOTALL)[1]
    assert 2 <= len(re.findall(r"^- ", aims, re.MULTILINE)) <= 4
    shown = [cell.text for cell in render.cells(source_of(name)) if cell.is_code and not cell.folded]
    estimate = len(prose_of(name).split()) / 130 + sum(text.count("\n") + 1 for text in shown) / 15
    minutes = int(re.search(r"\n\nReading time: about (\d+) minutes", head)[1])
    assert abs(minutes - estimate) < 5
    contents = (TUTORIAL / "README.md").read_text(encoding="utf-8")
    assert re.search(rf"\({name}\.md\)[^\]]* {minutes}\s+minutes\.", contents)


@every_page
def test_a_page_ends_with_exercises_whose_answers_are_folded_and_checked(name):
    exercises = page_of(name).split("\n## Exercises\n")[1]
    n = len(re.findall(r"^\*\*\d\.\*\* ", exercises, re.MULTILINE))
    answers = re.findall(r"^<details><summary>Answer (\d)</summary>", exercises, re.MULTILINE)
    assert 2 <= n <= 3
    assert answers == [str(k) for k in range(1, n + 1)]
    code = [cell.text for cell in render.cells(source_of(name)) if cell.whole]
    assert code
    assert [text for text in code if not re.search(r"^    assert|^assert", text, re.MULTILINE)] == []


@every_page
def test_no_sentence_begins_with_of_or_what(name):
    captions = re.findall(r"^\*([^*\n]+)\*$", page_of(name), re.MULTILINE)
    texts = [" ".join(part.split()) for part in (*prose_of(name).split("\n\n"), *captions)]
    assert [text for text in texts if re.search(r"(^|[.:;?!] |[#*] )(Of|What)\b", text)] == []


def test_the_first_page_has_the_beam_and_its_likelihood_before_jax():
    before, jax, _ = source_of("mapping").partition("import jax\n")
    assert jax
    assert {"walked_range_m", "log_likelihood"} <= definitions(before).keys()
    assert not re.search(r"\b(jnp|jrand|vmap|gen)\.", before)


def test_measured_times_are_rounded():
    assert render.rounded("time: 123 sweeps, 0.0024 s, 8 ms") == "time: 100 sweeps, 0.002 s, 10 ms"
    assert render.rounded("time: 93456.7 sweeps") == "time: 100,000 sweeps"
    assert render.rounded("123 sweeps") == "123 sweeps"


def test_a_page_has_its_cells_in_order_and_folds_those_that_say_so(tmp_path):
    source = (
        "# %% [markdown]\n# One\n#\n# two\n\n# %%\na = 3\nprint(a)\n\n"
        '# %% A check tags=["hide-input"]\nprint(a + 1)\nprint("figure: f.png: F")\n'
    )
    outputs = render.execute(source, tmp_path / "n.py")
    assert outputs == ["3\n", "4\nfigure: f.png: F\n"]
    page = render.page("n", source, outputs)
    assert "One\n\ntwo\n\n```python\na = 3\nprint(a)\n```\n\n```text\n3\n```" in page
    assert "<details><summary>A check</summary>\n\n```python\nprint(a + 1)" in page
    assert page.endswith("</details>\n\n```text\n4\n```\n\n![F](figures/f.png)\n\n*F*\n")
    answer = render.page("n", '# %% Answer tags=["hide-cell"]\nprint(1)\n', ["1\n"])
    assert answer.endswith("<summary>Answer</summary>\n\n```python\nprint(1)\n```\n\n```text\n1\n```\n\n</details>\n")


def recording(html):
    packed = base64.b64decode(re.search(r"data-recording>(.*?)</script>", html, re.DOTALL)[1])
    header, buffers = decode_frame(zlib.decompress(packed, -15))
    header["field"]["seconds"] = None  # differs from time to time
    return header, {name: values.tolist() for name, values in buffers.items()}


def test_the_interactive_page_is_made_by_its_script():
    """Only the recording is compared: the page carries the viewer that it was made with, and stays usable with it."""
    html = (TUTORIAL / "interactive.html").read_text(encoding="utf-8")
    assert recording(html) == recording(script(TUTORIAL / "interactive.py").interactive_page().decode())
    draws = recording(html)[0]["draws"]
    assert draws["chains"] * draws["count"] == 1000
