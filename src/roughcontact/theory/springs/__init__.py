"""Lines on springs in closed form: the models of the method of dimensionality reduction."""
