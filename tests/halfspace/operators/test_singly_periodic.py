"""One periodic axis: the sum over images against its other forms, spheres in a row, cylinders."""

import functools

import mpmath
import numpy as np
import pytest
from scipy.special import eval_legendre, k0, zeta

import roughcontact as rc
import roughcontact.halfspace.influence.love_singly_periodic as kernel
from roughcontact.halfspace.influence.love_singly_periodic import repeated_love
from roughcontact.halfspace.operators.build import singly_periodic

MODULUS, PERIOD = 2.0, 1.7
PAGE = 2 * np.exp(-np.euler_gamma) * PERIOD  # the reference length that takes 1/(|m| period) from each image


def images(x, y, count=100):
    """The sum itself, image by image, and the first three powers of what is left beyond them."""
    m = np.arange(1, count)[:, None, None] * PERIOD
    r = np.hypot(x, y)
    value = 1 / r + (1 / np.hypot(x, y + m) + 1 / np.hypot(x, y - m) - 2 / m).sum(0)
    for power in (2, 4, 6):
        value += 2 * (r / PERIOD) ** power * eval_legendre(power, y / r) * zeta(power + 1, count) / PERIOD
    return value


def waves(x, y, count=20):
    """The same by waves along the row; from half a period off it the next is below 1e-25."""
    n = np.arange(1, count)[:, None, None]
    q = 2 * np.pi / PERIOD
    value = -2 / PERIOD * (np.euler_gamma + np.log(np.abs(x) / (2 * PERIOD)))
    return value + 4 / PERIOD * (k0(n * q * np.abs(x)) * np.cos(n * q * y)).sum(0)


def over_cell(form, x, y, cell, parts):
    """Gauss's rule on parts of a cell."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    sides = [((nodes + 1) / 2 + np.arange(parts)[:, None]).ravel() / parts - 0.5 for _ in cell]
    weights = np.tile(weights, parts) / (2 * parts)
    u, v = x + sides[0] * cell[0], y + sides[1][:, None] * cell[1]
    return cell[0] * cell[1] * (weights[:, None] * weights * form(u, v)).sum()


def sphere_in_a_row(rows, across, force=0.2):
    """A sphere of radius 1 on cells of 1/32, repeated every `rows` cells along y."""
    grid = rc.Grid((rows, across), 1 / 32, (True, False))
    y, x = (c - length / 2 for c, length in zip(grid.coordinates, grid.lengths, strict=True))
    surface = rc.Surface(-(y[:, None] ** 2 + x**2) / 2, grid)
    return rc.press(surface, MODULUS, force=force, operator=singly_periodic(grid, MODULUS), tolerance=1e-10)


def cylinder(shape, periodic, axis, **options):
    """A cylinder of radius 1 under a force of 1 per unit length, its axis along `axis`."""
    grid = rc.Grid(shape, (4 / shape[0], 4 / shape[1]), periodic)
    x = grid.coordinates[1 - axis] - 2
    heights = np.broadcast_to(np.expand_dims(-(x**2) / 2, axis), shape).copy()
    operator = singly_periodic(grid, MODULUS, **options)
    return rc.press(rc.Surface(heights, grid), MODULUS, force=4.0, operator=operator, tolerance=1e-11)


@pytest.mark.parametrize("place", [(0.9, 0.1), (1.0, 0.8), (1.2, -0.5)])
def test_the_three_forms_of_the_sum_agree(place):
    """Two of them here, both evaluated where both hold; the images' next power is (r/100 periods)^8."""
    x, y = (np.full((1, 1), v) for v in place)
    assert images(x, y)[0, 0] == pytest.approx(waves(x, y)[0, 0], abs=1e-12)


CELLS = [(0.1, 0.2), (0.3, PERIOD), (2.5, 0.17), (0.4, 0.425)]
PLACES = [(0.0, 0.45), (0.3, 0.6), (0.8499, 0.8), (0.8501, 0.8), (0.7, -3.1), (1.6, 0.85), (5.0, 0.2)]
# The quadrature has no closed form for its own cell.
PAIRS = [(p, c) for p in PLACES for c in CELLS if p[0] >= c[0] or abs(p[1]) >= c[1]]


@pytest.mark.parametrize(("place", "cell"), PAIRS, ids=str)
def test_cells_against_quadrature(place, cell):
    """Near and far from the row, in another period, on cells that are larger than a period or fill it."""
    near = place[0] - cell[0] / 2 < 0.8
    exact = over_cell(images if near else waves, *place, cell, 8 if max(cell) > 1 else 3)
    found = repeated_love(*place, cell, PERIOD, PAGE)[0]
    # A mean value over the cell, in units of 1/period: ten units in the last place of the largest term, 1/r = 7.
    assert found == pytest.approx(exact, abs=1e-13 * cell[0] * cell[1])


def test_the_cell_itself():
    """Love's closed form and the rest of the row, which is smooth there."""
    cell = (0.02, 0.03)
    own = 2 * cell[0] * np.arcsinh(cell[1] / cell[0]) + 2 * cell[1] * np.arcsinh(cell[0] / cell[1])
    rest = over_cell(lambda x, y: images(x, y) - 1 / np.hypot(x, y), 0.0, 0.0, cell, 1)
    assert repeated_love(0.0, 0.0, cell, PERIOD, PAGE)[0] == pytest.approx(own + rest, rel=1e-13)


def row_by_images(x, y, a, b):
    """Love's integral in 30 digits, image by image; the rest of M is a series in (M + 1/2)^-2, taken to its limit."""

    def primitive(x, y):
        parts = ((x, y), (y, x))
        return mpmath.fsum(v * mpmath.asinh(w / abs(v)) for v, w in parts if v != 0)

    def love(y):
        corners = ((sx * sy, x + sx * a / 2, y + sy * b / 2) for sx in (1, -1) for sy in (1, -1))
        return mpmath.fsum(sign * primitive(u, v) for sign, u, v in corners)

    value, row = love(y), []
    for m in range(1, 61):
        value += love(y + m) + love(y - m) - 2 * a * b / m
        if m % 6 == 0:
            row.append((mpmath.mpf(m) + 0.5, value))
    at = [m**-2 for m, _ in row]
    limits = [value for _, value in row]
    for order in range(1, len(row)):
        limits = [
            (at[i + order] * limits[i] - at[i] * limits[i + 1]) / (at[i + order] - at[i])
            for i in range(len(limits) - 1)
        ]
    return limits[0]


@functools.cache  # of a few edges, for cells of any width along the row
def wave_beyond(z):
    return mpmath.quad(lambda t: mpmath.exp(-z * mpmath.cosh(t)) / mpmath.cosh(t), [0, 2, 5])


def row_by_lines(x, y, a, b):
    """A line load, the lines' own period (Clausen's function), and waves from the edges on, none of it near the row."""
    q = 2 * mpmath.pi

    def waves_beyond(edge):
        terms = []
        for n in range(1, 13):
            wave = wave_beyond(n * q * edge) / (n * q)
            terms.append(4 * b * mpmath.sincpi(n * b) * mpmath.cos(n * q * y) * wave)
        return mpmath.fsum(terms)

    start, stop = x - a / 2, x + a / 2
    logs = [edge * (mpmath.log(abs(edge)) - 1) for edge in (start, stop)]
    value = -2 * b * (logs[1] - logs[0] + a * (mpmath.euler - mpmath.log(2)))
    if start > 0:
        return value + waves_beyond(start) - waves_beyond(stop)
    turns = [mpmath.clsin(2, q * (y + half)) for half in (-b / 2, b / 2)]
    return value + 2 / q * (turns[1] - turns[0]) - waves_beyond(-start) - waves_beyond(stop)


@pytest.mark.parametrize("along", [1.0, 0.5, 0.02])
@pytest.mark.parametrize("ratio", [1e-3, 0.03, 0.26, 0.6, 1.0, 4.0, 100.0, 1e4])
def test_cells_of_any_length_over_the_period(ratio, along):
    """Against 30 digits, by images up to one period and by lines from it on: where both serve, they agree."""
    page = float(2 * mpmath.exp(-mpmath.euler))
    with mpmath.workdps(30):
        for place in ((0, 0), (1, 0), (1, 1), (4, 1)):
            x, y, a, b = (mpmath.mpf(v) for v in (place[0] * ratio, place[1] * along, ratio, along))
            truths = [
                form(x, y, a, b)
                for form, serves in ((row_by_images, ratio <= 1), (row_by_lines, ratio >= 1))
                if serves
            ]
            assert abs(truths[0] - truths[-1]) <= 1e-14 * ratio * along
            found = repeated_love(float(x), float(y), (ratio, along), 1.0, page)[0]
            # Fifty terms of which none is larger than the whole, or than the constant of the row.
            assert abs(found - truths[0]) <= 50 * 2.3e-16 * max(abs(truths[0]), ratio * along)


def test_the_work_does_not_grow_with_cells_over_the_period(monkeypatch):
    """Values by either form in a table of 12 cells: as many for cells of two periods as for those of ten thousand."""
    counts = dict.fromkeys(("_images", "_waves"), 0)

    def counted(name):
        form = getattr(kernel, name)

        def count(x, y, *rest):
            counts[name] += np.broadcast(x, y).size
            return form(x, y, *rest)

        return count

    for name in counts:
        monkeypatch.setattr(kernel, name, counted(name))
    totals = []
    for ratio in (2.0, 1e3, 1e4):
        for name in counts:
            counts[name] = 0
        singly_periodic(rc.Grid((1, 12), (1.0, ratio), (True, False)), MODULUS).influence.table((1, 12))
        totals.append(dict(counts))
    assert totals[0] == totals[1] == totals[2]
    assert totals[0]["_images"] <= 16  # one cell holds the row: its nearest period, in four by four pieces
    assert totals[0]["_waves"] <= 11 + 2


def test_a_table_is_its_single_values():
    x, y = np.arange(60) * 0.11, np.arange(9)[:, None] * 0.13
    table = repeated_love(x, y, (0.11, 0.13), PERIOD, 9.0)
    flat = repeated_love(
        *(np.broadcast_to(v, table.shape).ravel() for v in (x, y)), (0.11, 0.13), PERIOD, 9.0
    )
    np.testing.assert_allclose(table.ravel(), flat, rtol=1e-13, atol=1e-16)


def test_far_from_the_row_it_is_a_line_load():
    """u = (2 P/pi E*) ln(L_ref/x) with P the force per length; the next term is (dx/x)^2/24."""
    grid = rc.Grid((8, 400), (0.1, 0.05), (True, False))
    p = np.zeros(grid.shape)
    p[3, 0] = 3.0
    line, x = 3.0 * grid.cell_area / 0.8, 399 * 0.05
    exact = 2 * line / (np.pi * MODULUS) * np.log(30.0 / x)
    found = singly_periodic(grid, MODULUS, reference_length=30.0).apply(p)[:, -1]
    np.testing.assert_allclose(found, exact, rtol=(0.05 / x) ** 2)


@pytest.mark.parametrize("shape", [(4, 300), (300, 4), (64, 64), (1, 50), (50, 1)], ids=str)
def test_no_pressure_lifts_any_cell(shape):
    """The default reference length is beyond the last cell, in long grids along either axis; monotone decay to it."""
    table = singly_periodic(rc.Grid(shape, 0.1, (True, False)), MODULUS).influence.table(shape)
    assert table.min() > 0
    half = table[: shape[0] // 2 + 1]
    assert (np.diff(half, axis=0) <= 1e-14 * half[0, 0]).all()
    assert (np.diff(half, axis=1) < 0).all()


def test_a_constant_pressure_presses_down():
    """Unlike on a grid that is periodic along both axes, it is no exception: the strip has two free edges."""
    operator = singly_periodic(rc.Grid((16, 20), 0.1, (True, False)), MODULUS)
    u = operator.apply(np.ones((16, 20)))
    assert u.min() > 0
    np.testing.assert_allclose(u, np.broadcast_to(u[:1], u.shape), rtol=1e-13)


def test_both_axes_are_alike():
    p = np.random.default_rng(0).random((12, 9))
    along_y = singly_periodic(rc.Grid((12, 9), (0.3, 0.5), (True, False)), MODULUS).apply(p)
    along_x = singly_periodic(rc.Grid((9, 12), (0.5, 0.3), (False, True)), MODULUS).apply(p.T)
    np.testing.assert_allclose(along_x.T, along_y, rtol=1e-13)


def test_a_window_keeps_the_period_that_it_holds():
    grid = rc.Grid((12, 30), (0.3, 0.5), (True, False))
    operator = singly_periodic(grid, MODULUS)
    part = operator.restrict((slice(0, 12), slice(4, 11)))
    assert part.grid.periodic == (True, False)
    p = np.zeros(grid.shape)
    p[:, 4:11] = np.random.default_rng(0).random((12, 7))
    np.testing.assert_allclose(part.apply(p[:, 4:11]), operator.apply(p)[:, 4:11], rtol=1e-13)


def test_scale_laws():
    p = np.random.default_rng(0).random((12, 9))
    base = singly_periodic(rc.Grid((12, 9), (0.3, 0.5), (True, False)), 2.0).apply(p)
    small = singly_periodic(rc.Grid((12, 9), (3e-7, 5e-7), (True, False)), 2.0).apply(p)
    stiff = singly_periodic(rc.Grid((12, 9), (0.3, 0.5), (True, False)), 2e11).apply(p)
    np.testing.assert_allclose(small, base * 1e-6, rtol=1e-12)
    np.testing.assert_allclose(stiff, base * 1e-11, rtol=1e-12)


def test_spheres_far_apart_are_alone():
    """Images add a constant and then a term of 2 zeta(3) (r/period)^3/r: eight times less at twice the distance."""
    free = rc.Grid((40, 40), 1 / 32)
    y = free.coordinates[0] - free.lengths[0] / 2
    alone = rc.press(rc.Surface(-(y[:, None] ** 2 + y**2) / 2, free), MODULUS, force=0.2, tolerance=1e-10)
    errors = []
    for rows in (64, 128):
        s = sphere_in_a_row(rows, 40)
        period, reference = s.problem.grid.lengths[0], s.problem.operator.influence.influence.reference
        row = 2 * 0.2 / (np.pi * MODULUS * period) * (np.euler_gamma + np.log(reference / (2 * period)))
        middle = s.pressure[rows // 2 - 20 : rows // 2 + 20]
        inside = np.hypot(y[:, None], y) < 0.2  # at the edge, cells come and go
        errors.append((s.depth - row - alone.depth, np.abs(middle - alone.pressure)[inside].max()))
        radius = np.sqrt(s.contact_area / np.pi)
        bound = 2 * zeta(3) * (radius / period) ** 3
        assert abs(errors[-1][0]) < bound * alone.depth
        assert errors[-1][1] < bound * alone.pressure.max()
    assert errors[0][1] / errors[1][1] > 7


def test_spheres_in_a_row_press_each_other_down():
    """Under the same force, neighbours close by leave each a smaller contact under a higher pressure."""
    near, far = sphere_in_a_row(24, 40), sphere_in_a_row(48, 40)
    assert near.contact_area < far.contact_area
    assert near.pressure.max() > far.pressure.max()


@pytest.mark.parametrize(
    ("shape", "periodic", "axis"), [((6, 200), (True, False), 0), ((200, 6), (False, True), 1)]
)
def test_a_cylinder_is_a_line_contact(shape, periodic, axis):
    """a^2 = 4 P R/(pi E*), d = (P/pi E*)(2 ln(2 L_ref/a) + 1); the grid's error is of order (dx/a)^2 = 6e-4."""
    s = cylinder(shape, periodic, axis, reference_length=10.0)
    a = np.sqrt(4 / (np.pi * MODULUS))
    depth = (2 * np.log(2 * 10.0 / a) + 1) / (np.pi * MODULUS)
    assert s.depth == pytest.approx(depth, rel=1e-4)
    across = np.moveaxis(s.pressure, axis, 0)
    np.testing.assert_allclose(across, np.broadcast_to(across[:1], across.shape), atol=1e-9)
    x = s.problem.grid.coordinates[1 - axis] - 2
    exact = 2 / (np.pi * a) * np.sqrt(np.maximum(1 - (x / a) ** 2, 0))
    inside = np.abs(x) < a / 2
    np.testing.assert_allclose(across[0][inside], exact[inside], rtol=2e-4)


def test_a_cylinder_has_the_line_s_depth_for_the_same_reference():
    """Up to the means over cells that the line takes where the plane takes values: (dx/a)^2/12 of the depth."""
    s = cylinder((4, 200), (True, False), 0, reference_length=10.0)
    grid = rc.Grid(200, 0.02)
    surface = rc.Surface(-((grid.coordinates[0] - 2) ** 2) / 2, grid)
    line = rc.press(surface, MODULUS, force=1.0, operator=rc.line(grid, MODULUS, reference_length=10.0))
    assert s.depth == pytest.approx(line.depth, rel=5e-5)
    assert s.stiffness / 4.0 == pytest.approx(line.stiffness, rel=5e-3)  # the edge moves by a part of a cell


def test_another_reference_length_shifts_the_depth_alone():
    """By 2 F ln(10)/(pi E* period) a decade."""
    near = cylinder((4, 100), (True, False), 0, reference_length=10.0)
    far = cylinder((4, 100), (True, False), 0, reference_length=100.0)
    np.testing.assert_allclose(far.pressure, near.pressure, atol=1e-9)
    assert far.depth - near.depth == pytest.approx(2 * np.log(10) / (np.pi * MODULUS), rel=1e-10)


def test_a_rough_strip():
    """Curves, both solvers, and a stiffness between the secants."""
    grid = rc.Grid((48, 64), 1e-6, (True, False))
    rough = rc.self_affine(rc.Grid((48, 64), 1e-6, True), hurst=0.8, rms=1e-6, rng=np.random.default_rng(0))
    surface, operator = rc.Surface(rough.heights, grid), singly_periodic(grid, 1e9)
    curve = rc.loading_curve(surface, 1e9, pressures=np.geomspace(1e5, 1e8, 8), operator=operator)
    assert (np.diff(curve.depth) > 0).all()
    assert (curve.secant_stiffness >= curve.stiffness[:-1] * (1 - 1e-6)).all()
    assert (curve.secant_stiffness <= curve.stiffness[1:] * (1 + 1e-6)).all()
    for solver in (rc.ActiveSet(), rc.PolonskyKeer()):
        s = rc.press(
            surface, 1e9, depth=float(curve.depth[4]), operator=operator, solver=solver, tolerance=1e-9
        )
        assert s.force == pytest.approx(curve.force[4], rel=1e-6)


@pytest.mark.parametrize(
    ("grid", "reference", "message"),
    [
        (rc.Grid(8, 1.0, True), None, "two axes that is periodic along one"),
        (rc.Grid((8, 8), 1.0), None, "periodic along one"),
        (rc.Grid((8, 8), 1.0, True), None, "periodic along one"),
        (
            rc.Grid((8, 6), 1.0, (False, True)),
            8.5,
            "at least the longest distance on the grid, 8.544003745 m",
        ),
        (rc.Grid((8, 6), 1.0, (False, True)), np.inf, "finite"),
        (rc.RadialGrid.uniform(4, 1.0), None, "two axes"),
    ],
)
def test_nonsense_is_refused(grid, reference, message):
    with pytest.raises(ValueError, match=message):
        singly_periodic(grid, MODULUS, reference_length=reference)
