"""Figures: none is left open for the next test. Pictures and fields that nobody looks at need not be written."""

import sys
from contextlib import contextmanager
from pathlib import Path

import pytest


@pytest.fixture(autouse=True)
def _figures_are_closed():
    yield
    if pyplot := sys.modules.get("matplotlib.pyplot"):
        pyplot.close("all")


@pytest.fixture
def undrawn(monkeypatch):
    """Leave the files of pictures empty: to draw one, and to trace its flow lines, takes longer than many a job."""
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda figure, path, **_: Path(path).touch())
    monkeypatch.setattr("matplotlib.axes.Axes.streamplot", lambda axes, *_, **__: None)


@contextmanager
def without_fields():
    """Leave NetCDF files empty: to write one takes longer than many a job."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("roughcontact.files.write.netcdf_bytes", lambda dataset: b"")
        yield
