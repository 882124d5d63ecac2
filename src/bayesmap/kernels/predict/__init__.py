"""Predict readings from maps: densities, quantiles, scans at other poses, and weights of poses."""
