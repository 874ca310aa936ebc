"""What is refused of viscoelastic materials and their histories: the message is followed."""

import dataclasses

import numpy as np
import pytest

import roughcontact as rc
from followed import each, follow, row
from roughcontact import viscoelastic

SOLID = viscoelastic.standard_solid(1.0, 3.0, 1.0)
DAMPED = viscoelastic.kelvin_voigt(1.0, 1.0)
GEL = viscoelastic.power_law(1.0, 1.0, 0.3, band=(1e-2, 10.0))
LATE = viscoelastic.power_law(1.0, 1.0, 0.3, band=(20.0, 100.0))
SHEAR = rc.Viscoelastic(1.0, dashpot=1.0)
BALL = rc.mdr.indentation.indentation_curve
RISE = [0.0, 1.0, 2.0]


def curve(lowest=1e-7):
    return BALL(rc.mdr.indenter.paraboloid(1.0), 1.0, forces=np.geomspace(lowest, 0.1, 50))


def dma(loss=0.1, **frequencies):
    return viscoelastic.from_dma([1.0, 1.2, 1.4], [0.1, loss, 0.1], poisson=0.5, **frequencies)


def transfer(times, depths, material=SOLID, lowest=1e-7):
    return viscoelastic.transfer(curve(lowest), material, times, depths=depths)


ROUGH = rc.self_affine(
    rc.Grid((16, 16), 1 / 16, periodic=True), hurst=0.8, rms=0.01, rng=3, rolloff=0.5, short_cutoff=0.25
)
HOLES = rc.Surface(np.where(ROUGH.heights == ROUGH.heights.max(), np.nan, ROUGH.heights), ROUGH.grid)


def slide(surface=ROUGH, material=SOLID, **changed):
    return rc.steady_sliding(surface, material, **({"speed": 0.1, "pressure": 0.02} | changed))


def speeds(*given, **changed):
    return rc.friction_curve(ROUGH, SOLID, **({"speeds": given, "pressure": 0.02} | changed))


ROWS = [
    row(
        lambda: slide(rc.Surface(ROUGH.heights, rc.Grid((16, 16), 1 / 16))),
        "if the surface repeats itself, make the grid with periodic=True",
        lambda: slide(rc.Surface(ROUGH.heights, rc.Grid((16, 16), 1 / 16, periodic=True))),
    ),
    row(lambda: slide(HOLES), "fill them: surface.filled()", lambda: slide(HOLES.filled())),
    row(
        lambda: slide(material=viscoelastic.maxwell(1.0, 1.0)),
        "give it an equilibrium modulus",
        lambda: slide(material=dataclasses.replace(viscoelastic.maxwell(1.0, 1.0), equilibrium=0.1)),
    ),
    row(
        lambda: slide(material=1e6),
        "such as standard_solid(equilibrium, instantaneous, relaxation_time)",
        slide,
    ),
    row(lambda: slide(speed=-1.0), "must be 0 or more and finite", lambda: slide(speed=0.0)),
    row(lambda: speeds(-1.0, 0.1), "must be 0 or more and finite", lambda: speeds(0.0, 0.1)),
    row(lambda: speeds(), "must hold at least one speed", lambda: speeds(0.1)),
    row(
        lambda: slide(direction=(0, 0)),
        "must be a vector (x, y) that is not zero",
        lambda: slide(direction=(0, 1)),
    ),
    row(lambda: slide(force=0.02), "give exactly one of pressure and force", slide),
    row(lambda: slide(pressure=-1.0), "the pressure must be positive and finite", slide),
    row(
        lambda: slide(
            start=rc.press(rc.shapes.wave(rc.Grid((8, 8), 1.0, periodic=True), 1.0, 8.0), 1.0, pressure=0.1)
        ),
        "must be a contact on the grid (16, 16)",
        lambda: slide(start=rc.press(ROUGH, 1.0, pressure=0.02)),
    ),
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
    row(
        lambda: SOLID.relaxation([1.0, -1.0]),
        "times must not be negative [s], not -1: there is no response before the load",
        lambda: SOLID.relaxation([1.0, 0.0]),
    ),
    row(
        lambda: rc.Viscoelastic(1.0, 2.0, 1.0),
        "moduli must be a list, such as [0.1, 1.0], not 2.0",
        lambda: rc.Viscoelastic(1.0, [2.0], [1.0]),
    ),
    row(
        lambda: rc.Viscoelastic(1.0, (2.0, 3.0), (1.0,)),
        "each modulus needs its time: 2 moduli and 1 times are given",
        lambda: rc.Viscoelastic(1.0, (2.0, 3.0), (1.0, 2.0)),
    ),
    row(
        lambda: rc.Viscoelastic(1.0, (-2.0,), (1.0,)),
        "moduli and viscosities must be finite and not negative: 1 Pa, (-2.0,), 0 Pa s",
        lambda: rc.Viscoelastic(1.0, (0.0,), (1.0,)),
    ),
    row(
        lambda: rc.Viscoelastic(1.0, (2.0,), (0.0,)),
        "times of elements must be positive and finite [s], not (0.0,)",
        lambda: rc.Viscoelastic(1.0, (2.0,), (1e-9,)),
    ),
    row(
        lambda: rc.Viscoelastic(1.0, (2.0, 3.0), (1.0, 1.0)),
        "add the moduli of equal times",
        lambda: rc.Viscoelastic(1.0, (5.0,), (1.0,)),
    ),
    row(
        lambda: rc.Viscoelastic(0.0, (0.0,), (1.0,)),
        "a material needs a modulus or a viscosity",
        lambda: rc.Viscoelastic(1.0, (0.0,), (1.0,)),
        lambda: rc.Viscoelastic(0.0, (0.0,), (1.0,), dashpot=1.0),
    ),
    row(
        lambda: rc.Viscoelastic(1.0, band=(2.0, 1.0)),
        "band must be two positive times that rise [s], not (2.0, 1.0)",
        lambda: rc.Viscoelastic(1.0, band=(1.0, 2.0)),
    ),
    row(
        lambda: SOLID.shifted(0.0),
        "factor must be positive",
        lambda: SOLID.shifted(0.1),
    ),
    row(
        lambda: viscoelastic.standard_solid(3.0, 1.0, 1.0),
        "a standard solid softens from its instantaneous modulus 1.0 Pa to a lower one, not to 3.0 Pa",
        lambda: viscoelastic.standard_solid(1.0, 3.0, 1.0),
    ),
    row(
        lambda: viscoelastic.from_creep(1.0, [1.0, 2.0], [1.0]),
        "compliances and times must be lists of one length, not (2,) and (1,)",
        lambda: viscoelastic.from_creep(1.0, [1.0, 2.0], [1.0, 2.0]),
    ),
    row(
        lambda: viscoelastic.from_creep(1.0, [-1.0], [1.0]),
        "compliances must not be negative",
        lambda: viscoelastic.from_creep(1.0, [0.0], [1.0]),
    ),
    row(
        lambda: viscoelastic.from_creep(1.0, [1.0], [0.0]),
        "retardation times must be positive [s]",
        lambda: viscoelastic.from_creep(1.0, [1.0], [1e-9]),
    ),
    row(
        lambda: viscoelastic.from_creep(1.0, [1.0, 2.0], [1.0, 1.0]),
        "add the compliances of equal times",
        lambda: viscoelastic.from_creep(1.0, [3.0], [1.0]),
    ),
    row(
        lambda: viscoelastic.from_creep(0.0, [], []),
        "a material needs a compliance",
        lambda: viscoelastic.from_creep(1.0, [], []),
    ),
    row(
        lambda: viscoelastic.in_series(GEL, LATE),
        "extrapolate one with dataclasses.replace(material, band=None)",
        lambda: viscoelastic.in_series(dataclasses.replace(GEL, band=None), LATE),
        lambda: viscoelastic.in_series(GEL, dataclasses.replace(LATE, band=None)),
    ),
    row(
        lambda: viscoelastic.in_series(1e6, SOLID),
        "a viscoelastic material is needed, such as standard_solid(equilibrium, instantaneous, relaxation_time)",
        lambda: viscoelastic.in_series(viscoelastic.standard_solid(1e6, 2e6, 1.0), SOLID),
    ),
    row(
        lambda: viscoelastic.reduced(SOLID, "bulk", poisson=0.5),
        "kind must be 'young', 'shear' or 'reduced'",
        *each(lambda kind: viscoelastic.reduced(SOLID, kind, poisson=0.5), "young", "shear"),
        lambda: viscoelastic.reduced(SOLID, "reduced"),
    ),
    row(
        lambda: viscoelastic.reduced(SOLID, "reduced", poisson=0.5),
        "a reduced modulus needs no ratio and no bulk modulus",
        lambda: viscoelastic.reduced(SOLID, "reduced"),
    ),
    row(
        lambda: viscoelastic.reduced(SOLID, "shear"),
        "give exactly one of poisson and bulk",
        lambda: viscoelastic.reduced(SOLID, "shear", poisson=0.5),
        lambda: viscoelastic.reduced(SOLID, "shear", bulk=10.0),
    ),
    row(
        lambda: viscoelastic.reduced(SOLID, "shear", poisson=0.6),
        "poisson must be above -1 and at most 0.5, not 0.6",
        lambda: viscoelastic.reduced(SOLID, "shear", poisson=0.5),
    ),
    row(
        lambda: viscoelastic.reduced(SOLID, "young", bulk=0.3),
        "bulk must be finite and above 0.333333 Pa",
        lambda: viscoelastic.reduced(SOLID, "young", bulk=0.34),
    ),
    row(
        lambda: viscoelastic.from_dma([1.0, 2.0], [0.1, 0.1], frequencies=[1.0, 2.0], poisson=0.5),
        "a DMA table needs storage and loss at three or more frequencies",
        lambda: dma(frequencies=[1.0, 2.0, 3.0]),
    ),
    row(
        lambda: viscoelastic.power_law(1.0, 1.0, 1.0, band=(1.0, 2.0)),
        "exponent must be between 0 and 1 (given: 1)",
        lambda: viscoelastic.power_law(1.0, 1.0, 0.9, band=(1.0, 2.0)),
    ),
    row(
        lambda: viscoelastic.power_law(1.0, 1.0, 0.5, band=(1.0, 2.0), terms_per_decade=50.0),
        "terms_per_decade must lie between 0.1 and 20",
        lambda: viscoelastic.power_law(1.0, 1.0, 0.5, band=(1.0, 2.0), terms_per_decade=20.0),
    ),
    row(
        lambda: viscoelastic.transfer(1.0, SOLID, RISE, depths=[0.0, 1e-2, 1e-2]),
        "an elastic loading curve is needed, for example from rc.loading_curve or indentation_curve",
        lambda: transfer(RISE, [0.0, 1e-2, 1e-2]),
    ),
    row(
        lambda: transfer(RISE, [0.0, 1e-2, -1e-2]),
        "loads must not be negative, but the least is -0.01",
        lambda: transfer(RISE, [0.0, 1e-2, 0.0]),
    ),
    row(
        lambda: transfer(RISE, [0.0, 0.0, 0.0]),
        "a history needs a positive load",
        lambda: transfer(RISE, [0.0, 0.0, 1e-2]),
    ),
    row(
        lambda: viscoelastic.transfer(
            BALL(rc.mdr.indenter.paraboloid(1.0), 1.0, forces=[0.1]), SOLID, RISE, forces=0.1
        ),
        "compute the curve for more loads",
        lambda: viscoelastic.transfer(curve(), SOLID, RISE, forces=0.02),
    ),
]


@pytest.mark.parametrize("refusal", ROWS)
def test_the_message_is_followed(refusal):
    follow(refusal)
