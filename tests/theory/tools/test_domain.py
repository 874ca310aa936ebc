"""Numbers at the border: what is taken, and what is said of the rest."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory import hertz, mindlin, persson, pohrt_popov, punch, rough_sphere
from roughcontact.theory.tools.domain import count, number, pair, positive, require, scalar

SOLID = rc.Solid(2e11, 0.3)


def test_numbers_and_arrays_are_kept():
    assert number(3, "x") == 3.0
    assert number([1, 2], "x").dtype == np.float64
    assert np.shape(positive(np.array([[1.0]]), "x")) == (1, 1)
    assert scalar(np.float32(0.5), "x") == 0.5
    assert count("springs", np.int64(3)) == 3
    assert pair([1, (2, 3)], "x")[1].tolist() == [2, 3]


@pytest.mark.parametrize("value", ["110GPa", "1e9", None, 1j, [1, "a"], {}, np.array(["1"]), [[1], [1, 2]]])
def test_what_is_no_number(value):
    with pytest.raises(
        ValueError, match=r"force \[N\] must be a number or an array of numbers in SI units, not "
    ):
        positive(value, "force [N]")


@pytest.mark.parametrize("value", [SOLID, (SOLID, SOLID)])
def test_a_material_is_no_modulus(value):
    for use in (
        lambda: hertz.point(value, radius=1.0, force=1.0),
        lambda: pohrt_popov.law(0.7, 1e-6, 1e-3, value),
        lambda: rough_sphere.law(0.1, 0.7, 1e-6, 1e-3, value),
        lambda: persson.contact_fraction(1e6, value, rc.Moments(1e-12, 0.01, 1e9)),
    ):
        with pytest.raises(ValueError, match=r"modulus.*rc.reduced_modulus\(...\)"):
            use()


@pytest.mark.parametrize("value", [0, 2.5, True, "2", None])
def test_what_is_no_count(value):
    with pytest.raises(ValueError, match="springs must be a whole number, at least 1"):
        count("springs", value)


@pytest.mark.parametrize("value", [0.01, (1, 2, 3), ([1, 2], [1, 2, 3]), (1, -1), "ab"])
def test_what_is_no_pair(value):
    with pytest.raises(ValueError, match=r"x \[m\] must be"):
        pair(value, "x [m]")
    with pytest.raises(ValueError, match=r"radii \[m\] must be"):
        hertz.elliptic(1e9, radii=value, force=1.0)
    with pytest.raises(ValueError, match=r"semi_axes \[m\] must be"):
        punch.ellipse(1e9, value)


def test_a_message_has_the_first_value_that_is_wrong():
    with pytest.raises(ValueError, match=r"too much \(given: 7\)$"):
        require(np.array([True, False, False]), "too much", [1, 7, 9])
    with pytest.raises(ValueError, match=r"not exceed 3: .*\(given: 3.5\)"):
        pohrt_popov.exponent([1.0, 3.5])
    with pytest.raises(ValueError, match=r"exceed 0: .*\(given: nan\)"):
        pohrt_popov.exponent(math.nan)


def test_what_is_long_is_named_by_its_kind():
    with pytest.raises(ValueError, match=r"not a Surface; of a surface take") as caught:
        persson.contact_fraction(1e6, 1e11, rc.Surface(np.zeros((30, 30)), rc.Grid((30, 30), 1.0)))
    assert "\n" not in str(caught.value)


def test_shapes_that_do_not_fit():
    with pytest.raises(ValueError, match=r"radius \(2,\), force \(3,\)"):
        hertz.point(1e9, radius=[1, 2], force=[1, 2, 3])


@pytest.mark.parametrize("value", ["a", SOLID, [0.3, 0.4]])
def test_poissons_ratio_is_one_number(value):
    with pytest.raises(ValueError, match="Poisson's ratio must be"):
        mindlin.ratio(value)


def test_a_pair_of_solids():
    with pytest.raises(ValueError, match=r"shear_modulus and poisson_ratio is wanted, not 5\.0"):
        mindlin.pair_ratio(SOLID, 5.0)
