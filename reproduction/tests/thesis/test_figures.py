"""The figures of chapters 2 and 5: what their cases hold, and that they can be drawn."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact_thesis import (
    fig4_midpoint_line as fig4,
    fig5_midpoint_surface as fig5,
    fig6_lines_by_hurst as fig6,
    fig7_surfaces_by_hurst as fig7,
    fig14_merged_spectrum as fig14,
    fig34_rolloff_and_cutoff as fig34,
)
from roughcontact_thesis.figures import FIGURES, figure, module


def test_every_figure_says_what_it_is_and_what_is_chosen():
    for name in FIGURES:
        found = module(name)
        assert f"{found.__name__}_".startswith(f"roughcontact_thesis.{name.replace('-', '_')}_")
        assert found.TITLE
        assert found.CHOSEN
        assert all(found.CHOSEN)
    with pytest.raises(ValueError, match=r"no figure 'fig99'.*fig34"):
        module("fig99")


@pytest.mark.parametrize("name", ["fig4", "fig5", "fig6", "fig34"])
def test_a_figure_is_drawn_and_its_seed_makes_it(name):
    def pixels(seed):
        canvas = FigureCanvasAgg(figure(name, seed))
        canvas.figure.set_dpi(50)
        canvas.draw()
        return np.asarray(canvas.buffer_rgba()).copy()

    one = pixels(1)
    assert one.std() > 0
    assert (one != pixels(2)).any()


def test_the_surfaces_of_figure_7_are_drawn_at_any_size():
    # With few points: the views of the real ones take seconds.
    data = tuple(surface.averaged(8) for surface in fig7.case())
    drawn = Figure(figsize=fig7.SIZE, layout="constrained")
    fig7.draw(drawn, data)
    FigureCanvasAgg(drawn).draw()
    assert len(drawn.axes) == 5


def test_the_stages_of_figure_4_keep_the_nodes_of_the_stage_before_within_their_displacements():
    stages = fig4.case()
    assert [line.heights.size for line in stages] == [3, 5, 9, 17]
    before = np.zeros(2)
    for level, line in enumerate(stages):
        np.testing.assert_array_equal(line.heights[::2], before)
        moved = line.heights[1::2] - (before[1:] + before[:-1]) / 2
        # d * 2^-H a level; a rounding of the difference is far below any of them.
        assert (np.abs(moved) <= 2 ** (-fig4.HURST * level) * fig4.DISPLACEMENT).all()
        assert (moved != 0).all()
        before = line.heights


def test_the_stages_of_figure_5_are_one_surface_refined():
    coarse, middle, fine = fig5.case()
    np.testing.assert_array_equal(middle.heights[::4, ::4], coarse.heights)
    np.testing.assert_array_equal(fine.heights[::16, ::16], middle.heights)
    assert np.abs(coarse.heights[1, 1]) <= fig5.RELATIVE  # the corners are 0
    assert not np.array_equal(fig5.case(1)[2].heights, fine.heights)


@pytest.mark.parametrize(("figure_module", "rise"), [(fig6, 1), (fig7, 2)])
def test_the_exponents_share_phases_and_rms_and_differ_in_their_spectra(figure_module, rise):
    samples = figure_module.case()
    assert figure_module.EXPONENTS == (0, 0.5, 1, 1.5, 2)
    waves = [np.fft.rfftn(each.heights) for each in samples]
    for hurst, surface, wave in zip(figure_module.EXPONENTS, samples, waves, strict=True):
        assert surface.rms == pytest.approx(figure_module.RMS, rel=1e-12)
        first, fourth = (wave[(0,) * (wave.ndim - 1) + (n,)] for n in (1, 4))
        # B ~ q^(-H-1/2) on a line, q^(-H-1) on a surface.
        assert abs(first / fourth) == pytest.approx(4 ** (hurst + rise / 2), rel=1e-9)
        reference = waves[0][(0,) * (wave.ndim - 1) + (1,)]
        assert first / abs(first) == pytest.approx(reference / abs(reference), rel=1e-9)


def test_the_instruments_of_figure_14_find_one_spectrum_where_they_are_to_be_relied_upon():
    data = fig14.case(points=1024)
    bands = [(each.q_min, each.q_max) for each in data.single]
    assert bands[0][0] < bands[1][0] < bands[2][0]
    assert data.merged.q_min == bands[0][0]
    assert data.merged.q_max == max(high for _, high in bands)
    # Ratio to the known law over the band, weighted by what each bin is worth; four standard errors, and the
    # pixels' loss of at most 5 % along an axis and twice that across a corner.
    for spectrum in data.single:
        band = spectrum.within()
        ratio = band.density / data.law(band.wavenumber)
        mean = np.average(ratio, weights=band.freedom)
        error = 1 / np.sqrt(band.freedom.sum())
        assert abs(mean - 1) < 4 * error + 0.1
    # Averages over pixels lose power beyond the band: (sin x/x)^2 along an axis, x = pi/4 at twice its end.
    optical = data.single[1]
    beyond = optical.wavenumber > 2 * optical.q_max
    ratio = optical.density[beyond] / data.law(optical.wavenumber[beyond])
    assert np.average(ratio, weights=optical.freedom[beyond]) < (np.sin(np.pi / 4) / (np.pi / 4)) ** 2
    drawn = Figure(figsize=fig14.SIZE, layout="constrained")
    fig14.draw(drawn, data)
    FigureCanvasAgg(drawn).draw()
    labels = [text.get_text() for text in drawn.legends[0].get_texts()]
    assert len(labels) == 5
    assert labels[3].startswith("merged: H = ")


def test_the_spectra_of_figure_34_are_one_law_from_the_limit_on():
    plain, rolled, cut = fig34.case()
    q0 = 2 * np.pi / fig34.LENGTH
    bend = round(1 / fig34.LIMIT)
    assert plain.line.rms == pytest.approx(fig34.RMS * fig34.LENGTH, rel=1e-12)
    powers = [np.abs(np.fft.rfft(each.line.heights)) ** 2 for each in (plain, rolled, cut)]
    # The last wave is that of Nyquist, which no line has.
    for power in powers[1:]:
        np.testing.assert_allclose(power[bend:-1], powers[0][bend:-1], rtol=1e-6)
    np.testing.assert_allclose(powers[1][1:bend], powers[0][bend], rtol=1e-6)
    assert powers[2][1:bend].max() < 1e-20 * powers[0][1]
    assert cut.spectrum(np.array([q0 * (bend - 1)])) == 0
    assert isinstance(plain.line, rc.Surface)
