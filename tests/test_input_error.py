"""An error keeps what is wrong, the remedy and the place apart, on its way through callers and processes."""

import pickle

import pytest

import roughcontact as rc
from roughcontact.errors import placed, within


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
