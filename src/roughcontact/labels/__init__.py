"""Names, units and labels of everything that leaves the library."""
