"""Below the surface: point loads, equilibrium, Hooke's law, Hertz on the axis, waves and rows."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.influence.love import love
from roughcontact.halfspace.operators.build import singly_periodic
from roughcontact.halfspace.subsurface.fields_below import Stress, displacement, stress
from roughcontact.halfspace.subsurface.love_field import (
    displacement_table,
    love_displacement,
    love_stress,
    stress_table,
)
from roughcontact.halfspace.subsurface.row_field import row_stress_table

NU = 0.3
BODY = rc.Solid(2.6, NU)  # shear modulus 1
CELL = (0.7, 1.3)
STRESSES = ("xx", "yy", "zz", "xy", "xz", "yz")


def point_load(x, y, z, nu=NU):
    """Boussinesq's stresses and displacements (times G) under a unit force (thesis, eqs A.10 to A.12)."""
    r = np.sqrt(x * x + y * y + z * z)
    one, s = 1 - 2 * nu, r + z

    def direct(a):
        return -3 * a * a * z / r**5 + one * (z / r**3 - 1 / (r * s) + a * a * (2 * r + z) / (r**3 * s**2))

    shear = -3 * x * y * z / r**5 + one * x * y * (2 * r + z) / (r**3 * s**2)
    stresses = [direct(x), direct(y), -3 * z**3 / r**5, shear, -3 * x * z * z / r**5, -3 * y * z * z / r**5]
    lateral = z / r**3 - one / (r * s)
    return np.array(stresses) / (2 * np.pi), np.array(
        [x * lateral, y * lateral, z * z / r**3 + 2 * (1 - nu) / r]
    ) / (4 * np.pi)


def components(field):
    return np.stack([getattr(field, name) for name in STRESSES])


@pytest.mark.parametrize(
    "place",
    [
        (0.1, 0.2, 0.5),
        (0.65, 0.1, 0.4),
        (-0.65, 0.35, 0.6),
        (2.0, -1.5, 0.3),
        (0.0, 0.0, 30.0),
        (-9.0, 4.0, 1.0),
    ],
    ids=str,
)
def test_all_components_against_quadrature(place):
    """Inside, on an edge, above a corner, outside, deep and far; 60 points a side, which the nearest needs."""
    x, y, z = place
    nodes, weights = np.polynomial.legendre.leggauss(60)
    fields = point_load(x - nodes * CELL[1] / 2, (y - nodes * CELL[0] / 2)[:, None], z)
    for found, exact in zip(
        (love_stress(*place, CELL, NU), love_displacement(*place, CELL, NU)), fields, strict=True
    ):
        exact = (exact * weights[:, None] * weights).sum((1, 2)) * np.prod(CELL) / 4
        np.testing.assert_allclose(found, exact, rtol=0, atol=3e-13 * np.abs(exact).max())


@pytest.mark.parametrize("nu", [-0.5, 0.0, 0.3, 0.5])
def test_on_the_surface(nu):
    """-p and 0 normal to it, Love's integral of the displacement, and Love's lateral stress in the middle."""
    x, y = np.array([0.0, 0.3, 0.649, 0.651, 5.0]), np.array([0.0, 0.349, 0.1, 0.1, -3.0])
    s = love_stress(x, y, 0.0, CELL, nu)
    np.testing.assert_allclose(s[2], [-1, -1, -1, 0, 0], atol=1e-15)
    np.testing.assert_allclose(s[4:], 0.0, atol=1e-15)
    assert s[0, 0] == pytest.approx(
        -(2 * nu + (1 - 2 * nu) * 2 / np.pi * np.arctan(CELL[0] / CELL[1])), rel=1e-14
    )
    u = love_displacement(x, y, 0.0, CELL, nu)[2]
    np.testing.assert_allclose(u, (1 - nu) / (2 * np.pi) * love(x, y, CELL[1], CELL[0]), rtol=1e-13)
    # It is the limit: the depth is the order of what is left.
    near = love_stress(x, y, 1e-9, CELL, nu)
    np.testing.assert_allclose(near, s, atol=1e-6)


@pytest.mark.parametrize("place", [(0.3, 0.2, 0.4), (1.1, -0.6, 0.2), (-2.0, 0.9, 1.5)], ids=str)
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_stresses_follow_from_displacements_by_hooke(place, nu):
    """Central differences of the displacements: h^2/6 of the third derivative and 1e-16/h of rounding, h = 1e-4.

    At nu = 1/2, where the mean stress is free, the deviator alone follows.
    """
    h = 1e-4
    gradient = np.empty((3, 3))  # d u_i / d x_j, times G
    for j in range(3):
        step = h * np.eye(3)[j]
        ends = [love_displacement(*(np.array(place) + sign * step), CELL, nu) for sign in (1, -1)]
        gradient[:, j] = (ends[0] - ends[1]) / (2 * h)
    strain = (gradient + gradient.T) / 2
    xx, yy, zz, xy, xz, yz = love_stress(*place, CELL, nu)
    found = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    dilatation = np.trace(strain)
    if nu == 0.5:
        assert abs(dilatation) < 1e-7
        found = found - np.trace(found) / 3 * np.eye(3)
        exact = 2 * (strain - dilatation / 3 * np.eye(3))
    else:
        exact = 2 * (strain + nu / (1 - 2 * nu) * dilatation * np.eye(3))
    np.testing.assert_allclose(found, exact, atol=1e-7)


def test_tables_are_their_single_values():
    i, j = np.indices((5, 300))
    for table, single in ((stress_table, love_stress), (displacement_table, love_displacement)):
        found = table((5, 300), CELL, 0.3, NU)
        np.testing.assert_allclose(found, single(j * CELL[1], i * CELL[0], 0.3, CELL, NU), atol=1e-12)


@pytest.mark.parametrize("shape", [(1, 1), (1, 6), (7, 5), (8, 4), (13, 70)], ids=str)
def test_a_field_is_the_sum_over_cells(shape):
    """Every component and its sign, with loads in all corners: no load comes around the edge."""
    grid = rc.Grid(shape, (0.3, 0.5))
    p = np.random.default_rng(0).standard_normal(shape)
    i, j = (k[..., None, None] for k in np.indices(shape))
    a, b = np.indices(shape)
    y, x = (i - a) * 0.3, (j - b) * 0.5
    s, u = stress(p, grid, 0.2, NU), displacement(p, grid, 0.2, BODY)
    np.testing.assert_allclose(
        components(s), (love_stress(x, y, 0.2, (0.3, 0.5), NU) * p).sum((3, 4)), atol=3e-14
    )
    exact = (love_displacement(x, y, 0.2, (0.3, 0.5), NU) * p).sum((3, 4))
    np.testing.assert_allclose(np.stack([u.x, u.y, u.z]), exact, atol=3e-13)


def test_displacement_on_the_surface_is_the_operator_s():
    grid = rc.Grid((12, 9), (0.3, 0.5))
    p = np.random.default_rng(0).random((12, 9))
    for g in (grid, rc.Grid((12, 9), (0.3, 0.5), True)):
        np.testing.assert_allclose(
            displacement(p, g, 0.0, BODY).z, rc.half_space(g, BODY).apply(p), rtol=1e-12, atol=1e-14
        )


@pytest.mark.parametrize("depth", [0.5, 1.0, 3.0])
def test_equilibrium_at_each_depth(depth):
    """The sum of s_zz over a wide plane carries the load; what passes beside it is known by reciprocity."""
    n, force = 101, 2.0
    grid = rc.Grid((n, n), 0.2)
    p = np.zeros(grid.shape)
    p[50, 50] = force / grid.cell_area
    s = stress(p, grid, depth, NU)
    # A unit pressure on the plane's extent, seen from below its middle, and so near a point load that the cell's
    # extent shows as (0.2/depth)^2/4 at most, of which a sum over all places keeps nothing.
    through = -love_stress(0.0, 0.0, depth, grid.lengths, NU)[2]
    assert -s.zz.sum() * grid.cell_area == pytest.approx(force * through, rel=1e-5)
    assert through > 0.95
    for shear in (s.xy, s.xz, s.yz):
        assert shear.sum() == pytest.approx(0.0, abs=1e-10)
    periodic = stress(p, rc.Grid((n, n), 0.2, True), depth, NU)
    assert -periodic.zz.sum() * grid.cell_area == pytest.approx(force, rel=1e-13)


def hertz_cap(n, side=3.0):
    """Hertz' pressure of peak and radius 1, its mean over 8 x 8 points of each cell."""
    fine = (np.arange(8 * n) + 0.5) * side / (8 * n) - side / 2
    p = np.sqrt(np.maximum(1 - fine[:, None] ** 2 - fine**2, 0))
    return p.reshape(n, 8, n, 8).mean((1, 3)), rc.Grid((n, n), side / n)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_below_hertz_on_the_axis(nu):
    """Huber (1904): s_r = -p0 {(1 + nu)[1 - z atan(1/z)] - 1/2/(1 + z^2)}, s_z = -p0/(1 + z^2), a = 1.

    Means over cells, spread evenly over them, are two averages: dx^2/12 of the load's curvature, which is -2 in the
    middle, and as much again for the steep rim.
    """
    errors = []
    z = np.array([0.15, 0.25, 0.48, 1.0, 2.0])
    radial = -((1 + nu) * (1 - z * np.arctan(1 / z)) - 0.5 / (1 + z * z))
    for n in (61, 121):
        p, grid = hertz_cap(n)
        s = stress(p, grid, z, nu)
        m = n // 2
        for found, exact in ((s.xx, radial), (s.yy, radial), (s.zz, -1 / (1 + z * z))):
            errors.append(np.abs(found[:, m, m] - exact).max())
        np.testing.assert_allclose(components(s)[3:, :, m, m], 0.0, atol=1e-13)
        np.testing.assert_allclose(s.von_mises[:, m, m], np.abs(s.zz - s.xx)[:, m, m], rtol=1e-10)
    assert max(errors[:3]) < (3 / 61) ** 2 / 3
    assert (np.array(errors[:3]) / np.array(errors[3:]) > 3).all()


def test_the_largest_shear_below_hertz():
    """0.310 p0 at z = 0.48 a for nu = 0.3: digits of the closed form's own maximum, 0.31002 and 0.4809."""
    p, grid = hertz_cap(101)
    z = np.linspace(0.4, 0.56, 9)
    shear = stress(p, grid, z, 0.3).largest_shear[:, 50, 50]
    best = np.polyfit(z, shear, 4)
    roots = np.roots(np.polyder(best))
    depth = float(roots[np.abs(roots - 0.48).argmin()].real)
    assert np.polyval(best, depth) == pytest.approx(0.31002, abs=(3 / 101) ** 2 / 6)
    assert depth == pytest.approx(0.4809, abs=1e-3)


def test_principal_stresses_and_von_mises_do_not_turn_with_the_axes():
    """Of pure shear tau: tau, 0, -tau, and sqrt(3) tau; and the invariants of any stress."""
    zero, tau = np.zeros((1, 1)), np.full((1, 1), 2.0)
    s = Stress(rc.Grid((1, 1), 1.0), 1.0, zero, zero, zero, zero, tau, zero)
    np.testing.assert_allclose(s.principal[0, 0], [2.0, 0.0, -2.0], atol=1e-15)
    assert s.von_mises[0, 0] == pytest.approx(np.sqrt(3) * 2.0)
    assert s.largest_shear[0, 0] == pytest.approx(2.0)
    grid = rc.Grid((4, 5), (0.3, 0.5))
    s = stress(np.random.default_rng(0).random((4, 5)), grid, 0.3, NU)
    one, two, three = np.moveaxis(s.principal, -1, 0)
    assert (one >= two).all()
    assert (two >= three).all()
    equivalent = np.sqrt(((one - two) ** 2 + (two - three) ** 2 + (three - one) ** 2) / 2)
    np.testing.assert_allclose(s.von_mises, equivalent, rtol=1e-12)
    np.testing.assert_allclose(s.mean, (one + two + three) / 3, rtol=1e-12)


def test_a_wave_of_pressure():
    """Every component of a slanting wave by the formulas of the page, with their sines and cosines."""
    grid = rc.Grid((16, 25), (0.5, 0.24), True)
    y, x = np.meshgrid(*(c for c in grid.coordinates), indexing="ij")
    qy, qx, z = 2 * np.pi * 2 / 8.0, 2 * np.pi * 3 / 6.0, 0.3
    q, phase = np.hypot(qy, qx), qy * y + qx * x
    s, u = stress(np.cos(phase), grid, z, NU), displacement(np.cos(phase), grid, z, BODY)
    e, one = np.exp(-q * z), 1 - 2 * NU
    cosine = {
        "xx": -2 * NU + qx**2 / q * (z - one / q),
        "yy": -2 * NU + qy**2 / q * (z - one / q),
        "zz": -(1 + q * z),
        "xy": qx * qy / q * (z - one / q),
    }
    for name, factor in cosine.items():
        np.testing.assert_allclose(getattr(s, name), factor * e * np.cos(phase), atol=3e-15)
    for name, factor in {"xz": qx * z, "yz": qy * z}.items():
        np.testing.assert_allclose(getattr(s, name), -factor * e * np.sin(phase), atol=3e-15)
    lateral = e / (2 * q) * (z - one / q) * np.sin(phase)
    np.testing.assert_allclose(u.x, qx * lateral, atol=3e-15)
    np.testing.assert_allclose(u.y, qy * lateral, atol=3e-15)
    np.testing.assert_allclose(u.z, e * ((1 - NU) / q + z / 2) * np.cos(phase), atol=3e-15)


@pytest.mark.parametrize("shape", [(6, 8), (7, 5), (2, 2), (1, 4)], ids=str)
@pytest.mark.parametrize("periodic", [False, True, (True, False), (False, True)], ids=str)
def test_a_mirrored_pressure_has_a_mirrored_field(shape, periodic):
    """Along either axis, shear changing its sign; of noise, which holds waves that are the same both ways."""
    grid = rc.Grid(shape, (0.3, 0.5), periodic)
    p = np.random.default_rng(0).standard_normal(shape)
    fields = components(stress(p, grid, 0.2, NU))
    for axis, signs in ((0, [1, 1, 1, -1, 1, -1]), (1, [1, 1, 1, -1, -1, 1])):
        mirrored = components(stress(np.flip(p, axis), grid, 0.2, NU))
        exact = np.flip(fields, axis + 1) * np.array(signs)[:, None, None]
        np.testing.assert_allclose(mirrored, exact, atol=1e-14)


def test_a_constant_pressure_on_a_periodic_body():
    """It cannot widen: -nu/(1 - nu) p sideways at every depth, and Hooke's thinning of what lies above."""
    grid = rc.Grid((6, 8), 0.5, True)
    s = stress(np.full((6, 8), 2.0), grid, 3.0, NU)
    np.testing.assert_allclose(s.zz, -2.0, rtol=1e-14)
    np.testing.assert_allclose(s.xx, -2.0 * NU / (1 - NU), rtol=1e-14)
    np.testing.assert_allclose(s.yy, s.xx, rtol=1e-14)
    u = displacement(np.full((6, 8), 2.0), grid, 3.0, BODY)
    strain = (-2.0 + 2 * NU * 2.0 * NU / (1 - NU)) / BODY.young_modulus
    np.testing.assert_allclose(u.z, 3.0 * strain, rtol=1e-13)


def test_many_periods_of_loads_are_a_periodic_body():
    """Cells and waves differ by dx^2/24 of the load's curvature; a patch lacks what lies beyond."""
    n, copies = 24, 15
    small = rc.Grid((n, n), 0.25, True)
    c = small.coordinates[0] - 3
    p = np.cos(2 * np.pi * c / 6.0) * np.cos(
        2 * np.pi * c[:, None] / 6.0
    )  # no resultant: fades beyond the patch
    wide = rc.Grid((n * copies, n * copies), 0.25)
    middle = slice(n * (copies // 2), n * (copies // 2 + 1))
    periodic = components(stress(p, small, 0.8, NU))
    free = components(stress(np.tile(p, (copies, copies)), wide, 0.8, NU))[:, middle, middle]
    np.testing.assert_allclose(free, periodic, atol=(0.25**2 / 24) * 2 * (2 * np.pi / 6) ** 2 + 1e-3)


@pytest.mark.parametrize("shape", [(7, 5), (8, 4), (1, 3), (5, 1)], ids=str)
@pytest.mark.parametrize("along", [0, 1])
def test_a_row_is_the_sum_of_its_images(shape, along):
    """Images up to the m-th on either side, extrapolated: what is missing is a series in powers of 1/(m + 1/2)."""
    grid = rc.Grid(shape, (0.3, 0.5), [axis == along for axis in (0, 1)])
    p = np.random.default_rng(0).standard_normal(shape)
    y, x = (np.arange(1 - n, n) for n in shape)
    counts, m = np.array([20, 40, 80, 160, 320]), np.arange(-320, 321)[:, None, None]
    shift = [m * grid.lengths[along] * (axis == along) for axis in (0, 1)]
    fields = love_stress(x * 0.5 + shift[1], y[:, None] * 0.3 + shift[0], 0.2, (0.3, 0.5), NU)
    sums = np.stack([fields[:, abs(m.ravel()) <= count].sum(1) for count in counts])
    # The middle between the last image and the next is where a continuous load would take over.
    steps = (counts[:, None] + 0.5) ** -np.arange(5.0)
    row = np.tensordot(np.linalg.inv(steps)[0], sums, 1)
    i, j = (k[..., None, None] for k in np.indices(shape))
    a, b = np.indices(shape)
    exact = (row[:, i - a + shape[0] - 1, j - b + shape[1] - 1] * p).sum((3, 4))
    mean = np.abs(p).sum() / p.size
    np.testing.assert_allclose(components(stress(p, grid, 0.2, NU)), exact, atol=2e-8 * mean)


def test_a_row_that_is_full_is_a_strip_in_plane_strain():
    """s_xx = -[theta - sin(2 theta)/2]/pi between the ends, s_zz with the other sign, s_yy = nu (s_xx + s_zz)."""
    z = 0.2
    s = row_stress_table((8, 30), (0.3, 0.5), z, NU).sum(1)
    ends = (np.arange(30) + 0.5) * 0.5, (np.arange(30) - 0.5) * 0.5
    angle, sine = (
        f(ends[0]) - f(ends[1]) for f in (lambda x: np.arctan2(x, z), lambda x: x * z / (x * x + z * z))
    )
    shear = -(ends[1] ** 2 / (ends[1] ** 2 + z * z) - ends[0] ** 2 / (ends[0] ** 2 + z * z)) / np.pi
    np.testing.assert_allclose(s[0], -(angle - sine) / np.pi, atol=2e-8)
    np.testing.assert_allclose(s[2], -(angle + sine) / np.pi, atol=2e-8)
    np.testing.assert_allclose(s[1], -2 * NU * angle / np.pi, atol=2e-8)
    np.testing.assert_allclose(np.abs(s[4]), np.abs(shear), atol=2e-8)
    np.testing.assert_allclose(s[[3, 5]], 0.0, atol=2e-8)


def test_the_row_s_equilibrium():
    grid = rc.Grid((8, 400), 0.25, (True, False))
    p = np.zeros(grid.shape)
    p[3, 200] = 4.0
    s = stress(p, grid, 0.8, NU)
    # Beyond x = 50 on either side a line load leaves (4/3 pi) (z/x)^3.
    assert -s.zz.sum() * grid.cell_area == pytest.approx(4.0 * grid.cell_area, rel=1e-5)
    assert singly_periodic(grid, 1.0).weights == grid.cell_area


def test_scale_laws():
    """Stresses follow the pressure and the shape, not the size; displacements the size and the modulus too."""
    p = np.random.default_rng(0).random((6, 9))
    base, small = (
        stress(p, rc.Grid((6, 9), (0.3, 0.5)), 0.2, NU),
        stress(2e9 * p, rc.Grid((6, 9), (3e-7, 5e-7)), 2e-7, NU),
    )
    np.testing.assert_allclose(components(small), 2e9 * components(base), rtol=1e-11, atol=1e-4)
    u = displacement(p, rc.Grid((6, 9), (0.3, 0.5)), 0.2, rc.Solid(2.6, NU)).z
    v = displacement(p, rc.Grid((6, 9), (3e-7, 5e-7)), 2e-7, rc.Solid(2.6e11, NU)).z
    np.testing.assert_allclose(v, 1e-17 * u, rtol=1e-11)


@pytest.mark.parametrize("periodic", [False, True, (True, False)], ids=str)
def test_several_depths_at_once(periodic):
    grid = rc.Grid((6, 9), (0.3, 0.5), periodic)
    p = np.random.default_rng(0).random((6, 9))
    depths = np.array([0.0, 0.1, 2.0])
    several = stress(p, grid, depths, NU)
    assert several.von_mises.shape == (3, 6, 9)
    assert several.principal.shape == (3, 6, 9, 3)
    for i, z in enumerate(depths):
        np.testing.assert_array_equal(components(several)[:, i], components(stress(p, grid, z, NU)))


GRID, P = rc.Grid((4, 5), 1.0), np.ones((4, 5))


@pytest.mark.parametrize(
    ("p", "grid", "depth", "nu", "message"),
    [
        (np.ones(5), rc.Grid(5, 1.0), 1.0, NU, "two axes"),
        (np.ones(5), rc.RadialGrid.uniform(5, 1.0), 1.0, NU, "two axes"),
        (P[:3], GRID, 1.0, NU, "does not fit"),
        (P * np.nan, GRID, 1.0, NU, "pressure must be finite"),
        (P, GRID, -1e-9, NU, "at least 0"),
        (P, GRID, np.inf, NU, "finite"),
        (P, GRID, [], NU, "a number or a list"),
        (P, GRID, np.ones((2, 2)), NU, "a number or a list"),
        (P, GRID, 1.0, 0.51, "poisson_ratio must lie"),
        (P, GRID, 1.0, -1.0, "poisson_ratio must lie"),
        (P, GRID, 1.0, np.nan, "poisson_ratio must lie"),
    ],
)
def test_nonsense_is_refused(p, grid, depth, nu, message):
    with pytest.raises(ValueError, match=message):
        stress(p, grid, depth, nu)


def test_displacements_need_a_body_and_a_bound():
    with pytest.raises(ValueError, match="elastic Solid"):
        displacement(P, GRID, 1.0, rc.Solid(np.inf, 0.3))
    with pytest.raises(ValueError, match="elastic Solid"):
        displacement(P, GRID, 1.0, 0.3)
    with pytest.raises(ValueError, match="have no bound"):
        displacement(P, rc.Grid((4, 5), 1.0, (True, False)), 1.0, BODY)
