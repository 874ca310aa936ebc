"""A body between a list of its cells: each way to sum over them against the matrix, sub-lists, and threads."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.operators import cell_list as lists
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.influence_operator import InfluenceOperator
from roughcontact.halfspace.operators.layer import layer
from roughcontact.halfspace.sums import direct_sum
from roughcontact.halfspace.sums.direct_sum import DirectSum
from roughcontact.halfspace.sums.particle_mesh import ListParticleMesh
from roughcontact.kernels import loader
from roughcontact.threads import limit_threads

EPS = np.finfo(float).eps
SHAPE, SPACING = (37, 61), (0.3, 0.5)  # no side is a multiple of a tile's, and cells are longer than wide
WAYS = {"cell by cell": (np.inf, np.inf), "tile by tile": (0, np.inf), "by the plane": (0, -1.0)}
needs_code = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


def some(count, shape=SHAPE, seed=0):
    """Cells here and there, in no order."""
    return np.random.default_rng(seed).permutation(shape[0] * shape[1])[:count]


def at(*places):
    return np.array([np.ravel_multi_index(place, SHAPE, mode="wrap") for place in places])


LISTS = {
    "few": some(5),
    "some": some(301),
    "many": some(900, seed=1),
    "one": at((20, 30)),
    "the last": at((-1, -1)),
    "a row": at(*((11, column) for column in range(61))),
    "a column": at(*((row, 42) for row in range(37))),
    "up to the first of a tile": at(
        *((row, column) for row in range(0, 33, 4) for column in range(0, 57, 8))
    ),
    "corners": at((0, 0), (-1, -1), (0, -1), (-1, 0), (-2, -1), (1, 0), (18, 30)),
}
RUBBER = rc.Solid(1.5, 0.5)
BODIES = {
    "half-space": lambda: rc.half_space(rc.Grid(SHAPE, SPACING), 2.0),
    "periodic half-space": lambda: rc.half_space(rc.Grid(SHAPE, SPACING, True), 2.0),
    "window of a periodic half-space": lambda: rc.half_space(rc.Grid((50, 70), SPACING, True), 2.0).restrict(
        (slice(3, 40), slice(9, 70))
    ),
    "singly periodic half-space": lambda: rc.half_space(rc.Grid(SHAPE, SPACING, (True, False)), 2.0),
    "layer": lambda: layer(rc.Grid(SHAPE, SPACING), RUBBER, 0.8, base="bonded"),
    "periodic layer": lambda: layer(rc.Grid(SHAPE, SPACING, True), RUBBER, 0.8, base="bonded"),
    "line": lambda: rc.line(rc.Grid(SHAPE[0] * SHAPE[1], 0.5), 2.0),
    "moving grid": lambda: rc.half_space(rc.Grid(SHAPE, SPACING), 2.0, method="moving-grid"),
}


@pytest.fixture(params=WAYS)
def way(request, monkeypatch):
    """Let sums go one way alone."""
    if request.param != "cell by cell" and not loader.is_available():
        pytest.skip("no machine code here")
    go(monkeypatch, request.param)
    return request.param


def go(monkeypatch, way):
    many, sums = WAYS[way]
    monkeypatch.setattr(lists, "PAIRS_FOR_TILES", many)
    monkeypatch.setattr(lists, "TILE_SUMS_PER_CELL", sums)
    monkeypatch.setattr(lists, "PAIRS_PER_ENTRY", 0.0)


def pressure_on(count, seed=3):
    """Of both signs, a third of it zero."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=count) * (rng.random(count) > 1 / 3)


def rounding(matrix, pressure, transforms=0):
    """Return by how much sums of so many terms, in whatever order, may differ; and by how much transforms do.

    Two sums of n terms are each wrong by n eps/2 of the sum of their sizes at most, and each term by its own rounding.
    What transforms over N numbers do to any number is some eps log2 N of the norms of both fields; that of the kernel
    is sqrt(N) times its largest value at most.
    """
    own = (len(pressure) + 2) * EPS * np.abs(matrix) @ np.abs(pressure)
    if not transforms:
        return own
    kernel = np.abs(matrix).max() * np.sqrt(transforms)
    return own + EPS * np.log2(transforms) * kernel * np.linalg.norm(pressure)


@pytest.mark.parametrize("name", LISTS)
def test_the_sum_is_the_product_with_the_matrix(way, name):
    operator = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS[name])
    matrix, pressure = operator.as_matrix(), pressure_on(len(LISTS[name]))
    pressure[0] = -1.3
    found = operator.apply(pressure)
    padded = 4 * SHAPE[0] * SHAPE[1] if way == "by the plane" else 0
    assert found.shape == pressure.shape
    assert (np.abs(found - matrix @ pressure) <= rounding(matrix, pressure, padded)).all()


@pytest.mark.parametrize("name", BODIES)
def test_the_sum_of_any_body_is_the_product_with_its_matrix(way, name):
    body = BODIES[name]()
    operator = body.submatrix(some(400))
    if operator.plane is None and way == "by the plane":
        way = "tile by tile"
    matrix, pressure = operator.as_matrix(), pressure_on(400)
    padded = 4 * SHAPE[0] * SHAPE[1] if way == "by the plane" else 0
    # Single values of a layer and those of its table come from rules that are good to some 1e-15 of Love's integral.
    rules = 4e-15 * np.abs(matrix).max() * np.abs(pressure).sum() if "layer" in name else 0.0
    error = np.abs(operator.apply(pressure) - matrix @ pressure)
    assert (error <= rounding(matrix, pressure, padded) + rules).all()


@pytest.mark.parametrize("name", ["some", "corners", "the last", "up to the first of a tile"])
def test_nobody_needs_to_know_the_plane(way, name):
    known = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS[name])
    alone = CellsOperator(known.grid, known.influence, known.rows, known.columns)
    assert alone.plane is None
    assert alone.capabilities.particle_mesh() is None
    pressure = pressure_on(len(LISTS[name]))
    pressure[0] = -1.3
    matrix = alone.as_matrix()
    np.testing.assert_array_equal(matrix, known.as_matrix())
    assert (np.abs(alone.apply(pressure) - matrix @ pressure) <= rounding(matrix, pressure)).all()


@pytest.mark.parametrize("name", ["some", "one", "corners"])
def test_nothing_comes_of_nothing(way, name):
    operator = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS[name])
    np.testing.assert_array_equal(operator.apply(np.zeros(len(LISTS[name]))), 0.0)


def test_no_cells_at_all():
    operator = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(np.zeros(0, np.intp))
    assert operator.apply(np.zeros(0)).shape == (0,)
    assert operator.as_matrix().shape == (0, 0)
    assert operator.capabilities.particle_mesh() is None


@pytest.fixture
def taken(monkeypatch):
    """Say which ways sums go."""
    ways = []
    for kind, name, way in (
        (CellsOperator, "_by_cells", "cell by cell"),
        (DirectSum, "apply", "tile by tile"),
        (InfluenceOperator, "apply", "by the plane"),
    ):
        original = getattr(kind, name)

        def noted(self, *given, original=original, way=way):
            ways.append(way)
            return original(self, *given)

        monkeypatch.setattr(kind, name, noted)
    return ways


def test_these_are_the_ways(way, taken):
    rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS["some"]).apply(pressure_on(301))
    assert taken == [way]


@needs_code
@pytest.mark.parametrize(
    ("cells", "loaded", "way"),
    [
        (200, 200, "cell by cell"),
        (900, 40, "cell by cell"),
        (900, 80, "tile by tile"),
        (900, 900, "by the plane"),
    ],
)
def test_the_shortest_way(taken, cells, loaded, way):
    """Below PAIRS_FOR_TILES pairs cell by cell; 900 cells touch all of the 40 tiles, and the plane has 2257 cells."""
    rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(some(cells)).apply(
        1.0 * (np.arange(cells) < loaded)
    )
    assert taken == [way]


@pytest.mark.parametrize("way", ["tile by tile", "by the plane"])
def test_without_machine_code_it_goes_cell_by_cell(monkeypatch, taken, way):
    go(monkeypatch, way)
    monkeypatch.setattr(loader, "is_available", lambda: False)
    rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS["some"]).apply(pressure_on(301))
    assert taken == ["cell by cell"]


@pytest.mark.parametrize("name", BODIES)
def test_lists_of_lists_have_rows_and_columns_of_the_matrix(name):
    operator = BODIES[name]().submatrix(some(150))
    matrix = operator.as_matrix()
    chosen = np.random.default_rng(5).permutation(130)[:60]
    # Where the table ends single values take over, and of a layer these come from another rule.
    close = 4e-15 * matrix.max() if "layer" in name else 0.0
    for part, cells in (
        (operator.submatrix(chosen), chosen),
        (operator.restrict((slice(20, 90),)), np.arange(20, 90)),
        (operator.restrict((slice(10, 140),)).submatrix(chosen), 10 + chosen),
        (operator.submatrix(chosen).restrict((slice(None, 7),)), chosen[:7]),
    ):
        wanted = matrix[np.ix_(cells, cells)]
        np.testing.assert_allclose(part.as_matrix(), wanted, rtol=0, atol=close)
        np.testing.assert_allclose(operator.as_matrix(cells), wanted, rtol=0, atol=close)
        assert part.grid == rc.Grid(len(cells), operator.grid.spacing)
        assert part.weights == operator.weights
        assert part.plane is operator.plane


@pytest.mark.parametrize("name", ["some", "corners"])
def test_a_list_of_a_list_sums_alike(way, name):
    operator = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS[name])
    chosen = np.arange(0, len(LISTS[name]), 3)[::-1]
    part, pressure = operator.submatrix(chosen), pressure_on(len(chosen))
    pressure[0] = 2.0
    embedded = np.zeros(len(LISTS[name]))
    embedded[chosen] = pressure
    matrix = part.as_matrix()
    padded = 4 * SHAPE[0] * SHAPE[1] if way == "by the plane" else 0
    error = np.abs(part.apply(pressure) - operator.apply(embedded)[chosen])
    assert (error <= 2 * rounding(matrix, pressure, padded)).all()


def test_it_is_symmetric(way):
    operator = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS["some"])
    p, q = pressure_on(301, 1), pressure_on(301, 2)
    padded = 4 * SHAPE[0] * SHAPE[1] if way == "by the plane" else 0
    matrix = operator.as_matrix()
    np.testing.assert_array_equal(matrix, matrix.T)
    limit = np.abs(q) @ rounding(matrix, p, padded) + np.abs(p) @ rounding(matrix, q, padded)
    assert abs(q @ operator.apply(p) - p @ operator.apply(q)) <= limit


def test_a_pressure_may_be_locked(way):
    operator = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS["some"])
    pressure = pressure_on(301)
    expected = operator.apply(pressure)
    pressure.flags.writeable = False
    np.testing.assert_array_equal(operator.apply(pressure), expected)


@needs_code
def test_what_is_no_number_shows(way):
    operator = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS["some"])
    pressure = np.zeros(301)
    pressure[77] = np.nan
    assert np.isnan(operator.apply(pressure)).all()


@needs_code
@pytest.mark.parametrize("count", [2, 5])
@pytest.mark.parametrize("name", ["many", "corners", "one"])
def test_threads_are_no_matter(monkeypatch, name, count):
    go(monkeypatch, "tile by tile")
    operator = rc.half_space(rc.Grid(SHAPE, SPACING), 2.0).submatrix(LISTS[name])
    pressure = pressure_on(len(LISTS[name]))
    pressure[0] = 0.7
    with limit_threads(1):
        alone = operator.apply(pressure)
    monkeypatch.setattr(direct_sum, "PAIRS_FOR_THREADS", 0)
    for _ in range(5):
        with limit_threads(count):
            np.testing.assert_array_equal(operator.apply(pressure), alone)


@needs_code
def test_it_drives_by_its_tiles():
    """`patches` of a list: nearly the same sums on the tiles that a part of it touches, in single precision."""
    plane = rc.half_space(rc.Grid((96, 130), SPACING), 2.0)
    operator = plane.submatrix(some(900, (96, 130)))
    region = np.random.default_rng(7).random(900) < 0.1
    patches = operator.capabilities.particle_mesh()
    assert isinstance(patches, ListParticleMesh)
    tiles = patches.tiles(region)
    assert tiles.hold(region)
    assert len(tiles) < len(patches.whole)
    operator.influence.to_both_sides((96, 136), "float64")  # at hand, as an exact product leaves it
    driver = patches.on(tiles)
    assert isinstance(driver.forward, DirectSum)
    pressure = np.where(region, pressure_on(900), 0.0)
    exact = operator.as_matrix() @ pressure
    found = driver.scatter(driver.apply(driver.scaled(driver.gather(pressure))))
    single = (np.count_nonzero(region) + 3) * np.finfo(np.float32).eps
    limit = single * np.abs(operator.as_matrix()) @ np.abs(pressure)
    assert (np.abs(found - exact) <= limit)[region].all()


def test_bodies_without_tiles_have_no_patches():
    for name in ("periodic half-space", "layer", "line"):
        assert BODIES[name]().submatrix(some(50)).capabilities.particle_mesh() is None


@needs_code
def test_no_table_is_made_for_few_cells_far_apart(taken):
    """A table of the plane would cost more than so few single values; once it is there, it serves."""
    operator = rc.half_space(rc.Grid((600, 500), 1.0), 2.0).submatrix(np.arange(0, 300_000, 1001))
    pressure = np.ones(300)
    single = operator.apply(pressure)
    operator.influence.table((600, 500))
    assert taken == ["cell by cell"]
    from_table = operator.apply(pressure)
    assert taken == ["cell by cell", "tile by tile"]
    np.testing.assert_allclose(from_table, single, rtol=1e-12)
