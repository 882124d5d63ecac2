"""Structs for kernels hold what they are given: numbers, arrays from the host, and arrays of zeros by their shapes."""

import numpy as np

from bayesmap.kernels.device import pack, start
from bayesmap.kernels.match.line_pairs import PairSums
from bayesmap.kernels.match.scan_refinement import ConvergenceNumbers


def test_a_tuple_is_a_shape_where_the_field_is_an_array_and_a_vector_elsewhere():
    start()
    totals = np.arange(10.0).reshape(2, 5)
    sums = pack(PairSums, "cpu", second=(2,), totals=totals)
    np.testing.assert_array_equal(sums.second.numpy(), np.zeros((2, 3, 3)))
    np.testing.assert_array_equal(sums.totals.numpy(), totals)
    numbers = pack(ConvergenceNumbers, "cpu", steps=3, reach_m=(0.5, 0.25))
    assert (numbers.steps, *numbers.reach_m) == (3, 0.5, 0.25)
