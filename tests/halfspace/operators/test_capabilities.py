"""What operators state that they can do, and an operator that states nothing."""

from dataclasses import fields

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import (
    capabilities,
    exact_of,
    geometry_of,
    is_semidefinite,
    self_influences,
)

MEMBERS = ("grid", "weights", "apply", "as_matrix", "restrict")


class Bare:
    """An operator of a user: the five members of the protocol and nothing else."""

    def __init__(self, body):
        self.body, self.grid, self.weights = body, body.grid, body.weights

    def apply(self, pressure):
        return self.body.apply(pressure)

    def as_matrix(self, cells=None):
        return self.body.as_matrix(cells)

    def restrict(self, window):
        return Bare(self.body.restrict(window))


class Found:
    """The same, whose members `__getattr__` finds: `isinstance` of a protocol misses them from Python 3.12 on."""

    def __init__(self, body):
        self.body = body

    def __getattr__(self, name):
        if name not in MEMBERS:
            raise AttributeError(name)
        return getattr(self.body, name)


@pytest.fixture(params=[Bare, Found])
def kind(request):
    return request.param


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("solver", [rc.ActiveSet(), rc.ActiveSet(dense_limit=0), rc.PolonskyKeer()], ids=str)
def test_five_members_are_enough_to_press(kind, periodic, solver):
    """Gaps closed to 1e-10 of the largest displacement set the depths; stiffnesses are met to 1e-7."""
    rough = rc.self_affine(rc.Grid((80, 70), 1e-3, periodic), 0.8, rms=1e-3, rng=np.random.default_rng(2))
    body = rc.half_space(rough.grid, 1e9)
    force = 0.02 * 1e9 * rough.rms * rough.grid.lengths[0]
    given = {"force": force, "tolerance": 1e-10, "solver": solver}
    expected = rc.press(rough, 1e9, **given)
    found = rc.press(rough, 1e9, operator=kind(body), **given)
    assert found.status.converged
    scale = float(np.abs(expected.displacement).max())
    assert found.depth == pytest.approx(expected.depth, abs=2e-10 * scale)
    np.testing.assert_array_equal(found.contact, expected.contact)
    assert found.stiffness == pytest.approx(expected.stiffness, rel=2e-7)


def test_five_members_are_enough_for_a_curve(kind):
    rough = rc.self_affine(rc.Grid((80, 70), 1e-3), 0.8, rms=1e-3, rng=np.random.default_rng(2))
    forces = np.geomspace(2e-3, 0.1, 3) * (1e9 * rough.rms * rough.grid.lengths[0])
    given = {"forces": forces, "tolerance": 1e-10}
    expected = rc.loading_curve(rough, 1e9, **given)
    found = rc.loading_curve(rough, 1e9, operator=kind(rc.half_space(rough.grid, 1e9)), **given)
    assert all(status.converged for status in found.status)
    np.testing.assert_array_equal(found.contact_area, expected.contact_area)
    # As above; displacements are at most three times the depth here.
    np.testing.assert_allclose(found.depth, expected.depth, rtol=1e-9)
    np.testing.assert_allclose(found.stiffness, expected.stiffness, rtol=2e-7)


def test_without_a_record_nothing_is_stated(kind):
    body = rc.half_space(rc.Grid((4, 5), 1.0, True), 2.0)
    operator = kind(body)
    assert capabilities(operator) == rc.Capabilities()
    assert exact_of(operator) is operator
    assert geometry_of(operator) is Geometry.SURFACE
    assert is_semidefinite(operator)
    assert self_influences(operator) == body.as_matrix(np.zeros(1, int))[0, 0]


def test_by_default_nothing_is_there():
    nothing = rc.Capabilities()
    assert nothing.coarsened(rc.Grid((2, 2), 1.0)) is None
    assert nothing.local_inverse() is nothing.particle_mesh() is nothing.self_influences() is None


@pytest.mark.parametrize("wrong", [{"semi_definite": True}, {"exakt": None}])
def test_a_misspelt_name_is_refused(wrong):
    with pytest.raises(TypeError, match=next(iter(wrong))):
        rc.Capabilities(**wrong)


def test_names_are_asked_for():
    with pytest.raises(TypeError, match="positional"):
        rc.Capabilities(None)


def test_another_record_is_refused():
    operator = Bare(rc.half_space(rc.Grid((4, 5), 1.0), 2.0))
    operator.capabilities = {"positive": True}
    surface = rc.Surface(np.zeros((4, 5)), operator.grid)
    with pytest.raises(ValueError, match=r"must be a roughcontact.Capabilities, not \{'positive'"):
        rc.press(surface, 2.0, force=1.0, operator=operator)


@pytest.mark.parametrize(
    "make",
    [
        lambda: rc.half_space(rc.Grid((6, 8), 1.0), 2.0),
        lambda: rc.half_space(rc.Grid((6, 8), 1.0, True), 2.0),
        lambda: rc.half_space(rc.Grid((6, 8), 1.0, (True, False)), 2.0),
        lambda: rc.layer(rc.Grid((6, 8), 1.0, True), 2.0, 1.0, base="rigid-frictionless"),
        lambda: rc.half_space(rc.Grid((6, 8), 1.0), 2.0).submatrix(np.arange(5)),
    ],
)
def test_to_ask_makes_nothing(make):
    """Convolutions, tables and tiles are made when they are first used."""
    operator = make()
    before = set(vars(operator))
    stated = capabilities(operator)
    assert set(vars(operator)) == before
    assert any(getattr(stated, field.name) != field.default for field in fields(stated))
