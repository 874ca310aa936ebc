"""Cases for the executors: quick ones with digits that tell, and such as take their worker down.

Records are plain dictionaries here: a worker that need not import xarray starts in half the time.
"""

import os
import signal
import sys
import time
from contextlib import suppress

import numpy as np
import psutil

from roughcontact.study.case import Case, Parameters
from roughcontact.study.task import Result, Task


def run_task(task):
    """Return the result of a task, as the study's own function does."""
    try:
        rng = np.random.default_rng([task.seed, task.sample])
        return Result(task.key, task.case.run(task.parameters, rng), "", 0.01)
    except Exception as error:
        return Result(task.key, None, str(error), 0.01)


class Numbers(Parameters):
    value: int = 0
    seconds: float = 0.0


def numbers(parameters, rng):
    """Return numbers whose last bits depend on threads, and on the order of the random draws."""
    time.sleep(parameters.seconds)
    heights = rng.normal(size=(48, 48)) + parameters.value
    solved = np.linalg.solve(heights @ heights.T + 48 * np.eye(48), heights[0])
    return {"solved": solved, "spectrum": np.abs(np.fft.rfft2(heights)).sum(), "missing": np.float64(np.nan)}


class Fate(Parameters):
    value: int = 0
    how: str = "live"


def fate(parameters, rng):
    """Live, or go in one of the ways in which processes go."""
    mean = {"mean": rng.normal() + np.float64(parameters.value)}
    match parameters.how:
        case "kill":
            os.kill(os.getpid(), signal.SIGKILL)
        case "crash":
            os.kill(os.getpid(), signal.SIGSEGV)
        case "leave":
            os._exit(3)
        case "exit":
            sys.exit(3)
        case "raise":
            raise ValueError("no such surface")
        case "lock":
            return {"mean": Unsendable()}
        case "print":
            sys.stdout.write("printed by a case\n")
            sys.stdout.write(repr(sys.stdin.read()))
    return mean


class Unsendable:
    """Refuses to be pickled."""

    def __reduce__(self):
        raise TypeError("a lock is in here")


def record(parameters, rng):
    """Return the same numbers as a study takes them."""
    import xarray

    found = numbers(parameters, rng)
    if parameters.value == 3:
        raise ValueError("no such surface")
    return xarray.Dataset({**found, "solved": ("row", found["solved"])})


def environment(parameters, rng):
    """Return a variable of the worker's environment."""
    return {"threads": np.array(os.environ["OMP_NUM_THREADS"])}


NUMBERS = Case("numbers", 1, Numbers, numbers)
RECORD = Case("record", 1, Numbers, record)
FATE = Case("fate", 1, Fate, fate)


def workers():
    """Return the processes that this one has started; a helper of `multiprocessing` stays as long as it does."""
    found = []
    for child in psutil.Process().children(recursive=True):
        with suppress(psutil.NoSuchProcess):  # by now, or dead and not buried
            if "resource_tracker" not in " ".join(child.cmdline()) and child.status() != psutil.STATUS_ZOMBIE:
                found.append(child)
    return found


def tasks(case, rows, first=0):
    """Return a task for each mapping of parameters, numbered from `first`."""
    return [Task(f"key{i}", case, case.parameters(**row), 0, i) for i, row in enumerate(rows, first)]


def bits(results):
    """Return every bit of the records, to be compared with ``==``; a key that comes twice is an error."""
    found = {}
    for result in results:
        assert result.key not in found
        assert (result.record is None) == bool(result.message)
        found[result.key] = result.record and {name: v.tobytes() for name, v in result.record.items()}
    return found


def truth(found):
    """Return the bits that serial execution gives."""
    return bits(map(run_task, found))
