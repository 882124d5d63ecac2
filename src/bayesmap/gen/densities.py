"""The named distributions, with TensorFlow Probability's parameters and, where it is simple, its draws.

A family gives its parameters in the form that the two functions below them use, how to draw `shape`
independent values, and the log density elementwise.
"""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

import inspect
import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import jax.random as jr
import jax.scipy.stats as st
from jax.nn import log_sigmoid, log_softmax
from jax.scipy.special import gammaln, xlog1py, xlogy

from bayesmap.gen.distribution import ExactDensity, draw_shape
from bayesmap.gen.errors import BadArguments
from bayesmap.gen.generative_function import GenerativeFunction
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.typing import PRNGKey

Params = tuple[Any, ...]


class Family(NamedTuple):
    """How to read the parameters, draw, and score."""

    parameters: Callable[..., Params]
    draw: Callable[..., Any]
    logpdf: Callable[..., Any]
    support: Callable[[Any], Any] = lambda value: True
    batch: Callable[..., tuple[int, ...]] = lambda *params: jnp.broadcast_shapes(*map(jnp.shape, params))


@dataclass
class Named(ExactDensity):
    """One of the families below; `by_name`, its arguments are `((positional, ...), {"name": value})`."""

    name: str = static()
    by_name: bool = static(default=False)

    def handle_kwargs(self) -> GenerativeFunction:
        return Named(self.name, by_name=True)

    def _parameters(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[tuple[int, ...], Params]:
        """(Shape of independent draws, parameters)."""
        if self.by_name:
            args, kwargs = args[0], {**args[1], **kwargs}
        kwargs = dict(kwargs)
        shape = draw_shape(kwargs.pop("sample_shape", ()))
        read = _FAMILIES[self.name].parameters
        try:
            inspect.signature(read).bind(*args, **kwargs)
        except TypeError as error:
            raise BadArguments(f"{self.name}{inspect.signature(read)}: {error}") from None
        return shape, tuple(jnp.asarray(p, jnp.result_type(float)) for p in read(*args, **kwargs))

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        family, (shape, params) = _FAMILIES[self.name], self._parameters(args, kwargs)
        return family.draw(key, (*shape, *family.batch(*params)), *params)

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        return _FAMILIES[self.name].logpdf(value, *self._parameters(args, kwargs)[1])

    def in_support(self, value: Any) -> Any:
        return _FAMILIES[self.name].support(value)


def _event(logits: Any = None, probs: Any = None) -> Params:
    """Parameters of an event's probability: (p, log p, log(1 - p))."""
    if (logits is None) == (probs is None):
        raise BadArguments("a probability is given by exactly one of logits= and probs=")
    if probs is not None:
        return _chance(probs)
    logits = jnp.asarray(logits, jnp.result_type(float))
    return jax.nn.sigmoid(logits), log_sigmoid(logits), log_sigmoid(-logits)


def _bernoulli(implicit: Any = None, *, logits: Any = None, probs: Any = None) -> Params:
    return _event(_explicit("bernoulli", implicit, logits, probs), probs)


def _explicit(name: str, implicit: Any, logits: Any, probs: Any) -> Any:
    """The logits; a positional argument counts as such, with a warning, for it is easily mistaken."""
    if sum(x is not None for x in (implicit, logits, probs)) != 1:
        raise BadArguments(f"{name} takes exactly one of logits= and probs=")
    if implicit is not None:
        text = f"a bare argument to {name} means logits; say logits= or probs="
        warnings.warn(text, DeprecationWarning, stacklevel=4)
    return implicit if logits is None else logits


def _chance(p: Any) -> Params:
    p = jnp.asarray(p, jnp.result_type(float))
    return p, jnp.log(p), jnp.log1p(-p)


def _class_logits(implicit: Any = None, *, logits: Any = None, probs: Any = None) -> Params:
    logits = _explicit("categorical", implicit, logits, probs)
    return (jnp.log(jnp.asarray(probs)) if logits is None else logits,)


def _categorical_logpdf(value: Any, logits: Any) -> Any:
    table = log_softmax(logits)
    k = table.shape[-1]
    shape = jnp.broadcast_shapes(jnp.shape(value), table.shape[:-1])
    table = jnp.broadcast_to(table, (*shape, k))
    index = jnp.broadcast_to(jnp.clip(value, 0, k - 1), shape).astype(jnp.int32)[..., None]
    return jnp.where((value >= 0) & (value < k), jnp.take_along_axis(table, index, axis=-1)[..., 0], -jnp.inf)


def _truncated_draw(key: PRNGKey, shape: tuple[int, ...], loc: Any, scale: Any, low: Any, high: Any) -> Any:
    return loc + scale * jr.truncated_normal(key, (low - loc) / scale, (high - loc) / scale, shape)


def _positive(value: Any, logpdf: Any) -> Any:
    return jnp.where(value >= 0, logpdf, -jnp.inf)


def _log_normal_logpdf(value: Any, loc: Any, scale: Any) -> Any:
    safe = jnp.where(value > 0, value, 1.0)
    return jnp.where(value > 0, st.norm.logpdf(jnp.log(safe), loc, scale) - jnp.log(safe), -jnp.inf)


def _inverse_gamma_logpdf(value: Any, a: Any, scale: Any) -> Any:
    safe = jnp.where(value > 0, value, 1.0)
    logpdf = a * jnp.log(scale) - gammaln(a) - (a + 1) * jnp.log(safe) - scale / safe
    return jnp.where(value > 0, logpdf, -jnp.inf)


def _weibull_logpdf(value: Any, k: Any, scale: Any) -> Any:
    z = jnp.where(value > 0, value, 1.0) / scale
    return jnp.where(value > 0, jnp.log(k / scale) + (k - 1) * jnp.log(z) - z**k, -jnp.inf)


def _loc_scale(loc: Any, scale: Any) -> Params:
    return loc, scale


def _binomial(total_count: Any, logits: Any = None, probs: Any = None) -> Params:
    return total_count, *_event(logits, probs)[:1]


def _counts(value: Any) -> Any:
    return (value >= 0) & (value == jnp.floor(value))


def _real(draw: Callable[..., Any]) -> Callable[..., Any]:
    """Counts as real numbers, as TensorFlow Probability draws them."""
    return lambda *args: draw(*args).astype(jnp.result_type(float))


def _event_batch(concentration: Any) -> tuple[int, ...]:
    return jnp.shape(concentration)[:-1]


_FAMILIES: dict[str, Family] = {
    "flip": Family(
        _chance,
        lambda key, shape, p, *_: jr.uniform(key, shape) < p,
        lambda v, p, yes, no: jnp.where(v, yes, no),
    ),
    "bernoulli": Family(
        _bernoulli,
        lambda key, shape, p, *_: (jr.uniform(key, shape) < p).astype(jnp.int32),
        lambda v, p, yes, no: jnp.where(v == 1, yes, jnp.where(v == 0, no, -jnp.inf)),
        support=lambda v: (v == 0) | (v == 1),
    ),
    "categorical": Family(
        _class_logits,
        lambda key, shape, logits: jr.categorical(key, logits, shape=shape),
        _categorical_logpdf,
        support=_counts,
        batch=_event_batch,
    ),
    "normal": Family(_loc_scale, lambda key, shape, loc, scale: loc + scale * jr.normal(key, shape), st.norm.logpdf),
    "uniform": Family(
        lambda low, high: (low, high),
        lambda key, shape, low, high: low + (high - low) * jr.uniform(key, shape),
        lambda v, low, high: jnp.where((v >= low) & (v <= high), -jnp.log(high - low), -jnp.inf),
    ),
    "beta": Family(
        lambda concentration1, concentration0: (concentration1, concentration0),
        lambda key, shape, a, b: jr.beta(key, a, b, shape),
        st.beta.logpdf,
    ),
    "gamma": Family(
        lambda concentration, rate: (concentration, rate),
        lambda key, shape, a, rate: jr.gamma(key, a, shape) / rate,
        lambda v, a, rate: st.gamma.logpdf(v, a, scale=1 / rate),
    ),
    "inverse_gamma": Family(
        lambda concentration, scale: (concentration, scale),
        lambda key, shape, a, scale: scale / jr.gamma(key, a, shape),
        _inverse_gamma_logpdf,
    ),
    "exponential": Family(
        lambda rate: (rate,),
        lambda key, shape, rate: jr.exponential(key, shape) / rate,
        lambda v, rate: _positive(v, jnp.log(rate) - rate * v),
    ),
    "poisson": Family(
        lambda rate: (rate,),
        _real(lambda key, shape, rate: jr.poisson(key, rate, shape)),
        lambda v, rate: _positive(v, xlogy(v, rate) - rate - gammaln(v + 1.0)),
        support=_counts,
    ),
    "geometric": Family(
        _event,
        _real(lambda key, shape, p, *_: jr.geometric(key, p, shape) - 1),
        lambda v, p, yes, no: _positive(v, yes + xlog1py(v, -p)),
        support=_counts,
    ),
    "binomial": Family(
        _binomial,
        _real(lambda key, shape, n, p: jr.binomial(key, n, p, shape)),
        st.binom.logpmf,
        support=_counts,
    ),
    "laplace": Family(_loc_scale, lambda key, shape, m, s: m + s * jr.laplace(key, shape), st.laplace.logpdf),
    "cauchy": Family(_loc_scale, lambda key, shape, m, s: m + s * jr.cauchy(key, shape), st.cauchy.logpdf),
    "gumbel": Family(
        _loc_scale,
        lambda key, shape, m, s: m + s * jr.gumbel(key, shape),
        lambda v, m, s: -(v - m) / s - jnp.exp(-(v - m) / s) - jnp.log(s),
    ),
    "student_t": Family(
        lambda df, loc, scale: (df, loc, scale),
        lambda key, shape, df, m, s: m + s * jr.t(key, df, shape),
        st.t.logpdf,
    ),
    "log_normal": Family(
        _loc_scale, lambda key, shape, m, s: jnp.exp(m + s * jr.normal(key, shape)), _log_normal_logpdf
    ),
    "half_normal": Family(
        lambda scale: (scale,),
        lambda key, shape, s: s * jnp.abs(jr.normal(key, shape)),
        lambda v, s: _positive(v, st.norm.logpdf(v, 0.0, s) + jnp.log(2.0)),
    ),
    "half_cauchy": Family(
        _loc_scale,
        lambda key, shape, m, s: m + s * jnp.abs(jr.cauchy(key, shape)),
        lambda v, m, s: _positive(v - m, st.cauchy.logpdf(v, m, s) + jnp.log(2.0)),
    ),
    "truncated_normal": Family(
        lambda loc, scale, low, high: (loc, scale, low, high),
        _truncated_draw,
        lambda v, m, s, low, high: st.truncnorm.logpdf(v, (low - m) / s, (high - m) / s, m, s),
    ),
    "weibull": Family(
        lambda concentration, scale: (concentration, scale),
        lambda key, shape, k, s: jr.weibull_min(key, s, k, shape),
        _weibull_logpdf,
    ),
    "chi2": Family(lambda df: (df,), lambda key, shape, df: 2.0 * jr.gamma(key, df / 2, shape), st.chi2.logpdf),
    "dirichlet": Family(
        lambda concentration: (concentration,),
        lambda key, shape, a: jr.dirichlet(key, a, shape),
        lambda v, a: st.dirichlet.logpdf(jnp.moveaxis(v, -1, 0), a),
        batch=_event_batch,
    ),
    "mv_normal": Family(
        lambda loc, covariance_matrix: (loc, covariance_matrix),
        lambda key, shape, m, cov: jr.multivariate_normal(key, m, cov, shape),
        st.multivariate_normal.logpdf,
        batch=lambda m, cov: jnp.shape(m)[:-1],
    ),
    "mv_normal_diag": Family(
        lambda loc, scale_diag=1.0: (loc, scale_diag),
        lambda key, shape, m, s: m + s * jr.normal(key, (*shape, jnp.broadcast_shapes(jnp.shape(m), jnp.shape(s))[-1])),
        lambda v, m, s: jnp.sum(st.norm.logpdf(v, m, s), axis=-1),
        batch=lambda m, s: jnp.broadcast_shapes(jnp.shape(m), jnp.shape(s))[:-1],
    ),
}

flip = Named("flip")
"""True with probability `p`."""
bernoulli = Named("bernoulli")
"""1 with probability `probs`, or log odds `logits`; int32."""
categorical = Named("categorical")
"""An index into the last axis of `logits` or `probs`."""
normal = Named("normal")
uniform = Named("uniform")
beta = Named("beta")
gamma = Named("gamma")
inverse_gamma = Named("inverse_gamma")
exponential = Named("exponential")
poisson = Named("poisson")
geometric = Named("geometric")
"""Failures before the first success."""
binomial = Named("binomial")
laplace = Named("laplace")
cauchy = Named("cauchy")
gumbel = Named("gumbel")
student_t = Named("student_t")
log_normal = Named("log_normal")
half_normal = Named("half_normal")
half_cauchy = Named("half_cauchy")
truncated_normal = Named("truncated_normal")
weibull = Named("weibull")
chi2 = Named("chi2")
dirichlet = Named("dirichlet")
mv_normal = Named("mv_normal")
mv_normal_diag = Named("mv_normal_diag")
