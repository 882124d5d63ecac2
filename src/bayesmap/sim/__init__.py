"""Simulation: buildings, drawings and pictures as worlds, patrols, the forward model."""
