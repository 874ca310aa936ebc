import numpy as np
import pytest

from roughcontact.study.ranges import Range
from roughcontact.study.study_errors import StudyError


def values(**range_):
    return Range(**range_).values(float)


def test_even_values_are_those_one_means():
    # 0.1 and 0.25, not 0.09999999999999998 and 0.2500000000000001 as sums of 0.15 give
    found = values(start=-0.5, stop=2.95, count=24)
    assert found[:6] == (-0.5, -0.35, -0.2, -0.05, 0.1, 0.25)
    assert found[-1] == 2.95
    assert len(found) == 24
    assert values(start=-0.3, stop=0.3, count=3) == (-0.3, 0.0, 0.3)


def test_steps_end_at_the_last_that_does_not_pass():
    assert values(start=0, stop=1, step=0.1) == tuple(i / 10 for i in range(11))
    assert values(start=0, stop=1, step=0.3) == (0.0, 0.3, 0.6, 0.9)
    assert values(start=1, stop=0, step=-0.5) == (1.0, 0.5, 0.0)


def test_a_range_that_grows_keeps_its_values():
    assert values(start=-0.5, stop=2.95, step=0.15) == values(start=-0.5, stop=4.0, step=0.15)[:24]


def test_equal_ratios():
    assert values(start=1e-7, stop=10, count=9, spacing="log") == tuple(float(f"1e{n}") for n in range(-7, 2))
    assert values(start=-1, stop=-100, count=3, spacing="log") == (-1.0, -10.0, -100.0)
    assert values(start=128, stop=1024, count=4, spacing="log") == (128.0, 256.0, 512.0, 1024.0)


def test_the_ends_keep_every_bit():
    start, stop = 0.12345678901234567, np.nextafter(2.0, 3.0)
    found = values(start=start, stop=stop, count=5)
    assert (found[0], found[-1]) == (start, stop)


@pytest.mark.parametrize(
    ("range_", "complaint"),
    [
        ({"start": 0, "stop": 1}, "either a count or a step"),
        ({"start": 0, "stop": 1, "count": 3, "step": 1}, "either a count or a step"),
        ({"start": 1, "stop": 2, "step": 1, "spacing": "log"}, "has a count, not a step"),
        ({"start": 0, "stop": 1, "count": 1}, "greater than or equal to 2"),
        ({"start": 0, "stop": 1, "count": 10**9}, "less than or equal to"),
        ({"start": 0, "stop": 1, "count": 2, "by": 1}, "by"),
    ],
)
def test_what_is_no_range_is_refused(range_, complaint):
    with pytest.raises(StudyError, match=complaint):
        Range(**range_)


@pytest.mark.parametrize(
    ("range_", "complaint"),
    [
        ({"start": 0, "stop": 1, "step": -0.1}, "steps of -0.1 do not lead from 0 to 1"),
        ({"start": 0, "stop": 1, "step": 0}, "steps of 0 do not lead"),
        ({"start": 0, "stop": 1, "step": 1e-9}, "too many"),
        ({"start": 1, "stop": 1, "count": 3}, "starts and stops at 1"),
        ({"start": 0, "stop": 1, "count": 3, "spacing": "log"}, "both ends must be above 0"),
        ({"start": -1, "stop": 1, "count": 3, "spacing": "log"}, "both ends must be above 0"),
    ],
)
def test_a_range_without_values_is_refused(range_, complaint):
    with pytest.raises(ValueError, match=complaint):
        values(**range_)


def test_only_numbers_have_ranges():
    with pytest.raises(ValueError, match=r"'a' is not a number.*write a list"):
        Range(start="a", stop="b", count=2).values(str)
