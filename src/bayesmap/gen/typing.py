"""Names for the kinds of values that cross the generative function interface."""

from collections.abc import Callable, Iterable, Sequence
from types import EllipsisType
from typing import Any, TypeAlias

import jax

Array: TypeAlias = jax.Array
IntArray: TypeAlias = jax.Array
FloatArray: TypeAlias = jax.Array
BoolArray: TypeAlias = jax.Array
PRNGKey: TypeAlias = jax.Array

Flag: TypeAlias = bool | BoolArray
Score: TypeAlias = FloatArray
Weight: TypeAlias = FloatArray
Arguments: TypeAlias = tuple[Any, ...]
InAxes: TypeAlias = int | Sequence[Any] | None

StaticComponent: TypeAlias = str
AddressComponent: TypeAlias = str | int | slice | IntArray
Address: TypeAlias = AddressComponent | tuple[AddressComponent, ...]
StaticAddress: TypeAlias = tuple[str, ...]

__all__ = [
    "Address",
    "AddressComponent",
    "Any",
    "Arguments",
    "Array",
    "BoolArray",
    "Callable",
    "EllipsisType",
    "Flag",
    "FloatArray",
    "InAxes",
    "IntArray",
    "Iterable",
    "PRNGKey",
    "Score",
    "Sequence",
    "StaticAddress",
    "StaticComponent",
    "Weight",
]
