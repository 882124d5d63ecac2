"""The command line. Read `main`, `group` (all commands), `command` and `keys` (settings), then `infer`, `pipeline`."""
