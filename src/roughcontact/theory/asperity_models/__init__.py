"""Theories of asperities: independent ones, and asperities that interact through the body."""
