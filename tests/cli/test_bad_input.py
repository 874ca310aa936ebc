"""Whatever is wrong with what the user gives: one line that says so, status 2, and nothing on disk."""

import numpy as np
import pytest

import roughcontact as rc

PRESS = ("press", "FILE", "--force", "1mN", "--modulus", "1GPa")
CURVE = ("curve", "FILE", "--forces", "1mN,2mN", "--modulus", "1GPa")
INFO = ("surface", "info", "FILE")
SIZED = ("--unit", "um", "--size", "1mm")


def x3p(folder):
    """Return the bytes of a file that is no X3P from its first half on."""
    path = folder / "whole.npz"
    np.savez(path, heights=np.random.default_rng(1).random((64, 64)), spacing=1e-6, unit="um")
    content = path.read_bytes()
    path.unlink()
    return content[: len(content) // 2]


def heights(change):
    values = np.random.default_rng(1).random((8, 8))
    change(values)
    return values


def text(rows):
    return "\n".join(" ".join(row) for row in rows).encode()


def spoil(values, where, by):
    values[where] = by


def saved(values):
    def content(folder):
        path = folder / "whole.npz"
        np.savez(path, heights=values, spacing=1e-6, unit="um")
        data = path.read_bytes()
        path.unlink()
        return data

    return content


GOOD = heights(lambda values: None)
ROWS = [[f"{value:.6f}" for value in row] for row in GOOD]
FILES = {
    "missing": ("part.npz", None, "cannot be opened"),
    "folder": (".", None, "it is a folder; name a file in it"),
    "empty npz": ("part.npz", lambda _: b"", "empty"),
    "empty npy": ("part.npy", lambda _: b"", "empty"),
    "empty text": ("part.txt", lambda _: b"", "empty"),
    "empty csv": ("part.csv", lambda _: b"", "empty"),
    "empty x3p": ("part.x3p", lambda _: b"", "empty"),
    "empty of another kind": ("part.sur", lambda _: b"", "empty"),
    "truncated npz": ("part.npz", x3p, "cut short"),
    "truncated x3p": ("part.x3p", x3p, "cut short"),
    "text with a hole": ("part.txt", lambda _: text([*ROWS[:3], ROWS[3][:-2], *ROWS[4:]]), "row"),
    "text with words": ("part.txt", lambda _: text([*ROWS[:3], ["what"] * 8, *ROWS[4:]]), "row"),
    "all NaN": ("part.npz", saved(np.full((8, 8), np.nan)), "NaN"),
    "one row": ("part.npz", saved(np.ones((1, 8))), "1 x 8"),
    "infinite heights": ("part.npz", saved(heights(lambda v: spoil(v, (2, 3), np.inf))), "infinite"),
    "no numbers": ("part.npz", saved(np.full((8, 8), "word")), ""),
}


def refused(answer, complaint):
    assert answer.exit_code == 2, answer.stderr
    assert isinstance(answer.exception, SystemExit)
    errors = [line for line in answer.stderr.splitlines() if not line.startswith("Note: ")]
    assert len(errors) == 1
    assert errors[0].startswith("Error: ")
    assert complaint in errors[0]


@pytest.mark.parametrize("words", [PRESS, CURVE, INFO], ids=["press", "curve", "info"])
@pytest.mark.parametrize("case", FILES)
def test_a_bad_file(invoke, tmp_path, case, words):
    name, content, complaint = FILES[case]
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content(tmp_path))
    before = sorted(tmp_path.iterdir())
    sized = SIZED if path.suffix in (".txt", ".csv", ".npy") else ()
    out = () if words is INFO else ("--out", tmp_path / "new" / "out")
    answer = invoke(*(path if word == "FILE" else word for word in words), *sized, *out)
    refused(answer, complaint)
    assert answer.stdout == "" or words is INFO
    assert sorted(tmp_path.iterdir()) == before


LOADS = {"--force": "1mN", "--modulus": "1GPa"}


def changed(**options):
    """Return the good options with some others instead; None takes one out."""
    named = LOADS | {f"--{name}": value for name, value in options.items()}
    return [word for name, value in named.items() if value is not None for word in (name, value)]


PRESS_OPTIONS = {
    "negative force": (changed(force="-1N"), "--force: the force must be positive"),
    "zero force": (changed(force="0N"), "the force must be positive"),
    "force in kilograms": (
        changed(force="1kg"),
        "--force: '1kg' is not a force; write a force such as 10N",
    ),
    "no number": (changed(force="much"), "--force: 'much' does not start with a number"),
    "negative depth": (changed(force=None, depth="-1um"), "--depth: the depth is measured from first touch"),
    "zero pressure": (changed(force=None, pressure="0"), "the pressure must be positive"),
    "no load": (
        changed(force=None),
        "--force, --pressure or --depth is required: add one, such as --force 10N",
    ),
    "two loads": (changed(depth="1um"), "--force and --depth exclude each other"),
    "zero modulus": (changed(modulus="0GPa"), "modulus must be positive"),
    "negative modulus": (changed(modulus="-1GPa"), "modulus must be positive"),
    "no modulus": (changed(modulus=None), "--modulus, --materials or --young is required"),
    "two moduli": (changed(young="1GPa", poisson="0.3"), "exclude each other"),
    "half a body": (
        changed(modulus=None, young="1GPa"),
        "--poisson: --young is given without --poisson; give --poisson",
    ),
    "half of the other body": (
        changed(modulus=None, young="1GPa", poisson="0.3", young2="1GPa"),
        "--poisson2: --young2 is given without --poisson2; give --poisson2",
    ),
    "too many bodies": (changed(young2="1GPa"), "--young2 needs --young"),
    "zero Young's modulus": (
        changed(modulus=None, young="0", poisson="0.3"),
        "--young: Young's modulus must be positive",
    ),
    "Poisson's ratio": (
        changed(modulus=None, young="1GPa", poisson="0.7"),
        "--poisson: Poisson's ratio must lie between",
    ),
    "decimal comma": (
        changed(modulus=None, young="1GPa", poisson="0,3"),
        "--poisson: '0,3' holds a comma; write the decimal point as '.'",
    ),
    "Poisson's ratio in words": (changed(modulus=None, young="1GPa", poisson="third"), "not a number"),
    "a force beyond measure": (changed(force="1e300N"), "--force: '1e300N' is out of range"),
    "a size beyond measure": (changed(size="1e-300m"), "--size: '1e-300m' is out of range"),
    "size of zero": (changed(size="0mm"), "--size: a side length must be positive"),
    "unit that is none": (changed(unit="second"), "unit 'second' is not a known unit of length"),
    "unknown channel": (changed(channel="colour"), "no channel 'colour'"),
    "loose tolerance": (changed(tolerance="1"), "--tolerance: the tolerance must lie between"),
    "tight tolerance": (changed(tolerance="0"), "the tolerance must lie between"),
    "no tolerance": (changed(tolerance="small"), "--tolerance: 'small' is not a number"),
}


@pytest.mark.parametrize("case", PRESS_OPTIONS)
def test_a_bad_option_of_press(invoke, rough, tmp_path, case):
    options, complaint = PRESS_OPTIONS[case]
    answer = invoke("press", rough, *options, "--out", tmp_path / "out")
    refused(answer, complaint)
    assert answer.stdout == ""
    assert not (tmp_path / "out").exists()


CURVE_OPTIONS = {
    "no load": (("--forces", ""), "holds no load"),
    "empty list": (("--forces", ", ,"), "holds no load"),
    "falling loads": (("--forces", "2N,1N"), "must increase"),
    "equal loads": (("--forces", "1N,1N"), "must increase"),
    "a load of zero": (("--forces", "0,1N"), "must be positive"),
    "negative depths": (("--depths", "-1um,1um"), "must be positive"),
    "a range of nothing": (("--forces", "1N:2N:0"), "from 2 to"),
    "two kinds": (("--forces", "1N,2N", "--depths", "1um,2um"), "exclude each other"),
    "full contact": (("--depths", "1um,1m", "--periodic"), "exceeds the mean separation"),
}


@pytest.mark.parametrize("case", CURVE_OPTIONS)
def test_a_bad_option_of_curve(invoke, rough, tmp_path, case):
    options, complaint = CURVE_OPTIONS[case]
    answer = invoke("curve", rough, *options, "--modulus", "1GPa", "--out", tmp_path / "out")
    refused(answer, complaint)
    assert answer.stdout == ""
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("words", [PRESS, CURVE], ids=["press", "curve"])
@pytest.mark.parametrize("place", ["", "inside"])
def test_an_output_folder_with_a_file_in_its_place(invoke, rough, tmp_path, words, place):
    (tmp_path / "taken").write_text("mine")
    answer = invoke(
        *(rough if word == "FILE" else word for word in words), "--out", tmp_path / "taken" / place
    )
    refused(answer, "is a file")
    assert (tmp_path / "taken").read_text() == "mine"
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize(
    "options",
    [
        changed(force="-1N"),
        changed(tolerance="1"),
        changed(modulus="0GPa"),
        changed(modulus=None, young="1GPa", poisson="1"),
    ],
)
def test_what_needs_no_file_is_checked_before_it_is_read(invoke, tmp_path, options):
    answer = invoke("press", tmp_path / "missing.npz", *options)
    assert answer.exit_code == 2
    assert answer.stderr.startswith("Error: --")


def test_paths_are_shown_as_they_were_typed(invoke, rough, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").write_text("mine")
    words = ["press", "./rough.npz", *changed()]
    assert (
        invoke(*words, "--out", "./taken")
        .stderr.splitlines()[-1]
        .startswith("Error: cannot use taken as a folder")
    )
    words[1] = "sub/missing.npz"
    assert invoke(*words).stderr.startswith("Error: sub/missing.npz: it cannot be opened")
    assert invoke("surface", "info", "sub/missing.npz").stderr.startswith("Error: sub/missing.npz: ")


def test_what_overrides_the_file_is_spoken(invoke, rough):
    answer = invoke("press", rough, *changed(size="1mm", unit="um"))
    assert answer.exit_code == 0
    assert "unit of the heights um as given, instead of the file's m" in answer.stderr
    assert "instead of the file's 4.8e-05 x 3.2e-05" in answer.stderr


def test_a_mistake_of_ours_shows_itself(invoke, rough, monkeypatch):
    def mistake(*_, **__):
        raise ValueError("operands could not be broadcast together")

    monkeypatch.setattr(rc, "press", mistake)
    answer = invoke(*(rough if word == "FILE" else word for word in PRESS))
    assert isinstance(answer.exception, ValueError)
    assert answer.exit_code == 1
