"""The programs that take part, each behind an adapter `peer_<name>.py`: docs/evidence/benchmark-suite.md."""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

__all__ = ["Program", "limit_threads", "load", "names"]

HOME = Path(__file__).parent


@dataclass(frozen=True, slots=True)
class Program:
    """An adapter that could be imported."""

    name: str
    version: str
    adapter: ModuleType

    def solver(self, kind: str) -> Callable[..., dict[str, Any]] | None:
        """Return the function that solves problems of a kind, if there is one."""
        return getattr(self.adapter, kind, None)

    def start(self, kind: str, tolerance: float) -> float:
        """Return the setting from which the search starts; the tolerance of the case otherwise."""
        return float(getattr(self.adapter, "START", {}).get(kind, tolerance))


def names(folder: Path | None = None) -> list[str]:
    """Return the names of the adapters here and in a folder of the user, ours first."""
    found = [
        path.stem.removeprefix("peer_")
        for home in (HOME, folder)
        if home
        for path in sorted(home.glob("peer_*.py"))
    ]
    return sorted(dict.fromkeys(found), key=lambda name: name != "roughcontact")


def load(name: str, folder: Path | None = None) -> Program | str:
    """Return the program `name`, or the reason why it cannot be shown."""
    try:
        if folder is not None and (path := folder / f"peer_{name}.py").is_file():
            spec = importlib.util.spec_from_file_location(path.stem, path)
            assert spec is not None
            assert spec.loader is not None
            adapter = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(adapter)
        else:
            adapter = importlib.import_module(f"suite.peer_{name}")
        version = getattr(adapter, "VERSION", None) or importlib.metadata.version(adapter.PACKAGE)
    except ImportError as error:  # a missing package, or a shared library that it misses
        return str(error)
    return Program(name, version, adapter)


def limit_threads(count: int) -> None:
    """Give this process and every library in it `count` cores; to be called before any of them is imported."""
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[variable] = str(count)
    if hasattr(os, "sched_setaffinity"):  # what counts cores by itself finds no more than these
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:count])
