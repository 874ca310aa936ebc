"""Numbers per area: those of a state and of a curve have the same names, units and values."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.labels.labelled import units_of

NAMES = (
    *("nominal_pressure", "contact_fraction", "max_pressure", "mean_pressure"),
    "interfacial_stiffness_per_area",
)
LINE, RINGS = rc.Grid(64, 1e-6), rc.RadialGrid.uniform(64, 64e-6)


def rough(periodic):
    surface = rc.self_affine(
        rc.Grid((24, 32), (2e-6, 1e-6), periodic), hurst=0.8, rms=1e-7, rng=np.random.default_rng(0)
    )
    heights = surface.heights.copy()
    heights[3:5, 7:9] = np.nan
    return rc.Surface(heights, surface.grid)


def profile():
    return rc.Surface(-((np.arange(64) - 31.5) ** 2) * 1e-9, LINE)


BODIES = {
    "free": (rough(False), None, 48e-6 * 32e-6),
    "periodic": (rough(True), None, 48e-6 * 32e-6),
    "rings": (rc.RadialProfile(-(RINGS.radii**2) / 2e-3, RINGS), None, math.pi * 64e-6**2),
    "line": (profile(), rc.line(LINE, 1e11), 64e-6),
    "springs": (profile(), rc.foundation(LINE, 1e11), 64e-6),
}


@pytest.mark.parametrize("body", BODIES)
def test_a_state_has_the_numbers_of_a_curve(body):
    """A0 holds missing cells; on lines and springs it is their length."""
    surface, operator, area = BODIES[body]
    state = rc.press(surface, 1e11, force=0.05, operator=operator, tolerance=1e-10)
    curve = rc.loading_curve(surface, 1e11, forces=[0.05], operator=operator, tolerance=1e-10)
    assert state.nominal_area == pytest.approx(area, rel=1e-12)
    assert state.nominal_pressure == pytest.approx(state.force / area, rel=1e-12)
    assert state.contact_fraction == pytest.approx(state.contact_area / area, rel=1e-12)
    assert state.interfacial_stiffness_per_area == pytest.approx(
        state.interfacial_stiffness / area, rel=1e-12
    )
    assert state.max_pressure == state.pressure.max()
    assert state.mean_pressure == pytest.approx(state.pressure[state.contact].mean(), rel=0.5)
    assert state.mean_pressure * state.contact_area == pytest.approx(state.force, rel=1e-12)
    record, points, dataset = state.to_record(), curve.to_record(), state.to_dataset()
    for name in NAMES:
        [point] = getattr(curve, name)
        assert getattr(state, name) == pytest.approx(point, rel=1e-7), name
        assert record[name] == getattr(state, name) == float(dataset[name])
        assert points[name] == [point]
        assert record["units"].get(name) == points["units"].get(name) == dataset[name].attrs["units"]
    per_length = units_of(dict.fromkeys(NAMES), state.problem.geometry)
    assert per_length["interfacial_stiffness_per_area"] == ("N m-2" if body == "springs" else "Pa m-1")
    assert per_length["mean_pressure"] == ("N m-1" if body == "springs" else "Pa")


def test_the_pressures_of_hertz():
    """The largest is 3/2 of the mean: F/(pi a^2), with a^3 = 3 F R/(4 E*)."""
    surface = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    solution = rc.press(surface, 1e9, force=0.05)
    mean = 0.05 / (math.pi * (0.75 * 0.05 * 1e-4 / 1e9) ** (2 / 3))
    # The border cuts cells: the area is good to half a cell of the radius, 15 cells.
    assert solution.mean_pressure == pytest.approx(mean, rel=0.07)
    assert solution.max_pressure == pytest.approx(1.5 * mean, rel=0.02)


def test_without_contact_the_mean_pressure_is_missing():
    surface = rc.shapes.paraboloid(rc.Grid((16, 16), 1e-6), radius=1e-4)
    apart = rc.press(surface, 1e9, depth=0.0)
    assert (apart.contact_area, apart.max_pressure) == (0.0, 0.0)
    assert math.isnan(apart.mean_pressure)
    assert apart.to_record()["mean_pressure"] is None
    curve = rc.loading_curve(surface, 1e9, depths=[0.0, 1e-8])
    assert np.isnan(curve.mean_pressure).tolist() == [True, False]


def test_surfaces_that_stick_have_no_mean_pressure_in_contact():
    """Part of their force is outside contact, and no stiffness of theirs is against the mean gap."""
    surface = rc.shapes.paraboloid(rc.Grid((24, 24), 1e-6), radius=1e-4)
    adhesion = rc.Adhesion(work=0.5, range=2e-7)
    state = rc.adhesive_state(surface, 1e9, adhesion, depth=2e-8)
    curve = rc.adhesive_curve(surface, 1e9, adhesion, depths=[2e-8])
    assert state.nominal_area == curve.nominal_area == pytest.approx(24e-6**2, rel=1e-12)
    assert state.nominal_pressure == pytest.approx(state.force / 24e-6**2, rel=1e-12)
    assert curve.nominal_pressure[0] == pytest.approx(state.nominal_pressure, rel=1e-6)
    assert (state.max_pressure, state.max_tension) == (state.pressure.max(), -state.pressure.min())
    for record in (state.to_record(), curve.to_record()):
        assert record["units"]["nominal_pressure"] == "Pa"
        assert not {"mean_pressure", "interfacial_stiffness_per_area"} & record.keys()
