"""Maps that other programs made, to be located in."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.defaults import default_sensor
from bayesmap.localization.known_map import KnownMap, Trust
from bayesmap.posterior.others_maps import stop_probabilities
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.noise import Gaussian, StudentT

Floats = NDArray[np.float64]
WARY = Trust(pose_readings=5.4, place_readings=2.7, least_draws=1.0, fit_readings=13.0, shared_way_m=0.5, carried=3e-3, search_way_m=1.0, kept=12, forgotten_nats=30.0)


def external(occupancy, grid, scans, trust=WARY, sigma=0.08, p_random=0.1, p_short=0.3, rate=0.3, occ=0.8, free=1e-3, unk=0.05, device="cpu"):
    values = {"stop_occupied": occ, "stop_free": free, "stop_unknown": unk}
    stop = stop_probabilities(occupancy, values)
    sensor = BeamMixture(Gaussian(sigma, 0.005), p_random=p_random, p_no_return=0.03, p_short=p_short, rate_short_per_m=rate)
    from dataclasses import replace
    made = KnownMap.of_draws(
        stop.ravel()[None].astype(np.float32), grid, sensor, scans, occupancy=stop, observed=~np.isnan(occupancy), device=device)
    return replace(made, trust=trust)
