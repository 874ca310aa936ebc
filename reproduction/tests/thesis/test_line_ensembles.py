"""Averages and power laws of rough lines."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.lines.line_curves import LineCurves
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.statistics.fit_window import force_window
from roughcontact.study.study import Study
from roughcontact.theory.springs import gaussian_heights
from roughcontact_thesis.ensembles import HURST as SQUARES
from roughcontact_thesis.line_ensembles import (
    HURST,
    each_line,
    line_averages,
    line_fits,
    line_studies,
    line_study,
    resolution_exponent,
    white_exponent,
)
from thesis.computed import exported

TABLE = {"points": [128, 512], "hurst": [0.4, 1.2]}


@pytest.fixture(scope="module")
def lines():
    return exported(Study(name="few", case="lines", samples=3, parameters={"lines": 20}, table=TABLE))


def test_the_study_is_that_of_the_thesis():
    [study] = line_studies("thesis")
    assert study.samples * study.parameters["lines"] == 1000
    assert study.table["points"] == (2**9, 2**11, 2**13)
    hurst, squares = (each.values(float) for each in (HURST, SQUARES))
    # Bit for bit: figures take lines and surfaces of one Hurst exponent.
    assert hurst[-24:] == squares
    [small] = line_studies("small")
    assert small.samples * small.parameters["lines"] == 200
    assert small.name != study.name


def test_every_line_is_a_sample(lines):
    every = each_line(lines)
    assert every["dimensionless_stiffness"].sizes == {"points": 2, "hurst": 2, "load": 97, "sample": 60}
    one = lines["dimensionless_stiffness"].isel(sample=2, line=7, points=1, hurst=0)
    np.testing.assert_array_equal(every["dimensionless_stiffness"].isel(sample=47, points=1, hurst=0), one)


def test_averages_and_fits_are_those_of_the_lines_pressed_together(lines):
    means, fits = line_averages(lines), line_fits(lines)
    grid, spectrum = rc.Grid(512, 1 / 512, periodic=True), rc.SelfAffineSpectrum(1.2, dimension=1)
    batches = []
    for sample in range(3):
        rng = np.random.default_rng(np.random.SeedSequence(0, spawn_key=(sample,)))
        batches += rough_lines(grid, spectrum, rng, 20, rms=1.0)
    forces = lines["dimensionless_force"].to_numpy()
    curves = LineCurves.joined(loading_curves(h, 1 / 512, 1.0, forces=forces) for h in batches)
    law = curves.fit()
    one, mean = fits.sel(points=512, hurst=1.2), means.sel(points=512, hurst=1.2)
    np.testing.assert_allclose(mean["stiffness"], curves.mean_stiffness(), rtol=1e-12)
    np.testing.assert_allclose(mean["scatter"], curves.scatter, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(
        mean["stiffness_error"], curves.stiffness.std(axis=0, ddof=1) / np.sqrt(60), rtol=1e-9, atol=1e-15
    )
    assert means.attrs["lines"] == 60
    # The rms height of the lines is one to rounding, which moves no force over the border of the window.
    assert float(one["exponent"]) == pytest.approx(law.exponent, rel=1e-9)
    assert float(one["prefactor"]) == pytest.approx(law.prefactor, rel=1e-9)
    assert float(one["exponent_sandwich_error"]) == pytest.approx(law.exponent_error, rel=1e-9)
    assert (int(one["count"]), int(one["samples"])) == (law.law.count, 60)
    geometric = line_fits(lines, mean="geometric").sel(points=512, hurst=1.2)
    assert float(geometric["exponent"]) == pytest.approx(curves.fit("geometric").exponent, rel=1e-9)
    window = line_fits(lines, window=force_window(0.01, 0.07))
    assert float(window["window_low"].min()) >= 0.01


def test_white_heights_are_fitted_in_the_same_windows(lines):
    fits = line_fits(lines)
    found = white_exponent(lines["dimensionless_force"], fits)
    forces = lines["dimensionless_force"].to_numpy()
    for points in (128, 512):
        for hurst in (0.4, 1.2):
            fit = fits.sel(points=points, hurst=hurst)
            inside = (forces > fit["window_low"].item() * 0.999) & (
                forces < fit["window_high"].item() * 1.001
            )
            # Fewer than three forces: no window, no fit.
            if fit["count"] < 3:
                assert np.isnan(found.sel(points=points, hurst=hurst))
                continue
            assert inside.sum() == fit["count"]
            k = gaussian_heights.stiffness(forces[inside], 1, 1, 1)
            slope = np.polyfit(np.log(forces[inside]), np.log(k), 1)[0]
            assert float(found.sel(points=points, hurst=hurst)) == pytest.approx(slope, rel=1e-9)


def test_lines_of_white_heights_have_its_exponent():
    forces = {"lowest_force": 1e-3, "highest_force": 0.07, "loads": 20}
    study = line_study("white", "thesis", {"points": [2**12]}, lines=200, hurst=-1.0, **forces)
    lines = exported(study)
    fits = line_fits(lines)
    white = white_exponent(lines["dimensionless_force"], fits)
    # The mean over lines at a force is above the law by about half a spring over those in contact, 3 % at twenty: over
    # the window, of a factor of forty in stiffness, 0.03/ln(40) in the exponent.
    difference = float((fits["exponent"] - white).squeeze())
    assert abs(difference) < 0.03 / np.log(40) + 3 * float(fits["exponent_error"].squeeze())
    assert float(fits["window_low"].squeeze()) < 4e-3


def test_the_exponent_of_a_number_of_points_is_eq_4_73():
    # beta = -1/2 + log2(N)/2, alpha = (beta + 1)/(beta + 2).
    for n in (1, 2, 512, 2**13):
        beta = -0.5 + 0.5 * np.log2(n)
        assert resolution_exponent(n) == pytest.approx((beta + 1) / (beta + 2), rel=1e-15)
