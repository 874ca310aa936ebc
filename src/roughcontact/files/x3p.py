"""X3P, the format of ISO 25178-72: a zip archive of ``main.xml`` and the heights beside or inside it."""

from __future__ import annotations

import hashlib
import io
import math
import posixpath
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from types import SimpleNamespace
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_bounds import unzip
from roughcontact.files.file_errors import ContentError, damage
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["parse_xml", "read_x3p", "x3p_bytes"]

_TYPES = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}
_AGAIN = "export the surface again"
_POINTS = "bindata/data.bin"


def read_x3p(data: bytes) -> HeightMap:
    """Return the surface in an X3P file; heights and spacing are in metres by definition."""
    folder, main = _main_of(data)
    root = parse_xml(main)
    axes = root.child("Record1/Axes")
    shape = _shape(root)
    kind = root.text("Record1/FeatureType", "SUR")
    if kind != "SUR" and not (kind == "PRF" and shape[0] == 1):
        raise ContentError(f"it holds a feature of type {kind}, not a surface (SUR)", "give a map of heights")
    for axis in ("CX", "CY") if kind == "SUR" else ("CX",):
        if axes.text(f"{axis}/AxisType", "I") != "I":
            raise ContentError(f"its axis {axis} is not incremental", f"{_AGAIN} on a regular grid")
    values, notes, warnings = _values(data, folder, main, root, shape)
    # An absolute axis needs no increment, but programs that write whole numbers put their scale there.
    with np.errstate(all="ignore"):
        heights = values * axes.number("CZ/Increment", 1.0) + axes.number("CZ/Offset", 0.0)
    if infinite := int(np.isinf(heights).sum()):  # some instruments mark missing points by infinity
        heights = np.where(np.isinf(heights), np.nan, heights)
        notes = (*notes, f"{infinite} infinite heights count as missing")
    if kind == "PRF":
        line = as_heights(heights[0])
        return HeightMap(
            line, "X3P", unit="m", spacing=(axes.number("CX/Increment"),), notes=notes, warnings=warnings
        )
    return HeightMap(
        as_heights(heights),
        "X3P",
        unit="m",
        spacing=(axes.number("CY/Increment"), axes.number("CX/Increment")),
        notes=notes,
        warnings=warnings,
    )


def _main_of(data: bytes) -> tuple[str, bytes]:
    """Return the folder and the content of the uppermost ``main.xml``."""
    found = unzip(data, lambda member: posixpath.basename(member) == "main.xml")
    if not found:
        raise ContentError("its archive holds no main.xml", "check that it is an X3P file (ISO 25178-72)")
    member = min(found, key=lambda name: (name.count("/"), name))
    return posixpath.dirname(member), found[member]


def _shape(root: _Node) -> tuple[int, int]:
    """Return (SizeY, SizeX)."""
    sizes = []
    for name in ("SizeY", "SizeX", "SizeZ"):
        text = root.child("Record3/MatrixDimension").text(name, "1" if name == "SizeZ" else "")
        if not (text.isascii() and text.isdigit() and int(text[:12]) > 0):
            raise ContentError(f"its main.xml states {text!r} for {name}", _AGAIN)
        sizes.append(int(text[:12]))
    if sizes[2] != 1:
        raise ContentError(f"it holds {sizes[2]} layers", f"{_AGAIN} as a single layer")
    return sizes[0], sizes[1]


def _values(
    data: bytes, folder: str, main: bytes, root: _Node, shape: tuple[int, int]
) -> tuple[Array, tuple[str, ...], tuple[str, ...]]:
    """Return the numbers of the data list or the linked file as float64, NaN where invalid; remarks, warnings."""
    kind = root.child("Record1/Axes").text("CZ/DataType")
    if kind not in _TYPES:
        raise ContentError(f"its heights are of the type {kind!r}, not one of I, L, F, D", _AGAIN)
    link = root.text("Record3/DataLink/PointDataLink")
    mask_link = root.text("Record3/DataLink/ValidPointsLink")
    checksum_file = root.text("Record4/ChecksumFile", "md5checksum.hex")
    paths = {_resolve(folder, target) for target in (link, mask_link, checksum_file) if target}
    members = unzip(data, lambda member: posixpath.normpath(member) in paths)
    members = {posixpath.normpath(name): content for name, content in members.items()}

    points = b""
    if link:
        points = _member(members, _resolve(folder, link))
        _check(points, root.text("Record3/DataLink/MD5ChecksumPointData"), "the heights")
        values = _binary(points, _TYPES[kind], shape)
    else:
        values = _listed(root.child("Record3/DataList"), shape)
    if mask_link:
        mask = _member(members, _resolve(folder, mask_link))
        _check(mask, root.text("Record3/DataLink/MD5ChecksumValidPoints"), "the valid points")
        values = np.where(_valid(mask, shape), values, np.nan)
    guarded = bool(link and root.text("Record3/DataLink/MD5ChecksumPointData"))
    return values, *_check_main(members.get(_resolve(folder, checksum_file)), main, points, guarded)


def _resolve(folder: str, link: str) -> str:
    """Return the name of a linked member; links count from the folder of ``main.xml``."""
    return posixpath.normpath(posixpath.join(folder, link.replace("\\", "/")))


def _member(members: Mapping[str, bytes], path: str) -> bytes:
    if path not in members:
        raise ContentError(f"its archive lacks {path}, which its main.xml names", _AGAIN)
    return members[path]


def _binary(points: bytes, dtype: str, shape: tuple[int, int]) -> Array:
    expected = math.prod(shape) * np.dtype(dtype).itemsize
    if len(points) != expected:
        raise ContentError(
            f"its heights take {len(points)} bytes where {shape[0]} x {shape[1]} points need {expected}",
            _AGAIN,
        )
    with np.errstate(all="ignore"):  # signalling NaN
        return np.frombuffer(points, dtype=dtype).reshape(shape).astype(np.float64)


def _listed(data_list: _Node, shape: tuple[int, int]) -> Array:
    """Return the heights in the text of the XML; an empty entry is a missing point."""
    values = []
    for index, datum in enumerate(d for d in data_list.element if _local_name(d) == "Datum"):
        text = (datum.text or "").strip()
        try:
            values.append(float(text) if text else math.nan)
        except ValueError:
            raise ContentError(
                f"entry {index + 1} of its data list is {text!r}, not one height", _AGAIN
            ) from None
    if len(values) != math.prod(shape):
        raise ContentError(
            f"its data list has {len(values)} entries for {shape[0]} x {shape[1]} points", _AGAIN
        )
    return np.array(values).reshape(shape)


def _valid(mask: bytes, shape: tuple[int, int]) -> npt.NDArray[np.bool_]:
    """Return the valid points: one bit a point, the lowest bit first, in the order of the heights."""
    count = math.prod(shape)
    if len(mask) != (count + 7) // 8:
        raise ContentError(f"its list of valid points has {len(mask)} bytes for {count} points", _AGAIN)
    bits: npt.NDArray[Any] = np.unpackbits(
        np.frombuffer(mask, dtype=np.uint8), count=count, bitorder="little"
    )
    return bits.astype(np.bool_).reshape(shape)


def _check(content: bytes, stated: str, what: str) -> None:
    if stated and stated.casefold() != hashlib.md5(content, usedforsecurity=False).hexdigest():
        raise ContentError(
            f"the checksum of {what} is wrong: the file is damaged", f"copy it again, or {_AGAIN}"
        )


def _check_main(
    stated: bytes | None, main: bytes, points: bytes, guarded: bool
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Compare the checksum of ``main.xml``, and return a note or a warning if it differs.

    Some writers put the checksum of the heights there instead. Programs that edit ``main.xml`` leave a stale one: the
    file is read only if the heights have a separate checksum, which is right.
    """
    words = (stated or b"").split()
    if not words:
        return (), ()
    checksum = words[0].decode("latin-1").casefold()
    if checksum == hashlib.md5(main, usedforsecurity=False).hexdigest():
        return (), ()
    if points and checksum == hashlib.md5(points, usedforsecurity=False).hexdigest():
        return ("the checksum file states the heights instead of main.xml; they agree",), ()
    if guarded:
        return (), (
            "the checksum of main.xml is wrong, that of its heights is right: main.xml was changed after it was "
            "written; compare its steps and unit with the instrument's",
        )
    raise ContentError(
        "the checksum of main.xml is wrong: the file is damaged", f"copy it again, or {_AGAIN}"
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Node:
    """An element that finds its descendants by paths of local names: writers disagree about the namespace."""

    element: ElementTree.Element

    def find(self, path: str) -> ElementTree.Element | None:
        """Return the element at `path`, or None."""
        element: ElementTree.Element | None = self.element
        for part in path.split("/"):
            if element is not None:
                element = next((child for child in element if _local_name(child) == part), None)
        return element

    def child(self, path: str) -> _Node:
        """Return the element at `path`, which must be there."""
        element = self.find(path)
        if element is None:
            raise ContentError(f"its main.xml has no {path}", _AGAIN)
        return _Node(element)

    def text(self, path: str, default: str = "") -> str:
        """Return the text at `path`, or `default` where it is absent or empty."""
        element = self.find(path)
        text = "" if element is None else (element.text or "").strip()
        return text or default

    def number(self, path: str, default: float | None = None) -> float:
        """Return the finite number at `path`, or `default` where it is absent or empty."""
        text = self.text(path)
        if not text and default is not None:
            return default
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise ContentError(f"its main.xml states {text!r} for {path}", _AGAIN)
        return value


def _local_name(element: ElementTree.Element) -> str:
    """Return the name of an element without its namespace."""
    return str(element.tag).rpartition("}")[2]


def parse_xml(main: bytes) -> _Node:
    """Return the root of ``main.xml``."""

    def refuse(*_: str | None) -> None:
        raise ContentError("its main.xml declares a document type, which X3P does not have", _AGAIN)

    builder = ElementTree.TreeBuilder()
    # The parser reports a document type in any encoding, before any entity that could be expanded.
    target = SimpleNamespace(
        start=builder.start, end=builder.end, data=builder.data, close=builder.close, doctype=refuse
    )
    with damage("its main.xml is damaged", _AGAIN):  # its declared encoding may also be wrong
        return _Node(ElementTree.fromstring(main, ElementTree.XMLParser(target=target)))


def x3p_bytes(surface: Surface) -> bytes:
    """Return the surface, or a profile, as the bytes of an ``.x3p`` file.

    Heights are little-endian doubles [m], NaN where nothing was measured. ``md5checksum.hex`` holds the checksum of
    ``main.xml``, as in the samples of the standard, and ``main.xml`` that of the heights. The format cannot state that
    a surface is periodic; the provenance becomes its comment.
    """
    points = np.ascontiguousarray(surface.heights, dtype="<f8").tobytes()
    main = _written(surface, hashlib.md5(points, usedforsecurity=False).hexdigest()).encode()
    checksum = f"{hashlib.md5(main, usedforsecurity=False).hexdigest()} *main.xml\n".encode()
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, content in (("main.xml", main), (_POINTS, points), ("md5checksum.hex", checksum)):
            # Only a few bytes in eight of the heights repeat: levels above 1 save almost nothing.
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED, 1)
    return stream.getvalue()


def _written(surface: Surface, digest: str) -> str:
    from roughcontact.version import __version__

    grid = surface.grid
    ny, nx = (1, *grid.shape)[-2:]
    dy, dx = (grid.spacing[-1], *grid.spacing)[-2:]
    axes = "".join(
        f"<{name}><AxisType>{kind}</AxisType><DataType>D</DataType>"
        f"<Increment>{step!r}</Increment><Offset>0</Offset></{name}>\n"
        for name, kind, step in (("CX", "I", dx), ("CY", "I", dy), ("CZ", "A", 1))
    )
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>{"SUR" if grid.ndim == 2 else "PRF"}</FeatureType>
<Axes>
{axes}</Axes></Record1>
<Record2><Date>{datetime.now(UTC).isoformat(timespec="seconds")}</Date>
<Creator>roughcontact {__version__}</Creator>
<Instrument><Manufacturer>not stated</Manufacturer><Model>not stated</Model><Serial>not stated</Serial>
<Version>not stated</Version></Instrument>
<CalibrationDate>{datetime.now(UTC).isoformat(timespec="seconds")}</CalibrationDate>
<ProbingSystem><Type>Software</Type><Identification>not stated</Identification></ProbingSystem>
<Comment>{_plain("; ".join(surface.provenance))}</Comment></Record2>
<Record3><MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
<DataLink><PointDataLink>{_POINTS}</PointDataLink>
<MD5ChecksumPointData>{digest.upper()}</MD5ChecksumPointData></DataLink></Record3>
<Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>
</p:ISO5436_2>
"""


def _plain(text: str) -> str:
    """Return a text for XML, without the control characters that it must not hold."""
    from xml.sax.saxutils import escape  # late: it brings the library of web addresses

    return escape("".join(c if c.isprintable() else " " for c in text))
