"""Ways to spoil a file, and what comes of reading it."""

import warnings

import numpy as np

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import read_line

__all__ = ["GUARDED", "LOST", "MUTATIONS", "attempt", "is_right"]

# A checksum guards the heights and what they mean.
GUARDED = (".x3p",)
# After these there is nothing left to read of any file but a tiny one.
LOST = {"empty", "one byte", "256 bytes", "garbage", "zeros"}


def flip(data, seed):
    spoilt = bytearray(data)
    for place in np.random.default_rng(seed).integers(0, min(2000, len(data)), 20):
        spoilt[place] ^= 1 << int(place) % 8
    return bytes(spoilt)


def garbage(count, seed=0):
    return np.random.default_rng(seed).bytes(max(0, count))


MUTATIONS = {
    "empty": lambda data: b"",
    "one byte": lambda data: data[:1],
    "cut at half": lambda data: data[: len(data) // 2],
    "cut at 97 %": lambda data: data[: int(0.97 * len(data))],
    "256 bytes": lambda data: data[:256],
    "garbage": lambda data: garbage(len(data)),
    "garbage after 128 bytes": lambda data: data[:128] + garbage(len(data) - 128, 1),
    "garbage after a tenth": lambda data: data[: len(data) // 10] + garbage(len(data) - len(data) // 10, 2),
    "zeros": lambda data: bytes(len(data)),
    **{f"flipped bytes {seed}": (lambda data, seed=seed: flip(data, seed)) for seed in range(5)},
    "0xFF over the header": lambda data: b"\xff" * 64 + data[64:],
    "a byte more": lambda data: data[:300] + b"\x55" + data[300:],
    "a byte less": lambda data: data[: len(data) // 2] + data[len(data) // 2 + 1 :],
}


def attempt(path, is_line=False, given=None):
    """Return the surface or the ReadError, and whether a warning was spoken; anything else goes through."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            outcome = (read_line if is_line else rc.read)(path, **(given or {}))
        except rc.ReadError as error:
            outcome = error
    said = [one for one in said if "dateutil" not in one.filename]  # it warns of an unknown time zone
    assert all(one.category is SurfaceWarning for one in said)
    return outcome, bool(said)


def is_right(outcome, truth):
    """Whether heights and cells are those of the whole file, but for the last digits of what a header prints."""
    return outcome.grid.shape == truth.grid.shape and (
        np.allclose(outcome.grid.spacing, truth.grid.spacing, rtol=1e-6, atol=0)
        and np.allclose(outcome.heights, truth.heights, rtol=1e-6, atol=1e-9 * truth.rms, equal_nan=True)
    )
