"""The programs that take part, each behind an adapter ``peer_<name>.py`` of one signature."""

from __future__ import annotations

import importlib
import importlib.metadata
import os
from dataclasses import dataclass
from types import ModuleType

__all__ = ["CERTIFICATE", "PEERS", "Program", "limit_threads", "load"]

CERTIFICATE = 1e-8  # what an answer has to reach before its time counts
PEERS = ("tamaas", "contactmechanics", "aspher", "aspher_h2")


@dataclass(frozen=True, slots=True)
class Program:
    """An adapter that could be imported."""

    name: str
    version: str
    adapter: ModuleType

    @property
    def goal(self) -> float:
        """What its answers have to reach before their time counts: infinite, if they are judged alone."""
        return getattr(self.adapter, "GOAL", CERTIFICATE)


def load(name: str) -> Program | str:
    """Return the program `name`, or the reason why it cannot be shown."""
    try:
        adapter = importlib.import_module(f"peer_{name}")
    except ImportError as error:  # a missing package, or a shared library that it misses
        return str(error)
    return Program(name, importlib.metadata.version(adapter.PACKAGE), adapter)


def limit_threads(count: int) -> None:
    """Give this process and every library in it `count` cores; to be called before any of them is imported."""
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[variable] = str(count)
    if hasattr(os, "sched_setaffinity"):  # what counts cores by itself finds no more than these
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:count])
