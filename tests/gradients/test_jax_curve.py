"""JAX differentiates a loading curve with respect to heights."""

from collections import Counter

import numpy as np
import pytest

import roughcontact as rc
from gradients.unambiguous import STEP, UNCERTAIN, rough, smooth_curve

jax = pytest.importorskip("jax")

SURFACE = rough(periodic=True)
HEIGHTS = SURFACE.heights


@pytest.fixture(autouse=True, scope="module")
def _double_precision():
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield
    jax.config.update("jax_enable_x64", before)


@pytest.fixture
def heights():
    return jax.numpy.asarray(HEIGHTS)


@pytest.fixture(scope="module")
def curve():
    return smooth_curve(SURFACE)


@pytest.fixture
def loss(curve):
    return lambda heights: sum((each**2).sum() for each in curve(heights))


@pytest.fixture(scope="module")
def known(curve):
    """The gradient of `loss`, by NumPy."""
    values, pullback = curve.linearise(HEIGHTS)
    return pullback(*(2 * each for each in values))


@pytest.fixture
def calls(monkeypatch):
    """Count what is computed."""
    counts, linearise = Counter(), rc.DifferentiableCurve.linearise

    def counted(curve, heights):
        counts["linearise"] += 1
        return linearise(curve, heights)

    monkeypatch.setattr(rc.DifferentiableCurve, "linearise", counted)
    return counts


@pytest.mark.parametrize("reference", ["first touch", "level"])
@pytest.mark.parametrize("held", ["force", "depth"])
@pytest.mark.parametrize("periodic", [False, True], ids=["free", "periodic"])
def test_check_grads(periodic, held, reference):
    """Along random directions of norm 12, so the uncertainty is that of a cell times 12."""
    curve = smooth_curve(rough(periodic), held=held, reference=reference)
    heights = jax.numpy.asarray(rough(periodic).heights)
    from jax.test_util import check_grads

    check_grads(curve, (heights,), order=1, modes=["rev"], eps=STEP, atol=12 * UNCERTAIN, rtol=0)


def test_values_are_those_of_numpy_and_gradients_those_of_the_pullback(curve, loss, known, heights):
    for function in (curve, jax.jit(curve)):
        found = function(heights)
        assert isinstance(found, rc.CurveValues)
        for here, there in zip(curve(HEIGHTS), found, strict=True):
            np.testing.assert_array_equal(there, here)
    for gradient in (jax.grad(loss), jax.jit(jax.grad(loss))):
        np.testing.assert_allclose(gradient(heights), known, rtol=1e-14)


def test_a_gradient_costs_one_linearisation(calls, loss, heights):
    jax.jit(jax.value_and_grad(loss))(heights)
    assert calls["linearise"] == 1
    jax.grad(lambda heights: loss(heights) + loss(2 * heights))(heights)
    assert calls["linearise"] == 3
    jax.vmap(jax.grad(loss))(jax.numpy.stack([heights, 2 * heights, 3 * heights]))
    assert calls["linearise"] == 6


def test_a_linearisation_that_is_not_kept_is_computed_again(calls, loss, known, heights):
    _, backward = jax.vjp(loss, heights)
    batch = heights * jax.numpy.arange(2.0, 10.0)[:, None, None]
    jax.vmap(lambda one: jax.vjp(loss, one)[0])(batch)  # eight forward passes
    assert calls["linearise"] == 9
    for _ in range(2):  # a used one is kept until the next forward pass
        np.testing.assert_allclose(backward(1.0)[0], known, rtol=1e-14)
        assert calls["linearise"] == 10


def test_batches_and_jacobians(curve, loss, heights):
    batch = jax.numpy.stack([heights, 2 * heights])
    each = [jax.value_and_grad(loss)(one) for one in batch]
    for function in (jax.vmap(jax.value_and_grad(loss)), jax.jit(jax.vmap(jax.value_and_grad(loss)))):
        values, gradients = function(batch)
        np.testing.assert_allclose(values, [value for value, _ in each], rtol=1e-14)
        np.testing.assert_allclose(gradients, np.stack([gradient for _, gradient in each]), rtol=1e-13)
    rows = jax.jacrev(lambda heights: curve(heights).depth)(heights)
    np.testing.assert_allclose(rows.sum(0), curve.linearise(HEIGHTS)[1](depth=np.ones(2)), rtol=0, atol=1e-15)


def test_second_derivatives_and_forward_mode_are_refused(curve, loss, heights):
    for function in (jax.hessian(loss), jax.grad(lambda heights: jax.grad(loss)(heights).sum())):
        with pytest.raises(ValueError, match=r"second derivatives .* are zero, except where a cell starts"):
            function(heights)
    with pytest.raises(TypeError, match="forward-mode"):
        jax.jvp(loss, (heights,), (heights,))


def test_missing_cells_have_no_gradient(loss, heights):
    gradient = jax.grad(loss)(heights.at[3, 4].set(np.nan))
    assert gradient[3, 4] == 0
    assert np.isfinite(gradient).all()


def test_single_precision_warns(curve, loss, known, heights):
    """The rounding of heights, 3e-8 of 0.3 m, changes values by 3e-8 and gradients of fixed regions not at all."""
    rounded = heights.astype("float32")
    with pytest.warns(UserWarning, match="jax_enable_x64"):
        gradient = jax.grad(loss)(rounded)
    with pytest.warns(UserWarning, match="7 digits of the largest height"):
        assert {each.dtype.name for each in curve(rounded)} == {"float32"}
    assert gradient.dtype.name == "float32"
    np.testing.assert_allclose(gradient, known, rtol=0, atol=1e-6 * np.abs(known).max())


def test_heights_that_cannot_be_differentiated_are_refused(curve, loss, heights):
    with pytest.raises(ValueError, match="must be of type float64, not float16: convert them to float64"):
        jax.jit(curve)(heights.astype("float16"))
    with pytest.raises(ValueError, match=r"the shape \(3, 12\), the grid \(12, 12\)"):
        jax.grad(loss)(heights[:3])
    with pytest.raises(RuntimeError, match="1 height is infinite"):
        jax.jit(loss)(heights.at[0, 0].set(np.inf)).block_until_ready()


def test_a_surface_of_jax_is_refused(heights):
    message = (
        r"heights of JAX cannot be pressed.* give np.asarray\(heights\); for .* call rc.differentiable_curve"
    )
    with pytest.raises(ValueError, match=message):
        rc.Surface(heights, SURFACE.grid)
    with pytest.raises(ValueError, match=message):
        jax.grad(lambda heights: rc.press(rc.Surface(heights, SURFACE.grid), 1.0, force=1.0).depth)(heights)
    assert rc.Surface(np.asarray(heights), SURFACE.grid).rms > 0
