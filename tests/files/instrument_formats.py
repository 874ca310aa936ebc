"""Writers of instruments' formats, which SurfaceTopography reads."""

import io
import struct
import zipfile

import numpy as np

from files.writing import SIZE, nm, text, writes


def filled(heights, mark, scale=1.0):
    """Return heights times a scale, with a mark where nothing was measured."""
    return np.where(np.isnan(heights), mark, heights * scale)


def tag(name, value):
    """Return an entry of Alicona's header."""
    return name.encode().ljust(20, b"\0") + str(value).encode().ljust(30, b"\0") + b"\r\n"


@writes("alicona.al3d", missing=True)
def _al3d(heights, dy, dx):
    ny, nx = heights.shape
    tags = {"Cols": nx, "Rows": ny, "PixelSizeXMeter": dx, "PixelSizeYMeter": dy, "InvalidPixelValue": 1e9}
    count = len(tags) + 1
    start = 17 + 52 * (2 + count) + 256
    tags["DepthImageOffset"] = start
    head = b"AliconaImaging\0\r\n" + tag("Version", 1) + tag("TagCount", count)
    head += b"".join(tag(*each) for each in tags.items()) + b"\0" * 256
    padded = np.pad(filled(heights, 1e9), ((0, 0), (0, nx % 2)))  # rows end at a multiple of 8 bytes
    return head.ljust(start, b"\0") + padded.astype("<f4").tobytes()


@writes("truemap.tmd")
def _tmd(heights, dy, dx):
    ny, nx = heights.shape
    head = b"Binary TrueMap Data File v2.0\r\n\0" + b"Created by TrueMap v6\r\n\0"
    head += struct.pack("<2I4f", nx, ny, nx * dx * 1e3, ny * dy * 1e3, 0, 0)
    return head + (heights * 1e3).astype("<f4").tobytes()


@writes("wsxm.top")
def _wsxm(heights, dy, dx):
    ny, nx = heights.shape
    lines = [
        "WSxM file copyright nobody",
        "SxM Image file",
        "Image header size: 0",
        "",
        "[Control]",
        "",
        f"    X Amplitude: {nx * dx * 1e9:g} nm",
        f"    Y Amplitude: {ny * dy * 1e9:g} nm",
        "",
        "[General Info]",
        "",
        "    Image Data Type: double",
        f"    Number of columns: {nx}",
        f"    Number of rows: {ny}",
        f"    Z Amplitude: {np.ptp(heights) * 1e9:g} nm",
        "",
        "[Miscellaneous]",
        "",
        f"    Maximum: {heights.max() * 1e9:g}",
        f"    Minimum: {heights.min() * 1e9:g}",
        "",
        "[Header end]",
    ]
    return ("\r\n".join(lines) + "\r\n").encode() + nm(heights[::-1, ::-1], "<f8")


@writes("agilent.mi")
def _mi(heights, dy, dx):
    ny, nx = heights.shape
    keys = {"fileType": "Image", "xPixels": nx, "yPixels": ny, "xLength": nx * dx, "yLength": ny * dy}
    keys |= {"bufferLabel": "Topography", "bufferUnit": "nm", "bufferRange": 32768, "data": "BINARY"}
    return "".join(f"{key:14}{value}\n" for key, value in keys.items()).encode() + nm(heights[::-1], "<i2")


@writes("wyko.opd", missing=True)
def _opd(heights, dy, dx):
    ny, nx = heights.shape
    waves = filled(heights, 1e38, 1 / 500e-9)
    raster = struct.pack("<3H", nx, ny, 4) + waves[::-1].T.astype("<f4").tobytes()
    blocks = [
        ("RAW_DATA", 3, raster),
        ("Wavelength", 7, struct.pack("<f", 500.0)),
        ("Mult", 6, struct.pack("<h", 1)),
        ("Aspect", 7, struct.pack("<f", dy / dx)),
        ("Pixel_size", 7, struct.pack("<f", dx * 1e3)),
    ]
    directory = [("Directory", 1, b" " * 24 * (len(blocks) + 1)), *blocks]
    entries = b"".join(struct.pack("<16shlH", n.encode(), kind, len(d), 1) for n, kind, d in directory)
    return b"\1\0" + entries + b"".join(content for _, _, content in blocks)


@writes("binary.sdf", missing=True)
def _sdf_binary(heights, dy, dx):
    ny, nx = heights.shape
    head = struct.pack("<8s10s12s12s2H4d3b", b"bISO-1.0", *[b"0"] * 3, nx, ny, dx, dy, 1e-9, 1e-12, 0, 5, 0)
    return head + nm(heights, "<i2", -32768)


@writes("text.sdf", missing=True)
def _sdf_text(heights, dy, dx):
    ny, nx = heights.shape
    keys = {"ManufacID": 0, "CreateDate": 0, "ModDate": 0, "NumPoints": nx, "NumProfiles": ny, "Xscale": dx}
    keys |= {
        "Yscale": dy,
        "Zscale": 1e-9,
        "Zresolution": 1e-12,
        "Compression": 0,
        "DataType": 6,
        "CheckType": 0,
    }
    head = "aISO-1.0\n" + "".join(f"{key} = {value}\n" for key, value in keys.items())
    return (head + "*\n" + text(heights * 1e9, " ", bad="BAD") + "*\n*\n").encode()


@writes("image.bcrf", missing=True)
def _bcrf(heights, dy, dx):
    ny, nx = heights.shape
    keys = {"fileformat": "bcrf", "headersize": 2048, "xpixels": nx, "ypixels": ny, "intelmode": 1}
    keys |= {"xlength": nx * dx * 1e9, "ylength": ny * dy * 1e9, "xunit": "nm", "yunit": "nm", "zunit": "nm"}
    head = "".join(f"{key} = {value}\n" for key, value in keys.items()).encode()
    return head.ljust(2048, b"\n") + filled(heights, 3e38, 1e9).astype("<f4").tobytes()


@writes("nanoscope.001", square=True, shape=(24, 24))
def _nanoscope(heights, dy, dx):
    ny, nx = heights.shape
    side = f"{nx * dx * 1e6:g} {ny * dy * 1e6:g} ~m"
    volts = 65536 / 20.0  # so that a count of two bytes is 1 nm at 20 nm/V
    lines = [
        "\\*File list",
        "\\Version: 0x05120000",
        "\\Data length: 2048",
        "\\*Scanner list",
        "\\@Sens. Zscan: V 20.00000 nm/V",
        "\\*Ciao scan list",
        f"\\Scan size: {nx * dx * 1e6:g} ~m",
        f"\\Samps/line: {nx}",
        f"\\Lines: {ny}",
        "\\*Ciao image list",
        "\\Data offset: 2048",
        f"\\Data length: {2 * nx * ny}",
        "\\Bytes/pixel: 2",
        f"\\Samps/line: {nx}",
        f"\\Number of lines: {ny}",
        "\\Aspect ratio: 1:1",
        f"\\Scan size: {side}",
        '\\@2:Image Data: S [Height] "Height"',
        f"\\@2:Z scale: V [Sens. Zscan] ({volts / 65536} V/LSB) {volts} V",
        "\\*File list end",
    ]
    return ("\r\n".join(lines) + "\r\n\x1a").encode().ljust(2048, b"\0") + nm(heights[::-1], "<i2")


@writes("zygo.dat", missing=True, square=True)
def _metropro(heights, dy, dx):
    ny, nx = heights.shape
    head = bytearray(834)
    for place, form, *values in (
        (0, ">4sHI", b"\x88\x1b\x03\x6f", 1, 834),
        (68, ">2HI", nx, ny, 4 * nx * ny),
        (164, ">2f", 0.5, 512e-9),  # half a wavelength over 32768 counts: 128 of them are 1 nm
        (176, ">f", 1.0),
        (184, ">f", dx),
        (218, ">h", 1),
    ):
        struct.pack_into(form, head, place, *values)
    return bytes(head) + filled(np.rint(heights * 1e9), 2147483647, 128).astype(">i4").tobytes()


def tiff(*pages):
    """Return a TIFF of pages, each a list of tags: number, type, value (numbers, a text, or bytes)."""
    sizes = {1: "B", 2: "s", 3: "H", 4: "I", 7: "s", 12: "d"}
    data, link = bytearray(b"II*\0\0\0\0\0"), 4
    for page in pages:
        entries = []
        for number, kind, value in sorted(page):
            plain = value.encode() + b"\0" if isinstance(value, str) else value
            many = plain if isinstance(plain, bytes) else np.atleast_1d(plain).tolist()
            packed = many if isinstance(many, bytes) else struct.pack(f"<{len(many)}{sizes[kind]}", *many)
            if len(packed) > 4:
                data += b"\0" * (len(data) % 2)
                packed, place = struct.pack("<I", len(data)), packed
                data += place
            entries.append(struct.pack("<HHI", number, kind, len(many)) + packed.ljust(4, b"\0"))
        data += b"\0" * (len(data) % 2)
        struct.pack_into("<I", data, link, len(data))
        data += struct.pack("<H", len(entries)) + b"".join(entries)
        link = len(data)
        data += b"\0" * 4
    return bytes(data)


def picture(values, sample=1):
    """Return the tags of a page of one strip, without the place of the strip."""
    ny, nx = values.shape
    return [
        *((256, 4, nx), (257, 4, ny), (258, 3, 8 * values.itemsize), (259, 3, 1), (262, 3, 1), (277, 3, 1)),
        *((278, 4, ny), (279, 4, values.nbytes), (339, 3, sample)),
    ]


@writes("park.tiff")
def _park(heights, dy, dx):
    ny, nx = heights.shape

    def wide(words, size):
        return words.encode("utf-16-le").ljust(2 * size, b"\0")

    head = struct.pack("<I", 0) + wide("Height", 32) + wide("NCM", 8) + struct.pack("<d2I", 0, 0, 0)
    head += struct.pack("<2I", nx, ny) + struct.pack("<dId3I", 0, 0, 0, 1, 1, 0)
    head += struct.pack("<6d", nx * dx * 1e6, ny * dy * 1e6, 0, 0, 1, 0) + wide("V", 8)
    head += struct.pack("<2d", 0, 0) + struct.pack("<3d", 1.0, 1e-3, 0.0) + wide("um", 8)
    head += struct.pack("<3i3I", 0, 0, 0, 0, 0, 0)
    thumbnail = np.zeros((2, 2), "u1")
    tags = [*picture(thumbnail), (273, 4, 0)]
    vendor = [
        (50432, 4, 0x0E031301),
        (50433, 4, 0x1000001),
        (50434, 7, nm(heights[::-1], "<i2")),
        (50435, 7, head),
    ]
    return tiff([*tags, *vendor])


@writes("scan.jpk")
def _jpk(heights, dy, dx):
    ny, nx = heights.shape
    sides = [(0x8042, 12, nx * dx), (0x8043, 12, ny * dy), (0x8003, 2, "2020-01-06 10:00:00 +0000")]
    counts = np.rint(heights * 1e9).astype("<i4")[::-1]
    slot = [(0x8090, 2, "nominal"), (0x80A2, 2, "m"), (0x80A3, 2, "LinearScaling"), (0x80A4, 12, 1e-9)]
    slot += [(0x80A5, 12, 0.0), (0x8080, 4, 1), (0x8081, 2, "nominal")]
    channel = [(0x8051, 4, 0), (0x8052, 2, "Height")]
    thumbnail = [*picture(np.zeros((2, 2), "u1")), (273, 4, 0), *sides]
    # A private tag puts the counts into the file; the strip of the page leads there.
    body = [*picture(counts, 2), (65000, 7, counts.tobytes()), *slot, *channel]
    place = tiff(thumbnail, [*body, (273, 4, 0)]).index(counts.tobytes())
    return tiff(thumbnail, [*body, (273, 4, place)])


def item(name, kind, value):
    """Return a component of Gwyddion's container."""
    packed = {"o": lambda: value, "s": lambda: value.encode() + b"\0", "i": lambda: struct.pack("<i", value)}
    packed |= {"d": lambda: struct.pack("<d", value)}
    packed |= {"D": lambda: struct.pack("<I", value.size) + np.ascontiguousarray(value, "<f8").tobytes()}
    return name.encode() + b"\0" + kind.encode() + packed[kind]()


def thing(name, *items):
    """Return an object of Gwyddion's container."""
    body = b"".join(items)
    return name.encode() + b"\0" + struct.pack("<I", len(body)) + body


@writes("gwyddion.gwy", missing=True)
def _gwy(heights, dy, dx):
    ny, nx = heights.shape

    def layer(values, unit):
        sides = [item("xres", "i", nx), item("yres", "i", ny)]
        sides += [item("xreal", "d", nx * dx), item("yreal", "d", ny * dy)]
        units = [
            item(f"si_unit_{axis}", "o", thing("GwySIUnit", item("unitstr", "s", word)))
            for axis, word in (("xy", "m"), ("z", unit))
        ]
        return thing("GwyDataField", *sides, *units, item("data", "D", values))

    return b"GWYP" + thing(
        "GwyContainer",
        item("/0/data", "o", layer(filled(heights, 0.0), "m")),
        item("/0/data/title", "s", "Topography"),
        item("/0/mask", "o", layer(np.isnan(heights).astype(float), "")),
    )


@writes("microprof.frt", missing=True)
def _frt(heights, dy, dx):
    ny, nx = heights.shape
    blocks = {
        0x0066: struct.pack("<3I", nx, ny, 32),
        0x0067: struct.pack("<5dI", nx * dx, ny * dy, 0, 0, 1, 0),
        0x006C: struct.pack("<Id", 0, 0.5e-9),
        # 1 marks a missing point, so heights are even counts.
        0x000B: filled(2 * np.rint(heights[::-1] * 1e9), 1).astype("<i4").tobytes(),
    }
    body = b"".join(struct.pack("<HI", key, len(block)) + block for key, block in blocks.items())
    return b"FRTM_GLIDERV1.00" + struct.pack("<H", len(blocks)) + body


@writes("nanosurf.nid")
def _nid(heights, dy, dx):
    ny, nx = heights.shape
    span = 65536e-9  # of two bytes, so that a count is 1 nm
    sections = {
        "DataSet": {
            "Version": 2,
            "GroupCount": 1,
            "Gr0-Name": "Scan forward",
            "Gr0-Count": 1,
            "Gr0-Ch0": "DataSet-0:0",
        },
        "DataSet-Info": {"Date": "06-01-2020", "Time": "10:00:00"},
        "DataSet-0:0": {
            **{"Points": nx, "Lines": ny, "Frame": "Scan forward", "SaveMode": "Binary", "SaveBits": 16},
            **{"SaveSign": "Signed", "SaveOrder": "Intel", "Dim0Range": nx * dx, "Dim0Unit": "m"},
            **{"Dim1Range": ny * dy, "Dim1Unit": "m", "Dim2Name": "Z-Axis", "Dim2Unit": "m"},
            **{"Dim2Min": -span / 2, "Dim2Range": span},
        },
    }
    lines = []
    for name, keys in sections.items():
        lines += [f"[{name}]", *(f"{key}={value}" for key, value in keys.items())]
    return ("\r\n".join(lines) + "\r\n\r\n\r\n#!").encode() + nm(heights[::-1], "<i2")


@writes("asylum.ibw")
def _ibw(heights, dy, dx):
    ny, nx = heights.shape
    body = heights[::-1].T.astype("<f4").tobytes(order="F")
    label = b"".ljust(32, b"\0") + b"HeightRetrace".ljust(32, b"\0")
    head = bytearray(384)
    for place, form, *values in (
        (0, "<2hi", 5, 0, 320 + len(body)),
        (44, "<i", len(label)),  # names along the third axis
        (64 + 12, "<ih", nx * ny, 2),
        (64 + 26, "<h32s", 1, b"wave"),
        (64 + 68, "<4i", nx, ny, 1, 0),
        (64 + 84, "<4d", dx, dy, 1, 1),
        (64 + 148, "<4s4s4s", b"m", b"m", b"m"),
    ):
        struct.pack_into(form, head, place, *values)
    total = int(np.frombuffer(head, "<i2").astype(int).sum())
    struct.pack_into("<h", head, 2, (-total + 32768) % 65536 - 32768)  # so that all of them sum up to 0
    return bytes(head) + body + label


@writes("bare.mat", given={"unit": "m", "size": SIZE})
def _mat(heights, dy, dx):
    from scipy.io import savemat

    stream = io.BytesIO()
    savemat(stream, {"Z": heights})
    return stream.getvalue()


@writes("bare.h5", given={"unit": "m", "size": SIZE})
def _h5(heights, dy, dx):
    import h5py

    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        file["heights"] = heights
    return stream.getvalue()


@writes("omnisurf.os3d", missing=True)
def _os3d(heights, dy, dx):
    ny, nx = heights.shape
    head = b"OmniSurf3D" + struct.pack("<2i", 1, 0) + struct.pack("<I4sI4s", 4, b"part", 4, b"2020")
    head += struct.pack("<2i4d", nx, ny, dx * 1e6, dy * 1e6, 0, 0)
    return head + filled(heights, np.finfo("f4").min, 1e6).astype("<f4").tobytes() + b"\0"  # no picture


@writes("zeta.zmg", positive=True)
def _zmg(heights, dy, dx):
    ny, nx = heights.shape
    head = b"Zeta-Instruments".ljust(85, b"\0")
    head += struct.pack("<2I4s3f8sI", nx, ny, b"", dx * 1e6, dy * 1e6, 1e-3, b"", 0) + b"\0" * 84
    return head + nm(heights, "<u2")


@writes("sensofar.plux", missing=True)
def _plux(heights, dy, dx):
    ny, nx = heights.shape
    index = (
        f"<xml><GENERAL><IMAGE_SIZE_X>{nx}</IMAGE_SIZE_X><IMAGE_SIZE_Y>{ny}</IMAGE_SIZE_Y>"
        f"<FOV_X>{dx * 1e6}</FOV_X><FOV_Y>{dy * 1e6}</FOV_Y><DATE>2020-01-06</DATE></GENERAL>"
        "<INFO><SIZE>0</SIZE></INFO><LAYER_0><FILENAME_Z>LAYER_0.raw</FILENAME_Z></LAYER_0></xml>"
    )
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("index.xml", index)
        archive.writestr("LAYER_0.raw", (heights * 1e6).astype("<f4").tobytes())
    return stream.getvalue()
