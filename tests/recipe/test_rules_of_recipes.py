"""What does not go together in a recipe, and what is none: refused with a place and a remedy that works."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from every_field import SMALLEST, SOURCE, refused, smallest
from roughcontact.cli.app import app
from roughcontact.errors import InputError
from roughcontact.recipe.bodies import Bodies
from roughcontact.recipe.contact import Contact
from roughcontact.recipe.elastic_jobs import PressJob, SurfaceJob
from roughcontact.recipe.jobs import JOBS, calls_of, surface_calls
from roughcontact.recipe.prescribed_loads import OneLoad
from roughcontact.recipe.source import Combined, Example, File, InPython
from roughcontact.recipe.written import from_plain, read_job, require_same_files, to_plain


def with_parts(job, kind="file", **parts):
    """Return a small job with other parts, each a table that is laid over the one that it has; None leaves it out."""
    plain = smallest(job, kind)
    merged = {
        name: plain.get(name, {}) | part if isinstance(part, dict) else part for name, part in parts.items()
    }
    return {name: part for name, part in (plain | merged).items() if part is not None}


def without(job, part, name):
    plain = smallest(job)
    del plain[part][name]
    return plain


PROFILE = {"profile": "line"}
SPRINGS = {"profile": "winkler"}
YOUNG = {"modulus": None, "young": "210GPa", "poisson": "0.3", "young2": "70GPa", "poisson2": "0.33"}
NAMED = {"modulus": None, "materials": "steel,aluminium"}
HEARD = {"frequency": "5MHz", "density": "7850kg/m^3,2700kg/m^3"}
# A recipe that no field alone makes wrong, where the error is, words of it, and recipes that its remedy says.
RULES = [
    (smallest("press") | {"format": 2}, "format", "the recipe has the format 2", [smallest("press")]),
    (smallest("press") | {"job": "pres"}, "job", "no job 'pres'", [smallest(job) for job in JOBS]),
    (smallest("press") | {"job": None}, "job", "no job is named", [smallest(job) for job in JOBS]),
    ({"name": "hurst", "case": "curve"}, "job", "this is a study, not a job", [smallest("curve")]),
    (smallest("press") | {"job": ["press"]}, "job", "no job ['press']", [smallest("press")]),
    (with_parts("press", loads={"force": "1N"}), "loads", "unknown field 'loads'", [smallest("press")]),
    (with_parts("press", load=None), "load", "load is missing", [smallest("press")]),
    (with_parts("press", source=None), "source", "source is missing", [smallest("press")]),
    (with_parts("press", bodies="steel"), "bodies", "'steel' is not a table of fields", [smallest("press")]),
    (
        with_parts("press", source="part.x3p"),
        "source",
        "'part.x3p' is not a table of fields",
        [smallest("press")],
    ),
    (
        without("press", "source", "file"),
        "source.kind",
        "no kind None",
        [smallest("press", kind) for kind in SOURCE if kind != "python"],
    ),
    (
        with_parts("press", source={"kind": "fractal"}),
        "source.kind",
        "no kind 'fractal'",
        [smallest("press")],
    ),
    (with_parts("press", source={"kind": ["file"]}), "source.kind", "no kind ['file']", [smallest("press")]),
    (
        with_parts("surface", "combined", source={"upper": {"example": "ground"}}),
        "source.upper.kind",
        "no kind None",
        [smallest("surface", "combined")],
    ),
    (
        with_parts("surface", "combined", source={"upper": None}),
        "source.upper",
        "None is not a table of fields",
        [smallest("surface", "combined")],
    ),
    (
        with_parts("press", contact={"operator": "fft"}),
        "contact.operator",
        "unknown field 'operator'",
        [with_parts("press", contact=PROFILE)],
    ),
    (
        with_parts("press", bodies={"moduls": "1GPa"}),
        "bodies.moduls",
        "did you mean modulus?",
        [smallest("press")],
    ),
    (
        without("adhesion press", "adhesion", "work"),
        "adhesion.work",
        "work is missing",
        [smallest("adhesion press")],
    ),
    (
        without("press", "load", "depth"),
        "load.force",
        "`force`, `pressure` or `depth` is required",
        [with_parts("press", load={"force": "10N", "depth": None})],
    ),
    (
        without("press", "bodies", "modulus"),
        "bodies.modulus",
        "`modulus`, `materials` or `young` is",
        [smallest("press")],
    ),
    (
        with_parts("press", load={"force": "1N"}),
        "load.force, load.depth",
        "exclude each other",
        [smallest("press"), with_parts("press", load={"force": "1N", "depth": None})],
    ),
    (
        with_parts("press", bodies={"materials": "steel,steel"}),
        "bodies.modulus, bodies.materials",
        "exclude each other",
        [smallest("press")],
    ),
    (
        with_parts("curve", loads={"forces": "1N,2N", "depths": "1um"}),
        "loads.forces, loads.depths",
        "exclude each other",
        [with_parts("curve", loads={"depths": "1um"})],
    ),
    (
        with_parts("adhesion detach", retreat={"forces": "0N", "depths": "0um"}),
        "retreat.depths, retreat.forces",
        "exclude each other",
        [with_parts("adhesion detach", retreat={"forces": "0N"})],
    ),
    (
        with_parts("press", bodies={"modulus": None, "young": "1GPa"}),
        "bodies.poisson",
        "give `poisson`, such as 0.3",
        [with_parts("press", bodies={"modulus": None, "young": "1GPa", "poisson": "0.3"})],
    ),
    (
        with_parts("surface", preparation={"window": "hann", "share": "0.3"}),
        "preparation.share",
        "give `window` tukey",
        [with_parts("surface", preparation={"window": "tukey", "share": "0.3"})],
    ),
    (
        with_parts("surface", "shape", source={"slope": "0.1"}),
        "source.slope",
        "leave out `slope`",
        [smallest("surface", "shape")],
    ),
    (
        with_parts("surface", "shape", source={"shape": "cone", "radius": None}),
        "source.slope",
        "give `slope`",
        [with_parts("surface", "shape", source={"shape": "cone", "radius": None, "slope": "0.1"})],
    ),
    (
        with_parts("surface", "self-affine", source={"long_cutoff": "1um", "short_cutoff": "2um"}),
        "source.short_cutoff, source.long_cutoff",
        "exchange them",
        [with_parts("surface", "self-affine", source={"long_cutoff": "2um", "short_cutoff": "1um"})],
    ),
    (
        with_parts("surface", "self-affine", source={"nodal": True, "periodic": True}),
        "source.nodal",
        "leave out one of them",
        [
            with_parts("surface", "self-affine", source={"nodal": True}),
            with_parts("surface", "self-affine", source={"periodic": True}),
        ],
    ),
    (
        with_parts("press", plastic={"after": "2um"}),
        "plastic.hardness",
        "which is not given",
        [
            with_parts("press", plastic={"after": "2um", "hardness": "2GPa"}),
            with_parts(
                "press", plastic={"after": "2um"}, bodies={"modulus": None, "materials": "steel,copper"}
            ),
        ],
    ),
    (
        with_parts("curve", plastic={"loop": True}),
        "plastic.hardness",
        "which is not given",
        [with_parts("curve", plastic={"loop": True, "hardness": "copper"})],
    ),
    (
        with_parts("press", contact=PROFILE, errors={"errors": True}),
        "errors.errors",
        "leave it out",
        [with_parts("press", contact=PROFILE), with_parts("press", errors={"errors": True})],
    ),
    (
        with_parts("press", contact=SPRINGS, plastic={"hardness": "2GPa"}),
        "plastic.hardness",
        "take `profile` line",
        [
            with_parts("press", contact=SPRINGS),
            with_parts("press", contact=PROFILE, plastic={"hardness": "2GPa"}),
        ],
    ),
    (
        with_parts("press", errors={"errors": True}, plastic={"hardness": "2GPa", "after": "2um"}),
        "errors.errors",
        "leave out one",
        [with_parts("press", errors={"errors": True})],
    ),
    (
        with_parts("press", errors={"errors": True}, plastic={"hardness": "2GPa", "flow": "raised"}),
        "errors.errors",
        "leave out one",
        [with_parts("press", plastic={"hardness": "2GPa", "flow": "raised"})],
    ),
    (
        with_parts("press", contact=PROFILE, theories={"theory": "persson"}),
        "theories.theory",
        "leave it out",
        [with_parts("press", contact=PROFILE)],
    ),
    (
        with_parts("press", contact=PROFILE, load={"force": "10N", "depth": None}),
        "load.force",
        "write a force per length such as 10N/mm",
        [with_parts("press", contact=PROFILE, load={"force": "10N/mm", "depth": None})],
    ),
    (
        with_parts("curve", contact=SPRINGS, loads={"pressures": "1MPa,2MPa"}),
        "loads.pressures",
        "write a force per length such as 1N/mm",
        [with_parts("curve", contact=SPRINGS, loads={"pressures": "1N/mm,2N/mm"})],
    ),
    (
        with_parts("curve", errors={"errors": True}, plastic={"hardness": "2GPa", "flow": "raised"}),
        "errors.errors",
        "leave out one",
        [with_parts("curve", errors={"errors": True}, plastic={"hardness": "2GPa"})],
    ),
    (
        with_parts("curve", plastic={"hardness": "2GPa", "loop": True}, loads={"depths": "1um"}),
        "loads.depths",
        "give `forces`",
        [with_parts("curve", plastic={"hardness": "2GPa", "loop": True}, loads={"forces": "1N"})],
    ),
    (
        with_parts("curve", contact=PROFILE, conduction={"resistivity": "copper"}),
        "conduction",
        "leave out `resistivity`",
        [with_parts("curve", contact=PROFILE)],
    ),
    (
        with_parts("curve", contact=SPRINGS, conduction={"resistivity": "copper"}),
        "conduction.of",
        "give `of` total",
        [with_parts("curve", contact=SPRINGS, conduction={"resistivity": "copper", "of": "total"})],
    ),
    (
        with_parts("curve", contact=PROFILE, ultrasound={"frequency": "5MHz"}),
        "ultrasound.frequency",
        "leave it out",
        [with_parts("curve", contact=PROFILE)],
    ),
    *(
        (
            with_parts("curve", bodies={"modulus": None} | bodies, ultrasound={"frequency": "5MHz"}),
            "ultrasound.frequency",
            "name both by `materials`, such as steel,aluminium",
            [with_parts("curve", bodies=NAMED, ultrasound={"frequency": "5MHz"})],
        )
        for bodies in (
            {"modulus": "110GPa"},
            {"materials": "steel,rigid"},
            {"young": "210GPa", "poisson": "0.3"},
        )
    ),
    (
        with_parts("curve", bodies=YOUNG, ultrasound={"frequency": "5MHz"}),
        "ultrasound.density",
        "give `density`, such as 7850kg/m^3,2700kg/m^3",
        [with_parts("curve", bodies=YOUNG, ultrasound=HEARD)],
    ),
    (
        with_parts("curve", bodies=YOUNG | {"poisson2": "0.5"}, ultrasound=HEARD),
        "bodies.poisson2",
        "give a smaller one, such as 0.49",
        [with_parts("curve", bodies=YOUNG | {"poisson2": "0.49"}, ultrasound=HEARD)],
    ),
    (
        with_parts("press", contact=SPRINGS, units={"unit_stiffness": "N/um/mm^2"}),
        "units.unit_stiffness, units.unit_pressure",
        "leave them out",
        [with_parts("press", contact=SPRINGS)],
    ),
    (
        with_parts("curve", contact=SPRINGS, units={"unit_pressure": "MPa"}),
        "units.unit_stiffness, units.unit_pressure",
        "leave them out",
        [with_parts("curve", contact=SPRINGS)],
    ),
    (
        with_parts("curve", theories={"theory": "hertz"}),
        "theories.radius",
        "give `radius`, such as 5mm",
        [with_parts("curve", theories={"theory": "hertz", "radius": "5mm"})],
    ),
    (
        with_parts("curve", theories={"theory": "ceb"}),
        "plastic.hardness",
        "give `hardness`, such as 2GPa or aluminium",
        [
            with_parts("curve", theories={"theory": "ceb"}, plastic={"hardness": hardness})
            for hardness in ("2GPa", "aluminium")
        ],
    ),
    (
        with_parts("curve", tables={"table": "csv", "table_area": "1mm^2"}),
        "tables.table_area",
        "leave it out",
        [with_parts("curve", tables={"table": "csv"})],
    ),
    (
        with_parts("curve", tables={"table": "lammps", "friction": "0.3"}, bodies=NAMED),
        "tables.friction",
        "leave it out",
        [with_parts("curve", tables={"table": "lammps"}, bodies=NAMED)],
    ),
    (
        with_parts("curve", tables={"table": "calculix", "friction": "0.3"}),
        "tables.friction",
        "name both by `materials`, such as steel,aluminium",
        [with_parts("curve", tables={"table": "calculix", "friction": "0.3"}, bodies=NAMED)],
    ),
    (
        smallest("adhesion press") | {"load": {"force": "-1mN"}},
        "load.force",
        "compute an adhesion curve with `forces` 0,-1mN",
        [smallest("adhesion curve") | {"loads": {"forces": "0,-1mN"}}],
    ),
    (
        with_parts("adhesion detach", retreat={"forces": "2mN,0N"}),
        "retreat.forces",
        "begin with 0.001 or less",
        [
            with_parts("adhesion detach", retreat={"forces": "0.001,0N"}),
            with_parts("adhesion detach", retreat={"forces": "2mN,0N"}, load={"force": "2mN"}),
        ],
    ),
]


@pytest.mark.parametrize(
    ("wrong", "place", "words", "right"), RULES, ids=[f"{row[1]}: {row[2]}" for row in RULES]
)
def test_what_does_not_go_together_is_refused_and_the_remedy_works(wrong, place, words, right):
    error = refused(wrong)
    assert (error.place, words in str(error)) == (place, True)
    for plain in right:
        assert list(calls_of(from_plain(plain)))


@pytest.mark.parametrize("job", JOBS)
def test_the_smallest_jobs_are_whole_and_miss_any_part_that_must_be_there(job):
    assert SMALLEST.keys() == JOBS.keys()
    assert list(calls_of(from_plain(smallest(job))))
    for part in ("source", *SMALLEST[job]):
        plain = smallest(job)
        del plain[part]
        if (job, part) in {("curve", "loads")}:
            from_plain(plain)
        else:
            assert refused(plain).place == part


@pytest.mark.parametrize(
    ("source", "place", "words", "right"),
    [
        ({"kind": "example", "example": "ground"}, "source.example", "not a profile", None),
        (SOURCE["combined"], "source.upper.example", "not a profile", None),
        (SOURCE["self-affine"] | {"size": "1mm x 2mm"}, "source.size", "give one number", {"size": "1mm"}),
        (SOURCE["shape"] | {"points": "16x32"}, "source.points", "give one number", {"points": "32"}),
    ],
    ids=str,
)
def test_a_source_without_profile_is_refused_before_anything_is_read(source, place, words, right):
    """Of two files the first would be read otherwise, which is not there."""
    plain = with_parts("press", contact=PROFILE) | {"source": source}
    with pytest.raises(InputError, match=words) as met:
        surface_calls(from_plain(plain))
    assert met.value.place == place
    mended = plain | ({"contact": {}} if right is None else {"source": source | right})
    assert surface_calls(from_plain(mended))


def test_heights_that_were_made_in_python_are_named_and_not_made_again():
    plain = smallest("press", "python")
    plain["source"]["history"] = ["a hill", "levelled"]
    job = from_plain(plain)
    assert to_plain(job)["source"] == plain["source"]
    with pytest.raises(
        InputError, match=r"made in Python \(a hill; levelled\): write them by rc.write"
    ) as met:
        surface_calls(job)
    assert met.value.place == "source"


GRID = rc.Grid((4, 4), 1e-6)


def test_a_surface_of_python_has_the_name_of_its_heights():
    ball, other = (rc.shapes.sphere(GRID, radius) for radius in (1e-3, 2e-3))
    assert InPython.of(ball) == InPython.of(rc.shapes.sphere(GRID, 1e-3))
    assert InPython.of(ball).surface_sha256 != InPython.of(other).surface_sha256
    job = PressJob(source=InPython.of(ball), load=OneLoad(force="1mN"), bodies=Bodies(modulus="1GPa"))
    assert from_plain(to_plain(job)) == job
    assert to_plain(job)["source"]["history"] == list(ball.provenance)


@pytest.mark.parametrize(
    ("made", "place"),
    [
        (lambda: PressJob(source=rc.shapes.sphere(GRID, 1e-3), load=LOAD, bodies=BODIES), "source"),
        (lambda: PressJob(source="part.x3p", load=LOAD, bodies=BODIES), "source"),
        (lambda: PressJob(source=np.zeros, load=LOAD, bodies=BODIES), "source"),
        (lambda: PressJob(source=MAP, load=1.0, bodies=BODIES), "load"),
        (lambda: PressJob(source=MAP, load=LOAD, bodies=1e9), "bodies"),
        (lambda: PressJob(source=MAP, load=LOAD, bodies=BODIES, contact=rc.half_space(GRID, 1e9)), "contact"),
        (lambda: SurfaceJob(source=File), "source"),
        (lambda: Combined(lower=MAP, upper=rc.shapes.sphere(GRID, 1e-3)), "upper"),
        (lambda: Bodies(modulus=lambda: 1e9), "modulus"),
        (lambda: OneLoad(force=rc.half_space(GRID, 1e9)), "force"),
        (lambda: Contact(profile=rc.line), "profile"),
    ],
)
def test_functions_operators_and_surfaces_of_python_are_refused_with_a_word(made, place):
    with pytest.raises(InputError, match=r"is neither a text nor a number|is not a `\w+` of a recipe") as met:
        made()
    assert met.value.place == place
    assert met.value.remedy


MAP, LOAD, BODIES = Example(example="ground"), OneLoad(force="1mN"), Bodies(modulus="1GPa")


def test_numbers_and_quantities_of_python_are_values():
    ureg = pytest.importorskip("pint").get_application_registry()
    for load in (0.001, np.float64(0.001), "1mN", ureg.Quantity(1.0, "mN"), np.float32(0.001)):
        [number] = OneLoad(force=load).named(None).values()
        assert number == pytest.approx(0.001, rel=1e-7)
    assert from_plain(to_plain(PressJob(source=MAP, load=OneLoad(force=1), bodies=BODIES))).load.force == "1"


def test_a_file_that_changed_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rc.write(rc.shapes.sphere(GRID, 1e-3), "part.npz")
    job = from_plain(with_parts("press", source={"file": "part.npz", "sha256": "0" * 64}))
    with pytest.raises(InputError, match="its SHA-256 differs") as met:
        require_same_files(job)
    assert met.value.place == "source.sha256"
    require_same_files(from_plain(with_parts("press", source={"file": "part.npz"})))


# TOML that is wrong by itself, or holds values of kinds that only TOML has.
PRESS = "job = 'press'\n[source]\nfile = 'part.x3p'\n[bodies]\nmodulus = 1e9\n"
FILES = [
    ("[load]\nforce = 10 N", "it is not valid TOML", None),
    ("job = 'press'\njob = 'press'", "it is not valid TOML", None),
    (f"{PRESS}[load]\nforce = nan", "'nan' does not start", "load.force"),
    (
        f"{PRESS}[load]\nforce = 1979-05-27",
        "datetime.date(1979, 5, 27) is neither a text nor a number",
        "load.force",
    ),
    (f"{PRESS}[load.force]\nvalue = 10", "{'value': 10} is neither a text nor a number", "load.force"),
    (f"{PRESS}[load]\nforce = [10, 20]", "[10, 20] is neither a text nor a number", "load.force"),
    (
        PRESS.replace("[bodies]", "periodic = 'true'\n[load]\nforce = 1\n[bodies]"),
        "'true' is neither",
        "source.periodic",
    ),
]


@pytest.mark.parametrize(("text", "words", "place"), FILES, ids=[row[1] for row in FILES])
def test_a_wrong_file_ends_run_with_its_place_and_leaves_no_folder(text, words, place, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "job.toml").write_text(text)
    answer = CliRunner().invoke(app, ["run", "job.toml", "--json"])
    assert answer.exit_code == 2
    error = json.loads(answer.stdout)["error"]
    assert words in error["message"]
    assert place is None or error["place"] == f"recipe.{place}"
    assert error["remedy"]
    assert answer.stderr.startswith("Error: ")
    assert [path.name for path in tmp_path.iterdir()] == ["job.toml"]


def test_a_recipe_with_numbers_of_toml_is_that_of_texts(tmp_path):
    (tmp_path / "job.toml").write_text(f"{PRESS}[load]\nforce = 10\n")
    job = read_job(tmp_path / "job.toml")
    assert (job.load.force, job.bodies.modulus) == ("10", "1000000000")


def test_a_map_that_is_cropped_is_free_so_that_periodic_is_refused():
    cropped = with_parts("press", source={"periodic": True}, preparation={"crop": "0:8,0:8"})
    with pytest.raises(InputError, match="a map that is cropped is free") as refused_:
        surface_calls(from_plain(cropped))
    assert refused_.value.place == "source.periodic"
    for source, preparation in (({"periodic": True}, {}), ({}, {"crop": "0:8,0:8"})):
        assert surface_calls(from_plain(with_parts("press", source=source, preparation=preparation)))


def test_an_empty_table_of_a_file_is_refused_since_it_would_ask_for_nothing(tmp_path):
    path = tmp_path / "press.toml"
    path.write_text(
        'job = "press"\n[source]\nfile = "part.npz"\n[load]\nforce = "1 N"\n[bodies]\nmodulus = "1 GPa"\n[errors]\n'
    )
    with pytest.raises(InputError, match="the table is empty") as refused_:
        read_job(path)
    assert refused_.value.place == "errors"
    path.write_text(path.read_text() + "errors = true\n")
    assert read_job(path).errors.errors
