"""The named distributions, with TensorFlow Probability's parameters and, where they are simple, its draws.

A distribution of JAX is a `Family` of three functions: parameters, sampler, log density. The helpers before the table
of families make such functions. The less common distributions come from TensorFlow Probability when they are used. This
library is no dependency, since its releases lag behind JAX; its nightly builds (`tfp-nightly`) follow JAX.
"""

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
    """A family of distributions: the functions that read its parameters, draw from it, and score values."""

    parameters: Callable[..., Params]  # (a user's arguments) -> parameters
    draw: Callable[..., Any]  # (key, shape of independent draws, *parameters) -> draws
    logpdf: Callable[..., Any]  # (value, *parameters) -> log density, elementwise
    support: Callable[[Any], Any] = lambda value: True  # (value) -> whether any parameters can give the value
    # (*parameters) -> the shape of independent draws that the parameters imply
    batch: Callable[..., tuple[int, ...]] = lambda *params: jnp.broadcast_shapes(*map(jnp.shape, params))


_FAMILIES: dict[str, Family] = {}  # families by the name of the distribution


@dataclass
class Named(KeywordDensity):
    """The distribution of the family that `_FAMILIES` stores under `name`."""

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
        """Return draws of shape `sample_shape + batch shape of the parameters + shape of one draw`."""
        family, (shape, params) = _FAMILIES[self.name], self._parameters(args, kwargs)
        return family.draw(key, (*shape, *family.batch(*params)), *params)

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        return _FAMILIES[self.name].logpdf(value, *self._parameters(args, kwargs)[1])

    def in_support(self, value: Any) -> Any:
        return _FAMILIES[self.name].support(value)


def _named(name: str, parameters: str | Callable[..., Params], draw: Any, logpdf: Any, **more: Any) -> Named:
    """Register a family, and return its distribution. `parameters` are names, or the function of `Family`."""
    read = _parameters_named(parameters) if isinstance(parameters, str) else parameters
    _FAMILIES[name] = Family(read, draw, logpdf, **more)
    return Named(name)


def _parameters_named(names: str) -> Callable[..., Params]:
    """Return a function whose parameters have these names, separated by blanks. It returns its arguments."""
    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    signature = inspect.Signature([inspect.Parameter(name, kind) for name in names.split()])

    def read(*args: Any, **kwargs: Any) -> Params:
        return signature.bind(*args, **kwargs).args

    read.__signature__ = signature  # type: ignore[attr-defined]
    return read


def _event(logits: Any = None, probs: Any = None) -> Params:
    """Return the parameters of an event: (p, log p, log(1 - p))."""
    if (logits is None) == (probs is None):
        raise BadArguments("a probability is given by exactly one of logits= and probs=")
    if probs is not None:
        return _chance(probs)
    logits = jnp.asarray(logits, jnp.result_type(float))
    return jax.nn.sigmoid(logits), log_sigmoid(logits), log_sigmoid(-logits)


def _chance(p: Any) -> Params:
    """Return (p, log p, log(1 - p))."""
    p = jnp.asarray(p, jnp.result_type(float))
    return p, jnp.log(p), jnp.log1p(-p)


def _bernoulli(implicit: Any = None, *, logits: Any = None, probs: Any = None) -> Params:
    """Return the parameters of `bernoulli`, as `_event` does."""
    return _event(_explicit("bernoulli", implicit, logits, probs), probs)


def _class_logits(implicit: Any = None, *, logits: Any = None, probs: Any = None) -> Params:
    """Return the parameter of `categorical`: logits, up to a constant, (..., number of classes)."""
    logits = _explicit("categorical", implicit, logits, probs)
    return (jnp.log(jnp.asarray(probs)) if logits is None else logits,)


def _explicit(name: str, implicit: Any, logits: Any, probs: Any) -> Any:
    """Return the logits, or None if `probs` is given. A positional argument counts as logits, with a warning."""
    if sum(x is not None for x in (implicit, logits, probs)) != 1:
        raise BadArguments(f"{name} takes exactly one of logits= and probs=")
    if implicit is not None:
        text = f"a bare argument to {name} means logits; say logits= or probs="
        warnings.warn(text, DeprecationWarning, stacklevel=4)
    return implicit if logits is None else logits


def _event_batch(parameter: Any, *others: Any) -> tuple[int, ...]:
    """Return the batch shape of a parameter whose last axis belongs to one draw."""
    return jnp.shape(parameter)[:-1]


def _scaled(standard: Callable[..., Any]) -> Callable[..., Any]:
    """Return the sampler of loc + scale * a draw of `standard`."""
    return lambda key, shape, loc, scale: loc + scale * standard(key, shape)


def _shaped(draw: Callable[..., Any]) -> Callable[..., Any]:
    """Return a sampler of JAX, whose last argument is the shape, in our order of arguments."""
    return lambda key, shape, *params: draw(key, *params, shape)  # noqa: PLW0108 - it reorders the arguments


def _real(draw: Callable[..., Any]) -> Callable[..., Any]:
    """Return `_shaped(draw)` with counts as real numbers, as TensorFlow Probability draws them."""
    return lambda key, shape, *params: draw(key, *params, shape).astype(jnp.result_type(float))


def _counts(value: Any) -> Any:
    """Return elementwise whether the value is 0, 1, 2, ..."""
    return (value >= 0) & (value == jnp.floor(value))


def _masked_to_nonnegative(value: Any, logpdf: Any) -> Any:
    """Return the log density, or -inf where the value is negative."""
    return jnp.where(value >= 0, logpdf, -jnp.inf)


def _categorical_logpdf(value: Any, logits: Any) -> Any:
    """Return the log probability of each class number; -inf for a number that is no class."""
    log_p = log_softmax(logits)
    n_classes = log_p.shape[-1]
    shape = jnp.broadcast_shapes(jnp.shape(value), log_p.shape[:-1])
    log_p = jnp.broadcast_to(log_p, (*shape, n_classes))
    index = jnp.broadcast_to(jnp.clip(value, 0, n_classes - 1), shape).astype(jnp.int32)[..., None]
    in_range = (value >= 0) & (value < n_classes)
    return jnp.where(in_range, jnp.take_along_axis(log_p, index, axis=-1)[..., 0], -jnp.inf)


def _logpdf_on_positive(logpdf: Callable[..., Any]) -> Callable[..., Any]:
    """Return a log density that is -inf, with gradient 0, for values that are not positive."""
    return lambda v, *params: jnp.where(v > 0, logpdf(jnp.where(v > 0, v, 1.0), *params), -jnp.inf)


# Families of JAX. In the lambdas v is a value, m a location and s a scale; `yes` and `no` are log p and log(1 - p).

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
    "categorical", _class_logits, _shaped(lambda key, logits, shape: jr.categorical(key, logits, shape=shape)),
    _categorical_logpdf, support=_counts, batch=_event_batch,
)  # fmt: skip
"""An index into the last axis of `logits` or `probs`."""
normal = _named("normal", "loc scale", _scaled(jr.normal), st.norm.logpdf)
uniform = _named(
    "uniform", "low high", lambda key, shape, low, high: low + (high - low) * jr.uniform(key, shape),
    lambda v, low, high: jnp.where((v >= low) & (v <= high), -jnp.log(high - low), -jnp.inf),
)  # fmt: skip
beta = _named("beta", "concentration1 concentration0", _shaped(jr.beta), st.beta.logpdf)
gamma = _named(
    "gamma", "concentration rate", lambda key, shape, a, rate: jr.gamma(key, a, shape) / rate,
    lambda v, a, rate: st.gamma.logpdf(v, a, scale=1 / rate),
)  # fmt: skip
inverse_gamma = _named(
    "inverse_gamma", "concentration scale", lambda key, shape, a, scale: scale / jr.gamma(key, a, shape),
    _logpdf_on_positive(lambda v, a, scale: a * jnp.log(scale) - gammaln(a) - (a + 1) * jnp.log(v) - scale / v),
)  # fmt: skip
exponential = _named(
    "exponential", "rate", lambda key, shape, rate: jr.exponential(key, shape) / rate,
    lambda v, rate: _masked_to_nonnegative(v, jnp.log(rate) - rate * v),
)  # fmt: skip
poisson = _named(
    "poisson", "rate", _real(jr.poisson),
    lambda v, rate: _masked_to_nonnegative(v, xlogy(v, rate) - rate - gammaln(v + 1.0)), support=_counts,
)  # fmt: skip
geometric = _named(
    "geometric", _event, lambda key, shape, p, *_: (jr.geometric(key, p, shape) - 1).astype(jnp.result_type(float)),
    lambda v, p, yes, no: _masked_to_nonnegative(v, yes + xlog1py(v, -p)), support=_counts,
)  # fmt: skip
"""The number of failures before the first success."""
binomial = _named(
    "binomial", lambda total_count, logits=None, probs=None: (total_count, *_event(logits, probs)[:1]),
    _real(jr.binomial), st.binom.logpmf, support=_counts,
)  # fmt: skip
laplace = _named("laplace", "loc scale", _scaled(jr.laplace), st.laplace.logpdf)
cauchy = _named("cauchy", "loc scale", _scaled(jr.cauchy), st.cauchy.logpdf)
gumbel = _named(
    "gumbel", "loc scale", _scaled(jr.gumbel), lambda v, m, s: -(v - m) / s - jnp.exp(-(v - m) / s) - jnp.log(s)
)
student_t = _named("student_t", "df loc scale", lambda key, shape, df, m, s: m + s * jr.t(key, df, shape), st.t.logpdf)
log_normal = _named(
    "log_normal", "loc scale", lambda key, shape, m, s: jnp.exp(m + s * jr.normal(key, shape)),
    _logpdf_on_positive(lambda v, m, s: st.norm.logpdf(jnp.log(v), m, s) - jnp.log(v)),
)  # fmt: skip
half_normal = _named(
    "half_normal", "scale", lambda key, shape, s: s * jnp.abs(jr.normal(key, shape)),
    lambda v, s: _masked_to_nonnegative(v, st.norm.logpdf(v, 0.0, s) + jnp.log(2.0)),
)  # fmt: skip
half_cauchy = _named(
    "half_cauchy", "loc scale", lambda key, shape, m, s: m + s * jnp.abs(jr.cauchy(key, shape)),
    lambda v, m, s: _masked_to_nonnegative(v - m, st.cauchy.logpdf(v, m, s) + jnp.log(2.0)),
)  # fmt: skip
truncated_normal = _named(
    "truncated_normal", "loc scale low high",
    lambda key, shape, m, s, low, high: m + s * jr.truncated_normal(key, (low - m) / s, (high - m) / s, shape),
    lambda v, m, s, low, high: st.truncnorm.logpdf(v, (low - m) / s, (high - m) / s, m, s),
)  # fmt: skip
weibull = _named(
    "weibull", "concentration scale", lambda key, shape, k, s: jr.weibull_min(key, s, k, shape),
    _logpdf_on_positive(lambda v, k, s: jnp.log(k / s) + (k - 1) * jnp.log(v / s) - (v / s) ** k),
)  # fmt: skip
chi2 = _named("chi2", "df", lambda key, shape, df: 2.0 * jr.gamma(key, df / 2, shape), st.chi2.logpdf)
dirichlet = _named(
    "dirichlet", "concentration", _shaped(jr.dirichlet),
    lambda v, a: st.dirichlet.logpdf(jnp.moveaxis(v, -1, 0), a), batch=_event_batch,
)  # fmt: skip
mv_normal = _named(
    "mv_normal", "loc covariance_matrix", _shaped(jr.multivariate_normal), st.multivariate_normal.logpdf,
    batch=_event_batch,
)  # fmt: skip
mv_normal_diag = _named(
    "mv_normal_diag", lambda loc, scale_diag=1.0: (loc, scale_diag),
    lambda key, shape, m, s: m + s * jr.normal(key, (*shape, jnp.broadcast_shapes(jnp.shape(m), jnp.shape(s))[-1])),
    lambda v, m, s: jnp.sum(st.norm.logpdf(v, m, s), axis=-1),
    batch=lambda m, s: jnp.broadcast_shapes(jnp.shape(m), jnp.shape(s))[:-1],
)  # fmt: skip


@dataclass
class TfpDistribution(KeywordDensity):
    """The distribution that `make(*args)` returns, an object of TensorFlow Probability. See `tfp_distribution`."""

    make: Callable[..., Any] = static()  # (*args) -> TensorFlow Probability's distribution
    name: str = static()

    def _make(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[Any, tuple[int, ...]]:
        """Return (TensorFlow Probability's distribution, shape of independent draws)."""
        args, kwargs = self.split(args, kwargs)
        shape = draw_shape(kwargs.pop("sample_shape", ()))
        return self.make(*args, **kwargs), shape

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        with warnings.catch_warnings(action="ignore"):  # the library warns of its own use of JAX
            distribution, shape = self._make(args, kwargs)
            return distribution.sample(seed=key, sample_shape=shape)

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        with warnings.catch_warnings(action="ignore"):
            return self._make(args, kwargs)[0].log_prob(value)


def tfp_distribution(dist: Callable[..., Any], name: str | None = None) -> TfpDistribution:
    """Return the distribution of a class of `tensorflow_probability.substrates.jax.distributions`, or of a function."""
    return TfpDistribution(dist, name or dist.__name__)


@dataclasses.dataclass(frozen=True)
class _ByName:
    """A class of TensorFlow Probability, which is imported when the class is first called."""

    class_name: str

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        try:
            library = importlib.import_module("tensorflow_probability.substrates.jax.distributions")
        except ModuleNotFoundError:
            raise MissingExtra(
                f"{self.class_name} comes from TensorFlow Probability, which is not installed: pip install tfp-nightly"
            ) from None
        return getattr(library, self.class_name)(*args, **kwargs)


def _tfp(class_name: str) -> TfpDistribution:
    """Return the distribution of a class of TensorFlow Probability, which is imported when it is first used."""
    return TfpDistribution(_ByName(class_name), class_name)


beta_binomial = _tfp("BetaBinomial")
beta_quotient = _tfp("BetaQuotient")
chi = _tfp("Chi")
dirichlet_multinomial = _tfp("DirichletMultinomial")
double_sided_maxwell = _tfp("DoublesidedMaxwell")
exp_gamma = _tfp("ExpGamma")
exp_inverse_gamma = _tfp("ExpInverseGamma")
half_student_t = _tfp("HalfStudentT")
inverse_gaussian = _tfp("InverseGaussian")
kumaraswamy = _tfp("Kumaraswamy")
lambert_w_normal = _tfp("LambertWNormal")
logit_normal = _tfp("LogitNormal")
moyal = _tfp("Moyal")
multinomial = _tfp("Multinomial")
negative_binomial = _tfp("NegativeBinomial")
non_central_chi2 = _tfp("NoncentralChi2")
power_spherical = _tfp("PowerSpherical")
skellam = _tfp("Skellam")
truncated_cauchy = _tfp("TruncatedCauchy")
von_mises = _tfp("VonMises")
von_mises_fisher = _tfp("VonMisesFisher")
zipf = _tfp("Zipf")
