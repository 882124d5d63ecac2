"""Match scans to scans: pairs of points and lines, likelihood grids, branch and bound, fields of a map."""
