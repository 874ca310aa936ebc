"""The case of loading curves: what it returns, and that it is what the package says of such a surface."""

from functools import partial

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases import find_case
from roughcontact.study.cases.curve_case import CASE, CurveParameters
from roughcontact.study.record import residual_of
from roughcontact.study.study_errors import StudyError
from study.cases.pure import pure_record

PLAIN = {"points": 33, "size": 2e-3, "modulus": 1e11, "hurst": 0.7, "rms": 1e-6, "loads": 6}


def run(seed=0, **given):
    return CASE.run(CurveParameters(**(PLAIN | given)), np.random.default_rng(seed))


def roughness(seed=0, hurst=0.7, **given):
    grid = rc.Grid((33, 33), 2e-3 / 33, given.pop("periodic", False))
    return rc.self_affine(grid, hurst, 1e-6, np.random.default_rng(seed), **given)


def test_it_comes_with_the_package():
    assert find_case("curve") is CASE


@pytest.mark.parametrize("periodic", [False, True])
def test_a_record_is_the_loading_curve_of_the_surface(periodic):
    record = run(periodic=periodic)
    surface = roughness(periodic=periodic)
    forces = np.geomspace(1e-4, 0.07, 6) * (1e11 * 2e-3 * 1e-6)
    curve = rc.loading_curve(surface, 1e11, forces=forces).to_dataset()
    assert set(record["force"].dims) == {"load"}
    for name in set(record.data_vars) - {
        "full_contact_stiffness",
        "dimensionless_force",
        "rms",
        "rms_slope",
        "rms_curvature",
    }:
        np.testing.assert_array_equal(record[name], curve[name], err_msg=name)
        assert record[name].attrs == curve[name].attrs
    # Found on a square of another size: equal but for rounding.
    np.testing.assert_allclose(record["full_contact_stiffness"], curve["full_contact_stiffness"], rtol=1e-12)
    np.testing.assert_allclose(record["dimensionless_force"], curve["dimensionless_force"], rtol=1e-12)
    moments = rc.surface_moments(surface, derivative="spectral")
    assert float(record["rms_slope"]) == moments.rms_slope
    assert float(record["rms_curvature"]) == moments.rms_curvature
    assert residual_of(record) < 1e-8


def test_quantities_may_have_units():
    assert run(size="2 mm", modulus="100 GPa", rms="1 um").identical(run())


def test_a_record_is_pure_is_paired_and_survives_as_text():
    one = pure_record(run)
    # Of one seed surfaces of other exponents have the same phases: of neighbours stiffness hardly differs.
    at = {"load": -1}
    near = run(seed=3, hurst=0.705)["stiffness"][at] / one["stiffness"][at] - 1
    far = run(seed=4)["stiffness"][at] / one["stiffness"][at] - 1
    assert abs(near) < 0.2 * abs(far)


def test_limits_of_the_spectrum_are_parts_of_the_side():
    given = {"rolloff": 1e-3, "long_cutoff": 1.5e-3, "short_cutoff": 2e-4}
    record = run(rolloff=0.5, long_cutoff=0.75, short_cutoff=0.1, amplitudes="gaussian")
    surface = roughness(amplitudes="gaussian", **given)
    curve = rc.loading_curve(surface, 1e11, forces=record["force"].to_numpy())
    np.testing.assert_array_equal(record["stiffness"], curve.stiffness)
    # The forces are those of the process; the sample has its own rms height.
    np.testing.assert_array_equal(record["dimensionless_force"], np.geomspace(1e-4, 0.07, 6))
    assert float(record["rms"]) == surface.rms != 1e-6


def test_a_paraboloid_may_lie_under_the_roughness():
    record = run(radius=0.5, highest_force=10.0)
    surface = rc.shapes.paraboloid(rc.Grid((33, 33), 2e-3 / 33), 0.5) + roughness()
    curve = rc.loading_curve(surface, 1e11, forces=record["force"].to_numpy())
    np.testing.assert_array_equal(record["stiffness"], curve.stiffness)
    assert float(record["rms"]) == pytest.approx(1e-6, rel=1e-12)  # of the roughness
    assert float(record["dimensionless_force"][-1]) == pytest.approx(10.0, rel=1e-12)
    assert float(record["rms_slope"]) == float(run()["rms_slope"])


def test_a_hardness_is_a_pressure_or_a_part_of_the_slope():
    part = run(relative_hardness=0.2)
    hardness = 0.2 * 1e11 * rc.surface_moments(roughness(), derivative="spectral").rms_slope
    assert float(part["hardness"]) == hardness
    assert part.identical(run(hardness=hardness))
    assert float(part["contact_area"][-1]) > float(run()["contact_area"][-1])
    assert "hardness" not in run()
    with pytest.raises(StudyError, match="hardness or relative_hardness, not both"):
        run(hardness=1e9, relative_hardness=0.2)


def test_a_load_that_misses_its_tolerance_keeps_its_mark(monkeypatch):
    hasty = partial(rc.loading_path, solver=rc.PolonskyKeer(max_steps=1))
    monkeypatch.setattr("roughcontact.study.cases.curve_case.loading_path", hasty)
    record = run(lowest_force=1.0, highest_force=5.0, loads=2)
    assert (record["status"] == "step limit").all()
    assert not record["resolved"].any()
    assert np.isfinite(record["stiffness"]).all()


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"points": 3}, "greater than or equal to 4"),
        ({"size": 0.0}, "greater than 0"),
        ({"hurst": 3.5}, "less than or equal to 3"),
        ({"rms": "1 GPa"}, "length"),
        ({"amplitudes": "random"}, "'exact' or 'gaussian'"),
        ({"radius": -1.0}, "greater than 0"),
        ({"lowest_force": 1.0}, "lowest_force must be below highest_force"),
        ({"tolerance": 1.0}, "less than 0.01"),
        ({"colour": 1}, "there is no 'colour'"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, says):
    with pytest.raises(StudyError, match=says):
        run(**wrong)


def test_limits_that_leave_no_wave_are_refused():
    with pytest.raises(ValueError, match="no wave is left"):
        run(long_cutoff=0.1, short_cutoff=0.5)


def test_more_points_refine_the_surface_of_a_band():
    """Points of three times as many cells in the middle of the large ones: no wave is below two and a half of those."""
    given = PLAIN | {"rms_band": [1.0, 0.1], "short_cutoff": 0.08}
    coarse, fine = (
        CurveParameters(**(given | {"points": points})).roughness(np.random.default_rng(0))
        for points in (33, 99)
    )
    np.testing.assert_allclose(coarse.heights, fine.heights[1::3, 1::3], rtol=0, atol=1e-12 * coarse.rms)
    grid = rc.Grid((33, 33), 2e-3 / 33)
    direct = rc.self_affine(
        grid, 0.7, 1e-6, np.random.default_rng(0), rms_band=(2e-3, 2e-4), short_cutoff=1.6e-4
    )
    np.testing.assert_array_equal(coarse.heights, direct.heights)
    assert coarse.rms > 1e-6


@pytest.mark.parametrize("band", [[1.0, 2 / 33], [0.1, 1.0], [1.0], [1.0, -0.5]])
def test_a_band_beyond_the_grid_is_refused(band):
    with pytest.raises(StudyError, match="rms_band"):
        CurveParameters(**(PLAIN | {"rms_band": band}))
