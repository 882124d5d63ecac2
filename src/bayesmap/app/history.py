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
    """

    present: T
    past: tuple[T, ...] = ()
    future: tuple[T, ...] = ()
    gesture: Hashable = None

    def push(self, state: T, gesture: Hashable = None) -> History[T]:
        """Another state; one of the same gesture as the last takes its place. No step where nothing changed."""
        if state == self.present:
            return self
        if gesture is not None and gesture == self.gesture:
            return replace(self, present=state, future=())
        return History(state, (*self.past, self.present)[-DEPTH:], (), gesture)

    def undo(self) -> History[T]:
        """The state before; this one where there is none."""
        if not self.past:
            return self
        return History(self.past[-1], self.past[:-1], (*self.future, self.present))

    def redo(self) -> History[T]:
        """The state that was undone last; this one where there is none."""
        if not self.future:
            return self
        return History(self.future[-1], (*self.past, self.present)[-DEPTH:], self.future[:-1])

    @property
    def can_undo(self) -> bool:
        """Whether there is a state before."""
        return bool(self.past)

    @property
    def can_redo(self) -> bool:
        """Whether a state was undone."""
        return bool(self.future)
