"""Grids named ``.grd``: the texts of Surfer and of ESRI, or a plain matrix."""

from __future__ import annotations

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap
from roughcontact.files.text import read_text

__all__ = ["read_grd"]


def read_grd(data: bytes) -> HeightMap:
    """Return the heights of a text; a binary grid of Surfer is refused."""
    if data.startswith((b"DSBB", b"DSRB")):
        raise ContentError(
            "it is a binary grid of Surfer, which is not read", "save it in Surfer as a text grid (DSAA)"
        )
    return read_text(data)
