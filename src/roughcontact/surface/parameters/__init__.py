"""Surface texture parameters of the ISO standards."""
