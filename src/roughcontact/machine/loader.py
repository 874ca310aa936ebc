"""Machine code: translated once, kept on disk, found there by the next process."""

from __future__ import annotations

import contextlib
import ctypes
import hashlib
import importlib
import importlib.metadata
import os
import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from roughcontact.threads import once

__all__ = ["address", "code_for", "functions", "is_available", "takes"]

COMMON = ("code", "layout", "loader", "stencil", "totals", "values")  # modules whose text all code hangs on
DIGEST = 32  # bytes of the check sum before the code
_POINTER = ctypes.c_void_p
_ENGINES: list[Any] = []  # they own the code that runs
_NAMES = {"f": "float32", "d": "float64"}  # by the short ones, which are sooner found
_REALS = {"float32": ctypes.c_float, "float64": ctypes.c_double}


@once
def is_available() -> bool:
    """Whether LLVM is there and knows this machine; without it NumPy and SciPy do everything."""
    try:
        _target()
    except (AttributeError, ImportError, OSError, RuntimeError):
        return False
    return True


def code_for(family: str, field: Any) -> Mapping[str, Callable[..., None]]:
    """Return the functions of a module for the precision of a NumPy array."""
    return functions(family, _NAMES[field.dtype.char])


@once
def functions(family: str, precision: str) -> Mapping[str, Callable[..., None]]:
    """Return the functions of a module of this package, which take arrays by their addresses.

    Parameters
    ----------
    family : str
        Name of the module. Its ``KINDS`` says which functions there are, with the kinds of their parameters, and its
        ``write(module, precision)`` writes them.
    precision : {"float32", "float64"}

    Notes
    -----
    Other threads run meanwhile. The first call on a machine takes about a second; later processes find the code in
    the user's folder for caches, if there is one.
    """
    writer = importlib.import_module(f"roughcontact.machine.{family}")
    place = _place(family, precision)
    code = None if place is None else _read(place)
    if code is None:
        code = _translated(writer, precision)
        if place is not None:
            _keep(place, code)
    return _loaded(code, writer.KINDS, precision)


def takes(field: Any) -> bool:
    """Whether machine code can work on a field: of NumPy, double or single precision, and the order of this machine."""
    if not isinstance(field, np.ndarray):
        return False
    return field.dtype.char in _NAMES and bool(field.dtype.isnative) and is_available()


def address(array: Any) -> int:
    """Return where a NumPy array begins."""
    try:
        return ctypes.addressof(ctypes.c_char.from_buffer(array))
    except (TypeError, ValueError):  # read only, empty, or not contiguous: a slower way
        found: int = array.__array_interface__["data"][0]
        return found


@cache
def _target() -> Any:
    return _new_target()


def _new_target() -> Any:
    """Return a description of this machine; every engine owns one."""
    from llvmlite import binding

    _ = binding.ModulePassManager.add_sroa_pass  # from 0.45 on
    with contextlib.suppress(RuntimeError):  # newer versions do it by themselves, and say so
        binding.initialize()
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    return binding.Target.from_default_triple().create_target_machine(
        cpu=binding.get_host_cpu_name(),
        features=binding.get_host_cpu_features().flatten(),
        opt=3,
        codemodel="jitdefault",
        jit=True,
    )


def _translated(writer: Any, precision: str) -> bytes:
    from llvmlite import binding, ir

    written = ir.Module(writer.__name__)
    writer.write(written, precision)
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


def _loaded(code: bytes, kinds: Mapping[str, str], precision: str) -> dict[str, Callable[..., None]]:
    from llvmlite import binding

    empty = binding.parse_assembly("")
    engine = binding.create_mcjit_compiler(empty, _new_target())
    engine.add_object_file(binding.ObjectFileRef.from_data(code))
    engine.finalize_object()
    _ENGINES.append(engine)
    types = {
        "index": ctypes.c_int64,
        "indices": _POINTER,
        "reals": _POINTER,
        "doubles": _POINTER,
        "flags": _POINTER,
        "double": ctypes.c_double,
        "real": _REALS[precision],
    }
    return {
        name: ctypes.CFUNCTYPE(None, *(types[kind] for kind in parameters.split()))(
            engine.get_function_address(f"{name}_{precision}")
        )
        for name, parameters in kinds.items()
    }


def _place(family: str, precision: str) -> Path | None:
    """Return where the code would be kept, None if nowhere; its name says all that it hangs on."""
    import platformdirs
    from llvmlite import binding

    here, digest = Path(__file__).parent, hashlib.sha256()
    try:
        texts = [(here / f"{name}.py").read_bytes() for name in (*COMMON, family)]
    except OSError:  # packed in an archive
        return None
    for part in (
        *texts,
        importlib.metadata.version("llvmlite").encode(),
        _target().triple.encode(),
        binding.get_host_cpu_name().encode(),
        binding.get_host_cpu_features().flatten().encode(),
    ):
        digest.update(hashlib.sha256(part).digest())
    folder = platformdirs.user_cache_path("roughcontact")
    if not folder.is_absolute():  # a user without a home
        return None
    return folder / f"{family}-{precision}-{digest.hexdigest()[:32]}.o"


def _read(place: Path) -> bytes | None:
    """Return the code that is kept; None if there is none, or not all of it."""
    try:
        kept = place.read_bytes()
    except OSError:
        return None
    check, code = kept[:DIGEST], kept[DIGEST:]
    return code if hashlib.sha256(code).digest() == check else None


def _keep(place: Path, code: bytes) -> None:
    """Keep the code if there is a place; whoever reads meanwhile finds all of it or none."""
    with contextlib.suppress(OSError):
        place.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=place.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(hashlib.sha256(code).digest() + code)
            os.replace(name, place)
        except OSError:
            Path(name).unlink(missing_ok=True)
            raise
