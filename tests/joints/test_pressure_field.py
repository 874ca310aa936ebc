"""Pressure fields: from arrays, from tables, and of a bolt."""

import math

import numpy as np
import pint
import pytest

import roughcontact as rc

M8 = {"force": 17e3, "head": 13e-3, "hole": 9e-3, "thickness": 10e-3}
WIDTH = 13e-3 + 20e-3 / math.sqrt(3)  # at half an angle of 30 degrees


def test_a_field_holds_its_force_and_area():
    p = np.array([[1e6, 0.0, 2e6], [np.nan, 3e6, 0.0]])
    field = rc.PressureField(p, (2e-3, 1e-3))
    assert field.grid == rc.Grid((2, 3), (2e-3, 1e-3))
    assert field.force == pytest.approx(12.0)
    assert field.face_area == pytest.approx(10e-6)
    assert not field.pressure.flags.writeable
    p[0, 0] = 5e6
    assert field.pressure[0, 0] == 1e6


def test_pressures_and_cells_carry_units():
    units = pint.get_application_registry()
    field = rc.PressureField(np.ones((2, 3)) * units.MPa, 1 * units.mm)
    assert field.force == pytest.approx(6.0)


def test_loads_go_from_the_lowest_pressure_on_at_most_three_decades():
    loads = rc.PressureField(np.array([[1e5, 1e6, 1e7]]), 1e-3).loads
    assert (loads[0], loads[-1], len(loads)) == (pytest.approx(1e5), 1e7, 21)
    np.testing.assert_allclose(np.diff(np.log10(loads)), 0.1)
    assert rc.PressureField(np.array([[1.0, 1e7]]), 1e-3).loads[0] == pytest.approx(1e4)
    even = rc.PressureField(np.full((2, 2), 3e6), 1e-3).loads
    assert (even[0], even[-1], len(even)) == (pytest.approx(3e5), 3e6, 11)


@pytest.mark.parametrize("distribution", ["even", "falling"])
def test_a_bolt_presses_an_annulus_of_the_cone_by_exactly_its_force(distribution):
    field = rc.bolt_pressure(**M8, distribution=distribution)
    assert field.force == pytest.approx(17e3, rel=1e-14)
    assert field.grid.lengths == pytest.approx((WIDTH, WIDTH))
    y, x = (each - WIDTH / 2 for each in field.grid.coordinates)
    radius = np.hypot(y[:, None], x)
    np.testing.assert_array_equal(np.isnan(field.pressure), 2 * radius < 9e-3)
    np.testing.assert_array_equal(field.pressure > 0, (2 * radius >= 9e-3) & (2 * radius < WIDTH))


def test_the_pressure_of_a_bolt_is_that_of_the_closed_form():
    """To the error of the area: of 1.3e4 cells on the rims about the root deviates, each by half: 1e-3 of 3e4 cells."""
    outer, inner = WIDTH / 2, 4.5e-3
    even = np.nanmax(rc.bolt_pressure(**M8).pressure)
    assert even == pytest.approx(17e3 / (math.pi * (outer**2 - inner**2)), rel=2e-3)
    falling = rc.bolt_pressure(**M8, distribution="falling").pressure
    slope = 17e3 / (2 * math.pi * (outer**3 / 6 - outer * inner**2 / 2 + inner**3 / 3))
    assert np.nanmax(falling) == pytest.approx(
        slope * (outer - inner), rel=1e-2
    )  # the first cell is off the rim
    assert falling[falling > 0].min() < 0.01 * np.nanmax(falling)


def test_the_cone_of_a_bolt_has_its_angle_and_lies_in_the_middle_of_a_grid():
    straight = rc.bolt_pressure(**M8, half_angle=0.0, grid=rc.Grid((130, 260), 1e-4))
    p = np.nan_to_num(straight.pressure)
    assert (p > 0).sum() * 1e-8 == pytest.approx(math.pi / 4 * (13e-3**2 - 9e-3**2), rel=1e-2)
    x = straight.grid.coordinates[1]
    assert (p.sum(axis=0) @ x) / p.sum() == pytest.approx(13e-3)


TABLE = "x [mm], y [mm], p [MPa]\n"
POINTS = [(x, y, 10.0 * x + y) for y in (0.0, 2.0, 4.0) for x in (5.0, 6.0, 7.0, 8.0) if (x, y) != (8.0, 4.0)]


def test_a_table_of_points_is_read_with_its_units(tmp_path):
    path = tmp_path / "field.csv"
    path.write_text(TABLE + "".join(f"{x}, {y}, {p}\n" for x, y, p in POINTS))
    with pytest.warns(rc.SurfaceWarning, match="may be cut short"):
        field = rc.read_pressure_field(path)
    expected = 1e6 * np.array([[50, 60, 70, 80], [52, 62, 72, 82], [54, 64, 74, np.nan]])
    np.testing.assert_allclose(field.pressure, expected)
    assert field.grid.spacing == pytest.approx((2e-3, 1e-3))


def test_columns_in_another_order_and_unit(tmp_path):
    path = tmp_path / "field.txt"
    path.write_text(
        "p [kPa]\ty [m]\tx [m]\n" + "".join(f"{p}\t{y}\t{x}\n" for x, y, p in [*POINTS, (8, 4, 84)])
    )
    field = rc.read_pressure_field(path)
    assert field.pressure[1, 2] == pytest.approx(72e3)
    assert field.grid.spacing == pytest.approx((2.0, 1.0))
