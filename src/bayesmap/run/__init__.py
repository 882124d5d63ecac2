"""The run of Markov chains. Read `chains` (plan and results), `runner` and `ray_executor` (the loops), and `cost`."""
