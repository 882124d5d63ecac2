"""Names of types for annotations, as in `genjax.typing`. No code checks them at run time; type checkers see arrays."""

from collections.abc import Callable, Generator, Iterable, Sequence
from types import EllipsisType
from typing import Annotated, Any, Final, Generic, Literal, ParamSpec, Self, TypeAlias, TypeVar

import jax
import jax.numpy as jnp

Array: TypeAlias = jax.Array
ArrayLike: TypeAlias = jax.typing.ArrayLike
IntArray: TypeAlias = jax.Array
FloatArray: TypeAlias = jax.Array
BoolArray: TypeAlias = jax.Array
PRNGKey: TypeAlias = jax.Array

Flag: TypeAlias = bool | BoolArray
Score: TypeAlias = FloatArray
Weight: TypeAlias = FloatArray
Arguments: TypeAlias = tuple[Any, ...]
Argdiffs: TypeAlias = tuple[Any, ...]
Retdiff: TypeAlias = Any
InAxes: TypeAlias = int | Sequence[Any] | None

StaticComponent: TypeAlias = str
AddressComponent: TypeAlias = str | int | slice | IntArray
Address: TypeAlias = AddressComponent | tuple[AddressComponent, ...]
StaticAddress: TypeAlias = tuple[str, ...]


class Is:
    """`Annotated[T, Is[condition]]`: a T that satisfies `condition`, as in beartype.vale."""

    def __init__(self, condition: Callable[[Any], bool]) -> None:
        self.condition = condition

    def __class_getitem__(cls, condition: Callable[[Any], bool]) -> "Is":
        return cls(condition)


ScalarShaped = Is(lambda value: jnp.shape(value) == ())
ScalarFlag: TypeAlias = Annotated[Flag, ScalarShaped]
ScalarInt: TypeAlias = Annotated[IntArray, ScalarShaped]

# fmt: off
__all__ = [
    "Address", "AddressComponent", "Annotated", "Any", "Argdiffs", "Arguments", "Array", "ArrayLike", "BoolArray",
    "Callable", "EllipsisType", "Final", "Flag", "FloatArray", "Generator", "Generic", "InAxes", "IntArray", "Is",
    "Iterable", "Literal", "PRNGKey", "ParamSpec", "Retdiff", "ScalarFlag", "ScalarInt", "ScalarShaped", "Score",
    "Self", "Sequence", "StaticAddress", "StaticComponent", "TypeAlias", "TypeVar", "Weight",
]
# fmt: on
