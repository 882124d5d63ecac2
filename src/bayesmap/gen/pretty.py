"""Traces and choice maps as readable trees, in the terminal and in notebooks."""

from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.choice_map import Choice, ChoiceMap, Indexed, Or, Static, Switch
from bayesmap.gen.generative_function import Trace
from bayesmap.gen.mask import Mask


def pretty() -> None:
    """Show values by treescope, if it is installed and a notebook is running; their text is a tree anyhow."""
    try:
        import treescope

        treescope.register_as_default()
        treescope.register_autovisualize_magic()
    except (ImportError, RuntimeError):  # the latter is what treescope raises outside IPython
        return


def render(value: Trace | ChoiceMap) -> str:
    """A trace or a choice map as a tree, one choice a line."""
    if isinstance(value, ChoiceMap):
        return "\n".join(_lines(value))
    name = type(value.get_gen_fn()).__name__
    head = f"{type(value).__name__} of {name}, score {_leaf(value.get_score())}"
    return "\n".join([head, *("  " + line for line in _lines(value.get_choices()))])


def _lines(chm: ChoiceMap, label: str = "") -> list[str]:
    match chm:
        case Choice(value):
            return [f"{label or '()'}: {_leaf(value)}"]
        case Indexed(inner, index):
            return _lines(inner, f"{label}[{_leaf(index)}]")
        case Or(left, right):
            return [*_lines(left, label), *_lines(right, label)]
        case Switch(index, maps):
            head = f"{label or 'switch'}: branch {_leaf(index)} of"
            return [head, *("  " + line for k, m in enumerate(maps) for line in _lines(m, f"[{k}]"))]
        case Static(mapping) if mapping:
            below = [line for name, sub in mapping.items() for line in _lines(sub, repr(name))]
            return [f"{label}:", *("  " + line for line in below)] if label else below
    return [f"{label}: (empty)" if label else "(empty)"]


def _leaf(value: Any) -> str:
    if isinstance(value, Mask):
        return f"{_leaf(value.value)} where {_leaf(value.flag)}"
    if isinstance(value, jax.core.Tracer) or jnp.size(value) > 8:
        return f"{jnp.result_type(value)}{list(jnp.shape(value))}"
    return str(value)
