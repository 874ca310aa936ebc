"""What is wrong is said beside the field that mends it; what the page shows of a surface are the library's numbers."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.page.jobs.bodies_job import bodies
from roughcontact.page.jobs.session_cache import SessionCache, UploadedFile
from roughcontact.page.jobs.surface_jobs import look, study
from roughcontact.page.recipe import FileSource, as_recipe
from roughcontact.page.refusal import refusal
from roughcontact.page.server.page_request import PageRequest

WRONG = [
    ("short_cutoff", {"preparation": {"short_cutoff": "10"}}),
    ("short_cutoff", {"preparation": {"short_cutoff": "1 m"}}),
    ("short_cutoff", {"preparation": {"short_cutoff": "1nm"}}),
    ("long_cutoff", {"preparation": {"long_cutoff": "some"}}),
    ("crop", {"preparation": {"crop": [20, 20, 0, 48]}}),
    ("downsample", {"preparation": {"downsample": 40}}),
    ("unit", {"source": {"unit": "second"}}),
    ("width", {"source": {"width": "500"}}),
    ("width", {"source": {"height": "500um"}}),
    ("second", {"bodies": {"materials": ["rigid", "rigid"]}}),
    ("modulus", {"bodies": {"modulus": "100"}}),
    ("young", {"bodies": {"poisson": "0.3"}}),
    ("poisson2", {"bodies": {"young": "1GPa", "poisson": "0.3", "young2": "1GPa", "poisson2": "0.7"}}),
    ("hardness", {"bodies": {"modulus": "1GPa", "hardness": "-2GPa"}}),
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
    source = {"kind": "file", "file": "key"} | recipe.get("source", {})
    request, heard = PageRequest(as_recipe({**recipe, "source": source}), files, {}), {}
    job(request, SessionCache(), lambda header, _=b"": heard.update({header["type"]: header}))
    return heard


@pytest.mark.parametrize(("field", "recipe"), WRONG, ids=lambda value: str(value)[:40])
def test_what_is_wrong_belongs_to_a_field(field, recipe, files):
    with pytest.raises(ValueError) as error:
        ordered(bodies if "bodies" in recipe else look, files, recipe)
    end = refusal(error.value)
    assert (end["how"], end["field"]) == ("refused", field)
    assert end["message"].endswith(".")
    assert "_" not in end["message"]


def test_a_study_shows_the_numbers_of_the_library(files):
    heard = ordered(study, files, {"preparation": {"level": "plane", "despike": "filled"}})
    raw, _ = SessionCache().read(FileSource("file", "key"), files)
    surface = raw.despiked("filled").levelled("plane")
    histogram = rc.height_histogram(surface, bins=80)
    assert heard["heights"]["x"] == histogram.centres.tolist()
    assert heard["heights"]["y"] == histogram.density.tolist()
    assert set(heard["spectrum"]["y"]) <= set(rc.power_spectrum(surface.filled(), per_decade=40).density)
    shown = {name: value for name, _, value in heard["roughness"]["facts"]}
    assert shown["Sku"] == f"{rc.areal_parameters(surface).Sku:.4g}"
    assert shown["rms slope"] == f"{rc.surface_moments(surface).rms_slope:.4g}"


def test_warnings_are_those_of_the_file_and_name_the_step_that_mends_them(files):
    heard = ordered(study, files, {"preparation": {"despike": "filled", "fill": True}})
    steps = {warning["kind"]: warning["step"] for warning in heard["warnings"]["warnings"]}
    assert steps["spikes"] == ("despike", "filled")
    assert steps["missing points"] == ("fill", "")


def test_the_file_is_described_before_its_preparation(files):
    heard = ordered(look, files, {"preparation": {"crop": [0, 24, 0, 12]}})
    assert heard["surface"]["raw"]["shape"] == (48, 48)
    assert heard["surface"]["raw"]["missing"] == 2
    assert heard["map"]["cells"] == (24, 12)


def test_bodies_are_those_of_the_handbooks(files):
    heard = ordered(bodies, files, {"bodies": {"materials": ["steel", "rigid"], "hardness": "steel"}})
    steel = rc.handbook("steel")
    assert heard["bodies"]["modulus"] == rc.reduced_modulus(steel.solid)
    assert heard["bodies"]["hardness"] == steel.hardness
