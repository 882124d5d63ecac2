"""Priors over maps, and the forward model from a map to scans."""
