"""Sensor models, and the beam table that they fill."""
