"""The program with the command of this package, whether or not it is installed."""

import importlib.metadata
import tomllib
from importlib.metadata import EntryPoint, EntryPoints
from pathlib import Path

import pytest

from cli.conftest import invoke  # noqa: F401
from pictures import _figures_are_closed  # noqa: F401

HOME = Path(__file__).parent.parent
GROUP = "roughcontact.commands"


@pytest.fixture(autouse=True)
def command(monkeypatch):
    """Read the entry points of this group from the settings of the checkout."""
    project = tomllib.loads((HOME / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    points = EntryPoints(EntryPoint(*each, GROUP) for each in project["entry-points"][GROUP].items())
    others = importlib.metadata.entry_points

    def entry_points(**wanted):
        return points if wanted == {"group": GROUP} else others(**wanted)

    monkeypatch.setattr(importlib.metadata, "entry_points", entry_points)
