"""Evaluation of a pressed contact: stress below it, conductance, errors, laws of interfaces, theories."""
