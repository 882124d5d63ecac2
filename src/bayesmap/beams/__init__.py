"""The cells of a grid along each beam."""
