"""Writing files atomically: into a temporary file first, which is then renamed."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from roughcontact.errors import InputError

__all__ = ["WriteError", "output_folder", "require_target", "written_aside"]


class WriteError(InputError):
    """A result cannot be written where it was asked for; the message names the path and the remedy.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.Surface(np.zeros((4, 4)), rc.Grid((4, 4), 1e-6))
    >>> try:
    ...     rc.write(surface, "part.docx")
    ... except rc.WriteError as error:
    ...     print(error)
    cannot write part.docx: a Surface is written as one of .npz, .nc, .x3p, .txt, .npy, .vti
    """


@contextmanager
def written_aside(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield the path of a temporary file; rename it to `path` when the block ends well.

    The temporary file lies in the same folder, because only there is a rename atomic. If the block fails or is
    interrupted, the file is removed and `path` stays as it was.

    Raises
    ------
    WriteError
        If `path` cannot be written: no such folder, no permission, a folder of that name, a full disk.
    """
    target = require_target(path)
    aside = target.with_name(f".{secrets.token_hex(6)}.part")
    try:
        yield aside
        os.replace(aside, target)
    except WriteError:
        raise
    except OSError as error:
        raise WriteError(f"cannot write {target}: {_reason(error)}", _REMEDY) from error
    finally:
        # After a rename there is nothing left to remove. This also runs for BaseException, such as an interrupt.
        with suppress(OSError):
            aside.unlink(missing_ok=True)


@contextmanager
def output_folder(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a folder that exists and can be written; create it, with its parents, if needed.

    Enter it before a long computation. If the block fails, the folders created here are removed again unless they hold
    something.

    Raises
    ------
    WriteError
        If the folder cannot be created or written.
    """
    folder = Path(os.path.realpath(path))
    created = [parent for parent in (folder, *folder.parents) if not parent.exists()]
    try:
        _make_writable(folder)
        yield folder
    except BaseException:
        with suppress(OSError):
            for each in created:  # the innermost first; the first that is not empty ends it
                each.rmdir()
        raise


_REMEDY = "choose another place or change its permissions"


def _make_writable(folder: Path) -> None:
    """Create `folder`, and check by a temporary file that it can be written."""
    for each in (folder, *folder.parents):
        if each.exists() and not each.is_dir():
            raise WriteError(f"cannot use {folder} as a folder: {each} is a file", "choose another name")
    probe = folder / f".{secrets.token_hex(6)}.part"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe.touch(exist_ok=False)
        probe.unlink()
    except OSError as error:
        raise WriteError(f"cannot write in the folder {folder}: {_reason(error)}", _REMEDY) from error


def require_target(path: str | os.PathLike[str]) -> Path:
    """Return the file that writing to `path` will replace or create; call it before a long computation.

    Raises
    ------
    WriteError
        If it cannot be written: no such folder, no permission, a folder of that name.
    """
    # A link is followed: its target is replaced and the link stays.
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise WriteError(f"cannot write {target}: it is a folder", "add a file name")
    if target.exists() and not target.is_file():
        raise WriteError(f"cannot write {target}: it is a device or a pipe", "choose an ordinary file")
    if not target.parent.is_dir():
        raise WriteError(f"cannot write {target}: there is no folder {target.parent}", "create it first")
    if target.exists() and not os.access(target, os.W_OK):
        # A rename would replace a protected file without asking.
        raise WriteError(f"cannot write {target}: the file is write-protected", _REMEDY)
    return target


def _reason(error: OSError) -> str:
    return error.strerror or str(error) or type(error).__name__
