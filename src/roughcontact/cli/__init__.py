"""The command line: verbs, no numerics."""
