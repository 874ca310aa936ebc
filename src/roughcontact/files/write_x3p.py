"""A surface as X3P, the format of ISO 25178-72, in double precision."""

from __future__ import annotations

import hashlib
import io
import zipfile
from datetime import UTC, datetime
from xml.sax.saxutils import escape

import numpy as np

from roughcontact.surface.surface import Surface

__all__ = ["x3p_bytes"]

_POINTS = "bindata/data.bin"


def x3p_bytes(surface: Surface) -> bytes:
    """Return the surface, or the line scan as a profile, as the bytes of an ``.x3p`` file.

    Heights are little-endian doubles [m], NaN where nothing was measured. ``md5checksum.hex`` holds the checksum of
    ``main.xml``, as in the samples of the standard, and ``main.xml`` that of the heights. The format has no word
    for a surface that repeats itself; the provenance becomes its comment.
    """
    points = np.ascontiguousarray(surface.heights, dtype="<f8").tobytes()
    main = _main(surface, hashlib.md5(points, usedforsecurity=False).hexdigest()).encode()
    checksum = f"{hashlib.md5(main, usedforsecurity=False).hexdigest()} *main.xml\n".encode()
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, content in (("main.xml", main), (_POINTS, points), ("md5checksum.hex", checksum)):
            # Of heights only a few bytes in eight repeat: more effort than level 1 buys little.
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED, 1)
    return stream.getvalue()


def _main(surface: Surface, digest: str) -> str:
    from roughcontact import __version__

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
    return escape("".join(c if c.isprintable() else " " for c in text))
