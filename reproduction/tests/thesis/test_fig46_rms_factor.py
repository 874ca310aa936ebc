"""Figure 46: the factor between the spectra of line and surface."""

import math

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact.mdr.lines.equivalent_line import line_spectrum
from roughcontact_thesis import fig46_rms_factor as fig46
from roughcontact_thesis.figures import drawn, verdicts


@pytest.fixture(scope="module")
def data():
    return fig46.case()


def brute(hurst, modes):
    """Return A.76 without its half, term by term."""
    n = np.arange(-modes, modes + 1.0)
    squares = n[:, None] ** 2 + n**2
    surface = squares[squares > 0] ** -(hurst + 1)
    return surface.sum() / (2 * (n[n > 0] ** -(2 * hurst + 1)).sum())


def test_the_curves_are_the_sums(data):
    for row, modes in enumerate(fig46.MODES[:3]):
        expected = [brute(hurst, modes) for hurst in fig46.HURST]
        np.testing.assert_allclose(data[row], expected, rtol=1e-12)


def test_more_waves_lead_to_the_limit(data):
    # At low H from below: every curve lies above the one of fewer waves.
    assert (np.diff(data[:, fig46.HURST <= 0.5], axis=0) > 0).all()
    # 2 zeta(2) beta(2)/zeta(3) at H = 1, with Catalan's and Apery's constants.
    apery = 1.2020569031595942
    at_one = 2 * math.pi**2 / 6 * 0.915965594177219 / apery
    assert data[-1][np.searchsorted(fig46.HURST, 1.0)] == pytest.approx(at_one, rel=1e-12)
    assert data[-1][0] == pytest.approx(math.pi, rel=1e-12)
    assert (np.diff(data[-1]) < 0).all()


def test_a_line_with_the_factor_is_as_rough_as_the_surface():
    hurst, n = 0.4, 17
    grids = rc.Grid((n, n), 1 / n, periodic=True), rc.Grid(n, 1 / n, periodic=True)
    law = rc.SelfAffineSpectrum(hurst)
    rng = np.random.default_rng(0)
    surface = rc.synthesise(grids[0], law, rng)
    line = rc.synthesise(grids[1], line_spectrum(law, brute(hurst, (n - 1) // 2)), rng)
    assert line.rms == pytest.approx(surface.rms, rel=1e-12)


def test_it_is_drawn_and_judged(data):
    FigureCanvasAgg(drawn(fig46, data)).draw()
    assert [each.word for each in verdicts(fig46, data)] == ["does not hold"] * 2
