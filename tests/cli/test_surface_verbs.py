"""The verbs ``surface spectrum``, ``surface prepare`` and ``thesis``."""

import json

import numpy as np
import pytest

import roughcontact as rc


@pytest.fixture
def free(tmp_path):
    """Return the file of a free rough surface with enough waves for a fit, and the surface."""
    grid = rc.Grid((96, 128), 1e-6)
    surface = rc.self_affine(grid, 0.8, 1e-7, np.random.default_rng(7), amplitudes="gaussian")
    path = tmp_path / "free.npz"
    rc.write(surface, path)
    return path, surface


@pytest.fixture
def holed(free, tmp_path):
    _, surface = free
    heights = surface.heights.copy()
    heights[40:44, 50:53] = np.nan
    rc.write(rc.Surface(heights, surface.grid), tmp_path / "holed.npz")
    return tmp_path / "holed.npz"


def test_spectrum_says_what_the_library_says(invoke, free):
    path, surface = free
    answer = invoke("surface", "spectrum", path, "--json")
    assert answer.exit_code == 0, answer.stderr
    assert "levelled by their plane" in answer.stderr
    record = json.loads(answer.stdout)
    fit = rc.hurst_exponent(surface)
    assert record["hurst"] == pytest.approx(fit.hurst, rel=1e-12)
    assert record["standard_error"] == pytest.approx(fit.standard_error, rel=1e-12)
    assert record["kind"] == "C2D"
    assert record["rms"] == pytest.approx(surface.levelled("plane").rms, rel=1e-12)
    spectrum = rc.power_spectrum(surface, per_decade=200)
    assert record["longest"] == pytest.approx(2 * np.pi / spectrum.q_min, rel=1e-12)
    moments = rc.spectrum_moments(spectrum.rebinned(20), spectrum.q_min, spectrum.q_max)
    assert [record["m0"], record["m2"], record["m4"]] == pytest.approx([moments.m0, moments.m2, moments.m4])


def test_spectrum_writes_a_table_that_numpy_reads_and_a_picture(invoke, free, tmp_path):
    path, surface = free
    out = tmp_path / "out"
    answer = invoke("surface", "spectrum", path, "--direction", "x", "--limit", "none", "--out", out)
    assert answer.exit_code == 0, answer.stderr
    assert sorted(file.name for file in out.iterdir()) == ["spectrum.csv", "spectrum.png"]
    table = np.genfromtxt(out / "spectrum.csv", delimiter=",", names=True)
    whole = rc.power_spectrum(surface, "x", per_decade=200)
    expected = whole.rebinned(20)
    np.testing.assert_array_equal(table["wavenumber"], expected.wavenumber)
    np.testing.assert_array_equal(table["density"], expected.density)
    law = rc.fit_spectrum(whole, limit="none")
    np.testing.assert_allclose(table["law"], law(expected.wavenumber), rtol=1e-15)
    assert 0 < table["reliable"].sum() <= expected.wavenumber.size
    assert "kind = C1D" in (out / "spectrum.csv").read_text(encoding="utf-8")
    assert (out / "spectrum.png").read_bytes().startswith(b"\x89PNG")
    assert "Hurst exponent H" in answer.stdout


def test_spectrum_takes_the_band_that_is_given(invoke, free):
    path, surface = free
    answer = invoke("surface", "spectrum", path, "--longest", "30um", "--shortest", "4um", "--json")
    record = json.loads(answer.stdout)
    fit = rc.hurst_exponent(surface, q_min=2 * np.pi / 30e-6, q_max=2 * np.pi / 4e-6)
    assert record["hurst"] == pytest.approx(fit.hurst, rel=1e-12)
    assert (record["longest"], record["shortest"]) == pytest.approx((30e-6, 4e-6), rel=1e-12)


def test_spectrum_asks_before_it_fills(invoke, holed):
    answer = invoke("surface", "spectrum", holed)
    assert answer.exit_code == 2
    assert "12 points are missing" in answer.stderr
    assert "--fill" in answer.stderr
    answer = invoke("surface", "spectrum", holed, "--fill")
    assert answer.exit_code == 0, answer.stderr
    assert "12 missing points are filled" in answer.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--longest", "-1um"), "--longest: a wavelength must be positive"),
        (("--longest", "4um", "--shortest", "30um"), "must be longer than --shortest 30um"),
        (("--shortest", "1kg"), "--shortest"),
        (("--longest", "4.1um", "--shortest", "4um"), "rad/m"),
    ],
)
def test_spectrum_refuses_a_band_that_is_none(invoke, free, tmp_path, arguments, words):
    answer = invoke("surface", "spectrum", free[0], *arguments, "--out", tmp_path / "out")
    assert answer.exit_code == 2
    assert words in answer.stderr
    assert answer.stderr.startswith("Error: ") or "\nError: " in answer.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("ending", ["npz", "nc", "x3p", "vti"])
def test_prepare_takes_its_steps_in_the_order_that_it_states(invoke, holed, tmp_path, ending):
    out = tmp_path / f"ready.{ending}"
    answer = invoke(
        *("surface", "prepare", holed, out, "--downsample", "2", "--long", "60um", "--short", "8um"),
        *("--fill", "--form", "2", "--level", "plane", "--crop", "10:90,:100", "--json"),
    )
    assert answer.exit_code == 0, answer.stderr
    start = rc.read(holed)
    expected = start.cropped(slice(10, 90), slice(None, 100)).levelled("plane").without_form(2).filled()
    expected = expected.filtered(short_cutoff=8e-6, long_cutoff=60e-6).downsampled(2)
    record = json.loads(answer.stdout)
    assert record["shape"] == [40, 50]
    assert record["rms"] == pytest.approx(expected.rms, rel=1e-12)
    assert record["provenance"] == list(expected.provenance)
    assert ("no place for the history" in answer.stderr) is (ending in ("x3p", "vti"))
    if ending != "vti":
        surface = rc.read(out)
        # Sums in another order of memory differ by rounding.
        atol = 1e-13 * float(np.abs(start.heights[~np.isnan(start.heights)]).max())
        np.testing.assert_allclose(surface.heights, expected.heights, rtol=0, atol=atol)
        assert surface.grid.spacing == pytest.approx((2e-6, 2e-6), rel=1e-12)
    if ending in ("npz", "nc"):
        assert surface.provenance[: len(expected.provenance)] == expected.provenance


def test_prepare_does_nothing_unasked(invoke, holed, tmp_path):
    out = tmp_path / "same.npz"
    answer = invoke("surface", "prepare", holed, out)
    assert answer.exit_code == 0
    assert "no step is asked for" in answer.stderr
    np.testing.assert_array_equal(rc.read(out).heights, rc.read(holed).heights)
    assert "12" in answer.stdout  # the missing points


def test_prepare_thins_out_with_or_without_a_filter(invoke, free, tmp_path):
    path, surface = free
    for arguments, filtered in (((), True), (("--alias",), False)):
        out = tmp_path / f"thin{filtered}.npz"
        assert invoke("surface", "prepare", path, out, "--downsample", "4", *arguments).exit_code == 0
        expected = surface.downsampled(4, anti_alias=filtered).heights
        np.testing.assert_array_equal(rc.read(out).heights, expected)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--crop", "1-5"), "rows,columns such as 0:512,100:612"),
        (("--crop", "5:5,:"), "nothing is left"),
        (("--form", "egg"), "sphere or cylinder"),
        (("--form", "13"), "0 to 12"),
        (("--short", "10"), "give its unit"),
        (("--short", "1um"), "cut-off"),
        (("--short", "20um", "--long", "8um"), "must be below"),
        (("--downsample", "0"), "from 1 up"),
        (("--downsample", "90"), "leaves less than two"),
        (("--alias",), "belongs to --downsample"),
    ],
)
def test_prepare_refuses_steps_that_make_no_sense(invoke, free, tmp_path, arguments, words):
    out = tmp_path / "out.npz"
    answer = invoke("surface", "prepare", free[0], out, *arguments)
    assert answer.exit_code == 2, answer.stdout
    assert words in answer.stderr
    assert not out.exists()


def test_prepare_neither_overwrites_what_was_measured_nor_writes_what_it_cannot(invoke, free, tmp_path):
    before = free[0].read_bytes()
    answer = invoke("surface", "prepare", free[0], free[0], "--level", "plane")
    assert answer.exit_code == 2
    assert "the measured file itself" in answer.stderr
    assert free[0].read_bytes() == before
    answer = invoke("surface", "prepare", free[0], tmp_path / "out.txt")
    assert answer.exit_code == 2
    assert ".npz, .x3p, .nc, .vti" in answer.stderr


def test_thesis_lists_its_figures(invoke):
    answer = invoke("thesis", "list")
    assert answer.exit_code == 0
    names = [line.split()[0] for line in answer.stdout.splitlines()]
    assert names == ["fig4", "fig5", "fig6", "fig7", "fig14", "fig34"]


def test_thesis_writes_a_figure_and_says_what_was_chosen(invoke, tmp_path):
    answer = invoke("thesis", "fig4", "--out", tmp_path / "figures", "--seed", "5")
    assert answer.exit_code == 0, answer.stderr
    path = tmp_path / "figures" / "fig4.png"
    assert path.read_bytes().startswith(b"\x89PNG")
    assert str(path) in answer.stdout
    assert "H = 0.8" in answer.stdout
    assert answer.stdout.rstrip().endswith("5")


@pytest.mark.parametrize(
    ("arguments", "words"), [(("fig99",), "no figure 'fig99'"), (("fig4", "--seed", "x"), "no seed")]
)
def test_thesis_refuses_what_it_does_not_know(invoke, tmp_path, arguments, words):
    answer = invoke("thesis", *arguments, "--out", tmp_path / "new")
    assert answer.exit_code == 2
    assert words in answer.stderr
    assert not (tmp_path / "new").exists()
