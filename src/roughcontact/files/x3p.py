"""X3P, the format of ISO 25178-72: a zip archive of ``main.xml`` and the heights beside or inside it."""

from __future__ import annotations

import hashlib
import math
import posixpath
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.archive import unzip
from roughcontact.files.file_errors import ReadError
from roughcontact.files.heightmap import Array, HeightMap, as_heights
from roughcontact.files.xmlnode import Node, local_name, parse_xml

__all__ = ["read_x3p"]

_TYPES = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}
_AGAIN = "export the surface again"


def read_x3p(data: bytes, file: str) -> HeightMap:
    """Return the surface in an X3P file; heights and spacing are in metres by definition."""
    folder, main = _main(data, file)
    root = parse_xml(main, file)
    axes = root.child("Record1/Axes")
    shape = _shape(root, file)
    kind = root.text("Record1/FeatureType", "SUR")
    if kind != "SUR" and not (kind == "PRF" and shape[0] == 1):
        raise ReadError(
            file, f"it holds a feature of type {kind}, not a surface (SUR)", "give a map of heights"
        )
    for axis in ("CX", "CY") if kind == "SUR" else ("CX",):
        if axes.text(f"{axis}/AxisType", "I") != "I":
            raise ReadError(file, f"its axis {axis} is not incremental", f"{_AGAIN} on a regular grid")
    values, notes = _values(data, file, folder, main, root, shape)
    # An absolute axis needs no increment, but writers of whole numbers put their scale there.
    with np.errstate(all="ignore"):
        heights = values * axes.number("CZ/Increment", 1.0) + axes.number("CZ/Offset", 0.0)
    if infinite := int(np.isinf(heights).sum()):  # some instruments mark missing points by infinity
        heights = np.where(np.isinf(heights), np.nan, heights)
        notes = (*notes, f"{infinite} infinite heights count as missing")
    if kind == "PRF":
        line = as_heights(heights[0], file)
        return HeightMap(line, "X3P", unit="m", spacing=(axes.number("CX/Increment"),), notes=notes)
    return HeightMap(
        as_heights(heights, file),
        "X3P",
        unit="m",
        spacing=(axes.number("CY/Increment"), axes.number("CX/Increment")),
        notes=notes,
    )


def _main(data: bytes, file: str) -> tuple[str, bytes]:
    """Return the folder and the content of the uppermost ``main.xml``."""
    found = unzip(data, file, lambda member: posixpath.basename(member) == "main.xml")
    if not found:
        raise ReadError(file, "its archive holds no main.xml", "check that it is an X3P file (ISO 25178-72)")
    member = min(found, key=lambda name: (name.count("/"), name))
    return posixpath.dirname(member), found[member]


def _shape(root: Node, file: str) -> tuple[int, int]:
    """Return (SizeY, SizeX)."""
    sizes = []
    for name in ("SizeY", "SizeX", "SizeZ"):
        text = root.child("Record3/MatrixDimension").text(name, "1" if name == "SizeZ" else "")
        if not (text.isascii() and text.isdigit() and int(text[:12]) > 0):
            raise ReadError(file, f"its main.xml states {text!r} for {name}", _AGAIN)
        sizes.append(int(text[:12]))
    if sizes[2] != 1:
        raise ReadError(file, f"it holds {sizes[2]} layers", f"{_AGAIN} as a single layer")
    return sizes[0], sizes[1]


def _values(
    data: bytes, file: str, folder: str, main: bytes, root: Node, shape: tuple[int, int]
) -> tuple[Array, tuple[str, ...]]:
    """Return the numbers of the data list or the linked file as float64, NaN where invalid, and remarks."""
    kind = root.child("Record1/Axes").text("CZ/DataType")
    if kind not in _TYPES:
        raise ReadError(file, f"its heights are of the type {kind!r}, not one of I, L, F, D", _AGAIN)
    link = root.text("Record3/DataLink/PointDataLink")
    mask_link = root.text("Record3/DataLink/ValidPointsLink")
    checksum_file = root.text("Record4/ChecksumFile", "md5checksum.hex")
    paths = {_resolve(folder, target) for target in (link, mask_link, checksum_file) if target}
    members = unzip(data, file, lambda member: posixpath.normpath(member) in paths)
    members = {posixpath.normpath(name): content for name, content in members.items()}

    points = b""
    if link:
        points = _member(members, _resolve(folder, link), file)
        _check(points, root.text("Record3/DataLink/MD5ChecksumPointData"), "the heights", file)
        values = _binary(points, _TYPES[kind], shape, file)
    else:
        values = _listed(root.child("Record3/DataList"), shape, file)
    if mask_link:
        mask = _member(members, _resolve(folder, mask_link), file)
        _check(mask, root.text("Record3/DataLink/MD5ChecksumValidPoints"), "the valid points", file)
        values = np.where(_valid(mask, shape, file), values, np.nan)
    return values, _check_main(members.get(_resolve(folder, checksum_file)), main, points, file)


def _resolve(folder: str, link: str) -> str:
    """Return the name of a linked member; links count from the folder of ``main.xml``."""
    return posixpath.normpath(posixpath.join(folder, link.replace("\\", "/")))


def _member(members: Mapping[str, bytes], path: str, file: str) -> bytes:
    if path not in members:
        raise ReadError(file, f"its archive lacks {path}, which its main.xml names", _AGAIN)
    return members[path]


def _binary(points: bytes, dtype: str, shape: tuple[int, int], file: str) -> Array:
    expected = math.prod(shape) * np.dtype(dtype).itemsize
    if len(points) != expected:
        raise ReadError(
            file,
            f"its heights take {len(points)} bytes where {shape[0]} x {shape[1]} points need {expected}",
            _AGAIN,
        )
    with np.errstate(all="ignore"):  # signalling NaN
        return np.frombuffer(points, dtype=dtype).reshape(shape).astype(np.float64)


def _listed(data_list: Node, shape: tuple[int, int], file: str) -> Array:
    """Return the heights written out in the XML; an empty entry is a missing point."""
    values = []
    for index, datum in enumerate(d for d in data_list.element if local_name(d) == "Datum"):
        text = (datum.text or "").strip()
        try:
            values.append(float(text) if text else math.nan)
        except ValueError:
            raise ReadError(
                file, f"entry {index + 1} of its data list is {text!r}, not one height", _AGAIN
            ) from None
    if len(values) != math.prod(shape):
        raise ReadError(
            file, f"its data list has {len(values)} entries for {shape[0]} x {shape[1]} points", _AGAIN
        )
    return np.array(values).reshape(shape)


def _valid(mask: bytes, shape: tuple[int, int], file: str) -> npt.NDArray[np.bool_]:
    """Return the valid points: one bit a point, the lowest bit first, in the order of the heights."""
    count = math.prod(shape)
    if len(mask) != (count + 7) // 8:
        raise ReadError(file, f"its list of valid points has {len(mask)} bytes for {count} points", _AGAIN)
    bits: npt.NDArray[Any] = np.unpackbits(
        np.frombuffer(mask, dtype=np.uint8), count=count, bitorder="little"
    )
    return bits.astype(np.bool_).reshape(shape)


def _check(content: bytes, stated: str, what: str, file: str) -> None:
    if stated and stated.casefold() != hashlib.md5(content, usedforsecurity=False).hexdigest():
        raise ReadError(
            file, f"the checksum of {what} is wrong: the file is damaged", f"copy it again, or {_AGAIN}"
        )


def _check_main(stated: bytes | None, main: bytes, points: bytes, file: str) -> tuple[str, ...]:
    """Compare the checksum of ``main.xml``; some writers put the checksum of the heights there instead."""
    words = (stated or b"").split()
    if not words:
        return ()
    checksum = words[0].decode("latin-1").casefold()
    if checksum == hashlib.md5(main, usedforsecurity=False).hexdigest():
        return ()
    if points and checksum == hashlib.md5(points, usedforsecurity=False).hexdigest():
        return ("the checksum file states the heights instead of main.xml; they agree",)
    raise ReadError(
        file, "the checksum of main.xml is wrong: the file is damaged", f"copy it again, or {_AGAIN}"
    )
