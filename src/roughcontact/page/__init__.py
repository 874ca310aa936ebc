"""A page on the user's machine: drop a file, move the load, see the contact. It contains no numerics."""
