"""Remedies that are followed to the letter: what is refused, the words of the message, and what they say to do."""

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.errors import correctable

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


VALUES = ROUGH.heights
INFINITE = np.where(0.99 * VALUES.max() < VALUES, np.inf, VALUES)
LARGE = heights(rc.Grid((65, 65), 1e-6))
ROWS = slice(0, 4)
ODD = heights(rc.Grid((16, 16), 1.23456789012e-6))
NODES = rc.Grid((17, 17), 1e-6)


def rng():
    return np.random.default_rng(1)


def made(grid=PLANE, hurst=0.8, rms=1e-7, **named):
    return rc.self_affine(grid, hurst, rms, **({"rng": rng()} | named))


def midpoints(grid=NODES, hurst=0.8, **named):
    return rc.midpoint_surface(grid, hurst, rng(), **({"rms": 1e-7} | named))


def each(call, *values):
    """Return the call with each of the values that a message lists."""
    return [lambda value=value: call(value) for value in values]


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
    assert correctable(met.value), "the message is that of another library"
    for mended in refusal.right:
        mended(*given)


@dataclass(frozen=True)
class RefusedCommand:
    """A command that is refused, words of its message, and the commands that follow from each of its remedies."""

    wrong: str
    words: tuple[str, ...]
    right: tuple[str, ...]


def commands(*tables):
    """Return the rows of tables: ``$`` stands before what is refused, ``!`` before words, ``>`` before remedies."""
    rows = [block.split("\n") for table in tables for block in table.strip().split("\n\n")]
    return [pytest.param(_of(lines), id=lines[0].removeprefix("$ ")) for lines in rows]


def _of(lines):
    marked = {mark: tuple(each[2:] for each in lines if each[0] == mark) for mark in "$!>"}
    assert sum(map(len, marked.values())) == len(lines), lines
    [wrong] = marked["$"]
    assert marked["!"], wrong
    assert marked[">"], wrong
    return RefusedCommand(wrong, marked["!"], marked[">"])


def follow_command(command, refusal):
    """Meet the refusal of a command, then run what its message says, in every way that it offers."""
    answer = command(refusal.wrong)
    assert answer.exit_code == 2, answer.stderr
    for words in refusal.words:
        assert words in answer.stderr
    for mended in refusal.right:
        for each in mended.split(" && "):
            answer = command(each)
            assert answer.exit_code == 0, (each, answer.stderr)
