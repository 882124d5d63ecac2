"""Undo and redo: what the document was, with the steps of one gesture taken as one."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

T = TypeVar("T")
DEPTH = 200


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
