"""The elastic form: pressure from displacement, exactly the inverse of the operator."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.elastic_form import elastic_form
from roughcontact.halfspace.influence.love import love_table
from roughcontact.transforms import even_multiplier, padded_length

# Rounding of transforms and of a matrix and its inverse, whose condition is below 1e4 on these few cells.
ROUNDING = 1e-11

SHAPES = [(1, 64), (2, 2), (3, 1), (8, 256), (12, 20), (33, 20), (64, 64), (256, 8)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 3.0), (10.0, 1.0)])
def test_the_symbol_of_the_embedded_influence_is_positive(shape, spacing):
    lengths = tuple(max(2, padded_length(n)) for n in shape)
    symbol = even_multiplier(love_table(tuple(m // 2 + 1 for m in lengths), spacing), lengths)
    assert symbol.min() > 0


def bodies():
    rings = rc.RadialGrid(np.r_[0.0, np.geomspace(1.0, 9.0, 30)])
    return {
        "free": rc.half_space(rc.Grid((9, 14), (1.0, 2.5)), 2.0),
        "multilevel": rc.half_space(rc.Grid((9, 14), 1.0), 2.0, method="multilevel"),
        "periodic": rc.half_space(rc.Grid((10, 15), (1.0, 0.5), True), 2.0),
        "ring": rc.ring(rings, 2.0),
        "line": rc.line(rc.Grid(40, 0.5), 2.0),
        "periodic line": rc.line(rc.Grid(40, 0.5, True), 2.0),
        "singly periodic": rc.half_space(rc.Grid((8, 10), 1.0, (True, False)), 2.0),
    }


@pytest.mark.parametrize("name", bodies())
def test_the_pressure_of_a_displacement_is_the_one_that_caused_it(name):
    body = bodies()[name]
    form = elastic_form(body)
    pressure = np.random.default_rng(0).standard_normal(form.grid.shape)
    if form.mean_free:
        pressure -= pressure.mean()
    caused = form.compliance(form.extended(pressure, 0.0))
    exact = body.capabilities.exact or body
    wanted = exact.apply(pressure)
    assert np.abs(caused[form.inside] - wanted).max() <= ROUNDING * np.abs(wanted).max()
    back = form.stiffness(caused)
    assert np.abs(back[form.inside] - pressure).max() <= ROUNDING * np.abs(pressure).max()
    back[form.inside] = 0.0  # and no traction beyond the grid
    assert np.abs(back).max() <= ROUNDING * np.abs(pressure).max()


def test_the_least_energy_over_the_cells_beyond_is_that_of_the_inverse_matrix():
    body = rc.half_space(rc.Grid((3, 4), (1.0, 2.0)), 2.0)
    form = elastic_form(body)
    units = np.eye(int(np.prod(form.shape))).reshape(-1, *form.shape)
    stiffness = np.array([form.stiffness(unit).ravel() for unit in units])
    box = np.zeros(form.shape, bool)
    box[form.inside] = True
    i, o = np.flatnonzero(box), np.flatnonzero(~box)
    cross = stiffness[np.ix_(i, o)]
    schur = stiffness[np.ix_(i, i)] - cross @ np.linalg.solve(stiffness[np.ix_(o, o)], cross.T)
    np.testing.assert_allclose(schur @ body.as_matrix(), np.eye(12), atol=ROUNDING)


@pytest.mark.parametrize("shape", [(5, 5), (12, 20), (1, 40)])
def test_a_free_half_space_of_square_cells_keeps_the_order_of_gaps(shape):
    """Its stiffness is a matrix of type M, on which the uniqueness of paths rests."""
    stiffness = np.linalg.inv(rc.half_space(rc.Grid(shape, 1.0), 1.0).as_matrix())
    np.fill_diagonal(stiffness, -1.0)
    assert stiffness.max() < 0


def test_a_body_that_has_nothing_but_a_large_matrix_is_refused():
    with pytest.raises(ValueError, match=r"6400 cells are too many \(at most 6000\)"):
        elastic_form(rc.half_space(rc.Grid((80, 80), 1.0, (True, False)), 1.0))


@pytest.mark.parametrize(
    "body", [rc.half_space(rc.Grid((3, 4), (0.5, 0.25)), 2.0), rc.ring(rc.RadialGrid.uniform(5, 2.0), 2.0)]
)
def test_many_integrals_at_once_are_those_one_by_one(body):
    form = elastic_form(body)
    first, second = (np.random.default_rng(k).random((n, *form.shape)) for k, n in enumerate((2, 3)))
    expected = [[form.dot(a, b) for b in second] for a in first]
    np.testing.assert_allclose(form.dots(first, second), expected, rtol=1e-14)
