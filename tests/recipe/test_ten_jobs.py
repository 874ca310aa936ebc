"""Jobs of every kind: run from their file, by the printed command and by the printed Python, and repeated."""

import json
import shlex
import shutil
import zipfile
from contextlib import nullcontext
from functools import cache
from io import BytesIO
from itertools import chain
from pathlib import Path

import h5py
import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from pictures import without_fields
from roughcontact.cli.app import app
from roughcontact.labels.labelled import plain_values
from roughcontact.page import page_worker
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.stopping import Stopping
from roughcontact.recipe.command import command_of
from roughcontact.recipe.job_calls import python_of
from roughcontact.recipe.jobs import calls_of
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.recipe_fields import given, specs
from roughcontact.recipe.repeated import differences
from roughcontact.recipe.source import SOURCES, InPython
from roughcontact.recipe.written import read_job, to_plain
from roughcontact.threads import limit_threads, one_blas_thread

pytestmark = [pytest.mark.usefixtures("undrawn"), pytest.mark.slow]
JOBS = {path.stem: path for path in sorted((Path(__file__).parent / "jobs").glob("*.toml"))}
KINDS = {
    "elastic": ("press_measured", "curve_self_affine", "curve_specified"),
    "under a hardness": ("loop_shape", "press_after_example"),
    "sticking": ("adhesive_state", "adhesive_curve", "adhesive_loop", "detachment"),
    "leak": ("leak_liquid", "leak_gas"),
    "shear": ("shear_compared", "shear_flowed"),
    "in time": ("creep_force", "creep_squeeze"),
    "sliding": ("sliding_angle", "sliding_force"),
    "joint": ("joint_bolt", "joint_table"),
    "line": ("line_press", "line_curve"),
    "springs": ("winkler_press", "winkler_curve"),
}
WITHOUT_FORM = ("leak", "shear", "in time", "sliding", "joint")
# The variable that holds the answer, in the Python of a job.
ANSWERS = {"press": "solution", "leak": "leak", "curve": "curve", "adhesion press": "state", "joint": "joint"}
# What the page gives away of some jobs, fields too.
REPEATED_FROM_THE_PAGE = {"press_measured": ("press.json", "pressure.nc"), "loop_shape": ("curve.nc",)}
every_job = pytest.mark.parametrize("name", JOBS)


@pytest.fixture(autouse=True)
def one_thread():
    """Sums are added up in the same order."""
    with limit_threads(1), one_blas_thread():
        yield


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """A folder with the jobs and the measured files that some of them name."""
    here = tmp_path_factory.mktemp("jobs")
    for path in JOBS.values():
        shutil.copy(path, here)
    surface = rc.self_affine(rc.Grid((24, 32), 1e-6), 0.8, 2e-7, np.random.default_rng(5))
    heights = 1e6 * surface.heights
    heights[5, 7], heights[12, 20] = heights[5, 7] + 30, np.nan  # a spike, and a point that was not measured
    np.savetxt(here / "measured.txt", heights)
    rc.Viscoelastic(1e7, [2e7, 3e7], [1e-3, 1e-5]).write(here / "rubber.material")
    line = rc.self_affine(rc.Grid(64, 1e-6), 0.8, 2e-7, np.random.default_rng(6))
    rc.Viscoelastic(1e6, [2e6, 6e6], [1.0, 0.01]).write(here / "rubber.toml")
    points = "".join(f"{x}, {y}, {1 + x + y}\n" for y in range(3) for x in range(4))
    (here / "field.csv").write_text("x [mm], y [mm], p [MPa]\n" + points)
    np.savetxt(here / "profile.txt", np.column_stack([1e6 * line.grid.coordinates[0], 1e6 * line.heights]))
    return here


@pytest.fixture
def there(home, monkeypatch):
    monkeypatch.chdir(home)
    return home


def invoked(*words):
    """Return the answer of a command line in this process."""
    return CliRunner().invoke(app, [str(word) for word in words], env={"COLUMNS": "500", "TERM": "dumb"})


@cache
def result_of(name, home):
    """Run a job once; return the file of its numbers."""
    answer = invoked("run", home / f"{name}.toml", "--out", home / name)
    assert answer.exit_code == 0, answer.stderr
    return _record_in(home / name)


def _record_in(folder):
    [found] = folder.glob("*.json")
    return found


def numbers(path):
    return json.loads(path.read_text(encoding="utf-8"))


def maps(folder):
    """Return all columns and maps of the NetCDF files in a folder, by file and name."""
    found = {}
    for path in sorted(folder.glob("*.nc")):
        with h5py.File(path) as file:
            found |= {(path.name, name): values[()] for name, values in file.items()}
    return found


def test_each_kind_of_problem_has_two_jobs_and_each_source_and_step_one():
    jobs = {name: read_job(path) for name, path in JOBS.items()}
    assert sorted(name for names in KINDS.values() for name in names) == sorted(jobs)
    assert min(map(len, KINDS.values())) >= 2
    assert {type(job.source) for job in jobs.values()} == set(SOURCES) - {InPython}
    assert {name for job in jobs.values() for name in given(job.preparation)} == {
        each.name for each, _ in specs(Preparation)
    }


@every_job
def test_the_numbers_are_those_of_other_machines(name, there):
    """As they were on another one: to 1e-10, of which other kernels of BLAS and other machine code use up 1e-13."""
    found = numbers(result_of(name, there))
    expected = numbers(JOBS[name].with_name("numbers.json"))[name]
    assert {each: largest(found[each]) for each in expected} == pytest.approx(expected, rel=1e-10, abs=0)


def largest(values):
    """Return a number, or the largest of several, whatever its sign."""
    return max(values, key=abs) if isinstance(values, list) else values


@every_job
def test_the_printed_command_gives_the_same_numbers(name, there):
    before = result_of(name, there)
    lines = command_of(read_job(Path(f"{name}.toml")), f"{name}.toml").splitlines()
    folder = there / f"{name}-command"
    for line in lines:
        program, *words = shlex.split(line)
        assert program == "roughcontact"
        answer = invoked(*words, *(["--out", folder] if line is lines[-1] else []))
        assert answer.exit_code == 0, (line, answer.stderr)
    assert [str(each) for each in differences(numbers(before), numbers(_record_in(folder)))] == []
    old, new = maps(before.parent), maps(folder)
    assert old.keys() == new.keys()
    for key, values in old.items():
        np.testing.assert_array_equal(new[key], values, err_msg=str(key))


@every_job
def test_the_printed_python_gives_the_same_numbers(name, there):
    before, job = numbers(result_of(name, there)), read_job(Path(f"{name}.toml"))
    known = {}
    exec(python_of(calls_of(job)), known)
    if job.NAME == "shear":
        found = {name: plain_values(values.to_numpy()) for name, values in known["shear"].items()}
    else:  # of a loop the record is that of its first loading
        answer = (
            known["loop"].loading
            if job.NAME == "curve" and "loop" in known
            else known[ANSWERS.get(job.NAME, "curve")]
        )
        found = json.loads(json.dumps(answer.to_record()))
    assert found.keys() <= before.keys()
    assert len(found) >= 10
    shared = {each: before[each] for each in found}
    assert [str(each) for each in differences(shared, found)] == []


@every_job
def test_a_result_is_repeated_to_the_last_digit(name, there):
    result = result_of(name, there)
    with without_fields():
        answer = invoked("run", result)
    assert answer.exit_code == 0, answer.stderr
    assert "Note: same numbers" in answer.stderr


@pytest.mark.parametrize(
    ("name", "quantity"), [("line_press", "depth"), ("winkler_curve", "force"), ("detachment", "depth")]
)
def test_a_changed_digit_is_reported(name, quantity, there):
    before = result_of(name, there)
    record = numbers(before)
    values = record[quantity] if isinstance(record[quantity], list) else [record[quantity]]
    values[-1] = float(np.nextafter(values[-1], np.inf))
    record[quantity] = values if isinstance(record[quantity], list) else values[0]
    changed = before.with_name(f"changed-{name}.json")
    changed.write_text(json.dumps(record), encoding="utf-8")
    try:
        with without_fields():
            answer = invoked("run", changed)
    finally:
        changed.unlink()
    assert answer.exit_code == 1, answer.stderr
    assert (
        f"Note: 1 quantity differs:\nNote: {quantity}: 1 of {len(values)} differ, by at most" in answer.stderr
    )


@cache
def on_the_page(name, home):
    """Return the messages of a worker of the page that exports the answer to a job, and the archive's files."""
    plain, sent = to_plain(read_job(Path(f"{name}.toml"))), []
    file = plain["source"].get("file")
    files = {} if file is None else {file: {"path": str(home / file), "name": file}}
    request = {"number": 1, "job": "export", "recipe": plain, "files": files, "more": {"kind": "zip"}}
    with nullcontext() if name in REPEATED_FROM_THE_PAGE else without_fields():
        page_worker.perform(
            request, SessionCache(), lambda header, data=b"": sent.append((header, data)), Stopping()
        )
    packed = [data for header, data in sent if header["type"] == "file"]
    return sent[-1][0], zipfile.ZipFile(BytesIO(packed[0])) if packed else None


@pytest.mark.parametrize("name", sorted(JOBS.keys() - {*chain(*(KINDS[name] for name in WITHOUT_FORM))}))
def test_the_page_gives_the_same_numbers(name, there):
    before = numbers(result_of(name, there))
    end, archive = on_the_page(name, there)
    assert end["how"] == "done", end
    stem = read_job(Path(f"{name}.toml")).NAME.replace(" ", "-")
    found = json.loads(archive.read(f"{stem}.json"))
    shared = {each: before[each] for each in found.keys() & before.keys()}
    assert {"force", "depth", "stiffness"} <= shared.keys()
    assert [str(each) for each in differences(shared, found)] == []


@pytest.mark.parametrize(
    ("name", "file"), [(name, file) for name, files in REPEATED_FROM_THE_PAGE.items() for file in files]
)
def test_what_the_page_gives_away_is_repeated(name, file, there):
    _, archive = on_the_page(name, there)
    exported = there / f"page-{name}-{file}"
    exported.write_bytes(archive.read(file))
    answer = invoked("run", exported)
    assert answer.exit_code == 0, answer.stderr
    assert "same numbers" in answer.stderr


@pytest.mark.parametrize("name", ["press_measured", "press_after_example"])
def test_the_recipe_in_what_the_page_gives_away_is_run(name, there):
    """Where a file is, the page names it without a folder; where none is, the command that it states runs this file."""
    _, archive = on_the_page(name, there)
    (there / "press-job.toml").write_bytes(archive.read("press-job.toml"))
    stated = archive.read("commands.sh").decode().strip()
    assert (stated == "roughcontact run press-job.toml") == (name == "press_after_example")
    answer = invoked("run", "press-job.toml", "--out", f"{name}-again")
    assert answer.exit_code == 0, answer.stderr
    again = numbers(_record_in(there / f"{name}-again"))
    assert differences(numbers(result_of(name, there)), again) == []


@pytest.mark.parametrize("file", ["loop.nc", "curve.nc"])
def test_each_file_of_a_loop_is_repeated(file, there):
    answer = invoked("run", result_of("loop_shape", there).with_name(file))
    assert answer.exit_code == 0, answer.stderr
    assert "same numbers" in answer.stderr
