"""How claims are judged: tolerances, errors, and ranges of the Hurst exponent."""

import numpy as np
import pytest
import xarray

from roughcontact_thesis.ruling import (
    RANGES,
    exactly,
    exceeds,
    in_part,
    middle,
    ranged,
    ruled,
    ruled_in_middle,
    undecided,
)

HURST = [-0.5, -0.25, 0.0, 0.25, 1.0, 1.75, 2.0, 2.25, 2.5]


def along(values, hurst=HURST):
    return xarray.DataArray(values, {"hurst": hurst}, "hurst")


@pytest.mark.parametrize(
    ("deviation", "error", "word"),
    [
        ([0.05, -0.06], 0.02, "holds"),  # 0.06 + 2 * 0.02 is the tolerance
        ([0.05, -0.07], 0.02, "not decided"),
        ([0.0, -0.15], 0.02, "not decided"),  # 0.15 - 3 * 0.02 is below it
        ([0.11, -0.17], 0.02, "does not hold"),
        ([0.05, -0.09], 0.0, "holds"),
        # What was not computed says nothing; without an error nothing is sure.
        ([np.nan, 0.0], 0.0, "holds"),
        ([0.5], np.nan, "not decided"),
        ([0.0], np.nan, "not decided"),
        ([np.nan], 0.0, "not decided"),
        ([], 0.0, "not decided"),
    ],
)
def test_deviations_are_judged_by_their_errors(deviation, error, word):
    assert ruled(deviation, error, 0.1).word == word


def test_what_holds_in_part_says_where():
    away = along([0.5, 0.5, 0.0, 0.0, 0.0, 0.09, 0.5, 0.0, 0.5])
    rule = ruled(away, along(np.full(9, 0.01)), 0.1)
    assert rule.words == "holds in part (0.00 <= H <= 1.00, H = 2.25)"
    assert rule.span == "-0.50 <= H <= 2.50"
    assert rule.tolerance == "10%"
    assert rule.trigger.endswith("+50.0% ± 1.0% at H = -0.50")


def test_one_value_outside_of_many_at_one_hurst_exponent_is_no_part():
    forces = xarray.DataArray(
        [[0.0, 0.5], [0.0, 0.0]], {"hurst": [0.5, 1.0], "force": [1, 2]}, ("hurst", "force")
    )
    rule = ruled(forces, 0.01, 0.1)
    assert rule.words == "holds in part (H = 1.00)"
    assert rule.trigger.endswith("at H = 0.50, F = 2")


def test_an_error_may_lack_a_dimension():
    away = xarray.DataArray([[0.0, 0.5]], {"hurst": [0.5], "force": [1, 2]}, ("hurst", "force"))
    assert ruled(away, along([0.1], [0.5]), 0.1).word == "does not hold"
    assert ruled(away.T, along([0.2], [0.5]), 0.1).word == "not decided"


def test_only_what_lies_above_may_count():
    assert ruled([-0.5], 0.01, 0.0).word == "does not hold"
    assert ruled([-0.5], 0.01, 0.0, above=True).word == "holds"
    assert ruled([0.5], 0.01, 0.0, above=True).word == "does not hold"


def test_every_hurst_exponent_belongs_to_one_range():
    told = ranged(along(np.arange(9) / 100), along(np.zeros(9)), 1.0, ".2f")
    assert told == (
        "0.00 for H below 0 (holds); 0.01 to 0.02 for H within 0.25 of 0 (holds); 0.03 to 0.05 for H 0.25 to "
        "1.75 (holds); 0.06 to 0.07 for H within 0.25 of 2 (holds); 0.08 for H above 2 (holds)"
    )
    assert list(middle(along(np.zeros(9)))["hurst"]) == [0.25, 1.0, 1.75]
    assert len(RANGES) == 5


def test_what_is_judged_in_the_middle_has_verdicts_of_all_ranges():
    rule = ruled_in_middle(along([0.5, 0.5, 0.5, 0.0, 0.0, 0.0, 0.5, 0.5, 0.04]), along(np.zeros(9)), 0.1)
    assert (rule.word, rule.span) == ("holds", "0.25 <= H <= 1.75")
    assert rule.ranges == {
        "below 0": "does not hold: +50.0%",
        "within 0.25 of 0": "does not hold: +50.0%",
        "0.25 to 1.75": "holds: +0.0%",
        "within 0.25 of 2": "does not hold: +50.0%",
        "above 2": "holds: +4.0%",
    }
    assert ruled([0.0], 0.0, 0.1).ranges == {}


def test_a_number_is_above_another_by_more_than_three_errors():
    assert exceeds(1.0, 0.1, 0.6, ".1f", "more").word == "holds"
    assert exceeds(1.0, 0.1, 0.8, ".1f", "more").word == "not decided"
    assert exceeds(1.0, 0.1, 1.4, ".1f", "more").word == "does not hold"


def test_what_has_no_errors():
    assert exactly(True, "1%").words == "holds"
    assert exactly(False, "1%").words == "does not hold"
    assert in_part("here", "1%").words == "holds in part (here)"
    assert undecided("too few").words == "not decided"
