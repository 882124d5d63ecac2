"""The room keeps its rules: small files, imports that point one way, nothing but JAX."""

import ast
import pathlib

import bayesmap.gen

ROOM = pathlib.Path(bayesmap.gen.__file__).parent
FILES = {
    ".".join(path.relative_to(ROOM).with_suffix("").parts): path.read_text()
    for path in ROOM.rglob("*.py")
    if path.stem != "__init__"
}


def imports(text):
    """What a file imports, at its top and in its functions."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom):
            yield node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def test_imports_point_one_way():
    """Every file can be put after all that it imports."""
    needs = {
        name: {m.removeprefix("bayesmap.gen.") for m in imports(text) if m.startswith("bayesmap.gen.")}
        for name, text in FILES.items()
    }
    placed: set[str] = set()
    while len(placed) < len(needs):
        ready = {name for name, below in needs.items() if name not in placed and below <= placed}
        assert ready, f"these import each other: {sorted(set(needs) - placed)}"
        placed |= ready


def test_the_room_knows_jax_and_nothing_else():
    allowed = ("jax", "numpy", "bayesmap.gen", "bayesmap.errors", "treescope")
    standard = {
        "ast",
        "collections",
        "contextlib",
        "contextvars",
        "dataclasses",
        "functools",
        "inspect",
        "importlib",
        "math",
        "operator",
        "threading",
        "types",
        "typing",
        "warnings",
    }
    for name, text in FILES.items():
        for module in imports(text):
            assert module.startswith(allowed) or module.split(".")[0] in standard, (name, module)


def test_every_public_name_has_a_docstring_or_is_a_value():
    for name in bayesmap.gen.__all__:
        value = getattr(bayesmap.gen, name)
        assert not isinstance(value, type) or value.__doc__, name
