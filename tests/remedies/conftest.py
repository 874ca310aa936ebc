import shlex
import shutil

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from followed import MODULUS, ROUGH, heights, holed
from roughcontact.cli.app import app

# A plain, wide terminal, so that messages are not cut into pieces.
PLAIN = {"COLUMNS": "500", "TERM": "dumb", "NO_COLOR": "1"}


@pytest.fixture(scope="session")
def kept(tmp_path_factory):
    """A map, one without unit and size, one with holes, a profile, a curve and a path of surfaces that stick."""
    here = tmp_path_factory.mktemp("kept")
    surface = rc.self_affine(rc.Grid((24, 32), (2e-6, 1e-6)), 0.8, 1e-7, np.random.default_rng(5))
    for kind in (".npz", ".x3p", ".nc"):
        rc.write(surface, here / f"rough{kind}")
    rc.write(holed(), here / "holed.npz")
    np.save(here / "bare.npy", 1e9 * surface.heights)
    line = heights(rc.Grid(64, 1e-6))
    np.savetxt(here / "profile.txt", np.column_stack([line.grid.coordinates[0], line.heights]))
    curve = rc.loading_curve(ROUGH, MODULUS, forces=[1e-5, 1e-4])
    for kind in (".nc", ".csv"):
        rc.write(curve, here / f"curve{kind}")
    path = rc.adhesive_curve(ROUGH, MODULUS, rc.Adhesion(1e-3, 1e-7), depths=[1e-9, 2e-9])
    rc.write(path, here / "path.nc")
    (here / "taken").write_text("mine")
    return here


@pytest.fixture
def folder(kept, tmp_path, monkeypatch):
    """A folder of these files to work in."""
    shutil.copytree(kept, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def command(folder, undrawn):
    """Run a line of a shell in this process, without its pictures; the answer has exit_code, stdout and stderr."""
    return lambda line: CliRunner().invoke(app, shlex.split(line), env=PLAIN)
