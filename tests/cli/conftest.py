import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from roughcontact.contact import loop

assert loop  # imported before tests replace functions that it takes over


@pytest.fixture
def drawn():
    """Draw the pictures of a test that looks at their files."""


@pytest.fixture(autouse=True)
def _pictures(request):
    """Leave pictures empty unless a test is `drawn`: drawing takes longer than most commands."""
    if "drawn" not in request.fixturenames:
        request.getfixturevalue("undrawn")


@pytest.fixture
def invoke():
    """Run the program in this process; the answer has exit_code, stdout, stderr and exception."""

    def run(*arguments):
        # A plain, wide terminal, so that help is not cut into pieces.
        environment = {"COLUMNS": "120", "TERM": "dumb", "NO_COLOR": "1"}
        return CliRunner().invoke(app, [str(argument) for argument in arguments], env=environment)

    return run


@pytest.fixture
def surface():
    grid = rc.Grid((24, 32), (2e-6, 1e-6))
    return rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(5))


@pytest.fixture
def rough(surface, tmp_path):
    """Return the file of a small rough surface."""
    path = tmp_path / "rough.npz"
    np.savez(path, heights=surface.heights, spacing=np.array(surface.grid.spacing), unit=np.array("m"))
    return path
