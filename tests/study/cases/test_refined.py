"""The case of one surface on grids of several sizes."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases import find_case
from roughcontact.study.cases.curve_case import CASE as CURVE, CurveParameters
from roughcontact.study.cases.refined_case import CASE, RefinedParameters
from roughcontact.study.study_errors import StudyError

GIVEN = {
    "points": 16,
    "drawn_on": 64,
    "size": 2e-3,
    "modulus": 1e11,
    "hurst": 0.7,
    "rms": 1e-6,
    "short_cutoff": 0.25,
}


def roughness(seed=0, **given):
    return RefinedParameters(**(GIVEN | given)).roughness(np.random.default_rng(seed))


def test_it_comes_with_the_package():
    assert find_case("refined") is CASE


def test_a_surface_is_the_same_on_all_grids():
    whole = rc.self_affine(
        rc.Grid((64, 64), 2e-3 / 64), 0.7, 1e-6, np.random.default_rng(0), short_cutoff=0.5e-3
    )
    np.testing.assert_array_equal(roughness(points=64).heights, whole.heights)
    for points in (32, 16):
        coarse = roughness(points=points)
        assert coarse.grid == rc.Grid((points, points), 2e-3 / points)
        np.testing.assert_array_equal(coarse.heights, whole.heights[:: 64 // points, :: 64 // points])
        # Waves longer than two cells lose nothing: mean squares are those of the waves.
        assert coarse.rms == pytest.approx(1e-6, rel=1e-12)
        slopes = [rc.surface_moments(each, derivative="spectral").rms_slope for each in (coarse, whole)]
        assert slopes[0] == pytest.approx(slopes[1], rel=1e-12)


def test_longer_waves_are_the_same_whatever_the_shortest():
    few, many = (np.fft.fft2(roughness(points=64, short_cutoff=each).heights) for each in (0.5, 0.125))
    long = np.abs(few) > 1e-9 * np.abs(few).max()
    ratio = many[long] / few[long]
    assert 0 < long.sum() < (np.abs(many) > 1e-9 * np.abs(many).max()).sum()
    # One factor for all of them: both surfaces have the rms height that was asked for.
    np.testing.assert_allclose(ratio, ratio[0].real, rtol=1e-9)
    assert 0 < ratio[0].real < 1


def test_a_record_is_that_of_the_curve():
    given = GIVEN | {"points": 64, "loads": 3}
    record = CASE.run(RefinedParameters(**given), np.random.default_rng(2))
    plain = {name: value for name, value in given.items() if name != "drawn_on"}
    assert record.identical(CURVE.run(CurveParameters(**plain), np.random.default_rng(2)))


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"drawn_on": 60}, "multiple of points, not 60 with 16"),
        ({"short_cutoff": 0.125}, r"above two cells, 0.125 on 16 points, not 0.125"),
        ({"drawn_on": 8}, "multiple of points"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, says):
    with pytest.raises(StudyError, match=says):
        roughness(**wrong)
