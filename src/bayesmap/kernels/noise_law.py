"""Standard noise, compiled: normal, or Student's t, as in `bayesmap.sensors.noise`."""

from typing import Any

import warp as wp

SIGMAS_TO_CERTAINTY = wp.constant(wp.float64(9.0))  # standard deviations past which the normal's cumulative is 0 or 1
INV_SQRT_2 = wp.constant(wp.float64(0.7071067811865476))
INV_PI = wp.constant(wp.float64(0.3183098861837907))
MOST_TERMS = wp.constant(wp.float64(16.0))
ROUNDS = wp.constant(200)  # of the continued fraction, at most; it takes some tens
TINY = wp.constant(wp.float64(1.0e-300))
CLOSE = wp.constant(wp.float64(1.0e-14))
MOST_POWER = 16
"""Of a Student-t density: beyond it, at 31 degrees of freedom, it is nearly normal."""


@wp.func
def noise_log_density(law: Any, square: Any):
    """Return the log density of the standard noise of a sensor's law, at a squared distance."""
    half = type(square)(0.5)
    if law.dof > type(square)(0.0):
        one = type(square)(1.0)
        return law.log_height - half * (law.dof + one) * wp.log(one + square / law.dof)
    return law.log_height - half * square


def whole_power(power: float) -> int:
    """Return (dof + 1) / 2 where that is a whole number small enough to multiply out, else 0."""
    return int(power) if power == int(power) and power <= MOST_POWER else 0


@wp.func
def noise_density(law: Any, square: Any):
    """Return the density of the standard noise of a sensor's law, at a squared distance.

    Of Student's t with an odd number of degrees of freedom height / (1 + square / dof)^power, without logarithms.
    """
    if law.power > 0:
        base = type(square)(1.0) + square / law.dof
        product = base
        for _ in range(1, law.power):
            product = product * base
        return law.height / product
    return wp.exp(noise_log_density(law, square))


@wp.func
def noise_below(law: Any, x: Any):
    """Return P(standard noise <= x)."""
    if law.dof > type(x)(0.0):
        return type(x)(student_below(wp.float64(law.dof), wp.float64(law.log_height), wp.float64(x)))
    if x > type(x)(SIGMAS_TO_CERTAINTY):
        return type(x)(1.0)
    if x < -type(x)(SIGMAS_TO_CERTAINTY):
        return type(x)(0.0)
    return type(x)(0.5) * wp.erfc(-x * type(x)(INV_SQRT_2))


@wp.func
def beta_fraction(a: wp.float64, b: wp.float64, x: wp.float64) -> wp.float64:
    """Return the continued fraction of the incomplete beta function (DLMF 8.17.22), by Lentz's method."""
    one = wp.float64(1.0)
    tiny = TINY
    c = one
    d = one - (a + b) * x / (a + one)
    if wp.abs(d) < tiny:
        d = tiny
    d = one / d
    h = d
    for i in range(1, ROUNDS):
        m = wp.float64(i)
        even = m * (b - m) * x / ((a + m + m - one) * (a + m + m))
        d = one + even * d
        c = one + even / c
        if wp.abs(d) < tiny:
            d = tiny
        if wp.abs(c) < tiny:
            c = tiny
        d = one / d
        h = h * d * c
        odd = -(a + m) * (a + b + m) * x / ((a + m + m) * (a + m + m + one))
        d = one + odd * d
        c = one + odd / c
        if wp.abs(d) < tiny:
            d = tiny
        if wp.abs(c) < tiny:
            c = tiny
        d = one / d
        step = d * c
        h = h * step
        if wp.abs(step - one) < CLOSE:
            break
    return h


@wp.func
def student_below(dof: wp.float64, log_height: wp.float64, t: wp.float64) -> wp.float64:
    """Return P(T <= t) for Student's t: half an incomplete beta function of (dof / 2, 1 / 2) at dof / (dof + t^2).

    For whole dof it is a finite sum (Abramowitz and Stegun 26.7.3 and 26.7.4), which is ten times as fast.
    """
    half = wp.float64(0.5)
    one = wp.float64(1.0)
    if t == wp.float64(0.0):
        return half
    a = half * dof
    y = t * t / (dof + t * t)
    x = dof / (dof + t * t)
    if a == wp.floor(a) and a <= MOST_TERMS:
        term = one
        series = one
        for j in range(1, int(a)):
            term = term * x * (one - half / wp.float64(j))
            series += term
        return half + half * series * wp.sign(t) * wp.sqrt(y)
    if dof == wp.floor(dof) and a <= MOST_TERMS:
        angle = wp.atan(wp.abs(t) / wp.sqrt(dof))
        term_odd = wp.where(dof > one, wp.sqrt(x), wp.float64(0.0))
        series_odd = term_odd
        for j_odd in range(1, int(a)):
            term_odd = term_odd * x * (one - one / wp.float64(2 * j_odd + 1))
            series_odd += term_odd
        return half + wp.sign(t) * INV_PI * (angle + wp.sqrt(y) * series_odd)
    # log 1 / B(dof / 2, 1 / 2) = log_height + log(dof) / 2
    front = wp.exp(log_height + half * wp.log(dof) + a * wp.log(x) + half * wp.log(y))
    tail = wp.float64(0.0)
    if x < (a + one) / (a + wp.float64(2.5)):
        tail = half * front * beta_fraction(a, half, x) / a
    else:
        tail = half * (one - front * beta_fraction(half, a, y) / half)
    return wp.where(t > wp.float64(0.0), one - tail, tail)
