"""The command line: commands, no numerics."""
