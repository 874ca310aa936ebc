"""The energy of full contact: against the products of the half-space, and what is refused."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.adhesive import persson_tosatti
from roughcontact.theory.random_surfaces.waves import Waves


def test_the_energy_of_full_contact_is_that_of_the_half_space():
    grid = rc.Grid((32, 32), 0.5, periodic=True)
    heights = np.random.default_rng(0).standard_normal((32, 32))
    heights = np.fft.ifft2(np.fft.fft2(heights) * (np.abs(np.fft.fftfreq(32)) < 0.4)).real
    heights -= heights.mean()
    body = rc.half_space(grid, 3.0)
    # The pressure under which the displacement is the surface: wave by wave, from products with single waves.
    transfer = np.fft.fft2(body.apply(np.eye(1, 1024).reshape(32, 32))).real
    waves = np.fft.fft2(heights)
    pressure = np.fft.ifft2(np.divide(waves, transfer, out=np.zeros_like(waves), where=transfer > 1e-12)).real
    np.testing.assert_allclose(body.apply(pressure), heights, atol=1e-12)
    energy = 0.5 * float(np.mean(pressure * heights))
    told = persson_tosatti.full_contact_energy(Waves.of_heights(heights, grid.spacing), 3.0)
    # Waves of nearly one length stand together (Waves.of_heights).
    assert told == pytest.approx(energy, rel=1e-3)


def test_by_quadrature_of_a_power_law():
    spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1.0, short_cutoff=0.01).scaled(1e-3)
    q = np.linspace(2 * np.pi, 200 * np.pi, 400_001)
    told = np.pi / 2 * 5.0 * np.trapezoid(q**2 * spectrum(q), q)
    # Of the rule: step^2/12 of the slope at the long end, 1.6 of the integrand over q.
    assert persson_tosatti.full_contact_energy(spectrum, 5.0) == pytest.approx(told, rel=1e-6)
    limit = persson_tosatti.stickable_modulus(spectrum, 0.1)
    assert abs(persson_tosatti.effective_work(spectrum, limit, 0.1)) <= 1e-15


def test_what_makes_no_sense_is_refused():
    spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1.0, short_cutoff=0.01).scaled(1e-3)
    with pytest.raises(ValueError, match="work of adhesion"):
        persson_tosatti.effective_work(spectrum, 1.0, 0.0)
    with pytest.raises(ValueError, match="modulus"):
        persson_tosatti.full_contact_energy(spectrum, -1.0)
