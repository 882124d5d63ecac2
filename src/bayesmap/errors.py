"""The one exception for input that cannot be used.

Every layer raises `BadInput` with a message that says what was wrong, where, and what would be right;
the command line prints it on one line and exits with code 3.
"""


class BadInput(ValueError):
    """Input that cannot be used: the message names the place and the remedy."""
