"""The folder of a running server; folders of killed servers are removed."""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from filelock import FileLock, Timeout

from roughcontact.kernels.disk import private

__all__ = ["SCRATCH", "server_folder"]

SCRATCH = "scratch"  # subfolder for temporary files of workers, made after the folder is locked
_PREFIX = "roughcontact-page-"
# Another process holds the lock, it cannot be made, or the file system has no locks.
_UNLOCKABLE = (Timeout, OSError, NotImplementedError)
_LOCK = "lock"  # held until the server ends, however it ends


@contextlib.contextmanager
def server_folder() -> Iterator[Path]:
    """Keep a private folder of this user while the block runs; folders of killed servers are removed."""
    _remove_left()
    with tempfile.TemporaryDirectory(prefix=_PREFIX, ignore_cleanup_errors=True) as name:
        folder = Path(name)
        with contextlib.ExitStack() as held:
            with contextlib.suppress(*_UNLOCKABLE):
                held.enter_context(_lock(folder))
            (folder / SCRATCH).mkdir(mode=0o700)
            yield folder


def _remove_left() -> None:
    # A server that is starting has no such subfolder yet, or has locked its folder.
    for scratch in Path(tempfile.gettempdir()).resolve().glob(f"{_PREFIX}*/{SCRATCH}"):
        folder = scratch.parent
        with contextlib.suppress(*_UNLOCKABLE):
            if private(folder) == folder:  # neither a link nor a folder of another user
                with _lock(folder):
                    shutil.rmtree(folder, ignore_errors=True)


def _lock(folder: Path) -> FileLock:
    return FileLock(folder / _LOCK, timeout=0)
