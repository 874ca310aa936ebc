"""Figures of the thesis: one file each, with its parameters, its case and its picture."""
