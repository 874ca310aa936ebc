"""What the page states gives the numbers that it shows."""

import json
import shlex
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from roughcontact.page.jobs.reduced import as_seen, factor_for
from roughcontact.page.jobs.session_cache import SessionCache, UploadedFile
from roughcontact.page.server.page_request import PageRequest

PREPARATIONS = [
    {},
    {"level": "plane"},
    {"level": "none", "despike": "filled"},
    {"crop": "2:40,4:44", "level": "quadratic", "short_cutoff": "8um"},
    {"form": "cylinder", "fill": True, "long_cutoff": "20 um", "downsample": "2", "alias": True},
    {"form": "5", "despike": "missing"},
    {"mask": ["box=0:9,0:9", "outside-ellipse=0:48,0:48"], "tip": "2um", "tip_shape": "paraboloid"},
    {"average": "2", "window": "tukey", "share": "0.5"},
]
BODIES = [
    {"bodies": {"materials": "rigid,gold"}, "plastic": {"hardness": "gold"}},
    {"bodies": {"materials": "steel,copper"}, "plastic": {"hardness": "1.5 GPa", "after": "2 mN"}},
    {"bodies": {"modulus": "57.5 GPa"}, "plastic": {"hardness": "2GPa", "flow": "raised"}},
    {"bodies": {"young": "210GPa", "poisson": "0.3"}},
    {"bodies": {"young": "210GPa", "poisson": "0.3", "young2": "70 GPa", "poisson2": "0.33"}},
]
READINGS = [
    {"unit": "nm", "size": "96um"},
    {"unit": "1e-9", "size": "48um x 96 um", "periodic": True},
]
STEEL = {"bodies": {"materials": "steel,aluminium"}}


def check(source, preparation, parts, file="part.npz"):
    """Compare the numbers of the page with those of the commands and of the program that it states."""
    plain = {
        "job": "press",
        "source": source,
        "preparation": preparation,
        "load": {"force": "1.23 mN"},
        **parts,
    }
    request = PageRequest.of(plain, {"key": UploadedFile(Path(file).resolve(), file)}, {})
    shown = SessionCache().solution(request.job)
    space = {}
    exec(request.statement["python"], space)
    assert np.array_equal(space["solution"].pressure, shown.pressure)
    for line in request.statement["command"].splitlines():
        result = CliRunner().invoke(app, [*shlex.split(line)[1:], "--json"])
        assert result.exit_code == 0, result.stderr
    record = json.loads(result.stdout)
    assert (record["force"], record["depth"], record["contact_area"]) == (
        shown.force,
        shown.depth,
        shown.contact_area,
    )


@pytest.fixture
def part(tmp_path, monkeypatch):
    """Write a measured surface into a folder of its own, and go there."""
    monkeypatch.chdir(tmp_path)
    grid = rc.Grid((48, 48), 1e-6)
    rc.write(rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(2)), tmp_path / "part.npz")
    return {"kind": "file", "file": "key"}


@pytest.mark.parametrize("preparation", PREPARATIONS, ids=str)
@pytest.mark.parametrize("made", [True, False], ids=["made", "file"])
def test_command_and_python_give_the_same_numbers(made, preparation, part):
    source = part
    if made:
        source = {"kind": "self-affine", "hurst": "0.8", "rms": "0.1um", "size": "48um", "points": "48"}
    check(source, preparation, STEEL)


@pytest.mark.parametrize("parts", BODIES, ids=str)
def test_bodies_are_stated(parts, part):
    check(part, {}, parts)


@pytest.mark.parametrize("reading", READINGS, ids=str)
def test_what_a_file_leaves_open_is_stated(reading, part):
    np.save("heights.npy", 1e9 * rc.read("part.npz").heights)
    check({**part, **reading}, {}, {"bodies": {"modulus": "100GPa"}}, "heights.npy")


@pytest.mark.parametrize("shape", [(4096, 4096), (1023, 517), (7, 1025), (64, 64)])
def test_a_reduced_map_fits_the_screen_and_loses_no_peak(shape):
    """Peaks of one cell, wherever they are; the lowest of a gap likewise."""
    rng = np.random.default_rng(sum(shape))
    field = rng.normal(size=shape)
    for _ in range(5):
        place = tuple(rng.integers(shape))
        field[place] = 1e3
        factor = factor_for(shape, 256)
        seen = as_seen(field, factor)
        assert max(seen.shape) <= 256
        assert seen[place[0] // factor, place[1] // factor] == 1e3 == seen.max()
        assert as_seen(-field, factor, lowest=True).min() == -1e3
        field[place] = 0.0


def test_a_reduced_map_keeps_its_highest_points_and_what_is_missing():
    field = np.arange(30.0).reshape(5, 6)
    field[4, 4:] = np.nan
    assert np.array_equal(as_seen(field, 2), [[7, 9, 11], [19, 21, 23], [25, 27, np.nan]], equal_nan=True)
    assert np.array_equal(as_seen(field, 2, lowest=True)[0], [0, 2, 4])
