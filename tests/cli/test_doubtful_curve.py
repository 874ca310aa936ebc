"""The command says in its first line what makes a curve doubtful; its notes name the mask that takes far points out."""

import json
import re

import numpy as np
import pytest

import roughcontact as rc

LOADS = ["--level", "none", "--modulus", "1GPa", "--forces", "1mN:10mN:6"]
GRID = rc.Grid((128, 128), 1e-6)
SAME = "The contact does not change from 1 mN to 10 mN: the same 4 spots"


@pytest.fixture
def streaked(tmp_path):
    """Return the file of a rough map with four streaks, each five lines wide, which are not looked for as such."""
    heights = rc.self_affine(GRID, 0.8, 1e-7, np.random.default_rng(3)).heights.copy()
    for row in (20, 50, 80, 110):
        heights[row : row + 5, 30:40] = 5e-6
    heights[80, 30] += 1e-13  # the highest value, repeated and far from all others, would pass for a mark
    rc.write(rc.Surface(heights, GRID), tmp_path / "part.npz")
    return tmp_path / "part.npz"


def test_doubts_stand_in_the_first_line_and_the_mask_that_is_named_removes_them(invoke, streaked):
    before = invoke("curve", streaked, *LOADS)
    assert before.exit_code == 0, before.stderr
    first = before.stdout.splitlines()[0]
    assert first.startswith(f"doubtful             {SAME}")
    assert "'surface prepare --despike' or 'surface prepare --mask'" in first
    [mask] = re.findall(r"200 points stand .* remove them by --mask (above=\S+um)\.", before.stderr)
    after = invoke("curve", streaked, "--mask", mask, *LOADS)
    assert after.exit_code == 0, after.stderr
    assert after.stdout.startswith("surface ")
    assert "rms heights above" not in after.stderr


def test_doubts_stand_in_the_record(invoke, streaked):
    record = json.loads(invoke("curve", streaked, "--json", *LOADS).stdout)
    assert record["doubtful"][0].startswith(SAME)
    assert any("masked(above=" in note for note in record["notes"])


def test_info_names_the_masks_above_and_below_that_remove_what_is_far(invoke, streaked, tmp_path):
    heights = rc.read(streaked).heights.copy()
    heights[60:66, 90:100] = -9e-6
    rc.write(rc.Surface(heights, GRID), tmp_path / "two.npz")
    lines = json.loads(invoke("surface", "info", tmp_path / "two.npz", "--json").stdout)["suspicious"]
    found = [re.search(r"--level plane --mask (\S+)$", line)[1] for line in lines if "points far" in line]
    assert [mask.partition("=")[0] for mask in found] == ["below", "above"]
    options = ["--level", "plane", *(word for mask in found for word in ("--mask", mask))]
    clean = tmp_path / "clean.npz"
    assert invoke("surface", "prepare", tmp_path / "two.npz", clean, *options).exit_code == 0
    assert rc.read(clean).missing == 60 + 200
    again = json.loads(invoke("surface", "info", clean, "--json").stdout)["suspicious"]
    assert not any("points far" in line for line in again)
