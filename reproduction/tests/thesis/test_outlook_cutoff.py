"""The Outlook's shortest waves and grids."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact.study.study import Study
from roughcontact.theory.persson_theory import persson
from roughcontact_thesis import outlook_cutoff
from roughcontact_thesis.averaging import rms_heights
from roughcontact_thesis.figures import drawn, verdicts
from thesis.computed import exported

ROWS = [(16, 1 / 4), (32, 1 / 4), (32, 1 / 8)]


@pytest.fixture(scope="module")
def export():
    [study] = outlook_cutoff.studies("small")
    parameters = study.parameters | {"loads": 8}
    rows = [{"points": points, "short_cutoff": shortest} for points, shortest in ROWS]
    table = {"hurst": (0.2, 0.7)}
    given = {"samples": 2, "parameters": parameters, "rows": rows, "table": table}
    return exported(Study(**(dict(study) | given)), seconds=True)


@pytest.fixture(scope="module")
def found(export):
    return outlook_cutoff.averages(export)


def heights(hurst, shortest):
    """Return the surface with all waves, and how it looks without the short ones."""
    rng = np.random.default_rng(np.random.SeedSequence(outlook_cutoff.SEED, spawn_key=(0,)))
    grid = rc.Grid((32, 32), 1 / 32)
    whole = rc.self_affine(grid, hurst, 0.01, rng, short_cutoff=1 / 8)
    q = 2 * np.pi * np.hypot(*np.meshgrid(np.fft.fftfreq(32, 1 / 32), np.fft.fftfreq(32, 1 / 32)))
    waves = np.fft.fft2(whole.heights) * (q <= 2 * np.pi / shortest * (1 + 1e-9))
    return rc.Surface(np.fft.ifft2(waves).real, grid)


@pytest.mark.parametrize("hurst", [0.2, 0.7])
@pytest.mark.parametrize(("waves", "row"), [(4, 1), (8, 2)])
def test_curves_are_those_of_one_surface_without_its_short_waves(export, hurst, waves, row):
    # Rows have one rms height; what belongs to one surface follows by proportion.
    one = export.sel(hurst=hurst, sample=0).isel(row=[0, row])
    every = rms_heights(32, export["hurst"], export["short_cutoff"]).sel(hurst=hurst)
    part = every.isel(row=row) / every.isel(row=-1)
    surface = heights(hurst, 1 / waves)
    assert float(part) == pytest.approx(surface.rms / 0.01, rel=1e-9)
    load = 6
    force = float(one["dimensionless_force"][load] * part) * 0.01
    pressed = rc.press(surface, 1.0, force=force, tolerance=1e-6)
    assert float(one["stiffness"].isel(row=1, load=load)) == pytest.approx(pressed.stiffness, rel=1e-6)
    assert float(one["contact_area"].isel(row=1, load=load)) == pytest.approx(pressed.contact_area, rel=1e-9)


def test_means_stand_at_common_forces_and_changes_are_over_all_waves(found):
    assert set(found["area"].dims) == {"hurst", "force", "points", "waves"}
    assert np.isnan(found["area"].sel(points=16, waves=8)).all()
    for name in ("stiffness_change", "area_change"):
        np.testing.assert_array_equal(found[name].sel(points=32, waves=8), 1.0)
        np.testing.assert_array_equal(found[f"{name}_error"].sel(points=32, waves=8), 0.0)
    # The scale of the heights is not in A E* g/F.
    one = found.sel(points=32)
    pressure = one["force"] * 0.01
    np.testing.assert_allclose(one["spread"], one["area"] * one["slope"] / pressure, rtol=1e-3)
    # Slopes are the roots of sums of squares: shorter waves only add to them.
    assert (one["slope"].sel(waves=8) > one["slope"].sel(waves=4)).all()
    for waves in (4, 8):
        here = one.sel(waves=waves, hurst=0.2)
        moments = rc.Moments(1.0, 0.5 * float(here["slope"]) ** 2, 1.0)
        law = persson.contact_fraction(0.01 * outlook_cutoff.FORCES, 1.0, moments)
        np.testing.assert_allclose(here["persson"], law, rtol=1e-12)


def test_it_is_drawn_and_judged(found):
    few = found.assign_coords(hurst=[0.2, outlook_cutoff.SHOWN])
    FigureCanvasAgg(drawn(outlook_cutoff, few)).draw()
    claims = verdicts(outlook_cutoff, few)
    assert [each.kind for each in claims] == ["claim", "claim", "answer"]
    assert claims[-1].word == "not decided"


def test_the_study_shares_the_waves_of_a_sample_and_gives_each_four_cells():
    for scale, most in (("small", 256), ("thesis", 512)):
        (study,) = outlook_cutoff.studies(scale)
        rows = [(row["points"], round(1 / row["short_cutoff"])) for row in study.rows]
        assert most == rows[-1][0]
        assert rows[-1][1] == max(waves for _, waves in rows) == most // 4
        assert all(points >= 4 * waves for points, waves in rows)
