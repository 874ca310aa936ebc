"""Pictures of a whole joint, and of what a measured joint tells."""
