"""The messages between page, session and worker, each declared once with its limits.

`make page` writes the page's types from these declarations.
"""
