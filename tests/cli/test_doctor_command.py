"""What the doctor says of an installation that works, and of one that is broken."""

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from types import SimpleNamespace

import pytest

import roughcontact as rc
from roughcontact.cli import doctor_command
from roughcontact.cli.doctor_command import EXTRAS
from roughcontact.cli.exits import BAD_INPUT, MISSED
from roughcontact.evaluation.self_check import LIMITS
from roughcontact.files.installed import Requirement

PROJECT = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
WORK_ON_THIS_PACKAGE = {"test", "docs", "browser", "lint"}


@pytest.fixture
def quick(monkeypatch):
    """Leave the check out, which takes a second, and the devices, which take more."""
    parts = {name: part for name, part in doctor_command._PARTS.items() if name not in ("check", "devices")}
    monkeypatch.setattr(doctor_command, "_PARTS", parts)


@pytest.fixture
def checked(monkeypatch, invoke):
    """Return what the check alone says."""

    def run(code=None):
        monkeypatch.setattr(doctor_command, "_PARTS", {"check": doctor_command._check})
        if code is not None:
            monkeypatch.setattr(doctor_command, "_CHECK", code)
        answer = invoke("doctor", "--json")
        return answer.exit_code, json.loads(answer.stdout)

    return run


def test_it_says_what_is_installed(invoke):
    answer = invoke("doctor", "--json")
    found = json.loads(answer.stdout)
    assert answer.exit_code == (MISSED if found["problems"] else 0)
    assert found["python"]["roughcontact"] == rc.__version__
    assert {re.match(r"[\w-]+", text)[0] for text in PROJECT["dependencies"]} == set(found["packages"])
    assert found["extras"].keys() == EXTRAS.keys()
    assert found["check"].keys() == {*LIMITS, "sphere beside Hertz"}
    assert all(0 <= found["check"][name] <= limit for name, limit in LIMITS.items())
    assert found["check"]["sphere beside Hertz"] == "right"
    assert {"machine code", "cache of machine code", "threads", "memory", "devices"} <= found.keys()


def test_people_read_the_same_and_where_to_report(invoke, quick, monkeypatch):
    monkeypatch.setenv("HOME", str(Path(rc.__file__).parents[2]))
    monkeypatch.setenv("USERPROFILE", os.environ["HOME"])
    record = json.loads(invoke("doctor", "--json").stdout)
    answer = invoke("doctor")
    assert record["python"]["in"] == os.path.join("~", "src", "roughcontact")
    assert os.environ["HOME"] not in answer.stdout
    for title, told in record.items():
        if isinstance(told, dict):
            assert title in answer.stdout.splitlines()
            assert all(f"  {name} " in answer.stdout for name in told)
    assert f"problems: {len(record['problems']) or 'none'}" in answer.stdout
    assert "issue tracker" in answer.stderr
    assert "SECURITY.md" in answer.stderr


def test_the_extras_are_those_that_users_install():
    assert EXTRAS.keys() == PROJECT["optional-dependencies"].keys() - WORK_ON_THIS_PACKAGE


def test_a_package_that_an_extra_lacks_is_named_with_what_it_is_for(invoke, quick, monkeypatch):
    wanted = [Requirement("starlette", "0.40", "page", "1.0"), Requirement("uvicorn", "0.30", "page", None)]
    monkeypatch.setattr(doctor_command, "requirements", lambda: wanted)
    answer = invoke("doctor", "--json")
    page = json.loads(answer.stdout)["extras"]["page"]
    assert page.startswith("missing uvicorn, for the page in the browser")
    assert page.endswith("-m pip install 'roughcontact[page]'")


@pytest.mark.parametrize(
    ("broken", "check"),
    [
        (
            [
                (
                    *("numpy", "raise ImportError('torn apart')"),
                    "the package numpy cannot be loaded (torn apart): run: ",
                )
            ],
            "WRONG",
        ),
        ([("threadpoolctl", "1 / 0", "threadpoolctl: ZeroDivisionError: division by zero")], "WRONG"),
        (
            [
                ("psutil", "import gone_with_it", "the package gone_with_it is not installed: run: "),
                ("llvmlite", "raise OSError('no libffi')", "llvmlite: OSError: no libffi"),
            ],
            "right",
        ),
    ],
    ids=["numpy", "threadpoolctl", "two that are no part of the check"],
)
def test_a_broken_package_is_named_and_all_else_is_told(tmp_path, broken, check):
    for package, text, _ in broken:
        (tmp_path / package).mkdir()
        (tmp_path / package / "__init__.py").write_text(text)
    (tmp_path / "torch.py").write_text("raise ImportError('sooner than the true one')")
    paths = [str(tmp_path), str(Path(rc.__file__).parents[1])]
    answer = subprocess.run(
        [sys.executable, "-m", "roughcontact", "doctor", "--json"],
        capture_output=True,
        encoding="utf-8",
        env=os.environ | {"PYTHONPATH": os.pathsep.join(paths)},
        timeout=300,
        check=False,
    )
    found = json.loads(answer.stdout)
    assert answer.returncode == MISSED, answer.stderr
    for _, _, problem in broken:
        assert any(each.startswith(problem) for each in found["problems"]), found["problems"]
    assert found["python"]["python"].startswith(sys.version.partition(" ")[0])
    assert ("free" in found["memory"]) == (broken[0][0] not in ("numpy", "psutil"))
    assert found["check"]["sphere beside Hertz"] == check


def test_without_the_package_of_the_command_line_itself_it_is_named():
    code = "import sys; sys.modules['typer'] = None; from roughcontact.cli.main import run; run()"
    answer = subprocess.run(
        [sys.executable, "-c", code, "doctor"], capture_output=True, encoding="utf-8", check=False
    )
    assert (answer.returncode, answer.stdout) == (BAD_INPUT, "")
    assert answer.stderr.startswith("Error: the package typer is not installed: run: ")


def test_a_wrong_answer_is_a_problem(checked):
    status, found = checked("""print('{"depth error": 0.5, "stiffness error": 0.001, "residual": NaN}')""")
    assert (status, found["check"]["sphere beside Hertz"]) == (MISSED, "WRONG")
    assert found["problems"] == [
        "the check fails: depth error and residual of a pressed sphere outside the tolerance"
    ]


def test_what_is_right_without_machine_code_says_so(checked):
    right = json.dumps(dict.fromkeys(LIMITS, 0.0))
    code = f"import os; print({right!r} if os.environ.get('ROUGHCONTACT_CPU') == 'off' else 1 / 0)"
    assert checked(code)[1]["problems"] == [
        "the check fails: ZeroDivisionError: division by zero",
        "without machine code it is right: set ROUGHCONTACT_CPU=off until this is mended",
    ]


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_a_crash_of_the_check_is_none_of_the_doctor(checked):
    status, found = checked("import os, signal; os.kill(os.getpid(), signal.SIGILL)")
    assert (status, found["problems"]) == (MISSED, ["the check fails: it was ended by SIGILL"])


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the folder is not named by the environment")
@pytest.mark.parametrize(("mode", "kept"), [(0o700, True), (0o777, False)])
def test_a_cache_that_others_can_write_to_is_a_problem(invoke, quick, monkeypatch, tmp_path, mode, kept):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = tmp_path / "roughcontact"
    folder.mkdir()
    folder.chmod(mode)
    (folder / "a.o").write_bytes(bytes(2_000_000))
    found = json.loads(invoke("doctor", "--json").stdout)
    told = found["cache of machine code"]
    assert told == {"folder": str(folder), "holds": "1 files, 2.0 MB", "writable": kept}
    assert any("cannot be kept in" in each for each in found["problems"]) != kept


@pytest.mark.parametrize(("stated", "machine_code"), [("off", "nothing: "), ("z80", None)])
def test_the_processor_that_is_asked_for_is_told(invoke, quick, monkeypatch, stated, machine_code):
    monkeypatch.setenv("ROUGHCONTACT_CPU", stated)
    found = json.loads(invoke("doctor", "--json").stdout)
    assert found["python"]["ROUGHCONTACT_CPU"] == stated
    if machine_code is None:
        assert any("'z80' is not a processor known here" in each for each in found["problems"])
    else:
        assert found["machine code"]["made for"].startswith(machine_code)


def test_a_device_is_counted(monkeypatch):
    cuda = SimpleNamespace(runtime=SimpleNamespace(getDeviceCount=lambda: 2))
    monkeypatch.setitem(sys.modules, "cupy", SimpleNamespace(__version__="13", cuda=cuda))
    assert list(doctor_command._device("cupy")) == [("cupy", "13, 2 GPUs")]
