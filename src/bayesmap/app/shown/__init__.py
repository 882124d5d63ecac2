"""What the worker has found so far: a class for each method, and the picture that shows it."""
