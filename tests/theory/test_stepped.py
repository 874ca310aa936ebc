"""The stepped indenter of section 4.4.1."""

import numpy as np
import pytest

from roughcontact.theory.spheres_and_punches import punch
from roughcontact.theory.springs.stepped import SteppedIndenter


def test_geometry():
    steps = SteppedIndenter(radius=2.0, height=0.1, ratio=2.0, hurst=0.5)
    np.testing.assert_allclose(steps.radii(4), [2, 4, 8, 16], rtol=1e-15)
    np.testing.assert_allclose(steps.heights(4), 0.1 * np.sqrt([1, 2, 4, 8]), rtol=1e-15)


@pytest.mark.parametrize("hurst", [0.0, 0.5, 1.0])
def test_slope_far_from_the_tip(hurst):
    """Eq. 4.24, and the share of the last cylinder in eq. 4.23: 1 - C^-(H+1) of the force."""
    steps = SteppedIndenter(radius=1.0, height=1.0, ratio=3.0, hurst=hurst)
    force, stiffness = steps.corners(40, 1.0)
    slope = np.log(stiffness[-1] / stiffness[-2]) / np.log(force[-1] / force[-2])
    assert slope == pytest.approx(1 / (1 + hurst), rel=1e-12)
    last = stiffness[-1] * steps.heights(40)[-1] / force[-1]
    assert last == pytest.approx(1 - 3.0 ** -(1 + hurst), rel=1e-12)


def test_staircase():
    steps = SteppedIndenter(radius=1.0, height=1.0, ratio=2.0, hurst=0.0)
    # k = 2, 4, 8 and forces 2, 6, 14 at the corners.
    assert steps.stiffness(np.array([0.0, 1.9, 2.0, 5.9, 6.1, 1e9]), 3, 1.0).tolist() == [2, 2, 4, 4, 8, 8]
    assert steps.stiffness(1.0, 3, 1.0) == 2


@pytest.mark.parametrize(("ratio", "share"), [(1.5, 0.94), (2.0, 0.98)])
def test_a_new_cylinder_is_nearly_a_whole_disc(ratio, share):
    assert punch.annulus(1.0, ratio, 1.0) > share * punch.disc(1.0, ratio)


def test_refusals():
    with pytest.raises(ValueError, match="ratio must exceed 1"):
        SteppedIndenter(1.0, 1.0, 1.0, 0.5)
    with pytest.raises(ValueError, match="hurst must not be negative"):
        SteppedIndenter(1.0, 1.0, 2.0, -0.1)
    with pytest.raises(ValueError, match="height"):
        SteppedIndenter(1.0, 0.0, 2.0, 0.5)
