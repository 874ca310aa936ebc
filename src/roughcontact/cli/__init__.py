"""The command line: its commands, without numerics."""
