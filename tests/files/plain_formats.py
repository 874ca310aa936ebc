"""Writers of the formats with a reader of ours."""

import hashlib
import io
import json
import struct
import zipfile
import zlib

import numpy as np
from scipy.io import netcdf_file

from files.writing import SIZE, text, writes


@writes("bare.csv", given={"unit": "nm", "size": SIZE})
def _bare(heights, dy, dx):
    return text(heights * 1e9, ",").encode()


@writes("pixel-size.txt", missing=True)
def _pixel_size(heights, dy, dx):
    head = "# unit: nm\n# dx: 2 um\n# dy: 3 um\n# nodata: -9999\n"
    return (head + text(heights * 1e9, bad="-9999")).encode()


@writes("gwyddion.txt", square=True)
def _gwyddion_text(heights, dy, dx):
    head = "# Channel: Topography\n# Width: 56 µm\n# Height: 40 µm\n# Value units: nm\n"
    return (head + text(heights * 1e9)).encode()


@writes("gwyddion-german.txt", square=True)
def _gwyddion_german(heights, dy, dx):
    head = "# Kanal: Topographie\n# Breite: 56 µm\n# Höhe: 40 µm\n# Value units: nm\n"
    return (head + text(heights * 1e9)).encode()


@writes("profile.csv", line=True)
def _profile(heights, dy, dx):
    """As a stylus instrument writes it: words, then places and heights, with empty columns behind."""
    head = "Scan Parameters\nScan Type,Standard Scan\n\nScan Data\nLateral um,Raw Micrometer,\n"
    points = (f"{k * dx * 1e6:.1f},{z * 1e6:.3f},,\n" for k, z in enumerate(heights[0]))
    return (head + "".join(points)).encode()


@writes("points.xyz", missing=True)
def _points(heights, dy, dx):
    rows, columns = np.nonzero(~np.isnan(heights))
    triples = zip(columns * dx * 1e6, rows * dy * 1e6, heights[rows, columns] * 1e9, strict=True)
    return (
        "# x [um] y [um] z [nm]\n" + "".join(f"{x:.1f} {y:.1f} {z:.0f}\n" for x, y, z in triples)
    ).encode()


@writes("bare.npy", missing=True, given={"unit": "m", "size": SIZE})
def _npy(heights, dy, dx):
    stream = io.BytesIO()
    np.save(stream, heights)
    return stream.getvalue()


@writes("keyed.npz", missing=True)
def _npz(heights, dy, dx):
    stream = io.BytesIO()
    np.savez(stream, heights=heights * 1e6, unit="um", spacing=[dy, dx])
    return stream.getvalue()


@writes("classic.nc", missing=True)
def _netcdf(heights, dy, dx):
    fill = np.float64(1e30)
    stream = io.BytesIO()
    with netcdf_file(stream, "w") as file:
        for name, count, step in (("x", heights.shape[1], dx), ("y", heights.shape[0], dy)):
            file.createDimension(name, count)
            places = file.createVariable(name, "f8", (name,))
            places[:] = (np.arange(count) + 0.5) * step * 1e6
            places.units = "um"
        variable = file.createVariable("heights", "f8", ("y", "x"))
        variable[:] = np.where(np.isnan(heights), fill, heights * 1e9)
        variable.units = "nm"
        variable._FillValue = fill
        file.flush()
        return stream.getvalue()


def _x3p(points: str, heights: np.ndarray, dy: float, dx: float, members: dict[str, bytes]) -> bytes:
    ny, nx = heights.shape
    axes = "".join(
        f"<{axis}><AxisType>{kind}</AxisType><DataType>D</DataType><Increment>{step}</Increment></{axis}>"
        for axis, kind, step in (("CX", "I", dx), ("CY", "I", dy), ("CZ", "A", 1))
    )
    size = f"<SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ>"
    main = (
        '<?xml version="1.0"?><p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">'
        f"<Record1><FeatureType>SUR</FeatureType><Axes>{axes}</Axes></Record1>"
        f"<Record3><MatrixDimension>{size}</MatrixDimension>{points}</Record3>"
        "<Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4></p:ISO5436_2>"
    ).encode()
    members = {"main.xml": main, "md5checksum.hex": hashlib.md5(main).hexdigest().encode(), **members}
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return stream.getvalue()


@writes("binary.x3p", missing=True)
def _x3p_binary(heights, dy, dx):
    data = heights.astype("<f8").tobytes()
    link = (
        "<DataLink><PointDataLink>bindata/data.bin</PointDataLink>"
        f"<MD5ChecksumPointData>{hashlib.md5(data).hexdigest()}</MD5ChecksumPointData></DataLink>"
    )
    return _x3p(link, heights, dy, dx, {"bindata/data.bin": data})


@writes("listed.x3p", missing=True)
def _x3p_listed(heights, dy, dx):
    entries = ("<Datum/>" if np.isnan(v) else f"<Datum>{v!r}</Datum>" for v in heights.ravel().tolist())
    return _x3p(f"<DataList>{''.join(entries)}</DataList>", heights, dy, dx, {})


def _sur(heights, dy, dx, *, packed=False, kind=2, bits=32):
    ny, nx = heights.shape
    counts = np.where(np.isnan(heights), np.nan, np.rint(heights * 1e9))
    low, high = int(np.nanmin(counts)), int(np.nanmax(counts))
    head = bytearray(512)
    for place, form, *values in (
        (0, "12s", b"DSCOMPRESSED" if packed else b"DIGITAL SURF"),
        (14, "<3h", 1, 1, kind),
        (86, "<h", int(np.isnan(heights).any())),
        (98, "<h", bits),
        (100, "<5i", low, high, nx, ny, nx * ny),
        (120, "<3f", dx * 1e6, dy * 1e6, 1.0),
        (132, "16s16s16s", b"X", b"Y", b"Z"),
        (180, "16s16s16s", b"\xb5m", b"\xb5m", b"nm"),
    ):
        struct.pack_into(form, head, place, *values)
    body = np.where(np.isnan(counts), low - 2, counts).astype(f"<i{bits // 8}").tobytes()
    if packed:
        stream = zlib.compress(body)
        body = struct.pack("<III", 1, len(body), len(stream)) + stream
        struct.pack_into("<I", head, 324, len(body))
    return bytes(head) + body


@writes("plain.sur", missing=True)
def _sur_plain(heights, dy, dx):
    return _sur(heights, dy, dx, bits=16)


@writes("packed.sur", missing=True)
def _sur_packed(heights, dy, dx):
    return _sur(heights, dy, dx, packed=True)


@writes("line.pro", line=True)
def _pro(heights, dy, dx):
    return _sur(heights[:1], dy, dx, kind=1)


@writes("field.gsf", missing=True)
def _gsf(heights, dy, dx):
    ny, nx = heights.shape
    head = f"Gwyddion Simple Field 1.0\nXRes = {nx}\nYRes = {ny}\nXReal = {nx * dx}\nYReal = {ny * dy}\n"
    head = (head + "XYUnits = m\nZUnits = m\nTitle = Height\n").encode()
    return head + b"\0" * (4 - len(head) % 4) + heights.astype("<f4").tobytes()


@writes("surfer.grd", given={"unit": "nm"}, missing=True)
def _surfer(heights, dy, dx):
    """Text grid of Surfer, its rows from the smallest y upwards, places in the unit of the heights."""
    ny, nx = heights.shape
    low, high = np.nanmin(heights) * 1e9, np.nanmax(heights) * 1e9
    ends = f"0 {(nx - 1) * dx * 1e9}\n0 {(ny - 1) * dy * 1e9}\n{low} {high}\n"
    return (f"DSAA\n{nx} {ny}\n{ends}" + text(heights[::-1] * 1e9, bad="1.70141e+38")).encode()


@writes("container.zip")
def _container(heights, dy, dx):
    """As contact.engineering packs it: an index, and a measurement as it was uploaded."""
    ny, nx = heights.shape
    measurement = {
        "name": "map",
        "datafile": {"original": "map.npy"},
        "unit": "um",
        "size": (nx * dx * 1e6, ny * dy * 1e6),
    }
    stream, array = io.BytesIO(), io.BytesIO()
    np.save(array, heights * 1e6)
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr(
            "index.json", json.dumps({"surfaces": [{"name": "part", "topographies": [measurement]}]})
        )
        archive.writestr("map.npy", array.getvalue())
    return stream.getvalue()
