"""What README and documentation show runs as printed.

Every block of Python is a program of its own, except on a sheet of the course, where all blocks are one program. What a
block prints is compared with the text below it. The command lines of a page run one after the other. Both start in a
folder that holds the files that the pages name. Where nothing that is printed depends on it, less is computed.
"""

import importlib.util
import io
import pydoc
import re
import shlex
import shutil
from contextlib import redirect_stdout
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from public_names import public_names
from roughcontact.cli.app import app

HOME = Path(__file__).parent.parent
PAGES = [HOME / "README.md", *sorted((HOME / "docs").rglob("*.md"))]
# Pages whose commands want a cluster, days, or a file of the reader's.
NOT_HERE = {"cluster.md", "law-ensembles.md", "reproduction-figures.md"}
# What takes minutes, and what is run in its place: of maps a piece or every other point.
FEWER = {
    **{"samples = 10": "samples = 2", "count = 6": "count = 2", "--samples 100": "--samples 3"},
    **{"--samples 10 ": "--samples 2 ", "points = 128": "points = 32"},
    **{
        "--size 1mm --points 256": "--size 0.25mm --points 64",
        "--size 128um --points 128": "--size 128um --points 64",
    },
    **{"--time-tolerance 1e-2": "--time-tolerance 5e-2", "10m/s:20": "10m/s:4", "1N:100N:30": "1N:100N:5"},
    **{"--samples 4 ": "--samples 1 ", "--samples 8": "--samples 2"},
    **{"points = 64": "points = 32", "samples = 4": "samples = 1", "points = 257": "points = 65"},
    # Of the programs of Python those that print nothing.
    **{
        "Grid((64, 64), 1e-5, periodic": "Grid((32, 32), 2e-5, periodic",
        "shape=(256, 256)": "shape=(96, 96)",
    },
    **{"--size 0.2mm --points 64": "--size 0.2mm --points 32", "points = 24": "points = 6"},
    **{"hurst=0.2,0.4,0.6,0.8,1 ": "hurst=0.2,1 ", "rms=0.2um,0.4um,0.6um,0.8um,1um": "rms=0.2um,1um"},
}
PROCESSES = "commands.md"  # where studies start processes; on the other pages this one computes them
# Libraries that a block may want and a machine may lack.
OPTIONAL = {"jax": "import jax\n", "torch": "import torch\n", "tqdm": "rc.progress.bar("}
BLOCK = re.compile(r"^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?", re.DOTALL | re.MULTILINE)
COMMAND = re.compile(r"^    (roughcontact .*?)(?: {2,}#.*)?$", re.MULTILINE)


def blocks():
    for page in PAGES:
        found = BLOCK.findall(page.read_text(encoding="utf-8"))
        for number, cells in enumerate([found] if page.parent.name == "course" else zip(found)):
            code = "".join(code for code, _ in cells)
            wanted = [name for name, sign in OPTIONAL.items() if sign in code]
            lacking = [each for each in wanted if importlib.util.find_spec(each) is None]
            skipped = pytest.mark.skipif(bool(lacking), reason=f"{', '.join(lacking)}: not installed")
            yield pytest.param(cells, id=f"{page.name}-{number}", marks=skipped)


def commands():
    for page in PAGES:
        lines = COMMAND.findall(page.read_text(encoding="utf-8"))
        if lines and page.name not in NOT_HERE:
            run = "study run" if page.name == PROCESSES else "study run --executor serial"
            yield pytest.param([fewer(line).replace("study run", run) for line in lines], id=page.name)


def fewer(text):
    for many, few in FEWER.items():
        text = text.replace(many, few)
    return text


@pytest.fixture(scope="module")
def given(tmp_path_factory):
    """Return a folder with the files that the pages name."""
    there = tmp_path_factory.mktemp("given")
    rng = np.random.default_rng(1)
    free = rc.Grid((64, 64), 1e-6)
    part = rc.self_affine(free, hurst=0.8, rms=1e-7, rng=rng)
    rc.write(part, there / "part.x3p")
    periodic = rc.Grid((32, 32), 4e-6, periodic=True)
    line = rc.self_affine(rc.Grid(256, 1e-6), hurst=0.8, rms=1e-7, rng=rng)
    places = line.grid.coordinates[0] * 1e6
    scan = np.column_stack([places, line.heights * 1e6])
    np.savetxt(there / "scan.csv", scan, "%.9g", ";", header="x [um];z [um]", comments="")
    joint = rc.self_affine(periodic, hurst=0.8, rms=1e-7, rolloff=32e-6, rng=rng)
    rc.write(joint, there / "joint.npz")
    points = "".join(f"{x}, {y}, {12 + x}\n" for y in (0, 2, 4) for x in (0, 2, 4))
    (there / "field.csv").write_text("x [mm], y [mm], p [MPa]\n" + points)
    pages = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    for name, text in re.findall(r"```(?:toml|text)\n# (\S+\.(?:toml|csv))\n(.*?)```", pages, re.DOTALL):
        (there / name).write_text(fewer(text), encoding="utf-8")
    return there


@pytest.fixture
def folder(given, tmp_path, monkeypatch):
    """Go to a copy of that folder."""
    shutil.copytree(given, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("cells", list(blocks()))
def test_python_runs_as_printed(cells, folder, undrawn):
    names = {"__name__": "__main__"}
    compared = any(printed for _, printed in cells)
    for code, printed in cells:
        with redirect_stdout(io.StringIO()) as out:
            exec(compile(code if compared else fewer(code), "block", "exec"), names)
        if printed:
            assert out.getvalue() == printed


@pytest.mark.slow
@pytest.mark.parametrize("lines", list(commands()))
def test_commands_run_as_printed(lines, folder, undrawn):
    for line in lines:
        answer = CliRunner().invoke(app, shlex.split(line)[1:])
        assert answer.exit_code == 0, f"{line}\n{answer.stderr}"


def test_the_reference_lists_what_there_is_without_the_site():
    """For readers in the repository: the parts of the package, and calls that print the docstrings."""
    page = (HOME / "docs" / "reference" / "index.md").read_text(encoding="utf-8")
    rooms = {name.room for name in public_names()}
    assert rooms == set(re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE))
    for path in re.findall(r"python -m pydoc ([\w.]+[a-z])", page):
        if not path.endswith("PART"):
            assert pydoc.locate(path) is not None, path
