"""Small files in the formats of instruments and their programs, as bytes, each written by its own few lines."""

import io
import struct
import zlib

import numpy as np


def hills(ny=32, nx=36):
    """Return smooth heights of both signs without any symmetry, of three decimals."""
    y, x = np.mgrid[0:ny, 0:nx]
    u, v = x / nx, y / ny
    z = np.sin(2 * np.pi * u) + 0.6 * np.cos(4 * np.pi * v + 1) + 0.5 * u * v
    return np.round(z - z.mean(), 3)


def gsf(z, *, drop=(), end="\n", **fields):
    """Return Gwyddion's simple field; `fields` go before its own, those named in `drop` are left out."""
    ny, nx = z.shape
    own = {"XRes": nx, "YRes": ny, "XReal": nx * 5e-7, "YReal": ny * 5e-7, "XYUnits": "m", "ZUnits": "m"}
    lines = [f"{name} = {value}" for name, value in (own | fields).items() if name not in drop]
    head = ("Gwyddion Simple Field 1.0\n" + "\n".join(lines) + end).encode()
    return head + b"\0" * (4 - len(head) % 4) + z.astype("<f4").tobytes()


def tmd(z, *, comment=b"Created by TrueMap v6\r\n", sides=(0.9, 0.8), padding=0):
    """Return a file of TrueMap, heights and sides (x, y) in millimetres."""
    ny, nx = z.shape
    head = b"Binary TrueMap Data File v2.0\r\n\0" + comment + b"\0" * (1 + padding)
    return head + struct.pack("<2I4f", nx, ny, *sides, 0, 0) + z.astype("<f4").tobytes()


SDF_TYPES = ("u1", "<u2", "<u4", "<f4", "i1", "<i2", "<i4", "<f8")


def sdf_binary(
    counts, kind, *, mark="bISO-1.0", steps=(5e-7, 4e-7, 1e-9), flags=(0, 0), extra=b"", trailer=b""
):
    """Return a binary SDF file of the numbers `counts`, in the type `kind` of its header."""
    ny, nx = counts.shape
    form = "2I" if mark.endswith("2.0") else "2H"
    words = mark.encode() + b"nobody".ljust(10) + b"010120200000" * 2
    head = words + struct.pack(f"<{form}4d3B", nx, ny, *steps, -1.0, flags[0], kind, flags[1])
    return head + extra + counts.astype(SDF_TYPES[kind]).tobytes() + trailer


def sdf_text(
    counts, kind, *, mark="aISO-1.0", steps=(5e-7, 4e-7, 1e-9), newline="\n", end="*\n", bad="BAD", **fields
):
    """Return an SDF file as text; NaN is written as `bad`."""
    ny, nx = counts.shape
    own = {"ManufacID": "nobody", "CreateDate": "010120200000", "ModDate": "010120200000", "NumPoints": nx}
    own |= {"NumProfiles": ny, "Xscale": steps[0], "Yscale": steps[1], "Zscale": steps[2], "Zresolution": -1}
    own |= {"Compression": 0, "DataType": kind, "CheckType": 0} | fields
    form = "%r" if kind in (3, 7) else "%d"
    rows = (" ".join(bad if np.isnan(v) else form % v for v in row) for row in counts.tolist())
    text = (
        f"{mark}\n" + "".join(f"{k} = {v}\n" for k, v in own.items()) + "*\n" + "\n".join(rows) + "\n" + end
    )
    return text.replace("\n", newline).encode()


def gwy_item(name, kind, value):
    """Return an item of Gwyddion's tree: a number, a text, an array of doubles or an object."""
    head = name.encode() + b"\0" + kind.encode()
    if kind == "D":
        return head + struct.pack("<I", value.size) + np.ascontiguousarray(value, "<f8").tobytes()
    return (
        head
        + {
            "o": lambda: value,
            "s": lambda: value.encode() + b"\0",
            "S": lambda: struct.pack("<I", len(value)) + b"".join(text.encode() + b"\0" for text in value),
            "b": lambda: struct.pack("<?", value),
            "i": lambda: struct.pack("<i", value),
            "q": lambda: struct.pack("<q", value),
            "d": lambda: struct.pack("<d", value),
        }[kind]()
    )


def gwy_object(name, *items):
    body = b"".join(items)
    return name.encode() + b"\0" + struct.pack("<I", len(body)) + body


def gwy_field(z, units=("m", "m"), sides=None):
    """Return a field of Gwyddion; `units` (xy, z) are left out where None; `sides` are (x, y)."""
    ny, nx = z.shape
    xreal, yreal = sides or (nx * 5e-7, ny * 4e-7)
    named = [
        (name, unit)
        for name, unit in zip(("si_unit_xy", "si_unit_z"), units, strict=True)
        if unit is not None
    ]
    return gwy_object(
        "GwyDataField",
        *(gwy_item(name, "i", n) for name, n in (("xres", nx), ("yres", ny))),
        *(gwy_item(name, "d", side) for name, side in (("xreal", xreal), ("yreal", yreal))),
        *(
            gwy_item(name, "o", gwy_object("GwySIUnit", gwy_item("unitstr", "s", unit)))
            for name, unit in named
        ),
        gwy_item("data", "D", z),
    )


def gwy(*fields, titles=("Height",), masks=(), extra=b""):
    """Return a file of Gwyddion with these fields as its channels."""
    items = []
    for k, field in enumerate(fields):
        items.append(gwy_item(f"/{k}/data", "o", field))
        if k < len(titles) and titles[k] is not None:
            items.append(gwy_item(f"/{k}/data/title", "s", titles[k]))
    items += [gwy_item(f"/{k}/mask", "o", gwy_field(np.asarray(m, float))) for k, m in enumerate(masks)]
    return b"GWYP" + gwy_object("GwyContainer", *items, extra)


SHORT, LONG, TEXT = 3, 4, 2


def tiff(z, *, order="<", rows=None, deflate=False, tags=(), bits=None, **changed):
    """Return a TIFF of one page in strips of `rows` lines; `changed` are values of tags by number, `t258=8`."""
    ny, nx = z.shape
    rows = rows or ny
    strips = [z[k : k + rows].astype(z.dtype.newbyteorder(order)).tobytes() for k in range(0, ny, rows)]
    strips = [zlib.compress(strip) for strip in strips] if deflate else strips
    places = np.cumsum([8, *map(len, strips)]).tolist()
    table = [(256, LONG, [nx]), (257, LONG, [ny]), (258, SHORT, [z.dtype.itemsize * 8])]
    table += [
        (259, SHORT, [8 if deflate else 1]),
        (262, SHORT, [1]),
        (273, LONG, places[:-1]),
        (277, SHORT, [1]),
    ]
    table += [(278, LONG, [rows]), (279, LONG, list(map(len, strips)))]
    table += [(339, SHORT, [{"u": 1, "i": 2, "f": 3}[z.dtype.kind]])]
    table = [(tag, kind, [changed.get(f"t{tag}", values[0]), *values[1:]]) for tag, kind, values in table]
    start, entries, beyond = places[-1], [], b""
    for tag, kind, values in sorted([*table, *tags]):
        form = {SHORT: "H", LONG: "I"}.get(kind)
        packed = values if form is None else struct.pack(f"{order}{len(values)}{form}", *values)
        if len(packed) > 4:
            place = start + 2 + 12 * (len(table) + len(tags)) + 4 + len(beyond)
            beyond, packed = beyond + packed, struct.pack(order + "I", place)
        entries.append(struct.pack(order + "HHI", tag, kind, len(values)) + packed.ljust(4, b"\0"))
    head = struct.pack(order + "2sHI", b"II" if order == "<" else b"MM", 42, start)
    count = struct.pack(order + "H", len(entries))
    return head + b"".join(strips) + count + b"".join(entries) + struct.pack(order + "I", 0) + beyond


def nanoscope(
    counts, *, size, aspect, scan_aspect="1:1", lines=None, scan=(), names=("Height",), spare=b"", width=2
):
    """Return a Nanoscope file of `width` bytes a point with one image a name; `scan` are more lines of its scan list.

    A count is NANOSCOPE_STEP in 2 bytes, and a 65536th of it in 4.
    """
    ny, nx = counts.shape
    body, start = np.ascontiguousarray(counts[::-1], dtype=f"<i{width}").tobytes(), 4096
    head = [
        r"\*File list",
        r"\Version: 0x05300001",
        r"\Date: 10:00:00 AM Mon Jan 06 2020",
        r"\Start context: OL",
    ]
    head += [
        rf"\Data length: {start}",
        r"\*Scanner list",
        r"\@Sens. Zsens: V 20.00000 nm/V",
        r"\*Ciao scan list",
    ]
    head += [rf"\Scan Size: {size.split()[0]} {size.split()[-1]}", rf"\Samps/line: {nx}"]
    head += [rf"\Lines: {ny if lines is None else lines}", rf"\Aspect Ratio: {scan_aspect}", *scan]
    for k, name in enumerate(names):
        head += [
            r"\*Ciao image list",
            rf"\Data offset: {start + k * len(body)}",
            rf"\Data length: {len(body)}",
        ]
        head += [
            rf"\Bytes/pixel: {width}",
            rf"\Samps/line: {nx}",
            rf"\Number of lines: {ny}",
            rf"\Scan Size: {size}",
        ]
        head += [] if aspect is None else [rf"\Aspect Ratio: {aspect}"]
        head += [
            rf'\@2:Image Data: S [{name}] "{name}"',
            r"\@2:Z scale: V [Sens. Zsens] (0.0003 V/LSB) 20.00000 V",
        ]
    text = ("\r\n".join([*head, r"\*File list end"]) + "\r\n\x1a").encode("latin-1")
    return text.ljust(start, b"\0") + body * len(names) + spare


NANOSCOPE_STEP = 20.0 / 65536 * 20e-9  # metres a count


def mat(**arrays):
    """Return a MATLAB file, compressed."""
    from scipy.io import savemat

    stream = io.BytesIO()
    savemat(stream, arrays, do_compression=True)
    return stream.getvalue()
