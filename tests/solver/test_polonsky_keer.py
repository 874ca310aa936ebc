"""The method of Polonsky and Keer where its steps are known: full contact, other units, a punch at a given depth."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.solver.control import Depth, Force, Specification

MODULUS = 2.0


def run(operator, gap, spec, start=None):
    return rc.PolonskyKeer().run(operator, gap, spec, np.zeros(gap.shape) if start is None else start)


@pytest.mark.parametrize("amplitudes", [(1e-3, 0.0), (0.0, 1e-3), (1e-3, 1e-3), (6e-5, 1e-3)], ids=str)
def test_in_full_contact_it_takes_a_step_a_wavelength(amplitudes):
    """There it is the method of conjugate gradients. Its residual may leap: on the same cells it goes on."""
    cells = 512
    phase = 2 * np.pi * np.arange(cells) / cells
    long, short = (a * np.cos(k * phase) for a, k in zip(amplitudes, (1, 255), strict=True))
    gap = np.tile(2.0 - np.cos(9 * phase) - long - short, (2, 1))
    # By Westergaard a wave of this pressure flattens the first of the waves: the others are left for the steps.
    start = np.tile(1.0 + MODULUS / 2 * 2 * np.pi * 9 / cells * np.cos(9 * phase), (2, 1))
    grid = rc.Grid(gap.shape, 1.0, periodic=True)
    spec = Specification(Force(float(gap.size)), tolerance=1e-10)
    state = run(rc.half_space(grid, MODULUS), gap, spec, start)
    assert state.status.converged
    assert (state.pressure > 0).all()
    # Two products a step, of the residual and of the direction, and one of the residual at the end.
    assert state.steps == 2 * np.count_nonzero(amplitudes) + 1


def test_cells_that_were_wrong_join_those_that_are_free_when_it_cycles():
    """A case under a hardness: 43 products, and 93 if only cells that were both wrong and free stay free."""
    surface = rc.self_affine(rc.Grid((24, 24), 1.0), 0.8, 0.3, np.random.default_rng(4))
    depth = 0.3 * np.ptp(surface.heights)
    found = rc.press(surface, 1.0, depth=depth, hardness=0.05, solver=rc.PolonskyKeer())
    assert found.status.converged
    assert found.steps < 60


@pytest.mark.parametrize("control", [Force(3.0), Depth(0.3)], ids=str)
def test_units_that_are_powers_of_two_change_nothing(control):
    """From nothing, where at a given depth the first step is that of a single cell."""
    grid, fine = rc.Grid((12, 20), (0.5, 0.75)), rc.Grid((12, 20), (0.5 * 2.0**-20, 0.75 * 2.0**-20))
    gap = -rc.shapes.paraboloid(grid, radius=6.0).heights
    gap -= gap.min()
    one = run(rc.half_space(grid, MODULUS), gap, Specification(control))
    spec = Specification(
        type(control)(control.value * (2.0**-20 if isinstance(control, Depth) else 2.0**-10))
    )
    other = run(rc.half_space(fine, MODULUS * 2.0**30), gap * 2.0**-20, spec)
    assert one.status.converged
    assert other.steps == one.steps
    np.testing.assert_array_equal(other.pressure, one.pressure * 2.0**30)
    assert other.depth == one.depth * 2.0**-20


def test_a_flat_punch_at_a_given_depth():
    """All cells of a free body stay in contact: their pressure is that of the linear equations."""
    grid = rc.Grid((6, 9), (0.5, 0.75))
    operator = rc.half_space(grid, MODULUS)
    state = run(operator, np.zeros(grid.shape), Specification(Depth(0.1), tolerance=1e-12))
    assert state.status.converged
    exact = np.linalg.solve(operator.as_matrix(), np.full(grid.size, 0.1)).reshape(grid.shape)
    np.testing.assert_allclose(state.pressure, exact, rtol=1e-9)


@pytest.mark.parametrize("solver", [rc.PolonskyKeer(), rc.ActiveSet(), rc.ActiveSet(dense_limit=0)], ids=str)
def test_at_the_depth_of_full_contact_one_cell_has_no_pressure(solver):
    """Westergaard's wave at its first full contact; a larger constant pressure would move nothing."""
    grid = rc.Grid((24, 16), (0.5, 0.75), periodic=True)
    wave = np.cos(2 * np.pi * np.arange(24) / 24)[:, None] * np.ones(16)
    q = 2 * np.pi / grid.lengths[0]
    spec = Specification(Depth(0.1), tolerance=1e-10)
    state = solver.run(rc.half_space(grid, MODULUS), 0.1 * (1 - wave), spec, np.zeros(grid.shape))
    assert state.status.converged
    assert state.pressure.min() == 0
    exact = MODULUS * q / 2 * 0.1 * (1 + wave)
    # The shortest waves turn gaps within the tolerance into pressures that are the most.
    most = MODULUS / 2 * np.pi * np.hypot(1 / 0.5, 1 / 0.75)
    assert np.abs(state.pressure - exact).max() <= 2 * most * 1e-10 * 0.1
