"""The commands ``study ...``."""
