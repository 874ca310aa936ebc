"""The command ``run``: jobs from files, results that are repeated, and loads that are kept."""

import json
import shutil
import signal
from pathlib import Path

import pytest
from typer.testing import CliRunner

from roughcontact.cli.app import app

RUNNER = CliRunner()
JOB = """
format = 1
job = "curve"
[source]
kind = "self-affine"
hurst = "0.8"
rms = "1um"
size = "1mm"
points = "32"
[bodies]
modulus = "110GPa"
[loads]
forces = "100N:1kN:{count}"
"""


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def written(text=JOB, count=4):
    Path("job.toml").write_text(text.format(count=count), encoding="utf-8")


def ran(*words, status=0):
    result = RUNNER.invoke(app, ["run", *map(str, words)])
    assert result.exit_code == status, result.output
    return result


def record(name="job/curve.json"):
    return json.loads(Path(name).read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def answered(tmp_path_factory):
    """A folder with the job and its answer."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("answered"))
        written()
        ran("job.toml")
        return Path.cwd()


@pytest.fixture
def kept(answered):
    """Lay a copy of the job and its answer into the folder of a test."""
    shutil.copytree(answered, Path(), dirs_exist_ok=True)


@pytest.mark.usefixtures("kept")
def test_an_answer_carries_its_recipe_and_is_repeated():
    recipe = record()["recipe"]
    assert recipe["job"] == "curve"
    assert recipe["loads"] == {"forces": "100N:1kN:4"}
    for result in ("job/curve.json", "job/curve.nc"):
        again = ran(result)
        assert "Note: same numbers" in again.stderr
        assert "are in" not in again.stderr
    assert sorted(path.name for path in Path().iterdir()) == ["job", "job.toml"]


@pytest.mark.usefixtures("kept")
def test_a_number_that_differs_is_named():
    changed = record()
    changed["depth"][2] *= 1 + 1e-6
    changed["spots"] = changed["spots"][:2]
    Path("job/curve.json").write_text(json.dumps(changed), encoding="utf-8")
    told = ran("job/curve.json", status=1).stderr
    assert "Note: 2 quantities differ:" in told
    assert "Note: depth: 1 of 4 differ, by at most" in told
    assert "Note: spots: 2 numbers before, 4 now" in told


def test_loads_that_are_stored_are_kept(monkeypatch):
    written(count=3)
    ran("job.toml")
    before = record()
    written(count=5)  # of which three are those of before
    told = ran("job.toml").stderr
    assert "3 of 5 loads of the same recipe are in job already" in told
    after = record()
    assert after["depth"][::2] == before["depth"]
    assert after["depth"] == sorted(after["depth"])
    assert len(after["depth"]) == 5
    whole = ran("job.toml").stderr
    assert "5 of 5 loads of the same recipe are in job already" in whole
    assert record()["depth"] == after["depth"]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('modulus = "110GPa"', 'modulus = "120GPa"'),
        ('rms = "1um"', 'rms = "2um"'),
        ("[loads]", '[contact]\ntolerance = "1e-9"\n[loads]'),
        ("[loads]", '[plastic]\nhardness = "20GPa"\n[loads]'),
        ("[loads]", "[errors]\nerrors = true\n[loads]"),
        ("forces", "pressures"),
    ],
)
@pytest.mark.usefixtures("kept")
def test_of_another_contact_nothing_is_kept(old, new):
    text = JOB.replace(old, new)
    written(text.replace("100N:1kN", "100MPa:1GPa") if new == "pressures" else text)
    assert "are kept" not in ran("job.toml").stderr


@pytest.mark.usefixtures("kept")
def test_of_the_same_contact_all_is_kept():
    assert "4 of 4 loads of the same recipe are in job already" in ran("job.toml").stderr


@pytest.mark.usefixtures("kept")
def test_a_damaged_answer_is_replaced():
    before = record()
    Path("job/curve.nc").write_bytes(b"damaged")
    assert "are kept" not in ran("job.toml").stderr
    assert record()["depth"] == before["depth"]
    other = record()
    other["provenance"]["source"] = "roughcontact 0.0"
    Path("job/curve.json").write_text(json.dumps(other), encoding="utf-8")
    assert "are kept" not in ran("job.toml").stderr


def test_one_load_that_is_stored_is_not_pressed_again():
    text = (
        JOB.replace('"curve"', '"press"')
        .replace("[loads]\nforces", "[load]\nforce")
        .replace("100N:1kN:{count}", "100N")
    )
    written(text)
    ran("job.toml")
    told = ran("job.toml", "--json")
    assert "job already holds the answer of this job" in told.stderr
    assert json.loads(told.stdout) == record("job/press.json")
    assert "same numbers" in ran("job/press.json").stderr
    written(text.replace("100N", "200N"))
    assert "already" not in ran("job.toml").stderr


def test_what_is_no_job_is_refused():
    Path("job.toml").write_text("format = [", encoding="utf-8")
    assert "job.toml: it is not valid TOML" in ran("job.toml", status=2).stderr
    Path("list.json").write_text("[1]", encoding="utf-8")
    assert "list.json: it holds no result" in ran("list.json", status=2).stderr
    Path("old.json").write_text('{"force": [1.0]}', encoding="utf-8")
    assert "old.json: it contains no recipe" in ran("old.json", status=2).stderr
    assert "none.toml: it cannot be opened" in ran("none.toml", status=2).stderr
    written(JOB.replace("forces", "force"))
    assert "Error: recipe.loads.force: unknown field 'force'" in ran("job.toml", status=2).stderr


def test_another_file_under_the_name_is_refused():
    def done(words):
        result = RUNNER.invoke(app, words.split())
        assert result.exit_code == 0, result.output

    done("surface make a.npz --hurst 1 --rms 1um --size 1mm --points 16")
    done("press a.npz --force 10N --modulus 1GPa --out result")
    assert record("result/press.json")["recipe"]["source"]["file"] == "../a.npz"
    assert "same numbers" in ran("result/press.json").stderr
    done("surface make a.npz --hurst 1 --rms 2um --size 1mm --points 16")
    told = ran("result/press.json", status=2).stderr
    assert "its SHA-256 differs; give that file, or leave out sha256" in told


def test_several_mistakes_are_told_apart():
    written(JOB.replace("forces", "force").replace('hurst = "0.8"', 'hurst = "8"'))
    found = json.loads(ran("job.toml", "--json", status=2).stdout)
    assert [each["place"] for each in found["mistakes"]] == ["recipe.source.hurst", "recipe.loads.force"]
    assert all(each["message"] and each["remedy"] for each in found["mistakes"])


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("format = 7", "recipe.format: the recipe has the format 7"),
        ("format = 1", "no job is named"),
        ('case = "curve"', "run it by 'roughcontact study run'"),
    ],
)
def test_what_states_no_job_is_refused_with_what_to_do(text, told):
    Path("job.toml").write_text(text, encoding="utf-8")
    assert told in ran("job.toml", status=2).stderr


def test_a_folder_stands_for_the_result_in_it():
    written()
    ran("job.toml")
    assert "same numbers" in ran("job").stderr
    Path("empty").mkdir()
    assert "empty holds no result of a job" in ran("empty", status=2).stderr
    assert "curve.csv: it is neither a job nor a result" in ran("job/curve.csv", status=2).stderr


def test_a_program_reads_what_differs():
    written()
    ran("job.toml")
    assert json.loads(ran("job/curve.json", "--json").stdout)["different"] == []
    changed = record()
    changed["depth"][0] *= 2
    Path("job/curve.json").write_text(json.dumps(changed), encoding="utf-8")
    [told] = json.loads(ran("job/curve.json", "--json", status=1).stdout)["different"]
    assert told.startswith("depth: 1 of 4 differ")


def test_the_answer_of_another_recipe_is_replaced_with_a_word():
    written()
    ran("job.toml")
    assert "is replaced" not in ran("job.toml").stderr
    written(JOB.replace("110GPa", "120GPa"))
    assert "job holds the answer of another recipe, which is replaced" in ran("job.toml").stderr


def test_files_are_written_to_the_end(monkeypatch):
    from roughcontact.cli.contact import curve_answer

    write = curve_answer.CurveAnswer.write

    def interrupted(self, *given):
        signal.raise_signal(signal.SIGINT)
        return write(self, *given)

    monkeypatch.setattr(curve_answer.CurveAnswer, "write", interrupted)
    written()
    before = signal.getsignal(signal.SIGINT)
    assert "the files are being written" in ran("job.toml").stderr
    assert signal.getsignal(signal.SIGINT) == before
    assert len(record()["depth"]) == 4
