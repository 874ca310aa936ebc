"""The page about the thesis' figures says what the exported averages say."""

import csv
import importlib.util
import re
import shutil
import sys
import tomllib
from pathlib import Path

import pytest
import xarray

from roughcontact.study.study import Study
from roughcontact_thesis.figures import FIGURES, is_ensemble, module, verdicts

HOME = Path(__file__).parent.parent
FOLDER = HOME / "data"
PAGES = HOME.parent / "docs" / "evidence"
ENSEMBLES = [name for name in FIGURES if is_ensemble(module(name))]
SIMPLE = [name for name in FIGURES if name not in ENSEMBLES]


@pytest.fixture(scope="module")
def script():
    """Return the script that writes the page, as a module."""
    sys.path.insert(0, str(HOME / "benchmarks"))  # it takes the words of the script beside it
    spec = importlib.util.spec_from_file_location("pages", HOME / "benchmarks" / "pages.py")
    found = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = found  # where data classes look for it
    spec.loader.exec_module(found)
    yield found
    for name in [*sys.modules]:
        if name.startswith("law_") or name in (spec.name, "claim_pages", "page_texts"):
            del sys.modules[name]
    sys.path.remove(str(HOME / "benchmarks"))


@pytest.fixture(scope="module")
def page():
    """Return the first page: findings and a dozen claims."""
    return (PAGES / "reproduction.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def figures():
    """Return the page of the figures."""
    return (PAGES / "reproduction-figures.md").read_text(encoding="utf-8")


@pytest.fixture
def bare(tmp_path):
    """Return a folder without averages."""
    for name in ("captions.toml", "simple.json", "unjudged.toml"):
        shutil.copy(FOLDER / name, tmp_path)
    return tmp_path


def section(page, name):
    """Return the lines of the section of a figure."""
    return page.split(f"\n## {heading(name)}\n")[1].split("\n## ")[0]


def heading(name):
    return f"Figure {name[3:]}" if name.startswith("fig") else f"Outlook, {name.removeprefix('outlook-')}"


@pytest.mark.slow
def test_the_pages_are_what_the_script_writes(script, page, figures):
    assert script.page() == page
    assert script.figures_page() == figures
    data = script.claims()
    assert script.CLAIMS.read_text(encoding="utf-8") == data
    assert script.claims_page() == script.CLAIMS_PAGE.read_text(encoding="utf-8")
    assert script.changes() == script.CHANGES.read_text(encoding="utf-8")


def test_the_page_begins_with_its_findings(script, page):
    findings = page.split("## What is found\n")[1].split("\n## ")[0]
    assert re.findall(r"^(\d)\. ", findings, re.M) == list("12345")
    assert findings.count("![") == 1
    assert page.index("## What is found") < page.index("## A dozen claims")
    assert len(page.splitlines()) <= 200


def test_the_first_page_has_a_dozen_claims_that_all_have_a_row(script, page):
    rows = page.split("## A dozen claims\n")[1].split("\n## ")[0]
    assert rows.count("](reproduction-figures.md#") == len(script.claim_pages.DOZEN) == 12
    named = [each.claim for entry in script.entries(FOLDER) for each in entry.verdicts]
    assert all(named.count(claim) == 1 for claim in script.claim_pages.DOZEN)


def test_a_row_has_a_verdict_for_each_range_that_is_computed(script):
    with script.CLAIMS.open(encoding="utf-8") as file:
        rows = {row["claim"]: row for row in csv.DictReader(file)}
    lines = rows["alpha = 1/(H + 1) for lines"]
    assert lines["H 0.25 to 1.75"].startswith("holds: ")
    assert lines["H above 2"].startswith("does not hold: ")
    assert rows["the rms height of a surface grows as lambda^H with its size"]["H 0.25 to 1.75"] == ""
    assert {row["kind"] for row in rows.values()} == set(script.claim_pages._KINDS)


def test_every_claim_is_quoted_and_says_what_decided(script):
    every = [(each.name, verdict) for each in script.entries(FOLDER) for verdict in each.verdicts]
    claims = [(name, verdict.claim) for name, verdict in every]
    assert len(set(claims)) == len(claims)
    for _, verdict in every:
        assert verdict.quote
        assert verdict.source
        assert verdict.ruling.tolerance or verdict.kind == "answer"
        if verdict.kind == "claim":
            assert verdict.ruling.trigger


def test_every_change_of_a_verdict_is_explained(script):
    now = {
        (each.name, verdict.claim): verdict for each in script.entries(FOLDER) for verdict in each.verdicts
    }
    former = tomllib.loads((FOLDER / "former.toml").read_text(encoding="utf-8"))["row"]
    assert len(former) == 107
    for row in former:
        found = [now[row.get("judged", row["figure"]), claim] for claim in row["now"]]
        words = {verdict.ruling.word for verdict in found}
        before = row["word"].replace("open", "not decided")
        assert row["why"] or words == {before}, row["claim"]


def test_every_change_since_the_first_edition_has_a_reason(script):
    now = {
        (each.name, one.claim): (one.word, one.kind)
        for each in script.entries(FOLDER)
        for one in each.verdicts
    }
    with (FOLDER / "first-edition.csv").open(encoding="utf-8") as file:
        first = {(row["figure"], row["claim"]): (row["verdict"], row["kind"]) for row in csv.DictReader(file)}
    changed = tomllib.loads((FOLDER / "changed.toml").read_text(encoding="utf-8"))["row"]
    named = {(row["figure"], claim) for row in changed for claim in (*row["before"], *row["now"])}
    assert named == {each for each in now | first if now.get(each) != first.get(each)}
    assert all(row["why"] for row in changed)


def test_every_figure_of_the_thesis_has_a_section_or_a_reason(script):
    told = tomllib.loads((FOLDER / "unjudged.toml").read_text(encoding="utf-8"))["figures"]
    without = [int(number) for each in told for number in each["figure"].split(", ")]
    drawn = [int(name[3:]) for name in FIGURES if name.startswith("fig")]
    assert sorted(without + drawn) == list(range(1, 49))


def test_every_figure_has_a_section_with_its_picture(figures):
    assert re.findall(r"^## ((?:Figure|Outlook,) .+)$", figures, re.M) == [heading(name) for name in FIGURES]
    for name in FIGURES:
        told = section(figures, name)
        assert ("**Missing:**" in told) != (f"(../../reproduction/pictures/{name}.png)" in told)


def test_what_was_not_computed_is_said_to_be_missing(script, bare):
    written = script.figures_page(bare)
    for name in FIGURES:
        assert ("**Missing:**" in section(written, name)) == (name in ENSEMBLES)
    [told] = re.findall(r"^\*\*Missing\*\*, not computed yet: figures (.*)\.$", script.page(bare), re.M)
    assert told.split(", ") == [heading(name).split()[-1] for name in ENSEMBLES]


def test_a_scale_is_that_of_the_studies_and_not_of_fewer_samples(script):
    found = module("fig37")
    for scale in ("small", "thesis"):
        [study] = found.studies(scale)
        assert script.scale_of(found, (study,)) == scale
        assert script.scale_of(found, (study.with_samples(study.samples + 1),)) == scale
        assert script.scale_of(found, (study.with_samples(study.samples - 1),)) == "other"
        other = Study(**(dict(study) | {"seed": study.seed + 1}))
        assert script.scale_of(found, (other,)) == "other"


def test_averages_are_taken_over_with_what_they_are_and_without_a_place(script, bare, tmp_path, monkeypatch):
    [study] = module("fig37").studies("small")
    monkeypatch.setattr("roughcontact_thesis.fig37_stiffness_of_sphere.verdicts", lambda data: ())
    monkeypatch.setattr("roughcontact_thesis.fig37_stiffness_of_sphere.findings", lambda data: "")
    attrs = {"studies": [study.to_toml()], "history": "now: roughcontact thesis fig37 --out /some/where"}
    counts = {"cases_done": [17], "cases_failed": [1], "cases_missing": [2], "cases_seconds": [1e4]}
    source = tmp_path / "averages"
    source.mkdir()
    averages = xarray.Dataset({"force": ("load", [1.0, 2.0])}, attrs=attrs | counts)
    averages.to_netcdf(source / "fig37.nc", engine="h5netcdf")
    script.collect(source, bare)
    kept = script.read(bare / "fig37.nc")
    assert "/some" not in str(kept.attrs)
    assert script.studies_of(kept) == (study,)
    text = section(script.figures_page(bare), "fig37")
    assert "**On the small scale**" in text
    assert "20 samples, case `curve`, seed 1; " in text
    assert "**17 of 20 cases: 1 failed, 2 missing**, 2.8 hours of computing in total" in text
    assert "`roughcontact thesis fig37 --scale small --out DIR`" in text
    assert "Cases failed or are missing: figure 37." in script.page(bare)


def test_averages_that_do_not_say_what_they_are_are_refused(script, bare, tmp_path):
    source = tmp_path / "averages"
    source.mkdir()
    xarray.Dataset({"force": ("load", [1.0, 2.0])}).to_netcdf(source / "fig37.nc", engine="h5netcdf")
    with pytest.raises(SystemExit, match="--as-is"):
        script.collect(source, bare)


def test_figures_without_an_ensemble_are_those_that_are_kept(script):
    kept = script.read_simple(FOLDER)
    assert list(kept) == SIMPLE
    assert {name: each["seed"] for name, each in kept.items()} == {name: module(name).SEED for name in SIMPLE}


@pytest.mark.parametrize(
    "name", ["fig3", "fig13", "fig15", "fig19", "fig36", "fig43", "fig45", "fig46", "fig47"]
)
def test_what_is_kept_of_a_quick_figure_is_what_it_finds(script, name):
    # What is found may end in a rounding error, which is another on another machine.
    found, kept = module(name), script.read_simple(FOLDER)[name]["verdicts"]
    now = [(each.claim, each.quote, each.ruling.word) for each in verdicts(found, found.case(found.SEED))]
    assert now == [(each["claim"], each["quote"], each["ruling"]["word"]) for each in kept]
