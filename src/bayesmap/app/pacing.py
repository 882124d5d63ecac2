"""The pace of a hand: which edits of a gesture wait, and for what.

An edit waits while the picture before it is being computed, and while its page has pictures to paint yet. A page paints
one picture while the worker computes the next; where painting takes longer, pictures would queue for longer and longer.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bayesmap.app.edits import EDITS, gesture_of, merged

Message = Mapping[str, Any]
From = tuple[int, Message]

MOST_UNPAINTED = 2
"""Pictures on their way to a page with which it is behind: the one that it paints, and the one that it paints next."""


class Pace:
    """Edits come in, and come out when they are due; those of one gesture that wait together come out as one.

    Attributes:
        computing: whether the first picture of the present generation is not there yet.
    """

    def __init__(self) -> None:
        self.computing = False
        self._waiting: From | None = None
        self._unpainted: dict[int, list[int]] = {}

    def take(self, client: int, message: Message) -> list[From]:
        """A message has come: what is to be applied now, in order."""
        of_gesture = message["type"] in EDITS and gesture_of(message, client) is not None
        if not of_gesture or not self._must_wait(client):
            return [*self._let_go(), (client, message)]
        before, self._waiting = self._waiting, (client, message)
        if before is None:
            return []
        one = merged(before[1], message) if before[0] == client else None
        if one is None:
            return [before]
        self._waiting = client, one
        return []

    def due(self) -> list[From]:
        """What waited, if it need not wait any longer."""
        return [] if self._waiting is None or self._must_wait(self._waiting[0]) else self._let_go()

    def sent(self, client: int | None, generation: int) -> None:
        """A picture goes to a page, or to all. Pages that never said what they painted are not waited for."""
        for page, generations in self._unpainted.items():
            if client in (page, None) and generation not in generations:
                generations.append(generation)

    def painted(self, client: int, generation: int) -> None:
        """A page has painted a picture, and will paint none of those before it."""
        self._unpainted[client] = [later for later in self._unpainted.get(client, []) if later > generation]

    def forget(self, client: int) -> None:
        """A page has gone, or connects anew: it has nothing to paint."""
        self._unpainted.pop(client, None)

    def _must_wait(self, client: int) -> bool:
        return self.computing or len(self._unpainted.get(client, ())) >= MOST_UNPAINTED

    def _let_go(self) -> list[From]:
        waiting, self._waiting = self._waiting, None
        return [] if waiting is None else [waiting]
