"""What measurements tell of a surface: many maps with their combined spectrum, and the stiffness of a joint."""
