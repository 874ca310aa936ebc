"""Scan lines that are shifted against each other are brought to one median."""

import re

import numpy as np
import pytest

import roughcontact as rc

GRID = rc.Grid((48, 64), 1e-6)
ROUGH = rc.self_affine(GRID, 0.8, 1e-7, np.random.default_rng(3))
SHIFTS = np.random.default_rng(4).normal(0, 1e-6, (48, 1))


def test_shifts_of_the_lines_change_nothing_when_they_are_aligned():
    shifted = ROUGH.with_heights(ROUGH.heights + SHIFTS, "shifted")
    aligned = shifted.aligned("rows").heights
    np.testing.assert_allclose(np.median(aligned, axis=1), np.median(shifted.heights), rtol=0, atol=1e-20)
    expected = ROUGH.aligned("rows").heights + np.median(shifted.heights) - np.median(ROUGH.heights)
    np.testing.assert_allclose(aligned, expected, rtol=0, atol=1e-20)  # sums of numbers of 1e-6
    turned = shifted.transposed().aligned("columns")
    np.testing.assert_array_equal(turned.heights, aligned.T)
    shift = np.std(np.median(shifted.heights, axis=1) - np.median(shifted.heights))
    line = shifted.aligned().provenance[-1]
    words = re.fullmatch(r"rows aligned by their medians, shifts of (\S+) m rms removed", line)
    assert float(words[1]) == pytest.approx(shift, rel=0.2)  # about the median of the map, not their mean


def test_a_second_time_nothing_is_shifted():
    once = ROUGH.aligned()
    np.testing.assert_allclose(once.aligned().heights, once.heights, rtol=0, atol=1e-22)
    assert once.aligned().provenance[-1].endswith(" m rms removed")


def test_a_streak_along_less_than_half_a_line_moves_its_line_by_little():
    """The median of 64 heights of which 20 are raised is a quantile of the other 44, within their range."""
    heights = ROUGH.heights.copy()
    heights[10, 5:25] += 5e-6
    moved = rc.Surface(heights, GRID).aligned().heights[10, 30:] - ROUGH.aligned().heights[10, 30:]
    assert np.abs(moved).max() < np.ptp(ROUGH.heights)


def test_missing_points_stay_missing_and_a_line_without_heights_is_left():
    heights = ROUGH.heights + SHIFTS
    heights[7], heights[8, ::2] = np.nan, np.nan
    aligned = rc.Surface(heights, GRID).aligned()
    np.testing.assert_array_equal(aligned.measured, ~np.isnan(heights))
    medians = np.nanmedian(np.delete(aligned.heights, 7, axis=0), axis=1)
    np.testing.assert_allclose(medians, np.nanmedian(heights), rtol=0, atol=1e-20)
