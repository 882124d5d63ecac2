"""A generative function together with its first arguments."""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from typing import Any

from bayesmap.gen import handler
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.generative_function import Edited, EditRequest, GenerativeFunction, Trace
from bayesmap.gen.pytree import dataclass
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class Closure(GenerativeFunction):
    """`m(x)`: a site with `@ "address"`, a draw with `(key)`, or `m` with `x` before its arguments.

    Its traces are those of `m`, and their arguments include the ones held here.
    """

    gen_fn: GenerativeFunction
    args: tuple[Any, ...]
    keywords: tuple[Any, ...] = ()

    @staticmethod
    def of(gen_fn: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> "Closure":
        """Apply `gen_fn`; keyword arguments become its last positional ones."""
        if kwargs:
            gen_fn = gen_fn.keyworded(tuple(kwargs))
        return Closure(gen_fn, args, tuple(kwargs.values()))

    def _full(self, rest: tuple[Any, ...]) -> tuple[Any, ...]:
        return (*self.args, *rest, *self.keywords)

    def check_open(self, name: str) -> None:
        raise TypeError(f"apply {name} before the arguments: m.{name}(...)(x), not m(x).{name}(...)")

    def __matmul__(self, address: Any) -> Any:
        return handler.visit(address, self.gen_fn, self._full(()))

    def __call__(self, key: PRNGKey, *rest: Any) -> Any:
        """Simulate, and keep the return value alone."""
        return self.gen_fn.simulate(key, self._full(rest)).get_retval()

    def simulate(self, key: PRNGKey, args: Arguments) -> Trace:
        return self.gen_fn.simulate(key, self._full(args))

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        return self.gen_fn.assess(choices, self._full(args))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        return self.gen_fn.generate(key, constraint, self._full(args))

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        held = (Diff.unknown_change(self.args), Diff.unknown_change(self.keywords))
        return request.edit(key, trace, (*held[0], *argdiffs, *held[1]))

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return self.gen_fn.project(key, trace, selection)
