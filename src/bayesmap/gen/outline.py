"""The text of traces and choice maps: a tree with one choice per line."""

from contextlib import suppress
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.masks import Mask

MAX_ELEMENTS = 8  # size of the largest array whose elements are printed


class Outlined:
    """Base of values that print as a tree, one choice per line."""

    def outline(self, label: str = "") -> list[str]:
        """Return the lines. The first begins with `label`."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return "\n".join(self.outline())


def leaf_text(value: Any) -> str:
    """Return the text of a short array's elements, or of a long array's dtype and shape."""
    if isinstance(value, Mask):
        return f"{leaf_text(value.value)} where {leaf_text(value.flag)}"
    with suppress(TypeError):  # raised if the value is not an array
        if isinstance(value, jax.core.Tracer) or jnp.size(value) > MAX_ELEMENTS:
            return f"{jnp.result_type(value)}{list(jnp.shape(value))}"
    return str(value)


def pretty() -> None:
    """Make notebooks show values by treescope, if it is installed. Without it they show the same tree as text."""
    with suppress(ImportError, RuntimeError):  # treescope raises RuntimeError outside IPython
        import treescope

        treescope.register_as_default()
        treescope.register_autovisualize_magic()


def render(value: Outlined) -> str:  # GenJAX's name
    """Return the text of a trace or a choice map as a tree, one choice per line."""
    return repr(value)
