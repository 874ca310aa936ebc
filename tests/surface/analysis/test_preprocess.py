import numpy as np
import pytest

from roughcontact.surface.analysis.preprocess import taper
from roughcontact.surface.preparation.windows import WINDOWS


@pytest.mark.parametrize("size", [8, 101])
def test_the_corrections_of_hann_are_its_closed_ones(size):
    """sin^2 and its powers have as many waves in n cells as trapezoidal sums take exactly."""
    hann = taper("hann", size)
    assert hann.power == pytest.approx(3 / 8, rel=1e-13)
    assert hann.overlap == pytest.approx((35 / 128) / (3 / 8) ** 2, rel=1e-13)
    # Differences of cells damp the slope of one wave by sin(pi/n)/(pi/n); its mean square is 4/3 (pi/L)^2.
    assert hann.smear == pytest.approx(np.sinc(1 / size) ** 2 / 3, rel=1e-12)


@pytest.mark.parametrize("name", ["none", *WINDOWS])
def test_windows_are_even_and_end_low(name):
    window = taper(name, 64)
    np.testing.assert_allclose(window.values, window.values[::-1], rtol=0, atol=1e-14)
    assert window.values.max() <= 1 + 1e-12
    assert (window.overlap > 1) == (window.smear > 0) == (name != "none")


def test_automatic_windows_follow_the_boundary():
    assert (taper("auto", 9, periodic=True).values == 1).all()
    np.testing.assert_array_equal(taper("auto", 9, periodic=False).values, taper("hann", 9).values)
    with pytest.raises(ValueError, match="window must be one of"):
        taper("kaiser", 9)
