"""Ways to spoil a file of our own formats: the right data or a ReadError, never anything else.

Of formats of instruments that state their lengths and no checksum: the right data, a word, or a ReadError.
"""

import warnings
import zlib

import numpy as np
import pytest

import instruments as of
import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning

RNG = np.random.default_rng(11)
HEIGHTS = RNG.standard_normal((23, 31))
GIVEN = {"unit": "um", "size": 1e-3}


def lines(separator=" "):
    return "\n".join(separator.join(map(repr, row)) for row in HEIGHTS.tolist()) + "\n"


def points():
    table = [(x, y, HEIGHTS[y, x].item()) for y in range(23) for x in range(31)]
    return "# x [um] y [um] z [um]\n" + "".join(f"{x} {y} {z!r}\n" for x, y, z in table)


HEADER = "# Channel: Z\n# Width: 31 µm\n# Height: 23 µm\n# Value units: µm\n"
FLIPS = 6
# A checksum or an exact length guards these: whatever is changed in them is noticed or does not matter.
GUARDED = {"a.npz", "b.npz", "a.x3p", "b.x3p", "c.x3p", "d.x3p"}


@pytest.fixture(scope="module")
def originals(npy, npz, make_x3p):
    return {
        "a.npy": npy(HEIGHTS),
        "a.npz": npz(heights=HEIGHTS),
        "b.npz": npz(z=HEIGHTS, unit="um", spacing=1e-6),
        "a.txt": lines().encode(),
        "b.txt": (HEADER + lines("\t")).encode(),
        "a.csv": lines(",").encode(),
        "a.xyz": points().encode(),
        "a.x3p": make_x3p(HEIGHTS),
        "b.x3p": make_x3p(HEIGHTS, listed=True),
        "c.x3p": make_x3p(np.rint(HEIGHTS * 1e3), "I", increment=1e-3, valid=HEIGHTS < 9, folder="deep/"),
        "d.x3p": make_x3p(HEIGHTS, "F"),
    }


def flip(data, seed, start=0, stop=2000, count=20):
    spoilt = bytearray(data)
    for place in np.random.default_rng(seed).integers(start, min(stop, len(data)), count):
        spoilt[place] ^= 1 << int(place) % 8
    return bytes(spoilt)


MUTATIONS = {
    "empty": lambda data: b"",
    "one byte": lambda data: data[:1],
    "cut at half": lambda data: data[: len(data) // 2],
    "cut at 97 %": lambda data: data[: int(0.97 * len(data))],
    "256 bytes": lambda data: data[:256],
    "garbage": lambda data: np.random.default_rng(0).bytes(len(data)),
    "header and garbage": lambda data: data[:128] + np.random.default_rng(1).bytes(max(0, len(data) - 128)),
    "zeros": lambda data: bytes(len(data)),
    **{f"flipped bytes {seed}": (lambda data, seed=seed: flip(data, seed)) for seed in range(FLIPS)},
    "0xFF over the header": lambda data: b"\xff" * 64 + data[64:],
}
LOST = {
    "empty",
    "one byte",
    "cut at half",
    "cut at 97 %",
    "256 bytes",
    "garbage",
    "header and garbage",
    "zeros",
}
NAMES = ["a.npy", "a.npz", "b.npz", "a.txt", "b.txt", "a.csv", "a.xyz", "a.x3p", "b.x3p", "c.x3p", "d.x3p"]


@pytest.mark.parametrize("mutation", MUTATIONS)
@pytest.mark.parametrize("name", NAMES)
def test_a_spoilt_file(put, originals, name, mutation):
    data = MUTATIONS[mutation](originals[name])
    outcome = attempt(put(name, data))
    if name == "a.xyz" and mutation.startswith("cut") and not isinstance(outcome, rc.ReadError):
        # A list of points does not say how many there should be: those left must be right, save the last.
        left = outcome.heights[:-1]
        np.testing.assert_allclose(left, HEIGHTS[: len(left)] * 1e-6, rtol=1e-14)
    elif mutation in LOST:
        assert isinstance(outcome, rc.ReadError)
    if isinstance(outcome, rc.ReadError):
        assert str(outcome).startswith(f"{name}: ")
    elif name in GUARDED:
        assert np.array_equal(outcome.heights, attempt(put(name, originals[name])).heights)


def attempt(path):
    """Return the surface or the ReadError; any other error, and any warning but our own, goes through."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SurfaceWarning)
        try:
            return rc.read(path, **GIVEN)
        except rc.ReadError as error:
            return error


@pytest.mark.parametrize("name", NAMES)
def test_the_file_that_is_spoilt_can_be_read(put, originals, name):
    surface = attempt(put(name, originals[name]))
    expected = {"c.x3p": np.rint(HEIGHTS * 1e3) * 1e-3, "d.x3p": HEIGHTS.astype("f4").astype("f8")}.get(
        name, HEIGHTS
    )
    np.testing.assert_allclose(surface.heights, expected * 1e-6, rtol=1e-14)


@pytest.mark.parametrize("name", ["a.npy", "a.npz", "a.x3p", "b.x3p", "a.xyz"])
def test_one_flipped_byte_anywhere(put, originals, name):
    data = originals[name]
    for seed in range(40):
        place = zlib.crc32(f"{name}{seed}".encode()) % len(data)
        attempt(put(name, flip(data, seed, place, place + 1, 1)))


Z = of.hills()
COUNTS = np.rint(Z * 9000)
FAMILIES = {
    "a.gsf": of.gsf(Z * 1e-6),
    "a.gwy": of.gwy(of.gwy_field(Z * 1e-6), of.gwy_field(Z, ("m", "V")), titles=("Height", "Phase")),
    "a.sdf": of.sdf_binary(COUNTS, 5),
    "b.sdf": of.sdf_binary(Z * 1e3, 7, mark="bBCR-1.0"),
    "c.sdf": of.sdf_text(COUNTS, 6, mark="aBCR-1.0"),
    "a.tmd": of.tmd(Z * 1e-3),
    "a.tif": of.tiff((COUNTS + 20000).astype("u2"), rows=8),
    "b.tif": of.tiff((Z * 100).astype("f4"), order=">"),
    "c.tif": of.tiff((COUNTS + 20000).astype("u2"), rows=8, deflate=True),
    "a.001": of.nanoscope(
        np.rint(of.hills(16, 72) * 9000), size="2 2 ~m", aspect="4.5:1", scan_aspect="4.5:1"
    ),
    "a.mat": of.mat(Z=Z),
}
UNREAD = {"empty", "one byte", "cut at half", "cut at 97 %", "garbage", "zeros"}
LENGTHS = {
    **{name: MUTATIONS[name] for name in sorted(UNREAD)},
    "0xFF over the header": MUTATIONS["0xFF over the header"],
    **{f"a byte more at {k}": (lambda d, k=k: d[:k] + b"\x55" + d[k:]) for k in (9, 60, 100, 700, 3000)},
    **{f"a byte less at {k}": (lambda d, k=k: d[:k] + d[k + 1 :]) for k in (9, 60, 100, 700, 3000)},
    "40 bytes less": lambda d: d[:2500] + d[2540:],
    "a byte more at the end": lambda d: d + b"\x55",
}


@pytest.mark.parametrize("mutation", LENGTHS)
@pytest.mark.parametrize("name", FAMILIES)
def test_a_length_that_does_not_fit_is_noticed(put, name, mutation):
    whole, data = FAMILIES[name], LENGTHS[mutation](FAMILIES[name])
    if name == "a.001":
        pytest.importorskip("SurfaceTopography")
    truth, outcome, said = *said_of(put(name, whole))[:1], *said_of(put(name, data))
    if isinstance(outcome, rc.ReadError):
        assert str(outcome).startswith(f"{name}: ")
        return
    assert mutation not in UNREAD
    unchanged = truth.grid == outcome.grid and np.array_equal(truth.heights, outcome.heights)
    # A byte within words that mean nothing, such as the name of a channel or a comment, changes nothing; a digit more
    # or less in a text is a number.
    assert unchanged or said or name == "c.sdf"


def said_of(path):
    """Return the surface or the ReadError, and the warnings of ours; any other goes through."""
    given = {} if path.suffix in {".gsf", ".gwy", ".sdf", ".tmd", ".001"} else GIVEN
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            return rc.read(path, **given), [one for one in said if one.category is SurfaceWarning]
        except rc.ReadError as error:
            return error, []
