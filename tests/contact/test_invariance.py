"""Scale laws: the answer changes exactly as it must."""

import numpy as np
import pytest

import roughcontact as rc

N, FORCE = 48, 1e-3


def base(periodic, heights=1.0, lengths=1.0, offset=0.0):
    made = rc.self_affine(rc.Grid((N, N), lengths / N, periodic), 0.7, 0.01, np.random.default_rng(4))
    return rc.Surface(made.heights * heights + offset, made.grid)


@pytest.fixture(params=[False, True], ids=["free", "periodic"])
def periodic(request):
    return request.param


@pytest.fixture
def reference(periodic):
    return rc.press(base(periodic), 1.0, force=FORCE, tolerance=1e-10)


def same(solution, reference, *, pressure=1.0, depth=1.0, stiffness=1.0, rel=1e-9):
    """To the certificates of both sides, 1e-10 each, times the condition of the map from gap to pressure."""
    np.testing.assert_allclose(
        solution.pressure / pressure, reference.pressure, rtol=0, atol=100 * rel * reference.pressure.max()
    )
    assert solution.depth / depth == pytest.approx(reference.depth, rel=rel)
    assert solution.stiffness / stiffness == pytest.approx(reference.stiffness, rel=100 * rel)


def test_modulus(periodic, reference):
    solution = rc.press(base(periodic), 10.0, force=10 * FORCE, tolerance=1e-10)
    same(solution, reference, pressure=10, stiffness=10)


def test_all_lengths(periodic, reference):
    """All lengths by 1e-6: forces by 1e-12, the pressure stays."""
    solution = rc.press(base(periodic, 1e-6, 1e-6), 1.0, force=FORCE * 1e-12, tolerance=1e-10)
    same(solution, reference, depth=1e-6, stiffness=1e-6)
    assert solution.mean_gap == pytest.approx(reference.mean_gap * 1e-6, rel=1e-9)
    assert solution.elastic_energy == pytest.approx(reference.elastic_energy * 1e-18, rel=1e-8)


@pytest.mark.parametrize("factor", [1e-3, 7.0])
def test_heights(periodic, reference, factor):
    """Eqs 4.10 and 4.11 as corrected: F2(b d) = b F1(d), k2(b d) = k1(d)."""
    solution = rc.press(base(periodic, factor), 1.0, force=factor * FORCE, tolerance=1e-10)
    same(solution, reference, pressure=factor, depth=factor)


def test_offset(periodic, reference):
    """A million rms heights cost ten of sixteen digits of the heights, and nothing else."""
    solution = rc.press(base(periodic, offset=1e4), 1.0, force=FORCE, tolerance=1e-10)
    same(solution, reference, rel=1e-9)
    np.testing.assert_array_equal(solution.contact, reference.contact)


@pytest.mark.parametrize("turn", [np.flipud, np.fliplr, np.transpose, np.rot90])
def test_symmetries(periodic, reference, turn):
    surface = base(periodic)
    solution = rc.press(rc.Surface(turn(surface.heights), surface.grid), 1.0, force=FORCE, tolerance=1e-10)
    np.testing.assert_allclose(
        solution.pressure, turn(reference.pressure), rtol=0, atol=1e-7 * reference.pressure.max()
    )
    assert solution.depth == pytest.approx(reference.depth, rel=1e-9)
    assert solution.stiffness == pytest.approx(reference.stiffness, rel=1e-7)


def test_a_periodic_surface_may_be_shifted(reference, periodic):
    if not periodic:
        pytest.skip("only a periodic surface has no edge")
    surface = base(True)
    moved = rc.Surface(np.roll(surface.heights, (5, 17), (0, 1)), surface.grid)
    solution = rc.press(moved, 1.0, force=FORCE, tolerance=1e-10)
    np.testing.assert_allclose(
        np.roll(solution.pressure, (-5, -17), (0, 1)),
        reference.pressure,
        rtol=0,
        atol=1e-7 * reference.pressure.max(),
    )


def ring(length, modulus, solver):
    """Press a ball on rings: of this body no inverse is known, so that its directions are what is lacking."""
    grid = rc.RadialGrid.uniform(60, length)
    profile = rc.RadialProfile(-(grid.radii**2) / (2 * length), grid)
    return rc.press(profile, modulus, force=0.05 * modulus * length**2, solver=solver)


def plane(length, modulus, solver):
    heights = length * base(False).heights
    surface = rc.Surface(heights, rc.Grid((N, N), length / N))
    return rc.press(surface, modulus, force=0.02 * modulus * length**2, solver=solver)


@pytest.mark.parametrize("solver", [rc.ActiveSet(), rc.ActiveSet(dense_limit=0), rc.PolonskyKeer()], ids=repr)
@pytest.mark.parametrize("press", [ring, plane])
def test_units_take_no_steps(press, solver):
    """Powers of four round nothing, nor do their roots: every step is the same, in any unit."""
    reference = press(1.0, 1.0, solver)
    for length, modulus in ((4.0**-10, 4.0**18), (4.0**-15, 4.0**20), (4.0**5, 4.0**-5)):
        solution = press(length, modulus, solver)
        assert solution.steps == reference.steps
        np.testing.assert_array_equal(solution.pressure, modulus * reference.pressure)
        assert solution.stiffness == modulus * length * reference.stiffness
