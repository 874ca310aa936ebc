"""What a study's file and its commands refuse is run when their message is followed."""

import shutil
from pathlib import Path

import pytest

import roughcontact as rc
from followed import commands, follow, follow_command, row

# Parts of a study of cases that are quick; in a row below they are changed.
PARTS = {"name": '"tried"', "case": '"study.trial:CASE"', "size": '"1 mm"', "hurst": "[0.1, 0.2]"}
CURVE = {"case": '"curve"', "rms": '"1um"', "modulus": '"1GPa"', "points": "16"}


def study(head="", tail="", **changed):
    """Return what reads a study with some parts changed (None takes one out) and checks all of its cases."""

    def read(folder):
        parts = {name: text for name, text in (PARTS | changed).items() if text is not None}
        table = parts.pop("hurst", None)
        stated = {name: parts.pop(name) for name in ("name", "case") if name in parts}
        lines = [*_written(stated), head, "[parameters]", *_written(parts)]
        lines += ["[table]", f"hurst = {table}"] if table else []
        (folder / "tried.toml").write_text("\n".join([*lines, tail]))
        assert rc.study.Study.read(folder / "tried.toml").combinations()

    return read


def _written(parts):
    return [f"{name} = {text}" for name, text in parts.items()]


def ranged(text):
    return study(hurst=f"{{ {text} }}")


FILES = [
    row(study(name=None), "'name' is missing", study(name='"tried"')),
    row(
        study(name='"a b"'),
        "use letters, digits, '-', '_' and '.', and begin with a letter or digit",
        study(name='"a-b_c.1"'),
        study(name='"1a"'),
    ),
    row(study("sample = 3"), "there is no 'sample': did you mean 'samples'?", study("samples = 3")),
    row(study("samples = 0"), "samples: 0 should be greater than or equal to 1", study("samples = 1")),
    row(study('samples = "3"'), "samples: '3' should be a valid integer", study("samples = 3")),
    row(
        study(**CURVE | {"case": '"curv"'}),
        "there is no case 'curv': did you mean 'curve'? choose from adhesion, asperities, cells, curve",
        study(**CURVE),
    ),
    row(
        study(case='"own:CASE"'),
        "no module own is found; run in the folder that contains own, or add this folder to PYTHONPATH",
        study(case='"study.trial:CASE"'),
    ),
    row(
        study(size=None, sise='"1 mm"'), "has no parameter 'sise': did you mean 'size'?", study(size='"1 mm"')
    ),
    row(study(size='"1 N"'), "'1 N' is not a length; write a length such as 5um", study(size='"5um"')),
    row(study(hurst="[5.0]"), "hurst: 5.0 should be less than or equal to 3", study(hurst="[3.0]")),
    row(
        study(**CURVE | {"modulus": None}),
        "parameters.modulus: 'modulus' is missing; give modulus",
        study(**CURVE),
    ),
    *(
        row(
            study(**CURVE | {"modulus": f'"{text}"'}),
            f"{text!r} is a name, but a reduced modulus is a number; write '{number} GPa', that of {bodies}",
            study(**CURVE | {"modulus": f'"{number} GPa"'}),
        )
        for text, number, bodies in (
            ("steel", "111.9", "steel and steel"),
            ("steel, aluminium", "57.47", "steel and aluminium"),
            ("rigid,steel", "223.8", "rigid and steel"),
        )
    ),
    row(
        study(**CURVE, hardness='"1GPa"', relative_hardness="0.1"),
        "give hardness or relative_hardness, not both",
        study(**CURVE, hardness='"1GPa"'),
        study(**CURVE, relative_hardness="0.1"),
    ),
    row(
        study(**CURVE | {"case": '"loop"'}),
        "a loop with plastic flow needs a hardness; give hardness or relative_hardness",
        study(**CURVE | {"case": '"loop"'}, hardness='"1GPa"'),
        study(**CURVE | {"case": '"loop"'}, relative_hardness="0.1"),
    ),
    row(
        study(tail="[[rows]]\nhurst = 0.1"),
        "'hurst' is given both in table and in rows; remove it from one of them",
        study(),
        study(hurst=None, tail="[[rows]]\nhurst = 0.1"),
    ),
    row(study(hurst="[]"), "the list is empty; give one value or more", study(hurst="[0.1]")),
    row(
        study(hurst="0.1"),
        "write a single value under parameters, and a range as { start = 0.1, stop = 0.9, count = 9 }",
        study(hurst=None, tail="[[rows]]\nhurst = 0.1"),
        study(hurst="{ start = 0.1, stop = 0.9, count = 9 }"),
    ),
    row(study(hurst="[0.1, 0.1]"), "remove one from the table or the rows", study(hurst="[0.1]")),
    row(
        ranged("start = 0.1, stop = 0.9"),
        "a range has either a count or a step; give one of them",
        ranged("start = 0.1, stop = 0.9, count = 3"),
        ranged("start = 0.1, stop = 0.9, step = 0.2"),
    ),
    row(
        ranged('start = 0.1, stop = 0.9, step = 0.1, spacing = "log"'),
        "a range in equal ratios has a count, not a step",
        ranged('start = 0.1, stop = 0.9, count = 3, spacing = "log"'),
    ),
    row(
        ranged("start = 0.1, stop = 0.1, count = 3"),
        "it starts and stops at 0.1; give the one value under parameters",
        study(hurst=None, tail="[[rows]]\nhurst = 0.1"),
    ),
    row(
        ranged('start = 0.0, stop = 0.9, count = 3, spacing = "log"'),
        "both ends must be above 0, or both below",
        ranged('start = 0.1, stop = 0.9, count = 3, spacing = "log"'),
        ranged('start = -0.9, stop = -0.1, count = 3, spacing = "log"'),
    ),
    row(
        ranged("start = 0.1, stop = 0.9, step = -0.1"),
        "steps of -0.1 do not lead from 0.1 to 0.9; give a step towards the stop",
        ranged("start = 0.1, stop = 0.9, step = 0.1"),
    ),
    row(
        lambda _: rc.study.Range(start=0.1, stop=0.9, step=1e-9).values(float),
        "8e+08 steps of 1e-09 are too many: give a step above 8e-07",
        lambda _: rc.study.Range(start=0.1, stop=0.9, step=8.1e-7).values(float),
    ),
    row(
        study(tail='end = { start = "well", stop = "error", count = 2 }'),
        "'well' is not a number, and a range needs numbers; write a list",
        study(tail='end = ["well", "error"]'),
    ),
    row(
        study("samples = 10000000"),
        "a study has 10,000,000 at most; take fewer samples or values",
        study("samples = 5000000"),
        study("samples = 10000000", hurst="[0.1]"),
    ),
]

SERIAL = "study run tried.toml --executor serial"
COMMANDS = f"""
$ study run nowhere.toml
! No such file or directory; name the file of a study, such as study.toml
> {SERIAL}

$ study run tried.toml --scheduler tcp://127.0.0.1:1
! --scheduler: only --executor dask has a scheduler
> {SERIAL}

$ {SERIAL} --workers 2
! computes one case at a time; choose processes
> study run tried.toml --executor processes --workers 2

$ study status nowhere
! there is no study.toml in it; name the folder of the results of a study; if 'study run' has just started, wait
> {SERIAL} && study status tried

$ study export done --out all.xlsx
! give a file .nc (NetCDF) or .csv (a table)
> study export done --out all.nc
> study export done --out all.csv

$ study add done --samples 2
! the study already has 2 samples; give more, not 2
> study add done --samples 3

$ study run done --out other
! is the folder of the results itself; leave out --out
> study run done

$ {SERIAL} --out seeded
! it holds results of a study with the seed 1, not 0; choose another folder
> {SERIAL} --out another

$ study average done --out all.txt
! give a file .nc (NetCDF) or .csv (a table)
> study average done --out all.nc
> study average done --out all.csv

$ study average done --out all.nc --window 1e-3
! is not a window; write two forces over E* h L, 1e-3:0.07
> study average done --out all.nc --window 1e-3:0.07

$ study average done --out all.nc --window 0.07:1e-3
! the first force of the window '0.07:1e-3' must be smaller than the second; exchange the two
> study average done --out all.nc --window 1e-3:0.07

$ study plot done --out all.png --quantity weight
! choose
> study plot done --out all.png --quantity force

$ study table done --quantity weight
! choose from force, stiffness, residual
> study table loads --quantity stiffness --at 0.01

$ study table loads --quantity stiffness
! choose a load by --at, such as --at 1MPa
> study table loads --quantity stiffness --at 0.01

$ study table loads --at 100
! and 100 is not between them; choose a load between them
> study table loads --at 0.01

$ study table loads --at 0
! choose a load above 0
> study table loads --at 0.01

$ study run broken.toml
! there is no 'sample': did you mean 'samples'?
> {SERIAL}
"""


@pytest.mark.parametrize("refusal", FILES)
def test_files(refusal, tmp_path):
    follow(refusal, tmp_path)


@pytest.fixture(scope="module")
def studies(tmp_path_factory):
    """A folder of studies that have been run."""
    folder = tmp_path_factory.mktemp("studies")
    text = 'name = "{}"\ncase = "study.trial:CASE"\nsamples = 2\n[table]\nhurst = [0.1, 0.2]\n'
    (folder / "tried.toml").write_text(text.format("tried"))
    (folder / "broken.toml").write_text(text.format("tried").replace("samples", "sample"))
    loads = {"points": 16, "size": "1mm", "hurst": 0.8, "rms": "1um", "modulus": "1GPa", "loads": 6}
    for name, each in {
        "done": rc.study.Study(name="done", case="study.trial:CASE", samples=2, table={"hurst": [0.1, 0.2]}),
        "seeded": rc.study.Study(name="tried", case="study.trial:CASE", seed=1, table={"hurst": [0.1, 0.2]}),
        "loads": rc.study.Study(name="loads", case="curve", samples=2, parameters=loads),
    }.items():
        rc.study.run(each, folder / name, rc.study.Serial())
    return folder


@pytest.mark.parametrize("refusal", commands(COMMANDS))
def test_commands(refusal, command, studies):
    shutil.copytree(studies, Path.cwd(), dirs_exist_ok=True)
    follow_command(command, refusal)
