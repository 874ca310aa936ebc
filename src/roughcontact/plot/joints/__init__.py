"""Pictures of a whole joint, and of an inference from a measured joint."""
