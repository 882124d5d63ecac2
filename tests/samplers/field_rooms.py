"""A room with glass in it, and scans of it: small, but of every kind of reading."""

from functools import cache

import numpy as np

import bayesmap as bm

TRUTH = bm.BeamMixture(bm.Gaussian(0.03, 0.004), p_random=0.04, p_no_return=0.06, p_short=0.08, rate_short_per_m=0.7)
GRID = bm.Grid((30, 24), resolution=0.2)
PRIORS = {"reflectivities": bm.Beta(), "surfaces": bm.Surface()}


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
    chosen = {"prior": PRIORS[kind], "sensor": "fit", "chains": 2, "warmup": 12, "draws": 6, "hit_depth": 0.5} | options
    return bm.infer(scans() if data is None else data, chosen.pop("grid", GRID), **chosen)


ARRAYS = (
    "touched", "busy", "reflectivity", "expected", "surfaces", "occupancy", "observed", "log_likelihood", "log_prior",
    "warmup_log_joint", "states", "informed",
)  # fmt: skip


def assert_same(one, other, but=()):
    """Two runs' posteriors are equal bit for bit, in all that is not a time."""
    for name in ARRAYS:
        if name in but:
            continue
        mine, theirs = getattr(one.posterior, name), getattr(other.posterior, name)
        assert mine.dtype == theirs.dtype, name
        np.testing.assert_array_equal(mine, theirs, err_msg=name)
    for name in ("sensor", "prior", "sweep", "finished", "counts"):
        assert getattr(one.posterior, name) == getattr(other.posterior, name), name
