"""Measurements of one surface: maps and profiles with their instruments, reliable bands and combined spectrum."""
