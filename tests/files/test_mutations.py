"""Every measured file, spoilt in every way: an error of ours, the right data, or a word of warning."""

import time

import pytest

import roughcontact as rc
from files.spoiling import GUARDED, LOST, MUTATIONS, attempt, is_right
from measured import NOT_HERE, SURFACES

if SURFACES is None:
    pytest.skip(NOT_HERE, allow_module_level=True)

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
SLOWEST = 30.0  # seconds


def tried(path):
    return attempt(path, path.name in LINES, GIVEN.get(path.name))


@pytest.fixture(scope="module", params=NAMES)
def whole(request):
    """The path of a measured file, its bytes and its surface."""
    path = SURFACES / request.param
    if path.suffix not in OWN:
        pytest.importorskip("SurfaceTopography")
    return path, path.read_bytes(), tried(path)[0]


@pytest.mark.parametrize("mutation", MUTATIONS)
def test_a_spoilt_file(whole, put, caplog, capfd, mutation):
    path, data, truth = whole
    started = time.monotonic()
    outcome, warned = tried(put(path.name, MUTATIONS[mutation](data)))
    assert time.monotonic() - started < SLOWEST
    assert not caplog.records
    assert capfd.readouterr() == ("", "")
    if isinstance(outcome, rc.ReadError):
        assert str(outcome).startswith(f"{path.name}: ")
        return
    assert mutation not in LOST or len(data) <= 256
    right = is_right(outcome, truth)
    assert right or (warned and path.suffix not in GUARDED)


def test_the_whole_files_are_read(whole):
    _, _, truth = whole
    assert isinstance(truth, rc.Surface)
