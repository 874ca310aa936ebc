"""What is said about a claim, and when nothing can be said."""

import numpy as np
import xarray

from roughcontact.thesis.verdict import Verdict, counted, judged, listed, series, spanned


def test_a_verdict_has_a_word():
    words = [Verdict("a claim", "1", "2", holds).word for holds in (True, False, None)]
    assert words == ["holds", "does not hold", "open"]


def test_deviations_are_judged_by_their_errors():
    assert judged([0.05, -0.09], 0.2, 0.1) is True
    assert judged([0.05, -0.2], [0.01, 0.03], 0.1) is False
    assert judged([0.05, -0.2], [0.01, 0.04], 0.1) is None
    # What was not computed says nothing; without an error a deviation counts as it is.
    assert judged([np.nan, 0.0], np.nan, 0.1) is True
    assert judged([0.11], np.nan, 0.1) is False
    assert judged([], [], 0.1) is judged([np.nan], 0.0, 0.1) is None


def test_numbers_are_told_by_their_ends():
    assert spanned([0.1, np.nan, -0.02], "+.1%") == "-2.0% to +10.0%"
    assert spanned([np.nan], ".2g") == "none"


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
