"""Tangential loading of a contact under constant pressure: full stick, partial slip, cycles."""
