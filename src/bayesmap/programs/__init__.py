"""The mapping model as a generative function on JAX."""

from bayesmap import gen as gen  # says what is missing where JAX is
