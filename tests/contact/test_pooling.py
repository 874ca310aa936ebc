"""The height that blocks of cells have: slopes do not count, summits do, and what is missing is left out."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.pooling import lowest, raised

SHAPES = [(8, 6), (7, 6), (8, 5), (9, 7), (1, 8), (2, 2)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("factors", [(2, 2), (1, 2), (2, 1)])
def test_lowest(shape, factors):
    field = np.random.default_rng(0).random(shape)
    found = lowest(field, factors)
    assert found.shape == tuple(-(-n // f) for n, f in zip(shape, factors, strict=True))
    for (i, j), value in np.ndenumerate(found):
        block = field[i * factors[0] : (i + 1) * factors[0], j * factors[1] : (j + 1) * factors[1]]
        assert value == block.min()


@pytest.mark.parametrize("shape", SHAPES)
def test_a_block_lies_between_its_mean_and_its_lowest_separation(shape):
    field = np.random.default_rng(1).random(shape)
    found, low = raised(field, (2, 2)), lowest(field, (2, 2))
    assert (found >= low).all()
    whole = field[: shape[0] // 2 * 2, : shape[1] // 2 * 2]
    mean = whole.reshape(shape[0] // 2, 2, shape[1] // 2, 2).mean(axis=(1, 3))
    assert (found[: shape[0] // 2, : shape[1] // 2] <= mean * (1 + 1e-15)).all()


def test_a_plane_has_its_mean():
    y, x = np.indices((8, 6)).astype(float)
    field = 3.0 + 2.0 * y - 0.5 * x
    np.testing.assert_allclose(raised(field, (2, 2)), field.reshape(4, 2, 3, 2).mean(axis=(1, 3)), rtol=1e-15)


@pytest.mark.parametrize("out", [1.0, -1.0])
def test_cells_that_stand_out_of_their_plane_raise_the_block(out):
    """By twice as far, unless its highest cell is less high."""
    saddle = 5.0 + out * np.array([[1.0, -1.0], [-1.0, 1.0]])
    assert raised(saddle, (2, 2)) == 4.0
    tilted = saddle + np.array([[0.0, 0.0], [10.0, 10.0]])
    assert raised(tilted, (2, 2)) == pytest.approx(10.0 - 2.0)


def test_blocks_with_missing_cells_have_the_lowest_of_the_rest():
    field = np.random.default_rng(2).random((6, 6))
    field[0, 0] = field[2:4, 2:4] = np.inf
    found = raised(field, (2, 2))
    assert found[0, 0] == field[:2, :2].min()
    assert found[1, 1] == np.inf
    assert np.isfinite(found).sum() == 8


@pytest.mark.parametrize("factors", [(2,), (1, 2)])
def test_without_blocks_of_two_by_two_it_is_the_lowest(factors):
    field = np.random.default_rng(3).random((6, 6)[: len(factors)])
    np.testing.assert_array_equal(raised(field, factors), lowest(field, factors))


@pytest.mark.parametrize("hurst", [-0.5, 0.8])
def test_a_rough_surface_takes_few_products_from_its_coarse_guess(hurst):
    """Both where long waves carry the contact and where short ones do; cold starts take 30 to 60."""
    rough = rc.self_affine(rc.Grid((256, 256), 1 / 256), hurst, 0.01, np.random.default_rng(0))
    solution = rc.press(rough, 1.0, force=3e-5)
    assert solution.status.converged
    assert solution.steps < 10
