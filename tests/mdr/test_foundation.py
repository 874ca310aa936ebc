"""Springs: what the general solver finds is what sorting finds."""

import numpy as np
import pytest

import roughcontact as rc

MODULUS = 3e9


@pytest.fixture(params=[False, True], ids=["free", "periodic"])
def line(request):
    grid = rc.Grid(400, 1e-6, request.param)
    return rc.self_affine(grid, hurst=0.7, rms=1e-6, rng=np.random.default_rng(5))


def by_sorting(heights, spacing, force):
    """The depth at which the springs that are pressed carry the force, one spring after the other."""
    below = np.sort(heights.max() - heights)
    for count in range(1, len(below) + 1):
        depth = (force / (MODULUS * spacing) + below[:count].sum()) / count
        if count == len(below) or depth <= below[count]:
            return depth, count
    raise AssertionError


@pytest.mark.parametrize("share", [1e-6, 1e-3, 0.1, 10.0])
def test_press_is_sorting(line, share):
    force = share * MODULUS * line.rms * line.grid.lengths[0]
    solution = rc.press(line, MODULUS, force=force, operator=rc.foundation(line.grid, MODULUS))
    depth, count = by_sorting(line.heights, line.grid.spacing[0], force)
    assert solution.depth == pytest.approx(depth, rel=1e-11)
    assert solution.contact.sum() == count
    assert solution.stiffness == pytest.approx(MODULUS * line.grid.spacing[0] * count, rel=1e-11)
    assert solution.force == pytest.approx(force, rel=1e-11)


def test_given_depth(line):
    solution = rc.press(line, MODULUS, depth=line.rms, operator=rc.foundation(line.grid, MODULUS))
    pressed = np.maximum(line.rms - (line.heights.max() - line.heights), 0)
    np.testing.assert_allclose(solution.pressure, MODULUS * pressed, rtol=1e-11)


def test_a_curve_and_its_law(line):
    """Saturation is E* L; dimensionless numbers are those of a surface of that length."""
    curve = rc.loading_curve(line, MODULUS, operator=rc.foundation(line.grid, MODULUS))
    assert curve.full_contact_stiffness == pytest.approx(MODULUS * line.grid.lengths[0])
    assert curve.cell_stiffness == pytest.approx(MODULUS * line.grid.spacing[0])
    assert curve.force_scale == pytest.approx(MODULUS * line.rms * line.grid.lengths[0])
    law = curve.fit()
    assert law.window[0] >= curve.force[curve.resolved][0]
    assert 0.4 < law.exponent < 0.8  # thesis, fig. 23: 1/(H+1) = 0.59; one line scatters


def test_two_axes_are_refused():
    with pytest.raises(ValueError, match="one axis"):
        rc.foundation(rc.Grid((4, 4), 1.0), 1.0)
