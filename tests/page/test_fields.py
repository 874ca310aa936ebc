"""What is wrong is said beside the field that mends it; what the page shows of a surface are the library's numbers."""

import re

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.page.jobs.bodies_job import bodies
from roughcontact.page.jobs.session_cache import SessionCache, UploadedFile
from roughcontact.page.jobs.surface_jobs import look, study
from roughcontact.page.refusal import refusal
from roughcontact.page.server.page_request import PageRequest

WRONG = [
    ("preparation.short_cutoff", {"preparation": {"short_cutoff": "10kg"}}),
    ("preparation.short_cutoff", {"preparation": {"short_cutoff": "1 m"}}),
    ("preparation.short_cutoff", {"preparation": {"short_cutoff": "1nm"}}),
    ("preparation.long_cutoff", {"preparation": {"long_cutoff": "some"}}),
    ("preparation.long_cutoff", {"preparation": {"long_cutoff": "1nm"}}),
    ("preparation.long_cutoff", {"preparation": {"short_cutoff": "9um", "long_cutoff": "8um"}}),
    ("preparation.crop", {"preparation": {"crop": "20:20,0:48"}}),
    ("preparation.downsample", {"preparation": {"downsample": "40"}}),
    ("preparation.mask", {"preparation": {"mask": ["circle=3"]}}),
    ("preparation.tip", {"preparation": {"tip": "1m"}}),
    ("preparation.alias", {"preparation": {"alias": True}}),
    ("preparation.share", {"preparation": {"window": "hann", "share": "0.2"}}),
    ("source.unit", {"source": {"unit": "second"}}),
    ("source.size", {"source": {"size": "500um x"}}),
    ("bodies.materials", {"bodies": {"materials": "rigid,rigid"}}),
    ("bodies.modulus", {"bodies": {"modulus": "100"}}),
    ("bodies.poisson", {"bodies": {"poisson": "0.3"}}),
    ("bodies.poisson2", {"bodies": {"young": "1GPa", "poisson": "0.3", "young2": "1GPa", "poisson2": "0.7"}}),
    ("plastic.hardness", {"bodies": {"modulus": "1GPa"}, "plastic": {"hardness": "-2GPa"}}),
    ("plastic.hardness", {"bodies": {"modulus": "1GPa"}, "plastic": {"loop": True}}),
]


@pytest.fixture
def files(tmp_path):
    """Return a measured surface with a spike and without two points, as the server keeps it."""
    heights = rc.self_affine(rc.Grid((48, 48), 1e-6), 0.8, 1e-7, np.random.default_rng(2)).heights.copy()
    heights[10, 20], heights[30, 5:7] = 9e-6, np.nan
    rc.write(rc.Surface(heights, rc.Grid((48, 48), 1e-6)), tmp_path / "part.npz")
    return {"key": UploadedFile(tmp_path / "part.npz", "part.npz")}


def ordered(job, files, recipe):
    """Return the messages that answer a request, by their type."""
    name = "curve" if "bodies" in recipe else "surface"
    source = {"kind": "file", "file": "key"} | recipe.get("source", {})
    request, heard = PageRequest.of({"job": name, **recipe, "source": source}, files, {}), {}
    job(request, SessionCache(), lambda header, _=b"": heard.update({header["type"]: header}))
    return heard


@pytest.mark.parametrize(("field", "recipe"), WRONG, ids=lambda value: str(value)[:40])
def test_what_is_wrong_belongs_to_a_field(field, recipe, files):
    with pytest.raises(ValueError) as error:
        ordered(bodies if "bodies" in recipe else look, files, recipe)
    end = refusal(error.value)
    assert end["how"] == "refused"
    assert field in end["places"]
    assert end["message"].endswith(".")


def test_a_study_shows_the_numbers_of_the_library(files):
    heard = ordered(study, files, {"preparation": {"level": "plane", "despike": "filled"}})
    with pytest.warns(rc.SurfaceWarning):
        surface = rc.read(files["key"].path)
    surface = surface.despiked("filled").levelled("plane")
    # Of 48 x 48 heights, Rice's rule makes 27 bars.
    histogram = rc.height_histogram(surface, bins=27)
    assert heard["heights"]["x"] == histogram.centres.tolist()
    assert heard["heights"]["y"] == histogram.density.tolist()
    assert set(heard["spectrum"]["y"]) <= set(rc.power_spectrum(surface.filled(), per_decade=40).density)
    shown = {name: value for name, _, value in heard["roughness"]["facts"]}
    assert shown["Sku"] == f"{rc.areal_parameters(surface).Sku:.4g}"
    assert shown["rms slope"] == f"{rc.surface_moments(surface).rms_slope:.4g}"


def test_a_spike_takes_no_room_in_the_distribution_and_is_named(files):
    spiky = ordered(study, files, {})["heights"]
    assert max(spiky["x"]) < 1e-6
    assert re.fullmatch(r"Beyond the axis: 0\.04\d* % of the heights, .* µm\.", spiky["beyond"])
    assert ordered(study, files, {"preparation": {"despike": "filled"}})["heights"]["beyond"] == ""


def test_warnings_are_those_of_the_file_and_name_the_step_that_mends_them(files):
    heard = ordered(study, files, {"preparation": {"despike": "filled", "fill": True}})
    steps = {warning["kind"]: warning["step"] for warning in heard["warnings"]["warnings"]}
    assert steps["spikes"] == ("despike", "filled")
    assert steps["missing points"] == ("fill", "")
    assert not any(warning["left"] for warning in heard["warnings"]["warnings"])


def test_what_a_step_has_left_is_said(files):
    """A block too large for a spike stays when spikes are filled, and goes with its mask."""
    with pytest.warns(rc.SurfaceWarning):
        heights = rc.read(files["key"].path).heights.copy()
    heights[20:25, 30:36] = -5e-6 + 1e-9 * np.arange(6)
    rc.write(rc.Surface(heights, rc.Grid((48, 48), 1e-6)), files["key"].path)

    def left(**preparation):
        heard = ordered(study, files, {"preparation": {"level": "plane", **preparation}})
        found = heard["warnings"]["warnings"]
        return {each["kind"]: (each["step"], each["left"]) for each in found}

    step, still = left(despike="filled")["points far below"]
    assert (step[0], still) == ("mask", True)
    masked = left(despike="filled", mask=[step[1]])
    assert masked["points far below"] == (step, False)
    assert masked["spikes"] == (("despike", "filled"), False)
    assert masked["missing points"][1]


def test_the_file_is_described_before_its_preparation(files):
    heard = ordered(look, files, {"preparation": {"crop": "0:24,0:12"}})
    assert heard["surface"]["raw"]["shape"] == (48, 48)
    assert heard["map"]["cells"] == (24, 12)


def test_bodies_are_those_of_the_handbooks(files):
    heard = ordered(bodies, files, {"bodies": {"materials": "steel,rigid"}, "plastic": {"hardness": "steel"}})
    steel = rc.handbook("steel")
    assert heard["bodies"]["modulus"] == rc.reduced_modulus(steel.solid)
    assert heard["bodies"]["hardness"] == steel.hardness


def test_bodies_by_name_are_told_in_numbers_too(files):
    heard = ordered(bodies, files, {"bodies": {"materials": "steel,gold"}})["bodies"]
    again = ordered(
        bodies,
        files,
        {"bodies": {name: heard["same"][name] for name in ("young", "poisson", "young2", "poisson2")}},
    )
    assert again["bodies"]["modulus"] == heard["modulus"]
    assert heard["lines"][0].startswith("Reduced modulus E*")


def test_a_step_that_is_added_begins_with_the_surface_before_it(files, monkeypatch):
    cache, spoken = SessionCache(), []
    despiked = rc.Surface.despiked
    monkeypatch.setattr(
        rc.Surface, "despiked", lambda self, *given: spoken.append(1) or despiked(self, *given)
    )
    for steps in ({}, {"window": "hann"}, {"fill": True, "window": "hann"}):
        plain = {"job": "surface", "source": {"kind": "file", "file": "key"}}
        request = PageRequest.of({**plain, "preparation": {"despike": "filled", **steps}}, files, {})
        surface = cache.surface(request.job)
    assert len(spoken) == 1
    with pytest.warns(rc.SurfaceWarning):
        raw = rc.read(files["key"].path)
    expected = despiked(raw, "filled").filled().tapered("hann")
    np.testing.assert_array_equal(surface.heights, expected.heights)


def test_a_spike_is_ringed_and_does_not_set_the_colours_until_it_is_gone(files):
    spiky = ordered(look, files, {"preparation": {"level": "mean"}})["map"]
    assert spiky["ends"][1] > 8e-6 > 1e-6 > spiky["colours"][1]
    plain = ordered(look, files, {"preparation": {"level": "mean", "despike": "filled"}})["map"]
    assert plain["colours"] == plain["ends"]
    assert ordered(study, files, {})["spikes"]["places"] == [[10, 20]]
    assert ordered(study, files, {"preparation": {"despike": "filled"}})["spikes"]["places"] == []


@pytest.mark.parametrize(
    ("source", "exponent"),
    [
        ({"kind": "shape", "shape": "sphere", "radius": "5mm", "size": "0.2mm", "points": "64"}, False),
        ({"kind": "example", "example": "ground"}, False),
        ({"kind": "self-affine", "hurst": "0.8", "rms": "1um", "size": "1mm", "points": "64"}, True),
    ],
)
def test_a_hurst_exponent_is_shown_where_the_spectrum_is_a_power_law(source, exponent):
    heard = {}
    request = PageRequest.of({"job": "surface", "source": source}, {}, {})
    study(request, SessionCache(), lambda header, _=b"": heard.update({header["type"]: header}))
    name, words, value = heard["roughness"]["facts"][-1]
    assert name == "Hurst exponent"
    assert (value != "none") == exponent
    assert ("no power law" in words) != exponent
