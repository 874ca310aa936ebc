"""Theories of summits: independent ones, and summits that push each other down."""
