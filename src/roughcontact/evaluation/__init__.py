"""Evaluation of a pressed contact: stress below it, conductance, reflection, errors, laws of interfaces, theories."""
