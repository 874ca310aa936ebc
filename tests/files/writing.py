"""What is right about a file that a test writes: its heights, cells, and what a reader must be told.

All files hold the same hills: whole nanometres, no symmetry, three points missing where the format has a mark for them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from roughcontact.files.dispatch import READERS

Writer = Callable[[np.ndarray, float, float], bytes]

DY, DX = 3e-6, 2e-6  # of a cell [m]
SIZE = (20 * DY, 28 * DX)  # of a map [m]
MISSING = ((2, 2, 11), (3, 4, 20))  # rows and columns


@dataclass(frozen=True, eq=False)
class Written:
    """A file and what is right about it.

    Parameters
    ----------
    name : str
    heights : array
        As they are written [m]; NaN where missing.
    cell : tuple of float
        Its sides (dy, dx) [m].
    is_line : bool
        Whether the first row alone is in the file.
    given : dict
        What a reader must be told.
    write : callable
        ``write(heights, dy, dx)`` returns the content.
    """

    name: str
    heights: np.ndarray
    cell: tuple[float, float]
    is_line: bool
    given: dict[str, Any]
    write: Writer

    @cached_property
    def data(self) -> bytes:
        """The content of the file."""
        return self.write(self.heights, *self.cell)

    @property
    def expected(self) -> np.ndarray:
        """Heights that a right reading gives [m]."""
        return self.heights[0] if self.is_line else self.heights

    @property
    def spacing(self) -> tuple[float, ...]:
        """Spacing that a right reading gives [m]."""
        return self.cell[1:] if self.is_line else self.cell

    @property
    def needs_library(self) -> bool:
        """Whether SurfaceTopography reads it."""
        return Path(self.name).suffix not in READERS


FILES: dict[str, Written] = {}


def hills(ny: int = 20, nx: int = 28) -> np.ndarray:
    """Return heights in whole nanometres, up to some 1500."""
    y, x = np.mgrid[0:ny, 0:nx]
    u, v = x / nx, y / ny
    waves = np.sin(2 * np.pi * u) + 0.6 * np.cos(4 * np.pi * v + 1) + 0.5 * u * v
    return np.rint(800 * (waves - 0.2))


def writes(
    name: str,
    *,
    missing: bool = False,
    square: bool = False,
    positive: bool = False,
    line: bool = False,
    shape: tuple[int, int] = (20, 28),
    given: dict[str, Any] | None = None,
) -> Callable[[Writer], Writer]:
    """Let a function of heights [m], dy and dx [m] write the file `name`.

    Parameters
    ----------
    missing : bool
        Whether the format has a mark for missing points.
    square : bool
        Whether it knows square cells alone.
    positive : bool
        Whether it knows positive heights alone.
    line : bool
        Whether it holds a profile.
    given : dict
        What the reader must be told.
    """

    def kept(write: Writer) -> Writer:
        heights = hills(*shape) * 1e-9
        if positive:
            heights -= heights.min()
        if missing:
            heights[MISSING] = np.nan
        FILES[name] = Written(name, heights, (DX if square else DY, DX), line, given or {}, write)
        return write

    return kept


def nm(heights: np.ndarray, dtype: str, missing: float = 0) -> bytes:
    """Return the heights in whole nanometres."""
    return np.where(np.isnan(heights), missing, np.rint(heights * 1e9)).astype(dtype).tobytes()


def text(values: np.ndarray, separator: str = "\t", form: str = "%d", bad: str = "nan") -> str:
    """Return a matrix as lines."""
    lines = (separator.join(bad if np.isnan(v) else form % v for v in row) for row in np.rint(values))
    return "\n".join(lines) + "\n"
