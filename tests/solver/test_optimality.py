"""What a pressure amounts to: machine code says what arrays of any library do, and what the definitions say."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import roughcontact as rc
from libraries import Strict
from roughcontact.kernels import loader, planes
from roughcontact.slabs import passes
from roughcontact.solver.control import Depth, Force, Specification
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import Iterate, Optimality

EPS = np.finfo(np.float64).eps
FORCE, DEPTH = Specification(Force(1.0)), Specification(Depth(0.4))
CONTROLS = {"force": FORCE, "depth": DEPTH}
many = settings(max_examples=60, deadline=None, derandomize=True)


def plane(shape=(9, 14), periodic=False):
    return rc.half_space(rc.Grid(shape, (0.3, 0.2), periodic), 2.0)


PLANES = {periodic: plane(periodic=periodic) for periodic in (False, True)}


def judged(operator, spec, p, u, s):
    return Optimality.of(operator, spec, s).evaluate(Iterate(p, u, s))


def generic(function, *given, **named):
    """Return what there is without machine code."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(loader, "is_available", lambda: False)
        return function(*given, **named)


def unheard_of(*_):
    raise AssertionError("machine code does not know this")


@pytest.fixture
def without_machine_code(monkeypatch):
    """Whoever asks it is wrong."""
    for name in ("extremes", "predict_active"):
        monkeypatch.setattr(planes, name, unheard_of)


@st.composite
def givens(draw):
    """Return an operator, a pressure on some of its cells, its displacement, and a separation; some cells missing."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    operator = PLANES[draw(st.booleans())]
    there = rng.random(operator.grid.shape) >= draw(st.sampled_from([0.0, 0.2]))
    there.ravel()[rng.integers(there.size)] = True
    pressed = there & (rng.random(there.shape) < draw(st.sampled_from([0.02, 0.4, 1.0])))
    p = pressed * np.abs(rng.standard_normal(there.shape))
    return operator, p, operator.apply(p), np.where(there, np.abs(rng.standard_normal(there.shape)), math.inf)


def literally(judge, measure, spec, p, u, s):
    """Return depth, residual and scale by their definitions; and by how much rounding may move a depth."""
    weights = np.broadcast_to(measure.weights, p.shape).ravel()
    level, pressed = (u + s).ravel(), p.ravel()
    between = [k for k, one in enumerate(pressed) if 0 < one < spec.hardness]
    depth, error = spec.depth, 0.0
    if depth is None:
        parts = [weights[k] * level[k] for k in between]
        area = math.fsum(weights[k] for k in between)
        depth = math.fsum(parts) / area
        # Each product and each sum of both is rounded, and the ratio.
        error = (2 * len(parts) + 3) * EPS * math.fsum(map(abs, parts)) / area
    gap = (level - depth).reshape(p.shape)
    return depth, judge.residual(p, u, gap), np.abs(u).max(), error


def agrees(found, judge, measure, spec, *fields):
    depth, residual, scale, error = literally(judge, measure, spec, *fields)
    assert abs(found.depth - depth) <= error
    assert found.scale == scale
    if not residual < math.inf:
        assert found.residual == residual
        return
    # A gap is rounded too, and so is its ratio; whatever is off in the depth is in the gap.
    size = np.abs(residual) * scale + np.abs(depth)
    assert abs(found.residual - residual) <= (error + 2 * EPS * size) / scale + EPS * residual


@pytest.mark.parametrize("control", CONTROLS)
@many
@given(given_fields=givens())
def test_both_give_the_residual_of_the_definition(control, given_fields):
    (operator, p, u, s), spec = given_fields, CONTROLS[control]
    if not p.any():
        return
    before = [f.copy() for f in (p, u, s)]
    judge, measure = Optimality.of(operator, spec, s), Measure(operator.weights)
    for found in (judged(operator, spec, p, u, s), generic(judged, operator, spec, p, u, s)):
        agrees(found, judge, measure, spec, p, u, s)
    for one, other in zip(before, (p, u, s), strict=True):
        np.testing.assert_array_equal(one, other)


@many
@given(givens(), st.sampled_from([0.0, 0.1]), st.sampled_from([math.inf, None, 1e-3]))
def test_both_guess_the_same_region(given_fields, allowed, own):
    operator, p, u, s = given_fields
    conditions, projected = Optimality.of(operator, FORCE, s), own != math.inf
    if own is not None:
        conditions = replace(conditions, self_influence=own)
    named = {"depth": 0.4, "allowed": allowed, "first": projected}
    one = conditions.predict_free_set(Iterate(p, u, s), **named)
    two = replace(conditions, passes=None).predict_free_set(Iterate(p, u, s), **named)
    gap = u + s - 0.4
    wrong = (p * conditions.self_influence < gap) if projected else np.zeros(p.shape, bool)
    asked = (p > 0) | (gap < -allowed)
    for guess in (one, two):
        np.testing.assert_array_equal(guess.free, asked & ~wrong)
        assert guess.count == np.count_nonzero(asked & ~wrong)
        assert guess.dropped == np.count_nonzero(asked & wrong)
        np.testing.assert_array_equal(guess.support, guess.free | (p > 0))
        assert not guess.free[np.isinf(s)].any()


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("missing", [0.0, 0.1])
def test_a_solution_is_one_both_ways(control, periodic, missing):
    """Its residual is that of its gap, to the rounding of a depth that is a mean of levels."""
    operator, rng = PLANES[periodic], np.random.default_rng(3)
    s = rng.random(operator.grid.shape)
    s[rng.random(s.shape) < missing] = math.inf
    spec = Specification(Force(0.5) if control == "force" else Depth(0.3), 1e-8)
    state = rc.ActiveSet().run(operator, s, spec, np.zeros_like(s))
    assert state.status.converged
    u, judge = operator.apply(state.pressure), Optimality.of(operator, spec, s)
    for found in (
        judged(operator, spec, state.pressure, u, s),
        generic(judged, operator, spec, state.pressure, u, s),
    ):
        agrees(found, judge, Measure(operator.weights), spec, state.pressure, u, s)
        assert found.residual <= 1e-8
        assert found.depth == pytest.approx(state.depth, rel=s.size * EPS)


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("wrong", [-1e-300, -1.0, math.inf, -math.inf, math.nan])
@pytest.mark.parametrize("at", [0, 5, -1])
def test_what_is_no_pressure_has_no_residual(control, wrong, at):
    """Negative, infinite, or no number, wherever it is; whatever displacement it says that it causes."""
    operator, spec, rng = plane((5, 7)), CONTROLS[control], np.random.default_rng(0)
    p, s = rng.random((5, 7)), rng.random((5, 7))
    p.ravel()[at] = wrong
    with np.errstate(invalid="ignore"):
        answers = [np.ones_like(p), np.where(np.isfinite(p), p, wrong)]
        for u in answers:
            assert judged(operator, spec, p, u, s).residual == math.inf
            assert generic(judged, operator, spec, p, u, s).residual == math.inf


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("wrong", [math.inf, -math.inf, math.nan])
def test_a_displacement_that_is_no_number_has_no_residual(control, wrong):
    operator, spec, rng = plane((5, 7)), CONTROLS[control], np.random.default_rng(0)
    p, u, s = rng.random((3, 5, 7))
    u[3, 4] = wrong
    with np.errstate(invalid="ignore"):
        for found in (judged(operator, spec, p, u, s), generic(judged, operator, spec, p, u, s)):
            assert not found.residual <= 1e-2  # infinite, or no number


@pytest.mark.parametrize("depth", [0.0, 0.25, 2.0])
def test_no_cell_in_contact_at_a_given_depth(depth):
    """All is well if none penetrates: else a violation is relative to nothing."""
    operator, spec, s = plane((5, 7)), Specification(Depth(depth)), np.full((5, 7), 0.5)
    s[0, 0] = math.inf
    nothing = np.zeros((5, 7))
    for found in (
        judged(operator, spec, nothing, nothing, s),
        generic(judged, operator, spec, nothing, nothing, s),
    ):
        assert found[:3] == (depth, 0.0 if depth < 0.5 else math.inf, 0.0)
    conditions = Optimality.of(operator, spec, s)
    for guess in (
        asked.predict_free_set(Iterate(nothing, nothing, s), depth=depth, allowed=0.0)
        for asked in (conditions, replace(conditions, passes=None))
    ):
        np.testing.assert_array_equal(guess.free, s < depth)
        assert guess.count == (s < depth).sum()


def test_what_is_rounding_is_forgiven_both_ways():
    """At given force, down to some units in the last place; at given depth nothing is."""
    operator, s = plane((1, 2)), np.zeros((1, 2))
    p, u = np.full((1, 2), 1e6), np.array([[1.0, 1.0 + 64 * EPS]])
    for spec, wanted in ((FORCE, 16 * EPS), (Specification(Depth(1.0)), 64 * EPS / (1 + 64 * EPS))):
        for found in (judged(operator, spec, p, u, s), generic(judged, operator, spec, p, u, s)):
            assert found.residual == wanted


@pytest.mark.usefixtures("without_machine_code")
@pytest.mark.parametrize("control", CONTROLS)
def test_varying_weights(control):
    """They count in the mean; regions hang on none."""
    operator = rc.ring(rc.RadialGrid(np.r_[0.2, 0.2 + np.cumsum(np.linspace(0.1, 0.6, 30))]), 2.0)
    spec, rng = CONTROLS[control], np.random.default_rng(4)
    p, s = rng.random(30) * (rng.random(30) < 0.5), rng.random(30)
    u, measure = operator.apply(p), Measure(operator.weights)
    assert measure.varies
    agrees(judged(operator, spec, p, u, s), Optimality.of(operator, spec, s), measure, spec, p, u, s)


@pytest.mark.usefixtures("without_machine_code")
@pytest.mark.parametrize("control", CONTROLS)
def test_a_hardness(control):
    """Plastic cells are free where their gap is more than is allowed, and tell no depth."""
    operator, rng = plane((5, 7)), np.random.default_rng(4)
    spec = Specification(CONTROLS[control].control, hardness=0.5)
    p, s = np.minimum(rng.random((5, 7)), 0.5) * (rng.random((5, 7)) < 0.7), rng.random((5, 7))
    u = operator.apply(p)
    found = judged(operator, spec, p, u, s)
    conditions = Optimality.of(operator, spec, s)
    agrees(found, conditions, Measure(operator.weights), spec, p, u, s)
    held, gap = p >= 0.5, u + s - found.depth
    assert held.any()
    guess = conditions.predict_free_set(Iterate(p, u, s), depth=found.depth, allowed=0.01)
    wanted = np.where(held, gap > 0.01, (p > 0) | (gap < -0.01))
    np.testing.assert_array_equal(guess.free, wanted)
    assert (guess.count, guess.dropped) == (wanted.sum(), 0)
    np.testing.assert_array_equal(guess.support, wanted | (p > 0))


@pytest.mark.usefixtures("without_machine_code")
@pytest.mark.parametrize("kind", ["single precision", "other order", "strided", "another library"])
def test_what_lies_otherwise(kind):
    """No machine code takes it, and the answers are those of the definitions."""
    ways = {
        "single precision": lambda f: f.astype(np.float32),
        "other order": np.asfortranarray,
        "strided": lambda f: np.repeat(f, 2, axis=1)[:, ::2],
        "another library": Strict.put,
    }
    operator, eps = plane((5, 7)), float(np.finfo(np.float32).eps) if kind == "single precision" else EPS
    p, u, s = np.random.default_rng(4).random((3, 5, 7)).astype(np.float32).astype(np.float64)
    there = [ways[kind](f) for f in (p, u, s)]
    found = judged(operator, DEPTH, *there)
    _, residual, scale, _ = literally(
        Optimality.of(operator, DEPTH, s), Measure(operator.weights), DEPTH, p, u, s
    )
    # Levels, gaps and their ratio are rounded: numbers below three, of which the worst is above a third.
    assert found.residual == pytest.approx(residual, rel=24 * eps)
    assert found.scale == scale
    conditions = replace(Optimality.of(operator, DEPTH, there[2]), self_influence=0.3)
    guess = conditions.predict_free_set(Iterate(*there), depth=0.4, allowed=0.1, first=True)
    assert (guess.count, guess.dropped) == ((p * 0.3 >= u + s - 0.4).sum(), (p * 0.3 < u + s - 0.4).sum())


def test_machine_code_is_asked_where_there_is_some(monkeypatch):
    if not loader.is_available():
        pytest.skip("no machine code here")
    p, u, s = np.random.default_rng(4).random((3, 5, 7))
    asked = []
    seen = SimpleNamespace(
        fit=planes.fit,
        extremes=lambda *given: asked.append("extremes") or planes.extremes(*given),
        predict_active=lambda *given, **named: (
            asked.append("predict_active") or planes.predict_active(*given, **named)
        ),
    )
    monkeypatch.setattr(passes, "planes", seen)
    conditions = Optimality.of(plane((5, 7)), FORCE, s)
    conditions.evaluate(Iterate(p, u, s))
    conditions.predict_free_set(Iterate(p, u, s), depth=0.4, allowed=0.1)
    assert asked == ["extremes", "predict_active"]


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("control", CONTROLS)
def test_a_start_is_what_presses_scaled_to_the_force(compiled, control, monkeypatch):
    """Without tension and on measured cells only; where nothing is left the summit carries the load."""
    if not compiled:
        monkeypatch.setattr(loader, "is_available", lambda: False)
    operator, rng = plane((5, 7)), np.random.default_rng(4)
    spec, initial, separation = CONTROLS[control], rng.standard_normal((5, 7)), rng.random((5, 7))
    separation[1, 2:5], separation[3, 4] = np.inf, -1.0
    conditions = Optimality.of(operator, spec, separation)
    wanted = np.where(np.isfinite(separation), np.maximum(initial, 0.0), 0.0)
    if control == "force":
        wanted *= spec.control.value / (wanted.sum() * operator.weights)
    found = conditions.feasible_start(separation, initial)
    np.testing.assert_allclose(found, wanted, rtol=1e-14)
    alone = conditions.feasible_start(separation, -np.abs(initial))
    assert np.flatnonzero(alone).tolist() == [3 * 7 + 4]
    if control == "force":
        assert alone.sum() * operator.weights == pytest.approx(spec.control.value, rel=1e-14)
    else:
        assert operator.apply(alone)[3, 4] == pytest.approx(spec.control.value, rel=1e-12)
