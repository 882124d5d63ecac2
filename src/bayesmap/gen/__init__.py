"""Generative functions on JAX: traces, choice maps, combinators, edits, inference on traces.

The interface is that of GenJAX 0.10; `docs/coming-from-genjax.md` lists what differs.
"""

from bayesmap.gen.builder import ChoiceMapBuilder
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.closure import Closure
from bayesmap.gen.densities import (
    bernoulli,
    beta,
    binomial,
    categorical,
    cauchy,
    chi2,
    dirichlet,
    exponential,
    flip,
    gamma,
    geometric,
    gumbel,
    half_cauchy,
    half_normal,
    inverse_gamma,
    laplace,
    log_normal,
    mv_normal,
    mv_normal_diag,
    normal,
    poisson,
    student_t,
    truncated_normal,
    uniform,
    weibull,
)
from bayesmap.gen.diff import Change, Diff, IndexChange, NoChange, UnknownChange
from bayesmap.gen.dimap import contramap, dimap, map
from bayesmap.gen.distribution import ExactDensity, exact_density
from bayesmap.gen.errors import (
    AddressError,
    AddressReuse,
    ChoiceMapNoValueAtAddress,
    MissingAddress,
    NotSupportedEditRequest,
    OutsideSupport,
    ShapeMismatch,
    UnknownAddress,
)
from bayesmap.gen.generative_function import (
    EditRequest,
    EmptyRequest,
    GenerativeFunction,
    IndexRequest,
    Regenerate,
    StaticRequest,
    Trace,
    Update,
    VectorRequest,
)
from bayesmap.gen.marginal import marginal
from bayesmap.gen.mask import Mask
from bayesmap.gen.masking import mask
from bayesmap.gen.mcmc import Chain, effective_sample_size, metropolis_hastings, run_chain, split_rhat
from bayesmap.gen.moves import HMC, Rejuvenate, mala
from bayesmap.gen.pretty import pretty, render
from bayesmap.gen.pytree import Pytree
from bayesmap.gen.scan import accumulate, iterate, iterate_final, reduce, scan
from bayesmap.gen.selection import Selection, SelectionBuilder
from bayesmap.gen.smc import Importance, ImportanceK, ParticleCollection, Target, particle_filter
from bayesmap.gen.static import gen
from bayesmap.gen.switch import mix, or_else, switch
from bayesmap.gen.vmap import repeat, vmap

__all__ = [
    "HMC",
    "AddressError",
    "AddressReuse",
    "Chain",
    "Change",
    "ChoiceMap",
    "ChoiceMapBuilder",
    "ChoiceMapNoValueAtAddress",
    "Closure",
    "Diff",
    "EditRequest",
    "EmptyRequest",
    "ExactDensity",
    "GenerativeFunction",
    "Importance",
    "ImportanceK",
    "IndexChange",
    "IndexRequest",
    "Mask",
    "MissingAddress",
    "NoChange",
    "NotSupportedEditRequest",
    "OutsideSupport",
    "ParticleCollection",
    "Pytree",
    "Regenerate",
    "Rejuvenate",
    "Selection",
    "SelectionBuilder",
    "ShapeMismatch",
    "StaticRequest",
    "Target",
    "Trace",
    "UnknownAddress",
    "UnknownChange",
    "Update",
    "VectorRequest",
    "accumulate",
    "bernoulli",
    "beta",
    "binomial",
    "categorical",
    "cauchy",
    "chi2",
    "contramap",
    "dimap",
    "dirichlet",
    "effective_sample_size",
    "exact_density",
    "exponential",
    "flip",
    "gamma",
    "gen",
    "geometric",
    "gumbel",
    "half_cauchy",
    "half_normal",
    "inverse_gamma",
    "iterate",
    "iterate_final",
    "laplace",
    "log_normal",
    "mala",
    "map",
    "marginal",
    "mask",
    "metropolis_hastings",
    "mix",
    "mv_normal",
    "mv_normal_diag",
    "normal",
    "or_else",
    "particle_filter",
    "poisson",
    "pretty",
    "reduce",
    "render",
    "repeat",
    "run_chain",
    "scan",
    "split_rhat",
    "student_t",
    "switch",
    "truncated_normal",
    "uniform",
    "vmap",
    "weibull",
]
