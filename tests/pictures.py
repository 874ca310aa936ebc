"""Figures: none is left open for the next test, and what nobody looks at need not be drawn."""

import sys
from pathlib import Path

import pytest


@pytest.fixture(autouse=True)
def _figures_are_closed():
    yield
    if pyplot := sys.modules.get("matplotlib.pyplot"):
        pyplot.close("all")


@pytest.fixture
def undrawn(monkeypatch):
    """Leave the files of pictures empty: to draw one takes longer than many a job."""
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda figure, path, **_: Path(path).touch())
