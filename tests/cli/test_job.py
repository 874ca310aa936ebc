import json
import sys

import pytest
from typer.testing import CliRunner

from roughcontact.cli import job
from roughcontact.cli.app import app
from roughcontact.cli.messages import UsageError

STATED = [name for pair in job._STATED.items() for name in pair]


@pytest.fixture(autouse=True)
def alone(monkeypatch):
    """Tests may themselves run in a job."""
    for name in STATED:
        monkeypatch.delenv(name, raising=False)
    job.slabs_of_job.cache_clear()
    yield
    job.slabs_of_job.cache_clear()


@pytest.mark.parametrize(("size", "rank"), job._STATED.items(), ids=str)
def test_a_launcher_is_known_by_what_it_states(size, rank, monkeypatch):
    assert job.launched() == (0, 1)
    monkeypatch.setenv(size, "4")
    assert job.launched() == (0, 1)  # half a statement is none
    monkeypatch.setenv(rank, "2")
    assert job.launched() == (2, 4)


def test_one_process_is_no_job(monkeypatch):
    assert job.slabs_of_job() is None
    assert job.refusal(["study", "run", "s.toml"]) is None
    job.require_one_process({"--loop": True})
    monkeypatch.setenv("PMI_SIZE", "1")
    monkeypatch.setenv("PMI_RANK", "0")
    assert job.slabs_of_job() is None


@pytest.fixture
def third_of_four(monkeypatch):
    monkeypatch.setenv("PMI_SIZE", "4")
    monkeypatch.setenv("PMI_RANK", "2")


@pytest.mark.usefixtures("third_of_four")
@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["press", "a.npz"], None),
        (["curve", "--json", "a.npz"], None),
        (["surface", "make", "a.npz"], None),
        (["surface", "info", "a.npz"], "'surface info'"),
        (["adhesion", "press", "a.npz"], "'adhesion press'"),
        (["study", "run", "s.toml"], "'study run'"),
        (["serve"], "'serve'"),
        (["study", "--help"], None),
        (["--version"], None),
    ],
)
def test_other_commands_are_refused(arguments, named):
    problem = job.refusal(arguments)
    assert (problem is None) == (named is None)
    if named:
        assert "4 processes" in str(problem)
        assert named in str(problem)


@pytest.mark.usefixtures("third_of_four")
def test_options_about_the_whole_surface_are_refused():
    job.require_one_process({"--theory": None, "--errors": False})
    with pytest.raises(UsageError, match=r"--errors needs the whole surface, of which each of 4 processes"):
        job.require_one_process({"--theory": None, "--errors": True})


@pytest.mark.usefixtures("third_of_four")
@pytest.mark.parametrize(
    ("command", "option"),
    [
        *(("press", option) for option in ("--after 2MPa", "--theory persson")),
        *(("curve", option) for option in ("--loop", "--theory persson", "--table csv")),
        *(
            (command, option)
            for command in ("press", "curve")
            for option in ("--flow removed", "--errors", "--despike missing", "--profile line")
        ),
    ],
)
def test_commands_refuse_them_before_any_work(command, option):
    """There is no such file, and no MPI: neither is asked for."""
    words = [command, "none.npz", *option.split(), "--modulus", "1GPa", "--json"]
    answer = CliRunner().invoke(app, words)
    assert answer.exit_code == 2
    assert json.loads(answer.stdout)["error"]["message"].startswith(
        f"{option.split()[0]} needs the whole surface"
    )


@pytest.mark.usefixtures("third_of_four")
def test_without_mpi4py_it_says_what_to_install(monkeypatch):
    """Else each process would do the whole work and write the same files."""
    monkeypatch.setitem(sys.modules, "mpi4py", None)
    with pytest.raises(UsageError, match=r"install roughcontact\[mpi\], or start one process"):
        job.slabs_of_job()


@pytest.mark.usefixtures("third_of_four")
def test_only_the_first_process_speaks(capsys):
    def speak():
        with job.as_one():
            sys.stdout.write("an answer")
            sys.exit(2)

    with pytest.raises(SystemExit) as end:
        speak()
    assert end.value.code == 2
    assert capsys.readouterr().out == ""
