"""Jobs on viscoelastic bodies."""
