"""Generative functions on JAX: traces, choice maps, combinators, edits, inference on traces.

The interface is that of GenJAX 0.10; `docs/coming-from-genjax.md` lists what differs.
"""

try:
    import jax as _jax  # noqa: F401 -- the first import says what is missing
except ModuleNotFoundError:
    raise ImportError("bayesmap.gen needs JAX: pip install 'bayesmap[gen]'") from None

# isort: off
# fmt: off
from bayesmap.gen import inference
from bayesmap.gen.choice_map import ChoiceMap, ChoiceMapBuilder
from bayesmap.gen.closure import Dimap, GenerativeFunctionClosure, contramap, dimap, map
from bayesmap.gen.densities import (
    bernoulli, beta, beta_binomial, beta_quotient, binomial, categorical, cauchy, chi, chi2, dirichlet,
    dirichlet_multinomial, double_sided_maxwell, exp_gamma, exp_inverse_gamma, exponential, flip, gamma, geometric,
    gumbel, half_cauchy, half_normal, half_student_t, inverse_gamma, inverse_gaussian, kumaraswamy,
    lambert_w_normal, laplace, log_normal, logit_normal, moyal, multinomial, mv_normal, mv_normal_diag,
    negative_binomial, non_central_chi2, normal, poisson, power_spherical, skellam, student_t, tfp_distribution,
    truncated_cauchy, truncated_normal, uniform, von_mises, von_mises_fisher, weibull, zipf,
)
from bayesmap.gen.diff import Change, Diff, IndexChange, NoChange, UnknownChange
from bayesmap.gen.distribution import Distribution, ExactDensity, exact_density
from bayesmap.gen.edits import (
    DiffAnnotate, EditRequest, EmptyRequest, IndexRequest, Regenerate, StaticRequest, Update, VectorRequest,
)
from bayesmap.gen.errors import (
    AddressError, AddressReuse, BadArguments, ChoiceMapNoValueAtAddress, MissingAddress, MissingExtra,
    NotSupportedEditRequest, OutsideSupport, ShapeMismatch, UnknownAddress,
)
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.hidden_markov import DiscreteHMM, DiscreteHMMConfiguration
from bayesmap.gen.inference import requests, smc
from bayesmap.gen.inference.marginal import Marginal, marginal
from bayesmap.gen.inference.mcmc import Chain, effective_sample_size, metropolis_hastings, run_chain, split_rhat
from bayesmap.gen.inference.requests import HMC, Rejuvenate, SafeHMC, mala
from bayesmap.gen.inference.smc import (
    Algorithm, ChangeTarget, Importance, ImportanceK, ParticleCollection, SMCAlgorithm, SampleDistribution, Target,
    particle_filter,
)
from bayesmap.gen.masks import Mask, do_checkify
from bayesmap.gen.outline import pretty, render
from bayesmap.gen.pytree import Closure, Const, PythonicPytree, Pytree, nth
from bayesmap.gen.scan import (
    Scan, accumulate, iterate, iterate_final, masked_iterate, masked_iterate_final, reduce, scan,
)
from bayesmap.gen.selection import Selection, SelectionBuilder
from bayesmap.gen.static import StaticGenerativeFunction, gen
from bayesmap.gen.switch import MaskCombinator, Switch, mask, mix, or_else, switch
from bayesmap.gen.typing import Address, AddressComponent, Argdiffs, Arguments, Retdiff, Score, Weight
from bayesmap.gen.vmap import Vmap, repeat, vmap

__all__ = [
    "HMC", "Address", "AddressComponent", "AddressError", "AddressReuse", "Algorithm", "Argdiffs", "Arguments",
    "BadArguments", "Chain", "Change", "ChangeTarget", "ChoiceMap", "ChoiceMapBuilder", "ChoiceMapNoValueAtAddress",
    "Closure", "Const", "Diff", "DiffAnnotate", "Dimap", "DiscreteHMM", "DiscreteHMMConfiguration", "Distribution",
    "EditRequest", "EmptyRequest", "ExactDensity", "GenerativeFunction", "GenerativeFunctionClosure", "Importance",
    "ImportanceK", "IndexChange", "IndexRequest", "Marginal", "Mask", "MaskCombinator", "MissingAddress",
    "MissingExtra", "NoChange", "NotSupportedEditRequest", "OutsideSupport", "ParticleCollection", "PythonicPytree",
    "Pytree", "Regenerate", "Rejuvenate", "Retdiff", "SMCAlgorithm", "SafeHMC", "SampleDistribution", "Scan", "Score",
    "Selection", "SelectionBuilder", "ShapeMismatch", "StaticGenerativeFunction", "StaticRequest", "Switch", "Target",
    "Trace", "UnknownAddress", "UnknownChange", "Update", "VectorRequest", "Vmap", "Weight", "accumulate",
    "bernoulli", "beta", "beta_binomial", "beta_quotient", "binomial", "categorical", "cauchy", "chi", "chi2",
    "contramap", "dimap", "dirichlet", "dirichlet_multinomial", "do_checkify", "double_sided_maxwell",
    "effective_sample_size", "exact_density", "exp_gamma", "exp_inverse_gamma", "exponential", "flip", "gamma", "gen",
    "geometric", "gumbel", "half_cauchy", "half_normal", "half_student_t", "inference", "inverse_gamma",
    "inverse_gaussian", "iterate", "iterate_final", "kumaraswamy", "lambert_w_normal", "laplace", "log_normal",
    "logit_normal", "mala", "map", "marginal", "mask", "masked_iterate", "masked_iterate_final",
    "metropolis_hastings", "mix", "moyal", "multinomial", "mv_normal", "mv_normal_diag", "negative_binomial",
    "non_central_chi2", "normal", "nth", "or_else", "particle_filter", "poisson", "power_spherical", "pretty",
    "reduce", "render", "repeat", "requests", "run_chain", "scan", "skellam", "smc", "split_rhat", "student_t",
    "switch", "tfp_distribution", "truncated_cauchy", "truncated_normal", "uniform", "vmap", "von_mises",
    "von_mises_fisher", "weibull", "zipf",
]
# fmt: on
# isort: on
