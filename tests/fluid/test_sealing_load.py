"""The load at which the open cells cease to percolate."""

import math

import numpy as np
import pytest

import roughcontact as rc


def rough(n=32, seed=3, periodic=True):
    grid, rng = rc.Grid((n, n), 1 / n, periodic=True), np.random.default_rng(seed)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=rng, rolloff=0.25, short_cutoff=1 / 8)
    return surface if periodic else rc.Surface(surface.heights, rc.Grid((n, n), 1 / n))


def ridges(n=32, along=(1, 1)):
    """A wave of amplitude 0.01 with the given periods along both axes of a unit square."""
    i, j = np.indices((n, n))
    phase = 2 * math.pi * (along[0] * i + along[1] * j) / n
    return rc.Surface(0.01 * np.cos(phase), rc.Grid((n, n), 1 / n, periodic=True))


@pytest.mark.parametrize(("periodic", "axis"), [(True, None), (True, 0), (True, 1), (False, 0), (False, 1)])
def test_as_a_scan_of_all_loads_finds_it(periodic, axis):
    """The scan sees one change, from open to closed, within its step and the ratio of the search."""
    surface = rough(periodic=periodic)
    found = rc.sealing_load(surface, 1.0, axis=axis)
    step = 1.02
    pressures = 0.03 * step ** np.arange(70)
    leads = []
    for solution in rc.loading_path(surface, 1.0, pressures=pressures):
        flow = rc.gap_flow(solution, axis=None if periodic else axis)
        leads.append(flow.windings[:, axis].any() if periodic and axis is not None else flow.percolates)
    last = int(np.count_nonzero(leads)) - 1
    assert all(leads[: last + 1])
    assert not any(leads[last + 1 :])
    low, high = found.pressures
    assert low < high <= 1.01 * low * (1 + 1e-9)
    assert low <= pressures[last + 1]
    assert high >= pressures[last]
    assert found.contact_fractions[0] <= found.contact_fractions[1]
    assert 0.3 < found.contact_fractions[0] < 0.6
    assert found.constriction.cells < 4
    assert found.constriction.share > 0.5
    assert "A/A0 0." in repr(found)


def test_in_any_direction_it_is_the_larger_load_of_both_axes():
    """A smaller ratio narrows the interval."""
    surface = rough()
    both = [rc.sealing_load(surface, 1.0, axis=axis).pressures[0] for axis in (0, 1)]
    assert rc.sealing_load(surface, 1.0).pressures[0] == pytest.approx(max(both), rel=0.01)
    fine = rc.sealing_load(surface, 1.0, ratio=1e-4)
    assert fine.pressures[1] <= 1.0001 * fine.pressures[0] * (1 + 1e-9)


def test_a_diagonal_channel_leads_along_both_axes():
    """It stays open until the wave lies flat: at pi E* (amplitude)/(wavelength), to the cells of the trough."""
    flat = math.pi * 0.01 * math.sqrt(2)
    for axis in (None, 0, 1):
        found = rc.sealing_load(ridges(), 1.0, axis=axis)
        assert np.abs(found.last_open.windings).tolist() == [[1, 1]]
        assert 0.8 * flat < found.pressures[0] < flat
    straight = ridges(along=(2, 0))
    assert rc.sealing_load(straight, 1.0, axis=1).pressures[1] == pytest.approx(2 * math.pi * 0.01, rel=0.1)
    with pytest.raises(rc.InputError, match="even at first touch") as caught:
        rc.sealing_load(straight, 1.0, axis=0)
    assert "the other axis" in caught.value.remedy


def test_it_scales_with_the_modulus_and_grows_with_roughness():
    surface = rough()
    soft, stiff = (rc.sealing_load(surface, each).pressures[0] for each in (1.0, 5.0))
    assert stiff == pytest.approx(5 * soft, rel=1e-6)
    twice = rc.Surface(2 * surface.heights, surface.grid)
    assert rc.sealing_load(twice, 1.0).pressures[0] == pytest.approx(2 * soft, rel=1e-6)
    yielding = rc.sealing_load(surface, 1.0, hardness=0.1)
    assert yielding.pressures[1] < soft  # cells that yield close more area
    assert yielding.last_open.solution.plastic.any()
    assert rc.sealing_load(surface, 1.0, hardness=1e-3).pressures[1] < 1e-3


def test_missing_cells():
    heights = rough(periodic=False).heights.copy()
    heights[15:17] = np.nan  # a ditch across
    surface = rc.Surface(heights, rc.Grid((32, 32), 1 / 32))
    assert rc.sealing_load(surface, 1.0, axis=0, missing="open").pressures[0] > 0.01
    for axis, missing, remedy in ((0, "closed", "open"), (1, "open", "closed")):
        with pytest.raises(rc.InputError, match="path") as caught:
            rc.sealing_load(surface, 1.0, axis=axis, missing=missing)
        assert f"missing='{remedy}'" in caught.value.remedy
        rc.sealing_load(surface, 1.0, axis=axis, missing=remedy)


def test_what_is_refused():
    line = rc.Surface(np.cos(np.linspace(0, 6, 32)), rc.Grid((32,), 1.0))
    ring = rc.RadialProfile(-(np.linspace(0, 1, 32) ** 2), rc.RadialGrid.uniform(32, 0.03))
    for surface, operator in ((line, rc.line(line.grid, 1.0)), (ring, None)):
        with pytest.raises(rc.InputError, match=r"a map of heights|must be a Surface"):
            rc.sealing_load(surface, 1.0, operator=operator)
    with pytest.raises(rc.InputError, match="direction of the flow"):
        rc.sealing_load(rough(periodic=False), 1.0)
    with pytest.raises(rc.InputError, match="axis"):
        rc.sealing_load(rough(), 1.0, axis=2)
    with pytest.raises(rc.InputError, match="ratio"):
        rc.sealing_load(rough(), 1.0, ratio=0.0)
    flat = rc.Surface(np.zeros((8, 8)), rc.Grid((8, 8), 1.0, periodic=True))
    with pytest.raises(rc.InputError, match="first touch"):
        rc.sealing_load(flat, 1.0)
