"""The mapping model as a generative function on JAX."""
