"""A sensor model of the user's own: the three methods alone of another model."""

import numpy as np

import bayesmap as bm


class OwnSensor(bm.SensorModel):
    """Another model's law without its formulas for kernels; ``weight`` multiplies its densities, and should be 1."""

    def __init__(self, law, weight=1.0):
        self.law, self.weight = law, weight

    def log_likelihood(self, range_m, distance_m, limits):
        return self.law.log_likelihood(range_m, distance_m, limits) + np.log(self.weight)

    def reach_m(self, range_m, limits):
        return self.law.reach_m(range_m, limits)

    def sample(self, rng, distance_m, limits):
        return self.law.sample(rng, distance_m, limits)
