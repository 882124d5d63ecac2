"""The densities of the sensor models, written down once more from their definitions with scipy.stats."""

import numpy as np
import scipy


def gaussian(z, d, *, sigma, per_m=0.0, max_m):
    """The tutorial's sensor: the reading is the capped distance plus normal noise."""
    d = np.minimum(d, max_m)
    return scipy.stats.norm.logpdf(z, loc=d, scale=sigma + per_m * d)


def mixture(z, d, *, sigma, dof=None, per_m=0.0, min_m, max_m, p_random, p_no_return, p_short, rate):
    """log p(z | d) of one reading, told component by component; z may be +inf (no return) or -inf (too close)."""
    seen, wall = d <= max_m, min(d, max_m)
    law, shape = (scipy.stats.norm, ()) if dof is None else (scipy.stats.t, (dof,))
    at = (*shape, wall, sigma + per_m * wall)
    reaches = 1 - p_short * scipy.stats.expon.cdf(wall, scale=1 / rate)  # no object stands before the wall
    lost = p_no_return if seen else 1.0  # nothing comes back from what the beam reaches
    echo = reaches * (1 - p_no_return) if seen else 0.0  # the wall is what is read
    if z == np.inf:
        p = (1 - p_random) * (reaches * lost + echo * law.sf(max_m, *at))
    elif z == -np.inf:
        blocked = p_short * scipy.stats.expon.cdf(min(wall, min_m), scale=1 / rate)
        p = (1 - p_random) * (blocked + echo * law.cdf(min_m, *at))
    else:
        short = p_short * scipy.stats.expon.pdf(z, scale=1 / rate) if z < wall else 0.0
        p = p_random / (max_m - min_m) + (1 - p_random) * (short + echo * law.pdf(z, *at))
    return float(np.log(p))
