"""What the page states gives the numbers that it shows."""

import json
import shlex

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from roughcontact.page.recipe import as_recipe
from roughcontact.page.reduced import as_seen
from roughcontact.page.statement import stated
from roughcontact.page.workbench import UploadedFile, Workbench

PREPARATIONS = [
    {},
    {"level": "none", "despike": "filled"},
    {"crop": [2, 40, 4, 44], "level": "quadratic", "short_cutoff": "8um"},
]


@pytest.mark.parametrize("preparation", PREPARATIONS, ids=["plain", "despiked", "prepared"])
@pytest.mark.parametrize("made", [True, False], ids=["made", "file"])
def test_command_and_python_give_the_same_numbers(made, preparation, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "part.npz"
    grid = rc.Grid((48, 48), 1e-6)
    rc.write(rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(2)), file)
    source = {"kind": "file", "file": "key"}
    if made:
        source = {"kind": "made", "hurst": "0.8", "rms": "0.1um", "size": "48um", "points": 48}
    bodies, load = {"materials": ["steel", "aluminium"]}, {"control": "force", "text": "1.23 mN"}
    recipe = as_recipe({"source": source, "preparation": preparation, "bodies": bodies, "load": load})
    shown = Workbench().solution(recipe, {"key": UploadedFile(file, "part.npz")})
    statement = stated(recipe, "part.npz")
    space = {}
    exec(statement.python, space)
    assert np.array_equal(space["solution"].pressure, shown.pressure)
    for line in statement.command.splitlines():
        result = CliRunner().invoke(app, [*shlex.split(line)[1:], "--json"])
        assert result.exit_code == 0, result.stderr
    record = json.loads(result.stdout)
    assert (record["force"], record["depth"], record["contact_area"]) == (
        shown.force,
        shown.depth,
        shown.contact_area,
    )


def test_a_reduced_map_keeps_its_highest_points_and_what_is_missing():
    field = np.arange(30.0).reshape(5, 6)
    field[4, 4:] = np.nan
    assert np.array_equal(as_seen(field, 2), [[7, 9, 11], [19, 21, 23], [25, 27, np.nan]], equal_nan=True)
    assert np.array_equal(as_seen(field, 2, lowest=True)[0], [0, 2, 4])
