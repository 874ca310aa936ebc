"""Theories of surfaces that attract each other."""
