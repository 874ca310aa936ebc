"""The version, for imports by every file."""

__all__ = ["__version__"]

__version__ = "0.1.0"
