"""The processor that machine code is made for: the one at hand, or by name one that many machines have in common."""

from __future__ import annotations

import os
from typing import NamedTuple

from roughcontact.errors import InputError

__all__ = ["VARIABLE", "Processor", "is_off", "processor"]

VARIABLE = "ROUGHCONTACT_CPU"  # of the environment, read once by a process
NATIVE, OFF = "native", "off"

# What a machine must have to run the code, by the first part of its triple and by LLVM's name: the levels of the x86-64
# psABI. Loops use nothing that haswell has beyond level 3. No other name reaches LLVM, which ends the process at one
# that it does not know.
_LEVEL_2 = ("cx16", "popcnt", "sahf", "sse3", "sse4.1", "sse4.2", "ssse3")
_LEVEL_3 = (*_LEVEL_2, "avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")
_LEVEL_4 = (*_LEVEL_3, "avx512bw", "avx512cd", "avx512dq", "avx512f", "avx512vl")
_NEEDED: dict[str, dict[str, tuple[str, ...]]] = {
    "x86_64": {
        "x86-64": (),
        "x86-64-v2": _LEVEL_2,
        "x86-64-v3": _LEVEL_3,
        "haswell": _LEVEL_3,
        "x86-64-v4": _LEVEL_4,
    },
    "aarch64": {"generic": ()},
    "arm64": {"generic": ()},
}


class Processor(NamedTuple):
    """What LLVM is given of a processor: its name, and what it has beyond the name or lacks of it."""

    name: str
    features: str


def is_off() -> bool:
    """Whether no machine code is wanted."""
    return _asked() == OFF


def processor() -> Processor:
    """Return the processor that machine code is made for.

    Raises
    ------
    ValueError
        If the environment names one that is not known, or whose instructions this machine lacks.
    """
    from llvmlite import binding

    name, host = _asked(), binding.get_host_cpu_name()
    has = binding.get_host_cpu_features()
    if name == NATIVE:
        return Processor(host, has.flatten())
    known = _NEEDED.get(binding.get_default_triple().partition("-")[0], {})
    choice = f"choose one of {', '.join((NATIVE, OFF, *known))}"
    if name not in known:
        raise InputError(f"{VARIABLE}={name!r} is not a processor known here", choice)
    lacking = [feature for feature in known[name] if not has.get(feature)]
    if lacking:
        raise InputError(
            f"{VARIABLE}={name!r} needs {', '.join(lacking)}, which this machine ({host}) lacks", choice
        )
    return Processor(name, "")


def _asked() -> str:
    return os.environ.get(VARIABLE) or NATIVE
