"""Ray casting: cell visits a second on one core."""

from collections.abc import Iterator

import numpy as np
import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.walk import find_first_hits
from benchmarks.figure import Figure, rate

BEAMS, SIZE = 200_000, 1000


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """Long beams through a sparse 1000 x 1000 map; one launch runs on one core."""
    devices.start()
    rng = np.random.default_rng(0)
    walls = (rng.random((SIZE, SIZE)) < 0.002).astype(np.uint8)
    x, y, angle = (rng.uniform(0, end, BEAMS) for end in (SIZE, SIZE, 2 * np.pi))
    starts = devices.to_device(np.column_stack([x, y]), wp.vec2d, device)
    inputs = [devices.to_device(walls, wp.uint8, device), starts, devices.to_device(angle, wp.float64, device)]
    distance = wp.empty(BEAMS, dtype=wp.float64, device=device)
    visits = wp.empty(BEAMS, dtype=wp.int32, device=device)

    def work() -> float:
        wp.launch(find_first_hits, BEAMS, [0, *inputs, wp.float64(2.0 * SIZE), distance, visits], device=device)
        return float(visits.numpy().sum()) * 1e-6

    yield rate("ranges/cell_visits", work, unit="M/s")
