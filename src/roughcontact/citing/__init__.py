"""The papers behind a result: the references of the program, and those of one result."""
