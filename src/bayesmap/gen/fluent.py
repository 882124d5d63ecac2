"""Combinators as methods, `model.vmap(in_axes=0)`: looked up when they are called."""

import importlib
from collections.abc import Callable
from typing import Any


def _decorator(name: str) -> Callable[..., Any]:
    """A method `m.name(**options)` that is `name(**options)(m)`."""

    def method(self: Any, *args: Any, **options: Any) -> Any:
        self.check_open(name)
        return getattr(importlib.import_module("bayesmap.gen"), name)(*args, **options)(self)

    method.__name__, method.__doc__ = name, f"See `bayesmap.gen.{name}`."
    return method


def _function(name: str) -> Callable[..., Any]:
    """A method `m.name(*others)` that is `name(m, *others)`."""

    def method(self: Any, *others: Any) -> Any:
        self.check_open(name)
        return getattr(importlib.import_module("bayesmap.gen"), name)(self, *others)

    method.__name__, method.__doc__ = name, f"See `bayesmap.gen.{name}`."
    return method


class Fluent:
    """The methods that build larger generative functions."""

    vmap, repeat, scan = _decorator("vmap"), _decorator("repeat"), _decorator("scan")
    iterate, iterate_final = _decorator("iterate"), _decorator("iterate_final")
    accumulate, reduce = _decorator("accumulate"), _decorator("reduce")
    dimap, map, contramap = _decorator("dimap"), _decorator("map"), _decorator("contramap")
    marginal = _decorator("marginal")
    mask, or_else, switch, mix = (
        _function("mask"),
        _function("or_else"),
        _function("switch"),
        _function("mix"),
    )

    def check_open(self, name: str) -> None:
        """Raise TypeError if the function has been applied to arguments already."""

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """The function applied to arguments: trace it with `@ "address"`, draw from it with `(key)`."""
        from bayesmap.gen.closure import Closure

        return Closure.of(self, args, kwargs)
