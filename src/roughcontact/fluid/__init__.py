"""Flow of a fluid through the gap of a contact."""
