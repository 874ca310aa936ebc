"""A run that stands still at a chosen moment, to be killed there."""

import time
from pathlib import Path

import scipy.linalg  # noqa: F401
import xarray

from roughcontact.study import store as module
from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study

# The first dataset brings other libraries with it: loaded here, they are loaded once for all processes.
xarray.Dataset({"any": ("x", [0.0])}, {"x": [0]})


def stand_still(folder, place):
    (Path(folder).parent / "here").write_text(place)
    time.sleep(600)


def run_until(folder, study, place, number):
    """Run a study, and stand still at that place of storing the case of that number.

    ``before`` it is stored; between its ``field`` and its row; ``inserted``, but not committed; the same with part of
    the row written to the database already (``spilled``); and ``after`` it was stored.
    """
    add, encode = Store.add, module.encode
    count = 0

    def watched(self, task, result):
        nonlocal count
        count += 1
        if count == number:
            database = self._connection
            if place == "before":
                stand_still(folder, place)
            if place == "field":
                module.encode = lambda record: stand_still(folder, place)
            if place == "spilled":
                database.execute("PRAGMA cache_size = 1")
            if place in ("inserted", "spilled"):
                database.set_trace_callback(
                    lambda sql: stand_still(folder, place) if sql == "COMMIT" else None
                )
        add(self, task, result)
        if count == number and place == "after":
            stand_still(folder, place)

    Store.add = watched
    run(Study(**study), folder)
    Store.add, module.encode = add, encode
