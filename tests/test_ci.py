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


@pytest.fixture
def prose(tmp_path, monkeypatch):
    """Return the check of prose, for a checkout in an empty folder without exceptions."""
    module = script("prose")
    monkeypatch.setattr(module, "HOME", tmp_path)
    monkeypatch.setattr(module, "LEFT", tmp_path / "left.toml")
    monkeypatch.setattr(module, "EXCEPT", ())
    return module


def rules(prose, name, text):
    path = prose.HOME / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return [(one.line, one.rule) for one in prose.findings(path)]


@pytest.mark.parametrize(
    ("rule", "wrong", "right"),
    [
        ("tell", "a message tells which", "a message names it"),
        ("say", "the label says so", "we say so"),
        ("know", "a file knows no units", "a file has known units"),
        ("want", "a curve wants loads", "users want loads"),
        ("forget", "the first speaks for all", "the first prints for all"),
        ("who", "a gift to whoever waits", "a thread that waits"),
        ("hardly", "there is hardly a cell", "almost no cell"),
        ("but for", "all cells but for one", "all cells except one"),
        ("so many", "a block of so many cells", "so many cells that none is left, twice as many as before"),
        ("none", "if the spectrum is none", "NaN where there is none, or if x is None"),
        ("no number", "it holds no number", "it is not a number"),
        ("what there is", "the end of what there is", "what is there"),
        ("is to be", "where a limit is to be found", "where we look for a limit"),
        ("is meant", "which of them is meant", "which of them is meant to be used"),
        ("all of it", "keep all of it", "all of its cells"),
        ("of its own", "in a process of its own", "a curve of your own file"),
        ("lets expect", "as its slope lets expect", "as expected from its slope"),
        ("alone", "of the host alone", "it can stand alone"),
        ("else", "the side, else 1", "nowhere else"),
        ("inverted", "It ends. Of a line it is C1D", "The sides of a line"),
        ("idiom", "it could take for ever", "it could take hours"),
    ],
)
def test_a_turn_of_phrase_that_is_not_used_is_found(prose, rule, wrong, right):
    assert rules(prose, "page.md", f"{right}.\n") == []
    assert rules(prose, "page.md", f"{right}.\n\n{wrong.replace(' ', chr(10), 1)}.\n") == [(4, rule)]
    assert rule in {name for name, *_ in prose.RULES}


def test_every_rule_of_prose_is_tested(prose):
    marks = test_a_turn_of_phrase_that_is_not_used_is_found.pytestmark
    assert {rule for rule, *_ in marks[0].args[1]} == {name for name, *_ in prose.RULES}


def test_code_in_a_page_is_no_prose_but_its_comments_are(prose):
    page = "`told` [a](told.md) <!-- told -->\n\n```python\ntold = 1  # told\n```\n\n    told\n"
    assert rules(prose, "page.md", page) == [(4, "tell"), (7, "tell")]


def test_texts_of_code_are_its_docstrings_messages_and_comments(prose):
    code = (
        '"""It tells.\n\nIt said.\n\n>>> told\n"""\n'
        "alone = told(hardly)  # it is as it\n"
        "# knows\n"
        'raise Wrong("told", f"the {told!r} is "\n    "none")\n'
    )
    assert rules(prose, "code.py", code) == [(1, "tell"), (3, "say"), (8, "know"), (9, "none")]
    script = 'told("told", "is told") // whoever\n'
    assert rules(prose, "src/static/told.js", script) == [(1, "tell"), (1, "who")]


def test_findings_may_only_become_fewer(prose):
    def state(count):
        rules(prose, "page.md", "hardly\n\n" * count)
        return prose.main()

    state(3)
    prose.main("--lower")
    assert 'page.md" = 3' in prose.LEFT.read_text(encoding="utf-8")
    assert state(3) is None
    for count, remedy in ((4, "python .ci/prose.py page.md"), (2, "python .ci/prose.py --lower")):
        assert state(count).endswith(remedy)
    assert prose.main("--lower") is None
    assert state(3).startswith("page.md: 3 findings, 2 allowed")
    assert prose.main("--lower") is not None  # numbers are not raised
    assert state(0) is not None
    assert prose.main("--lower") is None
    assert prose.left() == {}
    assert state(1) is not None


def test_an_exception_allows_its_words_until_they_are_gone(prose, monkeypatch):
    monkeypatch.setattr(prose, "EXCEPT", (("page.md", "is said to be", "quoted"),))
    assert rules(prose, "page.md", "it is said\nto be, it is said\n") == [(2, "say")]
    assert prose.stale() == []
    assert rules(prose, "page.md", "it is said\n") == [(1, "say")]
    assert "page.md" in prose.main().splitlines()[-1]


def test_findings_of_a_folder_are_printed(prose, capsys):
    rules(prose, "docs/how-to/page.md", "hardly\n")
    rules(prose, "docs/gallery/made.md", "hardly\n")
    assert prose.main(str(prose.HOME / "docs")) is None
    assert capsys.readouterr().out.startswith("docs/how-to/page.md:1: hardly: ")
    assert [path.name for path in prose.files()] == ["page.md"]
    assert "$(BIN)/python .ci/prose.py" in (HOME / "Makefile").read_text(encoding="utf-8")
