"""The case of interacting asperities."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases.asperities_case import CASE, AsperityParameters, summits_of
from roughcontact.study.record import decode, encode
from roughcontact.study.study_errors import StudyError
from roughcontact.surface.analysis.summits import find_summits

GIVEN = {"hurst": 0.6, "points": 64, "loads": 5}


def run(seed=0, **given):
    return CASE.run(AsperityParameters(**GIVEN | given), np.random.default_rng(seed))


def test_summits_are_those_of_the_surface():
    surface = rc.self_affine(
        rc.Grid((32, 48), (2e-6, 1e-6), periodic=True), 0.5, 1e-7, np.random.default_rng(2)
    )
    asperities, found = summits_of(surface), find_summits(surface)
    np.testing.assert_allclose(asperities.x, found.columns * 1e-6, rtol=1e-14)
    np.testing.assert_allclose(asperities.y, found.rows * 2e-6, rtol=1e-14)
    np.testing.assert_array_equal(asperities.height, found.height)
    np.testing.assert_array_equal(asperities.radius, found.radius)


def test_at_the_lowest_force_one_sphere_is_touched():
    record = run(lowest_force=1e-9, highest_force=1e-7)
    surface = rc.self_affine(rc.Grid((64, 64), 1 / 64, periodic=True), 0.6, 1.0, np.random.default_rng(0))
    found = find_summits(surface)
    radius = found.radius[np.argmax(found.height)]
    sphere = (6 * radius * record["dimensionless_force"]) ** (1 / 3)  # thesis, eq. 5.4
    assert (record["spots"] == 1).all()
    assert (record["merged"] == 0).all()
    np.testing.assert_allclose(record["dimensionless_stiffness"], sphere, rtol=1e-9)
    np.testing.assert_allclose(record["independent_stiffness"], sphere, rtol=1e-9)


def test_summits_that_push_each_other_down_are_less_stiff_together():
    record = run()
    assert (record["spots"].diff("load") >= 0).all()
    together, alone = (
        record[name].to_numpy() for name in ("dimensionless_stiffness", "independent_stiffness")
    )
    assert (together <= alone * (1 + 1e-9)).all()
    assert together[-1] < 0.9 * alone[-1]


def test_a_record_is_pure_and_survives_as_text():
    assert run(seed=3).identical(run(seed=3))
    assert decode(encode(run())).identical(run())


@pytest.mark.parametrize("wrong", [{"points": 4}, {"hurst": -2}, {"highest_force": 1e-5}, {"lines": 3}])
def test_what_makes_no_sense_is_refused(wrong):
    with pytest.raises(StudyError):
        run(**wrong)
