"""The option ``--cite``: references after an answer, and beside its files."""

import json

import pytest

from pictures import without_fields
from roughcontact import viscoelastic
from roughcontact.citing.bibliography import references

MODULUS = ("--modulus", "1GPa")
LINES = {
    "press": ("--force", "1mN", *MODULUS),
    "curve": ("--forces", "0.1mN,1mN", *MODULUS, "--hardness", "1GPa", "--theory", "gw"),
    "leak": ("--force", "0.1N", *MODULUS, "--viscosity", "1mPa*s", "--drop", "1kPa"),
    "shear": ("--materials", "steel,steel", "--pressures", "1GPa", "--friction", "0.2"),
    "creep": ("--history", "0s:0nm,1s:1nm", "--steps", "2", "--material", "rubber.toml"),
    "adhesion press": ("--depth", "1nm", *MODULUS, "--work", "1mJ/m^2", "--range", "0.1um"),
    "adhesion curve": ("--depths", "1nm,2nm", *MODULUS, "--work", "1mJ/m^2", "--range", "0.1um"),
    "adhesion detach": ("--force", "1mN", *MODULUS, "--work", "1mJ/m^2"),
    "sliding": ("--periodic", "--pressure", "1MPa", "--speeds", "1m/s", "--material", "rubber.toml"),
    "joint": (
        *("--bolt-force", "10N", "--head", "13mm", "--hole", "9mm", "--thickness", "2mm"),
        *("--young", "1GPa", "--poisson", "0.3", "--friction", "0.2"),
    ),
    "surface spectrum": (),
    "surface measurements": (),
    "surface info": (),
}
PAPERS = {
    "press": "Love1929",
    "curve": "Greenwood1966",
    "leak": "Love1929",
    "shear": "Ciavarella1998",
    "creep": "Love1929",
    "adhesion press": "Rey2017",
    "adhesion curve": "Rey2017",
    "adhesion detach": "Pohrt2015",
    "sliding": "Persson2001",
    "joint": "Rotscher1927",
    "surface spectrum": "Pohrt2013",
    "surface measurements": "roughcontact",
    "surface info": "roughcontact",
}


def text_of(key):
    return next(str(each) for each in references() if each.key == key)


@pytest.mark.parametrize("command", LINES)
def test_references_follow_the_answer(command, invoke, rough, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    viscoelastic.standard_solid(1e9, 2e9, 1.0).write("rubber.toml")
    out = tmp_path / "out"
    with without_fields():
        answer = invoke(*command.split(), rough, *LINES[command], "--cite", "--out", out)
    assert answer.exit_code == 0, answer.stderr
    before, _, cited = answer.stdout.partition("\nTo cite:\n")
    assert before
    assert text_of(PAPERS[command]) in cited
    assert f"{{{PAPERS[command]}," in (out / "references.bib").read_text(encoding="utf-8")
    assert "references.bib" in answer.stderr


def test_a_theory_and_a_conductance(invoke, rough, tmp_path):
    joint = ("--sigma", "1um", "--slope", "0.1", *MODULUS, "--pressures", "1MPa", "--theory", "mikic")
    answer = invoke("theory", *joint, "--cite", "--out", tmp_path / "theory")
    assert text_of("Mikic1974") in answer.stdout
    assert "theory.csv, theory.json, references.bib and theory.nc are in" in answer.stderr
    invoke("curve", rough, *LINES["curve"], "--out", tmp_path / "curve")
    answer = invoke("conductance", tmp_path / "curve", "--resistivity", "17nohm*m", "--cite")
    assert text_of("Barber2003") in answer.stdout


def test_json_stays_json_and_nothing_is_cited_unasked(invoke, rough):
    answer = invoke("press", rough, *LINES["press"], "--json", "--cite")
    assert json.loads(answer.stdout)["command"] == "press"
    assert text_of("Love1929") in answer.stderr
    answer = invoke("press", rough, *LINES["press"])
    assert "To cite" not in answer.stdout + answer.stderr


def test_a_job_that_is_run_is_cited_also_where_its_answer_is_stored(invoke, rough, tmp_path):
    job, out = tmp_path / "job.toml", tmp_path / "out"
    job.write_text(invoke("press", rough, *LINES["press"], "--print", "toml").stdout, encoding="utf-8")
    answers = [invoke("run", job, "--out", out, "--cite") for _ in range(2)]
    assert [answer.exit_code for answer in answers] == [0, 0]
    assert "nothing is computed" in answers[1].stderr
    for answer in answers:
        assert text_of("Love1929") in answer.stdout
    again = invoke("run", out / "press.json", "--cite")
    assert text_of("Love1929") in again.stdout
    assert "same numbers" in again.stderr
