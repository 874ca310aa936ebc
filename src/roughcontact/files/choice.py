"""Which channels of a file are heights, and which of them is read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import Channel, describe, names_a_height, names_something_else, pick
from roughcontact.files.length_units import is_length

__all__ = ["AS_TEXT", "choose", "holds_a_profile", "marked"]

AS_TEXT = "give a map of heights, or export the profile as a text of two columns, places and heights"


def marked(channels: Sequence[Channel]) -> tuple[Channel, ...]:
    """Return the channels with heights marked by name and unit; the second of two equal names gets ``#2``."""
    seen: Counter[str] = Counter()
    named = []
    for channel in channels:
        seen[channel.name] += 1
        count = seen[channel.name]
        named.append(channel if count == 1 else replace(channel, name=f"{channel.name}#{count}"))
    return tuple(replace(channel, is_height=_is_height(channel, named)) for channel in named)


def _is_height(channel: Channel, channels: Sequence[Channel]) -> bool:
    """Whether a map is named as a height, or is the only one and not named otherwise; its unit may be missing."""
    if not _is_map(channel) or not (channel.unit is None or is_length(channel.unit)):
        return False
    alone = sum(map(_is_map, channels)) == 1
    return names_a_height(channel.name) or (alone and not names_something_else(channel.name))


def _is_map(channel: Channel) -> bool:
    return len(channel.shape) == 2 and min(channel.shape) >= 2


def choose(channels: Sequence[Channel], wanted: str | int | None) -> tuple[int, tuple[str, ...]]:
    """Return the position of the channel to read, and a warning if another channel would also fit."""
    if wanted is not None:
        index = pick(channels, wanted)
        return index, _warnings(channels[index])
    if not any(map(_is_map, channels)):
        raise ContentError(
            f"it holds no map but {describe(channels)}",
            AS_TEXT,
        )
    heights = [k for k, c in enumerate(channels) if c.is_height and c.unit is not None]
    if not heights:  # without a unit they need that of the user, which is checked later
        heights = [k for k, c in enumerate(channels) if c.is_height]
    if not heights:
        raise ContentError(
            f"no channel is a height by its name and unit: {describe(channels)}",
            "pass channel= with a name from this list, and unit= where its unit is no length",
            "channel",
        )
    if len(heights) == 1:
        return heights[0], ()
    names = ", ".join(repr(channels[k].name) for k in heights)
    chosen = channels[heights[0]].name
    return heights[0], (
        f"{len(heights)} channels are heights ({names}); took {chosen!r}, pass channel= for another",
    )


def holds_a_profile(channels: Sequence[Channel]) -> bool:
    """Whether the only channel has a single row."""
    return len(channels) == 1 and channels[0].shape[0] == 1


def _warnings(channel: Channel) -> tuple[str, ...]:
    """Return a warning about a map that the user chose and whose name or unit is not that of heights."""
    other_unit = channel.unit is not None and not is_length(channel.unit)
    if not _is_map(channel) or not (other_unit or names_something_else(channel.name)):
        return ()
    unit = f" in {channel.unit}" if other_unit else ""
    return (f"channel {channel.name!r}{unit} is not marked as heights, but is read as heights",)
