"""Combinators as methods: `model.vmap(in_axes=0)`.

Combinators are made of generative functions, so `GenerativeFunction` cannot name them. Each offers itself here
instead, when its own file is imported, and the methods look it up.
"""

from collections.abc import Callable
from typing import Any, TypeVar

_OFFERED: dict[str, Callable[..., Any]] = {}

F = TypeVar("F", bound=Callable[..., Any])


def method(combinator: F) -> F:
    """Offer `combinator(m, *others)` as `m.combinator(*others)`."""
    _OFFERED[combinator.__name__] = combinator
    return combinator


def decorator_method(combinator: F) -> F:
    """Offer `combinator(**options)(m)` as `m.combinator(**options)`."""
    _OFFERED[combinator.__name__] = lambda m, *args, **options: combinator(*args, **options)(m)
    return combinator


def _lookup(name: str) -> Callable[..., Any]:
    def call(self: Any, *args: Any, **options: Any) -> Any:
        return _OFFERED[name](self, *args, **options)

    call.__name__, call.__doc__ = name, f"See `bayesmap.gen.{name}`."
    return call


class Fluent:
    """The methods that build larger generative functions."""

    vmap, repeat, scan = _lookup("vmap"), _lookup("repeat"), _lookup("scan")
    iterate, iterate_final = _lookup("iterate"), _lookup("iterate_final")
    masked_iterate, masked_iterate_final = _lookup("masked_iterate"), _lookup("masked_iterate_final")
    accumulate, reduce = _lookup("accumulate"), _lookup("reduce")
    dimap, map, contramap = _lookup("dimap"), _lookup("map"), _lookup("contramap")
    mask, or_else, switch, mix = _lookup("mask"), _lookup("or_else"), _lookup("switch"), _lookup("mix")
    marginal = _lookup("marginal")

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """The function applied to arguments: trace it with `@ "address"`, draw from it with `(key)`."""
        return _OFFERED["apply"](self, args, kwargs)
