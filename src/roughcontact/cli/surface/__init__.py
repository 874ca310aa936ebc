"""The commands ``surface ...``."""
