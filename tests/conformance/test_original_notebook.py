"""The original tutorial's code cells, run as they are: imports changed, pictures stubbed, fewer samples.

The notebook is not part of the project; the tests skip where it is absent.
"""

import sys
import types

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from run_peer_tests import notebook_cells

import bayesmap.gen as genjax

pytestmark = pytest.mark.full

SHORTER = {"num_samples=100": "num_samples=3", "N=100000": "N=200", "num_frames = 100": "num_frames = 1"}
"""100 samples take minutes."""


class Picture:
    """Stands for whatever the plotting library would make."""

    def __getattr__(self, name):
        return Picture()

    def __call__(self, *args, **kwargs):
        return Picture()

    def __add__(self, other):
        return Picture()

    __radd__ = __and__ = __rand__ = __or__ = __ror__ = __add__


def stubs():
    """The modules that draw, and penzai, whose dataclasses are ours where it is not installed."""
    plot = types.ModuleType("genstudio.plot")
    plot.__getattr__ = lambda name: Picture()
    studio = types.ModuleType("genstudio")
    studio.plot = plot
    penzai = types.ModuleType("penzai")
    penzai.pz = types.SimpleNamespace(pytree_dataclass=genjax.Pytree.dataclass)
    return {"genstudio": studio, "genstudio.plot": plot, "penzai": penzai}


@pytest.fixture(scope="module")
def names():
    """Everything that the notebook defines, in its last state, and the chains that it overwrites."""
    import matplotlib

    cells = [shortened(cell) for cell in notebook_cells()]
    matplotlib.use("Agg")
    names = {"display": lambda value: None, "chains": []}
    with pytest.MonkeyPatch.context() as patch:
        for name, module in {**stubs(), "genjax": genjax, "genjax.typing": genjax.typing}.items():
            patch.setitem(sys.modules, name, module)
        with pytest.warns(DeprecationWarning, match="bare argument to categorical"):
            run(cells, names)
    return names


def shortened(cell):
    for long, short in SHORTER.items():
        cell = cell.replace(long, short)
    return cell


def run(cells, names):
    for cell in cells:
        exec(compile(cell, "a cell of the notebook", "exec"), names)
        if "run_gibbs_chain(" in cell and "gibbs_chain = " in cell:
            names["chains"].append(names["gibbs_chain"])


def test_every_cell_runs_and_draws_what_it_drew_on_genjax_and_walls_stay_floats(names):
    """The golden figures of GenJAX 0.10.3: walls of a draw from the prior, readings, the first states of Gibbs."""
    assert int(names["true_walls"].sum()) == 54
    np.testing.assert_allclose(names["observed_readings"].sum(), 1225.6375, rtol=1e-6)
    simple, radial, sparse, block = names["chains"]
    assert [int(state.sum()) for state in simple] == [0, 219, 203]
    for chain in (radial, sparse, block, names["gibbs_chain_incremental"]):
        assert chain.shape == (3, 21, 21)
        assert 0 < int(chain[-1].sum()) < 21 * 21
    assert all(chain.dtype == jnp.float32 for chain in names["chains"])
    assert names["gibbs_chain_incremental"].dtype == jnp.float32
    args = (names["CENTER"], names["DEFAULT_PARAMS"])
    chm = names["C"]["readings"].set(names["observed_readings"]) | names["C"]["walls"].set(jnp.zeros((21, 21)))
    walls, readings = jax.eval_shape(names["full_model"].assess, chm, args)[1]
    assert (walls.dtype, readings.dtype) == (jnp.float32, jnp.float32)
