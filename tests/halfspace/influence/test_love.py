import mpmath
import numpy as np
import pytest

from roughcontact.halfspace.influence import love as kernels
from roughcontact.halfspace.influence.love import love, love_table, wave_compliance

# Thesis, K(i, j) of the unit cell; 60-digit arithmetic.
TABLE = {
    (0, 0): 3.525494348078172,
    (1, 0): 1.038049735904756,
    (1, 1): 0.724697438134330,
    (2, 0): 0.505091983075117,
    (2, 1): 0.451088988349220,
    (2, 2): 0.355477214265529,
    (3, 0): 0.334861370214300,
}


def exact(x, y, dx, dy):
    """Eq. A.16 in 50 digits."""
    return float(exact_number(x, y, dx, dy))


def exact_number(x, y, dx, dy):
    with mpmath.workdps(50):
        x, y, dx, dy = (mpmath.mpf(float(v)) for v in (x, y, dx, dy))

        def corner(a, b):
            first = a * mpmath.asinh(b / abs(a)) if a else mpmath.mpf(0)
            return first + (b * mpmath.asinh(a / abs(b)) if b else 0)

        right, left, top, bottom = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
        return corner(right, top) - corner(left, top) - corner(right, bottom) + corner(left, bottom)


@pytest.mark.parametrize("offset", TABLE)
def test_the_table_of_the_thesis(offset):
    assert love(*offset, 1.0, 1.0) == pytest.approx(TABLE[offset], rel=1e-14)


@pytest.mark.parametrize("aspect", [1.0, 1.5, 5.0, 20.0, 1000.0])
@pytest.mark.parametrize("turned", [False, True])
def test_any_offset_and_any_aspect(aspect, turned):
    """1e-12, as promised, at offsets from the cell itself to 30,000 cells, on both sides of every switch."""
    dx, dy = (1.0, aspect) if turned else (aspect, 1.0)
    rng = np.random.default_rng(3)
    offsets = np.floor(10 ** rng.uniform(0, 4.5, (120, 2))) - 1
    offsets[:40] = rng.integers(0, 70, (40, 2))
    offsets[40:60, 0] = 0
    offsets[60:80, 1] = 0
    values = love(offsets[:, 0] * dx, offsets[:, 1] * dy, dx, dy)
    truth = np.array([exact(i * dx, j * dy, dx, dy) for i, j in offsets])
    np.testing.assert_allclose(values, truth, rtol=1e-12)


@pytest.mark.parametrize("aspect", [1.0, 0.3, 1 / 0.3, 0.01])
@pytest.mark.parametrize("radius", [1 - 1e-9, 1 + 1e-9, 1.01, 1.5, 10.0])
def test_about_where_multipoles_take_over(aspect, radius):
    """Some roundings of sums whose first term is the largest, and 2e-3 FAR^-10 = 6e-16 that is left out."""
    angle = np.linspace(0, np.pi / 2, 21)
    distance = radius * kernels.FAR * max(1.0, aspect)
    x, y = distance * np.cos(angle), distance * np.sin(angle)
    truth = np.array([exact(*place, 1.0, aspect) for place in zip(x, y, strict=True)])
    np.testing.assert_allclose(love(x, y, 1.0, aspect), truth, rtol=1e-14)
    expanded, close = (
        kernels._expansion(x, y, 1.0, aspect) if aspect <= 1 else kernels._expansion(y, x, aspect, 1.0)
    )
    assert (close == (radius < 1)).all()
    # Just within they would do as well: nothing jumps.
    np.testing.assert_allclose(expanded, truth, rtol=1e-14)


@pytest.mark.parametrize("aspect", [1.0, 0.3, 0.01])
def test_the_first_multipole_is_the_force(aspect):
    assert kernels._multipoles(2.0, 2.0 * aspect)[0] == pytest.approx((1.0,), rel=1e-15)


@pytest.mark.parametrize("aspect", [1.0, 0.3, 0.01])
@pytest.mark.parametrize("angle", [0.0, 0.4])
@pytest.mark.parametrize("orders", [1, 2, 3, 4, 5])
def test_each_multipole_that_is_left_out_falls_faster(aspect, angle, orders):
    """The sum of the first m leaves a part of the whole that falls as R^-2m."""
    multipoles = kernels._multipoles(1.0, aspect)
    assert len(multipoles) == kernels.ORDER + 1

    def left(distance):
        with mpmath.workdps(50):
            x, y = float(distance * np.cos(angle)), float(distance * np.sin(angle))
            square = mpmath.mpf(x) ** 2 + mpmath.mpf(y) ** 2
            c, total = mpmath.mpf(x) ** 2 / square, mpmath.mpf(0)
            for m, polynomial in enumerate(multipoles[:orders]):
                total += sum(mpmath.mpf(t) * c**k for k, t in enumerate(polynomial)) / square**m
            return float(total * aspect / mpmath.sqrt(square) / exact_number(x, y, 1.0, aspect) - 1)

    # The multipole after the first that is left out is some R^-2 of it. Coefficients are rounded to 1e-16 of one:
    # at 6 sides the tenth power is still a thousand times more.
    near, far = left(3.0), left(6.0)
    assert abs(far) > 1e-14
    assert near / far == pytest.approx(2.0 ** (2 * orders), rel=0.15)


def test_self_term_of_a_rectangle():
    hx, hy = 3.0, 0.7
    assert love(0, 0, hx, hy) == pytest.approx(
        2 * hx * np.arcsinh(hy / hx) + 2 * hy * np.arcsinh(hx / hy), rel=1e-14
    )


def test_even_in_both_offsets_and_at_any_place():
    rng = np.random.default_rng(0)
    x, y = rng.uniform(-2000, 2000, (2, 500))
    np.testing.assert_array_equal(love(x, y, 1.0, 1.3), love(-x, -y, 1.0, 1.3))
    np.testing.assert_allclose(love(x, y, 1.0, 1.3), love(y, x, 1.3, 1.0), rtol=1e-13)


def test_tables_are_the_kernel_at_whole_cells():
    table = love_table((300, 200), (0.5, 0.2))
    y, x = np.mgrid[:300, :200]
    np.testing.assert_array_equal(table, love(x * 0.2, y * 0.5, 0.2, 0.5))


def test_a_table_is_its_owners():
    first = love_table((3, 4), (0.5, 0.2))
    first *= 2
    np.testing.assert_array_equal(first, 2 * love_table((3, 4), (0.5, 0.2)))


def test_cells_add_up():
    """Four cells side by side are one cell of twice the size."""
    parts = sum(love(7 + i, 2 + j, 2.0, 2.0) for i in (-1, 1) for j in (-1, 1))
    assert parts == pytest.approx(love(7, 2, 4.0, 4.0), rel=1e-13)


def test_the_mean_of_a_periodic_body_does_not_move():
    np.testing.assert_array_equal(wave_compliance([0.0, 1.0, 4.0]), [0.0, 2.0, 0.5])
