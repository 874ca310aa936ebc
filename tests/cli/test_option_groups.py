"""Options that are declared once: in groups within groups, and as defaults of parameters."""

from dataclasses import dataclass
from typing import ClassVar

import pytest
import typer
from typer.testing import CliRunner

from roughcontact.cli.option_groups import argument, grouped, option


@dataclass(frozen=True, slots=True)
class Inner:
    PANEL: ClassVar = "How much"
    file: str = argument("A file.", "FILE")
    count: int = option("How many.", "N", default=..., min=1)


@dataclass(frozen=True, slots=True)
class Outer:
    inner: Inner
    short_name: str | None = option("A text.", "TEXT")
    flag: bool = option("A switch.", default=False)


LEVEL = option("A level.", default=3)


@pytest.fixture
def run():
    seen = []

    def command(outer: Outer, *, level: int = LEVEL) -> None:
        """Do it."""
        seen.append((outer, level))

    app = typer.Typer(add_completion=False)
    app.command()(grouped(command))
    return lambda *words: (CliRunner().invoke(app, words, env={"COLUMNS": "100", "TERM": "dumb"}), seen)


def test_groups_come_as_they_were_declared(run):
    answer, seen = run("a.txt", "--count", "2", "--short-name", "b", "--flag", "--level", "4")
    assert answer.exit_code == 0, answer.output
    assert seen == [(Outer(Inner("a.txt", 2), "b", True), 4)]


def test_what_is_left_out_has_its_default(run):
    _, seen = run("a.txt", "--count", "2")
    assert seen == [(Outer(Inner("a.txt", 2), None, False), 3)]


@pytest.mark.parametrize(
    ("words", "message"),
    [(("a.txt",), "'--count'"), (("--count", "1"), "FILE"), (("a.txt", "--count", "0"), "'--count'")],
)
def test_what_must_be_given_and_fit_is_said(run, words, message):
    answer, seen = run(*words)
    assert answer.exit_code == 2
    assert message in answer.output
    assert not seen


def test_help_has_the_panel_and_no_opposite_of_a_switch(run):
    text = run("--help")[0].output
    assert "How much" in text
    assert "Do it." in text
    assert "--no-flag" not in text
