"""Laws of the normal stiffness of rough surfaces."""
