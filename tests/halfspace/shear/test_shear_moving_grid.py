"""The moving grid under tangential traction: the influence tensor, shifted to every load."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.influence.cerruti import cerruti

BODY = rc.Solid(2.0, 0.3)


def test_one_load_shows_the_influence_tensor():
    """Johnson's form, at the eight neighbours of a loaded cell and in the cell: the coupling changes sign around it."""
    dy, dx = 0.3, 0.5
    operator = rc.shear_half_space(rc.Grid((3, 3), (dy, dx)), BODY, method="moving-grid")
    q = np.zeros((2, 3, 3))
    q[:, 1, 1] = 2.0, -3.0
    y, x = (np.arange(-1, 2) * step for step in (dy, dx))
    along, across, cross = cerruti(x, y[:, None], dx, dy)
    nu, scale = 0.3, 1 / (2 * np.pi * BODY.shear_modulus)
    ux = ((1 - nu) * (along + across) + nu * along) * 2.0 - nu * cross * 3.0
    uy = nu * cross * 2.0 - ((1 - nu) * (along + across) + nu * across) * 3.0
    assert cross[0, 0] > 0 > cross[0, 2]
    np.testing.assert_allclose(operator.apply(q), scale * np.stack([ux, uy]), rtol=1e-14)


@pytest.mark.parametrize("shape", [(130, 140), (17, 2000)])
def test_equal_to_the_transforms(shape):
    """On so many cells the transforms take several slabs of columns; tractions of either sign, in corners too."""
    grid = rc.Grid(shape, (0.3, 0.5))
    rng = np.random.default_rng(0)
    q = np.where(rng.random((2, *shape)) < 0.02, rng.standard_normal((2, *shape)), 0.0)
    q[:, [0, 0, -1, -1], [0, -1, 0, -1]] = rng.standard_normal((2, 4))
    moved, transformed = (rc.shear_half_space(grid, BODY, method=m).apply(q) for m in ("moving-grid", "fft"))
    np.testing.assert_allclose(moved, transformed, rtol=0, atol=1e-14 * np.abs(transformed).max())


def test_cells_without_traction_cost_nothing():
    operator = rc.shear_half_space(rc.Grid((300, 300), 1.0), BODY, method="moving-grid")
    np.testing.assert_array_equal(operator.apply(np.zeros((2, 300, 300))), 0.0)


@pytest.mark.parametrize("method", ["moving-grid", "multilevel"])
def test_arrays_of_others_are_refused_and_not_converted(method):
    with pytest.raises(TypeError, match="only arrays of NumPy; use 'fft'"):
        rc.shear_half_space(rc.Grid((1, 1), 1.0), BODY, method=method).apply([[[1.0]], [[2.0]]])
