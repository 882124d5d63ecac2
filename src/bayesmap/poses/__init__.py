"""Where the robot was: priors of poses, and their inference."""
