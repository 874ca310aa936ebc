"""Johnson's adhesive wave: its energy release, its limits, and a computed line."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.adhesive.adhesive_wave import AdhesiveWave

AMPLITUDE = 0.01
ALPHA = 0.3
WORK = (ALPHA * math.pi * AMPLITUDE) ** 2 / 2
WAVE = AdhesiveWave(AMPLITUDE, 1.0, 1.0, WORK)


def test_a_crack_that_closes_stores_the_work_of_adhesion():
    """At given depth the elastic energy of a period grows with the half width a by 2 w: what its two edges gain."""
    a, depth = 0.2, float(WAVE.depth(0.2))

    def compliance(a):
        return -2 / math.pi * math.log(math.sin(math.pi * a))

    def elastic(a):
        # Westergaard's contact up to a, and then as a punch: both paths of loading at a fixed contact.
        bare = next(AMPLITUDE * (s - s * math.log(s)) for s in [math.sin(math.pi * a) ** 2])
        pressed = math.pi * AMPLITUDE * math.sin(math.pi * a) ** 2
        energy = quad(
            lambda x: (
                math.pi
                * AMPLITUDE
                * math.sin(math.pi * x) ** 2
                * compliance(x)
                * math.pi
                * AMPLITUDE
                * math.sin(2 * math.pi * x)
                * math.pi
            ),
            0,
            a,
        )[0]
        moved = depth - bare
        return energy + pressed * moved + moved**2 / (2 * compliance(a))

    step = 1e-4
    stored = (elastic(a + step) - elastic(a - step)) / (2 * step)
    # Differences of second order, of energies good to 1e-13 of w.
    assert stored == pytest.approx(2 * WORK, rel=1e-5)


def test_without_work_it_is_westergaards():
    bare = AdhesiveWave(AMPLITUDE, 1.0, 1.0, 1e-30)
    a = np.array([0.1, 0.25, 0.4])
    np.testing.assert_allclose(
        bare.mean_pressure(a), math.pi * AMPLITUDE * np.sin(math.pi * a) ** 2, rtol=1e-9
    )
    assert WAVE.number == pytest.approx(ALPHA, rel=1e-14)


def test_a_line_with_a_short_range_comes_near():
    """Irwin's length spans three cells of each grid: the zone beside the contact, and with it the error, is halved."""
    half_widths = np.linspace(0.05, 0.45, 4000)
    curve = WAVE.depth(half_widths)
    stable = slice(int(np.argmin(curve)), None)
    depths = np.array([0.0085, 0.006, 0.002, -0.002])
    wanted = np.interp(depths, curve[stable], WAVE.mean_pressure(half_widths)[stable])
    errors = []
    for cells in (128, 256, 512):
        grid = rc.Grid(cells, 1 / cells, True)
        surface = _wave(grid)
        adhesion = rc.Adhesion(WORK, math.sqrt(3 / cells * math.pi * WORK))
        states = rc.adhesive_path(surface, 1.0, adhesion, depths=depths, operator=rc.line(grid, 1.0))
        errors.append(np.abs(np.array([state.force for state in states]) - wanted).max())
    assert errors[1] <= errors[0] / 1.5
    assert errors[2] <= errors[1] / 1.5


def _wave(grid):
    x = grid.coordinates[0]
    return rc.Surface(AMPLITUDE * np.cos(2 * math.pi * (x - x[0])), grid)


def test_what_is_no_contact_is_refused():
    with pytest.raises(ValueError, match="half a wavelength"):
        WAVE.depth(0.5)
    with pytest.raises(ValueError, match="the amplitude"):
        AdhesiveWave(-1.0, 1.0, 1.0, 1.0)
