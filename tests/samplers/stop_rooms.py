"""A room with glass in it, and scans of it: small, but of every kind of reading."""

from functools import cache

import numpy as np
from flat_options import grouped

import bayesmap as bm
from bayesmap.cells.surface import PARTS

TRUTH = bm.BeamMixture(bm.Gaussian(0.03, 0.004), p_random=0.04, p_no_return=0.06, p_short=0.08, rate_short_per_m=0.7)
GRID = bm.Grid((30, 24), resolution=0.2)
PRIORS = {"reflectivities": bm.Beta(), "surfaces": bm.Surface()}
LABELLED = {"labelled surfaces": bm.Surface(coupling=1.0), "labelled reflectivities": bm.Beta(coupling=0.8)}


def room():
    """A box with a pillar, (30, 24), and the opacity of its cells: one wall is glass."""
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[1:-1, [1, -2]] = walls[[1, -2], 1:-1] = True
    walls[12:15, 10:13] = True
    opacity = np.ones(GRID.shape)
    opacity[:, -2] = 0.5
    return walls, opacity


@cache
def scans(poses=30, beams=40, sensor=TRUTH, seed=1, max_range_m=6.0):
    walls, opacity = room()
    rng = np.random.default_rng(seed)
    free = np.argwhere(~walls[3:-3, 3:-3]) + 3
    xy = (free[rng.choice(len(free), poses)] + rng.uniform(0.1, 0.9, (poses, 2))) * GRID.resolution
    where = np.column_stack([xy, rng.uniform(-np.pi, np.pi, poses)])
    angles = np.linspace(-np.pi, np.pi, beams, endpoint=False)
    return bm.simulate(
        walls, GRID, where, angles, sensor=sensor, max_range_m=max_range_m, min_range_m=0.1, seed=seed, opacity=opacity
    )


def infer(kind, data=None, **options):
    """A short run; everything but the room can be changed."""
    chosen = {"prior": (PRIORS | LABELLED)[kind], "sensor": "fit", "chains": 2, "warmup": 12, "draws": 6}
    chosen |= {"hit_depth": 0.5} | options
    return bm.infer(scans() if data is None else data, chosen.pop("grid", GRID), **grouped(**chosen))


def assert_same(one, other, but=()):
    """Two runs' posteriors are equal bit for bit, in all that is not a time."""
    mine, theirs = one.posterior, other.posterior
    for of in (lambda p: p.draws.arrays, lambda p: p.draws.index, lambda p: p.snapshot.arrays, lambda p: p.statistics):
        assert list(of(mine)) == list(of(theirs))
        for name, values in of(mine).items():
            if name not in but:
                assert values.dtype == of(theirs)[name].dtype, name
                np.testing.assert_array_equal(values, of(theirs)[name], err_msg=name)
    for name in ("occupancy", "observed", "log_likelihood", "log_prior", "warmup_log_joint"):
        if name not in but:
            np.testing.assert_array_equal(getattr(mine, name), getattr(theirs, name), err_msg=name)
    for name in ("sensor", "prior", "sweep", "finished", "counts"):
        if name not in but:
            assert repr(getattr(mine, name)) == repr(getattr(theirs, name)), name


def surfaces_of(posterior):
    return np.stack([posterior.draws.arrays[f"surface_{part}"] for part in PARTS], axis=-1)
