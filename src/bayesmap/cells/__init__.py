"""Kinds of cells and their priors."""
