"""Combinators as methods: `model.vmap(in_axes=0)`. This file alone looks them up, when they are called."""

from collections.abc import Callable
from typing import Any

from bayesmap.gen.typing import InAxes


class Fluent:
    """The methods that build larger generative functions; `bayesmap.gen.vmap` and the like say what they do."""

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """The function applied to arguments: trace it with `@ "address"`, draw from it with `(key)`."""
        from bayesmap.gen.closure import Closure

        return Closure.of(self, args, kwargs)

    def vmap(self, /, *, in_axes: InAxes = 0) -> Any:
        """See `bayesmap.gen.vmap`."""
        from bayesmap.gen import vmap

        return vmap(in_axes=in_axes)(self)

    def repeat(self, /, *, n: int) -> Any:
        """See `bayesmap.gen.repeat`."""
        from bayesmap.gen import repeat

        return repeat(n=n)(self)

    def scan(self, /, *, n: int | None = None) -> Any:
        """See `bayesmap.gen.scan`."""
        from bayesmap.gen import scan

        return scan(n=n)(self)

    def accumulate(self) -> Any:
        """See `bayesmap.gen.accumulate`."""
        from bayesmap.gen import accumulate

        return accumulate()(self)

    def reduce(self) -> Any:
        """See `bayesmap.gen.reduce`."""
        from bayesmap.gen import reduce

        return reduce()(self)

    def iterate(self, /, *, n: int) -> Any:
        """See `bayesmap.gen.iterate`."""
        from bayesmap.gen import iterate

        return iterate(n=n)(self)

    def iterate_final(self, /, *, n: int) -> Any:
        """See `bayesmap.gen.iterate_final`."""
        from bayesmap.gen import iterate_final

        return iterate_final(n=n)(self)

    def mask(self) -> Any:
        """See `bayesmap.gen.mask`."""
        from bayesmap.gen import mask

        return mask(self)

    def or_else(self, other: Any, /) -> Any:
        """See `bayesmap.gen.or_else`."""
        from bayesmap.gen import or_else

        return or_else(self, other)

    def switch(self, *others: Any) -> Any:
        """See `bayesmap.gen.switch`."""
        from bayesmap.gen import switch

        return switch(self, *others)

    def mix(self, *others: Any) -> Any:
        """See `bayesmap.gen.mix`."""
        from bayesmap.gen import mix

        return mix(self, *others)

    def dimap(self, /, *, pre: Callable[..., Any], post: Callable[..., Any]) -> Any:
        """See `bayesmap.gen.dimap`."""
        from bayesmap.gen import dimap

        return dimap(pre=pre, post=post)(self)

    def map(self, f: Callable[..., Any]) -> Any:
        """See `bayesmap.gen.map`."""
        from bayesmap.gen import map as map_

        return map_(f)(self)

    def contramap(self, f: Callable[..., Any]) -> Any:
        """See `bayesmap.gen.contramap`."""
        from bayesmap.gen import contramap

        return contramap(f)(self)

    def marginal(self, /, *, selection: Any = None, particles: int = 1) -> Any:
        """See `bayesmap.gen.marginal`."""
        from bayesmap.gen import marginal

        return marginal(selection=selection, particles=particles)(self)
