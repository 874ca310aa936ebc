"""A step of the preparation that is added for trial: a numeric function, and one field of the recipe.

A copy of the sources gets both, as a contributor would write them, and nothing else. The new option is then in every
command, file, form and page, and does what it should.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.ndimage import median_filter

import roughcontact as rc

HOME = Path(__file__).parents[2]
NUMERICS = '''"""Medians of heights."""

from __future__ import annotations

from dataclasses import replace

from scipy.ndimage import median_filter

from roughcontact.surface.surface import Surface
from roughcontact.validation import numeric_method

__all__ = ["median_filtered"]


@numeric_method
def median_filtered(surface: Surface, cells: int) -> Surface:
    """Return the median of the heights over `cells` x `cells` cells."""
    heights = median_filter(surface.heights, cells, mode="nearest")
    return replace(surface, heights=heights, provenance=(*surface.provenance, f"median over {cells} cells"))
'''
# The function as a method of surfaces, as `scanned` is one.
METHOD = [
    (
        "methods.py",
        '        "surface.preparation.tip": "scanned",\n',
        '        "surface.preparation.medians": "median_filtered",\n',
    ),
    (
        "surface/surface.py",
        "    scanned = methods.scanned\n",
        "    median_filtered = methods.median_filtered\n",
    ),
]
FIELD = (
    "recipe/preparation.py",
    "    short_cutoff: str | None = _step(\n",
    """    median: str | None = _step(
        "Median over K x K cells.", "3", "median_filtered", "Filtering", read=whole(1, "the number of cells")
    )
""",
)
# What the copy is asked; it answers with one JSON object.
QUESTIONS = """
import json, sys
from pathlib import Path
import numpy as np
from typer.testing import CliRunner
import roughcontact as rc
from roughcontact.cli.app import app
from roughcontact.page.forms import forms
from roughcontact.recipe.command import command_of
from roughcontact.recipe.jobs import calls_of
from roughcontact.recipe.job_calls import python_of
from roughcontact.recipe.written import read_job, to_plain
from recipe_page import recipes

def invoked(line):
    environment = {"COLUMNS": "200", "TERM": "dumb", "NO_COLOR": "1"}
    answer = CliRunner().invoke(app, line.split(), env=environment)
    return {"status": answer.exit_code, "out": answer.stdout, "err": answer.stderr}

job = read_job(Path("job.toml"))
space = {}
exec(python_of(calls_of(job)), space)
found = {
    "package": rc.__file__,
    "help": {name: invoked(f"{name} --help-all")["out"] for name in sys.argv[1:]},
    "short": invoked("press --help")["out"],
    "prepared": invoked("surface prepare part.npz command.npz --level none --median 3"),
    "run": invoked("run job.toml --out run"),
    "pressed": invoked("press part.npz --pressure 1MPa --modulus 1GPa --level none --median 3 --out pressed"),
    "again": invoked("run pressed/press.json"),
    "refused": invoked("surface prepare part.npz wrong.npz --median 0 --json"),
    "study": invoked("study from press.toml --vary preparation.median=1,3 --samples 1 --out study.toml"),
    "recipe": to_plain(job),
    "command": command_of(job),
    "python": python_of(calls_of(job)),
    "form": [each["name"] for each in forms()["jobs"]["press"]["preparation"]["fields"]],
    "reference": [line for line in recipes() if line.startswith("| `median`")],
    "heights": space["surface"].heights.tolist(),
    "carried": json.loads(Path("pressed/press.json").read_text())["recipe"]["preparation"],
}
print(json.dumps(found))
"""
COMMANDS = [
    "press",
    "leak",
    "shear",
    "curve",
    "creep",
    "surface prepare",
    "adhesion press",
    "adhesion curve",
    "adhesion loop",
    "adhesion detach",
    "sliding",
    "joint",
]


def inserted(path, place, text):
    """Insert lines of Python before others, once."""
    before = path.read_text(encoding="utf-8")
    assert before.count(place) == 1, (path, place)
    path.write_text(before.replace(place, text + place), encoding="utf-8")


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    here = tmp_path_factory.mktemp("trial")
    surface = rc.self_affine(rc.Grid((24, 32), 1e-6), 0.8, 1e-7, np.random.default_rng(5))
    rc.write(surface, here / "part.npz")
    job = "[source]\nfile = 'part.npz'\n[preparation]\nlevel = 'none'\nmedian = 3\n"
    (here / "job.toml").write_text(f"job = 'surface'\n{job}")
    (here / "press.toml").write_text(
        f"job = 'press'\n{job}[load]\npressure = '1MPa'\n[bodies]\nmodulus = '1GPa'\n"
    )
    return here


@pytest.fixture(scope="module")
def found(home):
    """The answers of a copy of the package in which the step is declared."""
    copy = home / "src" / "roughcontact"
    shutil.copytree(HOME / "src" / "roughcontact", copy, ignore=shutil.ignore_patterns("__pycache__"))
    (copy / "surface" / "preparation" / "medians.py").write_text(NUMERICS, encoding="utf-8")
    for file, place, text in [*METHOD, FIELD]:
        inserted(copy / file, place, text)
    paths = [str(copy.parent), str(HOME / "docs"), str(HOME / "tests")]
    answer = subprocess.run(
        [sys.executable, "-c", QUESTIONS, *COMMANDS],
        cwd=home,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(paths)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    found = json.loads(answer.stdout)
    assert Path(found["package"]).parent == copy
    return found


@pytest.mark.slow
def test_every_command_that_prepares_has_the_option(found):
    for name, text in found["help"].items():
        assert "--median" in text, name
        assert "Median over K x K cells." in text, name
    assert found["help"].keys() == set(COMMANDS)
    # An option that not everybody needs: the short help has its name alone.
    assert "--median" in found["short"]
    assert "Median over" not in found["short"]


def test_the_step_is_taken_in_its_place_by_command_recipe_and_python(found, home):
    before = rc.read(home / "part.npz")
    expected = median_filter(before.heights, 3, mode="nearest")
    assert (found["prepared"]["status"], found["run"]["status"]) == (0, 0), (found["prepared"], found["run"])
    for file in ("command.npz", "run/surface.npz"):
        surface = rc.read(home / file)
        np.testing.assert_array_equal(surface.heights, expected)
        assert "median over 3 cells" in surface.provenance
    np.testing.assert_array_equal(np.array(found["heights"]), expected)


def test_the_recipe_the_statements_the_form_and_the_reference_have_it(found):
    assert found["recipe"]["preparation"] == {"level": "none", "median": "3"}
    assert found["command"].endswith("--level none --median 3")
    assert "surface = surface.median_filtered(3)\n" in found["python"]
    assert found["form"].index("median") == found["form"].index("short_cutoff") - 1
    assert found["reference"] == ["| `median` | Median over K x K cells. | `3` |  |"]


def test_a_result_carries_it_and_is_repeated(found):
    assert found["carried"] == {"level": "none", "median": "3"}
    assert found["again"]["status"] == 0
    assert "same numbers" in found["again"]["err"]


def test_a_value_out_of_range_is_refused(found):
    error = json.loads(found["refused"]["out"])["error"]
    assert found["refused"]["status"] == error["exit_status"] == 2
    assert (error["place"], "whole number from 1 up" in error["message"]) == ("--median", True)
    assert error["remedy"] == "give one such as 2"


def test_a_study_varies_it(found, home):
    assert found["study"]["status"] == 0, found["study"]
    assert "preparation.median" in (home / "study.toml").read_text().replace('"', "")
