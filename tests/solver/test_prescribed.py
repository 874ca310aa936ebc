"""Pressure under a prescribed displacement: by a factorisation, or by corrections that begin from nothing."""

import tracemalloc
from fractions import Fraction

import numpy as np
import pytest
import scipy.linalg

import roughcontact as rc
from regions import region
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.solver.control import Depth
from roughcontact.solver.direct import _System, press_cells, solve_cells

SHAPE = (50, 52)
STEP = (0.3, 0.2)


class Watched:
    """A half-space that keeps the pressures it is asked about; beyond the protocol it states an inverse."""

    def __init__(self, periodic=False):
        self.body = rc.half_space(rc.Grid(SHAPE, STEP, periodic), 2.0)
        self.grid, self.weights, self.asked = self.body.grid, self.body.weights, []
        self.capabilities = rc.Capabilities(approximate_inverse=self.body.approximate_inverse)

    def apply(self, pressure):
        self.asked.append(pressure.copy())
        return self.body.apply(pressure)

    def as_matrix(self, cells=None):
        return self.body.as_matrix(cells)


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
    found = rc.prescribed_displacement(inside, wanted, operator=watched)
    assert len(watched.asked) == found.steps
    assert all(pressure.any() for pressure in watched.asked)
    assert (found.steps == 0) == (np.count_nonzero(inside) < 1000)


class Windowed(Watched):
    """The same, which notes the windows that are cut out."""

    def __init__(self, periodic):
        super().__init__(periodic)
        self.windows = []

    def restrict(self, window):
        self.windows.append(window)
        return self.body.restrict(window)


@pytest.mark.parametrize(
    ("periodic", "rows", "columns", "cut"),
    [
        (False, 20, 30, True),
        (False, 34, 39, False),
        (True, 10, 30, True),
        (True, 20, 30, False),
    ],
)
def test_a_box_is_cut_out_where_its_padding_is_less_than_half_of_the_plane(periodic, rows, columns, cut):
    """In a box nothing is periodic: it is padded to twice its sides, and a periodic plane is not."""
    body, inside = Windowed(periodic), np.zeros(SHAPE, bool)
    inside[7 : 7 + rows, 5 : 5 + columns] = region((rows, columns), share=0.9)
    inside[7, 5] = inside[6 + rows, 4 + columns] = True
    found = rc.prescribed_displacement(inside, 1.0, operator=body, tolerance=1e-10)
    assert body.windows == [(slice(7, 7 + rows), slice(5, 5 + columns))] * cut
    assert np.abs(body.body.apply(found.pressure)[inside] - 1).max() <= 2e-10
    assert (found.pressure[~inside] == 0).all()


@pytest.mark.parametrize("tolerance", [1e-3, 1e-10])
def test_what_is_lacking_is_what_the_matrix_says(watched, inside, wanted, tolerance):
    """Other sums than those that told the error round otherwise, by 1e-16 of sums of some thousand terms."""
    found = rc.prescribed_displacement(inside, wanted, operator=watched, tolerance=tolerance)
    given = (watched.as_matrix() @ found.pressure.ravel()).reshape(SHAPE)
    error = np.abs(given - wanted)[inside].max() / np.abs(wanted[inside]).max()
    assert found.residual <= tolerance
    assert error == pytest.approx(found.residual, abs=1e-12)
    assert not found.pressure[~inside].any()


def test_the_answer_to_start_from_is_the_answer(watched, inside, wanted):
    first = rc.prescribed_displacement(inside, wanted, operator=watched, tolerance=1e-10)
    watched.asked.clear()
    again = rc.prescribed_displacement(
        inside, wanted, operator=watched, tolerance=1e-9, initial=first.pressure
    )
    assert len(watched.asked) == again.steps == 1
    np.testing.assert_array_equal(again.pressure, first.pressure)


@pytest.mark.parametrize("most", [2, 5])
def test_too_few_products_are_said_to_be(watched, wanted, most):
    many = region(SHAPE, share=0.9)
    with pytest.raises(RuntimeError, match=rf"met only to .*, by {most} products.*max_steps"):
        rc.prescribed_displacement(many, wanted, operator=watched, max_steps=most)
    assert len(watched.asked) == most


def test_where_steps_are_left_it_is_the_tolerance_that_asks_for_too_much(watched, wanted):
    class Vague(Watched):
        def apply(self, pressure):
            noise = np.random.default_rng(len(self.asked)).standard_normal(SHAPE)
            return super().apply(pressure) * (1 + 1e-6 * noise)

    with pytest.raises(RuntimeError, match=r"met only to .*: allow a larger tolerance"):
        rc.prescribed_displacement(region(SHAPE, share=0.9), wanted, operator=Vague(watched.grid.periodic[0]))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"tolerance": np.nan}, "between 1e-14 and 1e-2, not nan"),
        ({"tolerance": 1.0}, "between 1e-14 and 1e-2, not 1"),
        ({"tolerance": "1e-8"}, "tolerance must be one number"),
        ({"max_steps": 1}, "max_steps must be a whole number, two at least, not 1"),
        ({"max_steps": 2.5}, "max_steps must be a whole number"),
        ({"displacement": "1nm"}, "displacement must be one number in SI units, not '1nm'"),
        ({"mask": np.full(SHAPE, np.nan)}, "truth values, such as pressure > 0"),
        ({"mask": np.full(SHAPE, 0.5)}, "truth values"),
        ({"mask": np.full(SHAPE, "in")}, "truth values"),
        ({"operator": rc.Grid(SHAPE, STEP)}, "an operator is wanted"),
    ],
    ids=str,
)
def test_what_makes_no_sense_is_refused(watched, given, message):
    asked = {"operator": watched, "mask": region(SHAPE), "displacement": 1.0} | given
    with pytest.raises(ValueError, match=message):
        rc.prescribed_displacement(**asked)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"tolerance": np.nan}, "not nan"),
        ({"tolerance": 1.0}, "not 1"),
        ({"mask": np.full(SHAPE, np.nan)}, "truth values"),
    ],
    ids=str,
)
def test_what_makes_no_sense_has_no_stiffness(given, message):
    asked = {"mask": region(SHAPE), "grid": rc.Grid(SHAPE, STEP), "modulus": 1.0} | given
    with pytest.raises(ValueError, match=message):
        rc.contact_stiffness(**asked)


@pytest.mark.parametrize("kind", [int, float, list])
def test_ones_and_zeros_tell_a_region(kind):
    mask, grid = region(SHAPE), rc.Grid(SHAPE, STEP)
    told = mask.astype(int).tolist() if kind is list else mask.astype(kind)
    assert rc.contact_stiffness(told, grid, 1.0) == rc.contact_stiffness(mask, grid, 1.0)


def test_a_body_that_cannot_be_factorised_is_iterated(monkeypatch, watched, wanted):
    def refuse(*_):
        raise np.linalg.LinAlgError("not definite")

    few = region(SHAPE, share=0.1)
    expected = rc.prescribed_displacement(few, wanted, operator=watched)
    monkeypatch.setattr("roughcontact.solver.prescribed.solve_cells", refuse)
    found = rc.prescribed_displacement(few, wanted, operator=watched, tolerance=1e-12)
    assert found.steps > 1
    # Wrong by the square of the residual, times the condition of some hundred cells.
    np.testing.assert_allclose(found.work, expected.work, rtol=1e-12)


@pytest.mark.parametrize("weights", [1.0, np.linspace(1, 3, 10)], ids=["alike", "rings"])
def test_the_matrix_is_as_it_was(weights):
    """Its factor overwrites a triangle; products read the other one, and the diagonal that was."""
    root = np.sqrt(weights * np.ones(10))
    matrix = scipy.linalg.hilbert(10) / root[:, None] * root  # symmetric under the weights
    system = _System(matrix.copy(), weights * np.ones(10), np.ones((10, 1)))
    x = np.random.default_rng(0).standard_normal(10)
    for pulls in (
        [],
        [3],
        [0, 1, 2, 3, 4],
    ):  # let go of few, and of so many that the rest is factorised anew
        unknowns = np.isin(np.arange(10), pulls) & system.kept
        if unknowns.any():
            system.deactivate(unknowns)
        for _ in range(2):
            np.testing.assert_allclose(system.product(x), matrix @ x, rtol=0, atol=1e-14)


def test_few_cells_say_how_far_they_came():
    """Hilbert's matrix of ten has a condition of 1e13: what is left is more than roundings of its numbers."""
    body = DenseOperator(rc.Grid(10, 1.0), scipy.linalg.hilbert(10))
    everything = np.arange(10)
    pressure, given = solve_cells(body, everything, np.ones(10))
    exact = [float(sum(Fraction(p) / (i + j + 1) for j, p in enumerate(pressure))) for i in range(10)]
    assert np.abs(given - 1).max() > 1e-12
    # Ten terms of at most so much.
    np.testing.assert_allclose(given, exact, rtol=0, atol=10 * np.finfo(float).eps * np.abs(pressure).max())
    pressed = press_cells(body, 1 - scipy.linalg.hilbert(10).sum(axis=1), Depth(1.0), everything)
    assert len(pressed.cells) == 10
    assert pressed.error > 1e-12


def test_a_matrix_that_must_not_be_written_to_is_left_alone(watched):
    few = region(SHAPE, share=0.1)
    expected = rc.prescribed_displacement(few, 1.0, operator=watched)
    matrix = watched.as_matrix(np.flatnonzero(few))
    matrix.flags.writeable = False
    watched.as_matrix = lambda cells: matrix if len(cells) > 1 else matrix[:1, :1]
    found = rc.prescribed_displacement(few, 1.0, operator=watched)
    np.testing.assert_array_equal(found.pressure, expected.pressure)


def test_products_have_the_last_word_where_the_matrix_is_another(watched, wanted):
    """A triangle of it is factorised: where the other says otherwise, the operator is asked."""
    few = region(SHAPE, share=0.1)
    cells = np.flatnonzero(few)
    matrix = watched.as_matrix(cells)
    skew = 1e-3 * matrix[0, 0] * np.random.default_rng(0).standard_normal(matrix.shape) / len(cells)
    watched.as_matrix = lambda cells: (matrix + np.triu(skew, 1)).copy()
    found = rc.prescribed_displacement(few, wanted, operator=watched)
    left = (wanted - watched.body.apply(found.pressure))[few]
    assert np.abs(left).max() <= 1e-8 * np.abs(wanted[few]).max()
    assert found.steps > 1


def test_what_a_driver_says_is_certified():
    """A large region of a half-space is driven in single precision: its answer is judged by the exact product."""
    body = rc.half_space(rc.Grid((70, 70), STEP), 2.0)
    many = region((70, 70), share=0.9)
    answer = rc.prescribed_displacement(many, 1.0, operator=body, tolerance=1e-10)
    again = rc.prescribed_displacement(many, 1.0, operator=body, tolerance=1e-3, initial=answer.pressure)
    assert again.steps == 2
    assert again.residual == np.abs(body.apply(answer.pressure) - 1)[many].max()


def test_a_start_in_single_precision_rounds_no_displacement(watched, inside):
    found = rc.prescribed_displacement(inside, 1 / 3, operator=watched, initial=np.zeros(SHAPE, np.float32))
    left = np.abs(watched.body.apply(found.pressure) - 1 / 3)[inside].max()
    assert left <= 1e-8 / 3 * (1 + 1e-6)


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize(("step", "modulus"), [(1.0, 1.0), (1e-9, 1e12), (1e6, 1e-3)])
def test_what_a_factorisation_says_of_itself_hangs_on_no_unit(step, modulus, compiled, monkeypatch):
    """Roundings of a hundred terms, whatever the size of influences beside that of their roots."""
    if not compiled:
        monkeypatch.setattr("roughcontact.solver.direct.tuning.COMPILED_CELLS", 0)
    body = rc.half_space(rc.Grid((20, 21), step), modulus)
    few = region((20, 21), share=0.3)
    cells = np.flatnonzero(few)
    rough = step * np.random.default_rng(2).random((20, 21))
    pressed = press_cells(body, rough, Depth(0.7 * step), cells)
    assert 10 < len(pressed.cells) < len(cells)
    assert pressed.error < 1e-13
    given = body.as_matrix(pressed.cells) @ pressed.pressure
    wanted = 0.7 * step - rough.flat[pressed.cells]
    np.testing.assert_allclose(given, wanted, rtol=0, atol=1e-12 * step)
    assert rc.prescribed_displacement(few, 1.0, operator=body).residual < 1e-13


def test_the_factor_takes_the_place_of_the_matrix():
    """A copy would be a second one of all pairs of cells."""
    body = rc.half_space(rc.Grid((24, 25), 1.0), 1.0)
    cells = np.arange(600)
    body.as_matrix(cells)  # the table is made once
    tracemalloc.start()
    try:
        solve_cells(body, cells, np.ones(600))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    matrix = 8 * 600**2
    assert matrix < peak < 1.5 * matrix
