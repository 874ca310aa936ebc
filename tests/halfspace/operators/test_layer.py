"""A layer on a base: waves against the equations of elasticity, cells against quadrature, spheres on thick and thin."""

from itertools import pairwise

import mpmath
import numpy as np
import pytest
from scipy.special import j0, j1

import roughcontact as rc
from roughcontact.halfspace.influence.layer_bases import Bonded, Frictionless, OnHalfSpace
from roughcontact.halfspace.influence.layer_kernel import layer_kernel
from roughcontact.halfspace.operators.layer import layer
from roughcontact.halfspace.operators.operator import is_semidefinite

STEEL, RUBBER, SOFT = rc.Solid(3.0, 0.3), rc.Solid(1.5, 0.5), rc.Solid(0.2, 0.4)
PAIRS = [(STEEL, SOFT), (RUBBER, STEEL), (rc.Solid(1.0, -0.4), SOFT)]
BASES = [
    Frictionless(),
    *(Bonded(nu) for nu in (-0.5, 0.3, 0.5)),
    *(OnHalfSpace(*pair) for pair in PAIRS),
    OnHalfSpace(rc.Solid(1e4, 0.3), rc.Solid(1.0, 0.3)),
    OnHalfSpace(rc.Solid(1e-4, 0.3), rc.Solid(1.0, 0.3)),
]
MODULUS = rc.reduced_modulus(STEEL)


def mode(t, solid):
    """Rows u_x, u_z, s_zz, t_xz of the four plane-strain solutions ~ cos x, exp(+-z) and z exp(+-z), at z = t.

    By the Papkovich-Neuber form 2G u = -grad(phi + z psi) + (0, 4 (1 - nu) psi), with harmonic phi and psi.
    """
    g, nu = solid.shear_modulus, solid.poisson_ratio
    columns = []
    for sign in (-1, 1):
        e = np.exp(sign * t)
        # phi = e^(sign z) cos x
        ux, uz = e / (2 * g), -sign * e / (2 * g)
        columns.append((ux, uz, -e, sign * e))
        # psi = e^(sign z) cos x
        ux = t * e / (2 * g)
        uz = (-(1 + sign * t) + 4 * (1 - nu)) * e / (2 * g)
        szz = (2 * (1 - nu) * sign - t) * e
        txz = (sign * t - (1 - 2 * nu)) * e
        columns.append((ux, uz, szz, txz))
    return np.array(columns).T


def by_elasticity(base, t):
    """The answer of a layer of thickness t to a wave of pressure cos x, from the conditions on its faces.

    u_x ~ sin x, u_z and s_zz ~ cos x, t_xz ~ sin x; z = 0 is the loaded face, z = t the base.
    """
    solid = {Frictionless: lambda: STEEL, Bonded: lambda: rc.Solid(2.0, base.poisson_ratio)}.get(
        type(base), lambda: base.layer
    )()
    top, bottom = mode(0.0, solid), mode(t, solid)
    rows, right = [top[2], top[3]], [-1.0, 0.0]
    if isinstance(base, Frictionless):
        rows += [bottom[1], bottom[3]]
    elif isinstance(base, Bonded):
        rows += [bottom[0], bottom[1]]
    if not isinstance(base, OnHalfSpace):
        coefficients = np.linalg.solve(np.array(rows), np.r_[right, 0, 0])
        return top[1] @ coefficients * rc.reduced_modulus(solid) / 2
    below = mode(0.0, base.base)[:, :2]  # what decays with depth
    matrix = np.zeros((6, 6))
    matrix[:2, :4] = rows
    matrix[2:, :4], matrix[2:, 4:] = bottom, -below
    coefficients = np.linalg.solve(matrix, np.r_[right, 0, 0, 0, 0])
    return top[1] @ coefficients[:4] * rc.reduced_modulus(solid) / 2


def transform(base, r, order):
    """The integrals of the deviation times J0(t r), or J1(t r)/(t r), by Gauss's rule on the real axis."""
    ends = np.r_[0, 2.0 ** np.arange(-40, 0), np.arange(1.0, 25.0)]
    width = 2.0 / max(r, 0.1)
    fine = [np.linspace(a, b, 2 + int((b - a) / width))[:-1] for a, b in pairwise(ends)]
    fine = np.r_[np.concatenate(fine), 24.0]
    nodes, weights = np.polynomial.legendre.leggauss(16)
    half = np.diff(fine) / 2
    t = (fine[:-1] + half)[:, None] + half[:, None] * nodes
    bessel = j0(t * r) if order == 0 else j1(t * r) / (t * r)
    return float((half[:, None] * weights * base.deviation(t) * bessel).sum())


@pytest.mark.parametrize("base", BASES, ids=str)
def test_waves_against_the_equations_of_elasticity(base):
    for t in (0.2, 1.0, 3.0):
        scale = max(1.0, float(base.ratio(np.array(t))))
        assert float(base.ratio(np.array(t))) == pytest.approx(by_elasticity(base, t), abs=1e-12 * scale)


@pytest.mark.parametrize("base", BASES, ids=str)
def test_no_digit_is_lost_at_any_wavelength(base):
    """The forms of the page in 50 digits, which some of them need: long waves leave little of their terms."""
    with mpmath.workdps(50):
        for t in (1e-6, 1e-3, 0.3, 0.99, 1.01, 4.0, 17.0):
            q = mpmath.mpf(t)
            if isinstance(base, Frictionless):
                exact = (mpmath.cosh(2 * q) - 1) / (mpmath.sinh(2 * q) + 2 * q)
            elif isinstance(base, Bonded):
                k = 3 - 4 * mpmath.mpf(base.poisson_ratio)
                exact = 2 * k * mpmath.sinh(2 * q) - 4 * q
                exact /= 2 * k * mpmath.cosh(2 * q) + 4 * q**2 + 1 + k**2
            else:
                one, two = (mpmath.mpf(s.poisson_ratio) for s in (base.layer, base.base))
                g1, g2 = (
                    mpmath.mpf(s.young_modulus) / (2 * (1 + nu))
                    for s, nu in ((base.layer, one), (base.base, two))
                )
                m, e = g1 / g2, mpmath.exp(-2 * q)
                lam = 1 - 4 * (1 - one) / (1 + m * (3 - 4 * two))
                rho = (m - 1) / (m + 3 - 4 * one)
                exact = (1 + 4 * q * rho * e - lam * rho * e**2) / (
                    1 - (lam + rho + 4 * rho * q**2) * e + lam * rho * e**2
                )
            assert float(base.ratio(np.array(t))) == pytest.approx(float(exact), rel=1e-14)
            change = float(exact - 1)
            assert float(base.deviation(np.array(t))) == pytest.approx(change, abs=1e-14 * (1 + abs(change)))


@pytest.mark.parametrize("base", BASES, ids=str)
def test_limits(base):
    """Short waves do not see the base, however short; under long ones the layer is a foundation or nothing."""
    assert float(base.ratio(np.array(1e5))) == pytest.approx(1.0, rel=1e-15)
    assert float(base.deviation(np.array(1e5))) == 0.0
    t = 1e-7
    if base.slope:
        assert float(base.ratio(np.array(t))) / t == pytest.approx(base.slope, rel=1e-6)
    elif isinstance(base, Bonded):
        assert float(base.ratio(np.array(t))) / t**3 == pytest.approx(2 / 3, rel=1e-6)
    else:
        ratio = rc.reduced_modulus(base.layer) / rc.reduced_modulus(base.base)
        assert float(base.ratio(np.array(1e-12))) == pytest.approx(ratio, rel=1e-6)


def test_a_base_of_the_same_solid_is_no_base_and_a_rigid_one_is_bonded():
    t = np.geomspace(1e-3, 30, 20)
    np.testing.assert_allclose(OnHalfSpace(STEEL, STEEL).ratio(t), 1.0, rtol=1e-15)
    rigid = OnHalfSpace(STEEL, rc.Solid(1e16, 0.1)).ratio(t)
    np.testing.assert_allclose(rigid, Bonded(0.3).ratio(t), rtol=1e-12)
    operator = layer(rc.Grid((4, 4), 1.0, True), STEEL, 1.0, base=rc.Solid(np.inf, 0.1))
    assert not is_semidefinite(operator)


@pytest.mark.parametrize("base", BASES, ids=str)
def test_the_kernel_against_its_integral(base):
    """Near, where it is a polynomial, and far, where 2000 oscillations cancel; relative to the half-space's 1/r."""
    kernel = layer_kernel(base.deviation, 400.0)
    most = max(1.0, float(base.ratio(np.array(1e-9))))
    for r in (0.01, 0.49, 0.51, 1.3, 4.0, 9.0, 31.0, 110.0, 399.0):
        exact = transform(base, r, 1)
        assert float(kernel(np.array([r]))[0]) == pytest.approx(exact, abs=1e-13 * most / max(r, 1))


@pytest.mark.parametrize("base", BASES, ids=str)
def test_the_least_of_the_kernel(base):
    """What `positive` stands on: 1 + r D at its smallest."""
    found = layer_kernel(base.deviation, 6.0).least
    sampled = min(1 + r * transform(base, r, 0) for r in np.linspace(0.01, 6.0, 40))
    most = max(1.0, float(base.ratio(np.array(1e-9))))
    assert found == pytest.approx(sampled, abs=2e-2 * most)
    assert (found > 0) == (sampled > 0) or abs(sampled) < 1e-3


@pytest.mark.parametrize(
    ("thickness", "spacing"), [(0.05, (1.0, 1.0)), (0.6, (0.4, 1.5)), (8.0, (1.5, 0.4))], ids=str
)
@pytest.mark.parametrize("base", ["rigid-frictionless", SOFT], ids=str)
def test_cells_against_quadrature(base, spacing, thickness):
    """Thin and thick against the cell; D by its own integral, over the cell by Gauss's rule on parts."""
    influence = layer(rc.Grid((12, 12), spacing), STEEL, thickness, base=base).influence.influence
    table = influence.table((12, 12))
    rows, columns = np.indices(table.shape)
    np.testing.assert_allclose(influence.at(rows, columns), table, rtol=0, atol=2e-14 * table.max())
    nodes, weights = np.polynomial.legendre.leggauss(12)
    for i, j in ((0, 2), (3, 1), (7, 6)):
        parts = 8
        u = ((nodes + 1) / 2 + np.arange(parts)[:, None]).ravel() / parts - 0.5
        w = np.tile(weights, parts) / (2 * parts)
        r = np.hypot((j + u) * spacing[1], (i + u)[:, None] * spacing[0])
        # D on a line, smooth at all these distances, as a polynomial in the logarithm of r
        d = np.polynomial.chebyshev.Chebyshev.interpolate(
            lambda logs: [
                transform(influence.stack.base, np.exp(v) / thickness, 0) / thickness for v in logs
            ],
            40,
            domain=[np.log(r.min()), np.log(r.max())],
        )
        exact = (w[:, None] * w * (1 / r + d(np.log(r)))).sum() * np.prod(spacing) / (np.pi * MODULUS)
        # The polynomial of degree 40 in a thin layer's far side is what limits this.
        assert table[i, j] == pytest.approx(exact, abs=1e-11 * table[0, 0])


def test_a_table_of_many_rows_is_its_single_values_to_the_last():
    """It is made some rows at a time: of a narrow strip more than there are columns."""
    influence = layer(rc.Grid((33_000, 2), (0.1, 0.15)), STEEL, 4.0, base=SOFT).influence.influence
    table = influence.table((33_000, 2))
    rows, columns = np.array([0, 7_000, 9_000, 32_767, 32_768, 32_999])[:, None], np.arange(2)
    found = table[rows, columns]
    np.testing.assert_allclose(influence.at(rows, columns), found, rtol=0, atol=2e-14 * table.max())


@pytest.mark.parametrize("thickness", [0.003, 0.5])
@pytest.mark.parametrize(
    ("solid", "base"), [(STEEL, "rigid-frictionless"), (STEEL, "bonded"), (RUBBER, "bonded")]
)
def test_a_wide_pressure_meets_a_foundation(solid, base, thickness):
    """u = p h/E*, p h (1 + nu)(1 - 2 nu)/((1 - nu) E), or nothing; beyond 21 metres exp(-0.8 * 21/h) is missing."""
    n = 61
    u = layer(rc.Grid((n, n), (1.0, 0.7)), solid, thickness, base=base).apply(np.ones((n, n)))[n // 2, n // 2]
    e, nu = solid.young_modulus, solid.poisson_ratio
    soft = (1 - nu**2) / e if base == "rigid-frictionless" else (1 + nu) * (1 - 2 * nu) / ((1 - nu) * e)
    # Love's integrals, of the size of a cell, cancel: 1e-13 of them is left.
    assert u == pytest.approx(thickness * soft, abs=1e-13)


def sphere(n, radius, side, offset=0.0):
    grid = rc.Grid((n, n), side / n)
    x = grid.coordinates[0] - side / 2 - offset
    return rc.Surface(-(x[:, None] ** 2 + x**2) / (2 * radius), grid)


@pytest.mark.parametrize("base", ["rigid-frictionless", "bonded", SOFT], ids=str)
def test_on_a_thick_layer_a_sphere_is_hertz(base):
    """A base far below moves the whole contact by F D(0)/(pi E*); what is left is of the order (a/h)^3."""
    surface = sphere(49, 1.0, 1.2)  # a cell under the apex
    alone = rc.press(surface, MODULUS, force=0.2, tolerance=1e-10)
    a = rc.theory.hertz.point(modulus=MODULUS, radius=1.0, force=0.2).contact_radius
    errors = []
    for h in (6.0, 12.0):
        operator = layer(surface.grid, STEEL, h, base=base)
        s = rc.press(surface, MODULUS, force=0.2, operator=operator, tolerance=1e-10)
        shift = 0.2 * transform(operator.influence.influence.stack.base, 1e-9, 0) / (h * np.pi * MODULUS)
        errors.append([abs(s.depth - shift - alone.depth) / alone.depth, np.ptp(s.pressure - alone.pressure)])
        assert errors[-1][0] < 3 * (a / h) ** 3 * max(1, MODULUS / rc.reduced_modulus(SOFT) / 10)
    assert errors[0][1] / errors[1][1] > 6
    assert alone.depth == pytest.approx(a**2, rel=4e-4)  # (dx/a)^2/12


@pytest.mark.parametrize("base", ["rigid-frictionless", "bonded"])
def test_on_a_thin_layer_a_sphere_meets_springs(base):
    """F = pi K R d^2/h with K = E* or E*(1 - nu)^2/(1 - 2 nu), and a^2 = 2 R d, to the orders (h/a)^2 and h/a."""
    surface = sphere(81, 10.0, 2.0)
    stiffness = MODULUS * (1.0 if base == "rigid-frictionless" else 0.7**2 / 0.4)
    a = np.sqrt(2 * 10.0 * 0.03)
    errors = []
    for h in (0.1, 0.05):
        s = rc.press(surface, MODULUS, depth=0.03, operator=layer(surface.grid, STEEL, h, base=base))
        errors.append(
            (s.force / (np.pi * stiffness * 10.0 * 0.03**2 / h) - 1, s.contact_area / (np.pi * a**2) - 1)
        )
        assert abs(errors[-1][0]) < (h / a) ** 2
        assert abs(errors[-1][1]) < h / a
    assert errors[0][0] / errors[1][0] > 3
    assert errors[0][1] / errors[1][1] > 1.5


@pytest.mark.parametrize("base", ["rigid-frictionless", "bonded"])
def test_periodic_and_free_are_one_body(base):
    """On a rigid base neighbours fade; cells and waves differ by dx^2/24 of the load's curvature, 2/0.09."""
    errors = []
    for n in (64, 128):
        grid = rc.Grid((n, n), 4 / n, True)
        x = grid.coordinates[0] - 2
        p = np.exp(-(x[:, None] ** 2 + x**2) / 0.18)
        periodic = layer(grid, STEEL, 0.3, base=base).apply(p)
        free = layer(rc.Grid((n, n), 4 / n), STEEL, 0.3, base=base).apply(p)
        errors.append(np.abs(free - periodic).max() / periodic.max())
    assert errors[1] < (4 / 128) ** 2 / 24 * 2 / 0.09
    assert errors[0] / errors[1] > 3.4  # order two, and a part of order three from the pole of 1/r


@pytest.mark.parametrize("base", ["rigid-frictionless", "bonded", STEEL], ids=str)
def test_periodic_layers_take_single_precision(base):
    """Single precision: 6e-8, times what a transform of some hundred values adds up."""
    operator = layer(rc.Grid((12, 20), (0.3, 0.5), True), rc.Solid(2.0, 0.3), 0.8, base=base)
    pressure = np.random.default_rng(0).random((12, 20))
    found, expected = operator.apply(pressure.astype(np.float32)), operator.apply(pressure)
    assert found.dtype == np.float32
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-5 * np.abs(expected).max())


@pytest.mark.parametrize(
    ("base", "thickness", "positive"),
    [("rigid-frictionless", 0.5, False), ("bonded", 0.5, False), (SOFT, 0.5, True), ("bonded", 500.0, True)],
    ids=str,
)
def test_positive_is_true_of_the_table(base, thickness, positive):
    """Rigid bases let a layer bulge some thicknesses away; a thick one on this small grid does not."""
    operator = layer(rc.Grid((20, 20), 0.3), STEEL, thickness, base=base)
    assert operator.positive is positive
    assert bool(operator.influence.table((20, 20)).min() >= 0) is positive


def test_an_incompressible_layer_bulges_beside_a_load():
    u = layer(rc.Grid((1, 40), 0.1), RUBBER, 0.5, base="bonded").apply(np.eye(1, 40))
    assert u[0, 0] > 0
    assert u.min() < -0.005 * u[0, 0]


def test_a_rigid_base_stops_full_contact():
    """In full contact the mean pressure is that of a foundation: there is no depth that a periodic layer refuses."""
    grid = rc.Grid((16, 16), 0.25, True)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-3, rng=np.random.default_rng(0))
    operator = layer(grid, STEEL, 0.5, base="rigid-frictionless")
    mean = rough.heights.max() - rough.heights.mean()
    s = rc.press(rough, MODULUS, depth=5 * mean, operator=operator)
    assert s.contact_fraction == 1.0
    assert s.force / grid.area == pytest.approx(4 * mean * MODULUS / 0.5, rel=1e-9)
    assert s.stiffness == pytest.approx(grid.area * MODULUS / 0.5, rel=1e-9)


@pytest.mark.parametrize(("solid", "base"), [(RUBBER, "bonded"), (STEEL, SOFT)])
def test_where_a_constant_pressure_moves_nothing_full_contact_is_the_limit(solid, base):
    grid = rc.Grid((16, 16), 0.25, True)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-3, rng=np.random.default_rng(0))
    operator = layer(grid, solid, 0.5, base=base)
    np.testing.assert_allclose(operator.apply(np.full((16, 16), 3.0)), 0.0, atol=1e-15)
    mean = rough.heights.max() - rough.heights.mean()
    with pytest.raises(ValueError, match="exceeds the mean separation"):
        rc.press(rough, MODULUS, depth=1.1 * mean, operator=operator)


@pytest.mark.parametrize("periodic", [False, True])
def test_the_other_body_adds_its_own(periodic):
    grid = rc.Grid((9, 12), (0.3, 0.5), periodic)
    p = np.random.default_rng(0).random((9, 12))
    both = layer(grid, STEEL, 0.5, base="bonded", against=SOFT).apply(p)
    alone = layer(grid, STEEL, 0.5, base="bonded").apply(p)
    np.testing.assert_allclose(both, alone + rc.half_space(grid, SOFT).apply(p), rtol=1e-12, atol=1e-14)


def test_scale_laws():
    p = np.random.default_rng(0).random((9, 12))
    base = layer(rc.Grid((9, 12), (0.3, 0.5)), 2.0, 0.4, base="rigid-frictionless").apply(p)
    small = layer(rc.Grid((9, 12), (3e-7, 5e-7)), 2.0, 4e-7, base="rigid-frictionless").apply(p)
    stiff = layer(rc.Grid((9, 12), (0.3, 0.5)), 2e11, 0.4, base="rigid-frictionless").apply(p)
    np.testing.assert_allclose(small, base * 1e-6, rtol=1e-11, atol=1e-20)
    np.testing.assert_allclose(stiff, base * 1e-11, rtol=1e-11, atol=1e-25)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize(
    ("solid", "base"), [(STEEL, "rigid-frictionless"), (RUBBER, "bonded"), (STEEL, SOFT)]
)
def test_rough_layers(solid, base, periodic):
    """Curves, both solvers, and a stiffness between the secants, bulging or not."""
    grid = rc.Grid((32, 32), 1e-6, periodic)
    rough = rc.self_affine(rc.Grid((32, 32), 1e-6, True), hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    surface, operator = rc.Surface(rough.heights, grid), layer(grid, solid, 4e-6, base=base)
    curve = rc.loading_curve(surface, MODULUS, pressures=np.geomspace(1e-4, 3e-2, 6), operator=operator)
    assert (np.diff(curve.depth) > 0).all()
    # The mean over a step, and half of what one cell that comes or goes changes in it.
    assert (curve.secant_stiffness >= curve.stiffness[:-1] * (1 - 1e-6)).all()
    assert (curve.secant_stiffness <= curve.stiffness[1:] * (1 + 1e-6)).all()
    found = [
        rc.press(
            surface, MODULUS, force=float(curve.force[3]), operator=operator, solver=solver, tolerance=1e-9
        )
        for solver in (rc.ActiveSet(), rc.PolonskyKeer())
    ]
    np.testing.assert_allclose(found[0].pressure, found[1].pressure, atol=1e-5 * found[0].pressure.max())


GRID = rc.Grid((8, 8), 1.0)


@pytest.mark.parametrize(
    ("grid", "modulus", "thickness", "more", "message"),
    [
        (rc.Grid(8, 1.0), STEEL, 1.0, {}, "two axes"),
        (rc.RadialGrid.uniform(8, 1.0), STEEL, 1.0, {}, "two axes"),
        (rc.Grid((8, 8), 1.0, (True, False)), STEEL, 1.0, {}, "both axes"),
        (GRID, STEEL, 0.0, {}, "thickness must be positive"),
        (GRID, STEEL, np.inf, {}, "thickness must be positive and finite"),
        (GRID, 2.0, 1.0, {}, "Poisson's ratio too"),
        (GRID, 2.0, 1.0, {"base": SOFT}, "Poisson's ratio too"),
        (GRID, STEEL, 1.0, {"base": "glued"}, "base must be"),
        (GRID, (STEEL, SOFT), 1.0, {}, "against="),
        (GRID, rc.Solid(np.inf, 0.3), 1.0, {}, "reduced modulus"),
        (GRID, -1.0, 1.0, {"base": "rigid-frictionless"}, "modulus must be positive"),
    ],
)
def test_nonsense_is_refused(grid, modulus, thickness, more, message):
    with pytest.raises(ValueError, match=message):
        layer(grid, modulus, thickness, **({"base": "bonded"} | more))
