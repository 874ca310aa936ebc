from pictures import _figures_are_closed, undrawn  # noqa: F401
