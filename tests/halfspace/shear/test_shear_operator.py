"""The contract of every operator from tangential traction to tangential displacement."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.influence.cerruti import cerruti
from roughcontact.halfspace.operators.operator import capabilities
from roughcontact.halfspace.shear.shear_operator import ShearOperator, dundurs_parameter, shear_half_space

SHAPES = [(1, 1), (1, 6), (7, 5), (8, 8), (13, 2), (33, 20), (6, 75)]
METHODS = {False: ("fft", "dense", "moving-grid", "multilevel"), True: ("fft", "dense")}
CASES = [
    (shape, periodic, method) for shape in SHAPES for periodic in METHODS for method in METHODS[periodic]
]
INEXACT = 2e-5  # of the largest displacement, under noise of both signs: see test_shear_multilevel.py
SPACING = (0.3, 0.5)
FIRST, SECOND = rc.Solid(2.0, 0.3), rc.Solid(3.0, -0.4)


@pytest.fixture(params=CASES, ids=str)
def operator(request):
    shape, periodic, method = request.param
    return shear_half_space(rc.Grid(shape, SPACING, periodic), (FIRST, SECOND), method=method)


def fields(operator, count=2, seed=0):
    return np.random.default_rng(seed).standard_normal((count, 2, *operator.grid.shape))


def close(a, b, scale=1.0):
    """Equal up to the rounding of a transform: some ten units in the last place of the largest value."""
    np.testing.assert_allclose(a, b, rtol=0, atol=1e-14 * scale)


def close_to_exact(operator, a, b, scale=1.0):
    """The same where the sum is exact; else as near as it claims to be."""
    inexact = INEXACT * np.abs(b).max() if capabilities(operator).exact else 0.0
    np.testing.assert_allclose(a, b, rtol=0, atol=1e-14 * scale + inexact)


def one_body(grid, body, traction):
    """Return the displacement of one half-space by a plain sum, from Johnson's form of Cerruti's solution."""
    y, x = (c.ravel() for c in np.meshgrid(*grid.coordinates, indexing="ij"))
    along, across, cross = cerruti(x[:, None] - x, y[:, None] - y, *grid.spacing[::-1])
    nu, scale = body.poisson_ratio, 1 / (2 * np.pi * body.shear_modulus)
    qx, qy = traction.reshape(2, -1)
    straight = (1 - nu) * (along + across)
    ux = (straight + nu * along) @ qx + nu * cross @ qy
    uy = (straight + nu * across) @ qy + nu * cross @ qx
    return scale * np.stack([ux, uy]).reshape(traction.shape)


def test_it_is_an_operator(operator):
    assert isinstance(operator, ShearOperator)
    assert operator.weights == pytest.approx(0.15)


def test_linear(operator):
    p, q = fields(operator)
    close(operator.apply(2 * p - 3 * q), 2 * operator.apply(p) - 3 * operator.apply(q), 10)


def test_symmetric(operator):
    p, q = fields(operator)
    there, back = np.vdot(operator.apply(p), q), np.vdot(p, operator.apply(q))
    assert there == pytest.approx(back, abs=1e-13 * p.size)
    matrix = operator.as_matrix()
    np.testing.assert_array_equal(matrix, matrix.T)


def test_definite(operator):
    """Free: positive definite. Periodic: semidefinite, and only constant tractions move nothing."""
    values = np.linalg.eigvalsh(operator.as_matrix())
    if all(operator.grid.periodic):
        np.testing.assert_allclose(values[:2], 0.0, atol=1e-14)
        assert operator.grid.size == 1 or values[2] > 0.01
        constant = np.ones((2, *operator.grid.shape)) * np.array([2.0, -3.0])[:, None, None]
        close(operator.apply(constant), 0.0)
    else:
        assert values[0] > 0.01


def test_equal_to_its_matrix(operator):
    q = fields(operator)[0]
    close_to_exact(operator, operator.apply(q).ravel(), operator.as_matrix() @ q.ravel(), 3)
    cells = np.flatnonzero(np.random.default_rng(1).random(operator.grid.size) < 0.4)
    both = np.concatenate([cells, cells + operator.grid.size])
    np.testing.assert_allclose(
        operator.as_matrix(cells), operator.as_matrix()[np.ix_(both, both)], rtol=0, atol=1e-16
    )


def test_equal_to_its_restriction(operator):
    q = fields(operator)[0]
    window = tuple(slice(n // 3, n) for n in operator.grid.shape)
    part = (slice(None), *window)
    inside = np.zeros_like(q)
    inside[part] = q[part]
    restricted = operator.restrict(window)
    assert type(restricted) is type(operator) or all(operator.grid.periodic)
    close_to_exact(operator, restricted.apply(q[part]), operator.apply(inside)[part], 3)


def test_the_whole_is_not_a_part(operator):
    whole = operator.restrict(tuple(slice(0, n) for n in operator.grid.shape))
    assert whole is operator


def test_the_approximate_inverse_is_symmetric_and_definite(operator):
    inverse = capabilities(operator).approximate_inverse
    if inverse is None:  # of a matrix none is known
        return
    p, q = fields(operator)
    assert np.vdot(inverse(p), q) == pytest.approx(np.vdot(p, inverse(q)), rel=1e-10, abs=1e-10 * p.size)
    assert np.vdot(inverse(p), p) > 0


@pytest.mark.parametrize("shape", SHAPES)
def test_free_bodies_add_up(shape):
    """The relative displacement of two bodies is the sum of that of each: one sinks in this way, the other in that."""
    operator = shear_half_space(rc.Grid(shape, SPACING), (FIRST, SECOND))
    q = fields(operator)[0]
    truth = one_body(operator.grid, FIRST, q) + one_body(operator.grid, SECOND, q)
    close(operator.apply(q), truth, 10)


@pytest.mark.parametrize("waves", [(2, 3), (-1, 4), (0, 1), (5, 0)])
def test_periodic_waves_answer_by_themselves(waves):
    """Along the wave vector as under pressure, 2/(E* q); across it as antiplane shear, sum 1/(G q)."""
    grid = rc.Grid((16, 24), (0.5, 0.25), True)
    operator = shear_half_space(grid, (FIRST, SECOND))
    y, x = np.meshgrid(*grid.coordinates, indexing="ij")
    qy, qx = (2 * np.pi * n / side for n, side in zip(waves, grid.lengths, strict=True))
    q = np.hypot(qy, qx)
    along, across = np.array([qx, qy]) / q, np.array([-qy, qx]) / q
    wave = np.cos(qy * y + qx * x)
    antiplane = 1 / FIRST.shear_modulus + 1 / SECOND.shear_modulus
    for direction, response in (
        (along, 2 / (rc.reduced_modulus(FIRST, SECOND) * q)),
        (across, antiplane / q),
    ):
        traction = direction[:, None, None] * wave
        close(operator.apply(traction), response * traction, 3)


@pytest.mark.parametrize("periodic", [False, True])
def test_without_poissons_ratio_each_component_is_loves(periodic):
    grid, body = rc.Grid((12, 9), SPACING, periodic), rc.Solid(2.0, 0.0)
    normal, shear = rc.half_space(grid, body), shear_half_space(grid, body)
    q = fields(shear)[0]
    close(shear.apply(q), [normal.apply(part) for part in q], 3)


def test_a_force_far_away():
    """Johnson's point force, to the order (h/r)^2 of the cell's extent."""
    operator = shear_half_space(rc.Grid((1, 400), 1.0), rc.Solid(2.0, 0.3))
    q = np.zeros((2, 1, 400))
    q[:, 0, 0] = 3.0
    r, scale = 399.0, 2 * np.pi * rc.Solid(2.0, 0.3).shear_modulus
    ux, uy = operator.apply(q)[:, 0, -1]
    assert ux == pytest.approx(3.0 / (scale * r), rel=1 / r**2)  # (1 - nu) + nu
    assert uy == pytest.approx(3.0 * 0.7 / (scale * r), rel=1 / r**2)


def test_loads_in_corners_meet():
    """Where an odd kernel lacks padding, its two outermost values share a place; on many cells, in several slabs."""
    for shape in ((2, 2), (8, 8), (5, 16), (130, 140)):
        operator = shear_half_space(rc.Grid(shape, SPACING), FIRST)
        q = np.zeros((2, *shape))
        q[0, 0, 0] = 1.0
        displacement = operator.apply(q)[:, -1, -1]
        matrix = operator.as_matrix(np.array([0, operator.grid.size - 1]))
        close(displacement, matrix[[1, 3], 0])
        assert displacement[1] > 0


@pytest.mark.parametrize(
    ("periodic", "method"), [(periodic, method) for periodic in METHODS for method in METHODS[periodic]]
)
def test_scale_laws(method, periodic):
    q = np.random.default_rng(0).standard_normal((2, 32, 19))

    def displacement(spacing, modulus):
        grid = rc.Grid((32, 19), spacing, periodic)
        return shear_half_space(grid, rc.Solid(modulus, 0.3), method=method).apply(q)

    base = displacement((0.3, 0.5), 2.0)
    np.testing.assert_allclose(displacement((3e-7, 5e-7), 2.0), base * 1e-6, rtol=0, atol=1e-20)
    np.testing.assert_allclose(displacement((0.3, 0.5), 2e11), base * 1e-11, rtol=0, atol=1e-25)


def test_dundurs_parameter():
    assert dundurs_parameter(FIRST, FIRST) == 0
    assert dundurs_parameter(rc.Solid(1.0, 0.5), rc.Solid(7.0, 0.5)) == 0
    assert dundurs_parameter(rc.Solid(1.0, 0.0)) == pytest.approx(0.5)  # its largest value
    assert dundurs_parameter(FIRST, SECOND) == pytest.approx(-dundurs_parameter(SECOND, FIRST))
    assert dundurs_parameter(FIRST) == pytest.approx(0.4 / 1.4)  # (1 - 2 nu)/(2 (1 - nu))
    assert dundurs_parameter(FIRST, rc.Solid(np.inf, 0.1)) == pytest.approx(dundurs_parameter(FIRST))


@pytest.mark.parametrize(
    ("grid", "bodies", "message"),
    [
        (rc.Grid(8, 1.0), FIRST, "two axes"),
        (rc.RadialGrid.uniform(3, 1.0), FIRST, "rings are not offered"),
        (rc.Grid((8, 8), 1.0, (True, False)), FIRST, "both axes"),
        (rc.Grid((8, 8), 1.0), 1e9, "a Solid or a pair of Solids is needed"),
        (rc.Grid((8, 8), 1.0), (rc.Solid(np.inf, 0.3), rc.Solid(np.inf, 0.3)), "two rigid bodies"),
    ],
)
def test_nonsense_is_refused(grid, bodies, message):
    with pytest.raises(ValueError, match=message):
        shear_half_space(grid, bodies)


@pytest.mark.parametrize("method", ["moving-grid", "multilevel"])
def test_methods_for_free_grids_say_so(method):
    with pytest.raises(ValueError, match=f"'{method}' is for free grids; a periodic one is summed by 'fft'"):
        shear_half_space(rc.Grid((8, 8), 1.0, True), FIRST, method=method)


def test_an_unknown_method_is_refused():
    with pytest.raises(ValueError, match="method must be"):
        shear_half_space(rc.Grid((8, 8), 1.0), FIRST, method="magic")
