"""Distributions from TensorFlow Probability's JAX substrate: any of them, and by name the less common ones.

TensorFlow Probability must be installed: it is no dependency, since its releases lag behind JAX and its nightly builds
(`tfp-nightly`) follow it. The common distributions, in `densities.py`, do not need it.
"""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

import dataclasses
import importlib
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from bayesmap.gen.distribution import ExactDensity, draw_shape
from bayesmap.gen.errors import MissingExtra
from bayesmap.gen.generative_function import GenerativeFunction
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.typing import PRNGKey


@contextmanager
def _quiet() -> Iterator[None]:
    """Without the library's warnings, which are about its own use of JAX."""
    with warnings.catch_warnings():
        for category in (DeprecationWarning, FutureWarning, UserWarning):
            warnings.simplefilter("ignore", category)
        yield


@dataclass
class TfpDistribution(ExactDensity):
    """The distribution `make(*args)`; made by `tfp_distribution`."""

    make: Callable[..., Any] = static()
    name: str = static()
    by_name: bool = static(default=False)

    def handle_kwargs(self) -> GenerativeFunction:
        return self.replace(by_name=True)

    def _made(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[Any, tuple[int, ...]]:
        """(The library's distribution, shape of independent draws)."""
        if self.by_name:
            args, kwargs = args[0], {**args[1], **kwargs}
        shape = draw_shape(kwargs.get("sample_shape", ()))
        return self.make(*args, **{k: v for k, v in kwargs.items() if k != "sample_shape"}), shape

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        with _quiet():
            made, shape = self._made(args, kwargs)
            return made.sample(seed=key, sample_shape=shape)

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        with _quiet():
            return self._made(args, kwargs)[0].log_prob(value)


def tfp_distribution(dist: Callable[..., Any], name: str | None = None) -> TfpDistribution:
    """A distribution from a class of `tensorflow_probability.substrates.jax.distributions`, or from a maker of one."""
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


def _named(class_name: str, name: str) -> TfpDistribution:
    return TfpDistribution(_ByName(class_name), name)


beta_binomial = _named("BetaBinomial", "beta_binomial")
beta_quotient = _named("BetaQuotient", "beta_quotient")
chi = _named("Chi", "chi")
dirichlet_multinomial = _named("DirichletMultinomial", "dirichlet_multinomial")
double_sided_maxwell = _named("DoublesidedMaxwell", "double_sided_maxwell")
exp_gamma = _named("ExpGamma", "exp_gamma")
exp_inverse_gamma = _named("ExpInverseGamma", "exp_inverse_gamma")
half_student_t = _named("HalfStudentT", "half_student_t")
inverse_gaussian = _named("InverseGaussian", "inverse_gaussian")
kumaraswamy = _named("Kumaraswamy", "kumaraswamy")
lambert_w_normal = _named("LambertWNormal", "lambert_w_normal")
logit_normal = _named("LogitNormal", "logit_normal")
moyal = _named("Moyal", "moyal")
multinomial = _named("Multinomial", "multinomial")
negative_binomial = _named("NegativeBinomial", "negative_binomial")
non_central_chi2 = _named("NoncentralChi2", "non_central_chi2")
power_spherical = _named("PowerSpherical", "power_spherical")
skellam = _named("Skellam", "skellam")
truncated_cauchy = _named("TruncatedCauchy", "truncated_cauchy")
von_mises = _named("VonMises", "von_mises")
von_mises_fisher = _named("VonMisesFisher", "von_mises_fisher")
zipf = _named("Zipf", "zipf")
