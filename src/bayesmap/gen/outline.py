"""Traces, choice maps and their values as text: readable trees, in the terminal and in notebooks."""

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


def pretty() -> None:
    """Show values by treescope, if it is installed and a notebook is running; their text is a tree anyhow."""
    try:
        import treescope

        treescope.register_as_default()
        treescope.register_autovisualize_magic()
    except (ImportError, RuntimeError):  # the latter is what treescope raises outside IPython
        return


def render(value: Outlined) -> str:
    """A trace or a choice map as a tree, one choice a line."""
    return "\n".join(value.outline())
