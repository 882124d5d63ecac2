"""The command line: parses, calls, prints. Nothing here is loaded by `import bayesmap`."""
