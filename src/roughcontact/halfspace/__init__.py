"""The elastic half-space: from pressure to displacement."""
