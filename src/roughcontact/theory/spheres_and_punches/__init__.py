"""Single bodies in closed form: spheres, punches, indenters."""
