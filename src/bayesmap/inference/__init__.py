"""Inference: one file a method, and one runner for all chains."""
