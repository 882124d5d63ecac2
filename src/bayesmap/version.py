"""The version, in one place: the build reads it, and every saved run and JSON document carries it."""

__version__ = "0.1.0"
