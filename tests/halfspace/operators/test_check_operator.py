"""A check of operators: all of the library pass, and each property that is broken is named."""

import dataclasses

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.operators.build import singly_periodic
from roughcontact.halfspace.operators.layer import layer
from roughcontact.halfspace.operators.operator import capabilities

GRID = rc.Grid((12, 18), (0.3, 0.5))
PERIODIC = rc.Grid((12, 18), (0.3, 0.5), periodic=True)
RUBBER = rc.Solid(1.5, 0.5)
GOOD = {
    **{method: lambda method=method: rc.half_space(GRID, 2.0, method=method) for method in ("fft", "dense")},
    "multilevel": lambda: rc.half_space(rc.Grid((40, 60), 0.5), 2.0, method="multilevel"),
    "moving grid": lambda: rc.half_space(GRID, 2.0, method="moving-grid"),
    "periodic": lambda: rc.half_space(PERIODIC, 2.0),
    "large": lambda: rc.half_space(rc.Grid((256, 250), 1e-6), 1e11),
    "singly periodic": lambda: singly_periodic(rc.Grid((12, 18), 0.3, (True, False)), 2.0),
    "line": lambda: rc.line(rc.Grid(75, 0.5), 2.0),
    "rings": lambda: rc.ring(rc.RadialGrid.uniform(33, 3.0), 2.0),
    "layer": lambda: layer(GRID, RUBBER, 0.8, base="bonded"),
    "periodic layer": lambda: layer(PERIODIC, RUBBER, 0.8, base="bonded"),
    "foundation": lambda: rc.foundation(rc.Grid(20, 0.5), 2.0),
}


@pytest.mark.parametrize("kind", GOOD)
def test_operators_of_the_library_pass(kind):
    checks = rc.check_operator(GOOD[kind]())
    names = [each.name for each in checks]
    assert len(set(names)) == len(names) >= 7
    assert all(each.departure <= each.allowed for each in checks)


def test_the_operator_of_a_list_of_cells_passes():
    cells = np.array([3, 4, 17, 40, 41, 100])
    listed = capabilities(rc.half_space(GRID, 2.0)).submatrix(cells)
    names = [each.name for each in rc.check_operator(listed)]
    assert "equal to its restriction" not in names


class Changed:
    """A half-space with one member replaced."""

    def __init__(self, body, **changed):
        self.body, self.changed = body, changed
        self.grid, self.weights = body.grid, changed.get("weights", body.weights)
        self.capabilities = changed.get("capabilities")

    def apply(self, pressure):
        return self.changed.get("apply", type(self.body).apply)(self.body, pressure)

    def as_matrix(self, cells=None):
        return self.changed.get("as_matrix", type(self.body).as_matrix)(self.body, cells)

    def restrict(self, window):
        return self.changed.get("restrict", type(self.body).restrict)(self.body, window)


class Drifting:
    calls = 0

    def __call__(self, body, p):
        self.calls += 1
        return body.apply(p) * (1 + 1e-6 * self.calls)


def spoilt(body, p):
    moved = body.apply(p)
    p += 1
    return moved


RAMP = np.linspace(1, 2, 18)
OFTEN = 1e-10 * np.eye(GRID.size)
BROKEN = [
    ({"apply": Drifting()}, "not repeatable"),
    ({"apply": spoilt}, "must not change the pressure"),
    ({"apply": lambda body, p: body.apply(p)[:-1]}, "of the shape"),
    ({"apply": lambda body, p: body.apply(p) * np.nan}, "finite displacements"),
    ({"apply": lambda body, p: body.apply(p) + 1e-6 * body.apply(p**2)}, "not linear"),
    ({"apply": lambda body, p: RAMP * body.apply(p)}, "not symmetric under its weights"),
    ({"weights": 0.0}, "weights of an operator are positive"),
    ({"as_matrix": lambda body, cells: body.as_matrix(cells) * 1.001}, "not equal to its matrix"),
    ({"restrict": lambda body, window: body}, "on the cells of the window"),
    (
        {"restrict": lambda body, window: Changed(body.restrict(window), apply=lambda b, p: 2 * b.apply(p))},
        "not equal to its restriction",
    ),
    (
        {"capabilities": rc.Capabilities(self_influences=lambda: np.ones(GRID.shape))},
        "not equal to its self-influences",
    ),
    (
        {
            "capabilities": rc.Capabilities(
                submatrix=lambda cells: rc.half_space(rc.Grid(cells.size, 1.0), 1.0)
            )
        },
        "axes",
    ),
    (
        {"capabilities": rc.Capabilities(approximate_inverse=lambda u: np.cumsum(u, axis=0))},
        "symmetric in its approximate",
    ),
    (
        {"capabilities": rc.Capabilities(approximate_inverse=lambda u: -u)},
        "approximate inverse of the operator is not positive definite",
    ),
    (
        {"capabilities": rc.Capabilities(single_convolution=lambda p: np.float32(2) * p)},
        "not equal to its convolution in single precision",
    ),
]


@pytest.mark.parametrize(("changed", "words"), BROKEN, ids=[words for _, words in BROKEN])
def test_what_is_broken_is_named(changed, words):
    with pytest.raises(ValueError, match=words):
        rc.check_operator(Changed(rc.half_space(GRID, 2.0), **changed))


def test_a_sum_in_single_precision_may_round_as_many_cells_do():
    """By 64 roundings times the root of the number of cells: 1.1e-4 of 216 cells."""
    body = rc.half_space(GRID, 2.0)

    def checked(error):
        able = rc.Capabilities(single_convolution=lambda p: ((1 + error) * body.apply(p)).astype(np.float32))
        return rc.check_operator(Changed(body, capabilities=able))

    assert checked(1e-4)[-1].departure == pytest.approx(1e-4, rel=1e-2)
    with pytest.raises(ValueError, match="not equal to its convolution in single precision"):
        checked(1.3e-4)


def test_a_body_that_is_unstable_is_not_definite():
    shift = 0.5

    def apply(body, p):
        return body.apply(p) - shift * p

    def as_matrix(body, cells):
        matrix = body.as_matrix(cells)
        return matrix - shift * np.eye(len(matrix))

    def restrict(body, window):
        return Changed(body.restrict(window), apply=apply, as_matrix=as_matrix)

    with pytest.raises(ValueError, match="not semidefinite"):
        rc.check_operator(
            Changed(rc.half_space(GRID, 2.0), apply=apply, as_matrix=as_matrix, restrict=restrict)
        )


def test_a_periodic_body_rests_under_a_constant_pressure_unless_it_says_otherwise():
    periodic = rc.half_space(PERIODIC, 2.0)
    foundation = rc.foundation(rc.Grid(20, 0.5, periodic=True), 2.0)
    at_rest = "at rest under a constant pressure"
    assert at_rest in [each.name for each in rc.check_operator(periodic)]
    assert at_rest not in [each.name for each in rc.check_operator(foundation)]
    with pytest.raises(ValueError, match="not at rest under a constant pressure"):
        rc.check_operator(Changed(foundation, capabilities=rc.Capabilities(semidefinite=True)))
    with pytest.raises(ValueError, match="not positive definite"):
        rc.check_operator(Changed(periodic, capabilities=rc.Capabilities(semidefinite=False)))


def test_pull_where_positive_is_stated():
    body = rc.half_space(PERIODIC, 2.0)  # its mean is at rest: far cells rise
    with pytest.raises(ValueError, match="not positive:"):
        rc.check_operator(Changed(body, capabilities=rc.Capabilities(positive=True)))


def test_the_error_of_an_inexact_sum_is_allowed():
    exact = rc.half_space(GRID, 2.0)

    def near(body, p):
        return 1.001 * body.apply(p)

    body = Changed(exact, apply=near)
    with pytest.raises(ValueError, match="not equal to its matrix"):
        rc.check_operator(body)
    body.capabilities = rc.Capabilities(exact=exact)

    def restrict(body, window):
        return Changed(body.restrict(window), apply=near)

    body.changed["restrict"] = restrict
    checks = rc.check_operator(body)
    assert max(each.departure for each in checks) == pytest.approx(1e-3, rel=0.1)


def test_what_is_no_operator_is_refused():
    with pytest.raises(ValueError, match="grid, weights, apply, as_matrix and restrict"):
        rc.check_operator(object())


def test_checks_are_values():
    [first, *_] = rc.check_operator(rc.half_space(GRID, 2.0))
    assert dataclasses.asdict(first) == {
        "name": "repeatable",
        "departure": 0.0,
        "allowed": pytest.approx(64 * 2.0**-52 * np.sqrt(GRID.size)),
    }


def test_a_matrix_of_at_most_three_hundred_cells_is_asked_for():
    asked = []

    class Counting(Changed):
        def as_matrix(self, cells=None):
            asked.append(self.grid.size if cells is None else len(cells))
            return super().as_matrix(cells)

    rc.check_operator(Counting(rc.half_space(rc.Grid((20, 20), 1.0), 2.0)))
    assert max(asked) == 300
