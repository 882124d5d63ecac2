"""Poses of the scans: their priors, and the inference of a trajectory from scans and odometry."""
