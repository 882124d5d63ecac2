"""Samplers: one file a method."""
