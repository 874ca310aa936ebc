"""TIFF as heights: grey values of 8 to 64 bits, with unit and size from the user; also formats of instruments."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.bare_table import heights_alone
from roughcontact.files.choice import choose, holds_a_profile, marked
from roughcontact.files.file_bounds import BYTES_PER_POINT, BoundedStream, require_memory
from roughcontact.files.file_errors import ContentError, damage
from roughcontact.files.foreign import brief, list_foreign, read_foreign, unlogged, without_reader
from roughcontact.files.heightmap import Channel, HeightMap, as_heights, line_if_one_row

__all__ = ["list_tiff", "read_tiff"]

_MARKS = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
# Tags and words of instruments that store units and sizes: Park, JPK, Olympus.
_INSTRUMENTS = {50432, 0x8000, 0x8050}
_OLYMPUS = "TiffTagDescData"
_GREY = {0: "white is zero", 1: "black is zero"}
_LOSSLESS = {
    1: "none",
    5: "LZW",
    8: "deflate",
    32946: "deflate",
    32773: "PackBits",
    34925: "LZMA",
    50000: "Zstandard",
}
_NUMBERS = {1: "u", 2: "i", 3: "f"}  # sample formats
_REDUCED, _MASK = 1, 4  # bits of a page that is a reduced copy or a mask of another page
_NODATA, _GDAL = 42113, 42112
_TURNED: dict[int, Callable[[npt.NDArray[Any]], npt.NDArray[Any]]] = {
    1: lambda h: h,
    2: lambda h: h[:, ::-1],
    3: lambda h: h[::-1, ::-1],
    4: lambda h: h[::-1],
    5: lambda h: h.T,
    6: lambda h: h[::-1].T,
    7: lambda h: h[::-1, ::-1].T,
    8: lambda h: h[:, ::-1].T,
}
_AGAIN = "copy the file again, or save it as a TIFF without compression"
_GREY_AGAIN = "save the heights as grey values of 16 or 32 bits, or as .npz"


def read_tiff(data: bytes, channel: str | int | None) -> HeightMap:
    """Return the numbers of a page as heights; the pages are its channels, counted from ``page 1``."""
    with _pages(data) as pages:
        if pages is None:
            return read_foreign(".tiff", data, channel)
        channels = _channels(pages)
        index, warnings = choose(channels, 0 if channel is None and holds_a_profile(channels) else channel)
        page = pages[index]
        heights = _numbers(page, len(data))
        missing, notes = _not_measured(page, heights)
        turn = int(page.tags.valueof("Orientation", default=1))
        values = np.where(missing, np.nan, as_heights(heights))
        return heights_alone(
            line_if_one_row(
                HeightMap(
                    _TURNED[turn](values),
                    "TIFF",
                    channel=channels[index].name,
                    unclear="a resolution, which is that of a print" if 282 in page.tags else None,
                    notes=(*notes, *((f"turned upright from orientation {turn}",) if turn != 1 else ())),
                    warnings=(*warnings, *_warnings(page)),
                )
            )
        )


def list_tiff(data: bytes) -> tuple[Channel, ...]:
    """Return the pages of the file that can be read, or the channels if an instrument has written it."""
    with _pages(data) as pages:
        return list_foreign(".tiff", data) if pages is None else _channels(pages)


@contextmanager
def _pages(data: bytes) -> Iterator[list[Any] | None]:
    """Yield the pages of grey values in a file, or None if an instrument has written it."""
    if not data.startswith(_MARKS):
        raise ContentError("it does not begin as a TIFF", "check its extension; copy the file again")
    try:
        import tifffile
    except ImportError as error:
        raise without_reader("tifffile", error) from error
    with (
        unlogged(),
        damage("it is damaged", _AGAIN, said=brief),
        np.errstate(all="ignore"),
        tifffile.TiffFile(BoundedStream(data, "surface.tiff")) as opened,
    ):
        pages: list[Any] = list(opened.pages)
        if any(map(_of_an_instrument, pages)):
            yield None
            return
        whole = [page for page in pages if not int(page.subfiletype) & (_REDUCED | _MASK)]
        problems = [_problem(page) for page in whole]
        grey = [page for page, problem in zip(whole, problems, strict=True) if problem is None]
        if not grey:
            problem, remedy = next(filter(None, problems), ("it holds no picture", _GREY_AGAIN))
            raise ContentError(problem, remedy)
        yield grey


def _of_an_instrument(page: Any) -> bool:
    tags = {tag.code for tag in page.tags}
    return bool(tags & _INSTRUMENTS) or _OLYMPUS in str(page.description)


def _channels(pages: list[Any]) -> tuple[Channel, ...]:
    shapes = [tuple(map(int, page.shape)) for page in pages]
    return marked(
        [
            Channel(f"page {page.index + 1}", shape, None, None, is_height=False)
            for page, shape in zip(pages, shapes, strict=True)
        ]
    )


def _problem(page: Any) -> tuple[str, str] | None:
    """Return why the numbers of a page cannot be heights, and what to do instead."""
    if int(page.photometric) not in _GREY:
        name = getattr(page.photometric, "name", str(page.photometric))
        return f"it is a picture in colours ({name}), not of grey values", _GREY_AGAIN
    if page.samplesperpixel != 1 or len(page.shape) != 2:
        return f"it holds {page.samplesperpixel} numbers a point, not one", _GREY_AGAIN
    kind = _NUMBERS.get(int(page.sampleformat or 1))
    if kind is None or page.dtype is None or page.bitspersample not in (8, 16, 32, 64):
        return f"its numbers are of {page.bitspersample} bits, format {page.sampleformat}", _GREY_AGAIN
    if int(page.compression) not in _LOSSLESS:
        name = getattr(page.compression, "name", str(page.compression))
        return f"it is compressed by {name}, which may change its numbers", _GREY_AGAIN
    if int(page.tags.valueof("Orientation", default=1)) not in _TURNED:
        return f"it is turned in the unknown way {page.tags.valueof('Orientation')}", _AGAIN
    return None


def _numbers(page: Any, size: int) -> npt.NDArray[Any]:
    """Return the numbers of a page; each of its parts must lie in the file exactly once."""
    shape = tuple(map(int, page.shape))
    require_memory(BYTES_PER_POINT * math.prod(shape))
    parts = sorted(zip(page.dataoffsets, page.databytecounts, strict=True))
    apart = all(before[0] + before[1] <= after[0] for before, after in itertools.pairwise(parts))
    there = len(parts) == math.prod(page.chunked) and 0 not in page.databytecounts and sum(parts[-1]) <= size
    if not (there and apart):
        raise ContentError("its parts are not all there, or overlap: it is cut short or damaged", _AGAIN)
    tile = math.prod(page.chunks) * len(parts) if page.is_tiled else math.prod(shape)
    if int(page.compression) == 1 and sum(page.databytecounts) != tile * page.dtype.itemsize:
        raise ContentError(
            f"its parts take {sum(page.databytecounts)} bytes where its points need {tile * page.dtype.itemsize}",
            _AGAIN,
        )
    try:
        values: npt.NDArray[Any] = page.asarray()
    except ValueError as error:
        if "imagecodecs" not in str(error):
            raise
        raise without_reader("imagecodecs", error, "save it without compression, or ") from error
    if values.shape != shape:
        raise ContentError(f"it holds {values.shape} points where its header states {shape}", _AGAIN)
    return values


def _not_measured(page: Any, values: npt.NDArray[Any]) -> tuple[npt.NDArray[np.bool_], tuple[str, ...]]:
    """Return the points that carry the mark which GDAL states, compared as they are stored."""
    text = str(page.tags.valueof(_NODATA, default="")).strip("\0 ")
    missing = np.zeros(values.shape, dtype=np.bool_)
    if not text:
        return missing, ()
    try:
        mark = float(text)
    except ValueError:
        raise ContentError(f"it marks missing points by {text[:40]!r}, not a number", _AGAIN) from None
    with np.errstate(all="ignore"):
        stored = values.dtype.type(mark) if values.dtype.kind == "f" else mark
    missing = values == stored
    return missing, (f"not measured where it is {text}, as it states",) if missing.any() else ()


def _warnings(page: Any) -> tuple[str, ...]:
    warnings = []
    if int(page.photometric) == 0:
        warnings.append(
            "its small numbers are the bright ones (white is zero): they are read as stored, small is low"
        )
    stated = str(page.description) + str(page.tags.valueof(_GDAL, default=""))
    if re.search(r"^c[01]=|role=.(?:scale|offset)", stated, re.MULTILINE):
        warnings.append("it states a scale or an offset of its numbers, which is not applied")
    return tuple(warnings)
