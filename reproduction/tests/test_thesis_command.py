"""The verb ``thesis``."""

import importlib.metadata
import subprocess
import sys

import numpy as np
import pytest
import xarray

from roughcontact.study.study import Study
from roughcontact_thesis import ensembles
from roughcontact_thesis.figures import FIGURES


@pytest.fixture
def few(monkeypatch):
    """Make the ensemble of figure 37 one of two samples on few cells; return what it is asked for."""

    def study(scale):
        parameters = ensembles.sphere_study("small").parameters | {"points": 17, "loads": 5}
        return Study(name=f"few-{scale}", case="curve", samples=2, parameters=parameters)

    monkeypatch.setattr("roughcontact_thesis.fig37_stiffness_of_sphere.sphere_study", study)


def test_an_installed_package_adds_the_command():
    try:
        importlib.metadata.distribution("roughcontact-thesis")
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("roughcontact-thesis is not installed")
    command = [sys.executable, "-m", "roughcontact", "thesis", "list"]
    answer = subprocess.run(command, capture_output=True, encoding="utf-8", check=True, timeout=120)
    assert answer.stdout.split()[0] == next(iter(FIGURES))


def test_it_lists_its_figures(invoke):
    answer = invoke("thesis", "list")
    assert answer.exit_code == 0
    names = [line.split()[0] for line in answer.stdout.splitlines()]
    assert names == list(FIGURES)


def test_it_writes_a_figure_and_says_what_was_chosen(invoke, tmp_path):
    answer = invoke("thesis", "fig4", "--out", tmp_path / "figures", "--seed", "5")
    assert answer.exit_code == 0, answer.stderr
    path = tmp_path / "figures" / "fig4.png"
    assert path.read_bytes().startswith(b"\x89PNG")
    assert str(path) in answer.stdout
    assert "H = 0.8" in answer.stdout
    assert answer.stdout.rstrip().endswith("5")


@pytest.mark.parametrize(("ending", "first"), [("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_pictures_for_print(invoke, tmp_path, ending, first):
    answer = invoke("thesis", "fig15", "--out", tmp_path, "--format", ending)
    assert answer.exit_code == 0, answer.stderr
    assert (tmp_path / f"fig15.{ending}").read_bytes().startswith(first)
    assert [each.name for each in tmp_path.iterdir()] == [f"fig15.{ending}"]


def test_an_ensemble_leaves_picture_averages_and_a_store_that_goes_on(invoke, tmp_path, few):
    answer = invoke("thesis", "fig37", "--out", tmp_path, "--workers", "1")
    assert answer.exit_code == 0, answer.stderr
    assert (tmp_path / "fig37.png").read_bytes().startswith(b"\x89PNG")
    with xarray.open_dataset(tmp_path / "fig37.nc") as first:
        assert first.sizes["load"] == 5
        assert np.isfinite(first["stiffness"]).all()
        assert "history" in first.attrs
    assert (tmp_path / "studies" / "few-small" / "cases.sqlite").exists()
    assert "few-small: 2 of 2 cases, seed 0" in answer.stdout  # its own seed is 0
    assert "holds" in answer.stdout
    assert "here 7.997e-05 by eq. 5.10" in answer.stdout
    # Nothing is left to compute: the same again, and from the store alone.
    again = invoke("thesis", "fig37", "--out", tmp_path, "--workers", "1")
    as_is = invoke("thesis", "fig37", "--out", tmp_path, "--as-is")
    assert again.stdout == as_is.stdout == answer.stdout


@pytest.mark.parametrize(("end", "status"), [(KeyboardInterrupt(), 130), (SystemExit(143), 143)], ids=repr)
def test_stopped_it_says_how_to_go_on(invoke, tmp_path, few, monkeypatch, end, status):
    def stopped(*arguments):
        raise end

    monkeypatch.setattr("roughcontact_thesis.reproduce.run_study", stopped)
    answer = invoke("thesis", "fig37", "--out", tmp_path, "--workers", "1")
    assert answer.exit_code == status
    assert "very finished case is stored. To go on: roughcontact" in answer.stderr


def test_a_seed_and_a_scale_are_other_stores(invoke, tmp_path, few):
    for more in (("--seed", "3"), ("--scale", "thesis")):
        assert invoke("thesis", "fig37", "--out", tmp_path, "--workers", "1", *more).exit_code == 0
    assert sorted(each.name for each in (tmp_path / "studies").iterdir()) == [
        "few-small-seed-3",
        "few-thesis",
    ]


def test_all_figures_are_computed_one_after_the_other(invoke, tmp_path, few, monkeypatch):
    some = {name: FIGURES[name] for name in ("fig4", "fig37")}
    monkeypatch.setattr("roughcontact_thesis.figures.FIGURES", some)
    answer = invoke("thesis", "all", "--out", tmp_path, "--workers", "1")
    assert answer.exit_code == 0, answer.stderr
    assert {each.name for each in tmp_path.iterdir()} == {"fig4.png", "fig37.png", "fig37.nc", "studies"}


def test_what_failed_is_told(invoke, tmp_path, monkeypatch):
    def study(scale):
        parameters = ensembles.sphere_study("small").parameters | {"points": 17, "loads": 3}
        # A cut-off below the shortest wave leaves no wave: these cases fail when they are run.
        rows = ({}, {"long_cutoff": 1e-3})
        return Study(name="some", case="curve", samples=1, parameters=parameters, rows=rows)

    monkeypatch.setattr("roughcontact_thesis.fig37_stiffness_of_sphere.sphere_study", study)
    monkeypatch.setattr(
        "roughcontact_thesis.fig37_stiffness_of_sphere.averages", lambda data: data.isel(row=0)
    )
    monkeypatch.setattr("roughcontact_thesis.fig37_stiffness_of_sphere.draw", lambda figure, data: None)
    monkeypatch.delattr("roughcontact_thesis.fig37_stiffness_of_sphere.verdicts")
    answer = invoke("thesis", "fig37", "--out", tmp_path, "--workers", "1")
    assert answer.exit_code == 0, answer.stderr
    assert "1 case of some failed" in answer.stderr


def test_ctrl_c_says_how_to_go_on(invoke, tmp_path, few, monkeypatch):
    def interrupted(*_: object):
        raise KeyboardInterrupt

    monkeypatch.setattr("roughcontact_thesis.reproduce.run_study", interrupted)
    answer = invoke("thesis", "fig37", "--out", tmp_path, "--workers", "1")
    assert answer.exit_code == 130
    assert "every finished case is stored. To go on: roughcontact" in answer.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("fig99",), "no figure 'fig99'"),
        (("fig4", "--seed", "x"), "the seed must be a whole number from 0 up"),
        (("fig37", "--scale", "big"), "choose from small, thesis"),
        (("fig37", "--as-is"), "was not run in"),
    ],
)
def test_it_refuses_what_makes_no_sense(invoke, tmp_path, arguments, words):
    answer = invoke("thesis", *arguments, "--out", tmp_path / "new")
    assert answer.exit_code == 2
    assert words in answer.stderr
    assert not (tmp_path / "new").exists()
