"""Compute the inverse of a sparse symmetric matrix on the pattern of its factor only."""

import numpy as np
import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float64s, Floats, Int32s, Ints

wp.set_module_options({"enable_backward": False})


@wp.kernel
def invert_on_pattern(
    _first: int, begin: Int32s, row: Int32s, lower: Float64s, pivot: Float64s, column_sums: Float64s, inverse: Float64s
):
    """One thread: compute Z_rj = -sum_k L_kj Z_rk and Z_jj = 1 / D_j - sum_k L_kj Z_kj, from the last column on."""
    # j: column; a, b: its entries below the diagonal, in rows k = row[a] and r = row[b]; p: entry of Z in column k.
    columns = begin.shape[0] - 1
    for back in range(columns):
        j = columns - 1 - back
        first = begin[j] + 1
        last = begin[j + 1]
        for a in range(first, last):
            column_sums[a - first] = wp.float64(0.0)
        for a in range(first, last):
            p = begin[row[a]]
            column_sums[a - first] -= lower[a] * inverse[p]
            for b in range(a + 1, last):
                # Rows of this column are among those of column row[a]: both are ascending.
                while row[p] < row[b]:
                    p += 1
                column_sums[b - first] -= lower[a] * inverse[p]
                column_sums[a - first] -= lower[b] * inverse[p]
        diagonal = wp.float64(1.0) / pivot[j]
        for a in range(first, last):
            inverse[a] = column_sums[a - first]
            diagonal -= lower[a] * inverse[a]
        inverse[begin[j]] = diagonal


def selected_inverse(begin: Ints, row: Ints, lower: Floats, pivot: Floats) -> Floats:
    """Compute the entries of (L D L^T)^-1 on the pattern of L (Takahashi, Fagan and Chin, 1973), in L's order.
    Column j of L has the entries begin[j] to begin[j + 1], with ascending rows, the diagonal first; ``lower`` holds
    them with a unit diagonal, ``pivot`` the diagonal of D, (n,). The pattern must be closed under elimination.
    """
    devices.start()
    column_sums_shape = (int(np.diff(begin).max(initial=1)),)
    inputs = [begin, row, lower, pivot, column_sums_shape, row.shape]  # `launch` makes output arrays of the two shapes
    _, inverse = devices.launch(invert_on_pattern, 1, inputs, "cpu")
    return np.asarray(inverse)
