"""The origin of a result: versions, inputs and their fingerprint, settings, time."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.slabs.by_rows import gather_to_first
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.validation import Array

if TYPE_CHECKING:
    from roughcontact.contact.problem import Body

__all__ = ["provenance", "surface_hash"]


def provenance(
    surface: Body | None = None,
    *,
    modulus: float | None = None,
    control: str | None = None,
    tolerance: float | None = None,
    command: Sequence[str] | str | None = None,
    recipe: Mapping[str, Any] | None = None,
) -> dict[str, str | float]:
    """Return the information that is needed to understand and repeat a result, as attributes of a file.

    Parameters
    ----------
    surface : Surface, optional
        The surface that was pressed: its history is recorded, its heights and grid are hashed.
    modulus : float, optional
        Reduced modulus [Pa].
    control : str, optional
        The prescribed quantity, in words with units: ``"force = 10.0 N"``.
    tolerance : float, optional
        Requested tolerance of the certificate.
    command : str or sequence of str, optional
        The command line, if there was one.
    recipe : mapping, optional
        The job as plain values, which are written as JSON.

    Returns
    -------
    dict
        Words and numbers only. The time is UTC, in ISO 8601.
    """
    import scipy

    from roughcontact.version import __version__

    now = datetime.now(UTC).isoformat(timespec="seconds")
    lines: dict[str, str | float | None] = {
        "source": f"roughcontact {__version__}",
        "date_created": now,
        "python_version": platform.python_version(),
        "numpy_version": np.__version__,
        "scipy_version": scipy.__version__,
        "input_reduced_modulus_in_Pa": modulus,
        "input_control": control,
        "tolerance": tolerance,
    }
    if surface is not None:
        lines["input_surface"] = "\n".join(surface.provenance) or "not stated"
        lines["input_sha256"] = surface_hash(surface)
    if command is not None:
        text = command if isinstance(command, str) else " ".join(command)
        lines["history"] = f"{now}: {text}"
    if recipe is not None:
        lines["recipe"] = json.dumps(recipe, ensure_ascii=True)
    return {name: _plain(value) for name, value in lines.items() if value is not None}


def _plain(value: str | float) -> str | float:
    """Return text that every file can hold: bytes of a file name that are not letters become question marks."""
    return value.encode("utf-8", "replace").decode("utf-8") if isinstance(value, str) else value


def surface_hash(surface: Body) -> str:
    """Return the SHA-256 of the heights and the grid of a surface, as 64 hexadecimal digits.

    Equal surfaces have equal hashes on every machine, and in slabs: heights count as little-endian doubles in the
    order of the rows, every NaN as the same NaN, -0 as 0.
    """
    grid = surface.grid
    heights: Any = surface.heights
    digest = hashlib.sha256(repr((grid.shape, grid.spacing, grid.periodic)).encode())
    if isinstance(heights, SlabArray):
        for _, rows in gather_to_first(heights):
            digest.update(b"" if rows is None else _bytes_of_heights(rows))
        digests: list[str] = heights.functions.communicator.allgather(digest.hexdigest())
        return digests[0]
    digest.update(_bytes_of_heights(heights))
    return digest.hexdigest()


def _bytes_of_heights(heights: Array) -> bytes:
    plain = np.where(np.isnan(heights), np.nan, heights + 0.0)
    return np.ascontiguousarray(plain, dtype="<f8").tobytes()
