"""What a file holds, without deciding what to read."""

from __future__ import annotations

import os

from roughcontact.files.arrays import list_npz
from roughcontact.files.channels import Channel
from roughcontact.files.dispatch import SINGLE, content, only_channel, suffix
from roughcontact.files.foreign import list_foreign

__all__ = ["Channel", "channels"]


def channels(path: str | os.PathLike[str]) -> tuple[Channel, ...]:
    """Return the channels of a file in its order: name, shape, unit, size [m], and whether they are heights.

    Raises
    ------
    ReadError
        If the file cannot be read.
    """
    file, data = content(path)
    kind = suffix(file)
    if kind in SINGLE:
        return (only_channel(SINGLE[kind](data, file)),)
    if kind == ".npz":
        return list_npz(data, file)
    return list_foreign(data, file)
