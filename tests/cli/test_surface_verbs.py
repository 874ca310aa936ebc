"""The verbs ``surface spectrum`` and ``surface prepare``."""

import json

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.plot import canvas
from tables import read_table


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
    assert "removed by a least-squares plane" in answer.stderr
    record = json.loads(answer.stdout)
    fit = rc.hurst_exponent(surface)
    assert record["hurst"] == pytest.approx(fit.hurst, rel=1e-12)
    assert record["standard_error"] == pytest.approx(fit.standard_error, rel=1e-12)
    assert record["kind"] == "C2D"
    assert record["rms"] == pytest.approx(surface.levelled("plane").rms, rel=1e-12)
    spectrum = rc.power_spectrum(surface, per_decade=200)
    assert record["longest"] == pytest.approx(2 * np.pi / spectrum.q_min, rel=1e-12)
    moments = rc.spectrum_moments(spectrum.rebinned(20), q_min=spectrum.q_min, q_max=spectrum.q_max)
    assert [record["m0"], record["m2"], record["m4"]] == pytest.approx([moments.m0, moments.m2, moments.m4])


@pytest.mark.usefixtures("drawn")
def test_spectrum_writes_a_table_that_numpy_reads_and_a_picture(invoke, free, tmp_path):
    path, surface = free
    out = tmp_path / "out"
    answer = invoke("surface", "spectrum", path, "--direction", "x", "--limit", "none", "--out", out)
    assert answer.exit_code == 0, answer.stderr
    assert sorted(file.name for file in out.iterdir()) == ["spectrum.csv", "spectrum.nc", "spectrum.png"]
    table = read_table(out / "spectrum.csv")
    whole = rc.power_spectrum(surface, "x", per_decade=200)
    expected = whole.rebinned(20)
    np.testing.assert_array_equal(table["wavenumber"], expected.wavenumber)
    np.testing.assert_array_equal(table["density"], expected.density)
    law = rc.fit_spectrum(whole, limit="none")
    np.testing.assert_allclose(table["law"], law(expected.wavenumber), rtol=1e-15)
    assert 0 < table["reliable"].sum() <= expected.wavenumber.size
    with xarray.open_dataset(out / "spectrum.nc") as dataset:
        assert dataset.attrs["kind"] == "C1D"
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
        (("--longest", "4um", "--shortest", "30um"), "must be longer than the shortest, 30um"),
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
        *("surface", "prepare", holed, out, "--downsample", "2"),
        *("--long-cutoff", "60um", "--short-cutoff", "8um"),
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
    assert (f"a file .{ending} " in answer.stderr) is (ending in ("x3p", "vti"))
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
    assert "no step is given" in answer.stderr
    np.testing.assert_array_equal(rc.read(out).heights, rc.read(holed).heights)
    assert "12" in answer.stdout  # the missing points


def test_prepare_thins_out_with_or_without_a_filter(invoke, free, tmp_path):
    path, surface = free
    for arguments, filtered in (((), True), (("--alias",), False)):
        out = tmp_path / f"thin{filtered}.npz"
        assert invoke("surface", "prepare", path, out, "--downsample", "4", *arguments).exit_code == 0
        expected = surface.downsampled(4, anti_alias=filtered).heights
        np.testing.assert_array_equal(rc.read(out).heights, expected)


def test_prepare_scans_averages_and_tapers_in_its_order(invoke, free, tmp_path):
    path, surface = free
    out = tmp_path / "out.npz"
    answer = invoke(
        *("surface", "prepare", path, out, "--window", "tukey", "--share", "0.5", "--average", "2"),
        *("--short-cutoff", "8um", "--tip", "20um", "--tip-shape", "paraboloid"),
    )
    assert answer.exit_code == 0, answer.stderr
    expected = (
        surface.scanned(20e-6, "paraboloid").filtered(short_cutoff=8e-6).averaged(2).tapered("tukey", 0.5)
    )
    found = rc.read(out)
    np.testing.assert_allclose(found.heights, expected.heights, rtol=0, atol=1e-13 * surface.rms)
    assert found.grid.shape == (48, 64)
    history = [line for line in found.provenance if not line.startswith("read from")]
    assert history == list(expected.provenance)
    assert history[1:] == [
        "scanned by a paraboloid of radius 2e-05 m",
        "Gaussian filter: waves below 8e-06 m removed",
        "averaged over pixels of 2 x 2 cells",
        f"tukey window, mean square times {(1 - 5 / 16) ** 2:.6g}",
    ]
    for line in history:
        assert line in answer.stdout


def test_prepare_scans_by_a_sphere_unless_told_otherwise(invoke, free, tmp_path):
    path, surface = free
    assert invoke("surface", "prepare", path, tmp_path / "a.npz", "--tip", "20um").exit_code == 0
    expected = surface.scanned(20e-6).heights
    # "20um" is 20e-6 m but for its last digit.
    np.testing.assert_allclose(
        rc.read(tmp_path / "a.npz").heights, expected, rtol=0, atol=1e-13 * surface.rms
    )


@pytest.fixture
def line(tmp_path):
    """Return the file of a line scan, and the line."""
    made = rc.self_affine(rc.Grid(512, 1e-6), 0.7, 1e-7, np.random.default_rng(1), amplitudes="gaussian")
    rc.write(made, tmp_path / "line.npz")
    return tmp_path / "line.npz", made


def test_prepare_takes_a_line_scan(invoke, line, tmp_path):
    path, made = line
    out = tmp_path / "out.txt"
    answer = invoke("surface", "prepare", path, out, "--crop", "12:", "--level", "plane", "--average", "5")
    assert answer.exit_code == 0, answer.stderr
    expected = made.cropped(slice(12, None)).levelled("plane").averaged(5)
    np.testing.assert_array_equal(rc.read_line(out).heights, expected.heights)
    wrong = invoke("surface", "prepare", path, out, "--crop", "1:5,2:7")
    assert (wrong.exit_code, "give one range of cells" in wrong.stderr) == (2, True)


def test_spectrum_of_a_line_scan_is_c1d_and_the_c2d_that_follows(invoke, line, tmp_path):
    path, made = line
    out = tmp_path / "out"
    answer = invoke("surface", "spectrum", path, "--limit", "none", "--out", out, "--json")
    assert answer.exit_code == 0, answer.stderr
    assert "removed by a least-squares line" in answer.stderr
    record = json.loads(answer.stdout)
    profile = rc.power_spectrum(made, per_decade=200)
    fit = rc.fit_spectrum(profile, limit="none")
    assert record["kind"] == "C1D"
    assert record["hurst"] == pytest.approx(fit.hurst, rel=1e-12)
    moments = rc.spectrum_moments(profile.rebinned(20), q_min=profile.q_min, q_max=profile.q_max)
    assert record["rms_slope"] == pytest.approx(moments.rms_slope, rel=1e-12)
    assert record["isotropic_rms_slope"] == pytest.approx(np.sqrt(2) * moments.rms_slope, rel=1e-12)
    table = read_table(out / "spectrum.csv")
    np.testing.assert_array_equal(table["density"], profile.rebinned(20).density)
    areal = rc.surface_spectrum(profile.rebinned(20), hurst=fit.hurst)
    np.testing.assert_array_equal(table["isotropic_density"], areal.density)
    assert table.attrs["units"]["isotropic_density"] == "m4"
    assert set(table["hurst_standard_error"]) == {fit.standard_error}
    assert "isotropic surface" in invoke("surface", "spectrum", path).stdout


def test_spectrum_of_a_line_scan_has_no_rings(invoke, line):
    answer = invoke("surface", "spectrum", line[0], "--direction", "ring")
    assert answer.exit_code == 2
    assert "a line has profiles along 'x' only" in answer.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--crop", "1-5"), "rows,columns such as 0:40,5:45"),
        (("--crop", "5:5,:"), "5:5 holds no cell"),
        (("--form", "egg"), "sphere or cylinder"),
        (("--form", "13"), "0 to 12"),
        (("--short-cutoff", "10"), "leaves nothing of a map"),
        (("--short-cutoff", "1um"), "cut-off"),
        (("--short-cutoff", "20um", "--long-cutoff", "8um"), "must be below"),
        (("--downsample", "0"), "from 1 up"),
        (("--downsample", "90"), "leaves less than two"),
        (("--alias",), "needs --downsample"),
        (("--average", "-3"), "--average: the number of cells must be a whole number from 1 up"),
        (("--average", "65"), "leaves less than two"),
        (("--tip", "2"), "a radius of 2 m is too large for a tip; write it with its unit, such as 2um"),
        (("--tip", "0um"), "--tip: the radius of a tip must be positive"),
        (("--tip", "1N"), "--tip: '1N' is not a length"),
        (("--tip-shape", "sphere"), "--tip-shape needs --tip"),
        (("--share", "0.1"), "--share needs --window"),
        (("--window", "hann", "--share", "0.1"), "--share belongs to a Tukey window: give --window tukey"),
        (("--window", "tukey", "--share", "1.5"), "must lie between 0 and 1, not '1.5'"),
        (("--crop", "1:5"), "--crop: a crop needs one slice an axis, 2 in all, not 1; give rows and columns"),
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
    answer = invoke("surface", "prepare", free[0], tmp_path / "out.csv")
    assert answer.exit_code == 2
    assert "written as one of .npz, .nc, .x3p, .txt, .npy, .vti" in answer.stderr


def test_spectrum_says_that_a_fit_is_poor_and_why(invoke, tmp_path):
    """Beyond its cut-off a Gaussian filter leaves a normal distribution of the wavenumber, no power law."""
    grid = rc.Grid((192, 192), 1e-6)
    surface = rc.self_affine(grid, 0.8, 1e-7, np.random.default_rng(7), amplitudes="gaussian")
    rc.write(surface, tmp_path / "whole.npz")
    rc.write(surface.filtered(short_cutoff=1e-5), tmp_path / "filtered.npz")
    rc.write(rc.Surface(surface.filtered(short_cutoff=1e-5).heights, grid), tmp_path / "silent.npz")

    def ask(name, *words):
        answer = invoke("surface", "spectrum", tmp_path / name, *words, "--json")
        notes = json.loads(answer.stdout)["notes"]
        assert all(f"Note: {line}" in answer.stderr for line in notes)
        return notes

    assert ask("whole.npz") == []
    (line,) = ask("filtered.npz")
    assert line.startswith("the fit is poor, misfit ")
    assert line.endswith("of a filter that removed waves below 10 µm; give --shortest 3e-05")
    assert ask("filtered.npz", "--shortest", "3e-05") == []
    (line,) = ask("silent.npz")
    assert line.endswith("the spectrum is no power law; narrow the band by --longest and --shortest")


@pytest.fixture
def spiky(tmp_path):
    """Return the file of a tilted rough map with two spikes and a step, and the map."""
    grid = rc.Grid((64, 80), 1e-6)
    heights = rc.self_affine(grid, 0.8, 1e-7, np.random.default_rng(3)).heights + 5e-8 * np.arange(80)
    heights[20, 30:32] += 5e-6
    heights[40, 10] -= 4e-6
    made = rc.Surface(heights, grid)
    rc.write(made, tmp_path / "spiky.npz")
    return tmp_path / "spiky.npz", made


@pytest.mark.usefixtures("drawn")
def test_info_draws_the_spikes_that_it_counts(invoke, spiky, tmp_path, monkeypatch):
    path, _ = spiky
    drawn, make = [], canvas.surface_figure
    monkeypatch.setattr(canvas, "surface_figure", lambda *given: drawn.append(make(*given)) or drawn[-1])
    answer = invoke("surface", "info", path, "--out", tmp_path / "out", "--format", "svg", "--json")
    assert answer.exit_code == 0, answer.stderr
    assert (tmp_path / "out" / "surface.svg").read_bytes().startswith(b"<?xml")
    assert "surface.svg is in" in answer.stderr
    heights = drawn[0].axes[0]
    (rings,) = heights.collections
    assert len(rings.get_offsets()) == json.loads(answer.stdout)["spikes"] == 2


def test_prepare_despikes_and_masks_in_its_order(invoke, spiky, tmp_path):
    path, made = spiky
    out = tmp_path / "out.npz"
    answer = invoke(
        *(
            "surface",
            "prepare",
            path,
            out,
            "--level",
            "plane",
            "--despike",
            "filled",
            "--mask",
            "above=0.2um",
        ),
        *("--mask", "ellipse=0:20,0:30", "--mask", "outside-box=0:60,:", "--crop", ":,:70"),
    )
    assert answer.exit_code == 0, answer.stderr
    assert "'surface prepare --despike'" not in answer.stderr  # it is done
    assert "Note: despiked: 2 spikes of 3 cells filled in, harmonic" in answer.stderr
    expected = made.cropped(slice(None), slice(None, 70)).despiked("filled")
    expected = expected.masked(ellipse=(slice(0, 20), slice(0, 30)))
    expected = expected.masked(box=(slice(0, 60), slice(None)), outside=True).levelled("plane")
    expected = expected.masked(above=0.2e-6)
    found = rc.read(out)
    np.testing.assert_allclose(found.heights, expected.heights, rtol=0, atol=1e-13 * made.rms)
    assert [line for line in found.provenance if "mask" in line or "despiked: " in line] == [
        line for line in expected.provenance if "mask" in line or "despiked: " in line
    ]
    again = invoke("surface", "prepare", out, tmp_path / "again.npz", "--despike", "missing")
    assert "Note: no spikes were found" in again.stderr


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("circle=0:5,0:5", "--mask: 'circle=0:5,0:5' is not a region"),
        ("box=1-5,3", "--mask: '1-5,3' is not a part of a map"),
        ("ellipse=0:5", "2 in all, not 1; give rows and columns"),
        ("above=3N", "--mask: '3N' is not a length"),
        ("above=-1m", "leaves no measured point"),
    ],
)
def test_prepare_refuses_what_is_no_mask(invoke, spiky, tmp_path, text, words):
    answer = invoke("surface", "prepare", spiky[0], tmp_path / "out.npz", "--mask", text)
    assert (answer.exit_code, words in answer.stderr) == (2, True), answer.stderr


def test_the_help_of_mask_begins_with_heights(invoke):
    shown = " ".join(invoke("surface", "prepare", "--help-all").stdout.replace("│", " ").split())
    assert "--mask above=3um " in shown
    assert -1 < shown.find("heights above") < shown.find("box= or")


@pytest.mark.parametrize("kind", ["missing", "filled"])
def test_press_and_curve_leave_spikes_out_when_asked(invoke, spiky, kind):
    path, made = spiky
    words = ("press", path, "--force", "1mN", "--modulus", "1GPa", "--json")
    with_spikes, without = invoke(*words), invoke(*words, "--despike", kind)
    assert "2 spikes of 3 cells" in with_spikes.stderr  # never pressed in silence
    assert "despiked: 2 spikes of 3 cells" in without.stderr
    clean = made.despiked(kind).levelled("plane")
    assert json.loads(without.stdout)["depth"] == rc.press(clean, 1e9, force=1e-3).depth
    assert json.loads(with_spikes.stdout)["depth"] == rc.press(made.levelled("plane"), 1e9, force=1e-3).depth
    assert any(line.startswith("despiked: ") for line in json.loads(without.stdout)["surface"])


def _suspicions(invoke, surface, path):
    rc.write(surface, path)
    record = json.loads(invoke("surface", "info", path, "--json").stdout)
    table = invoke("surface", "info", path).stdout
    assert all(line in table for line in record["suspicious"])
    assert ("these options of 'roughcontact surface prepare'" in table) == bool(record["suspicious"])
    return record


def test_info_says_what_is_suspicious_and_what_mends_it(invoke, spiky, tmp_path):
    """Each in a map that has it, and gone once the option that is named has been taken."""
    path, made = tmp_path / "map.npz", spiky[1]
    plain = made.despiked("filled").without_form(2)
    assert _suspicions(invoke, plain, path)["suspicious"] == []
    y, x = np.mgrid[:64, :80]
    cases = {
        "spikes: 2 spikes of 3 cells, the largest by 5": (made.heights - 5e-8 * x, "--despike"),
        "tilt: the plane has an rms height of 1.": (plain.heights + 5e-8 * x, "--level plane"),
        "form: the quadratic part has an rms height of ": (plain.heights + 5e-10 * (x - 40) ** 2, "--form 2"),
        "step: ": (plain.heights + 1e-6 * (y > 22), "between rows 22 and 23: --crop 23:64,:"),
        "missing points: 10": (np.where(x < 8, np.nan, plain.heights), "--fill"),
    }
    for start, (heights, option) in cases.items():
        found = _suspicions(invoke, rc.Surface(heights, plain.grid), path)
        lines = [line for line in found["suspicious"] if line.startswith(start)]
        assert len(lines) == 1, (start, found["suspicious"])
        assert option in lines[0]
        assert found["spikes"] == (2 if start.startswith("spikes") else 0)
    few = _suspicions(invoke, plain.cropped(slice(0, 12), slice(0, 40)), path)["suspicious"]
    assert any(line.startswith("few cells: 12 x 40") for line in few)
