"""A page on the user's own machine: drop a file, move the load, see the contact. It has no numerics of its own."""
