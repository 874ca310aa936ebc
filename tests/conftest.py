import gc

from pictures import _figures_are_closed, undrawn  # noqa: F401

# Tens of thousands of tests live to the end: to look for garbage among them takes a third of their collection, and is
# needless later.
gc.disable()


def pytest_collection_finish():
    gc.freeze()
    gc.set_threshold(20_000)  # a search for garbage goes through all that the libraries hold
    gc.enable()
