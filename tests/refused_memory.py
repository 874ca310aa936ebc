"""Memory of NumPy's arrays that is refused at a chosen allocation.

See numpy.org/doc/stable/reference/c-api/data_memory.html. Arrays of a few numbers are not refused: NumPy itself fails
then with other errors than MemoryError.
"""

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np

_SIZE, _PLACE = ctypes.c_size_t, ctypes.c_void_p
_MALLOC = ctypes.CFUNCTYPE(_PLACE, _PLACE, _SIZE)
_CALLOC = ctypes.CFUNCTYPE(_PLACE, _PLACE, _SIZE, _SIZE)
_REALLOC = ctypes.CFUNCTYPE(_PLACE, _PLACE, _PLACE, _SIZE)
_FREE = ctypes.CFUNCTYPE(None, _PLACE, _PLACE, _SIZE)
_LEAST = 1024  # bytes of an array that is counted
_SET_HANDLER = 304  # of the table of NumPy's functions in C


class _Handler(ctypes.Structure):
    _fields_ = (
        ("name", ctypes.c_char * 127),
        ("version", ctypes.c_uint8),
        ("context", _PLACE),
        ("malloc", _MALLOC),
        ("calloc", _CALLOC),
        ("realloc", _REALLOC),
        ("free", _FREE),
    )


_C = ctypes.CDLL(None)
_C.malloc.restype = _C.calloc.restype = _C.realloc.restype = _PLACE
_C.malloc.argtypes, _C.calloc.argtypes = (_SIZE,), (_SIZE, _SIZE)
_C.realloc.argtypes, _C.free.argtypes = (_PLACE, _SIZE), (_PLACE,)


class RefusedMemory:
    """Counts the allocations of a task, and refuses one of them.

    One object serves a whole process: arrays outlive the task.
    """

    def __init__(self) -> None:
        self.count, self.refused = 0, 0
        self._handler = _Handler(
            b"refused",
            1,
            None,
            _MALLOC(lambda _, size: self._given(_C.malloc, size)),
            _CALLOC(lambda _, number, size: self._given(_C.calloc, number, size)),
            _REALLOC(lambda _, place, size: self._given(_C.realloc, place, size)),
            # Python cannot be called while an exception is raised, and arrays are released then. So free of C is called
            # with the context, which is no place: what a task allocates is not released.
            ctypes.cast(_C.free, _FREE),
        )
        new = ctypes.pythonapi.PyCapsule_New
        new.restype, new.argtypes = ctypes.py_object, (_PLACE, ctypes.c_char_p, _PLACE)
        self._capsule = new(ctypes.addressof(self._handler), b"mem_handler", None)
        pointer = ctypes.pythonapi.PyCapsule_GetPointer
        pointer.restype, pointer.argtypes = _PLACE, (ctypes.py_object, ctypes.c_char_p)
        api = ctypes.cast(
            pointer(np._core._multiarray_umath._ARRAY_API, None), ctypes.POINTER(ctypes.c_void_p)
        )
        self._set = ctypes.PYFUNCTYPE(ctypes.py_object, ctypes.py_object)(api[_SET_HANDLER])

    def run(self, task: Callable[[], Any], refused: int = 0) -> Any:
        """Return what a task returns, without memory for the array that it allocates as the n-th."""
        self.count, self.refused = 0, refused
        before = self._set(self._capsule)
        try:
            return task()
        finally:
            self._set(before)

    def _given(self, allocate: Callable[..., int | None], *sizes: Any) -> int | None:
        if sizes[-1] * (sizes[0] if allocate is _C.calloc else 1) < _LEAST:
            return allocate(*sizes)
        self.count += 1
        return None if self.count == self.refused else allocate(*sizes)
