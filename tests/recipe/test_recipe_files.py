"""Recipes as files, and all that is wrong with one at once."""

import tomllib

import pytest

import roughcontact as rc
from roughcontact.errors import every
from roughcontact.recipe.written import carried, field_at, from_plain, read_job, to_plain, toml_of

BODIES = {"modulus": "110GPa"}
MADE = {"kind": "self-affine", "hurst": "0.8", "rms": "1um", "size": "1mm"}
TEXTS = ('quotes " and \\ and \t', "bell \x07, delete \x7f", "Sägezahn.x3p", "a'b", "two\nlines")


@pytest.mark.parametrize("name", TEXTS)
def test_a_job_that_is_written_reads_back_whatever_a_text_holds(tmp_path, name):
    plain = {
        "job": "surface",
        "source": {"kind": "python", "surface_sha256": "ab" * 32, "history": [name, "and"]},
    }
    job = from_plain(plain)
    (tmp_path / "job.toml").write_text(toml_of(carried(job, tmp_path)), encoding="utf-8")
    assert read_job(tmp_path / "job.toml") == job


def test_files_are_named_from_the_folder_of_the_job(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rc.write(rc.Surface([[0.0, 1e-6], [0.0, 0.0]], rc.Grid((2, 2), 1e-6)), "part.npz")
    (tmp_path / "jobs").mkdir()
    job = from_plain(
        {"job": "surface", "source": {"file": "part.npz"}, "preparation": {"mask": ["above=1um"]}}
    )
    (tmp_path / "jobs" / "job.toml").write_text(toml_of(carried(job, tmp_path / "jobs")), encoding="utf-8")
    written = tomllib.loads((tmp_path / "jobs" / "job.toml").read_text())
    assert written["source"]["file"] == "../part.npz"
    assert len(written["source"]["sha256"]) == 64
    assert written["preparation"]["mask"] == ["above=1um"]
    assert read_job(tmp_path / "jobs" / "job.toml").preparation == job.preparation


def test_all_mistakes_of_a_recipe_come_at_once():
    source = MADE | {"hurst": "9", "rms": "1N", "pints": 3}
    with pytest.raises(rc.InputError) as refused:
        from_plain(
            {"job": "curve", "source": source, "laods": {}, "preparation": {"share": "0.1", "tip": "1m"}}
        )
    assert {each.place for each in every(refused.value)} == {
        *("source.pints", "laods", "bodies", "preparation.share", "preparation.tip"),
    }
    with pytest.raises(rc.InputError) as refused:
        from_plain({"job": "curve", "source": MADE | {"hurst": "9", "rms": "1N"}, "bodies": BODIES})
    assert refused.value.place == "source.hurst, source.rms"
    assert "source.rms: '1N' is not a length" in refused.value.message


def test_a_field_is_known_by_its_dotted_name():
    plain = {"job": "curve", "source": MADE}
    assert field_at(plain, "source.hurst").read("0.8") == 0.8
    assert field_at(plain, "bodies.modulus").read("1 GPa") == 1e9
    for name, words in (
        ("source.hirst", "no field 'source.hirst': did you mean source.hurst"),
        ("source", "not a single value"),
    ):
        with pytest.raises(rc.InputError, match=words):
            field_at(plain, name)


def test_numbers_become_texts_and_whole_ones_stay_whole():
    plain = to_plain(from_plain({"job": "surface", "source": MADE | {"points": 16.0, "hurst": 0.1}}))
    assert (plain["source"]["points"], plain["source"]["hurst"]) == ("16", "0.1")
