"""Cases of a test in two tiers: the landing run keeps some, and `make test-all` adds those that are marked `full`."""

from itertools import product

import pytest


def full_but(cases, *kept):
    """Return pytest parameters for some cases, of which the landing run keeps those that are named."""
    assert not set(kept) - set(cases), "an unknown case"
    return [case if case in kept else pytest.param(case, marks=pytest.mark.full) for case in cases]


def pairs_but(cases, *kept):
    """Return pytest parameters for cases of several values each; the landing run keeps those that are named."""
    cases = list(cases)
    assert not set(kept) - set(cases), "an unknown case"
    return [pytest.param(*case, marks=[] if case in kept else [pytest.mark.full]) for case in cases]


def latin(of, *axes):
    """Return pytest parameters for all combinations of some axes, of which the landing run keeps one in ``of``.

    They are a Latin square: the values on all axes but one leave one value in ``of`` on the last one. A fault of one
    value of one axis is met as often as the value is kept, once in ``of`` times; only a fault of a single combination
    can be missed. Longer axes are shifted once a turn, so that regular axes within them are met evenly, too.
    """
    found = []
    for places in product(*(range(len(axis)) for axis in axes)):
        kept = sum(place + place // of for place in places) % of == 0
        values = [axis[place] for axis, place in zip(axes, places, strict=True)]
        found.append(pytest.param(*values, marks=[] if kept else [pytest.mark.full]))
    return found
