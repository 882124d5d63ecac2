"""Answers to the questions of a page about the result on show."""
