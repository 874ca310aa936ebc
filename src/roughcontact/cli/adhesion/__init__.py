"""The commands ``adhesion ...``."""
