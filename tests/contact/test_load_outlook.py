"""Which loads will be resolved, against which loads are."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.loads.load_outlook import load_outlook
from roughcontact.solver.loads import Loads
from roughcontact.statistics.fit_window import CELLS

MODULUS, RMS = 1e11, 1e-7


def surface_of(cells, hurst, periodic):
    grid = rc.Grid((cells, cells), 1e-6, periodic)
    return rc.self_affine(grid, hurst, RMS, np.random.default_rng(1))


@pytest.mark.parametrize(
    ("cells", "hurst", "periodic"), [(64, 0.8, False), (192, 0.8, False), (192, 0.3, True)]
)
@pytest.mark.parametrize("ends", [(1e-6, 1e-4), (1e-5, 1.0), (0.1, 30.0)])
def test_it_says_what_the_curve_will_say(cells, hurst, periodic, ends):
    """Of maps on which the blocks are the map itself, and of larger ones."""
    surface = surface_of(cells, hurst, periodic)
    forces = np.geomspace(*ends, 7) * MODULUS * RMS * cells * 1e-6
    ahead = load_outlook(surface, MODULUS, Loads("force", forces))
    curve = rc.loading_curve(surface, MODULUS, forces=forces)
    assert ahead.below == np.count_nonzero(curve.stiffness < CELLS * curve.cell_stiffness)
    assert (ahead.count, ahead.resolved) == (7, np.count_nonzero(curve.resolved))


def test_pressures_are_forces_over_the_area():
    surface = surface_of(64, 0.8, False)
    forces = np.geomspace(1e-3, 30.0, 6) * MODULUS * RMS * 64e-6
    by_force = load_outlook(surface, MODULUS, Loads("force", forces))
    assert load_outlook(surface, MODULUS, Loads("pressure", forces / surface.grid.area)) == by_force
    assert 0 < by_force.below < by_force.below + by_force.above < 6


@pytest.mark.parametrize("body", [rc.line, rc.foundation])
def test_of_profiles(body):
    line = rc.self_affine(rc.Grid(512, 1e-6), 0.8, RMS, np.random.default_rng(2))
    operator = body(line.grid, MODULUS)
    length = 1.0 if body is rc.line else 512e-6
    forces = np.geomspace(1e-5, 100.0, 9) * MODULUS * RMS * length
    ahead = load_outlook(line, MODULUS, Loads("force", forces), operator)
    curve = rc.loading_curve(line, MODULUS, forces=forces, operator=operator)
    assert ahead.resolved == np.count_nonzero(curve.resolved)
    assert 0 < ahead.below < 9


def test_a_pressure_is_positive():
    with pytest.raises(ValueError, match="positive"):
        load_outlook(surface_of(64, 0.8, False), MODULUS, Loads("pressure", [-1.0]))
