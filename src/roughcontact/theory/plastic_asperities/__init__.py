"""Theories of asperities that yield."""
