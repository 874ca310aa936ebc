"""A smooth crest that the border cuts: its stiffness, the mean over all places, and the other solver."""

import sys
from pathlib import Path

import numpy as np
import pytest

BOTH = pytest.mark.parametrize("cut", ["out of a period", "out of a larger surface"])


@pytest.fixture
def script(monkeypatch):
    before = {*sys.modules}
    monkeypatch.syspath_prepend(str(Path(__file__).parents[1] / "benchmarks"))
    import law_cut

    yield law_cut
    for name in {*sys.modules} - before:
        if name.startswith("law_"):
            del sys.modules[name]


def test_a_crest_whose_contact_reaches_the_border_is_whole(script):
    """The pressure ends with a root there, so a force is off by the square of a cell over the contact radius."""
    assert script.piece_force(1.0, 64) == pytest.approx(1, abs=((1 + 2**0.5) / 64) ** 2)


@BOTH
def test_data_are_those_of_coarse_grids_within_their_errors(script, cut):
    """First order: forces on n cells are off by less than a cell, 1/n of the width; extrapolated ones by its square."""
    angles = script.ANGLES[::3]
    x, s = script.curves(angles, 2 * script.forces(32, angles) - script.forces(16, angles))[cut]
    kept = x < 1.35  # further out, every third angle is too coarse
    np.testing.assert_allclose(script.stiffness_ratio(x[kept], cut), s[kept], atol=1 / 16**2)
    assert script.stiffness_ratio(np.array([1.5, 3.0]), cut).tolist() == [1, 1]


def test_halves_of_a_crest_are_two_or_one(script):
    """At x = 0 both halves are equal: k of one grows as the root of the cube of F, and so do two at half of F."""
    two, one = (float(script.stiffness_ratio(np.array(0.0), cut)) for cut in script.CUTS)
    assert two == pytest.approx(2 * one / 2 ** (1 / 3), abs=2e-4)  # four digits, twice


@BOTH
def test_the_integral_is_that_of_the_data(script, cut):
    """Four digits of s over a length of sqrt(2), and straight lines between the rows."""
    rows = (script.DATA / "cut-integral.csv").read_text(encoding="utf-8").splitlines()
    found = float(rows[1 + script.CUTS.index(cut)].split(",")[1].split()[0])
    x = np.linspace(0, 2**0.5, 2000)
    assert script.integral((x, script.stiffness_ratio(x, cut))) == pytest.approx(
        found, abs=5e-5 * 2**0.5 + 1e-4
    )


@BOTH
@pytest.mark.parametrize("place", [0, 0.5, 1, 1.6])
def test_a_map_has_the_stiffness_of_the_pieces(script, cut, place):
    """The number of cells in a disc scatters by n^(1/2) of n^2, and the root of the area by n^(-3/2).

    Pieces at the distance L lower each other in first order by `width`/pi; second order is left.
    """
    width, cells = 1 / 8, 256
    s = float(script.stiffness_ratio(np.array(place), cut))
    if cut == script.PERIOD and place <= 1:
        s = 1 / (1 / s + width / np.pi)
    within = (width * cells) ** -1.5 + (width**2 if cut == script.PERIOD else 0)
    assert script.on_map(width, cells, cut, place) == pytest.approx(s, abs=within)


def test_the_mean_over_all_places_counts_strips_and_corners(script, monkeypatch):
    """If every crest near a border is twice as stiff, the mean grows by the area near the border."""
    monkeypatch.setattr(script, "on_map", lambda *_: 2.0)
    assert script.added(0.1, 64, script.PERIOD) == pytest.approx(1 - (1 - 2 * 2**0.5 * 0.1) ** 2, rel=1e-9)


@BOTH
def test_the_other_solver_finds_half_a_crest(script, cut):
    """Contact regions are the same; then stiffnesses differ by less than the tolerance of a solution."""
    for width in (1 / 4, 1 / 8):
        other = script.by_peer(*script.cut_map(width, 64, cut, 0)) / (2 * width)
        assert script.on_map(width, 64, cut, 0) == pytest.approx(other, rel=1e-8)


def test_the_other_solver_finds_the_stiffness_of_a_member_of_e8(script):
    mine, other = script.member(64)
    assert mine == pytest.approx(other, rel=1e-8)
