"""Pressure under a prescribed displacement: by a factorisation, or by corrections that begin from nothing."""

import numpy as np
import pytest

import roughcontact as rc
from regions import region
from roughcontact.contact.direct import press_cells
from roughcontact.contact.problem import Depth

SHAPE = (50, 52)
STEP = (0.3, 0.2)


class Watched:
    """A half-space that keeps the pressures it is asked about; nothing is known of it but the protocol."""

    def __init__(self, periodic=False):
        self.body = rc.half_space(rc.Grid(SHAPE, STEP, periodic), 2.0)
        self.grid, self.weights, self.asked = self.body.grid, self.body.weights, []

    def apply(self, pressure):
        self.asked.append(pressure.copy())
        return self.body.apply(pressure)

    def as_matrix(self, cells=None):
        return self.body.as_matrix(cells)

    def approximate_inverse(self, displacement):
        return self.body.approximate_inverse(displacement)


@pytest.fixture(params=[False, True], ids=["free", "periodic"])
def watched(request):
    return Watched(request.param)


@pytest.fixture(params=[0.1, 0.9], ids=["few", "many"])
def inside(request):
    """Few cells are factorised, many iterated; they reach all sides, so that no box is cut out."""
    return region(SHAPE, share=request.param)


@pytest.fixture
def wanted():
    return np.random.default_rng(1).normal(size=SHAPE) + 1


def test_every_product_is_counted_and_none_is_taken_of_nothing(watched, inside, wanted):
    found = rc.prescribed_displacement(watched, inside, wanted)
    assert len(watched.asked) == found.steps
    assert all(pressure.any() for pressure in watched.asked)
    assert (found.steps == 0) == (np.count_nonzero(inside) < 1000)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-10])
def test_what_is_lacking_is_what_the_matrix_says(watched, inside, wanted, tolerance):
    """The error is told by a fresh product; the matrix rounds otherwise, by 1e-16 of sums of some thousand terms."""
    found = rc.prescribed_displacement(watched, inside, wanted, tolerance=tolerance)
    given = (watched.as_matrix() @ found.pressure.ravel()).reshape(SHAPE)
    error = np.abs(given - wanted)[inside].max() / np.abs(wanted[inside]).max()
    assert found.residual <= tolerance
    assert error == pytest.approx(found.residual, abs=1e-12)
    assert not found.pressure[~inside].any()


def test_the_answer_to_start_from_is_the_answer(watched, inside, wanted):
    first = rc.prescribed_displacement(watched, inside, wanted, tolerance=1e-10)
    watched.asked.clear()
    again = rc.prescribed_displacement(watched, inside, wanted, tolerance=1e-9, initial=first.pressure)
    assert len(watched.asked) == again.steps == 1
    np.testing.assert_array_equal(again.pressure, first.pressure)


@pytest.mark.parametrize("most", [1, 5])
def test_too_few_products_are_said_to_be(watched, wanted, most):
    """One more may tell how far they came."""
    many = region(SHAPE, share=0.9)
    with pytest.raises(RuntimeError, match=rf"only after {most + 1} products.*max_steps"):
        rc.prescribed_displacement(watched, many, wanted, max_steps=most)
    assert len(watched.asked) == most + 1


def test_a_body_that_cannot_be_factorised_is_iterated(monkeypatch, watched, wanted):
    def refuse(*_):
        raise np.linalg.LinAlgError("not definite")

    few = region(SHAPE, share=0.1)
    expected = rc.prescribed_displacement(watched, few, wanted)
    monkeypatch.setattr("roughcontact.contact.prescribed.solve_cells", refuse)
    found = rc.prescribed_displacement(watched, few, wanted, tolerance=1e-12)
    assert found.steps > 1
    # Wrong by the square of the residual, times the condition of some hundred cells.
    np.testing.assert_allclose(found.work, expected.work, rtol=1e-12)


def test_the_order_of_memory_does_not_matter(watched, inside, wanted):
    """Columns first, the cells of a region are no other ones."""
    expected = rc.prescribed_displacement(watched, inside, wanted)
    found = rc.prescribed_displacement(watched, np.asfortranarray(inside), np.asfortranarray(wanted))
    assert found.steps == expected.steps
    largest = np.abs(expected.pressure).max()
    np.testing.assert_allclose(found.pressure, expected.pressure, rtol=0, atol=1e-12 * largest)


@pytest.mark.parametrize(("step", "modulus"), [(1.0, 1.0), (1e-9, 1e12), (1e6, 1e-3)])
def test_what_a_factorisation_says_of_itself_hangs_on_no_unit(step, modulus):
    """Roundings of a hundred terms, whatever the size of influences beside that of their roots."""
    body = rc.half_space(rc.Grid((20, 21), step), modulus)
    few = region((20, 21), share=0.3)
    cells = np.flatnonzero(few)
    pressed = press_cells(body, np.zeros((20, 21)), Depth(1.0), cells)
    assert pressed.error < 1e-13
    assert rc.prescribed_displacement(body, few, 1.0).residual < 1e-13
