"""Rough lines on springs."""
