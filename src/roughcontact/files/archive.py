"""Members of a zip archive held in memory, or a clear refusal."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from io import BytesIO

from roughcontact.files.file_errors import ReadError
from roughcontact.files.file_memory import require_memory

__all__ = ["unzip"]

# The others unpack without a bound on what one step may give; neither NumPy nor X3P use them.
_BOUNDED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)


def unzip(data: bytes, file: str, wanted: Callable[[str], bool]) -> dict[str, bytes]:
    """Return the members whose name is `wanted`, by name, each checked against its size and checksum."""
    try:
        with zipfile.ZipFile(BytesIO(data)) as archive:
            members = [member for member in archive.infolist() if wanted(member.filename)]
            require_memory(sum(member.file_size for member in members), file)
            return {member.filename: _content(archive, member) for member in members}
    except ReadError:
        raise
    except Exception as error:  # a damaged archive fails in a dozen ways, from struct.error to zlib.error
        raise ReadError(
            file, f"its zip archive is damaged or cut short ({error})", "copy or export the file again"
        ) from error


def _content(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes:
    """Return what is in a member: never more than it declares, whatever its compressed bytes unpack to."""
    if member.compress_type not in _BOUNDED:
        raise zipfile.BadZipFile(f"{member.filename} is compressed by method {member.compress_type}")
    with archive.open(member) as stream:
        content = stream.read(member.file_size + 1)
    if len(content) != member.file_size:
        raise zipfile.BadZipFile(f"{member.filename} ends after {len(content)} of {member.file_size} bytes")
    return content
