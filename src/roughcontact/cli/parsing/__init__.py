"""From the words of a command line to what a command does: options, their errors, their help, several files."""
