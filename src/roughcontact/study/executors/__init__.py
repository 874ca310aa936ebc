"""Where tasks are computed: here, in processes of this machine, or on a cluster."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__all__ = ["Dask", "Processes", "Serial", "Slurm"]

if TYPE_CHECKING:
    from roughcontact.study.executors.dask import Dask as Dask
    from roughcontact.study.executors.processes import Processes as Processes
    from roughcontact.study.executors.serial import Serial as Serial
    from roughcontact.study.executors.slurm import Slurm as Slurm


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{name.lower()}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
