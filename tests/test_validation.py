"""Numbers at the border: what is taken, and what is said of the rest."""

from __future__ import annotations

import inspect
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pytest

import roughcontact as rc
from roughcontact.theory.joints import mindlin
from roughcontact.theory.persson_theory import persson
from roughcontact.theory.spheres_and_punches import hertz, punch, rough_sphere
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact.validation import (
    Array,
    exactly_one,
    number,
    numeric,
    pair,
    positive,
    require,
    require_numbers,
    scalar,
    whole,
)

SOLID = rc.Solid(2e11, 0.3)


def test_numbers_and_arrays_are_kept():
    assert number(3, "x") == 3.0
    assert number([1, 2], "x").dtype == np.float64
    assert np.shape(positive(np.array([[1.0]]), "x")) == (1, 1)
    assert scalar(np.float32(0.5), "x") == 0.5
    assert whole(np.int64(3), "springs") == 3
    assert pair([1, (2, 3)], "x")[1].tolist() == [2, 3]


@pytest.mark.parametrize("value", ["110GPa", "1e9", None, 1j, [1, "a"], {}, np.array(["1"]), [[1], [1, 2]]])
def test_what_is_not_numbers(value):
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
        with pytest.raises(ValueError, match=r"modulus.*rc\.reduced_modulus\('steel', 'aluminium'\)"):
            use()


@pytest.mark.parametrize("value", [0, 2.5, True, "2", None])
def test_what_is_not_a_whole_number(value):
    with pytest.raises(ValueError, match="springs must be a whole number, at least 1"):
        whole(value, "springs")


@pytest.mark.parametrize("value", [0.01, (1, 2, 3), ([1, 2], [1, 2, 3]), (1, -1), "ab"])
def test_what_is_not_a_pair(value):
    with pytest.raises(ValueError, match=r"x \[m\] must be"):
        pair(value, "x [m]")
    with pytest.raises(ValueError, match=r"radii \[m\] must be"):
        hertz.elliptic(1e9, radii=value, force=1.0)
    with pytest.raises(ValueError, match=r"semi_axes \[m\] must be"):
        punch.ellipse(1e9, value)


def test_exactly_one_is_given():
    assert exactly_one(force=None, depth=0.0, pressure=None) == ("depth", 0.0)
    with pytest.raises(ValueError, match="exactly one of force, depth and pressure: none is given"):
        exactly_one(force=None, depth=None, pressure=None)
    with pytest.raises(ValueError, match="exactly one of forces and depths, not forces and depths"):
        exactly_one(forces=[1.0], depths=[1.0])


def test_a_message_has_the_first_value_that_is_wrong():
    with pytest.raises(ValueError, match=r"too much \(given: 7\)$"):
        require(np.array([True, False, False]), "too much", value=[1, 7, 9])
    with pytest.raises(ValueError, match=r"not exceed 3: .*\(given: 3.5\)"):
        pohrt_popov.exponent([1.0, 3.5])
    with pytest.raises(ValueError, match=r"exceed 0: .*\(given: nan\)"):
        pohrt_popov.exponent(math.nan)


def test_what_is_long_is_named_by_its_kind():
    with pytest.raises(ValueError, match=r"not a Surface; for a surface use") as caught:
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
    with pytest.raises(ValueError, match=r"shear_modulus and poisson_ratio is needed, not 5\.0"):
        mindlin.pair_ratio(SOLID, 5.0)


@numeric
def checked(
    force: npt.ArrayLike, depth: float | Array, hurst: float, *, length: float | None = None, name: str = ""
) -> tuple[object, ...]:
    """Return what is given."""
    return force, depth, hurst, length, name


def test_values_pass_as_they_are():
    force = [1.0, 2.0]
    assert checked(force, 3, True, name="x") == (force, 3, True, None, "x")
    assert checked(force, 3, True, name="x")[0] is force
    checked(np.ones((2, 1)), np.ones(3), np.float64(0.8), length=2)
    checked(np.inf, -1.0, 0.0)  # ranges are the function's own


def test_the_function_stays_itself():
    assert checked.__name__ == "checked"
    assert checked.__doc__ == "Return what is given."
    assert list(inspect.signature(checked).parameters) == ["force", "depth", "hurst", "length", "name"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"force": "x"}, "force must be a number or an array of numbers in SI units, not 'x'"),
        ({"depth": None}, "depth must be a number or an array of numbers in SI units, not None"),
        ({"depth": [1.0, np.nan]}, "depth must be a number, not nan"),
        ({"hurst": [0.8]}, r"hurst must be one number in SI units, not an array of shape \(1,\)"),
        ({"length": "x"}, "length must be one number in SI units, not 'x'"),
        (
            {"force": np.ones(2), "depth": np.ones(3)},
            r"do not fit: force \(2,\), depth \(3,\); give numbers or arrays of one shape$",
        ),
    ],
    ids=str,
)
def test_what_is_wrong_is_named(given, message):
    with pytest.raises(ValueError, match=message):
        checked(**{"force": 1.0, "depth": 1.0, "hurst": 0.8} | given)


def test_missing_and_unknown_arguments_are_those_of_python():
    with pytest.raises(TypeError, match="missing"):
        checked(1.0, 2.0)
    with pytest.raises(TypeError, match="unexpected"):
        checked(1.0, 2.0, 3.0, other=1.0)
    with pytest.raises(TypeError, match="positional"):
        checked(1.0, 2.0, 3.0, 4.0)


def test_fields_of_a_body():
    @dataclass
    class Body:
        radius: float
        reference: float | None
        name: str

    require_numbers(Body(1.0, None, "x"))
    with pytest.raises(ValueError, match="radius must be one number"):
        require_numbers(Body(np.ones(2), None, "x"))
    with pytest.raises(ValueError, match="reference must be a number, not nan"):
        require_numbers(Body(1.0, np.nan, "x"))


@pytest.mark.parametrize(
    ("function", "kind"),
    [
        (rc.surface_moments, "Surface"),
        (rc.plot.height_map, "Surface"),
        (rc.plot.pressure_map, "Solution"),
        (rc.interface_table, "Curve"),
        (rc.plot.depth_loop, "Loop"),
        (rc.plot.loop_figure, "Loop"),
    ],
)
def test_what_is_no_surface_solution_or_curve_is_told_how_one_is_made(function, kind):
    with pytest.raises(ValueError, match=f"must be a {kind}, as rc\\..*, not 'part.x3p'"):
        function("part.x3p")


@pytest.mark.parametrize("draw", [rc.plot.bearing_curves, rc.plot.flattened_figure])
def test_what_has_not_flowed_is_not_drawn(draw):
    ball = rc.shapes.paraboloid(rc.Grid((9, 9), 1e-6), 1e-4)
    with pytest.raises(ValueError, match=r"must be a Surface, .* or a RadialProfile, not .part\.x3p."):
        draw("part.x3p", rc.press(ball, 1e11, force=0.02, hardness=2e9).flow)
    with pytest.raises(ValueError, match=r"flow must be a Flow, as solution\.flow holds it, not None"):
        draw(ball, None)
