"""Members of a zip archive held in memory, or a clear refusal."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from io import BytesIO

from roughcontact.files.errors import ReadError

__all__ = ["unzip"]


def unzip(data: bytes, file: str, wanted: Callable[[str], bool]) -> dict[str, bytes]:
    """Return the members whose name is `wanted`, by name, each checked against its checksum."""
    try:
        with zipfile.ZipFile(BytesIO(data)) as archive:
            return {member: archive.read(member) for member in archive.namelist() if wanted(member)}
    except Exception as error:  # a damaged archive fails in a dozen ways, from struct.error to zlib.error
        raise ReadError(
            file, f"its zip archive is damaged or cut short ({error})", "copy or export the file again"
        ) from error
