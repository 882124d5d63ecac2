"""How much of the work is done: shares rise to one, however it is divided."""

import numpy as np
import pytest

from bayesmap.posterior.predictor import parts, watched


def test_parts_follow_each_other_by_their_sizes():
    told = []
    first, second, third = parts(told.append, 1.0, 2.0, 5.0)
    for tell, share in ((first, 0.5), (first, 1.0), (second, 0.5), (second, 1.0), (third, 0.2), (third, 1.0)):
        tell(share)
    assert told == pytest.approx([0.5 / 8, 1 / 8, 2 / 8, 3 / 8, 4 / 8, 1.0])


def test_a_part_of_a_part():
    told = []
    _, second = parts(told.append, 1.0, 1.0)
    for tell in parts(second, 3.0, 1.0):
        tell(1.0)
    assert told == pytest.approx([0.875, 1.0])


def test_watched_batches_are_the_same_and_are_told_when_they_have_been_used():
    told = []
    batches = [np.arange(6).reshape(3, 2), np.arange(2).reshape(1, 2)]
    seen = [(batch, len(told)) for batch in watched(batches, 4, told.append)]
    assert [batch for batch, _ in seen] == batches
    assert [before for _, before in seen] == [0, 1]
    assert told == [0.75, 1.0]
