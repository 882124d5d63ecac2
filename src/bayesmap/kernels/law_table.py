"""Interpolate a tabulated sensor law (`bayesmap.sensors.tabulated`, which states the coordinates of its nodes)."""

from typing import Any

import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float32s
from bayesmap.sensors.tabulated import MAX_SPREAD_SCALES, TabulatedLaw

MAX_SPREAD = wp.constant(wp.float32(MAX_SPREAD_SCALES))
Float32Boxes = wp.array3d(dtype=wp.float32)
# A `TabulatedLaw` on a device: the Warp types of its fields, in their order.
LawTable = devices.struct_like(
    TabulatedLaw, wp.float32, wp.float32, wp.float32, int, Float32s, wp.float32, Float32Boxes, Float32Boxes,
    Float32Boxes, Float32s, Float32s, wp.vec2,
)  # fmt: skip


@wp.func
def node_below(x: wp.float32, nodes: int) -> wp.vec2:
    """Return the index of the node below x in [0, 1], and the share of the way from there to the next node."""
    position = wp.clamp(x, wp.float32(0.0), wp.float32(1.0)) * wp.float32(nodes - 1)
    low = wp.min(wp.floor(position), wp.float32(nodes - 2))
    return wp.vec2(low, position - low)


@wp.func
def interpolate(values: Float32s, x: wp.float32) -> wp.float32:
    """Interpolate linearly between evenly spaced nodes."""
    node = node_below(x, values.shape[0])
    i = int(node[0])
    return values[i] + node[1] * (values[i + 1] - values[i])


@wp.func
def interpolate_2d(values: Float32Rows, x: wp.float32, y: wp.float32) -> wp.float32:
    """Interpolate bilinearly in two dimensions."""
    node = node_below(x, values.shape[0])
    i = int(node[0])
    low = interpolate(values[i], y)
    return low + node[1] * (interpolate(values[i + 1], y) - low)


@wp.func
def interpolate_3d(values: Float32Boxes, x: wp.float32, y: wp.float32, z: wp.float32) -> wp.float32:
    """Interpolate trilinearly in three dimensions."""
    node = node_below(x, values.shape[0])
    i = int(node[0])
    low = interpolate_2d(values[i], y, z)
    return low + node[1] * (interpolate_2d(values[i + 1], y, z) - low)


@wp.func
def readings_scale_m(table: LawTable, distance_m: wp.float32, max_m: wp.float32) -> wp.float32:
    """Return the scale on which readings scatter about a stop at the distance, metres."""
    return interpolate(table.scale_m, distance_m / max_m)


@wp.func
def spread_coordinate(scale: wp.float32, variance: wp.float32) -> wp.float32:
    """Return the coordinate of a spread among its nodes, 0 to 1."""
    spread = wp.min(wp.sqrt(variance) / scale, MAX_SPREAD)
    return spread / (wp.float32(1.0) + spread) * (wp.float32(1.0) + MAX_SPREAD) / MAX_SPREAD


@wp.func
def offset_coordinate(table: LawTable, offset: wp.float32) -> wp.float32:
    """Return the coordinate of a standard offset among its nodes, 0 to 1."""
    size = wp.abs(offset)
    arsinh = wp.log(size + wp.sqrt(size * size + wp.float32(1.0)))
    return wp.float32(0.5) + wp.float32(0.5) * wp.sign(offset) * arsinh / table.max_offset


@wp.func
def table_log_density(law: Any, reading_m: Any, distance_m: Any, variance: Any):
    """Return log p(reading | the beam stops at about the distance), at least ``law.min_log``."""
    return wp.max(unbounded_log_density(law.table, reading_m, distance_m, variance, law.max_m), law.min_log)


@wp.func
def unbounded_log_density(table: LawTable, reading_m: Any, distance_m: Any, variance: Any, max_m: Any):
    """Return log p(reading | the beam stops at about the distance) without a lower bound."""
    # z: reading; d: distance; top: largest range. A typed reading of a law without such outcomes stands for a limit.
    z = wp.float32(reading_m)
    d = wp.float32(distance_m)
    top = wp.float32(max_m)
    typed = wp.isinf(z) and table.typed != 0
    if wp.isinf(z) and not typed:
        z = wp.where(z > wp.float32(0.0), top, table.min_m)
    # The beam stops nowhere within the range.
    if d > top:
        if typed:
            return type(reading_m)(table.log_typed_nowhere[wp.where(z > wp.float32(0.0), 1, 0)])
        return type(reading_m)(interpolate(table.log_nowhere, (z - table.low_m) / (table.high_m - table.low_m)))
    # Interpolate at distance, spread and offset.
    depth = d / top
    scale = readings_scale_m(table, d, top)
    spread = spread_coordinate(scale, wp.float32(variance))
    if typed:
        return type(reading_m)(interpolate_2d(table.log_typed[wp.where(z > wp.float32(0.0), 1, 0)], spread, depth))
    width = wp.sqrt(scale * scale + wp.float32(variance))
    offset = offset_coordinate(table, (z - d) / width)
    return type(reading_m)(interpolate_3d(table.log_density, spread, depth, offset) - wp.log(width))


@wp.func
def table_cumulative(table: LawTable, reading_m: Any, distance_m: Any, variance: Any, max_m: Any):
    """Return P(reading <= range | the beam stops at about the distance)."""
    # z: range; d: distance; top: largest range.
    z = wp.float32(reading_m)
    d = wp.float32(distance_m)
    top = wp.float32(max_m)
    if table.typed != 0:
        z = wp.clamp(z, table.min_m, top)
    if d > top:
        return type(reading_m)(interpolate(table.below_nowhere, (z - table.low_m) / (table.high_m - table.low_m)))
    scale = readings_scale_m(table, d, top)
    spread = spread_coordinate(scale, wp.float32(variance))
    offset = offset_coordinate(table, (z - d) / wp.sqrt(scale * scale + wp.float32(variance)))
    return type(reading_m)(interpolate_3d(table.below, spread, d / top, offset))
