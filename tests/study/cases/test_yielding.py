"""The case of surfaces under a ceiling of the pressure."""

from functools import partial

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases import find_case
from roughcontact.study.cases.yielding_case import CASE, YieldingParameters
from roughcontact.study.study_errors import StudyError
from study.cases.pure import pure_record

GIVEN = {"points": 32, "size": 2e-3, "modulus": 1e11, "hurst": 0.7, "rms": 1e-6, "loads": 4}


def run(seed=0, **given):
    return CASE.run(YieldingParameters(**(GIVEN | given)), np.random.default_rng(seed))


def surface():
    return rc.self_affine(rc.Grid((32, 32), 2e-3 / 32), 0.7, 1e-6, np.random.default_rng(0))


def test_it_comes_with_the_package():
    assert find_case("yielding") is CASE


def test_without_a_ceiling_it_is_the_loading_curve_at_these_depths():
    record = run()
    depths = np.geomspace(0.3, 3, 4) * 1e-6
    curve = rc.loading_curve(surface(), 1e11, depths=depths, tolerance=1e-6)
    np.testing.assert_array_equal(record["depth"], curve.depth)
    for name in ("force", "stiffness", "contact_area"):
        np.testing.assert_array_equal(record[name], getattr(curve, name))
    np.testing.assert_allclose(record["dimensionless_force"], curve.force / (1e11 * 2e-3 * 1e-6), rtol=1e-12)
    assert (record["yielded"] == 0).all()
    assert "hardness" not in record
    # The whole region answers; the tolerance of its displacement is 1e-4, the stiffness good to its square.
    np.testing.assert_allclose(record["region_stiffness"], record["stiffness"], rtol=1e-6)
    assert run(relative_hardness=1e3).drop_vars("hardness").identical(record)


def test_under_a_ceiling_the_area_bears_no_more_than_it():
    elastic, hard = run(), run(relative_hardness=0.2)
    hardness = float(hard["hardness"])
    assert hardness == pytest.approx(
        0.2 * 1e11 * rc.surface_moments(surface(), derivative="spectral").rms_slope, rel=1e-14
    )
    assert hard.identical(run(hardness=hardness))
    # At one depth: a lower pressure on a larger region.
    assert (hard["force"] < elastic["force"]).all()
    assert (hard["contact_area"] >= elastic["contact_area"]).all()
    mean_pressure = hard["force"] / hard["contact_area"]
    assert (mean_pressure <= hardness * (1 + 1e-12)).all()
    assert (mean_pressure >= hardness * hard["yielded"]).all()
    assert (hard["yielded"] > 0).all()
    # Fewer cells answer to going on than stand in contact, and a part is no stiffer than the whole.
    assert (hard["stiffness"] < hard["region_stiffness"]).all()
    assert (hard["region_stiffness"] >= elastic["region_stiffness"]).all()
    region = rc.contact_stiffness(
        rc.press(surface(), 1e11, depth=float(hard["depth"][-1]), hardness=hardness).contact,
        surface().grid,
        1e11,
    )
    assert float(hard["region_stiffness"][-1]) == pytest.approx(region, rel=1e-6)


def test_a_very_soft_body_bears_on_what_lies_above_the_flat():
    record = run(relative_hardness=1e-4)
    # Under next to no pressure nothing moves: the region is the cut through the heights.
    below = surface().heights.max() - surface().heights
    cut = [(below <= depth).sum() for depth in record["depth"].to_numpy()]
    # Displacements are about 1e-4 of the heights, so that a cell or two on the edge may differ.
    np.testing.assert_allclose(record["contact_area"] / (2e-3 / 32) ** 2, cut, atol=2)
    np.testing.assert_allclose(record["force"], record["contact_area"] * float(record["hardness"]), rtol=0.05)


def test_it_is_pure_and_survives_as_text():
    pure_record(partial(run, relative_hardness=0.5))


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"lowest_depth": 4.0}, "lowest_depth must be below highest_depth, not 4 and 3"),
        ({"hardness": 1e9, "relative_hardness": 0.2}, "hardness or relative_hardness, not both"),
        ({"relative_hardness": 0.0}, "greater than 0"),
        ({"lowest_force": 1e-3}, "there is no 'lowest_force'"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, says):
    with pytest.raises(StudyError, match=says):
        run(**wrong)
