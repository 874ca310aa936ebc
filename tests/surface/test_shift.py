"""Two maps of one place that were not put in the same place."""

import numpy as np
import pytest

import roughcontact as rc

STEP = (2e-6, 1e-6)
NOISE = 2e-8
# Of the cubic interpolation, in cells (docstring); the maps below have no waves shorter than four cells.
BIAS = 0.003


def rough(seed, shape=(96, 160), short=8e-6):
    grid = rc.Grid(shape, STEP, periodic=True)
    return rc.self_affine(grid, 0.8, 1e-6, short_cutoff=short, rng=np.random.default_rng(seed))


def moved(surface, cells):
    """Return the surface moved by a fraction of a cell, exactly, by the phases of its waves."""
    ky, kx = np.fft.fftfreq(surface.shape[0])[:, None], np.fft.fftfreq(surface.shape[1])
    turned = np.fft.fft2(surface.heights) * np.exp(-2j * np.pi * (ky * cells[0] + kx * cells[1]))
    return rc.Surface(np.fft.ifft2(turned).real, surface.grid)


def measured(surface, rng, part=(slice(8, 88), slice(10, 150)), periodic=False):
    """Return a map of a part of the surface with noise, 4 % missing points and a hole."""
    heights = (surface.heights + rng.normal(0, NOISE, surface.shape))[() if periodic else part]
    heights[rng.random(heights.shape) < 0.04] = np.nan
    heights[20:30, 40:60] = np.nan
    return rc.Surface(heights, rc.Grid(heights.shape, STEP, periodic=periodic))


def off(found, cells):
    """Return how far a shift is from minus the planted one, over what is allowed: four errors and the bias."""
    allowed = 4 * np.array(found.error) + BIAS * np.array(STEP)
    return np.abs(np.array(found.vector) + np.array(cells) * STEP) / allowed


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("cells", [(0.0, 0.0), (0.5, -0.5), (2.3, -7.8), (-5.25, 3.6)])
def test_a_planted_shift_is_found_to_its_error(cells, periodic):
    rng, whole = np.random.default_rng(3), rough(1)
    before, after = (
        measured(whole, rng, periodic=periodic),
        measured(moved(whole, cells), rng, periodic=periodic),
    )
    found = rc.shift_between(before, after)
    assert (off(found, cells) < 1).all()
    # Cramer and Rao: no estimate from heights with this noise in both maps is better than sqrt(2) s / |slopes|. The
    # interpolation halves the noise of one map at least, and the smoothed slopes lose part of the short waves.
    slopes = [np.gradient(np.nan_to_num(before.heights), step, axis=axis) for axis, step in enumerate(STEP)]
    best = (
        NOISE * np.sqrt(2) / np.array([np.sqrt(np.sum(np.where(before.measured, s, 0) ** 2)) for s in slopes])
    )
    assert (np.array(found.error) < 6 * best).all()
    assert found.sign == 1
    assert found.correlation > 0.8 > 2 * found.elsewhere


def test_maps_of_other_sizes_have_their_middles_together_at_zero():
    rng, whole = np.random.default_rng(3), rough(2)
    first = measured(whole, rng)  # middle at row 47.5, column 79.5
    second = measured(whole, rng, (slice(20, 91), slice(4, 130)))  # 55, 66.5
    found = rc.shift_between(first, second)
    assert (off(found, (47.5 - 55, 79.5 - 66.5)) < 1).all()


def test_a_worn_part_is_left_out():
    rng, whole, cells = np.random.default_rng(5), rough(4), (1.4, -2.7)
    level = np.quantile(whole.heights, 0.7)
    worn = rc.Surface(np.minimum(moved(whole, cells).heights, level), whole.grid)
    before = measured(whole, rng)
    found = rc.shift_between(before, measured(worn, rng))
    assert (off(found, cells) < 1).all()
    assert max(np.array(found.error) / STEP) < 0.03


def test_a_mated_fracture_closes():
    """The aperture has the noise of the lower face and of the upper one, which the interpolation makes smaller."""
    rng, whole, cells = np.random.default_rng(7), rough(6, short=16e-6), (0.6, -3.3)
    lower, facing = measured(whole, rng), measured(moved(whole * -1, cells), rng)
    upper = facing.flipped("x")
    found = rc.shift_between(lower, upper.flipped("x"))
    assert found.sign == -1
    assert (off(found, cells) < 1).all()
    with pytest.warns(UserWarning, match="lie beyond what both cover"):
        closed = rc.combined(lower, upper, shift=found.vector)
    assert NOISE < closed.rms < 1.05 * np.sqrt(2) * NOISE
    assert rc.combined(lower, upper).rms > 5 * NOISE
    assert "moved by" in closed.provenance[-2]


def test_another_place_or_a_structure_that_repeats_is_refused():
    rng = np.random.default_rng(9)
    first = measured(rough(10), rng)
    for other in (measured(rough(11), rng), first.rotated(2)):
        with pytest.raises(
            rc.InputError, match=r"not maps of the same place.* 0\.\d\d at best and 0\.\d\d elsewhere"
        ):
            rc.shift_between(first, other)
    turned = rc.shapes.wave(rc.Grid((64, 96), STEP, periodic=True), 1e-6, wavelength=16e-6)
    with pytest.raises(rc.InputError, match="or their structure repeats"):
        rc.shift_between(turned, turned)


def test_a_surface_is_moved_in_the_direction_of_the_indices():
    whole = rough(12)
    rolled = rc.resampled(whole, whole.grid, shift=(3 * STEP[0], -2 * STEP[1]))
    np.testing.assert_array_equal(rolled.heights, np.roll(whole.heights, (3, -2), (0, 1)))
    assert "waves of four cells keep (1, 1) of their height" in rolled.provenance[-1]


@pytest.mark.parametrize(
    ("interpolation", "kept"),
    [("linear", np.cos(np.pi / 4)), ("cubic", 9 / 8 * np.cos(np.pi / 4) - np.cos(3 * np.pi / 4) / 8)],
)
def test_the_loss_of_short_waves_is_stated(interpolation, kept):
    """Half a cell between the points 1/2 and -1/2 (3/2 and -3/2) with weights 1/2 (9/16 and -1/16)."""
    grid = rc.Grid((16, 32), STEP, periodic=True)
    wave = rc.shapes.wave(grid, 1e-6, wavelength=4e-6)
    half = rc.resampled(wave, grid, interpolation=interpolation, shift=(0.0, 0.5e-6))
    assert half.rms / wave.rms == pytest.approx(kept, rel=1e-12)
    assert f"waves of four cells keep (1, {kept:.3g}) of their height" in half.provenance[-1]


def test_cells_that_a_shift_moves_off_are_counted():
    lower = rc.Surface(rough(13).heights, STEP)
    with pytest.warns(UserWarning, match="480 of 15360 cells .* of the lower surface and 480 of 15360 cells"):
        both = rc.combined(lower, lower, turned_about=None, shift=(0.0, 3e-6 + 2e-6))
    # The shift by five cells loses five columns of 96 cells.
    assert both.missing == 480
