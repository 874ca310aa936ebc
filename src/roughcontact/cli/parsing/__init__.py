"""Parsing of the command line: options, their errors, their help, several files."""
