"""Contact of surfaces that attract each other."""
