"""Settings for all tests; its presence also puts tests/ on the import path (`from data import intel_log`)."""

from hypothesis import settings

# A slow machine is no failure.
settings.register_profile("bayesmap", deadline=None)
settings.load_profile("bayesmap")
