"""GenJAX 0.10.3's own tests pass but for those that docs/coming-from-genjax.md lists; its programs run under the alias.

The tests are not part of the project, and are skipped where they are absent. All of them take two minutes.
"""

import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from run_peer_tests import outcomes

PAGE = Path(__file__).resolve().parents[2] / "docs" / "coming-from-genjax.md"
LISTED = frozenset(re.findall(r"`(test_\w+\.py(?:::\w+)*)`", PAGE.read_text(encoding="utf-8")))
SOME = (
    "core/generative/test_functional_types.py",
    "generative_functions/test_or_else.py",
    "generative_functions/test_dimap_combinator.py",
)
"""Three quick files; one test of each is listed."""

PRIMITIVES = "test_distributions.py::TestDistributions::test_using_primitive_distributions"
"""It uses distributions that are TensorFlow Probability's, an optional package."""


def failed(found):
    return {name for name, passed in found.items() if not passed}


def test_only_the_listed_tests_of_three_files_fail():
    found = outcomes(*SOME)
    files = tuple(Path(name).name for name in SOME)
    assert failed(found) == {name for name in LISTED if name.startswith(files)}
    assert len(found) > len(SOME) + 10


@pytest.mark.full
def test_just_the_listed_tests_of_genjax_do_not_pass():
    found = outcomes()
    assert failed(found) == LISTED | (set() if find_spec("tensorflow_probability") else {PRIMITIVES})
    assert sum(found.values()) >= 205


PROGRAM = """
import genjax_alias
import jax, jax.numpy as jnp
import genjax
import genjax._src.core.pytree as pytree
from genjax import ChoiceMapBuilder as C
from genjax import Target, gen, normal, requests, smc
from genjax._src.core.generative import Argdiffs, Retdiff, Weight
from genjax._src.core.generative.choice_map import ChoiceMap, Selection
from genjax._src.core.pytree import Const, Pytree
from genjax._src.core.typing import FloatArray, PRNGKey
from genjax._src.generative_functions.combinators.vmap import Vmap
from genjax._src.generative_functions.distributions.distribution import Distribution, ExactDensity, exact_density
from genjax._src.generative_functions.distributions.tensorflow_probability import negative_binomial
from genjax._src.generative_functions.static import StaticRequest
from genjax._src.inference.smc import ImportanceK
from genjax.core import *
from genjax.generative_functions.distributions import flip
from genjax.incremental import Diff
from genjax.inference.smc import Importance
from genjax.pretty import pretty

assert pytree.Pytree is Pytree is genjax.Pytree and ChoiceMap is genjax.ChoiceMap and Vmap is genjax.Vmap
assert smc.ImportanceK is ImportanceK and requests.HMC is genjax.HMC and StaticRequest is genjax.StaticRequest

@Pytree.dataclass
class Shifted(ExactDensity):
    by: float = Pytree.static(default=1.0)

    def sample(self, key: PRNGKey, loc):
        return loc + self.by + jax.random.normal(key)

    def logpdf(self, value, loc):
        return jax.scipy.stats.norm.logpdf(value, loc + self.by)

@gen
def model():
    x = Shifted()(0.0) @ "x"
    y = normal(x, 1.0) @ "y"

target = Target(model, (), C["y"].set(3.0))
particles = smc.ImportanceK(target, k_particles=20_000).run_smc(jax.random.key(0))
log_z = particles.get_log_marginal_likelihood_estimate()
exact = jax.scipy.stats.norm.logpdf(3.0, 1.0, jnp.sqrt(2.0))
assert abs(log_z - exact) < 0.05, (log_z, exact)

from importlib import import_module
for name in genjax_alias.MODULES:
    import_module(name)
for absent in ("genjax.adev", "genjax.inference.vi", "genjax.nonsense"):
    try:
        import_module(absent)
    except ModuleNotFoundError:
        continue
    raise AssertionError(absent)
"""


def test_a_program_with_genjax_s_paths_runs_under_the_alias():
    """In a process of its own: the alias replaces modules. 20 000 particles err by 0.008 (a standard deviation)."""
    pytest.importorskip("tensorflow_probability")
    here = Path(__file__).parent
    done = subprocess.run([sys.executable, "-c", PROGRAM], cwd=here, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
