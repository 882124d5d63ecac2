"""The examples of README, CONTRIBUTING and docs/ run, and what they ask of the command line exists."""

import ast
import contextlib
import importlib
import inspect
import os
import re
import subprocess
import sys
import types
from importlib.util import find_spec
from pathlib import Path

import click
import pytest
from data import FOLDER
from examples import PAGES, ROOT, TUTORIAL, Example, python_examples, shell_words

import bayesmap as bm
from bayesmap.cli.group import COMMANDS, cli

LIMIT_S = 1800  # for all examples of a page, which take half a minute on a quiet machine

RUN = """
import json, sys
names = {"__name__": "__main__"}
for line, text in json.load(sys.stdin):
    exec(compile("\\n" * (line - 1) + text, sys.argv[1], "exec"), names)
"""


def name(page):
    return str(page.relative_to(ROOT))


EXAMPLES = {page: python_examples(page.read_text(encoding="utf-8")) for page in PAGES}
README = ROOT / "README.md"
RUNNABLE = [page for page in PAGES if page.parent != TUTORIAL and EXAMPLES[page]]
MARKED = [(page, e) for page in RUNNABLE for e in EXAMPLES[page] if e.needs or e.not_run]
SHELL = [(page, *found) for page in PAGES for found in shell_words(page.read_text(encoding="utf-8"))]


def why_not(example):
    """Return why an example cannot run here; "" if it can."""
    if example.needs.isidentifier():
        return "" if find_spec(example.needs) else f"the module {example.needs} is not installed"
    missing = example.needs and not (FOLDER / example.needs).exists()
    return example.not_run or (f"{FOLDER / example.needs} is not there (set BAYESMAP_DATA)" if missing else "")


def execute(page, examples, folder):
    """Run examples in order in one namespace in a process of its own; tracebacks name the lines of the page."""
    import json

    for example in examples:
        if example.needs and not example.needs.isidentifier():
            (folder / example.needs).symlink_to((FOLDER / example.needs).resolve())
    path = os.pathsep.join([str(ROOT / "src"), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, "-c", RUN, str(page)], input=json.dumps([(e.line, e.text) for e in examples]), cwd=folder,
        env=os.environ | {"PYTHONPATH": path, "MPLBACKEND": "agg"}, capture_output=True, text=True, check=False,
        timeout=LIMIT_S,
    )  # fmt: skip


# The tutorial's pages are made of notebooks, which run in test_tutorial.py; the README runs below. The landing run
# leaves out the page that takes 15 s; what it asks of the library is looked up in any case, see below.
@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, id=name(page), marks=[pytest.mark.full] if page.name == "mapping-model.md" else [])
        for page in RUNNABLE
        if page != README
    ],
)
def test_the_examples_of_a_page_run(page, tmp_path):
    done = execute(page, [e for e in EXAMPLES[page] if not why_not(e)], tmp_path)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(("page", "example"), MARKED, ids=[f"{name(page)}:{e.line}" for page, e in MARKED])
def test_examples_that_cannot_run_here_say_why(page, example):
    compile(example.text, str(page), "exec")
    if reason := why_not(example):
        pytest.skip(reason)


def imported(node):
    """Yield what an import statement gets of bayesmap: the name that it gets here, and the thing or an error."""
    if isinstance(node, ast.Import):
        for one in node.names:
            if one.name.split(".")[0] == "bayesmap":
                yield one.asname or "bayesmap", importlib.import_module(one.name if one.asname else "bayesmap")
    elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "bayesmap":
        module = importlib.import_module(node.module)
        for one in node.names:
            with contextlib.suppress(ModuleNotFoundError):  # no module of its own
                importlib.import_module(f"{node.module}.{one.name}")
            yield one.asname or one.name, getattr(module, one.name, AttributeError(f"{node.module} has no {one.name}"))


def misused(text):
    """Return what some code asks of bayesmap and bayesmap has not: names of its modules, arguments by name."""
    tree, found, known = ast.parse(text), [], {}

    def named(node):
        """The thing that a dotted name stands for; None where that is not known before the code runs."""
        if isinstance(node, ast.Name):
            return known.get(node.id)
        above = named(node.value) if isinstance(node, ast.Attribute) else None
        return getattr(above, node.attr, None) if isinstance(above, types.ModuleType | type) else None

    for node in ast.walk(tree):
        for as_name, thing in imported(node):
            known[as_name] = thing
            if isinstance(thing, AttributeError):
                found.append(f"line {node.lineno}: {thing}")
    for node in ast.walk(tree):
        above = named(node.value) if isinstance(node, ast.Attribute) else None
        if isinstance(above, types.ModuleType) and not hasattr(above, node.attr):
            found.append(f"line {node.lineno}: {above.__name__} has no {node.attr}")
        if isinstance(node, ast.Call) and node.keywords and callable(called := named(node.func)):
            takes = inspect.signature(called).parameters.values()
            if not any(one.kind is one.VAR_KEYWORD for one in takes):
                wrong = {given.arg for given in node.keywords} - {one.name for one in takes} - {None}
                found += [f"line {node.lineno}: {called.__name__} takes no {argument}" for argument in sorted(wrong)]
    return found


def code_of(page):
    """Return the examples of a page in one, each at its line; those that are marked as not run, too."""
    lines = [""] * page.read_text(encoding="utf-8").count("\n")
    for example in EXAMPLES[page]:
        text = example.text.splitlines()
        lines[example.line - 1 : example.line - 1 + len(text)] = text
    return "\n".join(lines)


def test_names_and_arguments_in_examples_exist():
    """The examples of all pages and the notebooks, without running them: what is renamed is noticed at once."""
    sources = {page: code_of(page) for page in PAGES if EXAMPLES[page]}
    sources |= {path: path.read_text(encoding="utf-8") for path in TUTORIAL.glob("*.py")}
    assert [f"{name(path)}, {what}" for path, text in sources.items() for what in misused(text)] == []


@pytest.mark.parametrize(("text", "what"), [
    ("import bayesmap as bm\nbm.infre(1)", ["line 2: bayesmap has no infre"]),
    ("import bayesmap as bm\nbm.infer(1, drawz=3)", ["line 2: infer takes no drawz"]),
    ("from bayesmap import gem", ["line 1: bayesmap has no gem"]),
    ("from bayesmap import gen\ngen.nrmal(0.0, 1.0)", ["line 2: bayesmap.gen has no nrmal"]),
    ("import bayesmap as bm\nbm.Grid.covring(3)\nbm.Grid((3, 3), 0.1, origin=(0, 0))", []),
    ("import bayesmap as bm\nbm.Grid((3, 3), 0.1, orign=(0, 0))", ["line 2: Grid takes no orign"]),
    ("import numpy as np\nnp.arnge(3)\nx.nothing(y=2)", []),
])  # fmt: skip
def test_names_and_arguments_that_do_not_exist_are_noticed(text, what):
    assert misused(text) == what


def test_the_readme_s_examples_run_and_give_what_they_say(tmp_path):
    shapes = Example(1, "assert run.occupancy.shape == (21, 21)\nassert run.draws.shape == (4, 112, 21, 21)\n")
    done = execute(README, [*EXAMPLES[README], shapes], tmp_path)
    assert done.returncode == 0, done.stderr
    assert "the mean map is known to" in done.stdout
    assert bm.load(tmp_path / "run.nc").finished


@pytest.mark.parametrize(("page", "line", "words"), SHELL, ids=[f"{name(p)}:{line}" for p, line, _ in SHELL])
def test_a_line_for_the_shell_can_be_understood(page, line, words):
    if words[0] == "make":
        assert words[1] in re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE)
    else:
        understood(words[1:])


def understood(words):
    """Raise click's error if the command line has no such command, option or value; files need not be there."""
    command = cli.get_command(click.Context(cli), words[0])
    context = click.Context(command, info_name=words[0])
    given, rest, _ = command.make_parser(context).parse_args(list(words[1:]))
    assert rest == [], f"too many arguments: {rest}"
    for parameter in command.params:
        value = given.get(parameter.name)
        if value is not None and not isinstance(parameter.type, click.Path | click.File):
            many = parameter.nargs == -1 and not isinstance(value, list | tuple)
            parameter.type_cast_value(context, (value,) if many else value)


def test_every_command_is_shown_somewhere():
    """The finder of examples finds lines for the shell, and blocks with each kind of mark."""
    shown = {words[1] for _, _, words in SHELL}  # `make demo` is one
    assert set(COMMANDS) - shown == set()
    assert sum(map(len, EXAMPLES.values())) > 100
    assert all(any(getattr(example, mark) for _, example in MARKED) for mark in ("needs", "not_run"))


REFUSED = (
    "infr LOG", "infer LOG --max-rnge 20", "infer LOG --cells glass", "infer LOG --chains none", "infer LOG --holdout",
    "app a.nc b.nc",
)  # fmt: skip


@pytest.mark.parametrize("line", REFUSED)
def test_a_line_that_would_be_refused_is_noticed(line):
    with pytest.raises((click.UsageError, AssertionError)):
        understood(line.split())


@pytest.mark.parametrize(("mark", "below"), [
    *((mark, "```python\nx = 1\n```") for mark in ("example: not run", "example needs a.log", "example: needs")),
    ("example: needs a.log", "Text."),
])  # fmt: skip
def test_a_mark_that_says_nothing_or_stands_above_nothing_is_refused(mark, below):
    with pytest.raises(ValueError, match="line 1"):
        python_examples(f"<!-- {mark} -->\n{below}\n")


def test_a_failing_example_names_the_line_of_its_page(tmp_path):
    page = "# Title\n\n```python\nx = 1\n```\n\n```python\nassert x == 2\n```\n"
    done = execute(Path("page.md"), python_examples(page), tmp_path)
    assert done.returncode != 0
    assert 'File "page.md", line 8' in done.stderr


NAMED = re.compile(r"`((?:src|tests|docs|benchmarks|tools)/[\w./-]+)`")


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_files_and_folders_that_a_page_names_are_there(page):
    assert [path for path in NAMED.findall(page.read_text(encoding="utf-8")) if not (ROOT / path).exists()] == []
