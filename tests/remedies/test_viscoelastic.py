"""What is refused of viscoelastic materials and their histories: the message is followed."""

import dataclasses

import numpy as np
import pytest

import roughcontact as rc
from followed import follow, row
from roughcontact import viscoelastic

SOLID = viscoelastic.standard_solid(1.0, 3.0, 1.0)
DAMPED = viscoelastic.kelvin_voigt(1.0, 1.0)
GEL = viscoelastic.power_law(1.0, 1.0, 0.3, band=(1e-2, 10.0))
SHEAR = rc.Viscoelastic(1.0, dashpot=1.0)
BALL = rc.mdr.indentation.indentation_curve
RISE = [0.0, 1.0, 2.0]


def curve(lowest=1e-7):
    return BALL(rc.mdr.indenter.paraboloid(1.0), 1.0, forces=np.geomspace(lowest, 0.1, 50))


def dma(loss=0.1, **frequencies):
    return viscoelastic.from_dma([1.0, 1.2, 1.4], [0.1, loss, 0.1], poisson=0.5, **frequencies)


def transfer(times, depths, material=SOLID, lowest=1e-7):
    return viscoelastic.transfer(curve(lowest), material, times, depths=depths)


ROWS = [
    row(
        lambda: transfer([*RISE, 3.0], [0.0, 1e-2, 5e-3, 6e-3]),
        "end the history before, or compute it in steps",
        lambda: transfer(RISE, [0.0, 1e-2, 5e-3]),
    ),
    row(
        lambda: transfer([*RISE, 5.0], [0.0, 1e-2, 5e-3, 5e-3]),
        "the contact grows again at t =",
        lambda: transfer(RISE, [0.0, 1e-2, 5e-3]),
    ),
    row(
        lambda: transfer([0.0, 1.0], [1e-2, 1e-2], DAMPED),
        "let the depth change within a time",
        lambda: transfer([0.0, 0.1, 1.0], [0.0, 1e-2, 1e-2], DAMPED),
    ),
    row(
        lambda: transfer([0.0, 1.0], [0.0, 1.0]),
        "compute the curve for more loads",
        lambda: transfer([0.0, 1.0], [0.0, 0.1]),
    ),
    row(
        lambda: transfer([0.0, 1.0], [0.0, 1e-3], lowest=1e-2),
        "compute the curve for more loads",
        lambda: transfer([0.0, 1.0], [0.0, 1e-3]),
    ),
    row(
        lambda: transfer([0.0, 1.0, 11.0], [0.0, 1e-2, 1e-2], GEL),
        "change the times, measure in a wider band, or extrapolate with dataclasses.replace(material, band=None)",
        lambda: transfer([0.0, 1.0, 9.0], [0.0, 1e-2, 1e-2], GEL),
        lambda: transfer([0.0, 1.0, 11.0], [0.0, 1e-2, 1e-2], dataclasses.replace(GEL, band=None)),
    ),
    row(
        lambda: GEL.relaxation(100.0),
        "extrapolate with dataclasses.replace(material, band=None)",
        lambda: dataclasses.replace(GEL, band=None).relaxation(100.0),
    ),
    row(
        lambda: dma(loss=0.0, frequencies=[1.0, 2.0, 3.0]),
        "leave out the rows of the table in which it is not",
        lambda: viscoelastic.from_dma([1.0] * 3, [0.1] * 3, frequencies=[1.0, 3.0, 4.0], poisson=0.5),
    ),
    row(
        lambda: dma(),
        "give exactly one of frequencies and angular_frequencies",
        lambda: dma(frequencies=[1.0, 2.0, 3.0]),
    ),
    row(
        lambda: viscoelastic.reduced(SHEAR, "young", bulk=1e3),
        "give poisson instead",
        lambda: viscoelastic.reduced(SHEAR, "young", poisson=0.4),
    ),
    row(
        lambda: SOLID.complex_modulus(-1.0),
        "give its absolute value",
        lambda: SOLID.complex_modulus(1.0),
    ),
]


@pytest.mark.parametrize("refusal", ROWS)
def test_the_message_is_followed(refusal):
    follow(refusal)
