"""Plain data about space: grids, scans, rigid motions, trajectories."""
