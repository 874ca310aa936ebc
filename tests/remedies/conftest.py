import shlex

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from followed import holed
from roughcontact.cli.app import app
from roughcontact.grid import Grid

# A plain, wide terminal, so that messages are not cut into pieces.
PLAIN = {"COLUMNS": "500", "TERM": "dumb", "NO_COLOR": "1"}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder to work in, with a map, one without unit and size, one with holes, and a profile."""
    monkeypatch.chdir(tmp_path)
    surface = rc.self_affine(Grid((24, 32), (2e-6, 1e-6)), 0.8, 1e-7, np.random.default_rng(5))
    rc.write(surface, "rough.npz")
    rc.write(holed(), "holed.npz")
    np.save("bare.npy", 1e9 * surface.heights)
    line = rc.self_affine(Grid(64, 1e-6), 0.8, 1e-7, np.random.default_rng(6))
    np.savetxt("profile.txt", np.column_stack([1e-6 * np.arange(64), line.heights]))
    (tmp_path / "taken").write_text("mine")
    return tmp_path


@pytest.fixture
def command(folder):
    """Run a line of a shell in this process; the answer has exit_code, stdout and stderr."""
    return lambda line: CliRunner().invoke(app, shlex.split(line), env=PLAIN)
