"""What inference found: the posterior as plain data, its summaries, diagnostics and scores."""
