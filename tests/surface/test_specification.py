"""Joints by their numbers: which spectrum they settle, and surfaces that have it."""

import itertools
import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.random_surfaces.waves import Waves

SIGMA = 1.2e-6
HAND = math.sqrt(math.pi / 2)


def found(**numbers):
    return rc.specified(sigma=SIGMA, **numbers).spectrum


def correlation(spectrum, lag):
    """Return the autocorrelation by sums over a polar grid of waves, an independent route."""
    q = np.linspace(0, spectrum.q_max, 60_001)[1:]
    angle = (np.arange(32) + 0.5) * math.pi / 64
    power = q * spectrum(q)
    waves = sum(np.sum(power * np.cos(q * lag * math.cos(each))) for each in angle) / angle.size
    return float(waves / power.sum())


@pytest.mark.parametrize("hurst", [0.2, 0.8, 1.0])
def test_any_two_numbers_of_a_spectrum_settle_it(hurst):
    """Slope and Nayak's parameter by the quadrature of theories, the correlation by a sum over waves."""
    law = rc.SelfAffineSpectrum(hurst, rolloff=60e-6, short_cutoff=6e-6).scaled(SIGMA)
    waves = Waves.of_spectrum(law, q_min=law.q_rolloff / 1e4)
    numbers = {
        "slope": math.sqrt(2 * waves.m2 / math.pi),
        "rolloff": 60e-6,
        "short_cutoff": 6e-6,
        "nayak": waves.m0 * waves.m4 / waves.m2**2,
    }
    # Without the waves beyond 1e4 roll-offs a part of 1e-8 of the mean square is missing; roots magnify it tenfold.
    for pair in itertools.combinations(numbers, 2):
        again = found(hurst=hurst, **{name: numbers[name] for name in pair})
        assert (again.rolloff, again.short_cutoff) == pytest.approx((60e-6, 6e-6), rel=1e-6), pair


@pytest.mark.parametrize("hurst", [0.3, 0.8])
@pytest.mark.parametrize("other", [{"slope": 0.12}, {"short_cutoff": 4e-6}, {"nayak": 12}])
def test_the_autocorrelation_falls_to_1_over_e_at_the_correlation_length(hurst, other):
    spectrum = found(hurst=hurst, correlation_length=12e-6, **other)
    # The sum over q leaves out half a node at 0 and at the end: 1e-3 of the roll-off.
    assert correlation(spectrum, 12e-6) == pytest.approx(math.exp(-1), abs=2e-3)


def test_moments_are_those_of_gaussian_slopes():
    joint = rc.specified(sigma=SIGMA, slope=0.12, nayak=10)
    assert joint.m0 == SIGMA**2
    assert math.sqrt(joint.m2) == pytest.approx(HAND * 0.12, rel=1e-14)
    assert joint.m4 == pytest.approx(10 * joint.m2**2 / joint.m0, rel=1e-14)
    assert rc.theory.thermal.mean_absolute_slope(joint) == pytest.approx(0.12, rel=1e-14)
    assert not joint.has_spectrum
    settled = rc.specified(sigma=SIGMA, hurst=0.8, rolloff=60e-6, short_cutoff=6e-6)
    assert settled.has_spectrum
    assert (settled.m2, settled.m4) == (settled.spectrum.moments().m2, settled.spectrum.moments().m4)


def test_two_faces_are_combined_by_their_squares():
    joint = rc.specified(sigma=(3e-6, 4e-6), slope=(0.05, 0.12))
    assert (joint.sigma, joint.slope) == pytest.approx((5e-6, 0.13), rel=1e-14)


@pytest.mark.parametrize(
    ("height", "sigma"),
    [
        ({"ra": 1e-6}, HAND * 1e-6),
        ({"ra": (3e-6, 4e-6)}, HAND * 5e-6),
        ({"rz": 6e-6, "rz_over_ra": 5}, HAND * 1.2e-6),
    ],
)
def test_other_heights_are_those_of_gaussian_surfaces(height, sigma):
    assert rc.specified(**height).sigma == pytest.approx(sigma, rel=1e-14)


@pytest.mark.parametrize("numbers", [{"slope": 0.12}, {"correlation_length": 12e-6, "short_cutoff": 6e-6}])
def test_a_surface_has_the_height_and_the_slope(numbers):
    more = {"rolloff": 64e-6} if "slope" in numbers else {}
    joint = rc.specified(sigma=SIGMA, hurst=0.8, **numbers, **more)
    longest = joint.spectrum.rolloff
    grid = rc.Grid((384, 384), 8 * longest / 384, periodic=True)
    surface = joint.surface(grid, rng=3)
    assert surface.rms == pytest.approx(SIGMA, rel=1e-12)
    m = rc.theory.thermal.mean_absolute_slope(joint)
    # The cell of the missing wave q = 0 has a part (1/8)^2/(pi (1 + 1/H)) of the mean square, half of it in the slope.
    # The waves up to the short cut-off are the points of a lattice in a circle of radius 60: R^(2/3) of pi R^2 more or
    # less, 1.4e-3.
    by_waves = rc.theory.thermal.mean_absolute_slope(rc.surface_moments(surface))
    assert by_waves == pytest.approx(m, rel=(1 / 8) ** 2 / (2 * math.pi * (1 + 1 / 0.8)) + 1.4e-3)
    # By differences of neighbours too. Of n independent slopes |s| over rms scatters by (0.07/n)^(1/2), 16^2 at least;
    # differences damp a wave of four cells or more by sin(pi/4)/(pi/4) at most, the mean much less.
    mean = np.abs(np.diff(surface.heights, axis=1)).mean() / grid.spacing[1]
    assert mean == pytest.approx(m, rel=0.1)
    assert "as specified: sigma 1.2e-06 m, hurst 0.8" in surface.provenance[-1]


OPEN = "do not determine the bandwidth of the roughness"


@pytest.mark.parametrize(
    ("numbers", "wanted", "remedy", "more"),
    [
        ({"slope": 0.1}, "m4", "give `nayak`, or `hurst` and one of `rolloff`", [{"nayak": 9}]),
        (
            {"slope": 0.1},
            "spectrum",
            "give `hurst` and one of `rolloff`, `correlation_length`, `short_cutoff`, `nayak`",
            [
                {"hurst": 0.8, name: value}
                for name, value in {
                    **{"rolloff": 60e-6, "correlation_length": 20e-6, "short_cutoff": 4e-6},
                    "nayak": 9,
                }.items()
            ],
        ),
        ({"slope": 0.1, "hurst": 0.8}, "spectrum", "give one of `rolloff`", [{"rolloff": 60e-6}]),
        (
            {"hurst": 0.8, "rolloff": 6e-5},
            "spectrum",
            "one of `slope`, `short_cutoff`, `nayak`",
            [{"nayak": 9}],
        ),
        ({"hurst": 0.8}, "spectrum", "give two of `slope`, `rolloff`", [{"nayak": 9, "rolloff": 6e-5}]),
        ({"nayak": 9}, "m2", "give `slope`, or `hurst`", [{"slope": 0.1}, {"hurst": 0.8, "rolloff": 6e-5}]),
    ],
)
def test_what_the_numbers_leave_open_is_an_error_that_names_the_remedy(numbers, wanted, remedy, more):
    with pytest.raises(rc.InputError, match=OPEN) as met:
        getattr(rc.specified(sigma=SIGMA, **numbers), wanted)
    assert remedy in met.value.remedy
    for each in more:
        assert getattr(rc.specified(sigma=SIGMA, **numbers, **each), wanted)


@pytest.mark.parametrize(
    ("numbers", "words", "right"),
    [
        ({"rz": 6e-6}, "give `rz_over_ra`", [{"rz": 6e-6, "rz_over_ra": 5}, {"ra": 1e-6}]),
        ({"sigma": 1e-6, "rz_over_ra": 5}, "omit it", [{"sigma": 1e-6}]),
        (
            {"sigma": (1e-6, 1e-6), "slope": 0.1},
            "give both as pairs",
            [{"sigma": (1e-6, 1e-6), "slope": (0.1, 0.1)}],
        ),
        ({"sigma": 1e-6, "ra": 1e-6}, "exactly one of sigma, ra and rz", [{"ra": 1e-6}]),
        ({"sigma": (1e-6,) * 3}, "give one for each face", [{"sigma": (1e-6,) * 2}]),
        (
            {"sigma": 1e-6, "rolloff": 6e-5},
            "also give `hurst`",
            [{"sigma": 1e-6, "rolloff": 6e-5, "hurst": 0.8}],
        ),
        ({"sigma": 1e-6, "nayak": 1.4}, "give a larger `nayak`", [{"sigma": 1e-6, "nayak": 2}]),
        ({"sigma": 1e-6, "hurst": 1.2}, "give 0.8", [{"sigma": 1e-6, "hurst": 0.8}]),
        ({"sigma": 1e-6, "slope": math.inf}, "must be positive and finite", [{"sigma": 1e-6, "slope": 0.1}]),
        (
            {"sigma": 1e-6, "hurst": 0.8, "rolloff": 6e-5, "correlation_length": 1e-5},
            "give one of them",
            [{"sigma": 1e-6, "hurst": 0.8, "rolloff": 6e-5}],
        ),
        (
            {"sigma": 1e-6, "slope": 0.1, "hurst": 0.8, "rolloff": 6e-5, "nayak": 9},
            "omit one",
            [{"sigma": 1e-6, "slope": 0.1, "hurst": 0.8, "nayak": 9}],
        ),
    ],
)
def test_numbers_that_do_not_go_together_are_refused(numbers, words, right):
    with pytest.raises(rc.InputError, match=words):
        rc.specified(**numbers)
    for each in right:
        rc.specified(**each)


def test_a_spectrum_that_does_not_exist_is_refused_with_the_range_of_the_last_number():
    joint = rc.specified(sigma=1e-6, slope=1e-3, hurst=0.8, rolloff=1e-4)
    with pytest.raises(rc.InputError, match="give a `rolloff` between") as met:
        _ = joint.spectrum
    low, high = (float(text) for text in met.value.remedy.removesuffix(" m").split(" ")[-3::2])
    for rolloff in (1.001 * low, 0.999 * high):
        assert rc.specified(sigma=1e-6, slope=1e-3, hurst=0.8, rolloff=rolloff).spectrum


JOINT = rc.specified(sigma=SIGMA, slope=0.12, hurst=0.8, rolloff=64e-6)


@pytest.mark.parametrize(
    ("grid", "words", "mended"),
    [
        (rc.Grid((64, 64), 8e-6, periodic=True), "268 x 268 points on the same sides", None),
        (rc.Grid((64, 64), 1e-6, periodic=True), "at least 0.000512 m long", rc.Grid((512, 512), 1e-6)),
        (rc.Grid(64, 1e-6), "give a grid of two axes", rc.Grid((512, 512), 1e-6)),
    ],
)
def test_a_grid_whose_waves_have_another_slope_is_refused(grid, words, mended):
    with pytest.raises(rc.InputError, match=words):
        JOINT.surface(grid, rng=1)
    JOINT.surface(mended or rc.Grid((268, 268), 512e-6 / 268), rng=1)
