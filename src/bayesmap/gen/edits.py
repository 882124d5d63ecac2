"""Requests to edit a trace: the primitive ones, which every generative function answers itself, and `DiffAnnotate`.

`StaticRequest` is for `@gen`, `IndexRequest` and `VectorRequest` for vectorised models, the others for all traces.
"""

from collections.abc import Callable
from typing import Any

import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.pytree import Pytree, dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import PRNGKey, Weight

Edited = tuple[Any, Weight, Any, "EditRequest"]  # new trace, weight, `Diff` of the return value, request that undoes it


def _unaltered(diffs: Any) -> Any:
    """Return the marks of change as they are."""
    return diffs


class EditRequest(Pytree):
    """Base of requests: a request describes a change of a trace, and `edit` makes it."""

    def edit(self, key: PRNGKey, trace: Any, argdiffs: Any) -> Edited:
        """Return the edited trace with its weight. By default the trace's generative function makes the edit."""
        return trace.get_gen_fn().edit(key, trace, self, argdiffs)  # type: ignore[no-any-return]

    def dimap(
        self, *, pre: Callable[[Any], Any] = _unaltered, post: Callable[[Any], Any] = _unaltered
    ) -> "DiffAnnotate":
        """Return this request with `pre(argdiffs)` as its argdiffs and `post(retdiff)` as its retdiff."""
        return DiffAnnotate(self, pre, post)

    def map(self, post: Callable[[Any], Any]) -> "DiffAnnotate":
        """Return this request with `post(retdiff)` as its retdiff."""
        return self.dimap(post=post)

    def contramap(self, pre: Callable[[Any], Any]) -> "DiffAnnotate":
        """Return this request with `pre(argdiffs)` as its argdiffs."""
        return self.dimap(pre=pre)


@dataclass
class DiffAnnotate(EditRequest):
    """A request with functions that inspect or overrule its marks of change. A wrong mark makes the edit wrong."""

    request: EditRequest
    argdiff_fn: Callable[[Any], Any] = static(default=_unaltered)
    retdiff_fn: Callable[[Any], Any] = static(default=_unaltered)

    def edit(self, key: PRNGKey, trace: Any, argdiffs: Any) -> Edited:
        """Edit the trace with the new marks of the arguments, and return the new marks of the return value."""
        new, weight, retdiff, backward = self.request.edit(key, trace, self.argdiff_fn(argdiffs))
        return new, weight, self.retdiff_fn(retdiff), backward


@dataclass
class Update(EditRequest):
    """A request to give the choices in `constraint` new values and keep the others. Weight: new score - old score."""

    constraint: ChoiceMap


@dataclass
class EmptyRequest(EditRequest):
    """A request to keep all choices. Weight: 0 if no argument changed, else new score - old score."""

    def edit(self, key: PRNGKey, trace: Any, argdiffs: Any) -> Edited:
        """Return the trace itself if no argument changed, else the trace with its new score."""
        if Diff.static_check_no_change(argdiffs):
            return trace, jnp.zeros(()), Diff.no_change(trace.get_retval()), EmptyRequest()
        return Update(ChoiceMap.empty()).edit(key, trace, argdiffs)


@dataclass
class Regenerate(EditRequest):
    """A request to draw the selected choices anew from the model, and to keep the others.
    The weight is the log Metropolis-Hastings ratio of this proposal: the change of the kept choices' log density. The
    selected choices' own densities cancel against the densities of their proposal.
    """

    selection: Selection


@dataclass
class StaticRequest(EditRequest):
    """One request for each address of a `@gen` function; the other addresses keep their choices."""

    addressed: dict[Any, EditRequest]

    def __post_init__(self) -> None:
        paths = {a if isinstance(a, tuple) else (a,): request for a, request in self.addressed.items()}
        object.__setattr__(self, "addressed", paths)


@dataclass
class IndexRequest(EditRequest):
    """A request for the element `idx`, an int or a scalar integer array, of a vectorised model."""

    idx: Any
    request: EditRequest


@dataclass
class VectorRequest(EditRequest):
    """One request for every element of a vectorised model: the leaves of `request` have a leading axis."""

    request: EditRequest
