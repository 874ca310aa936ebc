"""What is said about a claim, in words."""

import numpy as np
import xarray

from roughcontact_thesis.ruling import in_part
from roughcontact_thesis.verdict import Verdict, beside, counted, listed, series, signed, spanned


def test_a_verdict_has_a_word():
    verdict = Verdict("a claim", "its words", "eq. 1", "2", in_part("here", "1%"))
    assert verdict.word == "holds in part (here)"


def test_numbers_are_told_by_their_ends():
    assert spanned([0.1, np.nan, -0.02], "+.1%") == "-2.0% to +10.0%"
    assert spanned([np.nan], ".2g") == "none"
    assert spanned([-0.001, 0.001], "+.0%") == "0% to 0%"
    assert beside([-0.1, np.nan, 0.15]) == "10% below to 15% above"
    assert beside([0.09, 0.04]) == "4% to 9% above"
    assert beside([-0.66, np.nan, -0.01]) == "1% to 66% below"
    assert beside([np.nan]) == "nowhere"
    assert (signed(-0.004, ".2f"), signed(-0.006, ".2f")) == ("0.00", "-0.01")


def test_averages_in_words():
    found = xarray.Dataset(
        {"k": ("hurst", [1.0, 2.0]), "k_error": ("hurst", [0.5, np.nan])},
        {"hurst": [0.5, 1.0]},
        {"surfaces": 20, "cells": 128},
    )
    assert listed(found, "k", "hurst") == "1.00 ± 0.50 at H = 0.5, 2.00 at H = 1"
    assert counted(found) == "20 samples of 128² cells"
    assert series(found["k"], ".1f") == "1.0, 2.0"
    assert series([0.5, 0.25], between=" and ") == "0.500 and 0.250"
