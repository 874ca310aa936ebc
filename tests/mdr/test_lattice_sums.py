"""Lattice sums against double loops, closed forms and surfaces."""

import math

import mpmath
import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.lines.equivalent_line import line_spectrum
from roughcontact.mdr.lines.lattice_sums import lambda_rms, line_sum, square_sum

# Sums of up to 1e5 terms of one sign, pairwise: a few units in the last place.
ROUNDING = 2e-15


def direct(exponent, modes):
    n = np.arange(-modes, modes + 1.0)
    squares = (n[:, None] ** 2 + n**2).ravel()
    return math.fsum(squares[squares > 0] ** -exponent)


# 32 is the last ring that is summed directly.
@pytest.mark.parametrize("modes", [1, 2, 31, 32, 33, 34, 150])
@pytest.mark.parametrize("exponent", [0.0, 0.4, 1.0, 1.7, 3.0, 4.0])
def test_a_square_is_summed_as_term_by_term(exponent, modes):
    assert square_sum(exponent, modes) == pytest.approx(direct(exponent, modes), rel=ROUNDING)


@pytest.mark.parametrize("exponent", [-1.0, 0.0, 1.0, 3.6])
def test_a_line_is_summed_as_term_by_term(exponent):
    terms = [n**-exponent for n in range(1, 201)]
    assert line_sum(exponent, 200) == pytest.approx(2 * math.fsum(terms), rel=ROUNDING)


@pytest.mark.parametrize(
    ("hurst", "values"),
    [
        (0.0, (3.08985, 3.10466, 3.11298, 3.11826)),
        (0.25, (2.90251, 2.91018, 2.91352, 2.91508)),
        (0.7, (2.63612, 2.63684, 2.63694, 2.63696)),
        (1.0, (2.50678, 2.50687, 2.50687, 2.50687)),
        (2.0, (2.24650, 2.24650, 2.24650, 2.24650)),
    ],
)
def test_lambda_has_the_values_of_an_independent_double_sum(hurst, values):
    assert [round(lambda_rms(hurst, modes), 5) for modes in (16, 64, 256, 1024)] == list(values)


@pytest.mark.parametrize("hurst", [1e-300, 1e-17, 1e-12, 1e-6, 0.1, 0.5, 1.0, 2.0, 3.0, 40.0])
def test_the_limit_of_many_waves_is_that_of_zeta_functions_to_rounding(hurst):
    with mpmath.workdps(40):
        h, quarter = mpmath.mpf(hurst), mpmath.mpf(1) / 4
        if hurst < 1e-20:
            exact = mpmath.pi  # both zeta functions have their pole at H = 0
        else:
            beta = (mpmath.zeta(h + 1, quarter) - mpmath.zeta(h + 1, 3 * quarter)) / 4 ** (h + 1)
            exact = 2 * mpmath.zeta(h + 1) * beta / mpmath.zeta(2 * h + 1)
    # To the rounding of H + 1, whatever the size of H: lambda changes there by about 1.
    assert lambda_rms(hurst) == pytest.approx(float(exact), rel=1e-15)


@pytest.mark.parametrize("hurst", [-1.0, -0.7, -0.5, -0.2, 0.4, 1.0, 2.5])
def test_sums_go_to_the_limit(hurst):
    # The square's tail is that of an integral with an error of a part 1/N, the sum's part N^(-2|H|); for negative H
    # the first, constant terms of both sums are lost against N^(-2H).
    modes = 200_000
    slow = 4 * modes ** -min(1.0, 2 * abs(hurst))
    assert lambda_rms(hurst, modes) == pytest.approx(lambda_rms(hurst), abs=slow)


def test_known_limits():
    assert lambda_rms(-1) == pytest.approx(4, rel=1e-15)  # white: as many waves as the square has cells
    assert lambda_rms(-0.5) == pytest.approx(4 * math.asinh(1), rel=1e-15)
    assert lambda_rms(0) == pytest.approx(math.pi, rel=1e-15)
    assert lambda_rms(60) == 2  # the four longest waves of a square, the two of a line


@pytest.mark.parametrize("n", [32, 33])
@pytest.mark.parametrize("hurst", [0.0, 0.7, 2.0])
def test_surface_and_line_have_one_rms_height(n, hurst):
    surface = rc.SelfAffineSpectrum(hurst, scale=1e-15)
    line = line_spectrum(surface, lambda_rms(hurst, (n - 1) // 2))
    rng = np.random.default_rng(1)
    rough = rc.synthesise(rc.Grid((n, n), 2e-6), surface, rng)
    assert rc.synthesise(rc.Grid(n, 2e-6), line, rng).rms == pytest.approx(rough.rms, rel=1e-13)


@pytest.mark.parametrize(("hurst", "modes"), [(-1.1, 8), (math.nan, 8), (math.inf, None), (0.5, 0)])
def test_what_makes_no_sense_is_refused(hurst, modes):
    with pytest.raises(ValueError, match="at least"):
        lambda_rms(hurst, modes)


def test_waves_are_counted():
    with pytest.raises(ValueError, match=r"modes.*whole number.*not 2.5"):
        lambda_rms(0.7, modes=2.5)
    with pytest.raises(ValueError, match="Hurst exponent must be one number"):
        lambda_rms("a")
