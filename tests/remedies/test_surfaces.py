"""What is refused of grids, heights, waves and their preparation: the message is followed, and the surface is there."""

import numpy as np
import pytest

import roughcontact as rc
from followed import (
    INFINITE,
    LARGE,
    ODD,
    PERIODIC,
    PLANE,
    PROFILE,
    ROUGH,
    ROWS,
    VALUES,
    each,
    follow,
    heights,
    holed,
    row,
)

HEIGHTS = [
    row(
        lambda: rc.Grid((4, 4, 4), 1e-6),
        "must have one or two axes, not 3",
        *each(lambda n: rc.Grid(n, 1.0), 4, (4, 4)),
    ),
    row(
        lambda: rc.Grid((0, 16), 1e-6),
        "must hold positive whole numbers of cells",
        lambda: rc.Grid((1, 16), 1e-6),
    ),
    row(
        lambda: rc.Grid((4, 4), 0),
        "spacing must be positive, finite numbers [m]",
        lambda: rc.Grid((4, 4), 1e-6),
    ),
    row(
        lambda: rc.Grid((4, 4), "1um"),
        "positive, finite numbers [m], not ('1um', '1um'): give metres, such as 1e-6",
        lambda: rc.Grid((4, 4), 1e-6),
    ),
    row(
        lambda: rc.Grid((4, 4)),
        "give exactly one of spacing and size: none is given",
        lambda: rc.Grid((4, 4), spacing=1e-6),
        lambda: rc.Grid((4, 4), size=4e-6),
    ),
    row(
        lambda: rc.Grid((4, 4), (1e-6, 1e-6, 1e-6)),
        "spacing needs one value or 2, not 3",
        *each(lambda steps: rc.Grid((4, 4), steps), 1e-6, (1e-6, 1e-6)),
    ),
    row(lambda: rc.Grid((4, 4), 1e-60), "give lengths in other units", lambda: rc.Grid((4, 4), 1e-49)),
    row(
        lambda: rc.Grid((4, 4), 1e-6, periodic="no"),
        "periodic must hold True or False, not ('no', 'no')",
        *each(lambda repeats: rc.Grid((4, 4), 1e-6, periodic=repeats), True, False, (True, False)),
    ),
    row(
        lambda: rc.RadialGrid([1.0, 0.5]),
        "must be finite radii [m] that increase strictly, from 0 or above",
        lambda: rc.RadialGrid([0.0, 0.5, 1.0]),
    ),
    row(
        lambda: rc.RadialGrid.uniform(0, 1.0),
        "a disc needs a whole number of rings, at least one, and a radius above 0",
        lambda: rc.RadialGrid.uniform(1, 1.0),
    ),
    row(
        lambda: rc.Surface(VALUES[:3], PLANE),
        "do not fit the grid of shape (16, 16): give Grid(heights.shape, spacing)",
        lambda: rc.Surface(VALUES[:3], rc.Grid(VALUES[:3].shape, 1e-6)),
    ),
    row(
        lambda: rc.Surface(VALUES, None),
        "grid must be a Grid, or the size of a cell [m] such as 1e-6, not None",
        lambda: rc.Surface(VALUES, rc.Grid(VALUES.shape, 1e-6)),
        lambda: rc.Surface(VALUES, 1e-6),
    ),
    row(
        lambda: rc.Surface(np.full((16, 16), np.nan), PLANE),
        "all heights are NaN: the surface holds no measured point; give at least one height",
        lambda: rc.Surface(np.where(0.99 * VALUES.max() < VALUES, 0.0, np.nan), PLANE),
    ),
    row(
        lambda: rc.Surface(INFINITE, PLANE),
        "height is infinite: mark points without a measurement by NaN",
        lambda: rc.Surface(np.where(np.isinf(INFINITE), np.nan, INFINITE), PLANE),
    ),
    row(
        lambda: rc.Surface(VALUES.astype(str), PLANE),
        "heights must be real numbers [m], not text",
        lambda: rc.Surface(VALUES.astype(str).astype(float), PLANE),
    ),
    row(
        lambda: ROUGH + PERIODIC,
        "bring one onto the other by resampled()",
        lambda: ROUGH + rc.resampled(rc.Surface(PERIODIC.heights, PLANE), ROUGH.grid),
    ),
    row(lambda: ROUGH * np.nan, "can be multiplied by a finite number", lambda: ROUGH * 2.0),
    row(
        lambda: rc.combined(ROUGH, PERIODIC),
        "make both the same, for example Surface(heights, Grid(shape, spacing, periodic=False))",
        lambda: rc.combined(ROUGH, rc.Surface(PERIODIC.heights, rc.Grid((16, 16), 1e-6, periodic=False))),
    ),
    row(
        lambda: rc.combined(PERIODIC, heights(rc.Grid((15, 15), 1e-6, periodic=True))),
        "periods must be equal, not 1.5e-05 m and 1.6e-05 m: free both (Grid(shape, spacing))",
        lambda: rc.combined(
            rc.Surface(PERIODIC.heights, rc.Grid((16, 16), 1e-6)), heights(rc.Grid((15, 15), 1e-6))
        ),
    ),
    row(
        lambda: rc.combined(ROUGH, PROFILE),
        "must be the same, not 1 and 2: give two maps or two lines",
        lambda: rc.combined(ROUGH, ROUGH),
        lambda: rc.combined(PROFILE, PROFILE),
    ),
    row(
        lambda: rc.combined(PROFILE, PROFILE, turned_about="x"),
        "a line is turned about 'y', which reverses it, or not at all (None)",
        *each(lambda about: rc.combined(PROFILE, PROFILE, turned_about=about), "y", None),
    ),
    row(
        lambda: rc.resampled(ROUGH, PLANE, shift=1e-6),
        "shift [m] must be one length an axis, 2 in all, not 1e-06",
        lambda: rc.resampled(ROUGH, PLANE, shift=(1e-6, 1e-6)),
    ),
    row(
        lambda: rc.shift_between(PROFILE, PROFILE),
        "the shift is found between maps, not profiles: give surfaces of two axes",
        lambda: rc.shift_between(LARGE, LARGE),
    ),
    row(
        lambda: rc.shift_between(LARGE, rc.resampled(LARGE, rc.Grid((33, 33), 2e-6))),
        "both maps need cells of one size, not (1e-06, 1e-06) and (2e-06, 2e-06) m: bring one onto cells of the other",
        lambda: rc.shift_between(
            LARGE, rc.resampled(rc.resampled(LARGE, rc.Grid((33, 33), 2e-6)), LARGE.grid)
        ),
    ),
    row(
        lambda: rc.shift_between(LARGE, ROUGH),
        "second needs at least 32 cells along each axis, not (16, 16): use a larger map",
        lambda: rc.shift_between(LARGE, LARGE),
    ),
    row(
        lambda: rc.shift_between(LARGE, heights(LARGE.grid, seed=7)),
        "give maps of one place that are not rotated or scaled",
        lambda: rc.shift_between(LARGE, LARGE.cropped(slice(10, 60), slice(5, 60))),
    ),
    row(
        lambda: rc.resampled(ROUGH, PLANE, interpolation="spline"),
        "interpolation must be 'cubic' or 'linear'",
        *each(lambda kind: rc.resampled(ROUGH, PLANE, interpolation=kind), "cubic", "linear"),
    ),
    row(
        lambda: rc.examples.surface("milled"),
        "there are ground, blasted, turned",
        *each(rc.examples.surface, "ground", "blasted", "turned"),
    ),
]

PREPARED = [
    row(
        lambda: ROUGH.levelled("cubic"),
        "levelling must be 'mean', 'plane', 'quadratic' or 'auto'",
        *each(ROUGH.levelled, "mean", "plane", "quadratic", "auto"),
    ),
    row(
        lambda: ROUGH.without_form("cone"),
        "form must be a degree from 0 to 12, 'sphere' or 'cylinder'",
        *each(ROUGH.without_form, 0, 12),
        *each(rc.shapes.paraboloid(PLANE, radius=1e-4).without_form, "sphere", "cylinder"),
    ),
    row(
        lambda: ROUGH.filtered(),
        "give short_cutoff, long_cutoff or both [m]",
        lambda: ROUGH.filtered(short_cutoff=5e-6),
        lambda: ROUGH.filtered(long_cutoff=8e-6),
        lambda: ROUGH.filtered(short_cutoff=5e-6, long_cutoff=8e-6),
    ),
    row(
        lambda: ODD.filtered(short_cutoff=1e-9),
        "too short for cells of 1.23457e-06 m: give at least 4.93827156e-06 m",
        lambda: ODD.filtered(short_cutoff=4.93827156e-06),
    ),
    row(
        lambda: ROUGH.filtered(short_cutoff=8e-6, long_cutoff=5e-6),
        "the short cut-off of 8e-06 m must be below the long one of 5e-06 m: exchange them",
        lambda: ROUGH.filtered(short_cutoff=5e-6, long_cutoff=8e-6),
    ),
    row(
        lambda: ROUGH.cropped(ROWS),
        "needs one slice an axis, 2 in all, not 1",
        lambda: ROUGH.cropped(ROWS, ROWS),
    ),
    row(
        lambda: ROUGH.cropped(slice(4, 4), ROWS),
        "no cell is left of (16, 16) cells in 4:4, 0:4",
        lambda: ROUGH.cropped(ROWS, ROWS),
    ),
    row(
        lambda: ROUGH.cropped(slice(0, 8, 2), ROWS),
        "a crop has no step: use downsampled for a subsample",
        lambda: ROUGH.cropped(slice(0, 8), slice(0, 8)).downsampled(2),
    ),
    row(
        lambda: ROUGH.masked(),
        "masked() needs exactly one region: give box, ellipse, or below and above",
        lambda: ROUGH.masked(box=(ROWS, ROWS)),
        lambda: ROUGH.masked(ellipse=(ROWS, ROWS)),
        lambda: ROUGH.masked(below=-1e-7, above=1e-7),
    ),
    row(
        lambda: ROUGH.masked(below=1e-7, above=-1e-7),
        "leave nothing: below must be the lower",
        lambda: ROUGH.masked(below=-1e-7, above=1e-7),
    ),
    row(
        lambda: ROUGH.masked(above=-1.0),
        "the mask (heights above -1 m) leaves no measured point",
        lambda: ROUGH.masked(above=1e-7),
    ),
    row(
        lambda: ROUGH.tapered("cosine"),
        "window must be one of hann, hamming, blackman, welch, tukey",
        *each(ROUGH.tapered, "hann", "hamming", "blackman", "welch", "tukey"),
    ),
    row(
        lambda: ROUGH.scanned(-1.0), "tip_radius must be positive and finite [m]", lambda: ROUGH.scanned(1e-6)
    ),
    row(
        lambda: ROUGH.scanned(1e-6, "cone"),
        "tip must be 'sphere' or 'paraboloid'",
        *each(lambda tip: ROUGH.scanned(1e-6, tip), "sphere", "paraboloid"),
    ),
    row(
        lambda: ROUGH.downsampled(20),
        "a factor of 20 leaves less than two of 16 cells: give at most 8",
        lambda: ROUGH.downsampled(8),
    ),
    row(
        lambda: PERIODIC.averaged(3),
        "a factor of 3 does not divide 16 cells of a periodic axis: give a divisor of 16, or crop the surface, which",
        *each(PERIODIC.averaged, 2, 4, 8),
        lambda: PERIODIC.cropped(slice(0, 15), slice(0, 15)).averaged(3),
    ),
    row(
        lambda: ROUGH.rotated(90),
        "quarter turns, not degrees: give 1 for 90 degrees, not 90",
        lambda: ROUGH.rotated(1),
    ),
    row(
        lambda: PROFILE.rotated(),
        "only a surface of two axes can be turned: flip a line",
        lambda: ROUGH.rotated(),
        lambda: PROFILE.flipped("x"),
    ),
    row(lambda: ROUGH.flipped("z"), "axis must be one of x, y", *each(ROUGH.flipped, "x", "y")),
    row(
        lambda: ROUGH.despiked("zero"),
        "to must be 'missing' or 'filled'",
        *each(ROUGH.despiked, "missing", "filled"),
    ),
    row(
        lambda: ROUGH.aligned("x"),
        "lines must be 'rows' or 'columns'",
        *each(ROUGH.aligned, "rows", "columns"),
    ),
    row(
        lambda: PROFILE.aligned(),
        "a profile is one scan line: align the lines of a map",
        lambda: ROUGH.aligned(),
    ),
    row(
        lambda: holed().filled("linear"),
        "method must be 'harmonic' or 'nearest'",
        *each(holed().filled, "harmonic", "nearest"),
    ),
]


@pytest.mark.parametrize("refusal", HEIGHTS)
def test_heights(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", PREPARED)
def test_preparation(refusal):
    follow(refusal)
