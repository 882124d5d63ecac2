"""Logs, trajectories and graphs that are one file of lines, rows or records: their readers and writers."""
