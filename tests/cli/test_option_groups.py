"""Options that are declared once: as fields of a recipe, in groups within groups, and as defaults of parameters."""

from dataclasses import dataclass, field
from typing import ClassVar

import pytest
import typer
from typer.testing import CliRunner

import roughcontact as rc
from every_field import smallest
from pictures import without_fields
from roughcontact import viscoelastic
from roughcontact.cli.commands import do
from roughcontact.cli.option_groups import argument, grouped, option
from roughcontact.cli.options import Answer
from roughcontact.recipe.jobs import JOBS
from roughcontact.recipe.recipe_fields import check, described
from roughcontact.recipe.source import File, Source
from roughcontact.recipe.texts import Choice, Names, whole
from roughcontact.recipe.written import from_plain


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    TITLE: ClassVar = "A part"
    ONE_OF: ClassVar = ("length", "width")
    length: str | None = described("Its length.", "2", read=whole(1, "the length"), everyday=True)
    width: str | None = described("Its width, as long as it is: and more.", "3", everyday=True)
    kind_of: str = described("Which kind.", read=Choice(("round", "square")), default="round")
    holes: tuple[str, ...] = described("Holes; may be given again.", "1:2", default=())
    names: str | None = described("Whose.", "a,b", read=Names("name", ("ann", "bob")), needs="length")
    hidden: str | None = described("Not for a command.", "TEXT", option=False)

    def __post_init__(self):
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class PartJob:
    source: Source
    part: Part = field(default_factory=Part)


@pytest.fixture
def made():
    seen = []

    def command(job: PartJob) -> None:
        """Do a job."""
        seen.append(job)

    app = typer.Typer(add_completion=False)
    app.command()(grouped(command))
    return lambda *words: (CliRunner().invoke(app, words, env={"COLUMNS": "100", "TERM": "dumb"}), seen)


def test_fields_of_a_recipe_become_options(made):
    answer, seen = made(
        "a.txt", "--length", "5", "--holes", "1:2", "--holes=-3:4", "--kind-of", "square", "--free"
    )
    assert answer.exit_code == 0, answer.output
    part = Part(length="5", kind_of="square", holes=("1:2", "-3:4"))
    assert seen == [PartJob(source=File(file="a.txt", periodic=False), part=part)]
    assert made("a.txt", "--width", "1", "--periodic")[1][-1].source == File(file="a.txt", periodic=True)
    assert made("a.txt", "--width", "1")[1][-1].source.periodic is None


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("a.txt",), "Error: --length or --width is required: add one, such as --length 2"),
        (("a.txt", "--length", "x"), "Error: --length: the length must be a whole number from 1 up, not 'x'"),
        (
            ("a.txt", "--width", "1", "--names", "ann"),
            "Error: --names needs --length, which is not given",
        ),
        (
            ("a.txt", "--length", "1", "--kind-of", "squar"),
            "Error: --kind-of: 'squar' is not one of the choices; did you mean",
        ),
        (("a.txt", "--length", "1", "--size", "wide"), "Error: --size: 'wide' does not start with a number"),
        (("a.txt", "--length", "1", "--hidden", "x"), "--hidden"),
    ],
)
def test_a_field_that_makes_no_sense_is_named_as_its_option(made, words, message):
    answer, seen = made(*words)
    assert answer.exit_code == 2
    assert message in answer.output
    assert not seen


def test_help_of_a_field_is_what_the_recipe_says(made):
    text = made("--help")[0].output
    assert "A part" in text
    assert "[round|square]" in text
    assert "--hidden" not in text
    assert "--free" in text


@pytest.mark.parametrize("name", JOBS)
def test_each_kind_of_job_is_done_by_its_command(name, monkeypatch, tmp_path, rough, capsys):
    plain = (
        smallest(name)
        if name in ("theory", "infer")
        else {"job": name, "source": {"file": str(rough), "periodic": False}}
    )
    table = tmp_path / "joint.csv"
    table.write_text("pressure [MPa], stiffness [N/um/mm^2], error [%]\n7, 20, 5\n")
    if name == "creep":
        viscoelastic.standard_solid(1e9, 2e9, 1.0).write(tmp_path / "rubber.toml")
        plain["history"] = {"history": "0s:0nm,1s:1nm"}
        plain["bodies"] = {"material": str(tmp_path / "rubber.toml")}
    elif name != "surface":
        plain["bodies"] = {"modulus": "1GPa"}
    if name in ("press", "leak", "adhesion detach"):
        plain["load"] = {"depth": "10nm"}
    if name == "curve":
        plain["loads"] = {"depths": "10nm,20nm"}
    if name.startswith("adhesion"):
        plain["adhesion"] = {"work": "1mJ/m^2", **({} if name == "adhesion detach" else {"range": "100nm"})}
    if name == "shear":
        plain["bodies"] = {"materials": "steel,steel"}
    if name == "sliding":
        rubber = tmp_path / "rubber.toml"
        rc.viscoelastic.standard_solid(1e9, 2e9, 1e-6).write(rubber)
        plain["source"]["periodic"] = True
        plain["bodies"] = {"material": str(rubber)}
    plain |= {
        "leak": {"fluid": {"viscosity": "1mPa*s"}, "seal": {"drop": "1Pa"}},
        "shear": {"shear": {"pressures": "1GPa", "friction": "0.2"}},
        "sliding": {"sliding": {"pressure": "1MPa", "speeds": "1m/s"}},
        "joint": {"pressure": {"bolt_force": "1N", "head": "13mm", "hole": "9mm", "thickness": "1cm"}},
        "infer": {"source": {"file": str(table)}},
        "adhesion press": {"load": {"depth": "-2nm"}},
        "adhesion curve": {"loads": {"depths": "-2nm,2nm"}},
        "adhesion loop": {"turn": {"depth": "1nm", "points": "2"}},
    }.get(name, {})
    with without_fields():
        do(from_plain(plain), Answer(out=tmp_path / "out"))
    assert str(rough) in capsys.readouterr().out or list((tmp_path / "out").iterdir())
