"""A pytest plugin under which `import genjax` gives `bayesmap.gen`: to run GenJAX's own tests on it.

GenJAX's public modules are ours of the same name, and those of its private ones that its tests import are ours with
the same contents, named below. What its tests ask of no particular module is looked up in all of ours.
"""

import importlib
import pkgutil
import sys
import types
from typing import Any

import numpy as np
import pytest

import bayesmap.gen
from bayesmap.gen import flags

run_branch = importlib.import_module("bayesmap.gen.switch").run_branch  # `bayesmap.gen.switch` is the combinator

PUBLIC = {
    "genjax": "bayesmap.gen",
    "genjax.typing": "bayesmap.gen.typing",
    "genjax.inference": "bayesmap.gen.inference",
    "genjax.inference.smc": "bayesmap.gen.inference.smc",
    "genjax.inference.requests": "bayesmap.gen.inference.requests",
}
PRIVATE = {
    "genjax.generative_functions": None,
    "genjax.generative_functions.static": "bayesmap.gen.static",
    "genjax._src": None,
    "genjax._src.checkify": "bayesmap.gen.flags",
    "genjax._src.core": None,
    "genjax._src.core.compiler": None,
    "genjax._src.core.compiler.interpreters": None,
    "genjax._src.core.compiler.interpreters.incremental": "bayesmap.gen.diff",
    "genjax._src.core.compiler.staging": None,
    "genjax._src.core.generative": None,
    "genjax._src.core.generative.choice_map": "bayesmap.gen.choice_map",
    "genjax._src.core.generative.functional_types": "bayesmap.gen.mask",
    "genjax._src.core.typing": "bayesmap.gen.typing",
    "genjax._src.generative_functions": None,
    "genjax._src.generative_functions.combinators": None,
    "genjax._src.generative_functions.combinators.vmap": "bayesmap.gen.vmap",
    "genjax._src.generative_functions.static": "bayesmap.gen.static",
    "genjax._src.inference": None,
    "genjax._src.inference.sp": "bayesmap.gen.inference.target",
}


def _multi_switch(idx: Any, branches: Any, arguments: Any) -> list[Any]:
    """GenJAX's name for running one of several functions, here the part of `switch` that does so."""
    runs = [lambda f=f, args=args: (f(*args), ()) for f, args in zip(branches, arguments, strict=True)]
    return list(run_branch(idx, runs)[0])


def _tree_choose(idx: Any, values: Any) -> Any:
    """GenJAX's name for one of several values, in their common dtype; an index beyond the last goes round."""
    return run_branch(idx % len(values), [lambda value=value: ((), value) for value in values])[1]


INTERNAL = {
    "FlagOp": types.SimpleNamespace(
        and_=flags.both, or_=flags.either, xor_=flags.exactly_one, not_=flags.negation, where=flags.where
    ),
    "multi_switch": _multi_switch,
    "tree_choose": _tree_choose,
}


class Elsewhere(types.ModuleType):
    """A module whose names are found in one of ours, or else in whichever defines them."""

    def __init__(self, name: str, first: str | None = None) -> None:
        super().__init__(name)
        self.first, self.__path__ = first, []

    def __getattr__(self, name: str) -> object:
        if name in INTERNAL:
            return INTERNAL[name]
        if not name.startswith("__"):
            every = [info.name for info in pkgutil.walk_packages(bayesmap.gen.__path__, "bayesmap.gen.")]
            for ours in [*filter(None, [self.first]), *every]:
                names = vars(importlib.import_module(ours))
                if name in names and not isinstance(names[name], types.ModuleType):
                    return names[name]
        raise AttributeError(f"bayesmap.gen has no {name}")


sys.modules.update({theirs: importlib.import_module(ours) for theirs, ours in PUBLIC.items()})
sys.modules.update({theirs: Elsewhere(theirs, ours) for theirs, ours in PRIVATE.items()})

# pytest reads the numbers of an array by a property that JAX's arrays no longer have.
_approx = pytest.approx
pytest.approx = lambda expected, *args, **options: _approx(np.asarray(expected), *args, **options)
