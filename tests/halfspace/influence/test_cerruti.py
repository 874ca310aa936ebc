"""The closed forms under tangential traction, against 50 digits, quadrature, and what they must be by symmetry."""

import mpmath
import numpy as np
import pytest

from roughcontact.halfspace.influence.cerruti import cerruti, cerruti_table
from roughcontact.halfspace.influence.love import love

# Unit cell, by 40-point quadrature with the singularity taken out: X, Y, Z.
TABLE = {
    (0, 0): (1.762747174039086, 1.762747174039086, 0.0),
    (1, 0): (0.9370728722, 0.1009768637, 0.0),
    (1, 1): (0.3623487191, 0.3623487191, 0.3338505354),
    (2, 1): (0.3566371726, 0.0944518158, 0.1742153228),
}


def exact(x, y, dx, dy):
    """Corner sums of the primitives in 50 digits."""
    with mpmath.workdps(50):
        x, y, dx, dy = (mpmath.mpf(float(v)) for v in (x, y, dx, dy))

        def corner(a, b):
            first = b * mpmath.asinh(a / abs(b)) if b else mpmath.mpf(0)
            second = a * mpmath.asinh(b / abs(a)) if a else mpmath.mpf(0)
            return np.array([first, second, -mpmath.sqrt(a * a + b * b)])

        right, left, top, bottom = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
        value = corner(right, top) - corner(left, top) - corner(right, bottom) + corner(left, bottom)
        return [float(v) for v in value]


def point(x, y):
    r3 = np.hypot(x, y) ** 3
    return np.stack([x**2 / r3, y**2 / r3, x * y / r3])


@pytest.mark.parametrize("offset", TABLE)
def test_known_values(offset):
    np.testing.assert_allclose(cerruti(*offset, 1.0, 1.0), TABLE[offset], rtol=0, atol=5e-11)  # as printed


@pytest.mark.parametrize("aspect", [1.0, 1.5, 5.0, 20.0, 1000.0])
@pytest.mark.parametrize("turned", [False, True])
def test_any_offset_and_any_aspect(aspect, turned):
    """1e-13 of Love's integral, tenfold what was found, from the cell itself to 30,000 cells, about every switch."""
    dx, dy = (1.0, aspect) if turned else (aspect, 1.0)
    rng = np.random.default_rng(3)
    offsets = np.floor(10 ** rng.uniform(0, 4.5, (120, 2))) - 1
    offsets[:40] = rng.integers(0, 70, (40, 2))
    offsets[40:60, 0] = 0
    offsets[60:80, 1] = 0
    offsets[80:100] = rng.integers(0, 7, (20, 2))
    values = cerruti(offsets[:, 0] * dx, offsets[:, 1] * dy, dx, dy)
    truth = np.array([exact(i * dx, j * dy, dx, dy) for i, j in offsets]).T
    assert (np.abs(values - truth) / truth[:2].sum(axis=0)).max() < 1e-13


@pytest.mark.parametrize("offset", [(1.5, 0.0), (0.0, -2.0), (2.0, 1.0), (-3.0, 4.0)])
def test_primitives_are_the_integrals(offset):
    """Gauss's rule with 60 points a side, on a cell that is not square and does not hold the point."""
    dx, dy = 0.8, 1.3
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x, y = offset[0] - nodes * dx / 2, offset[1] - nodes[:, None] * dy / 2
    integral = (point(x, y) * weights * weights[:, None]).sum(axis=(1, 2)) * dx * dy / 4
    np.testing.assert_allclose(cerruti(*offset, dx, dy), integral, rtol=1e-12, atol=1e-14)


def test_far_away_a_cell_is_a_point():
    """To the order (h/r)^2 of the cell's extent: at most 6/24 of it for these functions."""
    angle = np.linspace(0.1, 6.2, 37)
    x, y = 50 * np.cos(angle), 50 * np.sin(angle)
    np.testing.assert_allclose(cerruti(x, y, 1.0, 1.0), point(x, y), rtol=0, atol=1e-4 / 50)


def test_the_sum_of_x_and_y_is_loves_integral():
    x, y = np.random.default_rng(0).uniform(-300, 300, (2, 500))
    np.testing.assert_allclose(cerruti(x, y, 1.0, 1.3)[:2].sum(axis=0), love(x, y, 1.0, 1.3), rtol=1e-12)


def test_parities():
    x, y = np.random.default_rng(0).uniform(-300, 300, (2, 500))
    value, mirrored, turned = cerruti(x, y, 1.0, 1.3), cerruti(-x, y, 1.0, 1.3), cerruti(x, -y, 1.0, 1.3)
    odd = np.array([1.0, 1.0, -1.0])[:, None]
    np.testing.assert_array_equal(mirrored, odd * value)
    np.testing.assert_array_equal(turned, odd * value)


@pytest.mark.parametrize("sides", [(1.0, 1.3), (1.0, 1.0), (30.0, 0.7)])
def test_exchange_of_the_axes(sides):
    x, y = np.random.default_rng(0).uniform(-300, 300, (2, 500))
    along, across, cross = cerruti(x, y, *sides)
    np.testing.assert_allclose(
        cerruti(y, x, *sides[::-1]), [across, along, cross], rtol=0, atol=1e-13 * along.max()
    )


def test_cells_add_up():
    """Four cells side by side are one cell of twice the size, in the middle too."""
    for x, y in ((7.0, 2.0), (0.0, 0.0), (1.0, 1.0)):
        parts = sum(cerruti(x + i, y + j, 2.0, 2.0) for i in (-1, 1) for j in (-1, 1))
        np.testing.assert_allclose(parts, cerruti(x, y, 4.0, 4.0), rtol=1e-13, atol=1e-14)


def test_tables_are_the_kernel_at_whole_cells():
    table = cerruti_table((300, 200), (0.5, 0.2))
    y, x = np.mgrid[:300, :200]
    np.testing.assert_array_equal(table, cerruti(x * 0.2, y * 0.5, 0.2, 0.5))
