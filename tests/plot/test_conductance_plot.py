"""The conductance by parts in the units of its labels, on a map that is not square."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.labels.engineering_units import Scale

GRID = rc.Grid((24, 40), (4e-6, 3e-6), periodic=True)
SURFACE = rc.self_affine(GRID, hurst=0.8, rms=1e-6, rng=1, rolloff=60e-6, short_cutoff=24e-6)
AIR = rc.Gas("air", pressure=1e5, accommodation=(0.9, 0.9))


def curve_of(**given):
    parts = rc.ConductanceParts(conductivities=(50.0, 160.0), **given)
    return rc.loading_curve(SURFACE, 1e10, pressures=[1e7, 1e8, 2e8], measures=[parts])


@pytest.mark.parametrize(
    ("units", "labels", "factors"),
    [
        (
            None,
            ("nominal pressure [MPa]", "thermal conductance per area [MW/m²/K]"),
            (1e-6, 1e-6),
        ),
        (
            {"nominal_pressure": Scale(1e-5, "bar"), "joint_conductance_per_area": Scale(1e-4, "W/cm^2/K")},
            ("nominal pressure [bar]", "thermal conductance per area [W/cm²/K]"),
            (1e-5, 1e-4),
        ),
    ],
)
def test_lines_hold_the_parts(units, labels, factors):
    curve, axes = curve_of(gas=AIR, emissivities=(0.2, 0.2)), Figure().subplots()
    assert curve.resolved.tolist() == [False, True, True]
    assert rc.plot.conductance_curve(curve, axes, units=units) is axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == labels
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    named = axes.get_legend_handles_labels()[1]
    assert named == ["spots", "gas", "joint"]  # without radiation, a millionth of the joint
    for whole, filled, name in zip(axes.lines[::2], axes.lines[1::2], named, strict=True):
        values = curve.measured[f"{name}_conductance_per_area"]
        np.testing.assert_allclose(whole.get_xdata(), curve.nominal_pressure * factors[0], rtol=1e-14)
        np.testing.assert_allclose(whole.get_ydata(), values * factors[1], rtol=1e-14)
        np.testing.assert_allclose(filled.get_ydata(), values[1:] * factors[1], rtol=1e-14)


def test_parts_that_are_zero_are_left_out():
    axes = rc.plot.conductance_curve(curve_of(), Figure().subplots())
    assert axes.get_legend_handles_labels()[1] == ["spots", "joint"]


def test_parts_that_do_not_count_are_left_out():
    """Radiation of 6 W/(m^2 K) counts beside a joint of 5 kW/(m^2 K), not beside one of 10."""
    pressures = np.array([1e7, 2e7])
    columns = {"spots": 0.0, "gas": 0.0, "radiation": 6.0}
    for joint, drawn in ((5e3, ["radiation", "joint"]), (1e4, ["joint"])):
        measured = {
            f"{name}_conductance_per_area": np.full(2, value)
            for name, value in (columns | {"joint": joint}).items()
        }
        curve = rc.loading_curve(
            SURFACE,
            1e10,
            pressures=pressures,
            measures=[lambda _, of=measured: {k: v[0] for k, v in of.items()}],
        )
        axes = rc.plot.conductance_curve(curve, Figure().subplots())
        assert axes.get_legend_handles_labels()[1] == drawn


def test_a_curve_without_parts_is_refused():
    with pytest.raises(ValueError, match=r"no parts of a conductance.*measures=\[rc\.ConductanceParts"):
        rc.plot.conductance_curve(rc.loading_curve(SURFACE, 1e10, pressures=[1e7]))
