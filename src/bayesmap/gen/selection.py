"""Sets of addresses: `Selection.at["x"] | Selection.at["y", "z"]`."""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from typing import Any

from bayesmap.gen.pytree import Pytree, dataclass, static


class SelectionBuilderType:
    """`at["x", "y"]` selects everything at or below that address; `...` matches any one component."""

    def __getitem__(self, address: Any) -> "Selection":
        address = address if isinstance(address, tuple) else (address,)
        return Selection.all().extend(*address) if address else Selection.leaf()

    @property
    def all(self) -> "Selection":
        """Every address."""
        return _All()

    @property
    def none(self) -> "Selection":
        """No address."""
        return _None()

    @property
    def leaf(self) -> "Selection":
        """The bare value, and nothing below it."""
        return _Leaf()


class Selection(Pytree):
    """A set of addresses: `sel(a)` is what it selects below `a`, `sel[a]` and `a in sel` ask for `a` itself.

    Combine with `|`, `&` and `~`.
    """

    at = SelectionBuilderType()

    def check(self) -> bool:
        """Is the empty address, the value right here, selected?"""
        raise NotImplementedError

    def get_subselection(self, component: Any) -> "Selection":
        """What is selected below one component."""
        raise NotImplementedError

    @staticmethod
    def all() -> "Selection":
        """Every address."""
        return _All()

    @staticmethod
    def none() -> "Selection":
        """No address."""
        return _None()

    @staticmethod
    def leaf() -> "Selection":
        """The bare value, and nothing below it."""
        return _Leaf()

    def extend(self, *address: Any) -> "Selection":
        """This selection moved below `address`."""
        acc = self
        for component in reversed(address):
            acc = acc if isinstance(acc, _None) else _At(acc, component)
        return acc

    def complement(self) -> "Selection":
        """The same as `~self`."""
        return ~self

    def filter(self, choices: Any) -> Any:
        """The part of a choice map that is selected."""
        return choices.filter(self)

    def __call__(self, address: Any) -> "Selection":
        acc = self
        for component in address if isinstance(address, tuple) else (address,):
            if component is ...:
                raise TypeError("`...` stands in a selection, not in an address that is asked for")
            acc = acc.get_subselection(component)
        return acc

    def __getitem__(self, address: Any) -> bool:
        return self(address).check()

    def __contains__(self, address: Any) -> bool:
        return self[address]

    def __or__(self, other: "Selection") -> "Selection":
        if isinstance(self, _None) or isinstance(other, _All) or self == other:
            return other
        return self if isinstance(self, _All) or isinstance(other, _None) else _Or(self, other)

    def __and__(self, other: "Selection") -> "Selection":
        if isinstance(self, _All) or isinstance(other, _None) or self == other:
            return other
        return self if isinstance(self, _None) or isinstance(other, _All) else _And(self, other)

    def __invert__(self) -> "Selection":
        match self:
            case _All():
                return _None()
            case _None():
                return _All()
            case _Not(inner):
                return inner
        return _Not(self)


@dataclass
class _All(Selection):
    def check(self) -> bool:
        return True

    def get_subselection(self, component: Any) -> Selection:
        return self


@dataclass
class _None(Selection):
    def check(self) -> bool:
        return False

    def get_subselection(self, component: Any) -> Selection:
        return self


@dataclass
class _Leaf(Selection):
    def check(self) -> bool:
        return True

    def get_subselection(self, component: Any) -> Selection:
        return _None()


@dataclass
class _At(Selection):
    inner: Selection
    component: Any = static()

    def check(self) -> bool:
        return False

    def get_subselection(self, component: Any) -> Selection:
        return self.inner if self.component is ... or component == self.component else _None()


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


@dataclass
class _And(Selection):
    left: Selection
    right: Selection

    def check(self) -> bool:
        return self.left.check() and self.right.check()

    def get_subselection(self, component: Any) -> Selection:
        return self.left.get_subselection(component) & self.right.get_subselection(component)


SelectionBuilder = SelectionBuilderType()
