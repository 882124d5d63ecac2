"""What `@ "address"` means at the moment: the stack of runs of `@gen` bodies."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from jax.extend.core import get_opaque_trace_state

from bayesmap.gen.errors import AddressError, AddressReuse, NotAnAddress
from bayesmap.gen.typing import StaticAddress

_local = threading.local()


def as_path(address: Any) -> StaticAddress:
    """An address of names as a tuple.

    Raises:
        NotAnAddress: some component is not a string.
    """
    path = address if isinstance(address, tuple) else (address,)
    if not all(isinstance(component, str) for component in path):
        raise NotAnAddress(path, "the address of a site is a string or a tuple of strings")
    return path


def _trace_state() -> Any:
    return get_opaque_trace_state(convention="flax")  # type: ignore[no-untyped-call]


class Handler:
    """One run of a body: `visit` is called for each site, in order."""

    def __init__(self) -> None:
        self.visited: list[StaticAddress] = []
        self.trace_state = _trace_state()

    def visit(self, path: StaticAddress, gen_fn: Any, args: tuple[Any, ...]) -> Any:
        """The value of the site's call."""
        raise NotImplementedError

    def enter(self, path: StaticAddress) -> None:
        """Note a site.

        Raises:
            AddressReuse: another site is at, above or below the same address.
            AddressError: the site lies in a JAX transformation within the body.
        """
        for other in self.visited:
            shared = min(len(other), len(path))
            if other[:shared] == path[:shared]:
                raise AddressReuse(path, f"there is one at {other}")
        if _trace_state() != self.trace_state:
            remedy = "use the vmap, scan or or_else combinator"
            raise AddressError(path, f"the site is inside a jax transformation within the body; {remedy}")
        self.visited.append(path)


def visit(address: Any, gen_fn: Any, args: tuple[Any, ...]) -> Any:
    """Call a generative function at an address of the `@gen` body that is running."""
    stack = getattr(_local, "stack", [])
    path = as_path(address)
    if not stack:
        raise AddressError(path, "`@` is for the body of a @gen function; call the closure with a key instead")
    stack[-1].enter(path)
    return stack[-1].visit(path, gen_fn, args)


@contextmanager
def running(handler: Handler) -> Iterator[None]:
    """Let `handler` receive the sites of the code inside."""
    stack = _local.__dict__.setdefault("stack", [])
    stack.append(handler)
    try:
        yield
    finally:
        stack.pop()
