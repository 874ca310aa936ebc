"""Solves that patches drive: the same certified answers, and none the worse where patches are wrong."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact import by_patches
from roughcontact.contact.active_set import ActiveSet
from roughcontact.halfspace.patches import PatchOperator

ITERATIVE = ActiveSet(dense_limit=0)


class Plain:
    """An operator that says nothing of its patches."""

    def __init__(self, operator):
        self._operator = operator

    def __getattr__(self, name):
        if name == "patches":
            raise AttributeError(name)
        value = getattr(self._operator, name)
        if name in ("restrict", "coarsened"):
            return lambda *arguments: plain(value(*arguments))
        return value


def plain(operator):
    return None if operator is None else Plain(operator)


@pytest.fixture(params=["free", "free, any shape", "periodic"])
def rough(request):
    shape = (230, 187) if request.param == "free, any shape" else (160, 160)
    grid = rc.Grid(shape, (1e-3, 1e-3), request.param == "periodic")
    return rc.self_affine(grid, hurst=0.8, rms=1e-3, rng=np.random.default_rng(5))


@pytest.fixture
def used(monkeypatch):
    """Count the products with operators on tiles."""
    counts = [0]
    apply = PatchOperator.apply

    def counted(self, pressure):
        counts[0] += 1
        return apply(self, pressure)

    monkeypatch.setattr(PatchOperator, "apply", counted)
    return counts


def pressed(surface, operator, part=0.3):
    force = part * 1e9 * surface.rms * surface.grid.lengths[0]
    return rc.press(surface, 1e9, force=force, operator=operator, solver=ITERATIVE, tolerance=1e-10)


def test_the_answer_is_that_of_the_exact_operator(rough, used):
    operator = rc.half_space(rough.grid, 1e9)
    expected = pressed(rough, plain(operator))
    assert not used[0]
    found = pressed(rough, operator)
    assert used[0] > 5
    assert found.residual <= 1e-10
    # Both gaps are closed to 1e-10 of the largest displacement: the depths, set by them, agree as well.
    scale = float(np.abs(expected.displacement).max())
    assert found.depth == pytest.approx(expected.depth, abs=2e-10 * scale)
    np.testing.assert_array_equal(found.contact, expected.contact)


def test_the_stiffness_is_that_of_the_exact_operator(rough, used):
    mask = pressed(rough, None).contact
    operator = rc.half_space(rough.grid, 1e9)
    left = np.arange(rough.grid.shape[1]) < 40  # a part of the tiles, and more cells than are factorised
    region = mask | (left & (rough.heights > np.quantile(rough.heights[:, left], 0.4)))
    expected = rc.contact_stiffness(region, rough.grid, 1e9, operator=plain(operator))
    before = used[0]
    found = rc.contact_stiffness(region, rough.grid, 1e9, operator=operator)
    if not all(rough.grid.periodic):  # a window of a period has no patches
        assert used[0] > before
    # Each unit displacement is met to 1e-7.
    assert found == pytest.approx(expected, rel=2e-7)


@dataclass(frozen=True)
class Wrong:
    """An operator on tiles that is none of the body's."""

    true: PatchOperator
    factor: float

    def __getattr__(self, name):
        return getattr(self.true, name)

    def apply(self, pressure):
        return self.factor * self.true.apply(pressure)


@pytest.mark.parametrize("factor", [-1.0, 0.05, 20.0, np.nan])
def test_wrong_patches_cost_time_and_no_more(monkeypatch, factor):
    grid = rc.Grid((128, 128), (1e-3, 1e-3))
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-3, rng=np.random.default_rng(5))
    operator = rc.half_space(grid, 1e9)
    expected = pressed(rough, plain(operator))
    honest = by_patches.patch_on

    def lying(*arguments):
        patch = honest(*arguments)
        return patch if patch is None or isinstance(patch, Wrong) else Wrong(patch, factor)

    monkeypatch.setattr("roughcontact.contact.active_set.patch_on", lying)
    monkeypatch.setattr("roughcontact.contact.prescribed.patch_on", lying)
    found = pressed(rough, operator)
    assert found.residual <= 1e-10
    assert found.depth == pytest.approx(expected.depth, rel=1e-8)
    region = rough.heights > np.quantile(rough.heights, 0.85)
    assert rc.contact_stiffness(region, grid, 1e9, operator=operator) == pytest.approx(
        rc.contact_stiffness(region, grid, 1e9, operator=plain(operator)), rel=2e-7
    )


def test_small_planes_and_full_ones_go_without():
    small = rc.half_space(rc.Grid((64, 64), (1.0, 1.0)), 1.0)
    assert by_patches.patch_on(small, np.eye(64, dtype=bool)) is None
    large = rc.half_space(rc.Grid((128, 128), (1.0, 1.0)), 1.0)
    assert by_patches.patch_on(large, np.ones((128, 128), dtype=bool)) is None
    some = by_patches.patch_on(large, np.eye(128, dtype=bool))
    assert some is not None
    assert by_patches.patch_on(large, np.eye(128, dtype=bool), some) is some
    assert by_patches.patch_on(replace(large), np.eye(128, dtype=bool)[::-1], some) is not some
