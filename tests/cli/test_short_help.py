"""The help of each command: on a screen, and all of it."""

import pytest
from typer.testing import CliRunner

from roughcontact.cli.app import app
from roughcontact.cli.option_groups import grouped
from roughcontact.cli.parsing.short_help import _first_sentence

ROWS, COLUMNS = 40, 80  # of a screen
JOBS = [
    *("press", "leak", "shear", "curve", "creep", "sliding", "joint"),
    *("adhesion press", "adhesion curve", "adhesion loop", "adhesion detach"),
    *("surface prepare", "surface make", "surface specified", "theory", "infer"),
]


@pytest.fixture
def helped():
    def run(command, option):
        environment = {"COLUMNS": str(COLUMNS), "TERM": "dumb", "NO_COLOR": "1"}
        answer = CliRunner().invoke(app, [*command.split(), option], env=environment)
        assert answer.exit_code == 0
        return answer.stdout

    return run


@pytest.mark.parametrize("command", JOBS)
def test_help_fits_a_screen_and_names_every_option(helped, command):
    short, whole = (helped(command, option) for option in ("--help", "--help-all"))
    lines = short.splitlines()
    assert len(lines) <= ROWS
    assert max(map(len, lines)) <= COLUMNS
    options = {word.strip(",") for word in short.split() if word.startswith("--")}
    for word in whole.split():
        if word.startswith("--") and word not in ("--help", "--help-all", "--free", "--out:"):
            assert any(word.strip(",.:;") in option for option in options), word
    assert len(whole.splitlines()) > ROWS or command.startswith("surface")


def test_help_all_explains_what_help_only_names(helped):
    short, whole = (" ".join(helped("press", option).split()) for option in ("--help", "--help-all"))
    assert "Gaussian filter" not in short
    assert "Gaussian filter" in whole
    assert "--short-cutoff" in short


@pytest.mark.parametrize("command", ["study status", "serve"])
def test_a_command_with_few_options_explains_them_all(helped, command):
    assert helped(command, "--help") == helped(command, "--help-all")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("One. Two.", "One."),
        ("One (in brackets, such as this). Two.", "One."),
        ("Short: and clear.", "Short: and clear."),
        (f"Long: {'word ' * 20}.", "Long."),
        ("X3P, text, ...", "X3P, text, ..."),
        ("From 0.5 to 1; then more.", "From 0.5 to 1."),
    ],
)
def test_the_first_sentence_is_enough(text, said):
    assert _first_sentence(text) == said


def test_a_command_without_hidden_options_has_no_more():
    def command() -> None:
        """Do it."""

    assert grouped(command).more == frozenset()


def test_help_all_of_the_program_lists_every_command(helped):
    every = " ".join(helped("", "--help-all").split())
    for name in ("press", "study run", "adhesion loop", "surface info"):
        assert f"roughcontact {name} " in every
    assert "roughcontact press" not in helped("study", "--help-all")


@pytest.mark.parametrize("command", ["", "surface", "surface info", "study run", "doctor"])
def test_h_is_help(helped, command):
    assert helped(command, "-h") == helped(command, "--help")
