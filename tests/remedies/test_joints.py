"""What a cycle of shear refuses: the message is followed, and the numbers are there."""

import numpy as np
import pytest

import roughcontact as rc
from followed import PERIODIC, ROUGH, follow, row

STEEL = rc.Solid(205e9, 0.29)
PAIR = (STEEL, STEEL)
PRESSURES = [2.5e8, 5e8, 7.5e8, 1e9, 1.5e9]


def pressed(surface=PERIODIC, pressure=1e9):
    return rc.press(surface, PAIR, pressure=pressure)


def cycle(solution=None, friction=0.3, **named):
    given = {"steps": 1} | (
        named if "traction" in named or "displacement" in named else {"traction": 1e8} | named
    )
    return rc.shear_cycle(solution or pressed(), PAIR, friction=friction, **given)


def law(friction=0.3, pressures=PRESSURES, bodies=PAIR, surface=PERIODIC):
    return rc.shear_law(rc.loading_curve(surface, bodies, pressures=pressures), bodies, friction=friction)


def heat(*pressures, other=PERIODIC):
    return rc.cycle_heat(law(), pressed(pressure=pressures[0]), pressed(other, pressures[1]))


CYCLES = [
    row(
        lambda: cycle(traction=None),
        "give exactly one of traction and displacement: none is given",
        lambda: cycle(traction=1e8),
        lambda: cycle(displacement=1e-9),
    ),
    row(
        lambda: cycle(traction=0.0),
        "the amplitude of the traction must not be zero",
        lambda: cycle(traction=1e5),
    ),
    row(
        lambda: cycle(traction=3.5e8),
        "mu p = 3e+08 Pa, and 3.5e+08 Pa are given: give a smaller traction, or press harder",
        lambda: cycle(traction=3e8),
        lambda: cycle(pressed(pressure=1.5e9), traction=3.5e8),
    ),
    row(
        lambda: cycle(pressed(ROUGH), displacement=1e-9),
        "only on a periodic map without missing cells: give a traction",
        lambda: cycle(pressed(ROUGH), traction=1e8),
        lambda: cycle(pressed(PERIODIC), displacement=1e-9),
    ),
    row(
        lambda: cycle(pressed(pressure=1e12)),
        "cannot move against each other while they stick: press with a smaller load",
        lambda: cycle(pressed(pressure=1e9)),
    ),
    row(
        lambda: cycle(law=law(friction=0.2)),
        "the law has friction 0.2 and",
        lambda: cycle(law=law(friction=0.3)),
    ),
    row(
        lambda: cycle(law=law(pressures=[2.5e8, 5e8])),
        "use a curve whose loads include this pressure",
        lambda: cycle(law=law()),
    ),
    row(
        lambda: cycle(friction=0.0),
        "the friction coefficient must be positive and finite, not 0.0",
        lambda: cycle(friction=0.3),
    ),
    row(
        lambda: cycle(shear_strength=-1.0),
        "the shear strength [Pa] must be positive and finite",
        lambda: cycle(shear_strength=1e9),
    ),
    row(
        lambda: heat(5e8, 1e9),
        "the second at a force P - Q/mu that is not larger: press the same surface at both forces",
        lambda: heat(1e9, 5e8),
    ),
    row(
        lambda: heat(1e9, 5e8, other=ROUGH),
        "two contacts of the same grid",
        lambda: heat(1e9, 5e8),
    ),
]


@pytest.mark.parametrize("refusal", CYCLES)
def test_cycles(refusal):
    follow(refusal)


def test_a_wrong_number_of_steps_is_refused_before_anything_is_computed():
    with pytest.raises(ValueError, match="steps >= 1"):
        cycle(steps=0)
    with pytest.raises(ValueError, match="one finite number, or two"):
        cycle(traction=np.array([1.0, 2.0, 3.0]))
