"""Containers of contact.engineering: a ZIP archive of the measurements of a surface and their metadata."""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import PurePosixPath
from typing import Any

import numpy as np

from roughcontact.errors import InputError
from roughcontact.files.choice import marked
from roughcontact.files.file_bounds import require_memory
from roughcontact.files.file_errors import ContentError, damage
from roughcontact.files.foreign import without_reader
from roughcontact.files.heightmap import Channel, HeightMap, pick
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.measurement.instrument import Instrument

__all__ = ["list_container", "read_container", "stated_in"]

_PREPARED = "squeezed-netcdf"  # by contact.engineering: scaled, filled and levelled as its user chose
_DAMAGED = (
    zipfile.BadZipFile,
    zlib.error,
    ValueError,
    KeyError,
    TypeError,
    EOFError,
    NotImplementedError,
    RuntimeError,
)

Reader = Callable[[bytes, str], HeightMap]


@dataclass(frozen=True, slots=True)
class _Measurement:
    """One measurement: its surface, its name, its file, whether it was prepared, and what the index states."""

    surface: str
    name: str
    file: str
    prepared: bool
    stated: dict[str, Any]


def read_container(data: bytes, channel: str | int | None, *, reader: Reader) -> HeightMap:
    """Return one measurement; the `reader` reads a file of the archive by its extension."""
    with _opened(data) as (archive, measurements):
        names = marked([Channel(one.name, (), None, None, True) for one in measurements])
        try:
            place = pick([replace(name, is_height=True) for name in names], channel)
        except ContentError:  # the files themselves state which of them are maps
            place = pick(_channels(archive, measurements, reader), channel)
        return replace(_read(archive, measurements[place], reader), channel=names[place].name)


def list_container(data: bytes, *, reader: Reader) -> tuple[Channel, ...]:
    """Return the measurements as channels."""
    with _opened(data) as (archive, measurements):
        return _channels(archive, measurements, reader)


def stated_in(data: bytes) -> tuple[tuple[str, str, Instrument], ...]:
    """Return surface, name and instrument of each measurement, in the order of the channels."""
    with _opened(data) as (_, measurements):
        names = marked([Channel(one.name, (), None, None, True) for one in measurements])
        return tuple(
            (one.surface, channel.name, _instrument(one.stated.get("instrument") or {}))
            for one, channel in zip(measurements, names, strict=True)
        )


def _instrument(stated: dict[str, Any]) -> Instrument:
    """Return the instrument that the index states, with the parameters that limit its waves."""
    given = stated.get("parameters") or {}
    lengths: dict[str, Any] = {
        name: float(given[name]["value"]) * length_factor(given[name]["unit"])
        for name in ("resolution", "tip_radius")
        if given.get(name)
    }
    return Instrument(str(stated.get("name") or stated.get("type") or ""), **lengths)


def _channels(
    archive: zipfile.ZipFile, measurements: list[_Measurement], reader: Reader
) -> tuple[Channel, ...]:
    found = [replace(_read(archive, one, reader).as_channel(), name=one.name) for one in measurements]
    # Each measurement is one of heights, whatever its name.
    named = marked(found)
    return tuple(replace(channel, is_height=len(channel.shape) == 2) for channel in named)


def _read(archive: zipfile.ZipFile, measurement: _Measurement, reader: Reader) -> HeightMap:
    """Return the heights of a measurement; the index supplies what its file does not state."""
    info = archive.getinfo(measurement.file)
    require_memory(info.file_size)
    found = reader(archive.read(info), PurePosixPath(measurement.file).suffix.casefold())
    stated, notes = measurement.stated, (*found.notes, f"from {measurement.file} in the container")
    if measurement.prepared:
        mode = stated.get("detrend_mode", "unknown")
        return replace(found, notes=(*notes, f"as contact.engineering prepared it (detrend mode: {mode})"))
    unit = stated.get("unit")
    if found.unit is None and isinstance(unit, str):
        found = replace(found, unit=unit)
    if found.spacing is None and "size" in stated and is_length(unit):
        sides = np.atleast_1d(np.asarray(stated["size"], dtype=np.float64))[::-1] * length_factor(unit or "")
        found = replace(found, spacing=tuple((sides / found.heights.shape).tolist()))
    scale = float(stated.get("height_scale", 1.0))
    if scale != 1.0:
        notes = (*notes, f"heights times {scale:g}, as the container states")
        found = replace(found, heights=found.heights * scale)
    return replace(found, periodic=stated.get("is_periodic", found.periodic), notes=notes)


@contextmanager
def _opened(data: bytes) -> Iterator[tuple[zipfile.ZipFile, list[_Measurement]]]:
    """Yield the archive and its measurements; damage raises ContentError."""
    again = "download it from contact.engineering again"
    with damage("it is damaged", again, _DAMAGED), zipfile.ZipFile(io.BytesIO(data)) as archive:
        yield archive, list(_measurements(_index(archive)))


def _index(archive: zipfile.ZipFile) -> Any:
    names = set(archive.namelist())
    if "index.json" in names:
        return json.loads(archive.read("index.json"))
    if "meta.yml" not in names:
        raise ContentError(
            "it is a ZIP archive without index.json or meta.yml, not a container of contact.engineering",
            "unpack it, and read the files in it",
        )
    try:
        import yaml
    except ImportError as error:
        raise without_reader("yaml", error) from error
    loader: Any = type("Loader", (yaml.SafeLoader,), {})
    # Older containers hold tuples of Python.
    loader.add_constructor("tag:yaml.org,2002:python/tuple", loader.construct_sequence)
    try:
        return yaml.load(archive.read("meta.yml"), Loader=loader)
    except yaml.YAMLError as error:
        raise InputError(str(error).splitlines()[0]) from error


def _measurements(index: Any) -> Iterator[_Measurement]:
    for number, surface in enumerate(index["surfaces"], 1):
        for stated in surface["topographies"]:
            files = stated["datafile"]
            prepared = files.get(_PREPARED)
            file = prepared or files["original"]
            name = str(stated.get("name") or PurePosixPath(file).name)
            owner = str(surface.get("name") or f"surface {number}")
            yield _Measurement(owner, name, file, prepared is not None, stated)
