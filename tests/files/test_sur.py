"""Digital Surf's files, from a writer of a few lines that fills the header by offsets."""

import struct
import tracemalloc
import zlib
from types import SimpleNamespace

import numpy as np
import psutil
import pytest

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels, read_line

COUNTS = np.array([[5, -7, 100, 3], [8, 0, 2, -40], [1, 2, 3, 4]])
STEP = 0.25  # exact in single precision


def sur(
    counts=COUNTS,
    *,
    bits=32,
    packed=0,
    unit="µm",
    lateral="mm",
    comment=b"",
    private=b"",
    missing=None,
    encoding="latin-1",
    **fields,
):
    """Return a file; `fields` are values (format, offset, value) that replace those of the header."""
    ny, nx = counts.shape
    low, high = int(counts.min()), int(counts.max())
    data = counts.copy()
    if missing is not None:
        data[missing] = low - 2
    head = bytearray(512)
    for where, form, value in (
        (0, "12s", b"DSCOMPRESSED" if packed else b"DIGITAL SURF"),
        (14, "<hhh", (1, 1, 2)),
        (86, "<h", 0 if missing is None else 1),
        (98, "<h", bits),
        (100, "<iiiii", (low, high, nx, ny, nx * ny)),
        (120, "<fff", (0.5, 2.0, STEP)),
        (132, "16s16s16s", (b"X", b"Y", b"Z")),
        (
            180,
            "16s16s16s",
            (lateral.encode(encoding or "latin-1"),) * 2 + (unit.encode(encoding or "latin-1").ljust(16),),
        ),
        (334, "<HH", (len(comment), len(private))),
        *fields.values(),
    ):
        struct.pack_into(form, head, where, *(value if isinstance(value, tuple) else (value,)))
    body = data.astype(f"<i{bits // 8}").tobytes()
    if packed:
        parts = [body[k::1][: -(-len(body) // packed)] for k in range(0, len(body), -(-len(body) // packed))]
        streams = [zlib.compress(part) for part in parts]
        table = b"".join(struct.pack("<II", len(a), len(b)) for a, b in zip(parts, streams, strict=True))
        body = struct.pack("<I", len(parts)) + table + b"".join(streams)
    return bytes(head) + comment + private + body


@pytest.mark.parametrize("bits", [16, 32])
@pytest.mark.parametrize("packed", [0, 1, 3])
@pytest.mark.parametrize(
    ("comment", "private"), [(b"", b""), (b"some words", b""), (b"words", b"of a program")]
)
def test_whole_numbers_times_their_step(put, bits, packed, comment, private):
    surface = rc.read(put("a.sur", sur(bits=bits, packed=packed, comment=comment, private=private)))
    np.testing.assert_allclose(surface.heights, COUNTS * STEP * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (2e-3, 0.5e-3), rtol=1e-15)
    assert surface.provenance[0].startswith("read from a.sur (Digital Surf, channel 'Z', sha256 ")


def test_missing_points(put):
    mask = COUNTS == 2
    surface = rc.read(put("a.sur", sur(missing=mask)))
    assert np.array_equal(np.isnan(surface.heights), mask)


@pytest.mark.parametrize(
    ("mode", "turn"), [(1, lambda h: -h), (2, lambda h: -h[:, ::-1]), (3, lambda h: -h[::-1])]
)
def test_inverted_heights_are_turned_back(put, mode, turn):
    surface = rc.read(put("a.sur", sur(mode=(290, "<h", mode))))
    np.testing.assert_allclose(surface.heights, turn(COUNTS) * STEP * 1e-6, rtol=1e-15)
    assert any("inverted" in line for line in surface.provenance)


def test_a_profile_is_a_line_scan(put):
    path = put("a.pro", sur(COUNTS[:1], kind=(18, "<h", 1)))
    line = read_line(path)
    np.testing.assert_allclose(line.heights, COUNTS[0] * STEP * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(line.grid.spacing, (0.5e-3,), rtol=1e-15)
    with pytest.raises(rc.ReadError, match="profile of 4 heights"):
        rc.read(path)


def test_a_map_of_type_1_is_a_map(put):
    """As Gwyddion exports it: the type of a profile, with all its lines."""
    path = put("a.sur", sur(kind=(18, "<h", 1)))
    surface = rc.read(path)
    np.testing.assert_allclose(surface.heights, COUNTS * STEP * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (2e-3, 0.5e-3), rtol=1e-15)
    assert any("type 1 (profile) with 3 lines" in line for line in surface.provenance)
    with pytest.raises(rc.ReadError, match=r"a map of 3 x 4 heights.*use read"):
        read_line(path)


@pytest.mark.parametrize("encoding", ["latin-1", "utf-8"])
@pytest.mark.parametrize("packed", [0, 1])
def test_units_in_either_encoding(put, encoding, packed):
    surface = rc.read(put("a.sur", sur(lateral="µm", unit="µm", encoding=encoding, packed=packed)))
    np.testing.assert_allclose(surface.heights, COUNTS * STEP * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (2e-6, 0.5e-6), rtol=1e-15)


def test_each_direction_has_its_unit(put):
    surface = rc.read(
        put("a.sur", sur(unit="nm", lateral="mm", dy_unit=(196, "16s", "µm".encode("latin-1"))))
    )
    np.testing.assert_allclose(surface.heights, COUNTS * STEP * 1e-9, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (2e-6, 0.5e-3), rtol=1e-15)


@pytest.mark.parametrize("packed", [0, 2])
@pytest.mark.parametrize("spare", [b"x", b"\0" * 8])
def test_bytes_behind_its_heights_are_warned_of(put, packed, spare):
    with pytest.warns(SurfaceWarning, match=f"{len(spare)} bytes at its end belong to no height"):
        surface = rc.read(put("a.sur", sur(packed=packed) + spare))
    np.testing.assert_allclose(surface.heights, COUNTS * STEP * 1e-6, rtol=1e-15)


def test_a_byte_more_in_a_stream_is_warned_of(put):
    body = COUNTS.astype("<i4").tobytes() + b"\0"
    stream = zlib.compress(body)
    path = put("a.sur", sur(packed=1)[:512] + struct.pack("<III", 1, len(body), len(stream)) + stream)
    with pytest.warns(SurfaceWarning, match="1 bytes at its end belong to no height"):
        surface = rc.read(path)
    np.testing.assert_allclose(surface.heights, COUNTS * STEP * 1e-6, rtol=1e-15)


def test_arbitrary_units_are_named(put):
    path = put("a.sur", sur(unit="a.u."))
    with pytest.raises(rc.ReadError, match=r"a\.sur: it states heights in 'a\.u\.', which is no length"):
        rc.read(path)
    (channel,) = channels(path)
    assert (channel.unit, channel.shape) == ("a.u.", (3, 4))
    assert rc.read(path, unit="nm").heights[0, 0] == pytest.approx(5 * STEP * 1e-9, rel=1e-15)
    with pytest.raises(rc.ReadError, match="no size"):
        rc.read(put("b.sur", sur(lateral="px")))


@pytest.mark.parametrize(
    ("field", "message"),
    [
        ((0, "12s", b"DIGITAL SURV"), "no whole header"),
        ((12, "<h", 256), "byte order 256"),
        ((14, "<h", 3), "3 objects"),
        ((18, "<h", 12), "type 12"),
        ((98, "<h", 24), "of 24 bits"),
        ((108, "<i", 5), "3 x 5 points"),
        ((108, "<i", -4), "3 x -4 points"),
        ((120, "<f", -1.0), "steps of -1"),
        ((120, "<f", 0.0), "steps of 0, 2, 0.25 "),
        ((124, "<f", 0.0), "steps of 0.5, 0, 0.25 "),
        ((128, "<f", 0.0), "steps of 0.5, 2, 0 "),
        ((128, "<f", float("nan")), "steps of .*nan"),
        ((334, "<H", 60000), "cut short"),
    ],
)
def test_a_header_that_cannot_be_is_refused(put, field, message):
    with pytest.raises(rc.ReadError, match=r"a\.sur: .*" + message):
        rc.read(put("a.sur", sur(field=field)))


@pytest.mark.filterwarnings("ignore:.*unusual:roughcontact.files.file_errors.SurfaceWarning")
@pytest.mark.parametrize("packed", [0, 2])
def test_damage_is_refused_or_named(put, packed):
    whole = sur(packed=packed)
    for end in (100, 511, 512, 530, len(whole) - 1):
        with pytest.raises(rc.ReadError, match=r"a\.sur"):
            rc.read(put("a.sur", whole[:end]))
    with pytest.raises(rc.ReadError, match="holds 0 of 48 bytes of heights" if not packed else "are damaged"):
        rc.read(put("a.sur", whole[:512]))
    spoilt = bytearray(whole)
    spoilt[-3] ^= 0x40
    if packed:
        with pytest.raises(rc.ReadError, match="compressed heights are damaged"):
            rc.read(put("a.sur", bytes(spoilt)))
    else:
        with pytest.warns(UserWarning, match="1 heights lie outside the range"):
            rc.read(put("a.sur", bytes(spoilt)))


def test_a_stream_that_promises_too_little_or_too_much_is_refused(put):
    whole = bytearray(sur(packed=1))
    for length in (3, 10**9):
        struct.pack_into("<I", whole, 516, length)
        with pytest.raises(rc.ReadError, match="compressed heights are damaged"):
            rc.read(put("a.sur", bytes(whole)))
    struct.pack_into("<I", whole, 512, 2**32 - 1)
    with pytest.raises(rc.ReadError, match=r"a\.sur"):
        rc.read(put("a.sur", bytes(whole)))


def test_streams_that_unpack_to_more_than_the_header_states_are_not_unpacked(put):
    """Two hundred streams of the whole map each, of zeros: each is as long as stated, all together are not."""
    whole = np.zeros((500, 1000), "<i4").tobytes()
    stream = zlib.compress(whole)
    packed = struct.pack("<I", 200) + struct.pack("<II", len(whole), len(stream)) * 200 + stream * 200
    head = sur(np.zeros((500, 1000), int), packed=1)[:512]
    path = put("a.sur", head + packed)
    tracemalloc.start()
    with pytest.raises(rc.ReadError, match="a stream holds 1 bytes where its table states 2000000"):
        rc.read(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2e7  # unpacked they take 400 MB


def test_points_beyond_the_memory_are_not_unpacked(put, monkeypatch):
    data = bytearray(sur(packed=1))
    struct.pack_into("<iii", data, 108, 40000, 50000, 2_000_000_000)
    monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=8e9))
    with pytest.raises(rc.ReadError, match="needs 200 GB of memory, and 8 GB are free"):
        rc.read(put("a.sur", bytes(data)))
