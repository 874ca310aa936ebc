"""Ten ways to spoil a file of our own formats: the right data or a ReadError, never anything else."""

import warnings
import zlib

import numpy as np
import pytest

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
