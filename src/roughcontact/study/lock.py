"""One coordinator a store: a lock that the operating system holds, and frees however the process ends."""

from __future__ import annotations

from pathlib import Path

from filelock import FileLock, Timeout

from roughcontact.study.study_errors import StoreError, disk_trouble

__all__ = ["locked"]


def locked(folder: Path) -> FileLock:
    """Return the lock of a store, taken.

    Raises
    ------
    StoreError
        If another process holds it, or the folder cannot be written.
    """
    lock = FileLock(folder / "lock")
    try:
        lock.acquire(timeout=0)
    except Timeout:
        raise StoreError(
            folder,
            "another process is running a study in this folder",
            "wait for its end, or stop it with Ctrl-C; 'roughcontact study status' works meanwhile",
        ) from None
    except (OSError, NotImplementedError) as error:  # the latter where a file system has no locks
        raise disk_trouble(folder, "the folder cannot be locked for writing", error) from error
    return lock
