"""The half-space between the nodes of finite elements: its energy, rigid punches, a plate and a block of elements."""

import runpy
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve
from scipy.spatial import Delaunay

import roughcontact as rc

GALLERY = Path(__file__).parents[3] / "examples" / "gallery"
SOLID = rc.Solid(1.0, 0.3)
SQUARE = 1.152298  # k/(E* L) of a rigid square (thesis)


def along(nodes, centres):
    """Linear shape functions of `nodes` at the centres of cells."""
    return np.array([np.interp(centres, nodes, unit) for unit in np.eye(len(nodes))]).T


def bilinear(grid, elements):
    """Shape functions of square elements on the whole of a grid of two axes, and the places (y, x) of the nodes."""
    axes = [np.linspace(0, length, n + 1) for length, n in zip(grid.lengths, elements, strict=True)]
    lines = [along(*pair) for pair in zip(axes, grid.coordinates, strict=True)]
    return np.kron(*lines), np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 2)


def square(elements, cells=4):
    """The interpolation of a unit square, and its cells."""
    grid = rc.Grid((elements * cells, elements * cells), 1 / (elements * cells))
    return grid, bilinear(grid, (elements, elements))[0]


def oblong():
    grid = rc.Grid((8, 18), (0.1, 0.07))
    return grid, bilinear(grid, (4, 6))[0]


def holed():
    """Elements on a part of the cells, in another order of the nodes."""
    grid, shapes = oblong()
    inside = np.ones(grid.shape, bool)
    inside[:3, 5:9] = inside[:, -1] = False
    return grid, (inside.reshape(-1, 1) * shapes)[:, np.random.default_rng(1).permutation(shapes.shape[1])]


def disc(rings, cells=8):
    """Triangles in a disc of radius 1, on an even number of cells along its radius."""
    turns = [np.exp(2j * np.pi * np.arange(6 * k) / (6 * k)) * k / rings for k in range(1, rings + 1)]
    points = np.concatenate([[0], *turns])
    mesh = Delaunay(np.column_stack([points.real, points.imag]))
    grid = rc.Grid((2 * rings * cells, 2 * rings * cells), 1 / (rings * cells))
    y, x = np.meshgrid(*(each - 1 for each in grid.coordinates), indexing="ij")
    centres = np.column_stack([x.ravel(), y.ravel()])
    triangle = mesh.find_simplex(centres)
    inside = np.flatnonzero(triangle >= 0)
    corner = mesh.transform[triangle[inside]]
    first = np.einsum("cij,cj->ci", corner[:, :2], centres[inside] - corner[:, 2])
    values = np.column_stack([first, 1 - first.sum(axis=1)])
    places = np.repeat(inside, 3), mesh.simplices[triangle[inside]].ravel()
    return grid, sparse.csr_array((values.ravel(), places), shape=(grid.size, points.size))


def bodies():
    for name, (grid, shapes) in {"bilinear": oblong(), "holed": holed(), "disc": disc(3, 4)}.items():
        yield pytest.param(rc.half_space(grid, 2.0), shapes, id=name)
        twice = sparse.block_diag([shapes, shapes])
        yield pytest.param(rc.shear_half_space(grid, SOLID), twice, id=f"{name}, sheared")
    grid, shapes = oblong()
    yield pytest.param(rc.half_space(grid, 2.0, method="dense"), shapes, id="dense")
    yield pytest.param(rc.half_space(grid, 2.0, method="multilevel"), shapes, id="multilevel")
    yield pytest.param(rc.layer(grid, SOLID, 0.3, base="bonded"), shapes, id="layer")
    row = rc.Grid(grid.shape, grid.spacing, (True, False))
    yield pytest.param(rc.half_space(row, 2.0), shapes, id="periodic along y")
    line, rings = rc.Grid(24, 0.1), rc.RadialGrid(np.r_[0, np.cumsum(np.linspace(0.02, 0.1, 24))])
    yield pytest.param(rc.line(line, 2.0), along(np.linspace(0, 2.4, 7), line.coordinates[0]), id="line")
    yield pytest.param(rc.ring(rings, 2.0), along(rings.edges[::4], rings.radii), id="rings")


@pytest.mark.parametrize(("body", "shapes"), list(bodies()))
def test_symmetric_positive_definite_and_of_the_energy_of_the_cells(body, shapes):
    """The nodal work is that of the cells, and nodal displacements are the least-squares fit to those of cells.

    The mass matrices have condition numbers below 1e3, which leaves 1e-12 of sixteen digits.
    """
    flexibility = rc.nodal_flexibility(body, shapes)
    np.testing.assert_array_equal(flexibility, flexibility.T)
    np.linalg.cholesky(flexibility)  # refuses what is not positive definite
    shapes = sparse.csr_array(shapes)
    components = shapes.shape[0] // body.grid.size
    areas = np.tile(np.broadcast_to(body.weights, body.grid.shape).ravel(), components)
    mass = (shapes.T * areas) @ shapes.toarray()
    assert np.linalg.cond(mass) < 1e3
    forces = np.random.default_rng(2).normal(size=shapes.shape[1])
    pressure = shapes @ np.linalg.solve(mass, forces)
    np.testing.assert_allclose(shapes.T @ (areas * pressure), forces, rtol=0, atol=1e-12 * abs(forces).max())
    exact = body.capabilities.exact or body
    field = pressure.reshape((components, *body.grid.shape) if components == 2 else body.grid.shape)
    moved = exact.apply(field).ravel()
    displacements = flexibility @ forces
    assert forces @ displacements == pytest.approx(np.sum(areas * pressure * moved), rel=1e-12)
    root = np.sqrt(areas)
    fitted = np.linalg.lstsq(root[:, None] * shapes.toarray(), root * moved)[0]
    np.testing.assert_allclose(displacements, fitted, rtol=0, atol=1e-12 * abs(fitted).max())


def test_forces_and_moments_are_those_of_the_pressure():
    """Bilinear shape functions reproduce 1, x and y; rounding as above."""
    grid, (shapes, places) = oblong()[0], bilinear(oblong()[0], (4, 6))
    pressure = np.random.default_rng(3).random(grid.size)
    forces = grid.cell_area * shapes.T @ pressure
    y, x = np.meshgrid(*grid.coordinates, indexing="ij")
    for of_cells, of_nodes in (
        (np.ones(grid.size), np.ones(len(places))),
        (y, places[:, 0]),
        (x, places[:, 1]),
    ):
        total = grid.cell_area * np.ravel(of_cells) @ pressure
        assert forces @ of_nodes == pytest.approx(total, rel=1e-13)


@pytest.mark.parametrize(
    "make", [lambda grid: rc.half_space(grid, 2.0), lambda grid: rc.shear_half_space(grid, SOLID)]
)
def test_a_node_in_each_cell(make):
    """F is the matrix of the cells over their area; transforms round to some units of the largest entry."""
    body = make(rc.Grid((7, 5), (0.1, 0.2)))
    matrix = body.as_matrix()
    found = rc.nodal_flexibility(body, sparse.eye_array(len(matrix)))
    np.testing.assert_allclose(found * body.weights, matrix, rtol=0, atol=1e-14 * matrix.max())


def test_sparse_and_dense_interpolations():
    grid, shapes = oblong()
    body = rc.half_space(grid, 2.0)
    expected = rc.nodal_flexibility(body, shapes)
    for given in (
        sparse.csr_array(shapes),
        sparse.csr_matrix(shapes),
        sparse.coo_array(shapes),
        shapes.tolist(),
    ):
        np.testing.assert_array_equal(rc.nodal_flexibility(body, given), expected)


def test_one_product_for_each_node():
    class Counted:
        def __init__(self, body):
            self.body, self.grid, self.weights, self.products = body, body.grid, body.weights, 0

        def apply(self, pressure):
            self.products += 1
            return self.body.apply(pressure)

        def as_matrix(self, cells=None):
            assert len(cells) == 1, "the matrix of all cells is large"
            return self.body.as_matrix(cells)

    grid, shapes = square(4)
    body = Counted(rc.half_space(grid, 1.0))
    assert rc.nodal_flexibility(body, shapes).shape == (25, 25)
    assert body.products == 25


def test_a_rigid_square():
    """Of first order in the elements, from below, and below the cells, whose pressures are not limited to the nodes'.

    Of nested meshes the finer is stiffer. What extrapolation leaves is of second order: less than its own last step.
    """
    stiffnesses, of_cells = [], []
    for elements in (2, 4, 8, 16):
        grid, shapes = square(elements, 32 // elements)
        stiffnesses.append(np.linalg.inv(rc.nodal_flexibility(rc.half_space(grid, 1.0), shapes)).sum())
        of_cells.append(rc.contact_stiffness(np.ones(grid.shape, bool), grid, 1.0))
    assert of_cells == pytest.approx([of_cells[0]] * 4, rel=1e-12)  # one grid for all
    assert stiffnesses == sorted(stiffnesses)
    assert stiffnesses[-1] < of_cells[-1] < SQUARE

    def errors(cells):
        found = []
        for elements in (4, 8, 16):
            grid, shapes = square(elements, cells)
            found.append(np.linalg.inv(rc.nodal_flexibility(rc.half_space(grid, 1.0), shapes)).sum())
        return 1 - np.array(found) / SQUARE

    for cells in (2, 4):
        coarse, middle, fine = errors(cells)
        assert 1.8 < coarse / middle < middle / fine < 2
        first, second = 2 * middle - coarse, 2 * fine - middle
        assert abs(second) < abs(first - second)


def test_a_rigid_disc_of_triangles():
    """2 E* a and, sheared, 8 G a/(2 - nu), of first order in the rings; the radius is that of the cells' area.

    Extrapolation leaves the second order, a quarter of the last error at most, and so do the steps of the rim.
    """
    normal, sheared = [], []
    for rings in (4, 8):
        grid, shapes = disc(rings)
        radius = np.sqrt(shapes.sum() * grid.cell_area / np.pi)
        stiffness = np.linalg.inv(rc.nodal_flexibility(rc.half_space(grid, SOLID), shapes)).sum()
        normal.append(stiffness / (2 * rc.reduced_modulus(SOLID) * radius))
        n = shapes.shape[1]
        flexibility = rc.nodal_flexibility(
            rc.shear_half_space(grid, SOLID), sparse.block_diag([shapes, shapes])
        )
        stiffness = np.linalg.inv(flexibility)[:n, :n].sum()
        sheared.append(stiffness * (2 - SOLID.poisson_ratio) / (8 * SOLID.shear_modulus * radius))
    for coarse, fine in (normal, sheared):
        assert 1.7 < (1 - coarse) / (1 - fine) < 2.1
        assert 2 * fine - coarse == pytest.approx(1, abs=(1 - fine) / 4)


def test_softer_than_the_cells_in_any_displacement():
    """Prescribed displacements N U of the cells take at least the force of S: N^T W A^-1 N - S has no negative part."""
    grid, shapes = square(3)
    body = rc.half_space(grid, 1.0)
    prescribed = grid.cell_area * shapes.T @ np.linalg.solve(body.as_matrix(), shapes)
    stiffness = np.linalg.inv(rc.nodal_flexibility(body, shapes))
    values = np.linalg.eigvalsh(prescribed - stiffness)
    assert values[0] > -1e-12 * values[-1]  # rounding
    assert values[-1] > 1e-3  # of E* L: they differ


def hermite(elements, size):
    """Integrals over a line of products of the derivatives (0, 0), (1, 1), (0, 2), (2, 2) of Hermite's cubics."""
    at, weights = np.polynomial.legendre.leggauss(4)  # exact to degree 7
    at, weights = (at + 1) / 2, weights / 2 * size
    cubics = [
        np.poly1d(c) for c in ([2, -3, 0, 1], [size, -2 * size, size, 0], [-2, 3, 0, 0], [size, -size, 0, 0])
    ]
    values = [np.array([each.deriv(k)(at) if k else each(at) for each in cubics]) / size**k for k in range(3)]
    for i, j in ((0, 0), (1, 1), (0, 2), (2, 2)):
        matrix = np.zeros((2 * elements + 2, 2 * elements + 2))
        for first in range(0, 2 * elements, 2):
            matrix[first : first + 4, first : first + 4] += (values[i] * weights) @ values[j].T
        yield sparse.csr_array(matrix)


def sunk(elements, side=12.0, poisson_ratio=0.3):
    """Depth under a point load on a square plate of D = E*/2 = 1/2, over 2 F/(3 sqrt(3) E*)."""
    mass, slopes, mixed, bends = hermite(elements, side / elements)
    matrix = sparse.kron(bends, mass) + sparse.kron(mass, bends)
    matrix += poisson_ratio * (sparse.kron(mixed, mixed.T) + sparse.kron(mixed.T, mixed))
    matrix = ((matrix + 2 * (1 - poisson_ratio) * sparse.kron(slopes, slopes)) / 2).toarray()
    grid = rc.Grid((2 * elements, 2 * elements), side / (2 * elements))
    shapes = bilinear(grid, (elements, elements))[0]
    numbers = (
        np.arange(len(matrix)).reshape(2 * elements + 2, -1)[::2, ::2].ravel()
    )  # of displacements, not of slopes
    matrix[np.ix_(numbers, numbers)] += np.linalg.inv(rc.nodal_flexibility(rc.half_space(grid, 1.0), shapes))
    middle = numbers[numbers.size // 2]
    load = np.zeros(len(matrix))
    load[middle] = 1
    return spsolve(sparse.csc_array(matrix), load)[middle] * 3 * np.sqrt(3) / 2


def test_a_plate_of_finite_elements_under_a_point_load():
    """An infinite plate of bending stiffness D on a half-space: w = 2 F/(3 sqrt(3) E* l), l^3 = 2 D/E* (Hogg 1938).

    The wave q of the load is answered by 1/(D q^4 + E* q/2). The plate's elements are conforming (Bogner, Fox and
    Schmit). The displacement between them and the half-space, linear in each element, has an error of second order:
    errors fall by factors that tend to four. Extrapolation leaves less than its step, and so does the plate's edge.
    """
    coarse, middle, fine = (sunk(elements) - 1 for elements in (6, 12, 24))
    assert 2.5 < coarse / middle < middle / fine < 4
    step = (middle - fine) / 3
    assert abs(fine - step) < step


def test_the_block_of_the_gallery_lies_between_its_bounds():
    """Rigid punch and uniform pressure, on the mesh, and next to them at the ends of the moduli.

    The distance from a limit is of first order in the ratio of moduli: it falls tenfold from one ratio to the next but
    one, to the second order (a fifth at a tenth).
    """
    example = runpy.run_path(str(GALLERY / "bodies" / "block_on_half_space.py"))
    plt.close("all")
    ratios, added = example["ratios"], example["added"]
    rigid, soft = example["rigid_limit"], example["soft_limit"]
    np.testing.assert_allclose(ratios[2:] / ratios[:-2], 10, rtol=1e-12)
    assert np.all((rigid < added) & (added < soft))
    assert (soft - added[2]) / (soft - added[0]) == pytest.approx(10, rel=0.2)
    assert (added[-3] - rigid) / (added[-1] - rigid) == pytest.approx(10, rel=0.2)
    assert 1 / rigid < SQUARE
    # The mean displacement under p = E*/L. At an edge u = s ln s: cells there, 4 h of the area miss a part of h = 1/32.
    exact = 4 / np.pi * (np.log(1 + np.sqrt(2)) - (np.sqrt(2) - 1) / 3)
    assert soft == pytest.approx(exact, rel=1e-3)
