"""Tangential loading of a contact that is pressed and held: full stick, partial slip, cycles."""
