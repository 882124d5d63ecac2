"""What becomes of a document that a page brings along: from a share link, or from before its connection was lost."""

from __future__ import annotations

from dataclasses import replace

from bayesmap.app.document import Document, Refused, settings_of


def adopted(present: Document, brought: Document) -> Document:
    """The document to show: a simulation is taken as it is; of one that shows the present file, its settings are.

    Raises:
        Refused: the two show different files, or one of them none.
    """
    if brought.simulated and present.simulated:
        return brought
    if brought.source == present.source and brought.grid == present.grid:
        return replace(present, **{name: getattr(brought, name) for name in settings_of(present.source.kind)})
    raise Refused(f"the link shows {_named(brought)}, and this server {_named(present)}", _remedy(brought))


def _named(document: Document) -> str:
    return "a map that was drawn" if document.simulated else f"{document.source.name}"


def _remedy(brought: Document) -> str:
    return f"start bayesmap app {'without a file' if brought.simulated else f'with {brought.source.name}'}"
