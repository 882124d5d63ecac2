"""Sets of addresses: `Selection.at["x"] | Selection.at["y", "z"]`."""

from typing import Any

from bayesmap.gen.pytree import Pytree, dataclass, static


class SelectionBuilderType:
    """`at["x", "y"]` selects everything at or below that address; `...` matches any one component."""

    def __getitem__(self, address: Any) -> "Selection":
        address = address if isinstance(address, tuple) else (address,)
        return Selection.all().extend(*address) if address else Selection.leaf()

    @property
    def all(self) -> "Selection":
        return _ALL

    @property
    def none(self) -> "Selection":
        return _NONE

    @property
    def leaf(self) -> "Selection":
        return _Leaf()


class Selection(Pytree):
    """A set of addresses, to combine by `|`, `&` and `~`.

    `sel(a)` is the selection below the address `a`; `sel[a]` and `a in sel` say whether `a` itself is selected.
    """

    at = SelectionBuilderType()

    def check(self) -> bool:
        """Return whether the empty address is selected."""
        raise NotImplementedError

    def get_subselection(self, component: Any) -> "Selection":
        """Return the selection below one component."""
        raise NotImplementedError

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
        acc = self
        for component in reversed(address):
            acc = acc if acc == _NONE else _At(acc, component)
        return acc

    def complement(self) -> "Selection":
        """Return `~self`."""
        return ~self

    def filter(self, choices: Any) -> Any:
        """Return the selected part of a choice map."""
        return choices.filter(self)

    def __call__(self, address: Any) -> "Selection":
        acc = self
        for component in address if isinstance(address, tuple) else (address,):
            if component is ...:
                raise TypeError("`...` can stand in a selection, but not in an address that is looked up")
            acc = acc.get_subselection(component)
        return acc

    def __getitem__(self, address: Any) -> bool:
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
    """All addresses, or none."""

    selected: bool = static()

    def check(self) -> bool:
        return self.selected

    def get_subselection(self, component: Any) -> Selection:
        return self


_ALL, _NONE = _Every(True), _Every(False)


@dataclass
class _Leaf(Selection):
    def check(self) -> bool:
        return True

    def get_subselection(self, component: Any) -> Selection:
        return _NONE


@dataclass
class _At(Selection):
    inner: Selection
    component: Any = static()

    def check(self) -> bool:
        return False

    def get_subselection(self, component: Any) -> Selection:
        return self.inner if self.component is ... or component == self.component else _NONE


@dataclass
class _Not(Selection):
    inner: Selection

    def check(self) -> bool:
        return not self.inner.check()

    def get_subselection(self, component: Any) -> Selection:
        return ~self.inner.get_subselection(component)


@dataclass
class _Or(Selection):
    left: Selection
    right: Selection

    def check(self) -> bool:
        return self.left.check() or self.right.check()

    def get_subselection(self, component: Any) -> Selection:
        return self.left.get_subselection(component) | self.right.get_subselection(component)


SelectionBuilder = SelectionBuilderType()
