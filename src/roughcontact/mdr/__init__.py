"""The method of dimensionality reduction: contacts of bodies of revolution and of rough lines on springs."""
