"""What the page, the session and the worker say to each other: each message is declared here once, with its limits.

The page's types are written from these declarations (`make page`).
"""
