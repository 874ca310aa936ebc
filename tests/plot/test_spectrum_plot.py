"""Spectra: bins, bands, laws and the limits of laws lie where the numbers are, in the units of the labels."""

import math

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.spectrum_plot import spectrum_curve

Q = np.geomspace(1e4, 1e7, 61)  # twenty bins a decade: each is drawn
BAND = (2e4, 2e6)


@pytest.mark.parametrize(
    ("kind", "power", "unit", "factor"), [("C2D", 4, "nm⁴", 1e36), ("C1D", 3, "nm³", 1e27)]
)
def test_all_that_is_drawn_lies_where_its_numbers_are(kind, power, unit, factor):
    law = rc.HurstFit(0.5, 0.01, 1e-30, 1e6, kind, 1e-4, 2e-4, 4e-6, misfit=1.0, band=BAND)
    # Of ten waves a bin is known to a third; of two of them to less than half of its own size.
    waves = np.where(np.arange(61) % 10 == 5, 2.0, 10.0)
    density = 1e-3 * (Q / 1e6) ** -float(power) / factor
    spectrum = rc.PowerSpectrum(Q, density, kind, 2 * waves, waves, *BAND)
    axes = spectrum_curve(spectrum, Figure().subplots(), law=law)
    assert axes.get_xlabel() == "wavenumber q [rad/µm]"
    assert axes.get_ylabel() == rf"power spectrum $C_{{\mathrm{{{kind[1:]}}}}}$ [{unit}]"
    assert axes.get_xlim() == pytest.approx((1e-2 / 1.3, 10 * 1.3), rel=1e-12)
    assert axes.get_ylim()[0] == pytest.approx(density.min() * factor / 2, rel=1e-12)
    assert axes.get_ylim()[1] > density.max() * factor

    every, measured, drawn_law, *limits = axes.lines
    q, values = Q / 1e6, density * factor
    inside = (q > 0.02) & (q < 2)
    np.testing.assert_allclose(every.get_xydata(), np.stack([q, values], 1), rtol=1e-12)
    np.testing.assert_allclose(measured.get_xydata(), np.stack([q, values], 1)[inside], rtol=1e-12)
    [band] = [each for each in axes.collections if isinstance(each, PolyCollection)]
    corners = band.get_paths()[0].vertices
    for at in np.flatnonzero(inside):
        found = corners[np.isclose(corners[:, 0], q[at], rtol=1e-9), 1]
        error = 1 / math.sqrt(waves[at])
        assert found.max() == pytest.approx(values[at] * (1 + error), rel=1e-9)
        assert found.min() == pytest.approx(values[at] * (1 - min(error, 0.5)), rel=1e-9)
    assert len(corners) >= 2 * inside.sum()

    # The law: flat below its roll-off at 100 um, nothing beyond 200 um and below 4 um.
    ends = 2 * math.pi / 200, 2 * math.pi / 4
    x, y = drawn_law.get_data()
    assert (x[0], x[-1]) == pytest.approx(ends, rel=1e-12)
    steep = 2 * 0.5 + (2 if kind == "C2D" else 1)
    np.testing.assert_allclose(y, 1e-30 * factor * np.maximum(x, 2 * math.pi / 100) ** -steep, rtol=1e-9)
    marks = [each.get_xdata()[0] for each in limits]
    assert marks == pytest.approx([2 * math.pi / 100, *ends], rel=1e-12)
    assert [text.xy[0] for text in axes.texts] == marks
    words = [text.get_text() for text in axes.texts]
    assert words == ["roll-off 100 µm", "long cut-off 200 µm", "short cut-off 4 µm"]
