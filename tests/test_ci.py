"""What `make` does beside the tests: it calls pip only where it must, and picks the quick tests."""

import importlib.util
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace

import pytest

HOME = Path(__file__).parent.parent


def script(name):
    spec = importlib.util.spec_from_file_location(f"ci_{name}", HOME / ".ci" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


PROJECT = """
[build-system]
requires = []
[project]
name = "numpy"
dependencies = ["scipy>=1.0", "no-such-package>=1; python_version < '3'"{more}]
optional-dependencies = {{ test = ["pytest>=1"] }}
[tool.hatch]
[tool.ruff]
line-length = {length}
"""
BESIDE = """
[build-system]
requires = []
[project]
name = "scipy"
version = "{version}"
[tool.hatch]
"""


@pytest.fixture
def pip(tmp_path, monkeypatch):
    """Return what installs into a stamp, and the calls of pip, which fail where the environment says so."""
    pytest.importorskip("pip")
    install, calls = script("install"), []
    monkeypatch.chdir(tmp_path)

    def run(words, **_):
        calls.append([word for before, word in pairwise(words) if before == "-e"])
        stderr = "ERROR: no route to the index\n[end of output]\nnote: read this"
        return SimpleNamespace(returncode=int(online is False), stderr=stderr)

    online = True

    def installed(*, more="", length=1, version=1, network=True):
        nonlocal online
        online = network
        Path("pyproject.toml").write_text(PROJECT.format(more=more, length=length), encoding="utf-8")
        Path("reproduction").mkdir(exist_ok=True)
        Path("reproduction/pyproject.toml").write_text(BESIDE.format(version=version), encoding="utf-8")
        before = len(calls)
        install.main(Path("stamp"), "Installing ...", "test")
        return calls[before:]

    monkeypatch.setattr(install.subprocess, "run", run)
    return installed


def test_pip_is_called_only_where_the_requirements_have_changed(pip, capsys):
    both = [[".[test]", "./reproduction"]]
    assert pip() == both
    assert capsys.readouterr().out == "Installing ...\n"
    assert pip() == []
    assert pip(length=2) == []
    assert capsys.readouterr().out == ""
    assert pip(more=', "numpy>=1"') == both
    assert pip(more=', "numpy>=1"') == []
    assert pip(more=', "numpy>=1"', version=2) == both


def test_without_a_network_what_is_installed_is_used_if_it_suits(pip, capsys):
    pip()
    capsys.readouterr()
    words = "pip cannot look for newer packages (no route to the index): what is installed is used\n"
    for _ in range(2):  # it is looked for until it is there
        assert pip(more=', "numpy>=1"', network=False) == [[".[test]", "./reproduction"]]
        assert capsys.readouterr().out == f"Installing ...\n{words}"
    with pytest.raises(
        SystemExit, match=r"^pip cannot install numpy>=99, no-such-package \(no route to the "
    ):
        pip(more=', "numpy>=99", "no-such-package"', network=False)
    assert pip(more=', "numpy>=1"') == [[".[test]", "./reproduction"]]


def test_quick_tests_are_those_of_the_house_and_of_what_changed(monkeypatch):
    quick = script("quick")
    house = {HOME / "tests" / f"test_{name}.py" for name in quick.HOUSE}
    assert all(path.exists() for path in house)
    figure = "reproduction/src/roughcontact_thesis/ruling.py"
    changes = ["src/roughcontact/files/sur.py", figure, "README.md", "tests/test_loops.py"]
    answers = {"diff": changes, "ls-files": []}
    monkeypatch.setattr(quick, "git", lambda verb, *_: answers[verb])
    named = ("tests/files/test_sur.py", "reproduction/tests/thesis/test_ruling.py", "tests/test_loops.py")
    assert quick.tests() - house == {HOME / name for name in named}
    answers = {"diff": [], "ls-files": []}
    assert quick.tests() == house


def test_git_that_knows_no_answer_gives_none(tmp_path, monkeypatch):
    quick = script("quick")
    monkeypatch.setattr(quick, "HOME", tmp_path)
    assert quick.git("diff", "--name-only", "HEAD") == []


def test_the_list_of_quick_tests_goes_to_pytest():
    words = [sys.executable, HOME / ".ci" / "quick.py"]
    paths = subprocess.run(words, capture_output=True, encoding="utf-8", check=True).stdout.split()
    assert all((HOME / path).is_file() for path in paths)
    assert "$$($(BIN)/python .ci/quick.py)" in (HOME / "Makefile").read_text(encoding="utf-8")
