"""The derivatives of every quantity against central differences, on all kinds of body."""

import numpy as np
import pytest

import roughcontact as rc
from perturbed import CASES, pair, pressed, single, uncertainty

VALUES = {"force": "force", "depth": "depth", "mean_gap": "mean_gap", "energy": "elastic_energy"}
QUANTITIES = (
    *("force_at_depth", "depth_at_force", "mean_gap_at_force", "mean_gap_at_depth"),
    *("energy_at_force", "energy_at_depth"),
)
# Relative to the largest entry, or, where the entry of first touch has cancelled, to the 1 that it is.
WANTED = dict.fromkeys(QUANTITIES, 1e-8) | {"energy_at_force": 1e-6}


def directions(state, rng):
    """Return cells by what they are, and random directions."""
    separation = state.problem.separation
    inside = np.where(state.contact, state.pressure, np.inf)
    outside = np.argwhere(~state.contact & np.isfinite(separation))
    cells = {
        "highest": np.unravel_index(separation.argmin(), separation.shape),
        "rim": np.unravel_index(inside.argmin(), inside.shape),
        "open": outside[rng.integers(len(outside))],
        "inside": np.unravel_index(state.pressure.argmax(), inside.shape),
    }
    return cells, [rng.normal(size=separation.shape) for _ in range(2)]


def numeric(quantity, states, step):
    name, _, _ = quantity.partition("_at_")
    forth, back = (getattr(state, VALUES[name]) for state in states)
    return (forth - back) / (2 * step)


def allowed(quantity, state, states, step):
    """Return the error of a central difference: all quantities are linear between the two states, or quadratic.

    An error of the depth changes the force by the stiffness times it and the energy by the force; the mean gap
    changes by the closing of the gap, at most 1 and the error of the depth itself.
    """
    scale = {
        "force": state.stiffness,
        "depth": 1.0,
        "mean_gap": 2.0,
        "energy": 2.0 * state.force,
    }[quantity.partition("_at_")[0]]
    return scale * sum(uncertainty(each) for each in states) / (2 * step)


@pytest.mark.parametrize("name", CASES)
def test_all_quantities(name):
    """Pairs of loads between which a cell opens or touches are discarded, at most a fifth of them."""
    case, rng = CASES[name](), np.random.default_rng(5)
    state = pressed(case)
    found, size = rc.sensitivity(state), np.sqrt(state.contact.size)
    cells, random = directions(state, rng)
    tried = [(single(case, cell), 1.0) for cell in cells.values()] + [(each, size) for each in random]
    discarded = 0
    for direction, length in tried:
        along = found.along(direction)
        for held, load in (("force", {"force": case.force}), ("depth", {"depth": state.depth})):
            differences = pair(case, direction, **load)
            if differences is None:
                discarded += 1
                continue
            *states, step = differences
            for quantity in (each for each in QUANTITIES if each.endswith(held)):
                error = abs(numeric(quantity, states, step) - along[quantity])
                largest = abs(getattr(found, quantity)).max()
                if quantity == "mean_gap_at_force":  # the depth and its entry of 1 cancel, but for rounding
                    largest = 1.0
                assert error <= length * allowed(quantity, state, states, step), (quantity, length)
                assert error <= WANTED[quantity] * length * largest, (quantity, length)
    assert discarded <= 2 * len(tried) / 5
