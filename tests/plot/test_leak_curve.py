"""The picture of the flow along a curve: data, units, theory, and closed gaps."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc

GRID = rc.Grid((32, 48), (1e-6, 1.5e-6), periodic=True)
SURFACE = rc.self_affine(GRID, hurst=0.8, rms=1e-7, rng=2, rolloff=24e-6, short_cutoff=8e-6)


def curve_of(*pressures):
    return rc.loading_curve(SURFACE, 1e9, pressures=pressures, measures=[rc.Transmissivity(axis=1)])


@pytest.fixture(scope="module")
def curve():
    return curve_of(1e6, 3e6, 3e7)


@pytest.mark.parametrize(
    ("quantity", "units", "labels", "factors"),
    [
        ("hydraulic_gap", None, ("MPa", "nm"), (1e-6, 1e9)),
        (
            "transmissivity",
            {"nominal_pressure": rc.plot.Scale(1e-5, "bar"), "transmissivity": rc.plot.Scale(1e27, "nm3")},
            ("bar", "nm³"),
            (1e-5, 1e27),
        ),
    ],
)
def test_points_theory_and_closed_gaps_are_drawn_in_their_units(curve, quantity, units, labels, factors):
    axes = rc.plot.leak_curve(curve, Figure().subplots(), quantity=quantity, units=units)
    assert axes.get_xlabel() == f"nominal pressure [{labels[0]}]"
    assert axes.get_ylabel() == f"{quantity.replace('_', ' ')} [{labels[1]}]"
    drawn = {line.get_label(): line.get_xydata() for line in axes.lines}
    x, y = curve.nominal_pressure * factors[0], curve.measured[quantity] * factors[1]
    np.testing.assert_allclose(drawn["resolved"], np.stack([x, y])[:, :2].T)
    theory = curve.measured["transmissivity_bruggeman"]
    theory = np.cbrt(theory) if quantity == "hydraulic_gap" else theory
    np.testing.assert_allclose(drawn["Bruggeman's theory"][:, 1], theory[theory > 0] * factors[1])
    np.testing.assert_allclose(drawn["no open path"][:, 0], x[2:])
    assert axes.get_ylim()[0] < y[1]  # the crosses lie in a band below the points


def test_curves_without_a_path_and_without_a_closed_gap(curve):
    labels = [
        {line.get_label() for line in rc.plot.leak_curve(each, Figure().subplots()).lines}
        for each in (curve_of(3e7), curve_of(1e6))
    ]
    assert curve.plot(Figure().subplots(), quantity="hydraulic_gap").get_ylabel() == "hydraulic gap [nm]"
    assert labels == [{"no open path"}, {"resolved", "Bruggeman's theory"}]


def test_what_cannot_be_drawn(curve):
    with pytest.raises(ValueError, match="quantity must be one of hydraulic_gap, transmissivity"):
        rc.plot.leak_curve(curve, quantity="depth")
    with pytest.raises(ValueError, match="the curve has no hydraulic gap"):
        rc.plot.leak_curve(rc.loading_curve(SURFACE, 1e9, pressures=[1e6]))
