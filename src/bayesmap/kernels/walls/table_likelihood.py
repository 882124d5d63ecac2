"""The likelihoods of a beam table: of each reading, for a first hit in each cell of its beam."""

import warp as wp

from bayesmap.kernels.rays import Lines, distance_at, first_past, line_of
from bayesmap.kernels.sensor_law import MIXTURE, SensorLaw64, object_decay, stop_log_density

wp.set_module_options({"enable_backward": False})

WIDTHS = wp.constant(wp.float64(9.0))  # scales past which normal noise adds nothing to a mixture


@wp.kernel
def fill_likelihood(
    first: int,
    law: SensorLaw64,
    lines: Lines,
    offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    depth: wp.float64,
    range_m: wp.array(dtype=wp.float64),
    loglik: wp.array(dtype=wp.float32),
    no_hit: wp.array(dtype=wp.float32),
):
    """One thread a beam: the log-likelihood of each entry, and of no hit.

    The normal noise of a mixture matters between two distances only, whose entries are found by halving: of walls
    before them and behind them a range has one likelihood each.
    """
    b = first + wp.tid()
    z = range_m[b]
    no_hit[b] = wp.float32(0.0)
    if wp.isnan(z):
        return
    one = wp.float64(1.0)
    zero = wp.float64(0.0)
    begin = offsets[b]
    end = offsets[b + 1]
    line = line_of(lines, b)
    decay = object_decay(law, z)
    no_hit[b] = wp.float32(stop_log_density(law, z, decay, wp.float64(wp.inf), zero))
    near = begin
    behind = end
    if law.kind == MIXTURE and law.dof == zero and wp.isfinite(z):
        begins = (z - WIDTHS * law.sigma_m) / (one + WIDTHS * law.sigma_per_m)
        near = first_past(line, cells, begin, end, begins, depth)
        if WIDTHS * law.sigma_per_m < one:
            ends = (z + WIDTHS * law.sigma_m) / (one - WIDTHS * law.sigma_per_m)
            behind = first_past(line, cells, near, end, ends, depth)
        if near > begin:
            before = wp.float32(wp.log(law.uniform))
            for k in range(begin, near):
                loglik[k] = before
    for k in range(near, behind):
        loglik[k] = wp.float32(stop_log_density(law, z, decay, distance_at(line, cells[k], depth), zero))
    if behind < end:
        after = no_hit[b]
        if z < law.max_m:
            after = wp.float32(wp.log(law.uniform + law.passing * decay))
        for k in range(behind, end):
            loglik[k] = after
