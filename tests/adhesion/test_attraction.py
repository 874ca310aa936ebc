"""The law of adhesion and its border."""

import math
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.attraction import LAWS, Law
from roughcontact.adhesion.exponential_law import ExponentialLaw
from sticking import rough, sticky


def test_the_attraction_is_the_slope_of_its_energy_and_does_the_work_of_adhesion():
    law, gap, step = ExponentialLaw(0.05, 2e-9), np.linspace(0, 2e-8, 2001), 1e-13
    slope = (law.energy(gap + step) - law.energy(gap - step)) / (2 * step)
    # Third derivative of the energy times step^2/6, and rounding of the difference.
    np.testing.assert_allclose(slope, law.traction(gap), atol=law.traction(gap)[0] * (1e-9 + 1e-16 * 2e4))
    assert law.energy(np.zeros(1))[0] == -0.05
    np.testing.assert_allclose(law.curvature(gap) * law.range, law.traction(gap), rtol=1e-15)


def test_small_changes_of_the_energy_keep_their_digits():
    law, gap = ExponentialLaw(0.05, 2e-9), np.array([0.0, 1e-9])
    step = 1e-25
    # exp(-step/range) differs from one by less than its rounding.
    np.testing.assert_allclose(
        law.energy_change(gap, np.full(2, step)), -law.traction(gap) * -step, rtol=1e-14
    )
    assert law.energy_change(np.array([np.inf]), np.array([1.0]))[0] == 0
    assert law.energy_change(np.array([1.0]), np.array([-1.0]))[0] == -0.05  # from afar to the wall


def test_numbers_of_the_law():
    adhesion = rc.Adhesion(0.05, 2e-9)
    assert adhesion.strength == 0.05 / 2e-9
    assert math.isclose(adhesion.process_zone(1e9), 1e9 * 0.05 / (math.pi * (0.05 / 2e-9) ** 2))
    assert math.isclose(adhesion.tabor(1e-6, 1e9) ** 3, 1e-6 * 0.05**2 / (1e18 * 8e-27))


def test_a_law_of_the_table_is_known_by_its_name_and_computed_with(monkeypatch):
    class Half(ExponentialLaw):
        @classmethod
        def on_cells(cls, work, length, strength, form, separation, modulus):
            return cls(work / 2, length)

    assert get_args(Law) == tuple(LAWS)
    surface, given = rough(16, periodic=False, slope=0.1, seed=1), sticky(3.0)
    with pytest.raises(ValueError, match="not 'half'"):
        replace(given, law="half")
    monkeypatch.setitem(LAWS, "half", Half)
    half, whole = (
        rc.adhesive_state(surface, 1.0, law, depth=-0.2) for law in (replace(given, law="half"), given)
    )
    weak = rc.adhesive_state(surface, 1.0, replace(given, work=given.work / 2), depth=-0.2)
    np.testing.assert_array_equal(half.pressure, weak.pressure)
    assert np.abs(half.pressure - whole.pressure).max() > 0.1 * np.abs(whole.pressure).max()


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ((-1.0, 1e-9), "work of adhesion"),
        ((math.nan, 1e-9), "work of adhesion"),
        ((0.0, 1e-9), "zero everywhere"),
        ((0.05, 0.0), "range of the attraction"),
        ((0.05, "2nm"), "range must be one number"),
        ((0.05, 2e-9, "jkr"), "one of 'exponential', 'dugdale', not 'jkr'"),
        ((0.05, 2e-9, ["jkr"]), "one of 'exponential', 'dugdale', not"),
    ],
)
def test_what_is_no_law_is_refused(given, told):
    with pytest.raises(ValueError, match=told):
        rc.Adhesion(*given)
