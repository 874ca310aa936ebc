"""The page on errors quotes the script that measures them."""

from __future__ import annotations

import importlib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[1]


def test_the_table_of_bandwidth_is_what_the_script_prints(capsys, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "benchmarks")  # it takes the joint of the script beside it
    importlib.import_module("errors").bandwidth()
    table = [line for line in capsys.readouterr().out.splitlines() if line.startswith("|")]
    assert len(table) == 2 + 5
    page = (ROOT / "docs" / "concepts" / "errors.md").read_text(encoding="utf-8")
    assert "\n".join(table) in page


def test_the_truth_of_most_single_spheres_lies_within(monkeypatch):
    """Of 32 and of 64 cells; the difference of two grids alone leaves a third outside (docs/concepts/errors.md)."""
    monkeypatch.syspath_prepend(ROOT / "benchmarks")
    errors = importlib.import_module("errors")
    missed, claimed = (
        np.concatenate(each) for each in zip(*(errors.single(n, 12) for n in (32, 64)), strict=True)
    )
    assert missed.shape == claimed.shape == (24, 4)
    # Nine in ten, and two standard deviations of a share of 24: 0.9 - 2 sqrt(0.9 0.1/24) = 0.78.
    assert (np.mean(np.abs(missed) <= claimed, axis=0) >= 0.78).all()
    assert (np.sqrt(np.mean(claimed**2, axis=0)) < [0.03, 0.06, 0.09, 0.06]).all()  # and it says something
