"""What is refused of viscoelastic contacts in time: the message is followed."""

import dataclasses

import numpy as np
import pytest

import roughcontact as rc
from followed import PERIODIC, PROFILE, follow, row

SOLID = rc.viscoelastic.standard_solid(1e8, 3e8, 1.0)
DAMPED = rc.viscoelastic.kelvin_voigt(1e8, 1.0)
GEL = dataclasses.replace(SOLID, band=(0.1, 100.0))
SMALL = 0.1 * float(np.ptp(PERIODIC.heights))


def path(surface=PERIODIC, material=SOLID, times=(0.0, 1.0), **given):
    given = {"steps": 1} | (given or {"forces": [0.0, 1e-6]})
    for state in rc.viscoelastic_path(surface, material, times=times, **given):
        assert state.status.converged


def curve(*names):
    return rc.viscoelastic_curve(
        PERIODIC,
        SOLID,
        times=[0, 1],
        forces=[0, 1e-6],
        steps=1,
        measures=[lambda solution, name=name: {name: solution.depth} for name in names],
    )


ROWS = [
    row(
        lambda: path(material=1e8),
        "a viscoelastic material is needed, such as standard_solid(equilibrium, instantaneous, relaxation_time)",
        lambda: path(material=rc.viscoelastic.standard_solid(1e8, 3e8, 1.0)),
    ),
    row(
        lambda: path(forces=[0, 1e-6], depths=[0, SMALL]),
        "give exactly one of forces, depths and pressures",
        lambda: path(forces=[0, 1e-6]),
        lambda: path(depths=[0, SMALL]),
        lambda: path(pressures=[0, 1e4]),
    ),
    row(
        lambda: path(times=[0, 1, 2]),
        "a history needs one time for each load, not (3,) and (2,)",
        lambda: path(times=[0, 1]),
    ),
    row(
        lambda: path(times=[0, np.inf]),
        "times must be finite, not inf",
        lambda: path(times=[0, 1e6]),
    ),
    row(
        lambda: path(times=[1, 0]),
        "times must not decrease, as from 1 to 0 s",
        lambda: path(times=[0, 1]),
        lambda: path(times=[1, 1]),
    ),
    row(
        lambda: path(forces=[0, -1e-6]),
        "the forces must not be negative",
        lambda: path(forces=[0, 0.0]),
    ),
    row(
        lambda: path(material=GEL, times=[0, 200]),
        "change the times, measure in a wider band, or extrapolate with dataclasses.replace(material, band=None)",
        lambda: path(material=GEL, times=[0, 100]),
        lambda: path(material=dataclasses.replace(GEL, band=(0.1, 200.0)), times=[0, 200]),
        lambda: path(material=dataclasses.replace(GEL, band=None), times=[0, 200]),
    ),
    row(
        lambda: path(material=GEL, times=[0, 0, 0.05], forces=[0, 1e-6, 1e-6]),
        "the time 0.05 s follows 0.05 s after a change of the rate of the load",
        lambda: path(material=GEL, times=[0, 0, 0.1], forces=[0, 1e-6, 1e-6]),
    ),
    row(
        lambda: path(forces=[0, 1e-6], time_tolerance=1e-8),
        "give a larger time_tolerance, or a smaller tolerance",
        lambda: path(forces=[0, 1e-6], time_tolerance=1e-7),
        lambda: path(forces=[0, 1e-6], time_tolerance=1e-8, tolerance=1e-9),
    ),
    row(
        lambda: path(material=DAMPED, times=[0, 1, 1], depths=[0, 0, SMALL]),
        "let the depth change over some time, start from depth 0, or give a material without a dashpot",
        lambda: path(material=DAMPED, times=[0, 1, 2], depths=[0, 0, SMALL]),
        lambda: path(times=[0, 1, 1], depths=[0, 0, SMALL]),
    ),
    row(
        lambda: path(material=DAMPED, depths=[SMALL, SMALL]),
        "let the depth change over some time, start from depth 0, or give a material without a dashpot",
        lambda: path(material=DAMPED, depths=[0, SMALL]),
    ),
    row(
        lambda: path(depths=[0, 1.0]),
        "give smaller depths, or forces",
        lambda: path(depths=[0, SMALL]),
        lambda: path(forces=[0, 1.0]),
    ),
    row(
        lambda: path(forces=[0, 1e-6], steps=0),
        "steps must be a whole number, at least 1",
        lambda: path(forces=[0, 1e-6], steps=1),
    ),
    row(
        lambda: path(PROFILE, forces=[0, 1e-6]),
        "line(",
        lambda: path(PROFILE, forces=[0, 1e-6], operator=rc.line(PROFILE.grid, SOLID.instantaneous)),
    ),
    row(
        lambda: path(forces=[0, 1e-6], operator=rc.half_space(PERIODIC.grid, 1e8)),
        "reduced modulus",
        lambda: path(forces=[0, 1e-6], operator=rc.half_space(PERIODIC.grid, SOLID.instantaneous)),
    ),
    row(
        lambda: curve("own", "own"),
        "two columns of the curve have the name 'own'",
        lambda: curve("own", "other"),
    ),
    row(
        lambda: curve("force"),
        "two columns of the curve have the name 'force'",
        lambda: curve("own"),
    ),
    row(
        lambda: curve().plot(quantities=("status", "depth")),
        "choose contact_area, depth or force",
        *(
            lambda name=name: curve().plot(quantities=(name, "mean_gap"))
            for name in ("contact_area", "depth", "force")
        ),
    ),
]


@pytest.mark.parametrize("refusal", ROWS)
def test_the_message_is_followed(refusal):
    follow(refusal)
