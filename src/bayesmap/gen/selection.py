"""Sets of addresses, as in `Selection.at["x"] | Selection.at["y", "z"]`.

Five kinds of nodes store a selection. `check` and `get_subselection` match over them; all else follows from these two.
"""

from typing import Any

from bayesmap.gen.pytree import Pytree, dataclass, static


class SelectionBuilderType:
    """Builder of selections: `at["x", "y"]` selects all addresses at or below ("x", "y"). `...` is any component."""

    def __getitem__(self, address: Any) -> "Selection":
        address = address if isinstance(address, tuple) else (address,)
        return Selection.all().extend(*address) if address else Selection.leaf()

    @property
    def all(self) -> "Selection":
        """The selection of every address."""
        return _ALL

    @property
    def none(self) -> "Selection":
        """The selection of no address."""
        return _NONE

    @property
    def leaf(self) -> "Selection":
        """The selection of the empty address alone."""
        return _Leaf()


class Selection(Pytree):
    """A set of addresses. Sets are combined by `|`, `&` and `~`.
    `sel(a)` is the selection below the address `a`. `sel[a]` and `a in sel` are True if `a` itself is selected.
    """

    at = SelectionBuilderType()

    def check(self) -> bool:
        """Return whether the empty address is selected."""
        match self:
            case _Every(selected):
                return selected
            case _Not(inner):
                return not inner.check()
            case _Or(left, right):
                return left.check() or right.check()
        return isinstance(self, _Leaf)

    def get_subselection(self, component: Any) -> "Selection":
        """Return the selection below one component."""
        match self:
            case _Every():
                return self
            case _At(inner, name) if name is ... or component == name:
                return inner
            case _Not(inner):
                return ~inner.get_subselection(component)
            case _Or(left, right):
                return left.get_subselection(component) | right.get_subselection(component)
        return _NONE

    @staticmethod
    def all() -> "Selection":
        """Return the selection of every address."""
        return _ALL

    @staticmethod
    def none() -> "Selection":
        """Return the selection of no address."""
        return _NONE

    @staticmethod
    def leaf() -> "Selection":
        """Return the selection of the empty address alone."""
        return _Leaf()

    def extend(self, *address: Any) -> "Selection":
        """Return this selection moved below `address`."""
        selection = self
        for component in reversed(address):
            selection = selection if selection == _NONE else _At(selection, component)
        return selection

    def complement(self) -> "Selection":
        """Return `~self`."""
        return ~self

    def filter(self, choices: Any) -> Any:
        """Return the selected part of a choice map."""
        return choices.filter(self)

    def __call__(self, address: Any) -> "Selection":
        """Return the selection below `address`."""
        selection = self
        for component in address if isinstance(address, tuple) else (address,):
            if component is ...:
                raise TypeError("`...` can stand in a selection, but not in an address that is looked up")
            selection = selection.get_subselection(component)
        return selection

    def __getitem__(self, address: Any) -> bool:
        """Return whether `address` is selected."""
        return self(address).check()

    def __contains__(self, address: Any) -> bool:
        return self[address]

    def __or__(self, other: "Selection") -> "Selection":
        if self in (_NONE, other) or other == _ALL:
            return other
        return self if self == _ALL or other == _NONE else _Or(self, other)

    def __and__(self, other: "Selection") -> "Selection":
        return ~(~self | ~other)

    def __invert__(self) -> "Selection":
        if isinstance(self, _Every):
            return _Every(not self.selected)
        return self.inner if isinstance(self, _Not) else _Not(self)


@dataclass
class _Every(Selection):
    """The node of all addresses, or of none."""

    selected: bool = static()


@dataclass
class _Leaf(Selection):
    """The node of the empty address alone."""


@dataclass
class _At(Selection):
    """The node of the addresses that `inner` selects below `component`; `...` stands for any one component."""

    inner: Selection
    component: Any = static()


@dataclass
class _Not(Selection):
    """The node of the addresses that `inner` does not select."""

    inner: Selection


@dataclass
class _Or(Selection):
    """The node of the addresses that at least one of two selections has."""

    left: Selection
    right: Selection


_ALL, _NONE = _Every(True), _Every(False)
SelectionBuilder = SelectionBuilderType()
