"""How much memory a run will need, and a refusal before the machine comes to a halt."""

from __future__ import annotations

import math
import warnings
import zipfile
from pathlib import Path
from typing import IO

import numpy as np
import psutil

from roughcontact.cli.errors import UsageError, note, plain

__all__ = ["require_memory", "require_memory_to_read"]

_WORTH_SAYING = 1e9  # [bytes]
# Reading a map takes up to 92 bytes a point beside the file itself, most of them for the look at spikes and noise.
_BYTES_PER_POINT = 100
# Where the number of points cannot be told from outside, the file is taken for numbers of four bytes.
_TIMES_THE_FILE = _BYTES_PER_POINT // 4


def require_memory(need: int, shape: tuple[int, ...]) -> None:
    """Say how much memory a big run takes, and refuse one beyond what is free.

    Parameters
    ----------
    need : int
        Memory of the run at its peak [bytes].
    shape : tuple of int
        The grid it is for, named in the message.

    Raises
    ------
    UsageError
        If the run needs more than the machine has free.
    """
    _require(need, f"a grid of {' x '.join(str(n) for n in shape)} cells", "use fewer points")


def require_memory_to_read(file: Path) -> None:
    """Refuse a file that cannot be read in the memory that is free; say so of one that takes much.

    Points are counted from the headers of ``.npy`` and ``.npz``. Any other file is taken to need 25 times its size,
    unpacked.

    Raises
    ------
    UsageError
        If reading it needs more than the machine has free.
    """
    try:
        need = _need(file)
    except (OSError, ValueError, EOFError, NotImplementedError, zipfile.BadZipFile):
        return  # missing or damaged, which its reader puts into words
    _require(need, f"reading {plain(str(file))}", "cut the map or thin it out")


def _require(need: int, what: str, remedy: str) -> None:
    free = psutil.virtual_memory().available
    if need > free:
        raise UsageError(
            f"{what} needs {_gigabytes(need)} of memory, and {_gigabytes(free)} are free: "
            f"{remedy}, or use a machine with more memory"
        )
    if need > _WORTH_SAYING:
        note(f"{what} needs about {_gigabytes(need)} of memory; {_gigabytes(free)} are free")


def _need(file: Path) -> int:
    """Return an upper estimate of the memory that reading `file` takes [bytes]."""
    size = file.stat().st_size
    kind = file.suffix.casefold()
    if kind == ".npy":
        with open(file, "rb") as stream:
            return size + _BYTES_PER_POINT * _points(stream)
    if kind not in (".npz", ".x3p"):
        return _TIMES_THE_FILE * size
    with zipfile.ZipFile(file) as archive:
        unpacked = sum(member.file_size for member in archive.infolist())
        if kind == ".x3p":
            return _TIMES_THE_FILE * unpacked
        points = 0
        for member in archive.namelist():
            if member.endswith(".npy"):
                with archive.open(member) as stream:
                    points = max(points, _points(stream))
        return size + 2 * unpacked + _BYTES_PER_POINT * points


def _points(stream: IO[bytes]) -> int:
    """Return the number of points that the header of a NumPy array announces."""
    version = np.lib.format.read_magic(stream)
    older = version == (1, 0)
    header = np.lib.format.read_array_header_1_0 if older else np.lib.format.read_array_header_2_0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # remarks on headers written by old versions
        return math.prod(header(stream)[0])


def _gigabytes(size: float) -> str:
    return f"{size / 1e9:.3g} GB"
