"""Machine code: translated once, kept on disk, found there by the next process."""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.kernels import disk
from roughcontact.kernels.calls import Function
from roughcontact.kernels.processor import is_off, processor
from roughcontact.kernels.team import Team
from roughcontact.threads import once

if TYPE_CHECKING:
    from roughcontact.kernels.signature import KernelDefinition

__all__ = ["code_for", "functions", "is_available", "takes"]

# Modules whose text all code depends on.
COMMON = (
    *("calls", "code", "constants", "team", "team_kernels", "groups", "loader"),
    *("signature", "totals", "values"),
)
_ENGINES: list[Any] = []  # they own the code that runs
_TEAM: list[Team] = []  # the one, of the first code that was loaded
_NAMES = {"f": "float32", "d": "float64"}  # by the short ones, which are sooner found


@once
def is_available() -> bool:
    """Whether LLVM makes code that runs here, and is wanted; without it NumPy and SciPy do everything.

    Raises
    ------
    ValueError
        If the environment names a processor that is not known, or whose instructions this machine lacks.
    """
    if is_off():
        return False
    try:
        functions("block_kernels", "float64")  # the smallest
    except (AttributeError, ImportError, OSError, RuntimeError, TypeError):
        return False
    return True


def code_for(family: str, field: Any) -> Mapping[str, Function]:
    """Return the functions of a module for the precision of a NumPy array."""
    return functions(family, _NAMES[field.dtype.char])


@once
def functions(family: str, precision: str) -> Mapping[str, Function]:
    """Return the kernels of a module of this package in machine code, by name.

    Parameters
    ----------
    family : str
        Name of the module.
    precision : {"float32", "float64"}

    Notes
    -----
    Other threads run meanwhile. The first call on a machine takes about a second; later processes find the code in
    the user's folder for caches, if there is one and no other user can write to it.
    """
    kernels, key = _kernels(family), _key(family, precision)
    if key is None:
        return _loaded(_translated(kernels, precision), kernels, precision)
    file = f"{family}-{precision}-{key.hex()[:32]}.o"
    found = disk.read(file, key)
    if found is not None:
        with contextlib.suppress(RuntimeError):
            return _loaded(found, kernels, precision)
    code = _translated(kernels, precision)
    loaded = _loaded(code, kernels, precision)
    disk.keep(file, key, code)
    return loaded


def takes(field: Any) -> bool:
    """Whether machine code can work on a field: of NumPy, double or single precision, and the order of this machine."""
    if not isinstance(field, np.ndarray):
        return False
    return field.dtype.char in _NAMES and bool(field.dtype.isnative) and is_available()


def _families() -> Mapping[str, Any]:
    """Return the modules of kernels, imported late and by names that bundlers of programs see."""
    from roughcontact.kernels import (
        block_kernels,
        dense_kernels,
        fft,
        near_kernels,
        plane_kernels,
        tile_kernels,
        vector_kernels,
    )

    families = block_kernels, dense_kernels, fft, near_kernels, plane_kernels, tile_kernels, vector_kernels
    return {family.__name__.rpartition(".")[2]: family for family in families}


def _kernels(family: str) -> Mapping[str, KernelDefinition]:
    """Return the kernels of a module, by name."""
    from roughcontact.kernels.signature import KernelDefinition

    found = [k for k in vars(_families()[family]).values() if isinstance(k, KernelDefinition)]
    return {kernel.name: kernel for kernel in found if kernel.packed}


@cache
def _target() -> Any:
    return _new_target()


def _new_target() -> Any:
    """Return a description of the processor; every engine owns one."""
    from llvmlite import binding

    _ = binding.ModulePassManager.add_sroa_pass  # from 0.45 on
    with contextlib.suppress(RuntimeError):  # newer versions do it by themselves, and say so
        binding.initialize()
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    return binding.Target.from_default_triple().create_target_machine(
        cpu=processor().name,
        features=processor().features,
        opt=3,
        codemodel="jitdefault",
        jit=True,
    )


def _translated(kernels: Mapping[str, KernelDefinition], precision: str) -> bytes:
    from llvmlite import binding, ir

    from roughcontact.kernels.code import Code
    from roughcontact.kernels.team_kernels import _lead, _serve

    written = ir.Module()
    for kernel in (*kernels.values(), _lead, _serve):
        Code(written, kernel, precision)
    module = binding.parse_assembly(str(written))
    module.triple, module.data_layout = _target().triple, str(_target().target_data)
    options = binding.create_pipeline_tuning_options(speed_level=0)
    passes = binding.create_pass_builder(_target(), options)
    manager = binding.create_new_module_pass_manager()
    manager.add_sroa_pass()
    manager.add_instruction_combine_pass()
    manager.add_simplify_cfg_pass()
    manager.run(module, passes)
    return bytes(_target().emit_object(module))


def _loaded(code: bytes, kernels: Mapping[str, KernelDefinition], precision: str) -> dict[str, Function]:
    """Return the functions in some object code.

    Raises
    ------
    RuntimeError
        If one of them is not in it.
    """
    from llvmlite import binding

    empty = binding.parse_assembly("")
    engine = binding.create_mcjit_compiler(empty, _new_target())
    engine.add_object_file(binding.ObjectFileRef.from_data(code))
    engine.finalize_object()
    names = *kernels, "_lead", "_serve"
    *places, lead, serve = (engine.get_function_address(f"{name}_{precision}") for name in names)
    if 0 in (*places, lead, serve):
        raise RuntimeError(f"not all of {', '.join(names)} are in the code")
    _ENGINES.append(engine)
    if not _TEAM:
        _TEAM.append(Team(lead, serve))
    return {
        kernel.name: Function(kernel.name, kernel.parameters(precision), place, _TEAM[0])
        for kernel, place in zip(kernels.values(), places, strict=True)
    }


def _key(family: str, precision: str) -> bytes | None:
    """Return a digest of all that the code depends on; None where the texts are missing, as in bundles of programs."""
    from llvmlite import __version__, binding

    try:
        texts = [_text(name) for name in (*COMMON, family)]
    except OSError:
        return None
    llvm = ".".join(map(str, binding.llvm_version_info))
    parts = (family, precision, __version__, llvm, _target().triple, *processor())
    digest = hashlib.sha256()
    for part in (*(part.encode() for part in parts), *texts):
        digest.update(hashlib.sha256(part).digest())
    return digest.digest()


def _text(module: str) -> bytes:
    return resources.files("roughcontact.kernels").joinpath(f"{module}.py").read_bytes()
