"""PyTorch differentiates a loading curve with respect to heights."""

import numpy as np
import pytest

import roughcontact as rc
from gradients.unambiguous import STEP, UNCERTAIN, rough, smooth_curve

torch = pytest.importorskip("torch")

SURFACE = rough(periodic=True)
HEIGHTS = SURFACE.heights


def tensor(**options):
    return torch.tensor(HEIGHTS, requires_grad=True, **options)


def squares(curve):
    """Return a loss to which all values contribute."""
    return lambda heights: sum((each**2).sum() for each in curve(heights))


@pytest.fixture(scope="module")
def curve():
    return smooth_curve(SURFACE)


@pytest.fixture(scope="module")
def known(curve):
    """The gradient of `squares`, by NumPy."""
    values, pullback = curve.linearise(HEIGHTS)
    return pullback(*(2 * each for each in values))


@pytest.mark.parametrize("reference", ["first touch", "level"])
@pytest.mark.parametrize("held", ["force", "depth"])
@pytest.mark.parametrize("periodic", [False, True], ids=["free", "periodic"])
def test_gradcheck(periodic, held, reference):
    curve = smooth_curve(rough(periodic), held=held, reference=reference)
    heights = torch.tensor(rough(periodic).heights, requires_grad=True)
    every_cell = held == "force" and reference == "first touch"  # otherwise along random directions
    assert torch.autograd.gradcheck(
        curve, (heights,), eps=STEP, atol=UNCERTAIN, rtol=0, fast_mode=not every_cell
    )


def test_values_are_those_of_numpy_and_gradients_those_of_the_pullback(curve, known):
    heights = tensor()
    found = curve(heights)
    for here, there in zip(curve(HEIGHTS), found, strict=True):
        np.testing.assert_array_equal(there.detach().numpy(), here)
    assert isinstance(found, rc.CurveValues)
    squares(curve)(heights).backward()
    np.testing.assert_array_equal(heights.grad.numpy(), known)


def test_heights_without_gradients_are_not_recorded(curve):
    assert not curve(torch.tensor(HEIGHTS)).depth.requires_grad
    with torch.no_grad():
        assert not curve(tensor()).depth.requires_grad


def test_missing_cells_have_no_gradient():
    heights = tensor()
    with torch.no_grad():
        heights[3, 4] = torch.nan
    squares(rc.differentiable_curve(SURFACE.grid, 1.0, forces=[1.0]))(heights).backward()
    assert heights.grad[3, 4] == 0
    assert torch.isfinite(heights.grad).all()


def test_profiles_are_differentiated_too():
    grid = rc.RadialGrid.uniform(40, 1.0)
    heights = torch.tensor(-(grid.radii**2) / 2, requires_grad=True)
    depth = rc.differentiable_curve(grid, 1.0, forces=[0.01], reference="level")(heights).depth
    depth.sum().backward()
    assert float(heights.grad.sum()) == pytest.approx(
        -1, abs=1e-7
    )  # all rings raised: the depth from a level shrinks


@pytest.mark.filterwarnings(
    "ignore:`torch.jit.script:DeprecationWarning"
)  # which PyTorch's forward mode uses
def test_a_second_derivative_is_refused(curve):
    heights = tensor()
    (gradient,) = torch.autograd.grad(squares(curve)(heights), heights, create_graph=True)
    with pytest.raises(
        ValueError, match=r"second derivatives .* are zero, except where a cell starts to touch"
    ):
        (gradient**2).sum().backward()
    with pytest.raises(ValueError, match="only first derivatives"):
        torch.autograd.functional.hessian(squares(curve), heights.detach())
    with torch.autograd.forward_ad.dual_level(), pytest.raises(NotImplementedError, match="forward mode"):
        curve(torch.autograd.forward_ad.make_dual(heights, heights))


def test_batches_and_function_transforms(curve, known):
    loss, batch = squares(curve), torch.tensor(np.stack([HEIGHTS, 2 * HEIGHTS], axis=1))
    each = torch.stack([loss(one) for one in batch.unbind(1)])
    torch.testing.assert_close(torch.func.vmap(loss, in_dims=1)(batch), each, rtol=0, atol=0)
    both = torch.func.vmap(torch.func.grad(loss), in_dims=1)(batch)
    np.testing.assert_array_equal(both[0], known)
    at_once = torch.func.grad(lambda heights: torch.func.vmap(loss, in_dims=1)(heights).sum())(batch)
    np.testing.assert_array_equal(at_once[:, 1], both[1])
    rows = torch.func.jacrev(lambda heights: curve(heights).depth)(torch.tensor(HEIGHTS))
    np.testing.assert_array_equal(rows.sum(0), curve.linearise(HEIGHTS)[1](depth=np.ones(2)))


@pytest.mark.filterwarnings("ignore::UserWarning")  # PyTorch's, of what its compiler looks at
def test_compiled_functions_call_it_as_it_is(curve, known):
    heights = tensor()
    torch.compile(squares(curve), backend="eager")(heights).backward()
    np.testing.assert_array_equal(heights.grad.numpy(), known)


def test_single_precision_warns(curve, known):
    """The rounding of heights, 3e-8 of 0.3 m, changes values by 3e-8 and gradients of fixed regions not at all."""
    heights = tensor(dtype=torch.float32)
    with pytest.warns(UserWarning, match="7 digits of the largest height"):
        values = curve(heights)
    assert {each.dtype for each in values} == {torch.float32}
    sum((each**2).sum() for each in values).backward()
    assert heights.grad.dtype == torch.float32
    np.testing.assert_allclose(heights.grad, known, rtol=0, atol=1e-6 * np.abs(known).max())


def test_heights_that_cannot_be_differentiated_are_refused(curve):
    for wrong, message, right in (
        (tensor().half(), "must be of type float64, not float16: convert", lambda heights: heights.double()),
        (tensor().int(), "must be of type float64, not int32: convert", lambda heights: heights.double()),
        (tensor(device="meta"), "'meta' hold no values: create them on another", torch.zeros_like),
        (tensor()[:3], r"the shape \(3, 12\), the grid \(12, 12\)", lambda _: tensor()),
    ):
        with pytest.raises(ValueError, match=message):
            curve(wrong)
        if wrong.device.type != "meta":
            assert curve(right(wrong)).depth.shape == (2,)
    infinite = torch.tensor(HEIGHTS)
    infinite[0, 0] = torch.inf
    with pytest.raises(ValueError, match="1 height is infinite"):
        curve(infinite.requires_grad_())
