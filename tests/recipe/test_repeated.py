"""A record beside that of the same job done again."""

import pytest

from roughcontact.recipe.repeated import differences

BEFORE = {
    "file": "a.npz",
    "force": [1.0, 2.0],
    "status": ["converged"],
    "fit": {"exponent": 0.5},
    "depth": 0.0,
}


def test_words_about_the_file_do_not_count():
    assert differences(BEFORE, {**BEFORE, "file": "b.npz", "force": (1.0, 2.0), "notes": ["late"]}) == []


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"force": [1.0, 2.5]}, "force: 1 of 2 differ, by at most 0.25 of the largest"),
        ({"force": [1.0]}, "force: 2 numbers before, 1 now"),
        ({"depth": 1e-9}, "depth: 1 of 1 differ, by at most 1e-09"),
        ({"status": ["missed"]}, "status: ['converged'] before, ['missed'] now"),
        ({"fit": {"exponent": 0.25}}, "fit.exponent: 1 of 1 differ, by at most 0.5 of the largest"),
        ({"fit": None}, "fit: {'exponent': 0.5} before, None now"),
    ],
)
def test_every_number_and_verdict_counts(changed, words):
    assert [str(each) for each in differences(BEFORE, {**BEFORE, **changed})] == [words]


def test_tables_in_a_list_are_compared_one_by_one():
    before = {"exponents": [{"value": 0.5, "count": 3}, {"value": 0.7, "count": 4}]}
    after = {"exponents": [{"value": 0.5, "count": 3}, {"value": 0.35, "count": 4}]}
    assert [str(each) for each in differences(before, after)] == [
        "exponents.1.value: 1 of 1 differ, by at most 0.5 of the largest"
    ]
    assert differences(before, {"exponents": [*before["exponents"]]}) == []


def test_a_quantity_may_come_and_not_go():
    assert differences(BEFORE, BEFORE | {"area": 2.0}) == []
    assert [str(each) for each in differences(BEFORE | {"area": 2.0}, BEFORE)] == [
        "area: 2.0 before, None now"
    ]
