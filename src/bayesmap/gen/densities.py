"""The named distributions, with TensorFlow Probability's parameters and, where they are simple, its draws.

The common distributions need JAX alone. The less common ones are read from TensorFlow Probability when they are used.
This library is no dependency, since its releases lag behind JAX; its nightly builds (`tfp-nightly`) follow JAX.
"""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

import dataclasses
import importlib
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

from bayesmap.gen.distribution import KeywordDensity, draw_shape
from bayesmap.gen.errors import BadArguments, MissingExtra
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.typing import PRNGKey

Params = tuple[Any, ...]


class Family(NamedTuple):
    """Functions that read the parameters, draw, and score.

    Attributes:
        parameters: takes a user's arguments, and returns the parameters of the functions below.
        draw: takes a key, the shape of independent draws and the parameters.
        logpdf: takes a value and the parameters, elementwise.
        support: takes a value, and returns whether some parameters can give it.
        batch: takes the parameters, and returns the shape of independent draws that they imply.
    """

    parameters: Callable[..., Params]
    draw: Callable[..., Any]
    logpdf: Callable[..., Any]
    support: Callable[[Any], Any] = lambda value: True
    batch: Callable[..., tuple[int, ...]] = lambda *params: jnp.broadcast_shapes(*map(jnp.shape, params))


_FAMILIES: dict[str, Family] = {}


@dataclass
class Named(KeywordDensity):
    """The distribution of a family of `_FAMILIES`."""

    name: str = static()

    def _parameters(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[tuple[int, ...], Params]:
        """Return (shape of independent draws, parameters)."""
        args, kwargs = self.split(args, kwargs)
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


def _named(name: str, *functions: Any, **more: Any) -> Named:
    """Register the family of these functions, and return its distribution."""
    _FAMILIES[name] = Family(*functions, **more)
    return Named(name)


# Parameters -------------------------------------------------------------------------------------------


def _event(logits: Any = None, probs: Any = None) -> Params:
    """Return the parameters of an event: (p, log p, log(1 - p))."""
    if (logits is None) == (probs is None):
        raise BadArguments("a probability is given by exactly one of logits= and probs=")
    if probs is not None:
        return _chance(probs)
    logits = jnp.asarray(logits, jnp.result_type(float))
    return jax.nn.sigmoid(logits), log_sigmoid(logits), log_sigmoid(-logits)


def _chance(p: Any) -> Params:
    p = jnp.asarray(p, jnp.result_type(float))
    return p, jnp.log(p), jnp.log1p(-p)


def _bernoulli(implicit: Any = None, *, logits: Any = None, probs: Any = None) -> Params:
    return _event(_explicit("bernoulli", implicit, logits, probs), probs)


def _class_logits(implicit: Any = None, *, logits: Any = None, probs: Any = None) -> Params:
    logits = _explicit("categorical", implicit, logits, probs)
    return (jnp.log(jnp.asarray(probs)) if logits is None else logits,)


def _explicit(name: str, implicit: Any, logits: Any, probs: Any) -> Any:
    """Return the logits; a positional argument counts as logits, with a warning, because it is easily mistaken."""
    if sum(x is not None for x in (implicit, logits, probs)) != 1:
        raise BadArguments(f"{name} takes exactly one of logits= and probs=")
    if implicit is not None:
        text = f"a bare argument to {name} means logits; say logits= or probs="
        warnings.warn(text, DeprecationWarning, stacklevel=4)
    return implicit if logits is None else logits


def _binomial(total_count: Any, logits: Any = None, probs: Any = None) -> Params:
    return total_count, *_event(logits, probs)[:1]


def _loc_scale(loc: Any, scale: Any) -> Params:
    return loc, scale


def _location_scale(name: str, standard: Callable[..., Any], logpdf: Callable[..., Any]) -> Named:
    """Return the distribution of loc + scale * a draw of `standard`."""
    return _named(name, _loc_scale, lambda key, shape, loc, scale: loc + scale * standard(key, shape), logpdf)


def _event_batch(concentration: Any) -> tuple[int, ...]:
    return jnp.shape(concentration)[:-1]


# Draws and densities ----------------------------------------------------------------------------------


def _real(draw: Callable[..., Any]) -> Callable[..., Any]:
    """Return `draw` with counts as real numbers, as TensorFlow Probability draws them."""
    return lambda *args: draw(*args).astype(jnp.result_type(float))


def _truncated_draw(key: PRNGKey, shape: tuple[int, ...], loc: Any, scale: Any, low: Any, high: Any) -> Any:
    return loc + scale * jr.truncated_normal(key, (low - loc) / scale, (high - loc) / scale, shape)


def _counts(value: Any) -> Any:
    return (value >= 0) & (value == jnp.floor(value))


def _positive(value: Any, logpdf: Any) -> Any:
    return jnp.where(value >= 0, logpdf, -jnp.inf)


def _categorical_logpdf(value: Any, logits: Any) -> Any:
    table = log_softmax(logits)
    k = table.shape[-1]
    shape = jnp.broadcast_shapes(jnp.shape(value), table.shape[:-1])
    table = jnp.broadcast_to(table, (*shape, k))
    index = jnp.broadcast_to(jnp.clip(value, 0, k - 1), shape).astype(jnp.int32)[..., None]
    return jnp.where((value >= 0) & (value < k), jnp.take_along_axis(table, index, axis=-1)[..., 0], -jnp.inf)


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


# Families of JAX --------------------------------------------------------------------------------------

flip = _named(
    "flip", _chance, lambda key, shape, p, *_: jr.uniform(key, shape) < p, lambda v, p, yes, no: jnp.where(v, yes, no)
)
"""True with probability `p`."""
bernoulli = _named(
    "bernoulli", _bernoulli, lambda key, shape, p, *_: (jr.uniform(key, shape) < p).astype(jnp.int32),
    lambda v, p, yes, no: jnp.where(v == 1, yes, jnp.where(v == 0, no, -jnp.inf)),
    support=lambda v: (v == 0) | (v == 1),
)  # fmt: skip
"""1 with probability `probs`, or log odds `logits`; int32."""
categorical = _named(
    "categorical", _class_logits, lambda key, shape, logits: jr.categorical(key, logits, shape=shape),
    _categorical_logpdf, support=_counts, batch=_event_batch,
)  # fmt: skip
"""An index into the last axis of `logits` or `probs`."""
normal = _location_scale("normal", jr.normal, st.norm.logpdf)
uniform = _named(
    "uniform", lambda low, high: (low, high), lambda key, shape, low, high: low + (high - low) * jr.uniform(key, shape),
    lambda v, low, high: jnp.where((v >= low) & (v <= high), -jnp.log(high - low), -jnp.inf),
)  # fmt: skip
beta = _named(
    "beta", lambda concentration1, concentration0: (concentration1, concentration0),
    lambda key, shape, a, b: jr.beta(key, a, b, shape), st.beta.logpdf,
)  # fmt: skip
gamma = _named(
    "gamma",
    lambda concentration, rate: (concentration, rate),
    lambda key, shape, a, rate: jr.gamma(key, a, shape) / rate,
    lambda v, a, rate: st.gamma.logpdf(v, a, scale=1 / rate),
)
inverse_gamma = _named(
    "inverse_gamma", lambda concentration, scale: (concentration, scale),
    lambda key, shape, a, scale: scale / jr.gamma(key, a, shape), _inverse_gamma_logpdf,
)  # fmt: skip
exponential = _named(
    "exponential", lambda rate: (rate,), lambda key, shape, rate: jr.exponential(key, shape) / rate,
    lambda v, rate: _positive(v, jnp.log(rate) - rate * v),
)  # fmt: skip
poisson = _named(
    "poisson", lambda rate: (rate,), _real(lambda key, shape, rate: jr.poisson(key, rate, shape)),
    lambda v, rate: _positive(v, xlogy(v, rate) - rate - gammaln(v + 1.0)), support=_counts,
)  # fmt: skip
geometric = _named(
    "geometric", _event, _real(lambda key, shape, p, *_: jr.geometric(key, p, shape) - 1),
    lambda v, p, yes, no: _positive(v, yes + xlog1py(v, -p)), support=_counts,
)  # fmt: skip
"""The number of failures before the first success."""
binomial = _named(
    "binomial", _binomial, _real(lambda key, shape, n, p: jr.binomial(key, n, p, shape)), st.binom.logpmf,
    support=_counts,
)  # fmt: skip
laplace = _location_scale("laplace", jr.laplace, st.laplace.logpdf)
cauchy = _location_scale("cauchy", jr.cauchy, st.cauchy.logpdf)
gumbel = _location_scale("gumbel", jr.gumbel, lambda v, m, s: -(v - m) / s - jnp.exp(-(v - m) / s) - jnp.log(s))
student_t = _named(
    "student_t", lambda df, loc, scale: (df, loc, scale), lambda key, shape, df, m, s: m + s * jr.t(key, df, shape),
    st.t.logpdf,
)  # fmt: skip
log_normal = _named(
    "log_normal", _loc_scale, lambda key, shape, m, s: jnp.exp(m + s * jr.normal(key, shape)), _log_normal_logpdf
)
half_normal = _named(
    "half_normal", lambda scale: (scale,), lambda key, shape, s: s * jnp.abs(jr.normal(key, shape)),
    lambda v, s: _positive(v, st.norm.logpdf(v, 0.0, s) + jnp.log(2.0)),
)  # fmt: skip
half_cauchy = _named(
    "half_cauchy", _loc_scale, lambda key, shape, m, s: m + s * jnp.abs(jr.cauchy(key, shape)),
    lambda v, m, s: _positive(v - m, st.cauchy.logpdf(v, m, s) + jnp.log(2.0)),
)  # fmt: skip
truncated_normal = _named(
    "truncated_normal", lambda loc, scale, low, high: (loc, scale, low, high), _truncated_draw,
    lambda v, m, s, low, high: st.truncnorm.logpdf(v, (low - m) / s, (high - m) / s, m, s),
)  # fmt: skip
weibull = _named(
    "weibull", lambda concentration, scale: (concentration, scale),
    lambda key, shape, k, s: jr.weibull_min(key, s, k, shape), _weibull_logpdf,
)  # fmt: skip
chi2 = _named("chi2", lambda df: (df,), lambda key, shape, df: 2.0 * jr.gamma(key, df / 2, shape), st.chi2.logpdf)
dirichlet = _named(
    "dirichlet", lambda concentration: (concentration,), lambda key, shape, a: jr.dirichlet(key, a, shape),
    lambda v, a: st.dirichlet.logpdf(jnp.moveaxis(v, -1, 0), a), batch=_event_batch,
)  # fmt: skip
mv_normal = _named(
    "mv_normal", lambda loc, covariance_matrix: (loc, covariance_matrix),
    lambda key, shape, m, cov: jr.multivariate_normal(key, m, cov, shape), st.multivariate_normal.logpdf,
    batch=lambda m, cov: jnp.shape(m)[:-1],
)  # fmt: skip
mv_normal_diag = _named(
    "mv_normal_diag",
    lambda loc, scale_diag=1.0: (loc, scale_diag),
    lambda key, shape, m, s: m + s * jr.normal(key, (*shape, jnp.broadcast_shapes(jnp.shape(m), jnp.shape(s))[-1])),
    lambda v, m, s: jnp.sum(st.norm.logpdf(v, m, s), axis=-1),
    batch=lambda m, s: jnp.broadcast_shapes(jnp.shape(m), jnp.shape(s))[:-1],
)

# Families of TensorFlow Probability -------------------------------------------------------------------


@dataclass
class TfpDistribution(KeywordDensity):
    """The distribution that `make(*args)` returns; `tfp_distribution` makes it."""

    make: Callable[..., Any] = static()
    name: str = static()

    def _made(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[Any, tuple[int, ...]]:
        """Return (the library's distribution, shape of independent draws)."""
        args, kwargs = self.split(args, kwargs)
        shape = draw_shape(kwargs.pop("sample_shape", ()))
        return self.make(*args, **kwargs), shape

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        with warnings.catch_warnings(action="ignore"):  # the library warns of its own use of JAX
            made, shape = self._made(args, kwargs)
            return made.sample(seed=key, sample_shape=shape)

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        with warnings.catch_warnings(action="ignore"):
            return self._made(args, kwargs)[0].log_prob(value)


def tfp_distribution(dist: Callable[..., Any], name: str | None = None) -> TfpDistribution:
    """Return the distribution of a class of `tensorflow_probability.substrates.jax.distributions`, or of a maker."""
    return TfpDistribution(dist, name or dist.__name__)


@dataclasses.dataclass(frozen=True)
class _ByName:
    """A class of the library, imported when it is first called."""

    class_name: str

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        try:
            library = importlib.import_module("tensorflow_probability.substrates.jax.distributions")
        except ModuleNotFoundError:
            raise MissingExtra(
                f"{self.class_name} comes from TensorFlow Probability, which is not installed: pip install tfp-nightly"
            ) from None
        return getattr(library, self.class_name)(*args, **kwargs)


def _tfp(class_name: str, name: str) -> TfpDistribution:
    return TfpDistribution(_ByName(class_name), name)


beta_binomial = _tfp("BetaBinomial", "beta_binomial")
beta_quotient = _tfp("BetaQuotient", "beta_quotient")
chi = _tfp("Chi", "chi")
dirichlet_multinomial = _tfp("DirichletMultinomial", "dirichlet_multinomial")
double_sided_maxwell = _tfp("DoublesidedMaxwell", "double_sided_maxwell")
exp_gamma = _tfp("ExpGamma", "exp_gamma")
exp_inverse_gamma = _tfp("ExpInverseGamma", "exp_inverse_gamma")
half_student_t = _tfp("HalfStudentT", "half_student_t")
inverse_gaussian = _tfp("InverseGaussian", "inverse_gaussian")
kumaraswamy = _tfp("Kumaraswamy", "kumaraswamy")
lambert_w_normal = _tfp("LambertWNormal", "lambert_w_normal")
logit_normal = _tfp("LogitNormal", "logit_normal")
moyal = _tfp("Moyal", "moyal")
multinomial = _tfp("Multinomial", "multinomial")
negative_binomial = _tfp("NegativeBinomial", "negative_binomial")
non_central_chi2 = _tfp("NoncentralChi2", "non_central_chi2")
power_spherical = _tfp("PowerSpherical", "power_spherical")
skellam = _tfp("Skellam", "skellam")
truncated_cauchy = _tfp("TruncatedCauchy", "truncated_cauchy")
von_mises = _tfp("VonMises", "von_mises")
von_mises_fisher = _tfp("VonMisesFisher", "von_mises_fisher")
zipf = _tfp("Zipf", "zipf")
