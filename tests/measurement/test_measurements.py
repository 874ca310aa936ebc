"""Many measurements of one surface: bands, noise, the combined spectrum and its interval, maps that do not belong."""

import dataclasses
import functools

import numpy as np
import pytest
import scipy.fft
from scipy.stats import binom

import roughcontact as rc

LAW = rc.SelfAffineSpectrum(0.8, None, None, 3e-6)
SIDE = 64


@functools.cache  # the same places with and without scatter
def drawn(seed, count, side, law):
    """Return heights of `side` cells, each cut from its own periodic surface twice as large, and a normal number."""
    rng = np.random.default_rng(seed)
    grid = rc.Grid((2 * side, 2 * side), 1e-6, periodic=True)
    return [
        (
            rc.synthesise(grid, law, rng, amplitudes="gaussian").heights[:side, :side].copy(),
            rng.standard_normal(),
        )
        for _ in range(count)
    ]


def places(seed, count=6, *, gain=0.0, side=SIDE, law=LAW):
    """Return maps of `side` cells of a known spectrum, whose heights scatter from map to map."""
    return {
        f"m{k}": rc.Surface(heights * np.exp(gain / 2 * normal), 1e-6)
        for k, (heights, normal) in enumerate(drawn(seed, count, side, law))
    }


def blurred(heights, resolution, spacing=1e-6):
    """Return periodic heights seen by an instrument that halves the amplitude of waves of its resolution."""
    q = [2 * np.pi * scipy.fft.fftfreq(n, spacing) for n in heights.shape]
    square = q[0][:, None] ** 2 + q[1] ** 2
    response = 2 ** -(square * (resolution / 2 / np.pi) ** 2)
    return scipy.fft.ifft2(scipy.fft.fft2(heights) * response).real


def seen(seed, *, resolution=8e-6, noise=0.0, repeats=1, side=SIDE):
    """Return repeated maps of one place by an instrument with blur and white noise."""
    rng = np.random.default_rng(seed)
    grid = rc.Grid((2 * side, 2 * side), 1e-6, periodic=True)
    true = rc.synthesise(grid, LAW, rng, amplitudes="gaussian").heights
    here = blurred(true, resolution)[:side, :side] if resolution else true[:side, :side]
    return [rc.Surface(here + noise * rng.standard_normal(here.shape), 1e-6) for _ in range(repeats)]


def noise_at(wavelength):
    """Return the rms of white noise in cells of 1 um whose density is that of the surface at a wavelength."""
    return float(np.sqrt(LAW(2 * np.pi / wavelength)) * 2 * np.pi / 1e-6)


def covered(spectra, truth, **options):
    """Return how often the intervals hold the truth: a row for each spectrum."""
    ends = [spectrum.interval(0.95, **options) for spectrum in spectra]
    return np.array([(low < truth) & (truth < high) for low, high in ends])


@pytest.mark.parametrize("gain", [0.0, 0.6])
def test_the_interval_holds_the_spectrum_of_the_generator(gain):
    """Of 60 surfaces at least the number that an interval of 90 % holds with a probability of 99 %, in each bin.

    The interval is that of Student's t with an estimated scatter, so that it need not be exact; 89 to 99 % is asked.
    """
    spectra = [rc.Measurements.of(places(seed, gain=gain)).combined_spectrum() for seed in range(60)]
    q = spectra[0].wavenumber
    assert all(np.array_equal(each.wavenumber, q) for each in spectra)
    hits = covered(spectra, LAW(q))
    assert hits.sum(axis=0).min() >= binom.ppf(0.005, 60, 0.90)
    assert hits.mean() >= 0.89
    if gain == 0:
        # The mean of the logarithms has no bias: within three of its standard errors and 3 % for the law of the window.
        bias = np.mean([np.log(each.density / LAW(q)) for each in spectra], axis=0)
        assert np.abs(bias).max() < 0.03 + 3 * np.mean([each.log_error for each in spectra]) / np.sqrt(60)


def test_a_planted_scatter_is_found_and_holds_another_place():
    """Of twelve places the standard deviation 0.6 has the relative error 1/sqrt(2 * 11) = 21 %; of 16 sets 5.3 %."""
    spectra = [rc.Measurements.of(places(100 + k, 13, gain=0.6)) for k in range(16)]
    found, hits = [], []
    for many in spectra:
        another = many.measurements[-1]
        spectrum = rc.Measurements(many.measurements[:-1]).combined_spectrum()
        found.append(spectrum.log_spread[3:])
        low, high = spectrum.interval(0.95, of="place")
        alone = rc.Measurements((another,)).combined_spectrum()
        at = np.isin(spectrum.wavenumber, alone.wavenumber)
        # Its own waves scatter as well: allow for their error.
        own = np.exp(2 * alone.log_error)
        hits.append((low[at] / own < alone.density) & (alone.density < high[at] * own))
    assert np.sqrt(np.mean(np.square(found))) == pytest.approx(0.6, rel=3 * 0.053)
    assert np.mean(hits) > 0.9


def test_one_map_has_no_scatter_between_places():
    spectrum = rc.Measurements.of(places(1, 1)).combined_spectrum()
    assert np.isnan(spectrum.log_spread).all()
    assert np.isinf(spectrum.freedom).all()
    assert np.isnan(spectrum.interval(of="place")[0]).all()
    assert any("hold one map only" in note for note in spectrum.notes)
    assert (spectrum.count == 1).all()


# Bands.


def test_the_band_ends_at_four_cells_and_at_a_third_of_a_map():
    one = rc.Measurement.of([rc.Surface(np.random.default_rng(1).random((32, 64)), (2e-6, 1e-6))], "a")
    free = rc.Measurement.of([rc.self_affine(rc.Grid((32, 64), (2e-6, 1e-6)), 0.8, 1e-7, 1)], "a")
    assert free.band == pytest.approx((8e-6, 64e-6 / 3))
    assert (free.limited_by, free.reliable, free.noise, free.noise_found) == (
        "cells",
        True,
        None,
        "not found",
    )
    # White heights are noise alone.
    assert (one.noise_found, one.limited_by, one.reliable, one.weight) == (
        "spectrum, assumed",
        "noise",
        False,
        0.0,
    )
    assert "no reliable wave" in str(one)
    round_about = rc.Measurement.of([rc.self_affine(rc.Grid((32, 32), 1e-6, True), 0.8, 1e-7, 1)], "a")
    assert round_about.band == pytest.approx((4e-6, 32e-6))


def test_a_stated_resolution_ends_the_band_and_is_corrected():
    """The error of a resolution of 10 % is in the interval; of 12 places the mean is right within three errors."""
    maps = {f"m{k}": seen(k)[0] for k in range(12)}
    stated = dict.fromkeys(maps, rc.Instrument(resolution=8e-6))
    many = rc.Measurements.of(maps, instruments=stated)
    assert {(one.limited_by, one.band[0]) for one in many} == {("resolution", 8e-6)}
    spectrum = many.combined_spectrum()
    away = np.log(spectrum.density / LAW(spectrum.wavenumber))
    assert (np.abs(away) < 3 * spectrum.log_error).all()
    silent = rc.Measurements.of(maps).combined_spectrum()
    at = np.argmin(np.abs(silent.wavelength - 9e-6))
    # The squared response at this wave is 2^(-2 (8/9)^2) = 0.33.
    assert silent.density[at] / LAW(silent.wavenumber[at]) == pytest.approx(0.33, rel=0.4)
    assert any("blur is not corrected" in note for note in silent.notes)
    assert not any("blur" in note for note in spectrum.notes)


@pytest.mark.parametrize("how", ["repeats", "stated", "spectrum, assumed"])
def test_noise_is_found_and_ends_the_band_where_it_exceeds_the_signal(how):
    equal = 8e-6  # wavelength [m] at which noise and signal are equal
    level = noise_at(equal)
    count = 2 if how == "repeats" else 1
    stated = rc.Instrument(noise=rc.Noise(level) if how == "stated" else None)
    one = rc.Measurement.of(seen(3, resolution=None, noise=level, repeats=count), "a", stated)
    assert one.noise_found == how
    # Waves of half a map without signal: the shortest 2 to 3 cells have some; their number makes 5 %.
    assert one.noise.rms == pytest.approx(level, rel=0.15)
    # The band ends at the edge of a bin of a tenth of a decade, and a ring of 50 waves scatters by 14 %.
    assert one.limited_by == "noise"
    assert equal / 1.3 < one.band[0] < equal * 1.5


def test_noise_is_subtracted_with_repeats():
    """Of 40 pairs the mean of the signal has no noise: at the end of the band the noise would add up to 100 %."""
    level = noise_at(8e-6)
    maps, pairs = {}, []
    for k in range(40):
        first, second = seen(k, resolution=None, noise=level, repeats=2)
        maps |= {f"a{k}": first, f"b{k}": second}
        pairs.append((f"a{k}", f"b{k}"))
    many = rc.Measurements.of(maps, repeats=pairs)
    assert len(many) == 40
    assert {one.limited_by for one in many} == {"noise"}
    spectrum = many.combined_spectrum()
    well = spectrum.count > 30
    away = np.log(spectrum.density / LAW(spectrum.wavenumber))[well]
    assert (np.abs(away) < 3 * spectrum.log_error[well] + 0.05).all()
    assert not any("assumed" in note for note in spectrum.notes)


def test_a_stated_correlation_length_shapes_the_noise():
    grid, noise = rc.Grid((64, 96), 1e-6), rc.Noise(3e-9, 5e-6)
    drawn = [rc.Surface(noise.draw(grid, seed), grid) for seed in range(20)]
    measured = np.mean([rc.power_spectrum(each).density for each in drawn], axis=0)
    q = rc.power_spectrum(drawn[0]).wavenumber
    expected = 9e-18 * 25e-12 / (4 * np.pi) * np.exp(-(q**2) * 25e-12 / 4)
    one = rc.Measurement.of([drawn[0]], "a", rc.Instrument(noise=noise))
    signal, _ = one.signal()
    np.testing.assert_allclose(signal.noise, expected, rtol=1e-12)
    some = (q > 4e5) & (q < 8e5)  # rings of 50 waves under a window, in 20 maps: 6 %
    assert np.mean(measured[some] / expected[some]) == pytest.approx(1, abs=0.1)


def test_a_tip_ends_the_band_where_its_image_begins():
    rough = rc.self_affine(rc.Grid((96, 128), 1e-7), 0.8, 3e-8, 1, amplitudes="gaussian")
    blunt = rc.Measurement.of([rough.scanned(2e-6)], "a", rc.Instrument(tip_radius=2e-6))
    sharp = rc.Measurement.of([rough.scanned(1e-9)], "a", rc.Instrument(tip_radius=1e-9))
    assert (blunt.limited_by, sharp.limited_by) == ("tip", "cells")
    # The second difference at the lag of half this wave is flatter than half of the tip's curvature, at the next
    # shorter lag it is not.
    heights, lag = rough.scanned(2e-6).heights, round(blunt.band[0] / 2e-7)
    for s, flatter in ((lag, True), (lag - 1, False)):
        second = np.min(heights[:, 2 * s :] - 2 * heights[:, s:-s] + heights[:, : -2 * s]) / (s * 1e-7) ** 2
        assert (second > -0.5 / 2e-6) == flatter
    hopeless = rc.Measurement.of([rough], "a", rc.Instrument(tip_radius=1.0))
    assert (hopeless.reliable, hopeless.limited_by) == (False, "tip")


# Maps and profiles, and maps that do not belong.


def test_profiles_and_maps_combine_as_profiles():
    rng = np.random.default_rng(2)
    line = rc.Grid(1024, 1e-6, periodic=True)
    profile = rc.profile_spectrum(
        rc.PowerSpectrum(q := np.geomspace(1e3, 2.09e6, 400), LAW(q), "C2D", q, q, 1e3, 2.09e6)
    )

    def density(k):
        return np.exp(
            np.interp(np.log(np.maximum(k, 1e3)), np.log(profile.wavenumber), np.log(profile.density))
        )

    def cut():
        heights = rc.synthesise(line, density, rng, amplitudes="gaussian").heights[:512]
        return rc.Surface(heights, rc.Grid(512, 1e-6))

    maps = places(2, 4) | {f"line {k}": cut() for k in range(4)}
    spectrum = rc.Measurements.of(maps).combined_spectrum()
    assert spectrum.kind == "C1D"
    assert any("profiles along their rows" in note for note in spectrum.notes)
    well = spectrum.wavelength < 15e-6
    assert spectrum.count[well].max() == 8
    away = np.log(spectrum.density / density(spectrum.wavenumber))[well]
    assert (np.abs(away) < 4 * spectrum.log_error[well]).all()
    # With 20 times the heights in the maps alone, the lines are of another surface.
    with pytest.raises(rc.InputError, match="is not of the surface of the others"):
        rc.Measurements.of(
            {name: 20 * each if each.grid.ndim == 2 else each for name, each in list(maps.items())[3:]}
        )


def test_a_map_that_stands_out_is_named_and_left_out():
    maps = places(5, 6)
    plain = rc.Measurements.of(maps).combined_spectrum()
    assert plain.outlying == ()
    assert not any("differs" in note for note in plain.notes)
    spoilt = rc.Measurements.of(maps | {"m2": 2 * maps["m2"]}).combined_spectrum()
    assert spoilt.outlying == ("m2",)
    assert any(note.startswith("'m2' differs") and "left out" in note for note in spoilt.notes)
    without = rc.Measurements.of(
        {name: each for name, each in maps.items() if name != "m2"}
    ).combined_spectrum()
    np.testing.assert_allclose(spoilt.density, without.density, rtol=0.02)  # the exponents of the bins differ
    assert (spoilt.count == without.count).all()
    assert np.isfinite(spoilt.map_density[2]).any()  # shown


def test_maps_of_other_surfaces_are_refused():
    maps = places(6, 4)
    assert len(rc.Measurements.of({**maps, "m1": 2 * maps["m1"]})) == 4
    for factor in (0.05, 20):
        with pytest.raises(
            rc.InputError, match=r"'m1' is not of the surface of the others.*leave it out"
        ) as caught:
            rc.Measurements.of({**maps, "m1": factor * maps["m1"]})
        assert caught.value.place == "maps"
        with pytest.raises(rc.InputError, match="'m1' is not of the surface"):
            rc.Measurements.of({"m0": maps["m0"], "m1": factor * maps["m1"]})


def test_a_measurement_without_reliable_waves_is_named():
    white = rc.Surface(np.random.default_rng(1).random((64, 64)), 1e-6)
    spectrum = rc.Measurements.of(places(7, 2) | {"white": white}).combined_spectrum()
    assert spectrum.names == ("m0", "m1")
    assert spectrum.notes[0] == "'white': no reliable wave, not in the spectrum"
    with pytest.raises(rc.InputError, match="no measurement has a reliable wave"):
        rc.Measurements.of({"white": white}).combined_spectrum()


def test_the_table_has_units_and_intervals():
    spectrum = dataclasses.replace(rc.Measurements.of(places(8, 3)).combined_spectrum(), outlying=("m1",))
    table = spectrum.to_dataset(0.5)
    assert table["density"].attrs["units"] == "m4"
    assert table["map_density"].dims == ("measurement", "wavenumber")
    assert table["outlying"].values.tolist() == [False, True, False]
    np.testing.assert_array_equal(table["mean_low"], spectrum.interval(0.5)[0])
    np.testing.assert_array_equal(table["place_high"], spectrum.interval(0.5, of="place")[1])
    assert table.attrs["notes"].splitlines() == list(spectrum.notes)


def test_a_measurement_prints_what_is_known():
    stated = {"m0": rc.Instrument("AFM", tip_radius=1e-9, noise=rc.Noise(1e-12))}
    many = rc.Measurements.of(places(9, 2), instruments=stated)
    first, second = str(many).splitlines()
    assert first.startswith("m0; AFM; 4 µm to 21.3 µm, limited by cells; white noise of 1e-12 m rms (stated)")
    assert second.startswith("m1; instrument not stated; ")
    assert [one.name for one in many] == ["m0", "m1"]


@pytest.mark.parametrize(("shape", "bins"), [((24, 32), 1), ((18, 36), 2)])
def test_a_small_map_with_fewer_than_three_bins_has_a_spectrum(shape, bins):
    small = rc.self_affine(rc.Grid(shape, (2e-6, 1e-6)), hurst=0.8, rms=1e-7, rng=5)
    spectrum = rc.Measurements.of({"small": small}).combined_spectrum()
    assert spectrum.density.shape == spectrum.log_error.shape == spectrum.wavenumber.shape == (bins,)
