"""Exact derivatives of a contact: with respect to heights, and through them to all that the heights depend on."""
