import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.analysis.spectra import power_spectrum
from roughcontact.surface.analysis.spectrum_moments import spectrum_moments
from roughcontact.surface.moments import surface_moments


def test_a_power_law_has_closed_moments():
    q = np.geomspace(1.0, 100.0, 40)
    ones = np.ones(q.shape)
    surface = spectrum_moments(PowerSpectrum(q, q**-4.0, "C2D", ones, ones, 1.0, 100.0))
    assert surface.m0 == pytest.approx(2 * math.pi * (1 - 1e-4) / 2, rel=1e-12)
    assert surface.m2 == pytest.approx(math.pi * math.log(100), rel=1e-12)  # exponent -1: the flat branch
    assert surface.m4 == pytest.approx(3 * math.pi / 4 * (1e4 - 1) / 2, rel=1e-12)
    line = spectrum_moments(PowerSpectrum(q, q**-4.0, "C1D", ones, ones, 1.0, 100.0), q_max=100.0)
    assert line.m0 == pytest.approx(2 * (1 - 1e-6) / 3, rel=1e-12)
    assert (surface.dimension, line.dimension) == (2, 1)


def test_they_are_those_of_the_surface():
    """A band well inside the grid; what the trapezium of rings makes of its sharp ends is a ring in 12 or 64."""
    grid = rc.Grid((256, 256), 1e-6, True)
    surface = rc.self_affine(grid, 0.5, 1e-6, np.random.default_rng(0), long_cutoff=20e-6, short_cutoff=4e-6)
    expected, found = surface_moments(surface), spectrum_moments(power_spectrum(surface))
    for name in ("m0", "m2", "m4"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1 / 12)


def test_an_empty_band_is_refused():
    q = np.array([1.0, 2.0, 3.0])
    spectrum = PowerSpectrum(q, np.array([1.0, 0.0, 0.0]), "C2D", q, q, 1.0, 3.0)
    with pytest.raises(ValueError, match="two bins with power"):
        spectrum_moments(spectrum)
