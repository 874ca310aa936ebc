"""Every contact that can be pulled at is answered: nearly full or a few cells, near sliding or far from it."""

import numpy as np
import pytest

import roughcontact as rc

MOST = 150  # products of a step: among a thousand such problems, on up to 200 x 256 cells, the worst took 118


def worst(answer, before):
    """Return the largest violation of Coulomb's law over the largest displacement, on a product of the whole grid."""
    problem, contact = answer.problem, answer.problem.pressed.contact
    operator = rc.shear_half_space(problem.pressed.problem.grid, problem.bodies)
    then = np.zeros((2, 1)) if before is None else before.slip[:, contact]
    moved = operator.apply(answer.traction)[:, contact]
    slip = moved - answer.displacement[:, None] - then
    traction, limit = answer.traction[:, contact], problem.friction * problem.pressed.pressure[contact]
    if problem.along is not None:  # what moves across is left out
        slip, moved = (
            np.array(problem.along) @ field * np.array(problem.along)[:, None] for field in (slip, moved)
        )
    size = np.hypot(*traction)
    assert (size <= limit * (1 + 1e-12)).all()
    assert not answer.traction[:, ~contact].any()
    unit = np.where(size < limit * (1 - 1e-12), 0.0, traction / np.where(size > 0, size, 1))
    astray = slip - np.minimum((slip * unit).sum(axis=0), 0) * unit
    violation = np.hypot(*astray).max()
    if violation <= 1e-15 * operator.as_matrix(np.zeros(1, int))[0, 0] * size.max():
        return 0.0  # uniform traction on a whole period moves nothing
    start = np.zeros(2) if before is None else before.displacement
    return violation / max(np.hypot(*moved).max(), np.hypot(*(then + start[:, None])).max())


def pressed(rng):
    """Return a rough contact, anything from a few cells to nearly all, and its bodies."""
    grid = rc.Grid(
        tuple(rng.choice([16, 24, 32, 48, 64], 2)), (1e-6, rng.choice([1e-6, 2e-6])), rng.random() < 0.5
    )
    surface = rc.self_affine(grid, hurst=rng.uniform(0.2, 1), rms=10 ** rng.uniform(-8, -7), rng=rng)
    bodies = (
        rc.Solid(1e11, rng.uniform(-0.5, 0.5)),
        rc.Solid(10 ** rng.uniform(10, 12), rng.uniform(-0.5, 0.5)),
    )
    slope = np.hypot(*np.gradient(surface.heights, *grid.spacing)).std()
    part = 10 ** rng.uniform(-2, 1)
    return rc.press(surface, bodies, pressure=part * slope * rc.reduced_modulus(*bodies)), bodies


@pytest.mark.parametrize("seed", range(36))
def test_any_contact_any_path(seed):
    """Forth and back, round a corner, or anywhere, by forces or displacements, with traction that may turn or not."""
    rng = np.random.default_rng(seed)
    solution, bodies = pressed(rng)
    friction = 10 ** rng.uniform(-1.5, 0.3)
    angles = {"cycle": [0, np.pi, 0], "corner": [0, 0.8, 1.6], "any": rng.uniform(0, 2 * np.pi, 3)}
    angle = np.array(angles[rng.choice(list(angles))])
    path = np.cos(angle) if rng.random() < 0.3 else np.stack([np.cos(angle), np.sin(angle)], axis=1)
    along = (0.6, 0.8) if path.ndim == 1 else None
    part = rng.uniform(0.05, 0.99)
    if rng.random() < 0.6 or solution.contact.all():
        loads = {"forces": part * friction * solution.force * path}
    else:
        loads = {"displacements": 2 * part * friction * solution.problem.separation.std() * path}
    before = None
    for answer in rc.slide_path(solution, bodies, friction=friction, along=along, **loads):
        assert answer.status.converged
        assert answer.residual <= 1e-8
        assert answer.steps <= MOST
        assert worst(answer, before) <= 1.01e-8
        before = answer


@pytest.mark.parametrize(
    ("shape", "periodic", "hurst", "rms", "pressure"),
    [
        ((128, 128), False, 0.8, 5e-8, 1e9),
        ((128, 128), False, 0.4, 1e-7, 3e9),
        ((96, 96), True, 0.4, 1e-7, 6e9),
    ],
)
def test_many_cells_that_flip_at_once(shape, periodic, hurst, rms, pressure):
    """Highly loaded, and much of it about to slip: Newton's method alone goes in circles here, at 2 to 80 percent."""
    surface = rc.self_affine(
        rc.Grid(shape, 1e-6, periodic), hurst=hurst, rms=rms, rng=np.random.default_rng(1)
    )
    body = rc.Solid(1e11, 0.3)
    solution = rc.press(surface, body, pressure=pressure)
    assert 0.75 < solution.contact_fraction < 0.99
    answer = rc.slide(solution, body, friction=0.3, force=0.8 * 0.3 * solution.force)
    assert answer.steps <= MOST
    assert worst(answer, None) <= 1.01e-8


@pytest.mark.parametrize("part", [1 - 1e-4, 1 - 1e-6, 1 - 1e-8])
def test_next_to_sliding(part):
    """The bodies move ever further, and at mu P on and on; beyond it there is no rest."""
    surface = rc.self_affine(rc.Grid((48, 48), 1e-6), hurst=0.8, rms=5e-8, rng=np.random.default_rng(1))
    body = rc.Solid(1e11, 0.3)
    solution = rc.press(surface, body, pressure=5e8)
    capacity = 0.3 * solution.force
    answer = rc.slide(solution, body, friction=0.3, force=part * capacity)
    assert answer.steps <= MOST
    assert worst(answer, None) <= 1.01e-8
    assert rc.slide(solution, body, friction=0.3, force=capacity).sliding
    with pytest.raises(ValueError, match="slide away"):
        rc.slide(solution, body, friction=0.3, force=(1 + 1e-8) * capacity)
