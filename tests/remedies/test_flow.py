"""What the flow through a gap, its fluids and the command `leak` refuse is computed when the message is followed."""

import math

import numpy as np
import pytest

import roughcontact as rc
from followed import LINE, MODULUS, PERIODIC, PLANE, PROFILE, ROUGH, commands, follow, follow_command, row

WATER, AIR = rc.Liquid(1e-3), rc.Gas("air")
LEFT, RIGHT = np.zeros((2, 16, 16), bool)
LEFT[:, 0] = RIGHT[:, -1] = True
SEAL = {"seal_width": 1e-3, "circumference": 0.1}


def pressed(surface=ROUGH, **named):
    return rc.press(surface, MODULUS, **({"pressure": 1e5} | named))


def flow(surface=ROUGH, **named):
    return rc.gap_flow(pressed(surface), **named)


def leak(fluid=WATER, surface=ROUGH, solution=None, **named):
    return rc.leak(solution or pressed(surface), fluid, **({"drop": 1e4, "axis": 0} | named))


def gas(upstream=2e5, downstream=1.9e5, solution=None, **named):
    return leak(AIR, solution=solution, **({"drop": None} | named), upstream=upstream, downstream=downstream)


def wide():
    """A rough surface whose gaps are wide for the molecules of a gas."""
    return rc.Surface(100 * ROUGH.heights, PLANE)


def rings(edges):
    grid = rc.RadialGrid(edges)
    return pressed(rc.RadialProfile(-grid.radii * 1e-3, grid), pressure=None, force=1e-3)


def hole():
    return rings(np.linspace(1e-3, 2e-3, 257))


def stuck(**named):
    return rc.adhesive_state(ROUGH, MODULUS, rc.Adhesion(1e-3, 1e-7), **({"depth": 1e-9} | named))


def slabs(array=np.asarray):
    return pressed(rc.Surface(array(PERIODIC.heights), PERIODIC.grid))


FLOWS = [
    row(
        lambda: rc.gap_flow(slabs(rc.Slabs().array)),
        "arrays of NumPy on one process: press a Surface whose heights are such an array",
        lambda: rc.gap_flow(slabs()),
    ),
    row(
        lambda: rc.gap_flow(rc.loading_curve(ROUGH, MODULUS, pressures=[1e5]), axis=0),
        "must be a Solution, as rc.press returns it, or an AdhesiveState",
        lambda: rc.gap_flow(pressed(), axis=0),
        lambda: rc.gap_flow(stuck(), axis=0, closing_gap=1e-9),
    ),
    row(
        lambda: rc.gap_flow(rc.press(PROFILE, MODULUS, force=1.0, operator=rc.line(LINE, MODULUS))),
        "through the gap of a profile: press a Surface with two axes, or a RadialProfile",
        lambda: flow(axis=0),
        lambda: rc.gap_flow(hole()),
    ),
    row(
        flow,
        "give exactly one of axis and between: none is given",
        lambda: flow(axis=0),
        lambda: flow(between=(LEFT, RIGHT)),
    ),
    row(lambda: flow(axis=2), "not 2: give axis=0", lambda: flow(axis=0)),
    row(lambda: flow(PERIODIC, axis=0), "not 0: leave axis out", lambda: flow(PERIODIC)),
    row(
        lambda: flow(rc.Surface(ROUGH.heights, rc.Grid((16, 16), 1e-6, periodic=(True, False))), axis=0),
        "not 0: give axis=1",
        lambda: flow(rc.Surface(ROUGH.heights, rc.Grid((16, 16), 1e-6, periodic=(True, False))), axis=1),
    ),
    row(
        lambda: flow(axis=0, between=(LEFT, RIGHT)),
        "give exactly one of axis and between",
        lambda: flow(axis=0),
        lambda: flow(between=(LEFT, RIGHT)),
    ),
    row(
        lambda: flow(between=(LEFT, LEFT)),
        "between must be two regions of shape (16, 16) without a common cell",
        lambda: flow(between=(LEFT, RIGHT)),
    ),
    row(
        lambda: flow(between=(LEFT, RIGHT)).interval,
        "has no interval: leave between out, and give axis on a map that is not periodic",
        lambda: flow(axis=0).interval,
        lambda: flow(PERIODIC).interval,
    ),
    row(
        lambda: flow(axis=0, missing="shut"),
        "must be 'closed' or 'open', not 'shut'",
        lambda: flow(axis=0, missing="closed"),
        lambda: flow(axis=0, missing="open"),
    ),
    row(
        lambda: flow(axis=0, slip_length=-1.0),
        "the slip length must be 0 or more [m], not -1.0",
        lambda: flow(axis=0, slip_length=0.0),
    ),
    row(
        lambda: flow(axis=0, closing_gap=-1e-9),
        "the closing gap must be 0 or more [m], not -1e-09",
        lambda: flow(axis=0, closing_gap=0.0),
    ),
    row(
        lambda: rc.gap_flow(rings(np.linspace(0, 1e-3, 65))),
        "they begin at the axis; press rings with a hole, such as rc.RadialGrid(numpy.linspace(1e-3, 2e-3, 257))",
        lambda: rc.gap_flow(hole()),
    ),
    row(
        lambda: rc.gap_flow(hole(), axis=0),
        "flows between both rims: leave axis and between out",
        lambda: rc.gap_flow(hole()),
    ),
    row(
        lambda: rc.gap_flow(hole()).flux(),
        "rings have no flux along y and x: use transmissivity and pressure(), or press a Surface",
        lambda: rc.gap_flow(hole()).transmissivity,
        lambda: rc.gap_flow(hole()).pressure(),
        lambda: flow(axis=0).flux(),
    ),
    row(
        lambda: rc.gap_flow(stuck(), axis=0),
        "give closing_gap, such as 1e-9 [m]: cells with a smaller gap are closed",
        lambda: rc.gap_flow(stuck(), axis=0, closing_gap=1e-9),
    ),
    row(
        lambda: rc.gap_flow(torn_off(), axis=0, closing_gap=1e-9),
        "the bodies are detached: the gap is infinite; give a state in contact",
        lambda: rc.gap_flow(stuck(), axis=0, closing_gap=1e-9),
    ),
]


def torn_off():
    """Return a state after pull-off."""
    return list(rc.adhesive_path(ROUGH, MODULUS, rc.Adhesion(1e-3, 1e-7), forces=[0.0, -1.0]))[-1]


LEAKS = [
    row(
        lambda: leak("water"),
        "the fluid must be an rc.Liquid or an rc.Gas, not 'water'",
        lambda: leak(rc.Liquid(1e-3)),
        lambda: gas(solution=pressed(wide())),
    ),
    row(
        lambda: leak(surface=PERIODIC, axis=None, **SEAL),
        "the direction of the drop must be given: give axis=0 or axis=1",
        lambda: leak(surface=PERIODIC, axis=0, **SEAL),
        lambda: leak(surface=PERIODIC, axis=1, **SEAL),
    ),
    row(
        lambda: leak(surface=PERIODIC),
        "a sample of a seal: give the width and the circumference of the seal",
        lambda: leak(surface=PERIODIC, **SEAL),
    ),
    row(
        lambda: leak(seal_width=1e-3),
        "a seal has a width and a circumference: give both",
        lambda: leak(**SEAL),
    ),
    row(
        lambda: leak(axis=None, between=(LEFT, RIGHT), **SEAL),
        "has no seal width: leave seal_width and circumference out",
        lambda: leak(axis=None, between=(LEFT, RIGHT)),
    ),
    row(
        lambda: leak(AIR),
        "do not follow: give upstream= and downstream=, absolute",
        lambda: gas(solution=pressed(wide())),
    ),
    row(
        lambda: leak(drop=None),
        "do not follow: give upstream= and downstream=, absolute, or only drop=",
        lambda: leak(drop=None, upstream=2e4, downstream=1e4),
        lambda: leak(drop=1e4),
    ),
    row(
        lambda: leak(drop=-1.0),
        "exchange or correct both pressures",
        lambda: leak(drop=1.0),
    ),
    row(
        lambda: leak(drop=2e5),
        "so the fluid separates the bodies: press harder, or give a smaller drop",
        lambda: leak(solution=pressed(pressure=3e5), drop=2e5),
        lambda: leak(drop=1e4),
    ),
    row(
        lambda: gas(2e4, 1e4),
        "is too rarefied in the critical constriction",
        lambda: gas(1e7, 1e7 - 1e4),
        lambda: gas(solution=pressed(wide(), pressure=2e4), upstream=2e5, downstream=1.9e5),
    ),
]
FLUIDS = [
    row(lambda: rc.Liquid(0.0), "the viscosity must be positive", lambda: rc.Liquid(1e-3)),
    row(lambda: rc.Liquid(-1e-3), "the viscosity must be positive", lambda: rc.Liquid(1e-3)),
    row(lambda: rc.Liquid(1e-3, 0.0), "the density must be positive", lambda: rc.Liquid(1e-3, 1e3)),
    row(
        lambda: rc.Gas("xenon"),
        "the gas must be one of air, nitrogen, helium, argon, not 'xenon'",
        *(lambda name=name: rc.Gas(name) for name in ("air", "nitrogen", "helium", "argon")),
    ),
    row(
        lambda: rc.Gas("air", temperature=20),
        "the temperature must be between 200 and 600 K, not 20",
        lambda: rc.Gas("air", temperature=200),
        lambda: rc.Gas("air", temperature=600),
    ),
    row(
        lambda: rc.Gas("air", pressure=math.inf),
        "the pressure must be positive and finite [Pa], not inf",
        lambda: rc.Gas("air", pressure=1e5),
    ),
    row(
        lambda: rc.Gas("air", accommodation=(0.0, 0.9)),
        "the accommodation must be two coefficients above 0 and up to 1",
        lambda: rc.Gas("air", accommodation=(0.1, 1.0)),
    ),
    row(
        lambda: rc.Gas("air", momentum_accommodation=1.1),
        "must be above 0 and up to 1, not 1.1",
        lambda: rc.Gas("air", momentum_accommodation=1.0),
    ),
    row(
        lambda: rc.Gas("air").jump_distance,
        "give them: rc.Gas('air', pressure=101325, accommodation=(0.9, 0.9))",
        lambda: rc.Gas("air", pressure=101325, accommodation=(0.9, 0.9)).jump_distance,
    ),
]

LEAK = "leak rough.npz --modulus 1GPa --pressure 1MPa"
WET = f"{LEAK} --viscosity 1mPa*s"
GAS = f"{LEAK} --gas air,20degC"
TILE = f"{WET} --drop 1kPa --periodic"
COMMANDS = f"""
$ {LEAK} --drop 1kPa
! --viscosity or --gas is required: add one, such as --viscosity 1mPa*s
> {WET} --drop 1kPa

$ {WET} --gas air,20degC --drop 1kPa
! --viscosity and --gas exclude each other: give one of them
> {WET} --drop 1kPa
> {GAS} --upstream 101bar --downstream 100.9bar

$ {LEAK} --viscosity 0Pa*s --drop 1kPa
! the viscosity must be positive, not '0Pa*s'
> {WET} --drop 1kPa

$ {LEAK} --gas air --upstream 101bar --downstream 100.9bar
! --gas: 'air' lacks the temperature of the gas; write air,20degC, with your values
> {GAS} --upstream 101bar --downstream 100.9bar

$ {LEAK} --gas air,1bar,20degC --upstream 101bar --downstream 100.9bar
! states the pressure of the gas, which is not used here; leave it out
> {GAS} --upstream 101bar --downstream 100.9bar

$ {WET}
! --drop or --upstream is required: add one, such as --drop 1bar
> {WET} --drop 1bar
> {WET} --upstream 2bar --downstream 1bar

$ {WET} --drop 1bar --upstream 2bar --downstream 1bar
! --drop and --upstream exclude each other: give one of them
> {WET} --drop 1bar
> {WET} --upstream 2bar --downstream 1bar

$ {WET} --upstream 2bar
! --upstream needs --downstream, which is not given: give --downstream too
> {WET} --upstream 2bar --downstream 1bar

$ {WET} --upstream 1bar --downstream 2bar
! the upstream pressure of 100000 Pa must be finite and exceed the downstream pressure of 200000 Pa
> {WET} --upstream 2bar --downstream 1bar

$ {GAS} --drop 1bar
! only on their difference; give --upstream and --downstream in place of --drop
> {GAS} --upstream 101bar --downstream 100.9bar

$ {GAS} --upstream 1mbar --downstream 0
! --upstream, --downstream: the gas is too rarefied in the critical constriction for a slip length
> {GAS} --upstream 101bar --downstream 100.9bar

$ {TILE}
! a periodic map is a sample of a seal; give the width and the circumference of the seal
> {TILE} --seal-width 1mm --circumference 0.1m

$ {TILE} --seal-width 1mm
! --seal-width needs --circumference, which is not given: give --circumference too
> {TILE} --seal-width 1mm --circumference 0.1m

$ {WET} --drop 2MPa
! so the fluid separates the bodies; press harder, or give a smaller drop
> {WET.replace("1MPa", "3MPa")} --drop 2MPa
> {WET} --drop 1kPa

$ {WET} --drop 1kPa --profile line
! --profile: a leak needs a map of heights; leave --profile out
> {WET} --drop 1kPa
"""


@pytest.mark.parametrize("refusal", [*FLOWS, *LEAKS, *FLUIDS])
def test_flow(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", commands(COMMANDS))
def test_commands(command, refusal):
    follow_command(command, refusal)
