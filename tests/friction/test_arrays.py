"""Tangential loading on arrays of other libraries: what goes in comes out, and nothing goes through NumPy."""

import functools
from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from libraries import LIBRARIES
from roughcontact.friction.coulomb import projected_to_force

MU = 0.3
BODIES = (rc.Solid(1e11, 0.1), rc.Solid(3e11, 0.3))


@pytest.fixture(params=LIBRARIES, ids=lambda kind: kind.__name__)
def library(request):
    return request.param


@functools.cache
def contact(periodic):
    grid = rc.Grid((20, 16), (2e-6, 3e-6), periodic)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    return rc.press(surface, BODIES, pressure=0.02 * rc.reduced_modulus(*BODIES))


@pytest.fixture(params=[False, True], ids=["free", "periodic"])
def pressed(request):
    return contact(request.param)


@functools.cache
def slid(periodic, part, along):
    """Return a force and the host's answer to it."""
    here = contact(periodic)
    force = part * MU * here.force * (np.array([0.6, 0.8]) if along is None else 1.0)
    return force, rc.slide(here, BODIES, friction=MU, force=force, along=along)


def elsewhere(solution, library):
    """Return the very same contact in another library."""
    problem = solution.problem
    surface = rc.Surface(library.put(problem.surface.heights.copy()), problem.grid)
    bodies = replace(problem, separation=library.put(problem.separation.copy()), surface=surface)
    return replace(solution, problem=bodies, pressure=library.put(solution.pressure.copy()))


def equal(there, here, digits=1e-9):
    """Equal but for what the solver, to its tolerance of 1e-8 and in many steps, makes of rounding."""
    np.testing.assert_allclose(there, here, rtol=0, atol=digits * np.abs(here).max())


OPERATORS = {
    "free": rc.shear_half_space(rc.Grid((13, 20), (0.3, 0.5)), rc.Solid(2.0, 0.3)),
    "periodic": rc.shear_half_space(rc.Grid((12, 21), (0.3, 0.5), True), rc.Solid(2.0, 0.3)),
    "dense": rc.shear_half_space(rc.Grid((6, 7), (0.3, 0.5)), rc.Solid(2.0, 0.3), method="dense"),
}


@pytest.mark.parametrize("name", OPERATORS)
@pytest.mark.parametrize("product", ["apply", "approximate_inverse"])
@pytest.mark.parametrize(("dtype", "digits"), [("float64", 1e-14), ("float32", 1e-5)])
def test_operators(library, name, product, dtype, digits):
    """Single precision: 6e-8, times what a transform of some hundred values adds up."""
    if (name, product) == ("dense", "approximate_inverse"):
        pytest.skip("of a matrix no inverse is known")
    operator = getattr(OPERATORS[name], product)
    field = np.random.default_rng(0).standard_normal((2, *OPERATORS[name].grid.shape))
    found = operator(library.put(field, dtype))
    assert library.is_there(found)
    assert str(found.dtype).endswith(dtype)
    equal(library.get(found), operator(field), digits)


@pytest.mark.parametrize("name", OPERATORS)
def test_whole_numbers(library, name):
    field = np.arange(2 * OPERATORS[name].grid.size).reshape(2, *OPERATORS[name].grid.shape) % 3
    exact = OPERATORS[name].apply(field.astype(float))
    np.testing.assert_array_equal(OPERATORS[name].apply(field), exact)
    assert OPERATORS[name].apply(field.astype(np.float32)).dtype == np.float32
    with pytest.raises(ValueError, match=r"floating numbers, not .*int64: convert"):
        OPERATORS[name].apply(library.put(field, "int64"))


@pytest.mark.parametrize(("part", "along"), [(0.6, None), (0.97, (1.0, 2.0)), (1.0, None)])
def test_slide(library, pressed, along, part):
    force, here = slid(all(pressed.problem.grid.periodic), part, along)
    there = rc.slide(elsewhere(pressed, library), BODIES, friction=MU, force=force, along=along)
    assert there.status is here.status
    assert there.residual <= 1e-8
    for name in ("traction", "slip"):
        assert library.is_there(getattr(there, name)), name
        equal(library.get(getattr(there, name)), getattr(here, name))
    for name in ("slipping", "sticking"):
        assert library.is_there(getattr(there, name)), name
        np.testing.assert_array_equal(library.get(getattr(there, name)), getattr(here, name))
    for name in ("force", "displacement", "stiffness"):
        assert isinstance(getattr(there, name), np.ndarray), name
        equal(getattr(there, name), getattr(here, name))
    assert (there.sliding, there.notes) == (here.sliding, here.notes)
    for name in ("stick_area", "slip_area", "dissipated", "elastic_energy"):
        assert getattr(there, name) == pytest.approx(getattr(here, name), rel=1e-9), name
    told, expected = (repr(answer).split(", residual ") for answer in (there, here))
    assert told[0] == expected[0]  # a residual of rounding, as that of full sliding is, is another elsewhere
    assert there.problem.capacity == pytest.approx(here.problem.capacity, rel=1e-14)


def test_a_path(library, pressed):
    """Forth and aside: as a curve by forces, and by the displacements that it gave."""
    forces = MU * pressed.force * np.array([[0.6, 0], [-0.5, 0.5]])
    there = elsewhere(pressed, library)
    a, b = (rc.slide_curve(s, BODIES, friction=MU, forces=forces) for s in (pressed, there))
    for name in ("force", "displacement", "stick_area", "slip_area", "dissipated", "elastic_energy"):
        equal(getattr(b, name), getattr(a, name), 1e-7)
    first, last = rc.slide_path(there, BODIES, friction=MU, displacements=b.displacement)
    equal(np.array([first.force, last.force]), a.force, 1e-6)
    assert library.is_there(last.traction)


def test_the_certificate_holds_on_the_host(library, pressed):
    """Coulomb's law, written out in NumPy, on a product of the host's operator."""
    there = rc.slide(elsewhere(pressed, library), BODIES, friction=MU, force=0.6 * MU * pressed.force)
    back = there.on_host()
    assert back.on_host() is back
    assert isinstance(back.traction, np.ndarray)
    assert isinstance(back.problem.pressed.pressure, np.ndarray)
    u = rc.shear_half_space(pressed.problem.grid, BODIES).apply(back.traction)
    slip = np.hypot(*(u - back.displacement[:, None, None]))
    size, limit = np.hypot(*back.traction), MU * pressed.pressure
    assert (size <= limit * (1 + 1e-12)).all()
    sticks = pressed.contact & (size < limit * (1 - 1e-12))
    assert sticks.any()
    assert slip[sticks].max() <= 1.1e-8 * np.hypot(*u)[pressed.contact].max()
    equal(back.stiffness, there.stiffness)


def test_stiffness(library, pressed):
    mask = library.put(pressed.contact, "bool")
    grid = pressed.problem.grid
    there, here = (rc.tangential_stiffness(m, grid, BODIES) for m in (mask, pressed.contact))
    assert isinstance(there.matrix, np.ndarray)
    equal(there.matrix, here.matrix, 1e-13)  # good to the square of the tolerance, 1e-7
    assert not rc.tangential_stiffness(mask & ~mask, grid, BODIES).matrix.any()
    if all(grid.periodic):
        assert np.isinf(rc.tangential_stiffness(mask | ~mask, grid, BODIES).matrix[0, 0])
    with pytest.raises(ValueError, match=r"shape \(20, 16\) does not fit"):
        rc.tangential_stiffness(mask, rc.Grid((8, 8), 1.0), BODIES)


@pytest.mark.parametrize("k", [1, 2])
def test_forces_within_limits(library, k):
    rng = np.random.default_rng(k)
    limit = 10 ** rng.normal(0, 1, 200)
    traction, total = 2 * limit * rng.standard_normal((k, 200)), 0.6 * limit.sum() * np.ones(k)
    found = projected_to_force(library.put(traction), library.put(limit), total)
    assert library.is_there(found)
    equal(library.get(found), projected_to_force(traction, limit, total), 1e-12)


@pytest.mark.parametrize("method", ["moving-grid", "multilevel"])
def test_sums_that_know_numpy_alone_say_so(library, pressed, method):
    grid = replace(pressed.problem.grid, periodic=(False, False))
    operator = rc.shear_half_space(grid, BODIES, method=method)
    with pytest.raises(TypeError, match="only arrays of NumPy; use 'fft'"):
        operator.apply(library.put(np.ones((2, *grid.shape))))
