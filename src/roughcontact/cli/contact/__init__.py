"""The commands of elastic and plastic contact."""
