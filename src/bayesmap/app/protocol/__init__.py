"""The messages of page, session and worker, each declared once with its limits.

The page's types are written from these declarations (`make page`).
"""
