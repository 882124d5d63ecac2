"""Values as text."""

from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.mask import Mask


class Outlined:
    """Base of what prints as a tree, one choice a line."""

    def outline(self, label: str = "") -> list[str]:
        """The lines; `label` goes before the first."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return "\n".join(self.outline())


def leaf_text(value: Any) -> str:
    """A short array as it is, a long one as dtype and shape."""
    if isinstance(value, Mask):
        return f"{leaf_text(value.value)} where {leaf_text(value.flag)}"
    try:
        if isinstance(value, jax.core.Tracer) or jnp.size(value) > 8:
            return f"{jnp.result_type(value)}{list(jnp.shape(value))}"
    except TypeError:  # not an array, or several
        return str(value)
    return str(value)
