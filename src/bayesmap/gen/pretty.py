"""Traces and choice maps as readable trees, in the terminal and in notebooks."""

from bayesmap.gen.outline import Outlined


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
