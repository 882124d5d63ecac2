"""With how many other scans is each beam matched?"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.match.line_pairs import Scene, nearest_point, scene_of
from bayesmap.kernels.parallel import launch

wp.set_module_options({"enable_backward": False})


@wp.kernel
def count_matches(
    first: int,
    scene: Scene,
    offsets: wp.array(dtype=wp.int32),
    target: wp.array(dtype=wp.int32),
    relative: wp.array(dtype=wp.vec3d),
    reach: float,
    scale: float,
    alike: float,
    counts: wp.array2d(dtype=wp.float32),
):
    """One thread a scan: with how many others is each beam matched, weighted by how well."""
    i = first + wp.tid()
    for b in range(scene.kind.shape[1]):
        counts[i, b] = 0.0
    for p in range(offsets[i], offsets[i + 1]):
        z = relative[p]
        j = target[p]
        cosine = float(wp.cos(z[2]))
        sine = float(wp.sin(z[2]))
        for b in range(scene.kind.shape[1]):
            if scene.kind[i, b] == wp.uint8(0):
                continue
            q = scene.points[i, b]
            x = cosine * q[0] - sine * q[1] + float(z[0])
            y = sine * q[0] + cosine * q[1] + float(z[1])
            other = nearest_point(scene, j, x, y, reach)
            if other < 0:
                continue
            if scene.kind[i, b] != scene.kind[j, other]:
                continue
            d = wp.vec2f(x, y) - scene.points[j, other]
            e2 = d[0] * d[0] + d[1] * d[1]
            if scene.kind[i, b] == wp.uint8(2):
                n = scene.normals[i, b]
                m = scene.normals[j, other]
                nx = cosine * n[0] - sine * n[1]
                ny = sine * n[0] + cosine * n[1]
                if nx * m[0] + ny * m[1] < alike:
                    continue
                e = m[0] * d[0] + m[1] * d[1]
                e2 = e * e
            w = 1.0 / (1.0 + e2 / (scale * scale))
            counts[i, b] = counts[i, b] + w * w


def match_counts(
    geometry: Any,
    offsets: NDArray[np.int32],
    target: NDArray[np.int32],
    relative: NDArray[np.float64],
    reach_m: float,
    scale_m: float,
    alike: float,
    threads: int | None = None,
) -> NDArray[np.float32]:
    """With how many of its partners each beam is matched, (S, B); scan s has the pairs offsets[s] .. offsets[s + 1]."""
    device = geometry.device
    counts = wp.empty((len(geometry), geometry.beams), dtype=wp.float32, device=device)
    inputs = [scene_of(geometry), devices.to_device(offsets, wp.int32, device)]
    inputs += [devices.to_device(target, wp.int32, device), devices.to_device(relative, wp.vec3d, device)]
    launch(count_matches, len(geometry), [*inputs, reach_m, scale_m, alike, counts], device, threads)
    return np.asarray(counts.numpy())
