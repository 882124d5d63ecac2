"""The rooms of the house: which may import which, and what stays outside until it is needed."""

import ast
import json
import re
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path
from statistics import median

import bayesmap

SOURCE = Path(bayesmap.__file__).parent
FILES = sorted(SOURCE.rglob("*.py"))

LEVELS = (
    {"errors", "version"},
    {"files"},
    {"gen", "space"},
    {"sensors"},
    {"beams", "cells"},
    {"kernels"},
    {"sim", "programs", "poses"},
    {"model"},
    {"samplers"},
    {"run"},
    {"posterior"},
    {"io", "viz", "localization"},
    {"result", "worlds"},
    {"arguments"},
    {"api"},
    {"app"},
    {"cli"},
    {"__main__"},
)
LEVEL = {room: level for level, rooms in enumerate(LEVELS) for room in rooms}


@cache
def text(path):
    return path.read_text(encoding="utf-8")


@cache
def parsed(path):
    return ast.parse(text(path))


def room_of(module):
    """bayesmap.kernels.walk -> kernels."""
    parts = module.split(".")
    return parts[1] if len(parts) > 1 else ""


def imports(path):
    """Modules that a file imports, at its top or inside functions, as (line, dotted name); typing's are not run."""
    tree = parsed(path)
    typing_only = {
        id(inner)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
        for inner in ast.walk(node)
    }
    for node in ast.walk(tree):
        if id(node) in typing_only:
            continue
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: a relative import"
            if node.module == "bayesmap":  # `from bayesmap import x` imports bayesmap.x
                yield from ((node.lineno, f"bayesmap.{alias.name}") for alias in node.names)
            else:
                yield node.lineno, node.module


def home(path):
    """The room of a source file; "" for the package's own __init__."""
    parts = path.relative_to(SOURCE).with_suffix("").parts
    return "" if parts == ("__init__",) else parts[0]


def forbidden(here, module):
    there = room_of(module)
    if module.split(".")[0] != "bayesmap" or there in (here, "", "__version__"):
        return None
    public = there not in LEVEL and there in bayesmap.__all__
    if not (public or there in LEVEL):
        return f"{module} is in no room that this test knows"
    target = room_of(bayesmap._MODULES[there]) if public else there
    return None if LEVEL[target] < LEVEL[here] else f"{here} may not import {module}"


def test_imports_point_one_way_and_one_that_points_up_is_noticed():
    """The public face is left out: it reaches everywhere, on first use."""
    offenders = [
        f"{path}:{line}: {reason}"
        for path in FILES
        if home(path)
        for line, module in imports(path)
        if (reason := forbidden(home(path), module))
    ]
    assert not offenders
    assert forbidden("kernels", "bayesmap.samplers.walls") == "kernels may not import bayesmap.samplers.walls"
    assert forbidden("kernels", "bayesmap.infer") == "kernels may not import bayesmap.infer"
    assert forbidden("kernels", "bayesmap.attic") == "bayesmap.attic is in no room that this test knows"
    assert forbidden("samplers", "bayesmap.kernels.walk") is None


FAMILIES: dict[str, tuple[set[str], ...]] = {
    "kernels": ({"kernels"}, {"kernels.match", "kernels.walls"}, {"kernels.surfaces"}, {"kernels.predict"}),
    "io": ({"io.returns"}, {"io.log_reading"}, {"io.text", "io.ros"}, {"io"}),
}
"""Families of a room (folders, or single modules), by level, the lowest first. A family imports lower levels only."""


def level_of_family(module):
    """Return the family of a module (a name without `bayesmap.`) and its level; None in a room that has no families."""
    levels = FAMILIES.get(module.split(".")[0], ())
    parts = module.split(".")
    heads = [".".join(parts[:n]) for n in range(len(parts), 0, -1)]
    found = [(head, level) for head in heads for level, names in enumerate(levels) if head in names]
    return found[0] if found else None


def crosses_families(here, module):
    """Return whether a module imports another family of its room that is not lower."""
    mine, other = level_of_family(here), level_of_family(module)
    same_room = here.split(".")[0] == module.split(".")[0]
    return bool(same_room and mine and other and mine[0] != other[0] and other[1] >= mine[1])


def test_families_of_a_room_import_lower_ones_and_an_import_between_them_is_noticed():
    offenders = [
        f"{name} imports {other}"
        for name, path in MODULES.items()
        for other in imported_modules(parsed(path), MODULES)
        if crosses_families(name.removeprefix("bayesmap."), other.removeprefix("bayesmap."))
    ]
    assert not offenders
    assert crosses_families("kernels.walls.gibbs", "kernels.match.line_pairs")
    assert crosses_families("kernels.walk", "kernels.walls.chains")
    assert not crosses_families("kernels.predict.view", "kernels.surfaces.surface")
    assert crosses_families("io.text.carmen", "io.ros.recording")
    assert crosses_families("io.text.carmen", "io.logs")
    assert crosses_families("io.returns", "io.text.carmen")
    assert not crosses_families("io.logs", "io.ros.log")
    assert not crosses_families("io.ros.log", "io.returns")
    assert not crosses_families("io.ros.log", "io.ros.poses")
    assert not crosses_families("io.ros.log", "space.grid")
    assert {home(path) for path in FILES} - {""} <= set(LEVEL)  # every room and family is known
    for room, levels in FAMILIES.items():
        assert {f"{room}.{path.parent.name}" for path in (SOURCE / room).glob("*/__init__.py")} <= set().union(*levels)


def test_heavy_libraries_have_a_room_each():
    rooms = {"warp": {"kernels"}, "jax": {"gen", "programs"}, "matplotlib": {"viz"}}
    offenders = [
        f"{path}:{line}: only {rooms[library]} imports {library}"
        for path in FILES
        for line, module in imports(path)
        if (library := module.split(".")[0]) in rooms and home(path) not in rooms[library]
    ]
    assert not offenders


def test_the_room_of_programs_knows_jax_and_nothing_else():
    allowed = {"jax", "numpy", "treescope"} | sys.stdlib_module_names
    modules = [module for path in FILES if home(path) == "gen" for _, module in imports(path)]
    assert len(modules) > 100
    ours = ("bayesmap.gen", "bayesmap.errors")
    assert [m for m in modules if not m.startswith(ours) and m.split(".")[0] not in allowed] == []


KINDS_OF_CELLS = {"BinaryWalls", "Independent", "Ising", "Beta", "Surface"}


def asked_for_a_kind(tree):
    """Lines that ask by type which kind of cells there is."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and getattr(node.func, "id", None) in ("isinstance", "issubclass"):
            words = {getattr(inner, "id", getattr(inner, "attr", None)) for inner in ast.walk(node.args[1])}
            if words & KINDS_OF_CELLS:
                yield node.lineno


def test_only_cells_know_which_kinds_of_cells_there_are():
    """Others ask a kind what it has, or take the one that they work with by `CellPrior.of`."""
    assert not [f"{path}:{line}" for path in FILES if home(path) != "cells" for line in asked_for_a_kind(parsed(path))]
    assert list(asked_for_a_kind(ast.parse("import bayesmap as bm\nisinstance(prior, (int, bm.Surface))\n"))) == [2]


MODULES = {".".join(("bayesmap", *path.relative_to(SOURCE).with_suffix("").parts)): path for path in FILES}
MODULES = {name.removesuffix(".__init__"): path for name, path in MODULES.items()}


def imported_modules(tree, modules):
    """The package's modules that a parsed source names in imports: at its top, inside functions, and for types alone.

    The last are not run, but a module whose types name another's cannot be read, or moved, without it. That importing
    `a.b` runs `a/__init__.py`, which may gather names from all its modules, is no import of it.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            inner = [f"{node.module}.{alias.name}" for alias in node.names]
            names = [name if name in modules else node.module for name in inner]
        else:
            continue
        yield from (name for name in names if name in modules)


def circles(graph):
    """Sets of modules each of which leads to all others of its set; the graph leads from a module to its imports."""
    reach = {}
    for start in graph:
        reach[start], waiting = set(), [start]
        while waiting:
            new = set(graph[waiting.pop()]) - reach[start]
            reach[start] |= new
            waiting += new
    together = {frozenset({a, *(b for b in reach[a] if a in reach[b])}) for a in graph if a in reach[a]}
    return sorted(map(set, together), key=sorted)


def test_no_modules_import_one_another_and_circles_are_found():
    graph = {name: set(imported_modules(parsed(path), MODULES)) for name, path in MODULES.items()}
    del graph["bayesmap"]  # the public face reaches everywhere, on first use
    graph = {name: {other for other in others if other in graph} for name, others in graph.items()}
    assert circles(graph) == []
    graph = {"a": {"b"}, "b": {"c"}, "c": {"a", "d"}, "d": {"e"}, "e": {"d"}, "f": {"a"}, "g": {"g"}}
    assert circles(graph) == [{"a", "b", "c"}, {"d", "e"}, {"g"}]
    assert circles({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == []


def test_imports_are_found_wherever_they_stand():
    source = """
import bayesmap.a
from bayesmap import b
from bayesmap.c import name
if TYPE_CHECKING:
    from bayesmap.d import Name
def f():
    from bayesmap.e import name
import numpy
"""
    modules = {"bayesmap", *(f"bayesmap.{letter}" for letter in "abcdef")}
    assert sorted(imported_modules(ast.parse(source), modules)) == [f"bayesmap.{letter}" for letter in "abcde"]


IMPORTED = re.compile(r"""(?:\bfrom|\bimport)\s*\(?\s*"(\.[^"]+)\"""")


def imported_scripts(path, paths):
    """Return the TypeScript files that one imports, for types alone too: `./geometry/bits` is geometry/bits.ts."""
    names = (path.parent / name for name in IMPORTED.findall(text(path)))
    return {found for name in names if (found := Path(f"{name.resolve()}.ts")) in paths}


def test_no_scripts_of_the_page_import_one_another_and_imports_are_found_wherever_they_stand(tmp_path):
    paths = {path.resolve() for path in scripts_of_the_page() if path.suffix == ".ts"}
    graph = {path: imported_scripts(path, paths) for path in paths}
    assert not paths or sum(map(len, graph.values())) > len(paths)
    assert [{path.name for path in circle} for circle in circles(graph)] == []
    (tmp_path / "a.ts").write_text("""import { b } from "./b";
import type {
  C,
} from "./inner/c";
import "./style.css";
export { d } from "./d";
import uplot from "uplot";
const e = await import("./e");
""")
    paths = {tmp_path / name for name in ("a.ts", "b.ts", "inner/c.ts", "d.ts", "e.ts", "f.ts", "style.ts")}
    assert imported_scripts(tmp_path / "a.ts", paths) == {tmp_path / n for n in ("b.ts", "inner/c.ts", "d.ts", "e.ts")}


MOST_LINES = 500
IDLE_NAMES = {"utils", "helpers", "manager", "misc", "common", "util", "helper"}


def scripts_of_the_page():
    folders, endings = (SOURCE, SOURCE.parents[1] / "page"), ("*.js", "*.mjs", "*.ts")
    paths = [path for folder in folders for ending in endings for path in sorted(folder.rglob(ending))]
    return [path for path in paths if "node_modules" not in path.parts]


def faults(path, source):
    """Return what a source file's name and length do wrong; one that is built of others says so in its first line."""
    lines = source.splitlines()
    if len(lines) > MOST_LINES and not lines[0].startswith("// Built by "):
        yield f"{path}: {len(lines)} lines, more than fit one idea"
    if path.stem in IDLE_NAMES:
        yield f"{path}: a name that does not say what the file does"


def test_files_are_short_and_named_for_what_they_do():
    assert [fault for path in [*FILES, *scripts_of_the_page()] for fault in faults(path, text(path))] == []
    line = "let x;\n"
    assert "501 lines" in "".join(faults(Path("a.ts"), 501 * line))
    assert not list(faults(Path("a.ts"), "// Built by `make page` from page/src: edit there.\n" + 501 * line))
    assert not list(faults(Path("a.ts"), 500 * line))
    assert "does not say" in "".join(faults(Path("utils.py"), line))


MOST_FILES, LEAST_MEDIAN = 260, 150
MOST_LINES_OF = {"src": 50_000, "tests": 31_000}  # they only go down; the goal is 50 000 and 31 000


def test_the_house_stays_small(capsys):
    lengths = {
        name: [len(path.read_text().splitlines()) for path in folder.rglob("*.py")]
        for name, folder in {"src": SOURCE, "tests": Path(__file__).parent}.items()
    }
    with capsys.disabled():
        for name, lines in lengths.items():
            print(f"\n{name}: {len(lines)} files, {sum(lines)} lines, median {median(lines):.0f}, most {max(lines)}")
    assert len(lengths["src"]) <= MOST_FILES
    assert median(lengths["src"]) >= LEAST_MEDIAN
    assert {name: sum(lines) for name, lines in lengths.items() if sum(lines) > MOST_LINES_OF[name]} == {}


def test_modules_of_tests_have_names_of_their_own():
    """Pytest imports them by name alone: two of one name end the run while it collects tests."""
    names = Counter(path.name for path in Path(__file__).parent.rglob("test_*.py"))
    assert [name for name, times in names.items() if times > 1] == []


def defined_twice(tree):
    """Names that a module defines a second time at its top: where two modules were joined, one took the other's."""
    seen = set()
    for node in tree.body:
        names = [node.name] if isinstance(node, ast.FunctionDef | ast.ClassDef) else []
        if isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            leaves = [leaf for target in targets for leaf in ast.walk(target)]
            names = [leaf.id for leaf in leaves if isinstance(leaf, ast.Name) and isinstance(leaf.ctx, ast.Store)]
        yield from (name for name in names if name in seen)
        seen.update(names)


def test_no_module_defines_a_name_twice():
    assert [f"{path}: {name}" for path in FILES for name in defined_twice(parsed(path))] == []
    source = "FLOOR, TOP = 1, 2\ndef f():\n    FLOOR = 3\nTOP: int = 4\nclass f:\n    TOP = 5\n"
    assert list(defined_twice(ast.parse(source))) == ["TOP", "f"]


def loaded_after(code):
    """The top-level modules that a fresh interpreter has loaded after running some code."""
    script = f"{code}\nimport sys, json; print(json.dumps(sorted({{name.split('.')[0] for name in sys.modules}})))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return set(json.loads(done.stdout.splitlines()[-1]))


HELP = """
import sys, runpy, io, contextlib
sys.argv = ["bayesmap", "--help"]
out = io.StringIO()
with contextlib.redirect_stdout(out), contextlib.suppress(SystemExit):
    runpy.run_module("bayesmap.cli.main", run_name="__main__")
assert "infer" in out.getvalue()
"""


def test_importing_the_package_and_asking_for_help_load_nothing_heavy():
    heavy = {"jax", "warp", "matplotlib", "scipy", "xarray", "netCDF4", "arviz_base", "arviz_stats", "numpy"}
    assert not loaded_after("import bayesmap") & heavy
    assert not loaded_after(HELP) & {"jax", "warp", "matplotlib"}
    assert "warp" in loaded_after("import bayesmap.kernels.walk")  # power of both tests


def test_modules_that_docstrings_name_are_there():
    """A name in backquotes is a module, or something in one: `bayesmap.space.grid`, `bayesmap.space.grid.Grid`."""
    modules = {".".join(path.relative_to(SOURCE).with_suffix("").parts) for path in FILES}
    folders = {name.removesuffix(".__init__") for name in modules if name.endswith(".__init__")} - {"gen", "viz"}
    stale = []
    for path in FILES:
        for name in re.findall(r"`bayesmap\.([\w.]*\w)`", text(path)):
            parts = name.split(".")
            rooms = [".".join(parts[:n]) for n in range(1, len(parts) + 1)]
            if rooms[0] in folders and len(parts) > 1 and not modules.intersection(rooms):
                stale.append(f"{path.relative_to(SOURCE)}: {name}")
    assert stale == []
