"""Localization: the posterior over a robot's pose in a map posterior, or in a map of another program."""
