"""The ensembles of the law: their study files."""

import tomllib
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from roughcontact.study.study import Study

ROOT = Path(__file__).parent.parent
FILES = sorted((ROOT / "examples" / "law").glob("*.toml"))


def study(name):
    return Study.read(ROOT / "examples" / "law" / f"{name}.toml")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_study_file_is_one_of_its_name_that_its_case_takes(path):
    assert Study.read(path).name == path.stem
    assert Study.read(path).combinations()
    assert path.read_text(encoding="utf-8").startswith("# E")


def test_every_ensemble_is_there():
    assert {path.name[:2] for path in FILES} == {f"e{number}" for number in range(1, 8)}


def test_surfaces_that_are_compared_are_the_same_draw():
    assert {tomllib.loads(path.read_text(encoding="utf-8"))["seed"] for path in FILES} == {27}


@pytest.mark.parametrize("name", ["e2-grids", "e3-modes", "e7-sizes"])
def test_waves_of_a_nested_ensemble_have_one_amplitude_on_every_grid(name):
    """The common band of two grids of one surface is the same heights, on the cells that both have in common."""
    wide = [each for each in study(name).combinations() if each.short_cutoff is None]
    lowest = min(each.hurst for each in wide)
    grids = sorted((each for each in wide if each.hurst == lowest), key=lambda each: each.points)
    for coarse, fine in pairwise(grids):
        both = [waves(each) for each in (coarse, fine)]
        # Of the rms height, which is that of about a thousand waves: what rounding leaves of each.
        np.testing.assert_allclose(*both, atol=1e-12 * coarse.rms)


def waves(parameters, highest=20):
    """Return the complex amplitudes of the longest waves, their phases counted from the outer corner."""
    heights = parameters.roughness(np.random.default_rng(3)).heights
    n = parameters.points
    kept = np.fft.fft2(heights)[: highest + 1, : highest + 1] / n**2
    turn = np.exp(-1j * np.pi * np.arange(highest + 1) / n)  # half a cell
    return kept * np.outer(turn, turn)
