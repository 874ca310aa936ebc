"""Notes on the numbers of a contact: limits, doubts, and faults of the map."""
