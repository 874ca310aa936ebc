"""What is refused of laws of an interface under shear: the message is followed, and the numbers are there."""

import numpy as np
import pytest

import roughcontact as rc
from followed import follow, row

GRID = rc.Grid((24, 24), 1e-6, periodic=True)
MAP = rc.self_affine(GRID, hurst=0.8, rms=1e-7, rng=1, rolloff=2e-5, short_cutoff=5e-6)
FREE = rc.Surface(MAP.heights, rc.Grid((24, 24), 1e-6))
SMOOTH = rc.Solid(2e9, 0.0)
BODIES = (SMOOTH, SMOOTH)
STIFF = rc.Solid(1e9, 0.3)
PRESSURES = np.geomspace(1e5, 4e6, 6)


def curve(surface=MAP, pressures=PRESSURES, **named):
    return rc.loading_curve(surface, BODIES, pressures=pressures, **named)


def loop():
    return rc.loading_loop(MAP, BODIES, hardness=6e7, pressures=PRESSURES)


def law(pressed=None, bodies=BODIES, friction=0.3, **named):
    return rc.shear_law(pressed or curve(), bodies, friction=friction, **named)


LINE = rc.self_affine(rc.Grid(64, 1e-6, periodic=True), hurst=0.8, rms=1e-8, rng=1)
LAW, OPEN = law(), law(curve(FREE))
ROWS = [
    row(
        lambda: rc.normal_law(
            rc.loading_curve(LINE, 1e9, forces=[1.0, 2.0], operator=rc.line(LINE.grid, 1e9))
        ),
        "needs the curve of a map, not of a line: press a map of heights",
        lambda: rc.normal_law(curve()),
    ),
    row(
        lambda: rc.normal_law(curve(hardness=6e7)),
        "pass the loop of rc.loading_loop, whose reloading branch is elastic",
        lambda: rc.normal_law(loop()),
    ),
    row(
        lambda: rc.normal_law(loop().unloading),
        "the mean gap at first touch after flow is not in the curve; pass the loop of rc.loading_loop",
        lambda: rc.normal_law(loop()),
    ),
    row(
        lambda: rc.normal_law(curve(pressures=[1e6])),
        "(loads: 1); press the map by more loads, from small ones on",
        lambda: rc.normal_law(curve(pressures=[1e5, 1e6])),
    ),
    row(
        lambda: rc.normal_law(curve(pressures=[1e5, 1e6])).fitted,
        "needs three loads, and this law has two: press the map by more loads",
        lambda: rc.normal_law(curve(pressures=[1e5, 1e6, 2e6])).fitted,
    ),
    row(
        lambda: LAW.stiffness(5e6),
        "the law holds from 0 to 4e+06 Pa (given: 5e+06); use a curve whose loads include this pressure",
        lambda: law(curve(pressures=[1e5, 1e6, 5e6])).stiffness(5e6),
    ),
    row(
        lambda: LAW.normal.pressure_at(LAW.normal.gap_at(4e6) / 2),
        "use a curve with higher loads",
        lambda: law(curve(pressures=[1e5, 1e6, 2e7])).normal.pressure_at(LAW.normal.gap_at(4e6) / 2),
    ),
    row(
        lambda: law(bodies=STIFF),
        "but were pressed with 1e+09 Pa: use the same bodies for both",
        lambda: law(rc.loading_curve(MAP, STIFF, pressures=PRESSURES), STIFF),
    ),
    row(
        lambda: law(rc.loading_curve(MAP, STIFF, pressures=PRESSURES), STIFF, exact=True),
        "of Poisson's ratio 0 and for periodic maps: leave out `exact`, or compute cycles by rc.shear_cycle",
        lambda: law(rc.loading_curve(MAP, STIFF, pressures=PRESSURES), STIFF),
        lambda: rc.shear_cycle(
            rc.press(MAP, STIFF, pressure=1e6), STIFF, friction=0.3, traction=1e5, steps=2
        ),
    ),
    row(
        lambda: LAW.displacement(0.4e6, 1e6),
        "the surfaces slide (given: 400000); give a smaller traction, or a displacement",
        lambda: LAW.displacement(0.3e6, 1e6),
        lambda: LAW.loss(1e6, displacement=2 * float(LAW.gross_slip(1e6))),
    ),
    row(
        lambda: OPEN.displacement(0.29e6, 1e6),
        "first touch is not known (given: 33333.3); give a smaller amplitude, or use a curve with smaller loads",
        lambda: OPEN.displacement(0.2e6, 1e6),
        lambda: law(curve(FREE, np.geomspace(1e4, 4e6, 6))).displacement(0.29e6, 1e6),
        lambda: LAW.displacement(0.29e6, 1e6),
    ),
    row(
        lambda: OPEN.loss(1e6, displacement=1e-6),
        "p - tau/mu lies below the lowest load of the curve",
        lambda: OPEN.loss(1e6, displacement=float(OPEN.displacement(0.26e6, 1e6))),
        lambda: LAW.loss(1e6, displacement=1e-6),
    ),
    row(
        lambda: LAW.loss(1e6, traction=1e3),
        "only single cells of the map slip (given: 1000); use the law `fitted`, whose stiffness has no steps",
        lambda: LAW.fitted.loss(1e6, traction=1e3),
    ),
    row(
        lambda: LAW.history([1e6, 1e6, 1e6], [0.0, 1e5, 4e5]),
        "at step 2 the traction 400000 Pa exceeds mu p = 300000 Pa: the surfaces slide, and their displacement is not "
        "determined; stop the history before this step, or give smaller tractions",
        lambda: LAW.history([1e6, 1e6], [0.0, 1e5]),
        lambda: LAW.history([1e6, 1e6, 1e6], [0.0, 1e5, 2e5]),
    ),
    row(
        lambda: LAW.history([1e6, 1e6], [0.0]),
        "give two rows of the same length",
        lambda: LAW.history([1e6, 1e6], [0.0, 0.0]),
    ),
    row(
        lambda: OPEN.history([1e6, 1e6], [0.0, 0.29e6]),
        "at step 1, p - tau/mu lies below the lowest load",
        lambda: OPEN.history([1e6, 1e6], [0.0, 0.2e6]),
        lambda: LAW.history([1e6, 1e6], [0.0, 0.29e6]),
    ),
    row(
        lambda: LAW.elements(1e6, count=1),
        "the backbone needs at least two elements",
        lambda: LAW.elements(1e6, count=2),
    ),
    row(
        lambda: LAW.elements(1e6, first=2.0),
        "is a fraction of the last slip (given: 2); give a number such as 0.01",
        lambda: LAW.elements(1e6, first=0.01),
    ),
    row(
        lambda: OPEN.elements(1e5),
        "elements need a pressure above 100000 Pa (given: 100000); give a larger pressure",
        lambda: OPEN.elements(2e5),
    ),
    row(
        lambda: LAW.iwan(1e6, 1e-8),
        "Iwan's distribution needs a smooth stiffness: use the law `fitted`",
        lambda: LAW.fitted.iwan(1e6, 1e-8),
    ),
]


@pytest.mark.parametrize("refusal", ROWS)
def test_laws_of_shear(refusal):
    follow(refusal)
