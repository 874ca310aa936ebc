"""Object code on disk: kept where no other user can write, and given back only for the key that it was kept under."""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import sys
import tempfile
from pathlib import Path

__all__ = ["DIGEST", "cache_folder", "keep", "private", "read"]

DIGEST = 32  # bytes of the digest of key and code, before the code


def read(name: str, key: bytes) -> bytes | None:
    """Return the code that is kept in that file under that key, of 32 bytes; None if there is none to be trusted."""
    try:
        folder = private(cache_folder())
        if folder is None:
            return None
        with open(folder / name, "rb", opener=_without_links) as file:
            if not _is_ours(os.fstat(file.fileno()), stat.S_IFREG):
                return None
            kept = file.read()
    except OSError:
        return None
    digest, code = kept[:DIGEST], kept[DIGEST:]
    return code if digest == _digest(key, code) else None


def keep(name: str, key: bytes, code: bytes) -> None:
    """Keep the code if there is a place for it; a process that reads meanwhile finds the whole code or none."""
    with contextlib.suppress(OSError):
        wanted = cache_folder()
        missing = [place for place in (wanted, *wanted.parents) if not place.exists()]
        for place in reversed(missing):
            place.mkdir(mode=0o700, exist_ok=True)
        folder = private(wanted)
        if folder is None:
            return
        handle, aside = tempfile.mkstemp(dir=folder)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_digest(key, code) + code)
            os.replace(aside, folder / name)
        except OSError:
            Path(aside).unlink(missing_ok=True)
            raise


def private(folder: Path) -> Path | None:
    """Return a folder without links on the way to it; None if another user could write to it or put one in its place.

    It is looked at from the root on: what lies in a folder that no other user can write to stays what it is. A parent
    such as ``/tmp``, where all users write but cannot move the files of others, is safe. Windows by itself keeps others
    out of a user's profile.

    Raises
    ------
    OSError
        If there is no such folder.
    """
    if os.name != "posix":
        return folder
    found = Path(os.path.realpath(folder, strict=True))
    above = all(_is_ours(os.lstat(place), stat.S_IFDIR, parent=True) for place in found.parents[::-1])
    return found if above and _is_ours(os.lstat(found), stat.S_IFDIR) else None


def _is_ours(status: os.stat_result, kind: int, *, parent: bool = False) -> bool:
    """Whether it is a file or folder, as asked, that only this user and root can change; a parent may be sticky."""
    mode, owned = status.st_mode, True
    if sys.platform != "win32":
        shared = mode & (stat.S_IWGRP | stat.S_IWOTH) and not (parent and mode & stat.S_ISVTX)
        owned = not shared and status.st_uid in (0, os.geteuid())
    return owned and stat.S_IFMT(mode) == kind


def _without_links(path: str, flags: int) -> int:
    """Open a file, but not what a link points to, without waiting for a pipe's other end."""
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))


def cache_folder() -> Path:
    """Return the folder where code is kept.

    Raises
    ------
    OSError
        If the user has no home.
    """
    import platformdirs

    folder = platformdirs.user_cache_path("roughcontact")
    if not folder.is_absolute():
        raise FileNotFoundError("a user without a home has no folder for caches")
    return folder


def _digest(key: bytes, code: bytes) -> bytes:
    return hashlib.sha256(key + code).digest()
