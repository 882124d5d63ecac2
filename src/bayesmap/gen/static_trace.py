"""The record of one run of a `@gen` function, and how to run it again on what was recorded."""

# ruff: noqa: D102 - the methods are those of the contract, documented with it.

import functools
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.errors import UnknownAddress, show
from bayesmap.gen.generative_function import Trace
from bayesmap.gen.handler import Handler, as_path, running
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.typing import Arguments, Score, StaticAddress


class Replay(Handler):
    """A run whose sites return given values; collects what they were called with."""

    def __init__(self, retvals: dict[StaticAddress, Any]) -> None:
        super().__init__()
        self.retvals = retvals
        self.calls: dict[StaticAddress, Any] = {}

    def run(self, gen_fn: Any, args: Arguments) -> Any:
        """The return value of the body."""
        with running(self):
            return gen_fn.call(args)

    def visit(self, path: StaticAddress, gen_fn: Any, args: Arguments) -> Any:
        if path not in self.retvals:
            raise UnknownAddress(path, "the trace that is edited has no such site")
        self.calls[path] = (gen_fn, args)
        return self.retvals[path]


@dataclass
class StaticTrace(Trace):
    """The calls of one run by address.

    The return value's leaves that some call returned are found there, by `sources`: (address, number of
    the leaf); `computed` holds the others.
    """

    gen_fn: Any
    args: Any
    subtraces: dict[StaticAddress, Trace]
    computed: list[Any]
    retval_tree: Any = static()
    sources: tuple[tuple[StaticAddress, int] | None, ...] = static()

    @staticmethod
    def build(gen_fn: Any, args: Any, retval: Any, subtraces: dict[StaticAddress, Trace]) -> "StaticTrace":
        """Record a run; `subtraces` are in the order of the calls."""
        origin: dict[int, tuple[StaticAddress, int]] = {}
        for path, trace in subtraces.items():
            for k, leaf in enumerate(jax.tree.leaves(trace.get_retval())):
                origin.setdefault(id(leaf), (path, k))
        leaves, tree = jax.tree.flatten(retval)
        sources = tuple(origin.get(id(leaf)) if isinstance(leaf, jax.Array) else None for leaf in leaves)
        computed = [leaf for leaf, source in zip(leaves, sources, strict=True) if source is None]
        return StaticTrace(gen_fn, args, subtraces, computed, tree, sources)

    def get_retval(self) -> Any:
        computed = iter(self.computed)
        returned = {path: jax.tree.leaves(t.get_retval()) for path, t in self.subtraces.items()}
        leaves = [next(computed) if s is None else returned[s[0]][s[1]] for s in self.sources]
        return self.retval_tree.unflatten(leaves)

    def get_score(self) -> Score:
        return sum((t.get_score() for t in self.subtraces.values()), start=jnp.zeros(()))

    def get_choices(self) -> ChoiceMap:
        parts = [t.get_choices().extend(*path) for path, t in self.subtraces.items()]
        return functools.reduce(lambda a, b: a | b, parts, ChoiceMap.empty())

    def get_inner_trace(self, address: Any) -> Trace:
        path = as_path(address)
        if path not in self.subtraces:
            raise UnknownAddress(path, f"its sites are {', '.join(map(show, self.subtraces))}")
        if self.args is None:
            return self.subtraces[path]

        def site_args(trace: StaticTrace) -> Any:
            replay = Replay({p: t.get_retval() for p, t in trace.subtraces.items()})
            replay.run(trace.gen_fn, trace.args)
            return replay.calls[path][1]

        for _ in range(jnp.ndim(self.subtraces[path].get_score())):
            site_args = jax.vmap(site_args)
        return self.subtraces[path].with_args(site_args(self))
