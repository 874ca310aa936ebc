"""Every measured file, spoilt in every way: an error of ours, the right data, or a word of warning."""

import time
import warnings

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import read_line

LINES = {"dektak-1.csv"}
GIVEN = {
    "derived_di3_nm.npy": {"unit": "nm", "size": "10 um"},
    "derived_mi1.mat": {"unit": "m", "size": (20e-6, 20e-6)},
    "rsciio_test_surface_au.sur": {"unit": "nm"},
}
NAMES = [
    "AR_20211011.ibw",
    "ISO5436-sample1.x3p",
    "KautschukInfiniteFocus.x3p",
    "Park_20210916_034.tiff",
    "al3d-1.al3d",
    "dektak-1.csv",
    "derived_al3d_crop.xyz",
    "derived_di3_nm.npy",
    "derived_frt2_masked.gwy",
    "derived_mi1.mat",
    "derived_top1.nc",
    "di-3.di",
    "frt-2.frt",
    "gwyddion-export-german.txt",
    "image.nid",
    "matrix-3.txt",
    "mi-1.mi",
    "rsciio_test_surface_au.sur",
    "sample_0.jpk-qi-image",
    "sur-2.sur",
    "test_1.opd",
    "tmd-1.tmd",
    "top-1.top",
    "valid_zygo_dat_file.dat",
]
OWN = (".x3p", ".csv", ".xyz", ".npy", ".nc", ".txt", ".sur", ".gwy", ".tmd")
# A checksum guards the heights and what they mean.
GUARDED = (".x3p",)
SLOWEST = 30.0  # seconds


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


def attempt(path):
    """Return the surface or the ReadError, and whether a warning was spoken; anything else goes through."""
    reader = read_line if path.name in LINES else rc.read
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            outcome = reader(path, **GIVEN.get(path.name, {}))
        except rc.ReadError as error:
            outcome = error
    said = [one for one in said if "dateutil" not in one.filename]  # it warns of an unknown time zone
    assert all(one.category is SurfaceWarning for one in said)
    return outcome, bool(said)


@pytest.fixture(scope="module", params=NAMES)
def whole(request, surfaces):
    """The path of a measured file, its bytes and its surface."""
    path = surfaces / request.param
    if path.suffix not in OWN:
        pytest.importorskip("SurfaceTopography")
    return path, path.read_bytes(), attempt(path)[0]


@pytest.mark.parametrize("mutation", MUTATIONS)
def test_a_spoilt_file(whole, put, caplog, capfd, mutation):
    path, data, truth = whole
    started = time.monotonic()
    outcome, warned = attempt(put(path.name, MUTATIONS[mutation](data)))
    assert time.monotonic() - started < SLOWEST
    assert not caplog.records
    assert capfd.readouterr() == ("", "")
    if isinstance(outcome, rc.ReadError):
        assert str(outcome).startswith(f"{path.name}: ")
        return
    assert mutation not in {"empty", "one byte", "256 bytes", "garbage", "zeros"} or len(data) <= 256
    right = is_right(outcome, truth)
    assert right or (warned and path.suffix not in GUARDED)


def is_right(outcome, truth):
    """Whether heights and cells are those of the whole file, but for the last digits of what a header prints."""
    return outcome.grid.shape == truth.grid.shape and (
        np.allclose(outcome.grid.spacing, truth.grid.spacing, rtol=1e-6, atol=0)
        and np.allclose(outcome.heights, truth.heights, rtol=1e-6, atol=1e-9 * truth.rms, equal_nan=True)
    )


def test_the_whole_files_are_read(whole):
    _, _, truth = whole
    assert isinstance(truth, rc.Surface)
