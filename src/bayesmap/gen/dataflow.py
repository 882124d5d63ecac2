"""Which outputs of a function can change, given which inputs did: read off its jaxpr."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import jax
from jax.extend.core import Literal

from bayesmap.gen.diff import Change, IndexChange, NoChange, UnknownChange

# Element i of the result depends on element i of the operands alone.
_ELEMENTWISE = frozenset(
    "abs add and ceil convert_element_type copy copy_p div eq exp floor ge gt integer_pow le log logistic lt "  # noqa: SIM905
    "max min mul ne neg not or round select_n sign sqrt sub tanh xor".split()
)


@dataclass(frozen=True)
class _Origin:
    """The inputs that a value is computed from, and those that it is an elementwise image of."""

    inputs: frozenset[int] = frozenset()
    images: frozenset[int] = frozenset()


@dataclass(frozen=True)
class Dataflow:
    """For each output leaf of a function, its origin among the input leaves."""

    outputs: tuple[_Origin, ...]

    def change(self, output: int, tangents: Sequence[Change]) -> Change:
        """How output leaf number `output` changed, from how the inputs did."""
        origin = self.outputs[output]
        changed = [k for k in origin.inputs if tangents[k] != NoChange]
        if not changed:
            return NoChange
        only = tangents[changed[0]]
        one_element = len(changed) == 1 and changed[0] in origin.images and isinstance(only, IndexChange)
        return only if one_element else UnknownChange


def dataflow(fn: Callable[..., Any], *inputs: Any) -> Dataflow | None:
    """Trace `fn` on inputs like these; None if it cannot run without their concrete values."""
    try:
        jaxpr = jax.make_jaxpr(fn)(*inputs).jaxpr
    except TypeError:  # what JAX raises when Python needs the value of a tracer
        return None
    origins = {v: _Origin(frozenset([k]), frozenset([k])) for k, v in enumerate(jaxpr.invars)}

    def origin(atom: Any) -> _Origin:
        return _Origin() if isinstance(atom, Literal) else origins.get(atom, _Origin())

    for eqn in jaxpr.eqns:
        shape = getattr(eqn.outvars[0].aval, "shape", None) if eqn.outvars else None
        operands = [(origin(v), getattr(v.aval, "shape", None) == shape) for v in eqn.invars]
        sources = frozenset[int]().union(*(o.inputs for o, _ in operands))
        images = frozenset[int]()
        if eqn.primitive.name in _ELEMENTWISE:
            images = frozenset(
                k for k in sources if all(k not in o.inputs or (same and k in o.images) for o, same in operands)
            )
        for out in eqn.outvars:
            origins[out] = _Origin(sources, images)
    return Dataflow(tuple(origin(v) for v in jaxpr.outvars))
