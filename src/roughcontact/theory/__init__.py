"""Theory: pure functions of numbers and of spectral moments, beside every computed curve."""

from __future__ import annotations

import pkgutil
from importlib import import_module
from types import ModuleType

__all__ = sorted(module.name for module in pkgutil.iter_modules(__path__))


def __getattr__(name: str) -> ModuleType:
    if name not in __all__:
        raise AttributeError(f"module 'roughcontact.theory' has no attribute {name!r}; it has {__all__}")
    return import_module(f"{__name__}.{name}")


def __dir__() -> list[str]:
    return __all__
