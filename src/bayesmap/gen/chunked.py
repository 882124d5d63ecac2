"""Large batches in bounded memory."""

import math
from collections.abc import Callable
from typing import Any

import jax
from jax.custom_batching import custom_vmap
from jax.extend.core import jaxprs_in_params

CACHE_BYTES, DEVICE_BYTES = 1 << 20, 1 << 28
"""How large the largest intermediate array of a chunk may be, on a CPU and on an accelerator."""


def in_chunks(fn: Callable[..., Any], *args: Any) -> Any:
    """`fn(*args)`; under `jax.vmap`, as many elements at a time as keep every array small.

    Memory is then that of the results and of one chunk. Work that all elements share is done once, too: XLA
    takes it out of the loop over chunks, whereas in one large batch it may repeat it for each element.
    """
    leaves, treedef = jax.tree.flatten(args)
    traced = [k for k, x in enumerate(leaves) if isinstance(x, jax.core.Tracer)]
    if not traced:
        return fn(*args)

    def of_traced(*values: Any) -> Any:
        # What is known stays known, so that errors can be raised while tracing.
        filled = dict(zip(traced, values, strict=True))
        return fn(*jax.tree.unflatten(treedef, [filled.get(k, x) for k, x in enumerate(leaves)]))

    chunked = custom_vmap(of_traced)

    @chunked.def_vmap
    def _(axis_size: int, in_batched: list[bool], *values: Any) -> Any:
        moving = [v for v, b in zip(values, in_batched, strict=True) if b]

        def one(moving: list[Any]) -> Any:
            rest = iter(moving)
            return of_traced(*(next(rest) if b else v for v, b in zip(values, in_batched, strict=True)))

        largest = _largest_array(jax.make_jaxpr(one)([v[0] for v in moving]).jaxpr)
        chunk = (CACHE_BYTES if jax.default_backend() == "cpu" else DEVICE_BYTES) // largest
        if chunk >= axis_size:
            out = jax.vmap(one)(moving)
        else:
            chunk = _even_share(axis_size, chunk)
            out = jax.lax.map(one, moving, batch_size=chunk if chunk > 1 else None)
        return out, jax.tree.map(lambda _: True, out)

    # Derivatives are those of the function itself: custom_vmap has no reverse mode.
    differentiable = jax.custom_jvp(chunked)
    differentiable.defjvp(lambda primals, tangents: jax.jvp(of_traced, primals, tangents))
    return differentiable(*(leaves[k] for k in traced))


def _even_share(size: int, most: int) -> int:
    """A chunk that divides the batch, if one is near the limit: a remainder would copy all results once more."""
    for chunk in range(most, max(1, most // 4), -1):
        if size % chunk == 0:
            return chunk
    return most


def _largest_array(jaxpr: Any) -> int:
    """Bytes of the largest array that a jaxpr computes."""
    sizes = [1]
    for eqn in jaxpr.eqns:
        sizes += [math.prod(v.aval.shape) * v.aval.dtype.itemsize for v in eqn.outvars if hasattr(v.aval, "shape")]
        sizes += [_largest_array(inner) for inner in jaxprs_in_params(eqn.params)]
    return max(sizes)
