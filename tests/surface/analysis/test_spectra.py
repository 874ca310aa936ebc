import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.analysis.power_map import power_map
from roughcontact.surface.analysis.spectra import power_spectrum


def noise(shape, spacing=(0.5, 0.25), periodic=True, seed=0):
    grid = rc.Grid(shape, spacing, periodic)
    return rc.Surface(np.random.default_rng(seed).standard_normal(shape), grid)


@pytest.mark.parametrize("shape", [(16, 24), (15, 24), (16, 25)])
def test_rings_are_averages_over_the_whole_plane(shape):
    surface = noise(shape)
    qy, qx, density = power_map(surface).centred()
    rings = power_spectrum(surface)
    step = min(2 * math.pi / length for length in surface.grid.lengths)
    limit = math.pi / 0.5
    found = {}
    for i, b in enumerate(qy):
        for j, a in enumerate(qx):
            q = math.hypot(a, b)
            if 0 < q < limit * (1 - 1e-9):
                found.setdefault(int(q / step + 0.5), []).append((math.log(q), density[i, j]))
    rows = [np.mean(found[k], axis=0) for k in sorted(found)]
    np.testing.assert_allclose(rings.wavenumber, np.exp([row[0] for row in rows]), rtol=1e-12)
    np.testing.assert_allclose(rings.density, [row[1] for row in rows], rtol=1e-12)
    np.testing.assert_array_equal(rings.count, [len(found[k]) for k in sorted(found)])
    np.testing.assert_allclose(rings.wavelength * rings.wavenumber, 2 * math.pi)


def test_fine_rings_hold_the_same_waves():
    surface = noise((32, 32), (1.0, 1.0))
    coarse, fine = power_spectrum(surface), power_spectrum(surface, per_decade=100)
    assert fine.count.sum() == coarse.count.sum()
    assert fine.density @ fine.count == pytest.approx(coarse.density @ coarse.count, rel=1e-12)


@pytest.mark.parametrize(("axis", "direction"), [(1, "x"), (0, "y")])
def test_profiles_of_a_periodic_surface_are_the_cut_of_its_map(axis, direction):
    """C1D(qx) is the integral of C2D over qy, wave by wave."""
    surface = noise((16, 24))
    qy, qx, density = power_map(surface).centred()
    steps = (qy[1] - qy[0], qx[1] - qx[0])
    along = (qy, qx)[axis]
    cut = density.sum(axis=1 - axis) * steps[1 - axis]
    spectrum = power_spectrum(surface, direction)
    inside = (along > 1e-9) & (along < spectrum.q_max * (1 - 1e-9))
    np.testing.assert_allclose(spectrum.wavenumber, along[inside], rtol=1e-12)
    np.testing.assert_allclose(spectrum.density, cut[inside], rtol=1e-12)
    assert spectrum.kind == "C1D"


def test_a_line_is_its_own_transform():
    heights = np.random.default_rng(1).standard_normal(41)
    line = rc.Surface(heights, rc.Grid(41, 0.1, True))
    spectrum = power_spectrum(line)
    x = np.arange(41)
    for k, q in enumerate(spectrum.wavenumber, start=1):
        amplitude = (heights * np.exp(-2j * np.pi * k * x / 41)).sum() / 41
        assert spectrum.density[k - 1] == pytest.approx(abs(amplitude) ** 2 * 4.1 / (2 * np.pi), rel=1e-12)
        assert q == pytest.approx(2 * np.pi * k / 4.1)
    # Parseval, both signs: <h^2> = 2 sum C1D dq.
    assert 2 * spectrum.density.sum() * 2 * np.pi / 4.1 == pytest.approx(heights.var(), rel=1e-12)
    assert (spectrum.freedom == 1).all()


def test_profiles_that_resemble_each_other_count_once():
    row = np.random.default_rng(0).standard_normal(64)
    grid = rc.Grid((50, 64), 1.0, True)
    same = power_spectrum(rc.Surface(np.tile(row, (50, 1)), grid), "x")
    np.testing.assert_allclose(same.freedom, 1, rtol=1e-9)
    other = power_spectrum(noise((50, 64), (1.0, 1.0)), "x")
    # The mean of an estimate of 50 that scatters by sqrt(1/50) or so for each of 31 waves.
    assert other.freedom.mean() == pytest.approx(50, rel=0.15)


def test_bands_begin_where_windows_no_longer_matter():
    surface = noise((64, 64), (1.0, 1.0))
    assert power_spectrum(surface).q_min == pytest.approx(2 * math.pi / 64)
    free = rc.Surface(surface.heights, rc.Grid((64, 64), 1.0))
    windowed = power_spectrum(free)
    assert windowed.q_min == pytest.approx(3 * 2 * math.pi / 64)
    assert windowed.within().wavenumber[0] >= windowed.q_min
    np.testing.assert_allclose(windowed.freedom * 2 * (35 / 18) ** 2, windowed.count, rtol=1e-12)


def test_rebinning_keeps_freedom_and_power():
    spectrum = power_spectrum(noise((64, 64), (1.0, 1.0)))
    coarse = spectrum.rebinned(5)
    assert coarse.freedom.sum() == pytest.approx(spectrum.freedom.sum(), rel=1e-12)
    assert coarse.freedom @ coarse.density == pytest.approx(spectrum.freedom @ spectrum.density, rel=1e-12)
    assert coarse.wavenumber.size < spectrum.wavenumber.size


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"wavenumber": [2.0, 1.0]}, "increase"),
        ({"density": [1.0, -1.0]}, "negative"),
        ({"freedom": [1.0, 0.0]}, "freedom"),
        ({"count": [1.0]}, "one value for each"),
        ({"kind": "C3D"}, "kind must be"),
    ],
)
def test_nonsense_is_no_spectrum(change, message):
    good = {"wavenumber": [1.0, 2.0], "density": [1.0, 1.0], "count": [2.0, 2.0], "freedom": [1.0, 1.0]}
    fields = {**good, "kind": "C2D", "q_min": 1.0, "q_max": 2.0, **change}
    with pytest.raises(ValueError, match=message):
        PowerSpectrum(**fields)


def test_unknown_directions_and_bands_are_refused():
    surface = noise((16, 16))
    with pytest.raises(ValueError, match="direction must be"):
        power_spectrum(surface, "z")
    with pytest.raises(ValueError, match="a line has profiles"):
        power_spectrum(rc.Surface(np.arange(9.0), rc.Grid(9, 1.0)), "ring")
    with pytest.raises(ValueError, match="no wave lies between"):
        power_spectrum(surface).within(1e6, 2e6)
    with pytest.raises(ValueError, match="per_decade"):
        power_spectrum(surface, per_decade=0)
