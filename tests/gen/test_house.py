"""The room knows JAX and nothing else; tests/test_architecture.py checks that its imports have no circles."""

import ast
import sys
from pathlib import Path

import bayesmap.gen

ALLOWED = {"jax", "numpy", "treescope"} | sys.stdlib_module_names
FILES = list(Path(bayesmap.gen.__file__).parent.rglob("*.py"))


def imports(text):
    """Yield the modules that a file imports, at its top and in its functions."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom):
            yield node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def test_the_room_knows_jax_and_nothing_else():
    assert len(FILES) > 20
    for file in FILES:
        for module in imports(file.read_text()):
            ours = module.startswith(("bayesmap.gen", "bayesmap.errors"))
            assert ours or module.split(".")[0] in ALLOWED, (file, module)
