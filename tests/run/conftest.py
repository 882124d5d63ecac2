"""Fixtures of the runner's tests."""

from ray_cluster import cluster, two_nodes  # noqa: F401 -- fixtures
