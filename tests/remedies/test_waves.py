"""What is refused of random surfaces, spectra and parameters: the message is followed, and the numbers are there."""

import numpy as np
import pytest

import roughcontact as rc
from followed import (
    LARGE,
    LINE,
    PLANE,
    PROFILE,
    ROUGH,
    ROUND,
    VALUES,
    each,
    follow,
    heights,
    holed,
    made,
    midpoints,
    rng,
    row,
)

WAVES = [
    row(
        lambda: made(hurst=5),
        "hurst must lie between -1 and 3, not 5",
        *each(lambda h: made(hurst=h), -0.9, 2.9),
    ),
    row(lambda: made(rms=-1), "rms must be positive and finite [m], not -1", made),
    row(
        lambda: made(rolloff=-1),
        "rolloff must be positive and finite [m], not -1",
        lambda: made(rolloff=8e-6),
    ),
    row(
        lambda: made(short_cutoff=8e-6, long_cutoff=4e-6),
        "short_cutoff 8e-06 m exceeds long_cutoff 4e-06 m: no wave is left",
        lambda: made(short_cutoff=4e-6, long_cutoff=8e-6),
    ),
    row(
        lambda: made(long_cutoff=1e-7),
        "widen the limits, or take a grid with waves between them",
        lambda: made(long_cutoff=1e-5),
        lambda: made(rc.Grid((16, 16), 1e-8), long_cutoff=1e-7),
    ),
    row(
        lambda: made(rms_band=(1e-5, 1e-7)),
        "only waves longer than 2e-06 m: end the band above two cells of the coarsest grid",
        lambda: made(rms_band=(1e-5, 2.1e-6)),
    ),
    row(
        lambda: made(rms_band=(4e-6, 9e-6)),
        "must begin with the longest",
        lambda: made(rms_band=(9e-6, 4e-6)),
    ),
    row(
        lambda: made(rms_band=(1e-3, 9e-4)),
        "of the spectrum lies in rms_band (0.001, 0.0009) m: widen it",
        lambda: made(rms_band=(1e-3, 3e-6)),
    ),
    row(
        lambda: made(amplitudes="equal"),
        "amplitudes must be 'exact' or 'gaussian'",
        *each(lambda kind: made(amplitudes=kind), "exact", "gaussian"),
    ),
    row(
        lambda: made(support="ring"),
        "support must be 'square' or 'disc'",
        *each(lambda kind: made(support=kind), "square", "disc"),
    ),
    row(lambda: made(anisotropy=3), "must be two numbers (ratio, angle)", lambda: made(anisotropy=(3, 0.1))),
    row(
        lambda: made(anisotropy=(0, 0)),
        "ratio of an anisotropy must be positive",
        lambda: made(anisotropy=(2, 0)),
    ),
    row(
        lambda: made(LINE, anisotropy=(2, 0)),
        "a line has no direction: omit the anisotropy, or make a surface (dimension=2)",
        lambda: made(LINE),
        lambda: made(PLANE, anisotropy=(2, 0)),
    ),
    row(
        lambda: rc.synthesise(PLANE, rc.SelfAffineSpectrum(0.8, 1e-18, dimension=1), rng()),
        "the spectrum has dimension 1, but the grid 2 axes: make it with dimension=2",
        lambda: rc.synthesise(PLANE, rc.SelfAffineSpectrum(0.8, 1e-18, dimension=2), rng()),
    ),
    row(
        lambda: rc.synthesise(PLANE, lambda q: -q, rng()),
        "must be finite and not negative at every wave of the grid except q = 0",
        lambda: rc.synthesise(PLANE, lambda q: q, rng()),
    ),
    row(
        lambda: midpoints(PLANE),
        "a square of (2^n + 1, 2^n + 1) nodes, for example 17",
        lambda: midpoints(rc.Grid((17, 17), 1e-6)),
    ),
    row(
        lambda: midpoints(rms=None),
        "give either displacement (of the first level) or rms [m]",
        lambda: midpoints(rms=1e-7),
        lambda: midpoints(rms=None, displacement=1e-7),
    ),
    row(
        lambda: midpoints(hurst=1.8),
        "between 0 and 1 for midpoints, not 1.8: self_affine takes -1 to 3",
        lambda: midpoints(hurst=0.9),
        lambda: made(hurst=1.8),
    ),
    row(
        lambda: midpoints(rc.Grid((17, 17), 1e-6, periodic=True)),
        "cannot be periodic: use Grid(..., periodic=False)",
        lambda: midpoints(rc.Grid((17, 17), 1e-6, periodic=False)),
    ),
    row(
        lambda: rc.shapes.sphere(PLANE, radius=1e-10),
        "no cell centre lies in the sphere, radius 1e-10 m: refine the grid or move the centre",
        lambda: rc.shapes.sphere(rc.Grid((16, 16), 1e-11), radius=1e-10),
        lambda: rc.shapes.sphere(PLANE, radius=1e-10, centre=(0.5e-6, 0.5e-6)),
    ),
    row(
        lambda: rc.shapes.sphere(PLANE, radius=1.0, centre=(1,)),
        "centre needs 2 finite coordinates [m], not (1,)",
        lambda: rc.shapes.sphere(PLANE, radius=1.0, centre=(8e-6, 8e-6)),
    ),
    row(
        lambda: rc.shapes.wave(ROUND, amplitude=1e-7, wavelength=1e-5),
        "waves do not fit a periodic length of 1.6e-05 m: take a whole number",
        lambda: rc.shapes.wave(ROUND, amplitude=1e-7, wavelength=8e-6),
    ),
]

MEASURED = [
    row(
        lambda: rc.power_spectrum(holed()),
        "2 are missing: fill them or crop the surface first, or use the structure function, which ignores missing",
        lambda: rc.power_spectrum(holed().filled()),
        lambda: rc.power_spectrum(holed().cropped(slice(4, 16), slice(0, 16))),
        lambda: rc.structure_function(holed()),
    ),
    row(
        lambda: rc.surface_moments(holed(), derivative="spectral"),
        "use derivative='difference' or fill them first",
        lambda: rc.surface_moments(holed(), derivative="difference"),
        lambda: rc.surface_moments(holed().filled(), derivative="spectral"),
    ),
    row(
        lambda: rc.power_spectrum(ROUGH, level="tilt"),
        "level must be 'auto', 'none', 'mean' or 'plane'",
        *each(lambda level: rc.power_spectrum(ROUGH, level=level), "auto", "none", "mean", "plane"),
    ),
    row(
        lambda: rc.power_spectrum(PROFILE, direction="y"),
        "a line has profiles along 'x' only",
        lambda: rc.power_spectrum(PROFILE, direction="x"),
    ),
    row(
        lambda: rc.profile_parameters(ROUGH),
        "need a line, not shape (16, 16): take a row or column of the surface",
        *each(
            lambda line: rc.profile_parameters(rc.Surface(line, rc.Grid(16, 1e-6))), VALUES[3], VALUES[:, 3]
        ),
    ),
    row(
        lambda: rc.profile_parameters(PROFILE, section_length=1.0),
        "all together 7: give a section_length of 2e-06 m to 3.2e-05 m, or a longer profile",
        *each(lambda length: rc.profile_parameters(PROFILE, section_length=length), 2e-6, 3.2e-5),
        lambda: rc.profile_parameters(heights(rc.Grid(64, 0.25)), section_length=1.0),
    ),
    row(
        lambda: rc.profile_parameters(
            rc.Surface(np.where(PROFILE.heights > 1e-7, np.nan, PROFILE.heights), LINE)
        ),
        "points are missing, and sections need all their points: fill them first",
        lambda: rc.profile_parameters(
            rc.Surface(np.where(PROFILE.heights > 1e-7, np.nan, PROFILE.heights), LINE).filled()
        ),
    ),
    row(
        lambda: rc.fit_structure(ROUGH),
        "needs a surface of at least 32 x 32 points",
        lambda: rc.fit_structure(heights(rc.Grid((64, 64), 1e-6))),
    ),
    row(
        lambda: rc.box_counting_dimension(ROUGH),
        "at least 65 points along each axis",
        lambda: rc.box_counting_dimension(LARGE),
    ),
    row(
        lambda: rc.spectrum_moments(rc.power_spectrum(ROUGH), q_min=1, q_max=2),
        "no wave lies between 1 and 2 rad/m: the spectrum has 467001 to 3.02865e+06 rad/m",
        lambda: rc.spectrum_moments(rc.power_spectrum(ROUGH), q_min=467001, q_max=3.02865e6),
    ),
    row(
        lambda: rc.merge_spectra([rc.power_spectrum(ROUGH), rc.power_spectrum(PROFILE)]),
        "of surfaces (C2D) and of profiles (C1D) cannot be merged: see surface_spectrum",
        lambda: rc.merge_spectra(
            [rc.power_spectrum(ROUGH), rc.surface_spectrum(rc.power_spectrum(PROFILE), hurst=0.8)]
        ),
    ),
    row(
        lambda: rc.surface_spectrum(rc.power_spectrum(PROFILE), method="cut"),
        "method must be 'law' or 'abel'",
        lambda: rc.surface_spectrum(rc.power_spectrum(PROFILE), hurst=0.8, method="law"),
        lambda: rc.surface_spectrum(rc.power_spectrum(ROUGH, direction="x"), method="abel"),
    ),
    row(
        lambda: rc.spectrum_moments(rc.SelfAffineSpectrum(0.8, 1e-3, short_cutoff=1e-5)),
        "for a spectrum by formula use its moments(), or rc.grid_moments(grid, spectrum)",
        lambda: rc.SelfAffineSpectrum(0.8, 1e-3, short_cutoff=1e-5).moments(),
        lambda: rc.grid_moments(PLANE, rc.SelfAffineSpectrum(0.8, 1e-3, short_cutoff=1e-5)),
        lambda: rc.spectrum_moments(rc.power_spectrum(ROUGH)),
    ),
    row(
        lambda: rc.height_histogram(ROUGH, bins=0),
        "bins must be a positive whole number",
        lambda: rc.height_histogram(ROUGH, bins=1),
    ),
    row(
        lambda: rc.structure_profile(PROFILE, direction="y"),
        "direction must be 'x', or 'y' on a surface",
        lambda: rc.structure_profile(PROFILE, direction="x"),
        lambda: rc.structure_profile(ROUGH, direction="y"),
    ),
    row(
        lambda: rc.stratified_parameters(rc.Surface(VALUES[:3, :3], rc.Grid((3, 3), 1e-6))),
        "needs ten heights, not 9",
        lambda: rc.stratified_parameters(ROUGH),
    ),
]


@pytest.mark.parametrize("refusal", WAVES)
def test_waves(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", MEASURED)
def test_parameters(refusal):
    follow(refusal)
