import numpy as np
import pytest

import bayesmap as bm
from bayesmap.cells.kinds import prior_from


@pytest.mark.parametrize("prior", [bm.Beta(), bm.Beta(0.5, 3.0), bm.Surface(), bm.Surface(0.1, 2, 0.3, 0.2, 4.5)])
def test_a_prior_comes_back_from_its_description(prior):
    assert prior_from(prior.describe()) == prior


@pytest.mark.parametrize("prior", [bm.Beta(0.5, 1.5), bm.Surface(0.5, 1.5)])
def test_the_mean_is_the_share_of_stopped_beams(prior):
    assert prior.mean == 0.25


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
@pytest.mark.parametrize("kind", [bm.Beta, bm.Surface])
@pytest.mark.parametrize("which", ["a", "b"])
def test_counts_must_be_positive_numbers(kind, which, value):
    with pytest.raises(bm.BadInput, match=f"{kind.__name__}: {which} must be a positive number"):
        kind(**{which: value})


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
@pytest.mark.parametrize("which", ["mean_scale", "spread", "size_scale"])
def test_sizes_must_be_positive_numbers(which, value):
    with pytest.raises(bm.BadInput, match=f"{which} must be a positive number of cells"):
        bm.Surface(**{which: value})


@pytest.mark.parametrize("value", [1.0, 0.5, np.nan, np.inf])
def test_degrees_of_freedom_must_exceed_one(value):
    with pytest.raises(bm.BadInput, match="dof must exceed 1"):
        bm.Surface(dof=value)


def test_surfaces_that_can_hardly_be_as_small_as_they_must_are_refused():
    """Draws are thinned out by their size: of such a prior next to none would be left."""
    with pytest.raises(bm.BadInput, match="spread must not exceed 3 times size_scale"):
        bm.Surface(spread=1.0, size_scale=0.2)
    assert bm.Surface(spread=0.9, size_scale=0.31).sample_surfaces(np.random.default_rng(1), 100).shape == (100, 5)


def test_the_old_names_of_a_surface_s_numbers_still_work():
    old = bm.Surface(wander=0.3, extent=0.5)
    assert old == bm.Surface(mean_scale=0.3, size_scale=0.5)
    assert (old.wander, old.extent) == (0.3, 0.5)
    assert prior_from(
        {"kind": "surface", "a": 0.1, "b": 0.2, "wander": 0.3, "spread": 0.2, "dof": 3.0, "extent": 0.5}
    ) == (bm.Surface(0.1, 0.2, 0.3, 0.2, 3.0, 0.5))
