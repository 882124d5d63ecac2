"""`python -m bayesmap` is the command line."""

from bayesmap.cli.main import main

main()
