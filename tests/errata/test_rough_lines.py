"""Thesis, eqs 4.54, 4.75, A.68, A.70, A.76 and figure 47: the line that stands for a surface, and its stiffness."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.mdr.lines.equivalent_line import line_spectrum
from roughcontact.mdr.lines.lattice_sums import lambda_rms
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact_thesis.calibration import calibrated_lambda

MODES, LENGTH = 6, 3.0


def waves(dimension):
    """Return the wave vectors of a square or of a line of side LENGTH, both signs, without the mean."""
    n = np.arange(-MODES, MODES + 1) * 2 * math.pi / LENGTH
    q = np.stack(np.meshgrid(*[n] * dimension, indexing="ij"), axis=-1).reshape(-1, dimension)
    return q[np.any(q != 0, axis=1)]


def heights(q, amplitude, seed=0):
    """Return the sum of B cos(q x + phi) with phi(-q) = -phi(q), wave by wave, at more points than waves."""
    phase = np.random.default_rng(seed).uniform(0, 2 * math.pi, len(q))
    phase = (phase - phase[::-1]) / 2  # the wave vectors stand in an order that reversal turns into -q
    x = np.arange(2 * MODES + 1) * LENGTH / (2 * MODES + 1)
    points = np.stack(np.meshgrid(*[x] * q.shape[1], indexing="ij"), axis=-1)
    return sum(b * np.cos(points @ k + p) for b, k, p in zip(amplitude, q, phase, strict=True))


def rms_of_surface_and_line(hurst, factor):
    """Return the rms heights of a surface and of a line with C1D = factor q C2D, by eqs A.69 and A.71."""
    surface, line = waves(2), waves(1)
    q = np.linalg.norm(surface, axis=1)
    b2d = 2 * math.pi / LENGTH * np.sqrt(q ** (-2 * hurst - 2))
    q = np.abs(line[:, 0])
    b1d = np.sqrt(2 * math.pi / LENGTH * factor * q * q ** (-2 * hurst - 2))
    return heights(surface, b2d).std(), heights(line, b1d).std()


def printed_a_76(hurst, modes):
    n = np.arange(-modes, modes + 1.0)
    squares = (n[:, None] ** 2 + n**2).ravel()
    surface = (squares[squares > 0] ** -(hurst + 1)).sum()
    return surface / (np.abs(n[n != 0]) ** -(2 * hurst + 1)).sum() / 2


@pytest.mark.parametrize("hurst", [0.0, 0.7, 1.0, 2.0])
def test_a_76_has_no_factor_one_half(hurst):
    surface, line = rms_of_surface_and_line(hurst, lambda_rms(hurst, MODES))
    assert line == pytest.approx(surface, rel=1e-12)
    surface, line = rms_of_surface_and_line(hurst, printed_a_76(hurst, MODES))
    assert line**2 / surface**2 == pytest.approx(0.5, rel=1e-12)


def printed_figure_46(hurst):
    """For many points lambda "only approaches pi for H = 1"."""
    assert hurst == 1
    return math.pi


def test_a_76_goes_to_pi_for_many_waves_at_hurst_0_and_not_at_1():
    # Twice the printed sums, which are right but for their factor; what 200 waves leave out is a part 1/N^2.
    many = 2 * printed_a_76(1.0, 200)
    assert lambda_rms(1.0) == pytest.approx(many, rel=2 / 200**2)
    assert printed_figure_46(1) / many == pytest.approx(1.2532, abs=1e-4)
    # Towards H = 0 both sums grow as ln N, in the ratio pi.
    growth = [
        2 * printed_a_76(0.0, modes) * 2 * sum(1 / n for n in range(1, modes + 1)) for modes in (100, 200)
    ]
    assert (growth[1] - growth[0]) / (2 * math.log(2)) == pytest.approx(math.pi, rel=0.01)
    assert lambda_rms(0.0) == pytest.approx(math.pi, rel=1e-14)


def test_4_54_gives_equal_rms_heights_as_integrals_and_not_on_a_grid():
    """C1D = pi q C2D equates eqs A.74 and A.75, not the sums over the waves of a grid."""
    surface = rc.SelfAffineSpectrum(1.0, long_cutoff=3.0, short_cutoff=0.1)
    line = line_spectrum(surface)
    ends = 2 * math.pi / 3.0 * (1 + 1e-12), 2 * math.pi / 0.1 * (1 - 1e-12)
    areal = 2 * math.pi * quad(lambda q: q * surface(np.array([q]))[0], *ends, epsrel=1e-10)[0]
    linear = 2 * quad(lambda q: line(np.array([q]))[0], *ends, epsrel=1e-10)[0]
    assert linear == pytest.approx(areal, rel=1e-9)
    rough, equivalent = rms_of_surface_and_line(1.0, math.pi)
    assert equivalent**2 / rough**2 == pytest.approx(math.pi / lambda_rms(1.0, MODES), rel=1e-12)
    assert equivalent**2 / rough**2 > 1.25


def test_4_75_matches_stiffness_and_so_not_the_rms_height():
    """The thesis gives lambda(H) as a figure; that of one wave is known: 4 where equal rms heights want 2."""
    n, h0, q = 2**18, 1e-3, 2 * math.pi / LENGTH
    grid = rc.Grid(n, LENGTH / n)

    def surface(wavenumber):
        """Return C2D of h0 (cos qx + cos qy): four waves of mean square height h0^2/4."""
        return np.where(wavenumber < 1.5 * q, h0**2 / 4 * (LENGTH / (2 * math.pi)) ** 2, 0.0)

    force = 1e-7 * h0 * LENGTH
    hertz = 2 * (3 * force / (4 * h0 * q**2)) ** (1 / 3)  # k = 2 E* a on the crest of radius 1/(h0 q^2)

    def stiffness(factor):
        [line] = rough_lines(grid, line_spectrum(surface, factor), np.random.default_rng(0), 1)
        return loading_curves(line, LENGTH / n, 1.0, forces=[force]).stiffness[0, 0]

    # The exact prefactors of one wave.
    prefactors = {
        "line_prefactor": (3 / (math.sqrt(2) * math.pi**2)) ** (1 / 3),
        "surface_prefactor": (6 / (4 * math.pi**2)) ** (1 / 3),
    }
    # Two springs at the rim of 900, and a parabola for the crest of a cosine, (q a)^2/6 = 1e-4.
    assert stiffness(calibrated_lambda(60.0, **prefactors)) == pytest.approx(hertz, rel=3e-3)
    assert stiffness(lambda_rms(60.0)) / hertz == pytest.approx(2 ** (1 / 6), rel=3e-3)


def bell(q):
    """Return a smooth spectrum whose sum over the waves of any longer line is its integral, to rounding."""
    return np.exp(-((q / 4) ** 2))


def printed_a_68(q, amplitude, seed=0):
    """An integral over the wave vectors of the amplitude of A.69, in the steps of the grid."""
    return (2 * math.pi / LENGTH) ** 2 * heights(q, amplitude, seed)


def printed_a_70(q, amplitude, seed=0):
    """An integral over the wavenumbers of the amplitude of A.71, in the steps of the grid."""
    return 2 * math.pi / LENGTH * heights(q, amplitude, seed)


def test_a_70_is_a_sum_over_waves(monkeypatch):
    monkeypatch.setattr(f"{__name__}.MODES", 20)
    q = waves(1)
    amplitude = np.sqrt(2 * math.pi / LENGTH * bell(q[:, 0]))  # A.71
    # A.75; C1D is smooth at q = 0, where the line has no wave: its share is missing.
    variance = 4 * math.sqrt(math.pi) - 2 * math.pi / LENGTH
    assert heights(q, amplitude).std() ** 2 == pytest.approx(variance, rel=1e-12)
    # A length of 2 pi would hide it.
    assert printed_a_70(q, amplitude).std() ** 2 / variance == pytest.approx((2 * math.pi / LENGTH) ** 2)


def test_a_68_is_a_sum_over_waves(monkeypatch):
    monkeypatch.setattr(f"{__name__}.MODES", 14)
    q = waves(2)
    amplitude = 2 * math.pi / LENGTH * np.sqrt(bell(np.linalg.norm(q, axis=1)))  # A.69
    variance = 16 * math.pi - (2 * math.pi / LENGTH) ** 2  # A.74, without q = 0
    assert heights(q, amplitude).std() ** 2 == pytest.approx(variance, rel=1e-12)
    assert printed_a_68(q, amplitude).std() ** 2 / variance == pytest.approx((2 * math.pi / LENGTH) ** 4)


def printed_figure_47(modulus, parts):
    """k = E*/n times the sum of the n lengths in contact."""
    return modulus / len(parts) * sum(parts)


def test_figure_47_stiffness_is_the_sum_of_the_lengths_in_contact():
    modulus, spacing = 3.0, 0.01
    x = np.arange(300) * spacing
    line = np.cos(2 * math.pi * x) + 0.3 * np.cos(14 * math.pi * x)

    def force(plane):
        """Return the force of a plane at a height: E* spacing times the springs' deflections."""
        return modulus * spacing * np.maximum(line - plane, 0).sum()

    plane, step = 0.4, 1e-6
    slope = (force(plane - step) - force(plane + step)) / (2 * step)
    inside = np.concatenate([[False], line > plane, [False]])
    parts = np.flatnonzero(inside[:-1] & ~inside[1:]) - np.flatnonzero(~inside[:-1] & inside[1:])
    assert len(parts) > 3
    assert modulus * spacing * parts.sum() == pytest.approx(slope, rel=1e-9)
    curves = loading_curves(line, spacing, modulus, depths=[line.max() - plane])
    assert curves.stiffness[0, 0] == pytest.approx(slope, rel=1e-9)
    assert slope / printed_figure_47(modulus, spacing * parts) == pytest.approx(len(parts), rel=1e-9)
