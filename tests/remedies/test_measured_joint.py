"""What an inference from a measured joint refuses is inferred when the message is followed."""

import numpy as np
import pytest

import roughcontact as rc
from followed import commands, follow, follow_command, row

P = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
K = 1.9e7 * P**0.88
GIVEN = {"modulus": 115e9, "modulus_error": 0.02, "area": 2e-4, "branch": "loading"}
FACES = rc.JointTopography(1.15e-6, 0.1, 1e-4, 0.1)
STEELS = (46e6, 46e6)


def measured(pressures=P, stiffness=K, errors=0.05):
    return rc.JointStiffness(pressures, stiffness, errors)


def inferred(data=None, **given):
    return rc.infer_joint(data or measured(), **GIVEN | given)


def echo(frequency, error=0.005):
    size = abs(rc.theory.ultrasound.reflection(K, frequency, STEELS))
    return rc.JointStiffness.from_reflection(P, size, error, frequency=frequency, impedances=STEELS)


def read(folder, text, quantity="stiffness", **named):
    (folder / "joint.csv").write_text(text)
    return rc.read_joint_table(folder / "joint.csv", quantity, **named)


ROWS = [
    row(
        lambda: inferred(branch=None),
        "must be 'loading' or 'unloading', not None: name the one that was measured",
        inferred,
        lambda: inferred(branch="unloading"),
    ),
    row(lambda: measured(errors=0.0), "errors must be positive", measured),
    row(lambda: measured(stiffness=K[1:]), "stiffness must have a value for each of 5 pressures", measured),
    row(
        lambda: rc.JointClosures(P[::-1], 1e-6 * np.arange(5), 1e-8),
        "give the loads of one branch in the order of increasing pressure",
        lambda: rc.JointClosures(P, 1e-6 * np.arange(5), 1e-8),
    ),
    row(lambda: echo(5e7), "times less certain than the reflection", lambda: echo(5e5)),
    row(
        lambda: inferred(measured(100 * P, 100 * K), profile=FACES),
        "leave out the smallest or the largest pressures, or press a map: rc.loading_curve",
        lambda: inferred(profile=FACES),
    ),
    row(
        lambda: inferred(area=4e-7, profile=FACES),
        "give the area of the whole joint, or press the measured map itself: rc.loading_curve",
        lambda: inferred(profile=FACES),
    ),
    row(
        lambda: inferred(hardness=2e9),
        "give both, such as hardness=2e9, hardness_error=0.1",
        lambda: inferred(hardness=2e9, hardness_error=0.1),
    ),
    row(
        lambda: inferred(branch="unloading", hardness=2e9, hardness_error=0.1),
        "faces flow on first loading only: leave out the hardness",
        lambda: inferred(branch="unloading"),
    ),
    row(
        lambda: inferred(profile=FACES, hardness=2e8, hardness_error=0.1),
        "leave out the largest pressures, or press a map with this hardness: rc.loading_curve",
        lambda: inferred(measured(P[:2], K[:2]), profile=FACES, hardness=2e9, hardness_error=0.1),
    ),
]
TABLE = "pressure [MPa], stiffness [N/um/mm^2]\n7, 20\n15, 39\n"
LIKE = "write such a line above the columns, or give columns='pressure [MPa], stiffness [N/um/mm^2]'"
COLUMNS = "pressure [MPa], stiffness [N/um/mm^2]"
OF_TABLES = [
    row(
        lambda folder: read(folder, "7, 20\n15, 39\n"),
        f"it has no column that is named pressure; {LIKE}",
        lambda folder: read(folder, TABLE),
        lambda folder: read(folder, "7, 20\n15, 39\n", columns=COLUMNS),
    ),
    row(
        lambda folder: read(folder, TABLE.replace(" [MPa]", "")),
        f"it states no unit of the pressure; {LIKE}",
        lambda folder: read(folder, TABLE),
        lambda folder: read(folder, TABLE.replace(" [MPa]", ""), columns=COLUMNS),
    ),
    row(
        lambda folder: read(folder, TABLE.replace("MPa", "furlong")),
        f"; {LIKE}",
        lambda folder: read(folder, TABLE),
        lambda folder: read(folder, TABLE.replace("MPa", "furlong"), columns=COLUMNS),
    ),
    row(
        lambda folder: read(folder, TABLE.replace("MPa", "blorg")),
        f"unknown unit 'blorg' in '1 blorg'; {LIKE}",
        lambda folder: read(folder, TABLE),
    ),
    row(
        lambda folder: read(folder, "p [MPa], reflection [mm]\n7, 0.9\n15, 0.8\n", "reflection"),
        "the unit 'mm' of the reflection is not that of a ratio; write such a line above the columns, or give "
        "columns='pressure [MPa], reflection'",
        lambda folder: read(folder, "pressure [MPa], reflection\n7, 0.9\n15, 0.8\n", "reflection"),
    ),
    row(
        lambda folder: read(folder, "p [MPa], closure [um]\n7, 1\n15, 2\n"),
        "it has no column of stiffness, but one of closure; give quantity='closure'",
        lambda folder: read(folder, "p [MPa], closure [um]\n7, 1\n15, 2\n", quantity="closure"),
    ),
    row(
        lambda folder: read(folder, TABLE, "depth"),
        "must be one of stiffness, closure, reflection, loads, not 'depth'",
        lambda folder: read(folder, TABLE, "stiffness"),
    ),
    row(
        lambda folder: read(folder, TABLE).errors,
        "give `errors`, such as 5%, or add a column error",
        lambda folder: read(folder, "p [MPa], K [N/um/mm^2], error [%]\n7, 20, 5\n15, 39, 5\n").errors,
    ),
    row(
        lambda folder: read(folder, "p [MPa], closure [um]\n7, 1\n15, 2\n", "closure").errors,
        "give `resolution`, such as 10nm, or add a column error",
        lambda folder: (
            read(folder, "p [MPa], closure [um], error [nm]\n7, 1, 9\n15, 2, 9\n", "closure").errors
        ),
    ),
]
TOPOGRAPHY = "--rms 1um --rms-error 10% --rolloff 100um --rolloff-error 30%"
LINE = "roughcontact infer joint.csv --area '2cm^2' --branch loading"
COMMANDS = """
$ LINE --modulus 115GPa
! --errors: the table has no column of errors, and --errors is not given; give --errors, such as 5%, or add a column
> LINE --modulus 115GPa --errors 5%

$ LINE --modulus 115GPa --errors 0%
! --errors: the error must lie between 0 and 100 %, not '0%'; give one such as 5%
> LINE --modulus 115GPa --errors 5%

$ roughcontact infer joint.csv --area '2cm^2' --modulus 115GPa --errors 5%
! --branch is required: add it, such as --branch [loading|unloading]
> LINE --modulus 115GPa --errors 5%

$ LINE --modulus 115GPa --errors 5% --resolution 10nm
! --resolution has no meaning for a stiffness: leave it out, or choose another --quantity
> LINE --modulus 115GPa --errors 5%

$ LINE --modulus 115GPa --errors 5% --hardness 2GPa
! --hardness is given without --hardness-error; give --hardness-error, such as 10%
> LINE --modulus 115GPa --errors 5% --hardness 2GPa --hardness-error 10%

$ LINE --modulus 115GPa --errors 5% --plan 8%
! --plan needs --rms, which is not given: give --rms too
> LINE --modulus 115GPa --errors 5% --plan 8% FACES

$ LINE --modulus 115GPa --quantity closure --resolution 10nm --plan 8% FACES
! a plan is made for stiffnesses; leave out the --quantity, or the --plan
> LINE --modulus 115GPa --errors 5% --plan 8% FACES

$ LINE --modulus 115GPa --errors 5% --plan 8% --hardness 2GPa --hardness-error 10% FACES
! a plan is made for elastic joints; leave out the --hardness, or the --plan
> LINE --modulus 115GPa --errors 5% --plan 8% FACES

$ LINE --modulus 115GPa --quantity closure --resolution 10nm
! it has no column of closure, but one of stiffness; give --quantity 'stiffness'
> LINE --modulus 115GPa --errors 5% --quantity 'stiffness'

$ LINE --modulus 115GPa --quantity reflection --errors 0.005
! a reflection needs the --frequency of the wave; give --frequency, such as 2MHz
> roughcontact infer echo.csv --area '2cm^2' --branch loading --materials steel,steel --quantity reflection \
--errors 0.005 --frequency 2MHz

$ LINE --modulus 115GPa --quantity reflection --errors 0.005 --frequency 2MHz
! --impedance: a reflection needs the acoustic impedances, which E* does not determine; give --impedance
> roughcontact infer echo.csv --area '2cm^2' --branch loading --modulus 115GPa --quantity reflection \
--errors 0.005 --frequency 2MHz --impedance steel,aluminium

$ LINE --modulus 115GPa --errors 5% --rms 1um
! --rms is given without --rms-error; give --rms-error, such as 10%
> LINE --modulus 115GPa --errors 5% --rms 1um --rms-error 10% --rolloff 100um --rolloff-error 30%
"""


@pytest.mark.parametrize("refusal", ROWS)
def test_what_is_refused_is_inferred_when_the_message_is_followed(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", OF_TABLES)
def test_what_a_table_lacks_is_read_when_the_message_is_followed(refusal, tmp_path):
    follow(refusal, tmp_path)


@pytest.mark.parametrize(
    "refusal",
    commands(COMMANDS.replace("LINE", LINE).replace("FACES", TOPOGRAPHY).replace("roughcontact ", "")),
)
def test_a_command_that_is_refused_runs_when_the_message_is_followed(refusal, command, folder):
    rows = "".join(f"{p / 1e6:g}, {k / 1e12:g}\n" for p, k in zip(P, K, strict=True))
    (folder / "joint.csv").write_text(f"pressure [MPa], stiffness [N/um/mm^2]\n{rows}")
    (folder / "echo.csv").write_text("pressure [MPa], reflection\n15, 0.97\n30, 0.92\n65, 0.8\n140, 0.62\n")
    follow_command(command, refusal)
