"""Sizes of any unit that keeps its digits give one answer; others are refused."""

import numpy as np
import pytest

import roughcontact as rc

N = 12
EDGE = 1e48  # within 1e50: the heights are tenths of their size
STEPS = 0.1 * (np.indices((N, N)) // 3).sum(axis=0) % 0.2 + 0.01 * np.random.default_rng(0).random((N, N))


def pressed(height, length, modulus, periodic, hard):
    """Return area, depth and stiffness in units of what they scale with."""
    surface = rc.Surface(STEPS * height, rc.Grid((N, N), length, periodic))
    limit = 0.05 * modulus * height / length if hard else None
    solution = rc.press(surface, modulus, force=0.3 * modulus * height * length, hardness=limit)
    return solution.contact_area / length**2, solution.depth / height, solution.stiffness / modulus / length


@pytest.mark.parametrize("hard", [False, True])
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize(
    "sizes", [(1, 1, EDGE), (1, 1, 1 / EDGE), (1, EDGE, 1 / EDGE), (1 / EDGE,) * 3, (EDGE,) * 3]
)
def test_the_answer_depends_on_no_unit(sizes, periodic, hard):
    # Tolerances of 1e-8 on both sides.
    np.testing.assert_allclose(
        pressed(*sizes, periodic, hard), pressed(1.0, 1.0, 1.0, periodic, hard), rtol=1e-6
    )


@pytest.mark.parametrize("height", [1e-320, 1e-200, 1e-51, 1e52])
def test_heights_that_lose_their_digits_are_refused(height):
    with pytest.raises(ValueError, match=r"range of the heights .* give it in other units"):
        rc.Surface(STEPS * height, rc.Grid((N, N), 1.0))
    with pytest.raises(ValueError, match=r"range of the heights .* give it in other units"):
        rc.RadialProfile(np.linspace(1, 0, 5) * height * 0.2, rc.RadialGrid.uniform(5, 1.0))


def test_flat_surfaces_have_no_range():
    assert rc.Surface(np.full((2, 2), 1e-320), rc.Grid((2, 2), 1.0)).rms == 0


def test_the_range_of_heights_does_not_overflow():
    with pytest.raises(ValueError, match=r"range of the heights .* not inf"):
        rc.Surface(np.array([-1e308, 1e308]), rc.Grid(2, 1.0))


@pytest.mark.parametrize("length", [1e-320, 1e-155, 1e-51, 1e51])
def test_cells_whose_area_is_no_number_are_refused(length):
    """Periodic cells of 1e-155 m, of no area, ended in a ZeroDivisionError, or in no depth that claimed to converge."""
    with pytest.raises(ValueError, match="spacing must give cells between"):
        rc.Grid((N, N), length, True)
    with pytest.raises(ValueError, match="their digits"):
        rc.RadialGrid.uniform(3, length)


@pytest.mark.parametrize("modulus", [1e-320, 1e-51, 1e51, 1e300])
def test_moduli_whose_inverse_is_no_number_are_refused(modulus):
    surface = rc.Surface(STEPS, rc.Grid((N, N), 1.0))
    with pytest.raises(ValueError, match=r"reduced modulus .* must lie between"):
        rc.press(surface, modulus, force=1.0)
    with pytest.raises(ValueError, match=r"young_modulus .* must lie between"):
        rc.Solid(modulus, 0.3)
