"""The Outlook's prefactor against the size."""

import numpy as np
import pytest
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact_thesis import outlook_scale
from roughcontact_thesis.figures import drawn, verdicts

HURST = np.array([0.0, 0.2, 0.4, 0.7])
WAVES = np.array([8, 16, 32])


def export(growth=0.0, steepness=0.0, samples=4):
    """Return what surfaces would export whose prefactor goes as powers of size and force."""
    force = np.geomspace(1e-3, 0.3, 16)
    points = np.array([64, 128, 128, 128])
    waves = np.array([8, 8, 16, 32])
    hurst = HURST[:, None, None]
    law = 1.7 / (hurst + 1) * force ** (1 / (hurst + 1)) * (force / 0.0375) ** steepness
    stiffness = law * (waves[:, None] / 32.0) ** growth
    scatter = 1 + 0.02 * (-1.0) ** np.arange(samples)
    every = ("row", "hurst", "sample", "load")
    values = np.swapaxes(stiffness, 0, 1)[:, :, None, :] * scatter[:, None]
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", force),
            "dimensionless_stiffness": (every, values),
            "status": (every, np.full(values.shape, "converged")),
            "case_seconds": (every[:3], np.ones(values.shape[:3])),
        },
        {
            "hurst": HURST,
            "row": np.arange(4),
            "points": ("row", points),
            "short_cutoff": ("row", 1 / waves),
            "sample": np.arange(samples),
        },
    )


@pytest.mark.parametrize("growth", [0.0, -0.2])
def test_a_power_of_the_size_is_found(growth):
    found = outlook_scale.averages(export(growth))
    assert list(found["waves"]) == list(WAVES)
    np.testing.assert_allclose(found["growth"], growth, atol=1e-12)
    np.testing.assert_allclose(found["steepness"], 0.0, atol=1e-12)
    # Scatter of 2 % to both sides: the mean is that of all samples to its square.
    np.testing.assert_allclose(found["zeta"].sel(waves=32), 1.7 / (HURST + 1), rtol=1e-12)
    np.testing.assert_allclose(found["zeta_octave"].sel(waves=32), 1.7 / (HURST + 1), rtol=1e-12)
    words = [each.word for each in verdicts(outlook_scale, found)]
    # From H = 0.25 on the size is said not to be in it, below to be.
    four, largest, force, low, _ = words
    assert (force, four) == ("holds", largest)
    assert (largest, low) == (("holds", "does not hold") if growth == 0 else ("does not hold", "holds"))
    FigureCanvasAgg(drawn(outlook_scale, found)).draw()


def test_the_longest_octave_is_that_of_the_waves_between_l_and_half_of_it():
    found = outlook_scale.averages(export())
    octave = (found["zeta_octave"] / found["zeta"]) ** (found["hurst"] + 1)
    grid = rc.Grid((128, 128), 1 / 128)
    for hurst in HURST:
        long, all_waves, few = (
            rc.grid_moments(grid, rc.SelfAffineSpectrum(hurst, short_cutoff=each)).rms_height
            for each in (1 / 2, 1 / 32, 1 / 8)
        )
        one = octave.sel(hurst=hurst)
        assert float(one.sel(waves=8)) == pytest.approx((long / few) / (long / all_waves), rel=1e-12)
    # The flatter the spectrum, the more the short waves count.
    assert (np.diff(octave.sel(waves=8)) < 0).all()


def test_a_prefactor_that_depends_on_the_force_is_no_law():
    found = outlook_scale.averages(export(steepness=0.2))
    np.testing.assert_allclose(found["steepness"], 0.2, atol=1e-12)
    assert verdicts(outlook_scale, found)[2].word == "does not hold"


def test_curves_stand_at_forces_that_do_not_know_the_size():
    found = outlook_scale.averages(export())
    # F/(E* Theta l^(H+1)) = F/(E* h L) (L/l)^(H+1).
    one = found["force"].sel(hurst=0.7, waves=16)
    np.testing.assert_allclose(one, found["dimensionless_force"] * 16**1.7, rtol=1e-12)


def test_at_one_force_sizes_differ_by_what_the_prefactor_does_with_size_and_force():
    found = outlook_scale.averages(export(growth=-0.2, steepness=0.1))
    # F/(E* h L) goes as L^-(H+1) at one F/(E* Theta).
    expected = (-0.2 - 0.1 * (HURST[:, None] + 1)) * np.log(WAVES / 8)
    np.testing.assert_allclose(found["same_force"].transpose("hurst", "waves"), expected, atol=1e-12)
    # Those that scatter together do not scatter against each other.
    np.testing.assert_allclose(found["same_force_error"], 0, atol=1e-12)
