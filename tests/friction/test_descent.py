"""Down the energy: what Newton's method falls back on, by itself."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
import roughcontact.friction.descent as descent
from libraries import LIBRARIES
from roughcontact.friction.contact_cells import ContactCells
from roughcontact.friction.coulomb import lengths
from roughcontact.friction.descent import descended
from roughcontact.friction.newton import SlipNewton
from roughcontact.friction.slip_step import SlipStep
from roughcontact.solver.control import Status

BODY = rc.Solid(1.0, 0.4)


def draw(seed, put=np.asarray):
    """Return a step on half the cells of a grid, with limits of all sizes, from a state of slip."""
    rng = np.random.default_rng(seed)
    grid = rc.Grid((14, 16), (1.0, 1.5), periodic=bool(rng.random() < 0.5))
    k, contact = rng.integers(1, 3), rng.random(grid.shape) < 0.5
    n = int(contact.sum())
    interface = ContactCells.of(
        rc.shear_half_space(grid, BODY), put(contact, "bool"), None if k == 2 else (0.6, 0.8)
    )
    limit = 10 ** rng.normal(0, 0.5, n)
    slip = rng.standard_normal((k, n)) * limit.mean() * interface.self_influence
    start, load = np.zeros((k, n)), rng.standard_normal(k)
    force = 0.8 * load / np.linalg.norm(load) * limit.sum() * interface.area if rng.random() < 0.5 else None
    shift = None if force is not None else load * limit.max() * interface.self_influence
    step = SlipStep(interface, put(limit), put(start), put(slip), force, shift, 0.0, 1e-8)
    return step, put(rng.standard_normal((k, n)) * limit)


@pytest.mark.parametrize("seed", range(20))
def test_slip_is_the_slope_of_the_energy(seed):
    """By differences, which are exact for a square but for rounding, 1e-16 of the energies over a thousandth."""
    step, way = draw(seed)
    if step.force is not None:
        way -= way.mean(axis=1, keepdims=True)
    q = step.admitted(step.traction)
    here, there, back = (step.state(q + part * way) for part in (0.0, 1e-3, -1e-3))
    slope = (step.energy(there) - step.energy(back)) / 2e-3
    terms = here.slipped * way
    assert slope == pytest.approx(terms.sum(), rel=0, abs=1e-11 * np.abs(terms).sum())


@pytest.mark.parametrize("seed", range(20))
def test_first_to_the_lowest_point_between(seed, monkeypatch):
    monkeypatch.setattr(descent, "GRADIENT_STEPS", 0)
    step, way = draw(seed)
    state = step.state(step.admitted(step.traction))
    trial = step.state(step.admitted(state.traction + 3 * way))
    lowest, products = descended(step, state, trial)
    parts = np.linspace(0, 1, 11)
    between = [step.state(state.traction + part * (trial.traction - state.traction)) for part in parts]
    energies = [step.energy(here) for here in between]
    assert step.energy(lowest) <= min(energies) + 1e-12 * np.ptp(energies)
    assert products == 0


@pytest.mark.parametrize("k", [1, 2])
def test_then_down_its_slope(k, monkeypatch):
    """All are to move alike, and the trial was a short wave, by whose small curvature a gradient step goes too far."""
    monkeypatch.setattr(descent, "GRADIENT_STEPS", 1)
    operator = rc.shear_half_space(rc.Grid((20, 20), 1.0), BODY)
    interface = ContactCells.of(operator, np.ones((20, 20), bool), None if k == 2 else (1, 0))
    nothing, short = interface.zeros(), np.tile((-1.0) ** np.add.outer(range(20), range(20)).ravel(), (k, 1))
    step = SlipStep(interface, np.full(400, 30.0), nothing, nothing, None, np.ones(k), 0.0, 1e-8)
    state, trial = step.state(nothing), step.state(1e-3 * short)
    lower, products = descended(step, state, trial)
    assert step.energy(lower) < min(step.energy(state), step.energy(trial))
    assert 2 <= products <= 4
    assert (lengths(lower.traction) <= 30).all()


@pytest.mark.parametrize("seed", range(8))
def test_falling_energy_alone_leads_to_the_answer(seed):
    step, _ = draw(seed)
    state = step.state(step.admitted(step.traction))
    for _ in range(400):
        if state.residual <= step.tolerance:
            break
        state, _ = descended(step, state, state)
    found = SlipNewton().run(step)
    assert found.status is Status.CONVERGED
    assert state.exact
    np.testing.assert_allclose(state.traction, found.traction, rtol=0, atol=1e-6 * step.limit.max())
    assert step.energy(state) == pytest.approx(step.energy(step.state(found.traction)), rel=1e-12)


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("seed", range(4))
def test_on_arrays_of_other_libraries(library, seed):
    (step, way), (there, _) = draw(seed), draw(seed, library.put)
    answers = []
    for this, far in ((step, way), (there, library.put(way))):
        state = this.state(this.admitted(this.traction))
        answers.append((this, *descended(this, state, this.state(this.admitted(state.traction + 3 * far)))))
    (_, here, steps), (_, found, others) = answers
    assert steps == others
    assert library.is_there(found.traction)
    np.testing.assert_allclose(
        library.get(found.traction), here.traction, rtol=0, atol=1e-9 * step.limit.max()
    )
    assert there.energy(found) == pytest.approx(step.energy(here), rel=1e-9)


def test_what_does_not_hold_still_is_given_up():
    """A product with noise of a millionth, another one each time: neither residual nor energy can fall for ever."""
    step, _ = draw(0)
    rng = np.random.default_rng(0)

    class Noisy:
        grid, weights = step.interface.operator.grid, step.interface.operator.weights
        capabilities = step.interface.operator.capabilities

        @staticmethod
        def apply(traction):
            return step.interface.operator.apply(traction) * (1 + 1e-6 * rng.standard_normal(traction.shape))

    noisy = replace(step, interface=replace(step.interface, operator=Noisy, exact=Noisy))
    found = SlipNewton().run(noisy)
    assert found.status is Status.STAGNATED
    assert 1e-8 < found.residual < 1e-4
    assert found.steps < 2000
