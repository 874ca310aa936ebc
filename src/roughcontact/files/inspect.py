"""What a file holds, without deciding what to read."""

from __future__ import annotations

import os

from roughcontact.files.channels import Channel
from roughcontact.files.content import content
from roughcontact.files.dispatch import channels_of

__all__ = ["Channel", "channels"]


def channels(path: str | os.PathLike[str]) -> tuple[Channel, ...]:
    """Return the channels of a file in its order: name, shape, unit, size [m], and whether they are heights.

    Raises
    ------
    ReadError
        If the file cannot be read.
    """
    file, data = content(path)
    return channels_of(data, file)
