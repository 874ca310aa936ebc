import pytest
from pydantic import BaseModel, ValidationError

from roughcontact.study.case import Area, Energy, Force, Length, Parameters, Positive, Pressure, Stiffness
from roughcontact.study.ranges import Range
from roughcontact.study.study_errors import StudyError


class Body(BaseModel):
    size: Positive[Length] = 1.0
    modulus: Pressure = 1.0
    force: Force | None = None
    area: Area = 1.0
    stiffness: Stiffness = 1.0
    energy: Energy = 1.0


class Square(Parameters):
    size: Positive[Length]


@pytest.mark.parametrize(
    ("name", "text", "number"),
    [
        ("size", "2 mm", 2e-3),
        ("modulus", "110 GPa", 110e9),
        ("force", "3mN", 3e-3),
        ("area", "2 mm**2", 2e-6),
        ("area", "2 mm²", 2e-6),
        ("stiffness", "5 MN/m", 5e6),
        ("energy", "1 mJ", 1e-3),
        ("energy", "7", 7.0),
    ],
)
def test_text_with_a_unit_is_a_number_in_si(name, text, number):
    assert getattr(Body(**{name: text}), name) == pytest.approx(number, rel=1e-15)
    assert getattr(Body(**{name: number}), name) == number


@pytest.mark.parametrize(
    ("name", "value", "complaint"),
    [
        ("size", "1 N", "'1 N' is not a length: write a length such as 5um"),
        ("size", "1 mmm", "unknown unit 'mmm'"),
        ("size", "-1 mm", "greater than 0"),
        ("size", True, "True is not a length"),
        ("modulus", "1,1 GPa", "holds a comma"),
        ("force", [1.0], "valid number"),
    ],
)
def test_what_is_no_quantity_of_its_kind_is_refused(name, value, complaint):
    with pytest.raises(ValidationError, match=complaint):
        Body(**{name: value})


def test_none_stays_where_it_is_allowed():
    assert Body(force=None).force is None


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: Range(start=0, stop=1), "a range has either a count or a step: give one of them"),
        (lambda: Square(size="1 N"), "size: '1 N' is not a length; write a length such as 5um"),
        (
            lambda: Square(sise=1),
            "size: 'size' is missing; give size; sise: there is no 'sise': did you mean 'size'? choose from size",
        ),
    ],
)
def test_values_are_refused_in_plain_words(make, says):
    """Without the names of the library that checks them, its prefixes and its address."""
    with pytest.raises(StudyError) as refused:
        make()
    assert str(refused.value) == says
