"""A pytest plugin under which `import genjax` gives `bayesmap.gen`: to run GenJAX's own tests on it.

Every module of GenJAX 0.10.3 that has a counterpart can be imported under its own path, the private ones too, which
public notebooks import. A name is looked for in the counterpart, then in all of `bayesmap.gen`.
"""

import importlib
import operator
import pkgutil
import sys
import types
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import bayesmap.gen
from bayesmap.gen import masks

run_branch = importlib.import_module("bayesmap.gen.switch").run_branch  # `bayesmap.gen.switch` is the combinator

COUNTERPARTS = {
    "gen": (
        ". core core.generative generative_functions generative_functions.combinators "
        "generative_functions.distributions _src _src.core _src.core.compiler _src.core.compiler.interpreters "
        "_src.core.generative _src.generative_functions _src.generative_functions.combinators "
        "_src.generative_functions.distributions _src.generative_functions.distributions.custom"
    ),
    "gen.masks": "checkify _src.checkify _src.core.compiler.staging _src.core.generative.functional_types",
    "gen.diff": "core.compiler incremental _src.core.compiler.interpreters.incremental",
    "gen.pytree": "core.pytree _src.core.pytree",
    "gen.static": "generative_functions.static _src.generative_functions.static",
    "gen.inference": "inference _src.inference",
    "gen.inference.requests": (
        "inference.requests _src.inference.requests _src.inference.requests.hmc _src.inference.requests.rejuvenate"
    ),
    "gen.inference.smc": "inference.smc _src.inference.smc _src.inference.sp",
    "gen.choice_map": "pretty _src.core.generative.choice_map",
    "gen.typing": "typing _src.core.generative.concepts _src.core.typing",
    "gen.edits": "core.requests _src.core.generative.requests",
    "gen.generative_function": "_src.core.generative.generative_function",
    "gen.closure": "_src.generative_functions.combinators.dimap",
    "gen.switch": (
        "_src.generative_functions.combinators.mask _src.generative_functions.combinators.mixture "
        "_src.generative_functions.combinators.or_else _src.generative_functions.combinators.switch"
    ),
    "gen.vmap": "_src.generative_functions.combinators.repeat _src.generative_functions.combinators.vmap",
    "gen.scan": "_src.generative_functions.combinators.scan",
    "gen.distribution": "_src.generative_functions.distributions.distribution",
    "gen.hidden_markov": "_src.generative_functions.distributions.custom.discrete_hmm",
    "gen.densities": "_src.generative_functions.distributions.tensorflow_probability",
}
"""Each module of ours, and the modules of GenJAX 0.10.3 (without `genjax.`) whose names are looked for there first.

Variational inference, ADEV and the interpreters of its compiler are absent: see docs/coming-from-genjax.md."""

MODULES = {f"genjax.{theirs}".rstrip("."): ours for ours, several in COUNTERPARTS.items() for theirs in several.split()}


def _multi_switch(idx: Any, branches: Any, arguments: Any) -> list[Any]:
    """GenJAX's name for running one of several functions, here the part of `switch` that does so."""
    runs = [lambda f=f, args=args: (f(*args), ()) for f, args in zip(branches, arguments, strict=True)]
    return list(run_branch(idx, runs)[0])


def _tree_choose(idx: Any, values: Any) -> Any:
    """GenJAX's name for one of several values, in their common dtype; an index beyond the last goes round."""
    return run_branch(idx % len(values), [lambda value=value: ((), value) for value in values])[1]


def _on_flags(known: Any, traced: Any) -> Any:
    """An operation on flags, whose result is a Python bool if all flags are."""
    return lambda *flags: bool(known(*map(bool, flags))) if all(map(masks.is_known, flags)) else traced(*flags)


INTERNAL = {
    "FlagOp": types.SimpleNamespace(
        and_=masks.flag_and,
        or_=_on_flags(operator.or_, jnp.logical_or),
        xor_=_on_flags(operator.xor, jnp.logical_xor),
        not_=_on_flags(operator.not_, jnp.logical_not),
        where=masks.where_leaves,
    ),
    "multi_switch": _multi_switch,
    "tree_choose": _tree_choose,
}


class Counterpart(types.ModuleType):
    """A module of GenJAX whose names are found in one of ours, or else in whichever defines them."""

    def __init__(self, name: str, ours: str) -> None:
        super().__init__(name)
        self.ours, self.__path__ = importlib.import_module(ours), []
        self.__all__ = getattr(self.ours, "__all__", [name for name in vars(self.ours) if not name.startswith("_")])

    def __getattr__(self, name: str) -> object:
        if name in INTERNAL:
            return INTERNAL[name]
        if name == "Switch" and "Branches" in vars(self.ours):
            return vars(self.ours)["Branches"]
        if name in vars(self.ours):
            return vars(self.ours)[name]
        if not name.startswith("__"):
            every = [info.name for info in pkgutil.walk_packages(bayesmap.gen.__path__, "bayesmap.gen.")]
            for module in [bayesmap.gen, *map(importlib.import_module, every)]:
                names = vars(module)
                if name in names and not isinstance(names[name], types.ModuleType):
                    return names[name]
        raise AttributeError(f"bayesmap.gen has no {name}")


for theirs, ours in sorted(MODULES.items()):
    same = theirs.removeprefix("genjax") == ours.removeprefix("gen")  # public, and ours of the same name
    module = f"bayesmap.{ours}"
    sys.modules[theirs] = importlib.import_module(module) if same else Counterpart(theirs, module)
    parent, _, name = theirs.rpartition(".")
    if parent and name not in vars(sys.modules[parent]):
        setattr(sys.modules[parent], name, sys.modules[theirs])

# pytest reads the numbers of an array by a property that JAX's arrays no longer have.
_approx = pytest.approx
pytest.approx = lambda expected, *args, **options: _approx(np.asarray(expected), *args, **options)
