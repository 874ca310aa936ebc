"""What a study says on the average, by command."""

import json
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray

from roughcontact.statistics import averages
from roughcontact.statistics.fit_window import force_window
from roughcontact.study import Store, export
from tables import read_table

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "study-files.md"
TEXT = """
name = "tried"
case = "curve"
seed = 3
samples = 3
parameters = { size = "1 mm", rms = "1 um", modulus = "110 GPa", loads = 8, lowest_force = 5e-3, points = 64 }
table = { hurst = [0.4, 1.6] }
"""
WINDOW = ("--window", "5e-3:0.07")


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Return the folder of a study that was run."""
    from typer.testing import CliRunner

    from roughcontact.cli.app import app

    folder = tmp_path_factory.mktemp("study")
    (folder / "tried.toml").write_text(TEXT)
    words = ["study", "run", folder / "tried.toml", "--out", folder / "tried", "--executor", "serial"]
    assert CliRunner().invoke(app, [str(word) for word in words]).exit_code == 0
    return folder / "tried"


@pytest.fixture(scope="module")
def averaged(study):
    with Store.open(study) as store:
        return averages(export(store), force_window(5e-3, 0.07), rng=np.random.default_rng(3))


def test_averages_are_written_as_netcdf_and_as_a_table(invoke, study, averaged, tmp_path):
    answer = invoke("study", "average", study, "--out", tmp_path / "a.nc", *WINDOW)
    assert answer.exit_code == 0, answer.stderr
    assert answer.stdout == f"file      {tmp_path / 'a.nc'}\ncontent   averages of 6 cases, 2 combinations\n"
    with xarray.open_dataset(tmp_path / "a.nc") as dataset:
        assert set(dataset.data_vars) == set(averaged.data_vars)
        np.testing.assert_array_equal(dataset["exponent"], averaged["exponent"])
        np.testing.assert_array_equal(dataset["stiffness_mean"], averaged["stiffness_mean"])
        assert dataset["stiffness_standard_error"].attrs["units"] == "N m-1"
        assert "history" in dataset.attrs
    told = json.loads(
        invoke("study", "average", study, "--out", tmp_path / "a.csv", *WINDOW, "--json").stdout
    )
    assert told["cases"] == 6
    table = read_table(tmp_path / "a.csv")
    assert len(table) == 2 * 8
    np.testing.assert_array_equal(table["stiffness_mean"], averaged["stiffness_mean"].to_numpy().ravel())
    np.testing.assert_array_equal(table["exponent"][::8], averaged["exponent"])


def test_a_table_has_a_line_for_each_combination(invoke, study, averaged):
    answer = invoke("study", "table", study, *WINDOW)
    assert answer.exit_code == 0
    header, *rows = answer.stdout.splitlines()
    assert header.split() == [
        "hurst",
        "samples",
        "exponent",
        "prefactor",
        "from",
        "F/(E*",
        "h",
        "L)",
        "to",
        "loads",
        "resolved",
    ]
    alpha, error = averaged["exponent"].to_numpy(), averaged["exponent_error"].to_numpy()
    for i, row in enumerate(rows):
        words = row.split()
        assert words[:2] == [("0.4", "1.6")[i], "3"]
        digits = len(words[4].partition(".")[2])
        assert words[2:5] == [f"{alpha[i]:.{digits}f}", "+-", f"{error[i]:.{digits}f}"]
        assert len(words[4].lstrip("0.")) == 2
        assert words[-2:] == ["8", "0"]


def test_means_can_be_asked_for_at_a_force(invoke, study, averaged):
    force = float(averaged["dimensionless_force"][3])
    words = ("--quantity", "stiffness,rms", "--at", force)
    told = json.loads(invoke("study", "table", study, *words, "--json").stdout)
    assert told["dimensionless_force"] == force
    assert told["units"] == {"stiffness": "N m-1", "rms": "m"}
    for i, row in enumerate(told["rows"]):
        assert row["parameters"] == {"hurst": (0.4, 1.6)[i]}
        assert row["samples"] == 3
        for word in ("mean", "standard_error"):
            # The force is one of the loads: nothing is interpolated.
            assert row["stiffness"][word] == averaged[f"stiffness_{word}"][i, 3]
        assert row["rms"]["mean"] == pytest.approx(1e-6, rel=1e-12)
    load, header, first, _ = invoke("study", "table", study, *words).stdout.splitlines()
    assert load == f"load   F/(E* h L) = {force:.4g}"
    assert header.split()[:5] == ["hurst", "samples", "resolved", "stiffness", "[MN/m]"]
    assert first.split()[3] == f"{averaged['stiffness_mean'][0, 3].item() * 1e-6:.2f}"


@pytest.mark.parametrize(("text", "name", "scale"), [("2MPa", "nominal_pressure", 1e6), ("2N", "force", 1.0)])
def test_means_can_be_asked_for_at_a_pressure_and_at_a_force(invoke, study, text, name, scale):
    """A side of 1 mm makes 1 MPa of 1 N; numbers follow straight lines between the logarithms of the loads."""
    told = json.loads(invoke("study", "table", study, "--at", text, "--json").stdout)
    assert told[name] == 2 * scale
    with Store.open(study) as store:
        dataset = export(store)
    assert dataset["nominal_pressure"].attrs["units"] == "Pa"
    np.testing.assert_allclose(dataset["nominal_pressure"], dataset["force"] / 1e-6, rtol=1e-15)
    for i, row in enumerate(told["rows"]):
        curves = dataset.isel(hurst=i)
        logs = [
            np.interp(np.log(2.0), np.log(curves["force"].to_numpy().ravel()[-8:]), np.log(each))
            for each in curves["stiffness"].to_numpy()
        ]
        assert row["stiffness"]["mean"] == pytest.approx(np.exp(logs).mean(), rel=1e-12)
        areal = row["interfacial_stiffness_per_area"]["mean"]
        assert 0.5 < areal / (row["stiffness"]["mean"] / 1e-6) < 2
    load, header, *_ = invoke("study", "table", study, "--at", text).stdout.splitlines()
    assert load.replace(" ", "") == f"load{text}"
    assert header.startswith(
        "hurst  samples  resolved  interfacial stiffness per area [N/µm/mm²]  stiffness [MN/m]"
    )


def test_it_counts_the_samples_whose_load_is_resolved(invoke, study, tmp_path):
    """On 64 x 64 cells no load is, at the end of the power law; pressed twenty times as hard, all are."""
    answer = invoke("study", "table", study, "--at", "2MPa")
    assert [row.split()[1:3] for row in answer.stdout.splitlines()[2:]] == [["3", "0"], ["3", "0"]]
    assert "all means contain loads that are not resolved" in answer.stderr
    (tmp_path / "hard.toml").write_text(TEXT.replace("loads = 8", "loads = 3, highest_force = 1.0"))
    invoke("study", "run", tmp_path / "hard.toml", "--out", tmp_path / "hard", "--executor", "serial")
    answer = invoke("study", "table", tmp_path / "hard", "--at", "1.0")
    assert [row.split()[1:3] for row in answer.stdout.splitlines()[2:]] == [["3", "3"], ["3", "3"]]
    assert "not resolved" not in answer.stderr
    rows = json.loads(invoke("study", "table", tmp_path / "hard", "--at", "1.0", "--json").stdout)["rows"]
    assert [row["resolved"] for row in rows] == [3, 3]


def test_a_table_counts_the_samples_behind_each_mean(invoke, study, monkeypatch):
    """The loads of one of three samples end below 2 N: its mean is that of the two others, and the table says so."""

    def shortened(store):
        dataset = export(store)
        force = (0 * dataset["stiffness"] + dataset["force"]).assign_attrs(dataset["force"].attrs)
        return dataset.assign(force=force.where(dataset["sample"] != 2, 0.01 * force))

    monkeypatch.setattr(sys.modules["roughcontact.study.export"], "export", shortened)
    answer = invoke("study", "table", study, "--at", "2N")
    assert [row.split()[1] for row in answer.stdout.splitlines()[2:]] == ["2", "2"]
    assert "the loads of some samples do not reach this load" in answer.stderr
    assert "do not reach" not in invoke("study", "table", study, "--at", "0.0002").stderr


def test_json_holds_the_laws(invoke, study, averaged):
    told = json.loads(invoke("study", "table", study, *WINDOW, "--json").stdout)
    assert told["window"] == "force from 0.005 to 0.07"
    law = told["rows"][1]["power_law"]
    assert law["exponent"] == averaged["exponent"][1]
    assert law["prefactor_high"] == averaged["prefactor_high"][1]
    assert law["law_count"] == 8


@pytest.mark.usefixtures("drawn")
def test_pictures_are_drawn(invoke, study, tmp_path):
    begins = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}
    for ending, words in (
        ("png", ()),
        ("pdf", ("--quantity", "contact_area")),
        ("svg", ("--quantity", "rms_slope")),
    ):
        out = tmp_path / f"picture.{ending}"
        answer = invoke("study", "plot", study, "--out", out, *words, *WINDOW)
        assert answer.exit_code == 0, answer.stderr
        assert out.read_bytes().startswith(begins[ending])
        assert f"quantity   {words[1] if words else 'dimensionless_stiffness'}" in answer.stdout
    told = json.loads(invoke("study", "plot", study, "--out", out, *WINDOW, "--json").stdout)
    assert told["quantity"] == "dimensionless_stiffness"


@pytest.mark.usefixtures("drawn")
def test_a_picture_at_one_load_is_of_the_stiffness_per_area(invoke, study, tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr("roughcontact.plot.canvas.save", lambda figure, out: drawn.append(figure))
    words = ("study", "plot", study, "--out", tmp_path / "a.png", "--at")
    answer = invoke(*words, "2MPa", "--json")
    told = json.loads(answer.stdout)
    assert (told["quantity"], told["nominal_pressure"]) == ("interfacial_stiffness_per_area", 2e6)
    assert "all means contain loads that are not resolved" in answer.stderr
    rows = json.loads(invoke("study", "table", study, "--at", "2MPa", "--json").stdout)["rows"]
    [axes] = drawn.pop().axes
    assert axes.get_title().endswith("at 2 MPa")
    assert axes.get_ylabel().endswith("[N/µm/mm²]")
    expected = [1e-12 * row["interfacial_stiffness_per_area"]["mean"] for row in rows]
    np.testing.assert_allclose(axes.containers[0].lines[0].get_ydata(), expected, rtol=1e-12)
    assert "quantity   contact_area" in invoke(*words, "0.01", "--quantity", "contact_area").stdout
    assert drawn.pop().axes[0].get_title().endswith("at F/(E* h L) = 0.01")


def test_a_run_says_what_it_computes_and_where_no_load_is_resolved(invoke, tmp_path):
    (tmp_path / "tried.toml").write_text(TEXT)
    hard = TEXT.replace("loads = 8", "loads = 3, highest_force = 1.0").replace("samples = 3", "samples = 1")
    (tmp_path / "hard.toml").write_text(hard)

    def told(name):
        words = (tmp_path / f"{name}.toml", "--out", tmp_path / name, "--executor", "serial")
        return invoke("study", "run", *words).stderr

    unresolved = "Note: no load is resolved: compute more points or larger loads"
    first = told("tried")
    assert "Note: computing 6 cases: 2 combinations, 3 samples of each; 1 worker\n" in first
    assert unresolved in first
    again = told("tried")  # nothing is left
    assert "computing" not in again
    assert unresolved in again
    resolved = told("hard")
    assert "Note: computing 2 cases: 2 combinations, 1 sample of each; 1 worker\n" in resolved
    assert unresolved not in resolved


def test_where_there_is_no_law_it_says_why(invoke, study):
    answer = invoke("study", "table", study)  # 64 x 64 cells resolve nothing of it
    assert answer.exit_code == 0
    assert [row.split()[2] for row in answer.stdout.splitlines()[1:]] == ["-", "-"]
    assert (
        "Note: no power law for hurst = 0.4; hurst = 1.6: fewer than 3 loads lie in the window"
        in answer.stderr
    )
    assert "choose another --window" in answer.stderr


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("average", "STUDY", "--out", "a.xlsx"), "--out: cannot write a.xlsx; give a file .nc"),
        (
            ("plot", "STUDY", "--out", "a.jpg"),
            "cannot write the picture a.jpg: end its name in png, pdf, svg",
        ),
        (("plot", "STUDY", "--out", "no/a.png"), "there is no folder"),
        (
            ("plot", "STUDY", "--out", "a.png", "--along", "points"),
            "'points' is not a number that varies; choose",
        ),
        (("table", "STUDY", "--window", "1"), "--window: '1' is not a window; write two forces"),
        (("table", "STUDY", "--window", "2:1"), "must be smaller than the second; exchange the two"),
        (("table", "STUDY", "--window", "a:1"), "--window: 'a' is not a number"),
        (
            ("table", "STUDY", "--at", "2"),
            "--at: the force over E* h L of the study goes from 0.005 to 0.07, and 2 is not between them; choose a "
            "load between them; a pressure or a force has a unit: 1MPa, 10N",
        ),
        (
            ("table", "STUDY", "--at", "1GPa"),
            "--at: the pressure of the study goes from 550 kPa to 7.7 MPa, and",
        ),
        (
            ("table", "STUDY", "--at", "5kg"),
            "--at: '5kg' is neither a pressure nor a force; write a pressure",
        ),
        (("plot", "STUDY", "--out", "a.png", "--at", "0"), "--at: '0' is not above 0; choose a load above 0"),
        (("table", "STUDY", "--at", "0"), "--at: '0' is not above 0; choose a load above 0"),
        (
            ("table", "STUDY", "--quantity", "stifness"),
            "--quantity: no 'stifness' differs between samples; did you mean 'stiffness'?",
        ),
        (
            ("table", "STUDY", "--quantity", "stiffness"),
            "stiffness depends on load; choose a load by --at, such as --at 1MPa",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(invoke, study, tmp_path, monkeypatch, words, message):
    monkeypatch.chdir(tmp_path)
    answer = invoke("study", *(study if word == "STUDY" else word for word in words))
    assert answer.exit_code == 2
    assert message in answer.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_study_without_results_is_refused(invoke, tmp_path):
    (tmp_path / "tried.toml").write_text(
        TEXT.replace("[0.4, 1.6]", "[0.4]").replace("64 }", "64, hardness = 1.0 }")
    )
    run = invoke("study", "run", tmp_path / "tried.toml", "--out", tmp_path / "tried", "--executor", "serial")
    assert "failed   3" in run.stdout
    answer = invoke("study", "table", tmp_path / "tried")
    assert answer.exit_code == 2
    assert "holds no results yet" in answer.stderr


def test_the_example_of_the_page_gives_numbers(invoke, tmp_path):
    """With two samples of three exponents: the window depends on the means, and these on the samples, hardly."""
    text = PAGE.read_text(encoding="utf-8").partition("```toml\n")[2].partition("```")[0]
    example = tomllib.loads(text)
    assert example["case"] == "curve"
    for count, fewer in ((f"samples = {example['samples']}", "samples = 2"), ("count = 6", "count = 3")):
        assert text.count(count) == 1
        text = text.replace(count, fewer)
    (tmp_path / "hurst.toml").write_text(text)
    words = (tmp_path / "hurst.toml", "--out", tmp_path / "hurst", "--executor", "serial")
    assert invoke("study", "run", *words).exit_code == 0
    answer = invoke("study", "table", tmp_path / "hurst", "--json")
    assert "no power law" not in answer.stderr
    rows = json.loads(answer.stdout)["rows"]
    assert [row["parameters"]["hurst"] for row in rows] == [0.0, 1.0, 2.0]
    assert all(row["power_law"]["law_count"] >= 3 and row["power_law"]["exponent"] > 0 for row in rows)
