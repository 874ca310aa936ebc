"""What a whole joint refuses is computed when the message is followed."""

import math

import numpy as np
import pytest

import roughcontact as rc
from followed import commands, follow, follow_command, row
from made_laws import exponential_law, law, power_law, under_shear

EVEN = np.full((2, 3), 1.0)
HOLE = np.pad(np.full((1, 1), np.nan), 1, constant_values=2e6)
BOLT = {"force": 17e3, "head": 13e-3, "hole": 9e-3, "thickness": 10e-3}
P = np.array([1e6, 4e6])


def field(pressure=EVEN, grid=0.1):
    return rc.PressureField(pressure, grid)


def joint(made=None, pressure=EVEN, **named):
    return rc.joint(made or power_law(), field(pressure), **named)


def leak(pressure=HOLE, fluid=None, **columns):
    made = law(P, -np.log(P), P, 0.0, **(columns or {"transmissivity": np.array([2e-20, 1e-20])}))
    return rc.joint_leak(joint(made, pressure), fluid or rc.Liquid(1e-3), drop=1e5)


def read(folder, text):
    (folder / "field.csv").write_text(text)
    return rc.read_pressure_field(folder / "field.csv")


ROWS = [
    row(
        lambda: field(-EVEN),
        "give 0 where the face is open, and NaN where there is no face",
        lambda: field(np.where(EVEN > 0, 1.0, 0.0)),
        lambda: field(np.where([[1, 1, 0], [1, 1, 1]], 1.0, np.nan)),
    ),
    row(lambda: field(EVEN * math.inf), "must be finite and not negative", field),
    row(lambda: field(0 * EVEN), "no cell of the face is under pressure: give a field with a force", field),
    row(
        lambda: field(EVEN[0]),
        "give an array of shape (ny, nx), and its grid or the size of a cell",
        field,
        lambda: field(grid=rc.Grid((2, 3), 0.1)),
        lambda: field(grid=(0.1, 0.2)),
    ),
    row(lambda: field("high"), "pressure [Pa] must be a number or an array of numbers", field),
    row(lambda: field(grid=-1.0), "must be positive", field),
    row(
        lambda: rc.bolt_pressure(**BOLT | {"head": 9e-3}),
        "the head of 9 mm is not wider than the hole of 9 mm: give a wider head or washer, or a smaller hole",
        lambda: rc.bolt_pressure(**BOLT),
        lambda: rc.bolt_pressure(**BOLT | {"head": 9e-3, "hole": 8e-3}),
    ),
    row(
        lambda: rc.bolt_pressure(**BOLT, half_angle=30),
        "must be less than 90 degrees, not 1718.87 degrees: give one such as 30deg, which is 0.52 rad",
        lambda: rc.bolt_pressure(**BOLT, half_angle=0.52),
    ),
    row(
        lambda: rc.bolt_pressure(**BOLT, distribution="cone"),
        "must be 'even' or 'falling', not 'cone'",
        lambda: rc.bolt_pressure(**BOLT, distribution="even"),
        lambda: rc.bolt_pressure(**BOLT, distribution="falling"),
    ),
    row(
        lambda: rc.bolt_pressure(**BOLT, grid=rc.Grid((9, 9), 1e-3)),
        "and does not fit on the grid: give a larger grid, or leave it out",
        lambda: rc.bolt_pressure(**BOLT, grid=rc.Grid((60, 60), 1e-3)),
        lambda: rc.bolt_pressure(**BOLT),
    ),
    row(
        lambda: rc.bolt_pressure(**BOLT, grid=rc.Grid((3, 3), 0.1)),
        "no cell lies between the hole and the cone: give a finer grid",
        lambda: rc.bolt_pressure(**BOLT, grid=rc.Grid((60, 60), 5e-3)),
    ),
    row(
        lambda: rc.bolt_pressure(**BOLT | {"force": -1.0}),
        "must be positive",
        lambda: rc.bolt_pressure(**BOLT),
    ),
    row(
        lambda: joint(pressure=9 * EVEN),
        "it is not extrapolated; compute its curve with pressures=field.loads",
        joint,
    ),
    row(lambda: joint(exponential_law(), 1e-9 * EVEN), "the law holds from 1 µPa to 4 Pa", joint),
    row(
        lambda: rc.joint(power_law(), EVEN),
        "field must be a PressureField, such as of rc.bolt_pressure",
        lambda: rc.joint(power_law(), field()),
    ),
    row(
        lambda: rc.joint([], field()),
        "law must be of rc.normal_law or rc.shear_law, or several of them",
        joint,
        lambda: joint([power_law(), power_law()]),
        lambda: joint(under_shear(power_law())),
    ),
    row(
        lambda: joint([under_shear(power_law()), under_shear(power_law(), 0.2)]),
        "make each law of the same bodies and with the same friction",
        lambda: joint([under_shear(power_law())] * 2),
    ),
    row(
        lambda: joint([under_shear(power_law()), power_law()]),
        "make each law of the same bodies and with the same friction",
        lambda: joint([power_law()] * 2),
    ),
    row(
        lambda: joint().shear_force(1e-3),
        "this joint has no friction: its laws are those of normal load; build it of rc.shear_law",
        lambda: joint(under_shear(power_law())).shear_force(1e-3),
    ),
    row(
        lambda: joint(under_shear(power_law())).shear_force(-1e-3),
        "must be finite and not negative",
        lambda: joint(under_shear(power_law())).shear_force(1e-3),
    ),
    row(
        lambda: joint(under_shear(power_law(cells=100.0))).loss(1e-3),
        "give a larger amplitude, or build the joint of laws `fitted`",
        lambda: joint(under_shear(power_law(cells=100.0))).loss(1.0),
        lambda: joint(under_shear(power_law(cells=100.0)).fitted).loss(1e-3),
    ),
    row(
        lambda: joint().conductance(),
        "give the resistivities [ohm m] or the conductivities [W/(m K)] of both bodies",
        lambda: joint().conductance(resistivities=(1e-8, 1e-8)),
        lambda: joint().conductance(conductivities=(50.0, 50.0)),
    ),
    row(
        lambda: joint(longest_wave=-1.0), "longest_wave [m] must be positive", lambda: joint(longest_wave=1.0)
    ),
    row(
        lambda: leak(contact_fraction=P),
        "give measures=[rc.Transmissivity(axis=0)] to the loading_curve of each law",
        leak,
    ),
    row(
        lambda: leak(np.full((3, 3), 2e6)),
        "encloses no hole, from which the fluid could leak: give NaN or 0 in the cells of the hole",
        leak,
        lambda: leak(np.nan_to_num(HOLE)),
    ),
    row(lambda: leak(fluid=rc.Gas("air")), "must be an rc.Liquid", lambda: leak(fluid=rc.Liquid(1e-3))),
]
POINTS = "".join(f"{x},{y},{1 + x}\n" for y in (0, 1) for x in (0, 1, 2))
TABLES = [
    row(
        lambda folder, wrong=wrong: read(folder, wrong + POINTS),
        "write the points of a regular grid under a first line such as x [mm], y [mm], p [MPa]",
        lambda folder: read(folder, "x [mm], y [mm], p [MPa]\n" + POINTS),
    )
    for wrong in (
        "",
        "x, y, p\n",
        "x [mm], y [mm], p [mm^2]\n",
        "x [Pa], y [mm], p [MPa]\n",
        "x [mm], y [mm], p []\n",
    )
]
FLAT = "joint rough.npz --modulus 1GPa"
BOLTED = f"{FLAT} --bolt-force 10N --head 13mm --hole 9mm --thickness 2mm"
NAMED = BOLTED.replace("--modulus 1GPa", "--young 1GPa --poisson 0.3")
WET = f"{BOLTED} --leak 0 --viscosity 1mPa*s --drop 1kPa"
COMMANDS = f"""
$ {FLAT}
! --pressure-field or --bolt-force is required: add one, such as --pressure-field field.csv
> {FLAT} --pressure-field field.csv

$ {BOLTED} --pressure-field field.csv
! --pressure-field and --bolt-force exclude each other: give one of them
> {FLAT} --pressure-field field.csv
> {BOLTED}

$ {BOLTED.replace(" --hole 9mm", "")}
! --bolt-force is given without --hole; give --hole, such as 9mm
> {BOLTED}

$ {FLAT} --pressure-field field.csv --head 13mm
! --head needs --bolt-force, which is not given
> {BOLTED}

$ {BOLTED.replace("13mm", "8mm")}
! --head, --hole: the head of 8 mm is not wider than the hole of 9 mm; give a wider head or washer, or a smaller hole
> {BOLTED}
> {BOLTED.replace("13mm", "8mm").replace("9mm", "7mm")}

$ {BOLTED.replace("13mm", "13")}
! --head: 13 without a unit is 13 m, larger than a bolt; write 13mm or, for a value in m, 13m
> {BOLTED}
> {BOLTED.replace("13mm", "13m")}

$ {BOLTED} --half-angle 30mm
! --half-angle: '30mm' is not an angle; write an angle such as 30deg
> {BOLTED} --half-angle 30deg

$ {BOLTED} --half-angle 90deg
! --half-angle: the half angle of the cone must be less than 90 degrees, not 90 degrees
! give one such as 30deg, which is 0.52 rad
> {BOLTED} --half-angle 30deg
> {BOLTED} --half-angle 0.52rad

$ {BOLTED} --friction 0.2
! needs Poisson's ratios, which E* does not determine
> {BOLTED.replace("--modulus 1GPa", "--materials steel,aluminium")} --friction 0.2

$ {NAMED} --friction 0
! the coefficient of friction must lie between 0 and 10 (both excluded), not '0'
> {NAMED} --friction 0.2

$ {NAMED} --amplitude 1um
! --amplitude needs --friction, which is not given: give --friction too
> {NAMED} --amplitude 1um --friction 0.2

$ {NAMED} --friction 0.2 --amplitude 0.5
! --amplitude: 0.5 without a unit is 0.5 m, larger than the slip of a joint; write 0.5um or, for a value in m, 0.5m
> {NAMED} --friction 0.2 --amplitude 0.5um
> {NAMED} --friction 0.2 --amplitude 0.5m

$ {NAMED} --friction 0.2 --amplitude 1pm
! --amplitude: at a force below
! give a larger amplitude
> {NAMED} --friction 0.2 --amplitude 1um

$ {BOLTED} --leak 0 --drop 1kPa
! --leak is given without --viscosity; give --viscosity, such as 1mPa*s
> {WET}

$ {BOLTED} --leak 0 --viscosity 1mPa*s
! --leak is given without --drop; give --drop, such as 1bar
> {BOLTED} --leak 0 --viscosity 1mPa*s --drop 1bar

$ {BOLTED} --hardness 100Pa
! --bolt-force: a force of
! the most that all measured cells can carry at this hardness; press by less, or give a greater hardness
> {BOLTED.replace("10N", "1mN")} --hardness 100Pa
> {BOLTED} --hardness 1GPa

$ {WET} --hardness 1GPa
! --leak does not go with a hardness: the flow is computed for increasing loads only; leave out one of them
> {WET}
> {BOLTED} --hardness 1GPa

$ {FLAT} --pressure-field field.csv --leak 0 --viscosity 1mPa*s --drop 1kPa
! --leak: the loaded area of the face encloses no hole
> {FLAT} --pressure-field hole.csv --leak 0 --viscosity 1mPa*s --drop 1kPa

$ {BOLTED} --conductivity 50W/m/K --of total
! --of: a joint has the conductance of its interface; leave --of out
> {BOLTED} --conductivity 50W/m/K

$ {BOLTED} --profile line
! --profile: a joint needs a map of heights; leave --profile out
> {BOLTED}

$ {FLAT} --pressure-field missing.csv
! missing.csv: it cannot be opened
> {FLAT} --pressure-field field.csv

$ {FLAT} --pressure-field tension.csv
! --pressure-field: the pressure on a face must be finite and not negative
> {FLAT} --pressure-field field.csv
"""


@pytest.mark.parametrize("refusal", ROWS)
def test_joint(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", TABLES)
def test_tables(refusal, tmp_path):
    follow(refusal, tmp_path)


@pytest.mark.parametrize("refusal", commands(COMMANDS))
def test_commands(command, refusal, folder):
    head, points = "x [mm], y [mm], p [kPa]\n", [(x, y) for y in range(3) for x in range(3)]
    for name, middle in (("field", 5), ("hole", 0), ("tension", -1)):
        lines = (f"{x},{y},{middle if x == y == 1 else 5}\n" for x, y in points)
        (folder / f"{name}.csv").write_text(head + "".join(lines))
    follow_command(command, refusal)
