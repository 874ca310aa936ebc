"""Contact: a pressed surface, loading curves and loops, stiffness, spots, errors, conductance, laws of interfaces."""
