"""Curves in the units of their labels: on cells and a map that are not square, each axis with its own."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.labels.engineering_units import Scale
from roughcontact.plot.canvas import areal_figure, curve_figure
from roughcontact.plot.curves import areal_curve, force_curve
from roughcontact.theory.law import LoadingLaw

MODULUS = 1e11


@pytest.fixture
def axes() -> Axes:
    return Figure().subplots()


def line(axes: Axes, label: str):
    (found,) = [each for each in axes.lines if each.get_label() == label]
    return found


OBLONG = rc.Grid((24, 40), (2e-7, 1.5e-7), periodic=True)  # sides of 4.8 and 6 um
AREA = 4.8e-6 * 6e-6
# Of a quantity of the patch: the unit of its label, and that unit over the one of SI.
OF_FORCE = {
    "stiffness": ("stiffness [MN/m]", 1e-6),
    "contact_area": ("contact area [µm²]", 1e12),
    "depth": ("depth [nm]", 1e9),
}
OF_PRESSURE = {
    "interfacial_stiffness_per_area": ("interfacial stiffness per area K/A0 [N/µm/mm²]", 1e-12),
    "contact_fraction": ("relative real contact area A/A0", 1.0),
    "mean_gap": ("mean gap [nm]", 1e9),
}


@pytest.fixture(scope="module")
def oblong() -> rc.Curve:
    surface = rc.self_affine(OBLONG, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    return rc.loading_curve(surface, MODULUS, forces=np.geomspace(2e-4, 8e-2, 9))


def straight(curve: rc.Curve) -> LoadingLaw:
    """Return a theory that goes through the last point of each quantity, in proportion to the force."""
    slopes = {
        name: float(getattr(curve, name)[-1] / curve.force[-1])
        for name in (*OF_FORCE, "interfacial_stiffness", "mean_gap")
    }
    return LoadingLaw("straight", "", {name: lambda f, c=c: c * f for name, c in slopes.items()})


@pytest.mark.parametrize("name", [*OF_FORCE, *OF_PRESSURE])
def test_points_and_theories_have_the_units_of_the_labels(axes, oblong, name):
    theory, force = straight(oblong), oblong.force
    if name in OF_FORCE:
        (label, factor), x, words = OF_FORCE[name], 1e3, "force [mN]"
        force_curve(oblong, axes, quantity=name, theories=[theory])
    else:
        (label, factor), x, words = OF_PRESSURE[name], 1e-9 / AREA, "nominal pressure [GPa]"
        areal_curve(oblong, axes, quantity=name, theories=[theory])
    assert (axes.get_xlabel(), axes.get_ylabel()) == (words, label)
    values = np.asarray(getattr(oblong, name))
    assert 0 < oblong.resolved.sum() < len(oblong)
    for points, mask in (("resolved", oblong.resolved), ("not resolved", ~oblong.resolved)):
        drawn = line(axes, points).get_xydata()
        np.testing.assert_allclose(drawn, np.stack([force * x, values * factor], 1)[mask], rtol=1e-12)
    between = np.geomspace(force[0], force[-1], 200)
    expected = np.stack([between * x, values[-1] * factor * between / force[-1]], 1)
    np.testing.assert_allclose(line(axes, "straight").get_xydata(), expected, rtol=1e-11)


def test_the_axis_of_the_relative_area_counts_nominal_areas(axes, oblong):
    force_curve(oblong, axes, quantity="contact_area")
    axes.figure.draw_without_rendering()
    (right,) = axes.child_axes
    assert np.multiply(right.get_ylim(), AREA * 1e12) == pytest.approx(axes.get_ylim(), rel=1e-12)  # um^2


def test_the_level_of_twenty_cells_is_drawn_per_area(axes, oblong):
    areal_curve(oblong, axes)
    [drawn] = [each.get_ydata()[0] for each in axes.lines if list(each.get_xdata()) == [0, 1]]
    assert drawn == pytest.approx(20 * oblong.cell_stiffness / AREA * 1e-12, rel=1e-12)
    low, high = axes.get_ylim()
    assert low < drawn < high


def test_each_panel_of_a_figure_shows_its_quantity_with_law_and_theories(oblong):
    law, theories = oblong.fit((float(oblong.force[2]), float(oblong.force[-1]))), [straight(oblong)]
    for figure, quantities in (
        (curve_figure(oblong, law, theories), OF_FORCE),
        (areal_figure(oblong, law, theories), OF_PRESSURE),
    ):
        for axes, (name, (label, factor)) in zip(figure.axes, quantities.items(), strict=True):
            assert axes.get_ylabel() == label
            points = line(axes, "resolved").get_ydata()
            np.testing.assert_allclose(points, getattr(oblong, name)[oblong.resolved] * factor, rtol=1e-12)
            assert line(axes, "straight")
            assert sum(each.get_linewidth() == 2 for each in axes.lines) == (axes is figure.axes[0])


def test_the_units_of_a_figure_are_those_of_each_panel(oblong):
    chosen = {"nominal_pressure": Scale(1e-5, "bar"), "mean_gap": Scale(1e10, "Å")}
    chosen["interfacial_stiffness_per_area"] = Scale(1e-12, "N/um/mm^2")  # as it is typed
    figure = areal_figure(oblong, units=chosen)
    label, _ = OF_PRESSURE["interfacial_stiffness_per_area"]  # as it is printed without a named unit
    assert label in [axes.get_ylabel() for axes in figure.axes]
    assert [axes.get_xlabel() for axes in figure.axes] == ["nominal pressure [bar]"] * 3
    assert figure.axes[2].get_ylabel() == "mean gap [Å]"


@pytest.mark.parametrize("of", ["interface", "total"])
def test_resistances_are_drawn_per_area_or_of_the_patch(oblong, of):
    """Against pressure in GPa or force in mN; infinite ones have no place, and colours tell the two apart."""
    given = {"resistivities": (1.7e-8, 2.7e-8), "conductivities": (400.0, 240.0)}
    dataset = rc.conductance(oblong.to_dataset(), of=of, **given)
    figure = rc.plot.resistance_figure(dataset)
    electric, thermal = figure.axes
    if of == "interface":
        x, words, tail, load = oblong.force / AREA * 1e-9, "nominal pressure [GPa]", "_per_area", ""
    else:
        x, words, tail, load = oblong.force * 1e3, "force [mN]", "", ", spreading resistance included"
    assert [axes.get_xlabel() for axes in figure.axes] == [words, words]
    units = []
    for axes, name in ((electric, f"electrical_resistance{tail}"), (thermal, f"thermal_resistance{tail}")):
        text, unit = axes.get_ylabel().rstrip("]").split(" [")
        assert text == name.replace("_", " ") + load
        units.append(unit)
        factor = {"mm²·ohm": 1e6, "µm²·ohm": 1e12, "mm²·K/W": 1e6, "mohm": 1e3, "kK/W": 1e-3}[unit]
        for points, mask in (("resolved", oblong.resolved), ("not resolved", ~oblong.resolved)):
            expected = np.stack([x, dataset[name].to_numpy() * factor], 1)[mask]
            np.testing.assert_allclose(line(axes, points).get_xydata(), expected, rtol=1e-12)
            assert (line(axes, points).get_markerfacecolor() == "white") is (points == "not resolved")
    assert units[0] != units[1]
    assert line(electric, "resolved").get_color() != line(thermal, "resolved").get_color()


def test_a_resistance_keeps_the_unit_of_its_dataset(axes, oblong):
    dataset = rc.conductance(oblong.to_dataset(), conductivities=(400.0, 240.0))
    name = "thermal_resistance_per_area"
    for each, factor, unit in (("nominal_pressure", 1e-5, "bar"), (name, 3.0, "thirds")):
        dataset[each] = (dataset[each] * factor).assign_attrs(units=unit)
    rc.plot.resistance_curve(dataset, name, axes)
    assert (axes.get_xlabel(), axes.get_ylabel()) == (
        "nominal pressure [bar]",
        "thermal resistance per area [thirds]",
    )
    expected = np.stack([dataset["nominal_pressure"], dataset[name]], 1)[oblong.resolved]
    np.testing.assert_allclose(line(axes, "resolved").get_xydata(), expected, rtol=1e-14)
