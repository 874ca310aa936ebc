"""The case of rough lines: what it returns, and that it is what the package says of such lines."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.study.cases import find_case
from roughcontact.study.cases.lines_case import CASE, LineParameters
from roughcontact.study.study_errors import StudyError
from study.cases.pure import pure_record


def run(seed=0, **given):
    return CASE.run(
        LineParameters(**{"hurst": 0.8, "points": 256, "lines": 5, "loads": 20} | given),
        np.random.default_rng(seed),
    )


def test_it_comes_with_the_package():
    assert find_case("lines") is CASE


def test_a_record_is_that_of_the_lines_pressed_with_units():
    # In metres and pascals here, without dimension there.
    size, rms, modulus = 3e-3, 2e-6, 5e9
    record = run()
    grid = rc.Grid(256, size / 256, periodic=True)
    spectrum = rc.SelfAffineSpectrum(0.8, dimension=1)
    [heights] = rough_lines(grid, spectrum, np.random.default_rng(0), 5, rms=rms)
    forces = record["dimensionless_force"].to_numpy() * (modulus * rms * size)
    curves = loading_curves(heights, size / 256, modulus, forces=forces)
    assert record["dimensionless_stiffness"].dims == ("line", "load")
    # A force on the border between two springs may fall on either side by its last digit; none does here.
    np.testing.assert_array_equal(record["dimensionless_stiffness"] * 256, curves.springs)


def test_defaults_go_from_one_spring_to_all_of_them_and_meet_the_end_of_the_power_law():
    forces = LineParameters(hurst=1, points=4).forces
    assert np.abs(forces / 0.07 - 1).min() < 1e-12
    for hurst in (-1.0, 0.5, 3.0):
        record = run(hurst=hurst, points=2**10, loads=97)
        stiffness = record["dimensionless_stiffness"]
        assert (stiffness.isel(load=-1) == 1).all()
        assert (stiffness.isel(load=0) * 2**10 < 20).all()
        assert (stiffness.diff("load") >= 0).all()


def test_a_record_is_pure_is_paired_and_survives_as_text():
    one = pure_record(run)
    # Of one seed lines of other exponents have the same phases: of neighbours stiffness hardly differs.
    near = run(seed=3, hurst=0.81)["dimensionless_stiffness"] - one["dimensionless_stiffness"]
    far = run(seed=4)["dimensionless_stiffness"] - one["dimensionless_stiffness"]
    assert abs(near).mean() < 0.2 * abs(far).mean()


def test_more_lines_are_more_of_the_same_ensemble():
    # A thousand lines in one case and in batches: phases come in the same order.
    many = run(lines=40)["dimensionless_stiffness"]
    np.testing.assert_array_equal(many[:5], run()["dimensionless_stiffness"])


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"hurst": 3.5}, "less than or equal to 3"),
        ({"points": 3}, "greater than or equal to 4"),
        ({"lines": 0}, "greater than or equal to 1"),
        ({"lowest_force": 8.0}, "lowest_force must be below highest_force"),
        ({"lowest_force": 0.0}, "greater than 0"),
        ({"loads": 1}, "greater than or equal to 2"),
        ({"rms": 1.0}, "there is no 'rms'"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, says):
    with pytest.raises(StudyError, match=says):
        run(**wrong)
