"""Sample reflectivities and surfaces: the stops of beams, the cells given them, and how chains run both."""
