"""Power laws of a thousand lines against an evaluation that shares nothing with the package."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.lines.line_curves import LineCurves
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves

POINTS = 2**13
FORCES = np.geomspace(1e-4, 0.07, 10)  # over E* h L

# H: alpha and zeta of another program, with another choice of forces, by arithmetic means.
TABLE = {0.0: (0.860, 1.40), 0.6: (0.605, 0.93), 1.0: (0.493, 0.81), 2.0: (0.356, 0.62)}


def direct(hurst, count, seed):
    """Return k/(E* L) of lines of unit rms at the forces, shape (count, forces).

    The force is convex in the height of the plane, so that Newton's method rises to it from the one at a larger force.
    """
    rng = np.random.default_rng(seed)
    n = np.arange(1, POINTS // 2)
    spectrum = np.zeros((count, POINTS // 2 + 1), dtype=complex)
    spectrum[:, 1:-1] = n ** -(hurst + 0.5) * np.exp(2j * math.pi * rng.random((count, n.size)))
    heights = np.fft.irfft(spectrum, POINTS, axis=1)
    heights /= np.sqrt((heights**2).mean(axis=1, keepdims=True))
    stiffness = np.empty((count, FORCES.size))
    z = np.full((count, 1), -np.inf)
    for j in range(FORCES.size - 1, -1, -1):
        while True:
            touching = heights > z
            springs = touching.sum(axis=1, keepdims=True)
            total = np.where(touching, heights, 0.0).sum(axis=1, keepdims=True)
            higher = (total - FORCES[j] * POINTS) / springs
            if not (higher > z + 1e-12).any():
                break
            z = np.maximum(z, higher)
        stiffness[:, j] = springs[:, 0] / POINTS
    return stiffness


def fitted(stiffness, mean):
    """Return alpha and ln zeta of a mean over lines, within the window of the table."""
    k = stiffness.mean(axis=0) if mean == "arithmetic" else np.exp(np.log(stiffness).mean(axis=0))
    inside = k > 20 / POINTS
    return np.polyfit(np.log(FORCES[inside]), np.log(k[inside]), 1)


@pytest.mark.parametrize("hurst", TABLE)
def test_alpha_and_zeta_of_a_thousand_lines(hurst):
    grid = rc.Grid(POINTS, 1 / POINTS)
    spectrum = rc.SelfAffineSpectrum(hurst, dimension=1)
    batches = rough_lines(grid, spectrum, np.random.default_rng(11), 1000, rms=1.0)
    curves = LineCurves.joined(loading_curves(h, 1 / POINTS, 1.0, forces=FORCES) for h in batches)

    groups = direct(hurst, 200, seed=12).reshape(10, 20, FORCES.size)
    for mean in ("arithmetic", "geometric"):
        fit = curves.fit(mean)
        truth = fitted(groups.reshape(200, FORCES.size), mean)
        # Standard errors of the direct evaluation by leaving out a tenth at a time.
        parts = [fitted(np.delete(groups, i, axis=0).reshape(180, FORCES.size), mean) for i in range(10)]
        error = np.std(parts, axis=0) * math.sqrt(9)
        assert abs(fit.exponent - truth[0]) < 3 * math.hypot(fit.exponent_error, error[0])
        difference = math.log(fit.prefactor) - truth[1]
        assert abs(difference) < 3 * math.hypot(fit.prefactor_error / fit.prefactor, error[1])

    # To the errors that the table states for itself.
    fit = curves.fit()
    assert fit.exponent == pytest.approx(TABLE[hurst][0], abs=0.01)
    assert fit.prefactor == pytest.approx(TABLE[hurst][1], abs=0.05)
