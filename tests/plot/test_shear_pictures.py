"""The picture of an interface under shear, by its data: backbones, a cycle, losses, computed cycles and their heat."""

from types import SimpleNamespace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.plot.shear_pictures import shear_figure

BODIES = (rc.Solid(2e9, 0.3), rc.Solid(2e9, 0.3))
PRESSURES = [1e6, 4e6]


def made(scale=1.0, *, periodic=True):
    """Return the law of a surface, and the surface; lengths grow with the scale, pressures do not."""
    grid = rc.Grid((24, 40), (2e-6 * scale, 1e-6 * scale), periodic=periodic)
    heights = rc.self_affine(
        rc.Grid((24, 40), (2e-6, 1e-6), periodic=True), 0.8, 1e-7, 1, rolloff=3e-5, short_cutoff=8e-6
    ).heights
    surface = rc.Surface(scale * heights, grid)
    curve = rc.loading_curve(surface, BODIES, pressures=np.geomspace(1e4, 4e6, 20).tolist())
    return rc.shear_law(curve, BODIES, friction=0.3), surface


def drawn(law, *more, shares=(0.5, 0.8)):
    table = rc.shear_dataset(law, PRESSURES, list(shares))
    figure = shear_figure(law, table, *more)
    figure.canvas.draw()
    return table, figure.axes


@pytest.mark.parametrize(("scale", "unit", "loss_unit"), [(1.0, "nm", "mJ/m²"), (1e3, "µm", "J/m²")])
def test_lines_are_those_of_the_law_in_units_that_suit(scale, unit, loss_unit):
    law, _ = made(scale)
    table, (backbones, losses) = drawn(law)
    assert backbones.get_xlabel() == f"tangential displacement [{unit}]"
    assert backbones.get_ylabel() == "nominal tangential traction [MPa]"
    assert losses.get_xlabel() == f"displacement amplitude [{unit}]"
    assert losses.get_ylabel() == f"loss per cycle [{loss_unit}]"
    of_length, of_loss = {"nm": 1e9, "µm": 1e6}[unit], {"mJ/m²": 1e3, "J/m²": 1.0}[loss_unit]
    assert [line.get_label() for line in backbones.lines] == ["1 MPa", "4 MPa"]
    for line, p in zip(backbones.lines, PRESSURES, strict=True):
        s, tau = line.get_data()
        np.testing.assert_allclose(tau[[0, -1]], [0, 0.3 * p * 1e-6], rtol=1e-12)
        np.testing.assert_allclose(s, law.displacement(tau * 1e6, p) * of_length, rtol=1e-9)
    [area] = backbones.patches
    assert area.get_label() == "cycle to 0.8 mu p"
    cycle = law.cycle(4e6, traction=0.8 * 0.3 * 4e6)
    np.testing.assert_allclose(area.get_xy()[: len(cycle.traction), 1], cycle.traction * 1e-6, rtol=1e-12)
    for line, marks, p in zip(losses.lines[::2], losses.lines[1::2], PRESSURES, strict=True):
        s, loss = line.get_data()
        np.testing.assert_array_equal(line.get_color(), marks.get_color())
        tau = law.traction(s[5] / of_length, p)
        assert loss[5] == pytest.approx(of_loss * law.loss(p, traction=float(tau)), rel=1e-6)
        here = table["nominal_pressure"] == p
        np.testing.assert_array_equal(marks.get_xdata(), table["displacement_amplitude"][here] * of_length)
        np.testing.assert_array_equal(marks.get_ydata(), table["cycle_loss"][here] * of_loss)
    assert losses.get_xscale() == losses.get_yscale() == "log"


def test_a_cycle_without_a_loss_has_no_area_and_many_pressures_are_thinned_out():
    law, _ = made()
    assert not drawn(law, shares=(0.5 * law.smallest_share(4e6),))[1][0].patches
    table = rc.shear_dataset(law, np.geomspace(1e6, 4e6, 30), [0.5])
    backbones, _ = shear_figure(law, table).axes
    labels = [line.get_label() for line in backbones.lines]
    assert (len(labels), labels[0], labels[-1]) == (8, "1 MPa", "4 MPa")


def test_on_a_free_map_lines_end_at_the_lowest_load():
    law, _ = made(periodic=False)
    _, (backbones, losses) = drawn(law)
    for line, p in zip(backbones.lines, PRESSURES, strict=True):
        assert line.get_ydata()[-1] == pytest.approx(0.3 * (p - 1e4) * 1e-6, rel=1e-9)
    ends = [line.get_xdata()[-1] for line in losses.lines[::2]]
    expected = [float(law.displacement(0.3 * (p - 1e4), p)) * 1e9 for p in PRESSURES]
    assert ends == pytest.approx(expected, rel=1e-9)


def test_computed_cycles_are_crosses_and_the_heat_of_the_last_is_a_map():
    law, surface = made()
    pressed = rc.press(surface, BODIES, pressure=4e6)
    heat = np.where(pressed.contact, np.arange(24 * 40).reshape(24, 40), 0.0) * 1e-3
    loops = [
        SimpleNamespace(displacement=np.array([x, 0, -x]), traction=np.array([y, 0, -y]), loss=loss)
        for x, y, loss in ((2e-9, 3e5, 1e-3), (5e-9, 6e5, 4e-3))
    ]
    reversal = SimpleNamespace(problem=SimpleNamespace(pressed=pressed))
    cycles = [SimpleNamespace(loop=loop, heat=heat, reversal=reversal) for loop in loops]
    _, (backbones, losses, heat_axes, *_) = drawn(law, cycles)
    crosses = backbones.lines[-1]
    np.testing.assert_allclose(crosses.get_xdata(), [5, 0, -5])
    np.testing.assert_allclose(crosses.get_ydata(), [0.6, 0, -0.6])
    assert crosses.get_label() == "by partial slip"
    assert [line.get_xdata() for line in losses.lines[-2:]] == pytest.approx([2, 5])
    assert [line.get_ydata() for line in losses.lines[-2:]] == pytest.approx([1, 4])
    image = heat_axes.images[-1].get_array()
    assert image.shape == (24, 40)
    np.testing.assert_array_equal(np.isfinite(np.ma.filled(image, np.nan)), pressed.contact)
    np.testing.assert_allclose(image[pressed.contact], heat[pressed.contact] * 1e3)
    assert heat_axes.get_xlim() == (0, 40)
    assert heat_axes.get_ylim() == (48, 0)
    assert (heat_axes.get_xlabel(), heat_axes.get_ylabel()) == ("x [µm]", "y [µm]")
