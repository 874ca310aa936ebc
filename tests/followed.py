"""Remedies that are followed to the letter: what is refused, the words of the message, and what they say to do."""

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.own_errors import is_ours

MODULUS = 1e9
PLANE = rc.Grid((16, 16), 1e-6)
ROUND = rc.Grid((16, 16), 1e-6, periodic=True)
LINE = rc.Grid(32, 1e-6)


def heights(grid=PLANE, *, seed=1):
    """Return a rough surface of an rms height of 100 nm."""
    return rc.self_affine(grid, 0.8, 1e-7, np.random.default_rng(seed))


ROUGH, PERIODIC, PROFILE = heights(), heights(ROUND), heights(LINE)


def holed():
    """Return a surface with two points that were not measured."""
    values = ROUGH.heights.copy()
    values[3, 4:6] = np.nan
    return rc.Surface(values, PLANE)


@dataclass(frozen=True)
class Refusal:
    """What is refused, words of its message up to the remedy, and every way that the remedy offers."""

    wrong: Callable
    words: str
    right: tuple[Callable, ...]


def row(wrong, words, *right):
    """Return a row of a table of refusals."""
    assert right, words
    return pytest.param(Refusal(wrong, words, right), id=words.encode("ascii", "replace").decode())


def follow(refusal, *given):
    """Meet the refusal, then do what it says, in every way that it offers."""
    with pytest.raises((ValueError, OSError), match=re.escape(refusal.words)) as met:
        refusal.wrong(*given)
    assert is_ours(met.value), "the message is that of another library"
    for mended in refusal.right:
        mended(*given)
