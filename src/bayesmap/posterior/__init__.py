"""The posterior as plain data, its summaries, predictions, scores and decisions."""
