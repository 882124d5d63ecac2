"""Results of the worker: one class per method, with the maps and figures that pages show."""
