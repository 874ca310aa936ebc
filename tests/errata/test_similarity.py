"""Thesis, eqs 4.11, 4.56, 4.57 and 4.66: what scales with what, and the units that go with it."""

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc


def printed_4_11(stiffness_of_second, depth, factor):
    """k1(d) = k2(lambda d) for z1 = lambda z2."""
    return stiffness_of_second(factor * depth)


def right_4_11(stiffness_of_second, depth, factor):
    return stiffness_of_second(depth / factor)


def test_4_11_a_higher_surface_is_pressed_deeper():
    grid, factor = rc.Grid((16, 16), 1 / 16), 3.0
    low = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(2))
    high = rc.Surface(factor * low.heights, grid)

    def stiffness(surface, depth):
        return rc.press(surface, 1.0, depth=depth, tolerance=1e-10).stiffness

    depth = 0.03
    k = stiffness(high, depth)
    # The same contact, so the same linear system.
    assert k == pytest.approx(right_4_11(lambda d: stiffness(low, d), depth, factor), rel=1e-9)
    assert abs(k / printed_4_11(lambda d: stiffness(low, d), depth, factor) - 1) > 0.2


def test_4_11_for_a_paraboloid():
    """k = 2 E* sqrt(R d): R2 = 1 and z1 = 3 z2 (R1 = 1/3) at d = 0.02."""

    def second(depth):
        return 2 * np.sqrt(depth)

    first = 2 * np.sqrt(0.02 / 3)
    assert first == pytest.approx(0.1633, abs=5e-5)
    assert right_4_11(second, 0.02, 3.0) == pytest.approx(first, rel=1e-14)
    assert printed_4_11(second, 0.02, 3.0) == pytest.approx(0.4899, abs=5e-5)


def printed_4_56(q, scale, length, hurst):
    """C1D = pi C0 (L q)^(-2H-1)."""
    return np.pi * scale * (length * q) ** (-2 * hurst - 1)


def right_4_56(q, scale, length, hurst):
    return np.pi * scale / length * (length * q) ** (-2 * hurst - 1)


@pytest.mark.parametrize("length", [1.0, 1e-3])
def test_4_56_line_and_surface_have_one_rms(length):
    """Eq. 4.54 gives the line the mean square of the surface: 2 int C1D dq = 2 pi int q C2D dq."""
    scale, hurst, first, last = 1e-20, 0.7, 2 * np.pi / length, 200 * np.pi / length

    def surface(q):
        return scale * (length * q) ** (-2 * (hurst + 1))

    def mean_square(density):
        # Over ln q, where the power laws are smooth.
        return quad(
            lambda x: np.exp(x) * density(np.exp(x)), np.log(first), np.log(last), epsabs=0, epsrel=1e-10
        )[0]

    wanted = 2 * np.pi * mean_square(lambda q: q * surface(q))
    assert 2 * mean_square(lambda q: right_4_56(q, scale, length, hurst)) == pytest.approx(wanted, rel=1e-9)
    printed = 2 * mean_square(lambda q: printed_4_56(q, scale, length, hurst))
    # It lacks 1/L, which is right by accident for L = 1 m.
    assert printed == pytest.approx(wanted * length, rel=1e-9)


def printed_4_57(line, factor, hurst):
    """z' = lambda^H z(x/lambda, y/lambda)."""
    return lambda x: factor**hurst * line(x / factor, 0.0 / factor)


def right_4_57(line, factor, hurst):
    return lambda x: factor**hurst * line(x / factor)


def test_4_57_a_line_has_one_argument():
    """Of a line with C1D ~ q^(-2H-1) the magnified one has the same spectrum, one octave further."""
    hurst, waves = 0.7, 2.0 ** np.arange(6)
    amplitudes = waves**-hurst

    def line(x):
        return np.sum(amplitudes * np.cos(waves * np.asarray(x)[..., None]), axis=-1)

    x = np.linspace(0, 40, 1000)
    magnified = right_4_57(line, 2.0, hurst)(x)
    # Octaves of amplitude q^-H are that spectrum: each wave has become the next longer one.
    octave_on = np.sum(2**hurst * amplitudes * np.cos(waves / 2 * x[:, None]), axis=1)
    np.testing.assert_allclose(magnified, octave_on, rtol=0, atol=1e-12)
    np.testing.assert_allclose((waves / 2) ** -hurst, 2**hurst * amplitudes, rtol=1e-14)
    with pytest.raises(TypeError, match="positional argument"):
        printed_4_57(line, 2.0, hurst)(x)


def printed_4_66(length, spacing):
    """Step of the wavenumbers: L/Delta x."""
    return length / spacing


def right_4_66(length, spacing):
    return 2 * np.pi / length


@pytest.mark.parametrize("length", [1.0, 3e-3])
def test_4_66_wavenumbers_of_a_line(length):
    n = 64
    spacing = length / n
    step = right_4_66(length, spacing)
    # Those of the discrete Fourier transform, and waves that repeat themselves after L.
    np.testing.assert_allclose(
        2 * np.pi * np.fft.rfftfreq(n, spacing), step * np.arange(n // 2 + 1), rtol=1e-14
    )
    phase = 0.3 + step * np.arange(1, 4) * length
    np.testing.assert_allclose(np.cos(phase), np.cos(0.3), atol=1e-14)
    off = 0.3 + printed_4_66(length, spacing) * length
    assert abs(np.cos(off) - np.cos(0.3)) > 0.01
    # Its number does not even have the unit of a wavenumber: it stays when lengths are counted in another unit.
    assert printed_4_66(1e3 * length, 1e3 * spacing) == printed_4_66(length, spacing)
    assert right_4_66(1e3 * length, 1e3 * spacing) == pytest.approx(step / 1e3, rel=1e-14)
