"""An error keeps what is wrong, the remedy and the place apart, on its way through callers and processes."""

import ast
import pickle
import re
from pathlib import Path

import pytest

import roughcontact as rc
from roughcontact.cli.messages import UsageError
from roughcontact.errors import about, correctable, every, placed, together, within
from roughcontact.files.file_errors import ContentError
from roughcontact.study.executors.worker import WorkersError
from roughcontact.validation import positive, require, whole

SOURCES = [
    path
    for folder in (Path(rc.__file__).parent, Path(__file__).parents[1] / "reproduction" / "src")
    for path in sorted(folder.rglob("*.py"))
]
OURS = {
    *("InputError", "ContentError", "ReadError", "StoreError", "StudyError", "UsageError", "WorkersError"),
    *("WriteError", "about", "require"),
}
REMEDY = re.compile(r"[:;] (add|choose|give|leave|make|name|press|say|take|use|write) ")


def test_the_text_joins_the_message_and_the_remedy():
    assert str(rc.InputError("0 is no length")) == "0 is no length"
    assert (
        str(rc.InputError("0 is no length", "give a positive one")) == "0 is no length: give a positive one"
    )
    assert str(rc.InputError("not of: a", "give b")) == "not of: a; give b"  # one colon is enough


@pytest.mark.parametrize(
    ("found", "at", "below"),
    [
        (None, "source", "source"),
        ("size", "source", "source.size"),
        ("size.y", "source", "source.size.y"),
        ("unit, size", "source", "source.unit, source.size"),
    ],
)
def test_a_caller_sets_the_place_or_puts_its_own_in_front(found, at, below):
    with pytest.raises(rc.InputError) as refused, placed(at):
        raise rc.InputError("wrong", place=found)
    assert refused.value.place == at
    with pytest.raises(rc.InputError) as refused, within(at):
        raise rc.InputError("wrong", place=found)
    assert refused.value.place == below


@pytest.mark.parametrize("context", [placed, within])
def test_errors_of_others_pass_unchanged(context):
    with pytest.raises(ValueError, match=r"^could not convert") as refused, context("source"):
        float("many")
    assert not hasattr(refused.value, "place")


def test_a_process_hands_on_the_fields():
    with pytest.raises(rc.InputError) as refused, within("source"):
        raise rc.InputError("wrong", "take another", "size")
    again = pickle.loads(pickle.dumps(refused.value))
    assert (again.message, again.remedy, again.place) == ("wrong", "take another", "source.size")
    assert str(again) == str(refused.value)


@pytest.mark.parametrize(
    "error",
    [
        rc.InputError("wrong", "take another", "size"),
        rc.ReadError("part.npy", "wrong", "take another", "size"),
        rc.WriteError("wrong", "take another", "size"),
        rc.study.StudyError("wrong", "take another", "size"),
        rc.study.StoreError("here", "wrong", "take another"),
        ContentError("wrong", "take another", "size"),
        UsageError("wrong", "take another", "--size"),
        WorkersError("wrong", "take another", "size"),
    ],
    ids=lambda error: type(error).__name__,
)
def test_each_class_keeps_its_fields_in_a_pickle(error):
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert vars(again) == vars(error)
    assert str(again) == str(error)
    assert error.remedy == "take another"
    assert error.message.endswith("wrong")


def test_a_missed_tolerance_has_the_fields_too():
    ball = rc.shapes.paraboloid(rc.Grid((16, 16), 1e-6), radius=1e-4)
    with pytest.raises(rc.ConvergenceError) as missed:
        rc.press(ball, 1e9, force=1e-4, solver=rc.PolonskyKeer(max_steps=1))
    again = pickle.loads(pickle.dumps(missed.value))
    assert (again.remedy, again.place) == ("allow it more steps", None)
    assert str(again) == f"{again.message}; {again.remedy}"


@pytest.mark.parametrize(
    ("call", "place"),
    [
        (lambda: positive(-1.0, "force [N]"), "force"),
        (lambda: positive(-1.0, "the depth [m]"), "depth"),
        (lambda: positive(-1.0, "work of adhesion [J/m^2]"), None),
        (lambda: whole(0, "bins"), "bins"),
        (lambda: require([True, False], "too much", "give less", place="load", value=[1, 2]), "load"),
        (lambda: rc.Solid("many", 0.3), "young_modulus"),
        (lambda: rc.Solid(1e9, 0.7), "poisson_ratio"),
        (lambda: rc.self_affine(rc.Grid((8, 8), 1e-6), "rough", 1e-7), "hurst"),
        (lambda: rc.press(None, 1e9, force=1.0), "surface"),
        (
            lambda: rc.study.Study(name="few", case="study.trial:CASE", parameters={"hirst": 1, "hurst": 1}),
            "parameters.hirst",
        ),
        (lambda: rc.study.find_case("curve").parameters(points="many"), "points, size, modulus, hurst, rms"),
    ],
)
def test_checks_name_the_argument(call, place):
    with pytest.raises(rc.InputError) as refused:
        call()
    assert refused.value.place == place


def test_a_check_gives_the_value_before_the_remedy():
    with pytest.raises(rc.InputError, match=r"^too much \(given: 2\); give less$"):
        require([True, False], "too much", "give less", value=[1, 2])


def test_what_the_user_can_correct_is_an_error_of_ours_or_about_a_file():
    ours = about("force", "must be positive")
    assert correctable(ours) is ours
    missing = correctable(FileNotFoundError(2, "No such file or directory", "part.npy"))
    assert (str(missing), missing.place) == ("part.npy: No such file or directory", "part.npy")
    assert correctable(OSError("strange")) is None
    assert correctable(BrokenPipeError(32, "Broken pipe", "stdout")) is None
    assert correctable(ValueError("of another library")) is None


def calls(path):
    """Yield the calls of a file by the names of what they call."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call):
            yield node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", ""), node


def text_of(node):
    """Return the text of a literal, with its fields as {}."""
    if isinstance(node, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_errors_about_input_are_written_with_their_fields(path):
    for name, call in calls(path):
        assert name != "ValueError", f"{path}:{call.lineno}: use InputError"
        if name in OURS:
            message = next(filter(None, map(text_of, call.args)), "")
            assert not REMEDY.search(message), f"{path}:{call.lineno}: give the remedy by itself"


def test_several_mistakes_are_one_error_with_each_of_them():
    one, other = rc.InputError("0 is no length", "give another", "size"), rc.InputError("no unit")
    assert together([one]) is one
    assert every(one) == (one,)
    with pytest.raises(rc.InputError) as refused, within("source"):
        raise together([one, other])
    assert str(refused.value) == "source.size: 0 is no length; give another; source: no unit"
    assert refused.value.place == "source.size, source"
    again = pickle.loads(pickle.dumps(refused.value))
    assert [each.place for each in every(again)] == ["source.size", "source"]
    assert str(again) == str(refused.value)
