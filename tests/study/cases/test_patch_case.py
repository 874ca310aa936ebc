"""The case of patches that are cut from a larger surface."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases import find_case
from roughcontact.study.cases.patch_case import CASE, PatchParameters
from roughcontact.study.study_errors import StudyError

GIVEN = {"points": 24, "size": 2e-3, "modulus": 1e11, "hurst": 0.8, "rms": 1e-6, "rolloff": 0.5, "loads": 3}


def run(seed=0, **given):
    return CASE.run(PatchParameters(**(GIVEN | given)), np.random.default_rng(seed))


def test_it_comes_with_the_package():
    assert find_case("patch") is CASE


def test_the_curve_is_that_of_the_patch_and_the_moments_are_those_of_the_whole():
    record = run(seed=3, period=3)
    whole = rc.self_affine(
        rc.Grid((72, 72), 2e-3 / 24, True), 0.8, 1e-6, np.random.default_rng(3), rolloff=0.5 * 2e-3
    )
    patch = rc.Surface(whole.heights[:24, :24], rc.Grid((24, 24), 2e-3 / 24)).levelled("plane")
    forces = np.geomspace(1e-4, 0.07, 3) * (1e11 * 2e-3 * 1e-6)
    curve = rc.loading_curve(patch, 1e11, forces=forces)
    for name in ("stiffness", "interfacial_stiffness", "contact_area", "depth"):
        np.testing.assert_array_equal(record[name], getattr(curve, name), err_msg=name)
    assert float(record["rms"]) == patch.rms
    assert float(record["rms_slope"]) == rc.surface_moments(whole, derivative="spectral").rms_slope


def test_patches_of_one_period_are_cut_from_one_surface():
    small, large = run(seed=1, period=4), run(seed=1, period=2, points=48, size=4e-3, rolloff=0.25)
    assert float(small["rms_curvature"]) == pytest.approx(float(large["rms_curvature"]), rel=1e-12)


def test_a_patch_does_not_repeat_itself():
    with pytest.raises(StudyError, match="leave periodic out"):
        PatchParameters(**GIVEN, period=2, periodic=True)
    with pytest.raises(StudyError, match="period"):
        PatchParameters(**GIVEN, period=1)
