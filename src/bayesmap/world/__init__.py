"""Grids, scans and worlds: plain data about space, with no sensor and no inference in it."""
