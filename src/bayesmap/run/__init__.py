"""The runner of all chains: schedule, progress, interruption, resuming."""
