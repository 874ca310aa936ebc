"""Printed equations of chapter 2 and of the symbol table that are wrong, and the right ones."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.generation.wave_grid import wave_powers


def test_2_12_the_exponent_lacks_the_place():
    """h(x_k) = sum_j B_j exp i(phi_j + (2 pi/N)(j - 1)(k - 1)). As printed nothing depends on k: a straight line."""
    grid = rc.Grid(64, 0.5, True)
    line = rc.self_affine(grid, hurst=0.7, rms=1.0, rng=np.random.default_rng(0))
    amplitude, phase = np.abs(np.fft.fft(line.heights)) / 64, np.angle(np.fft.fft(line.heights))
    j, k = np.arange(64), np.arange(64)
    right = (amplitude * np.exp(1j * (phase + 2 * np.pi / 64 * np.outer(k, j)))).sum(axis=1)
    printed = (amplitude * np.exp(1j * (phase + 2 * np.pi / 64 * np.outer(np.ones(64), j)))).sum(axis=1)
    np.testing.assert_allclose(right.real, line.heights, atol=1e-13)
    assert np.ptp(printed.real) < 1e-13 < np.ptp(line.heights)


def test_2_15_is_a_sum_over_wave_vectors_with_paired_phases():
    """h = sum over all q of B cos(q x + phi), phi(-q) = -phi(q). Unpaired phases lose half of the variance."""
    grid = rc.Grid((24, 24), 1.0, True)
    powers = wave_powers(rc.SelfAffineSpectrum(0.8), grid.shape, grid.spacing, "square")
    ny, nx = grid.shape
    b = np.zeros((ny, nx))
    b[:, : nx // 2 + 1] = np.sqrt(powers)
    b[:, nx // 2 + 1 :] = np.roll(b[::-1, 1 : nx // 2], 1, axis=0)[:, ::-1]  # B(-q) = B(q)
    rng = np.random.default_rng(0)
    paired = np.angle(np.fft.fft2(rng.standard_normal((ny, nx))))  # of real noise
    loose = rng.uniform(0, 2 * np.pi, (ny, nx))
    total = (b**2).sum()

    def variance(phases):
        return np.mean(np.fft.ifft2(b * np.exp(1j * phases) * ny * nx).real ** 2)

    assert variance(paired) == pytest.approx(total, rel=1e-12)
    # The real part of a complex surface: half on the mean, with the scatter of a few long waves.
    mean = np.mean([variance(rng.uniform(0, 2 * np.pi, (ny, nx))) for _ in range(400)])
    assert mean == pytest.approx(total / 2, rel=0.05)
    assert variance(loose) < 0.9 * total


def test_symbol_table_reduced_modulus_has_squares():
    """1/E* = (1 - nu1^2)/E1 + ...; the table prints 1 - nu (eq. 4.3 has it right)."""
    steel = rc.Solid(210e9, 0.3)
    printed = 210e9 / (1 - 0.3)
    assert rc.reduced_modulus(steel) == pytest.approx(210e9 / 0.91)
    assert abs(rc.reduced_modulus(steel) / printed - 1) > 0.2
    # Boussinesq's point load: u = P (1 - nu)/(2 pi G r), and u = P/(pi E* r).
    shear = 210e9 / (2 * 1.3)
    assert np.pi * rc.reduced_modulus(steel) == pytest.approx(2 * np.pi * shear / (1 - 0.3))


def test_symbol_table_step_lacks_parentheses():
    """D = L/(N - 1), not L/N - 1, which is no length; and cells of the Love kernel cover N D."""
    length, count = 2e-3, 513
    step = length / (count - 1)
    nodal = rc.self_affine(
        rc.Grid((count, count), step), hurst=0.8, rms=1e-6, rng=np.random.default_rng(0), nodal=True
    )
    np.testing.assert_array_equal(nodal.heights[0], nodal.heights[-1])  # both ends are nodes of one period
    assert nodal.grid.lengths[0] == pytest.approx(length * count / (count - 1))
    assert length / count - 1 < 0
