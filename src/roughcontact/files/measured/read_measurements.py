"""Read many maps and profiles of one surface: a container of contact.engineering, a folder, or files."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from roughcontact.errors import InputError
from roughcontact.files.container import stated_in
from roughcontact.files.content import content
from roughcontact.files.dispatch import READERS
from roughcontact.files.file_errors import ReadError
from roughcontact.files.read import read_either
from roughcontact.measurement.instrument import Instrument
from roughcontact.measurement.measurements import Measurements

__all__ = ["read_measurements"]

_PathLike = str | os.PathLike[str]


@dataclass(frozen=True, slots=True)
class _Place:
    """Where a measurement is stored, and what is stated about it."""

    path: _PathLike
    channel: int | None
    surface: str
    name: str
    instrument: Instrument


def read_measurements(
    source: _PathLike | Sequence[_PathLike],
    *,
    surface: str | None = None,
    instruments: Mapping[str, Instrument] | None = None,
    repeats: Sequence[Sequence[str]] = (),
) -> Measurements:
    """Return the maps and profiles of one surface.

    A measurement has the name that its container states, or that of its file.

    Parameters
    ----------
    source : str, path or sequence of them
        A container of contact.engineering (``.zip``), a file that `read` or `read_line` reads, a folder of such
        files, or a list of files. Files of a folder with other endings are named in the notes.
    surface : str, optional
        The surface to read from containers of several surfaces.
    instruments : mapping of str to Instrument, optional
        By the name of a measurement, in place of the instrument that its container states.
    repeats : sequence of sequence of str
        Names of maps of one place on one grid, whose differences are noise.

    Returns
    -------
    Measurements

    Raises
    ------
    ReadError
        If a file cannot be read, or states no unit or size.
    ValueError
        If there is no measurement, containers hold several surfaces, points are missing, or a map is of another
        surface than the others.

    Examples
    --------
    >>> import roughcontact as rc
    >>> for seed in (1, 2):
    ...     rc.write(rc.self_affine(rc.Grid((64, 64), 1e-6), 0.8, 1e-7, seed), f"place{seed}.npz")
    >>> many = rc.read_measurements(["place1.npz", "place2.npz"], instruments={"place1.npz": rc.Instrument("AFM")})
    >>> [(one.name, one.instrument.name) for one in many]
    [('place1.npz', 'AFM'), ('place2.npz', '')]
    """
    files, left_out = _files(source)
    places = [place for file in files for place in _places(file)]
    stated = sorted({place.surface for place in places if place.surface})
    if surface is None and len(stated) > 1:
        raise InputError(
            f"the containers hold {len(stated)} surfaces",
            f"name one by surface=, of {', '.join(map(repr, stated))}",
            "surface",
        )
    if surface is not None and surface not in stated:
        remedy = f"choose from {', '.join(map(repr, stated))}" if stated else "leave it out"
        raise InputError(f"no container states a surface {surface!r}", remedy, "surface")
    places = [place for place in places if surface is None or place.surface == surface]
    names = [place.name for place in places]
    if not places:
        raise InputError(
            "there is no measurement to read",
            "name files, or a folder or container that holds some",
            "source",
        )
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise InputError(f"two measurements are named {twice[0]!r}", "rename a file", "source")
    maps = {}
    for place in places:
        try:
            maps[place.name] = read_either(place.path, channel=place.channel)
        except ReadError as error:
            if error.place is None:
                raise
            alone = "" if place.channel is None else f"channel={place.channel}, "
            remedy = (
                f"read it by rc.read(..., {alone}unit=..., size=...), and give all maps to rc.Measurements.of"
            )
            raise ReadError(place.name, error.problem, remedy, "source") from error
    found = {place.name: place.instrument for place in places} | dict(instruments or {})
    return Measurements.of(
        maps, instruments=found, repeats=repeats, surface=surface or "".join(stated), left_out=left_out
    )


def _files(source: _PathLike | Sequence[_PathLike]) -> tuple[list[Path], list[str]]:
    """Return the files to read, and the names of those in folders whose ending is not that of a map."""
    known, left_out = [], []
    for path in map(Path, [source] if isinstance(source, str | os.PathLike) else source):
        if not path.is_dir():
            known.append(path)
            continue
        inside = sorted(each for each in path.iterdir() if each.is_file() and not each.name.startswith("."))
        maps = [each for each in inside if each.suffix.casefold() in READERS]
        known += maps
        left_out += [each.name for each in inside if each not in maps]
    return known, left_out


def _places(path: Path) -> list[_Place]:
    """Return the measurements in a file."""
    if path.suffix.casefold() != ".zip":
        return [_Place(path, None, "", path.name, Instrument())]
    with content(path) as (_, data):
        return [_Place(path, k, *stated) for k, stated in enumerate(stated_in(data))]
