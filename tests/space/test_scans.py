"""Scans refuse what is no measurement, and name it."""

import numpy as np
import pytest

import bayesmap as bm


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_a_stamp_that_is_no_time_is_named(wrong):
    stamps = np.array([0.0, 1.0, wrong])
    with pytest.raises(bm.BadInput, match=r"stamp of scan 2 is not finite: (nan|inf); leave stamps_s out"):
        bm.Scans(np.zeros((3, 3)), [0.0], np.ones((3, 1)), max_range_m=2.0, stamps_s=stamps)
