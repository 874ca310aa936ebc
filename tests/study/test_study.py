import pickle
import tomllib

import numpy as np
import pint
import pytest
import xarray

import roughcontact as rc
from roughcontact.study.ranges import Range
from roughcontact.study.study import Study
from roughcontact.study.study_errors import MOST_MISTAKES, StudyError
from study.trial import CASE, NAME

TEXT = """
name = "hurst"
case = "study.trial:CASE"
seed = 1
samples = 3

[parameters]
size = "1 mm"

[table]
hurst = { start = 0.1, stop = 0.3, count = 3 }
points = [4, 8]
"""
GIVEN = {"name": "a", "case": NAME, "parameters": {"hurst": 0.8}}


@pytest.fixture
def written(tmp_path):
    """Return a function that writes a study file."""

    def write(text):
        path = tmp_path / "given.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_a_study_is_read_from_a_file(written):
    study = Study.read(written(TEXT))
    assert (study.name, study.seed, study.samples) == ("hurst", 1, 3)
    found = [(each.hurst, each.points, each.size) for each in study.combinations()]
    assert found == [(h, n, 1e-3) for h in (0.1, 0.2, 0.3) for n in (4, 8)]


def test_tasks_come_sample_by_sample(written):
    tasks = list(Study.read(written(TEXT)).tasks())
    assert [task.sample for task in tasks] == [0] * 6 + [1] * 6 + [2] * 6
    assert [task.parameters for task in tasks[:6]] == [task.parameters for task in tasks[6:12]]
    assert len({task.key for task in tasks}) == 18
    assert {(task.case, task.seed) for task in tasks} == {(CASE, 1)}


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"parameters": {}, "table": {"hurst": [0.5, 1, 1.5], "end": ["well", "error"]}},
        {"parameters": {}, "table": {"hurst": Range(start=0.1, stop=2, step=0.1)}, "samples": 7},
        {"parameters": {}, "table": {"hurst": np.linspace(0, 1, 3)}, "seed": np.int64(3)},
        {"rows": [{"points": 3}, {"points": 4, "size": '1"\x7f\\ä mm'[0] + " mm"}]},
        {"parameters": {"hurst": np.float64(0.1), "size": np.array(1e-6)}, "table": {"points": [1, 2]}},
    ],
)
def test_a_study_is_written_and_read_back(more, tmp_path):
    study = Study(**(GIVEN | more))
    study.write(tmp_path / "study.toml")
    back = Study.read(tmp_path / "study.toml")
    assert back == study
    assert [task.key for task in back.tasks()] == [task.key for task in study.tasks()]
    tomllib.loads(study.to_toml())


def test_rows_are_crossed_with_the_table():
    study = Study(
        name="a", case=NAME, rows=[{"hurst": 0.1}, {"hurst": 0.2, "points": 9}], table={"size": [1, 2]}
    )
    found = [(each.hurst, each.points, each.size) for each in study.combinations()]
    assert found == [(0.1, 4, 1), (0.1, 4, 2), (0.2, 9, 1), (0.2, 9, 2)]


def test_ranges_take_units_and_whole_numbers():
    table = {"size": {"start": "1 um", "stop": "1 mm", "count": 4, "spacing": "log"}}
    study = Study(
        **GIVEN, table=table | {"points": {"start": 128, "stop": 512, "count": 3, "spacing": "log"}}
    )
    found = study.combinations()
    assert sorted({each.size for each in found}) == [1e-6, 1e-5, 1e-4, 1e-3]
    assert sorted({each.points for each in found}) == [128, 256, 512]


def test_more_samples_keep_the_keys():
    study = Study(**GIVEN, samples=2)
    more = [task.key for task in study.with_samples(5).tasks()]
    assert more[:2] == [task.key for task in study.tasks()]
    assert len(set(more)) == 5


def test_a_task_can_be_sent_to_another_process():
    (task,) = Study(**GIVEN).tasks()
    assert pickle.loads(pickle.dumps(task)) == task


def test_the_room_opens_at_its_public_names():
    assert rc.study.Study is Study
    assert callable(rc.study.run)
    assert callable(rc.study.run_task)
    for name in rc.study.__all__:
        assert getattr(rc.study, name) is not None
    assert {"Study", "Processes", "run"} <= set(rc.study.__all__)
    assert "task" not in rc.study.__all__  # no module
    with pytest.raises(AttributeError, match="no attribute 'Studio'"):
        _ = rc.study.Studio


@pytest.mark.parametrize(
    ("more", "complaint"),
    [
        (
            {"sample": 3},
            "there is no 'sample': did you mean 'samples'? choose from case, files, folder, name",
        ),
        ({"samples": 0}, "samples: 0 should be greater than or equal to 1"),
        ({"samples": 2.5}, "samples: 2.5 should be a valid integer"),
        ({"samples": 10**12}, "make 1,000,000,000,000 cases, and a study has 10,000,000 at most; take fewer"),
        ({"samples": True}, "samples: True should be a valid integer"),
        ({"seed": -1}, "seed: -1 should be greater than or equal to 0"),
        ({"seed": "1"}, "seed: '1' should be a valid integer"),
        ({"name": "a/b"}, "name: 'a/b' is not a valid name of a study; use letters"),
        ({"name": ""}, "name: '' is not a valid name"),
        ({"case": "curv"}, "there is no case 'curv': did you mean 'curve'? choose from"),
        ({"case": "curv"}, "or give your own case in Python as module:attribute"),
        (
            {"case": "nowhere.at_all:CASE"},
            "no module nowhere is found; run in the folder that contains nowhere",
        ),
        (
            {"case": "study.nowhere:CASE"},
            "no module study.nowhere is found; run in the folder that contains study",
        ),
        ({"case": "study.trial:CAS"}, "study.trial has no Case named 'CAS'"),
        ({"case": "study.trial:NO_CASE"}, "study.trial has no Case named 'NO_CASE'"),
        ({"case": "study.trial.CASE"}, "there is no case 'study.trial.CASE'"),
        ({"case": CASE}, "other processes cannot import the case 'trial'; name it by its module"),
        ({"parameters": {}}, "'hurst' is missing"),
        (
            {"parameters": {"hurts": 1}},
            "parameters.hurts: the case 'study.trial:CASE' has no parameter 'hurts'",
        ),
        ({"parameters": {"hurts": 1}}, "did you mean 'hurst'? choose from end, hurst, label, points"),
        ({"parameters": {"hurst": 4}}, "hurst: 4 should be less than or equal to 3"),
        ({"parameters": {"hurst": float("nan")}}, "hurst: nan should be a finite number"),
        ({"parameters": {"hurst": "rough"}}, "hurst: 'rough' should be a valid number"),
        (
            {"parameters": {"hurst": 1, "size": "1 N"}},
            "parameters.size: '1 N' is not a length; write a length such as 5um",
        ),
        ({"parameters": {"hurst": 1, "label": None}}, "None cannot be written to a study file"),
        ({"parameters": 5}, "parameters: 5 should be a valid dictionary"),
        ({"table": {"hurst": [1]}}, "'hurst' is given both in parameters and in table; remove it from one"),
        ({"table": {"hirst": [1]}}, "table.hirst: the case 'study.trial:CASE' has no parameter 'hirst'"),
        ({"table": {"points": []}}, "table.points: the list is empty; give one value or more"),
        ({"table": {"points": 4}}, "table.points: 4 is neither a list nor a range"),
        (
            {"table": {"points": [4, 4.0]}},
            'a case appears twice: {"end":"well","hurst":0.8,"label":null,"points":4',
        ),
        ({"table": {"size": ["1 mm", 0.001]}}, "a case appears twice"),
        ({"table": {"size": [0]}}, "size: 0 should be greater than 0"),
        ({"table": {"size": {"start": 1, "stop": 2}}}, "table.size: a range has either a count or a step"),
        ({"table": {"size": {"start": 1, "end": 2, "count": 3}}}, "there is no 'end'"),
        ({"table": {"size": {"start": "1 N", "stop": 2, "count": 3}}}, "table.size: '1 N' is not a length"),
        ({"table": {"size": {"start": 1, "stop": 2, "step": -1}}}, "table.size: steps of -1 do not lead"),
        ({"table": {"points": {"start": 1, "stop": 2, "count": 3}}}, "points: 1.5 should be a valid integer"),
        ({"table": {"end": {"start": "error", "stop": "well", "count": 3}}}, "a range needs numbers"),
        ({"rows": [{"hurst": 1}]}, "'hurst' is given both in parameters and in rows"),
        ({"rows": [{"pints": 1}]}, "rows.pints: the case 'study.trial:CASE' has no parameter 'pints'"),
        ({"rows": [{"points": 1}, {"points": 1}]}, "a case appears twice"),
        ({"rows": {"points": 1}}, "rows: {'points': 1} should be a valid tuple"),
    ],
)
def test_what_makes_no_sense_is_refused_in_plain_words(more, complaint):
    with pytest.raises(StudyError) as caught:
        Study(**(GIVEN | more))
    assert complaint in str(caught.value)
    assert "pydantic" not in str(caught.value)
    assert "\n" not in str(caught.value)


def test_all_mistakes_come_in_one_message_each_with_its_place_and_once():
    table = {"hurst": [4, 5, 0.5], "points": [], "size": {"start": "1 N", "stop": 2, "count": 3}}
    with pytest.raises(StudyError) as caught:
        Study(name="a/b", case=NAME, samples=0, parameters={"hurts": 1, "end": "ill"}, table=table)
    assert [each.place for each in caught.value.parts] == [
        *("name", "samples", "table.points", "parameters.hurts", "table.size"),
        *("table.hurst", "parameters.end", "table.hurst"),
    ]
    assert "table.hurst: 4 should be less than or equal to 3" in str(caught.value)
    assert caught.value.place.startswith("name, samples, table.points")


def test_of_many_mistakes_the_first_are_shown():
    with pytest.raises(StudyError) as caught:
        Study(name="a", case=NAME, table={"hurst": list(range(4, 1000))})
    assert str(caught.value).count("should be less") == MOST_MISTAKES
    assert str(caught.value).endswith("there are more errors: correct these first")


def test_what_is_missing_is_named():
    with pytest.raises(StudyError, match=r"'case' is missing"):
        Study(name="a")


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("name = ", "it is not a valid TOML file: Invalid value"),
        ('name = "a"\nname = "b"', "it is not a valid TOML file: Cannot overwrite a value"),
        ('name = "a"\ncase = "study.trial:CASE"', "'hurst' is missing"),
        ("[study]\nname = 'a'", "there is no 'study'"),
    ],
)
def test_a_bad_file_is_named(written, text, complaint):
    path = written(text)
    with pytest.raises(StudyError) as caught:
        Study.read(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert complaint in str(caught.value)


def test_a_file_that_is_not_there_or_not_text_is_named(tmp_path):
    with pytest.raises(StudyError, match=r"No such file.*name the file of a study"):
        Study.read(tmp_path / "nothing.toml")
    with pytest.raises(StudyError, match="Is a directory"):
        Study.read(tmp_path)
    (tmp_path / "a.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(StudyError, match="it is not a valid TOML file"):
        Study.read(tmp_path / "a.toml")


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("1 / 0", "cannot be imported: ZeroDivisionError: division by zero"),
        ("import no_such_library", "needs the module no_such_library; install it"),
    ],
)
def test_a_module_that_fails_is_not_mistaken_for_one_that_is_missing(tmp_path, monkeypatch, text, complaint):
    (tmp_path / "broken_cases.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(StudyError, match=complaint):
        Study(**(GIVEN | {"case": "broken_cases:CASE"}))


def test_a_table_with_too_many_combinations_is_refused_before_they_are_made():
    million = {"start": 1, "stop": 2, "count": 1_000_000}
    with pytest.raises(StudyError, match="1,000,000,000,000 cases"):
        Study(name="a", case=NAME, table={"hurst": million, "size": million})


@pytest.mark.parametrize("value", ["[" * 20000 + "]" * 20000, "{ a = " * 20000 + "1" + " }" * 20000])
def test_deep_nesting_is_refused(value, written):
    with pytest.raises(StudyError, match=r"given.toml: .* nested too deeply"):
        Study.read(written(TEXT + f"rms = {value}\n"))


def test_deep_nesting_of_values_is_refused():
    value = 1.0
    for _ in range(20000):
        value = [value]
    with pytest.raises(StudyError, match="nested too deeply"):
        Study(**(GIVEN | {"parameters": {"hurst": value}}))


U = pint.get_application_registry()


@pytest.mark.parametrize(
    "sizes",
    [
        [1 * U.mm, 2 * U.mm],
        [1, 2] * U.mm,
        xarray.DataArray([1.0, 2.0], attrs={"units": "mm"}),
        {"start": 1 * U.mm, "stop": xarray.DataArray(2.0, attrs={"units": "mm"}), "count": 2},
        Range(start=1 * U.mm, stop=2 * U.mm, count=2),
    ],
)
def test_values_with_a_unit_are_written_as_text(sizes):
    study = Study(**GIVEN, table={"size": sizes})
    assert [task.parameters.size for task in study.tasks()] == [1e-3, 2e-3]
    assert [task.key for task in Study.model_validate(tomllib.loads(study.to_toml())).tasks()] == [
        task.key for task in study.tasks()
    ]


def test_another_dimension_in_a_study_is_refused():
    with pytest.raises(StudyError, match=r"size: '1\.0 second' is not a length"):
        Study(name="a", case=NAME, parameters={"hurst": 0.8, "size": 1 * U.s})
