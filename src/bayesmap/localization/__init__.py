"""Where is the robot in a map that is known up to its posterior: the posterior over poses."""
