"""What is one gesture of the hand: one step of undo, and edits that need not all be shown.

An edit of a gesture waits while the picture of the last one is being computed, and while its page has pictures to paint
yet. A page paints one picture while the worker computes the next; where painting takes longer, pictures would queue.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

from bayesmap.app.edits import gesture_of, merged
from bayesmap.app.protocol.actions import AnyAction

From = tuple[int, AnyAction]
T = TypeVar("T")
DEPTH = 200

MOST_UNPAINTED = 2
"""Pictures on their way to a page with which it is behind: the one that it paints, and the one that it paints next."""


@dataclass(frozen=True)
class History(Generic[T]):
    """States before and after the present one.

    Attributes:
        present: the state.
        past: earlier states, the latest last.
        future: undone states, the next to redo last.
        gesture: what the last step belongs to (a stroke, a drag), or None where it stands alone.
        authors: of the steps from each past state on, the latest last.
        undone: of the undone steps, the next to redo last.
    """

    present: T
    past: tuple[T, ...] = ()
    future: tuple[T, ...] = ()
    gesture: Hashable = None
    authors: tuple[Hashable, ...] = ()
    undone: tuple[Hashable, ...] = ()

    @property
    def undoes(self) -> Hashable:
        """Who made the step that is undone next; None where there is none."""
        return self.authors[-1] if self.authors else None

    @property
    def redoes(self) -> Hashable:
        """Who made the step that is redone next; None where there is none."""
        return self.undone[-1] if self.undone else None

    def push(self, state: T, gesture: Hashable = None, author: Hashable = None) -> History[T]:
        """Another state; one of the same gesture as the last takes its place. No step where nothing changed."""
        if state == self.present:
            return self
        if gesture is not None and gesture == self.gesture:
            return replace(self, present=state, future=(), undone=())
        return History(state, (*self.past, self.present)[-DEPTH:], (), gesture, (*self.authors, author)[-DEPTH:])

    def undo(self) -> History[T]:
        """The state before; this one where there is none."""
        if not self.past:
            return self
        future, undone = (*self.future, self.present), (*self.undone, self.undoes)
        return History(self.past[-1], self.past[:-1], future, None, self.authors[:-1], undone)

    def redo(self) -> History[T]:
        """The state that was undone last; this one where there is none."""
        if not self.future:
            return self
        past, authors = (*self.past, self.present)[-DEPTH:], (*self.authors, self.redoes)[-DEPTH:]
        return History(self.future[-1], past, self.future[:-1], None, authors, self.undone[:-1])

    @property
    def can_undo(self) -> bool:
        """Whether there is a state before."""
        return bool(self.past)

    @property
    def can_redo(self) -> bool:
        """Whether a state was undone."""
        return bool(self.future)


class Pace:
    """Edits come in, and come out when they are due; those of one gesture that wait together come out as one.

    Attributes:
        computing: whether the first picture of the present generation is not there yet.
    """

    def __init__(self) -> None:
        self.computing = False
        self._waiting: From | None = None
        self._unpainted: dict[int, list[int]] = {}

    def take(self, client: int, action: AnyAction) -> list[From]:
        """Take an action; return what is to be applied now, in order."""
        if gesture_of(action, client) is None or not self._must_wait(client):
            return [*self._let_go(), (client, action)]
        before, self._waiting = self._waiting, (client, action)
        if before is None:
            return []
        one = merged(before[1], action) if before[0] == client else None
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
