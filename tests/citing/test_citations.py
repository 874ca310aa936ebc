"""References: the file is whole, each entry is cited for something that exists, and answers cite what made them."""

import re
from pathlib import Path

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.citing.bibliography import references
from roughcontact.errors import InputError
from roughcontact.recipe.outputs import THEORIES
from roughcontact.recipe.written import from_plain, toml_of
from roughcontact.theory import bush_gibson_thomas
from roughcontact.theory.laws import LAWS

SOURCE = Path(rc.__file__).parent
HOME = Path(__file__).parents[2]
BIB = (SOURCE / "citing" / "references.bib").read_text(encoding="utf-8")
STATES = {"always", "free", "periodic", "hardness", "raised", "dugdale", "SurfaceTopography"}
NEEDED = {
    "article": {"author", "title", "journal", "volume", "pages", "year"},
    "book": {"author", "title", "publisher", "year"},
    "incollection": {"author", "title", "booktitle", "editor", "publisher", "year"},
    "phdthesis": {"author", "title", "school", "year"},
    "techreport": {"author", "title", "institution", "number"},
    "misc": {"author", "title"},
}
METHOD = {"roughcontact", "Pohrt2013", "Hintermueller2002", "Dostal2005", "Polonsky1999"}
STICKING = {"roughcontact", "Pohrt2013", "Rey2017", "Bertsekas1982", "Kelley1998", "Knyazev2001"}
SLIDING = {"Johnson1985", "Hueeber2008", "Ciavarella1998", "Mindlin1949"}
SOLID = rc.Solid(1e9, 0.3)
FREE = rc.Grid((32, 32), 1e-6)
BALL = rc.shapes.paraboloid(FREE, radius=1e-4)
WAVE = rc.shapes.wave(rc.Grid((32, 32), 1e-6, periodic=True), 1e-8, 32e-6)
PRESSED = rc.press(BALL, SOLID, force=1e-3)
CURVE = rc.loading_curve(BALL, 1e9, forces=[1e-3, 2e-3])
JOB = {"job": "curve", "source": {"file": "part.x3p"}, "bodies": {"modulus": "1GPa"}}


def keys(*answers):
    return {each.key for each in rc.citations(*answers).references}


def rough():
    return rc.self_affine(FREE, 0.8, 1e-7, np.random.default_rng(1))


def laws():
    """Yield each law of theory with its name."""
    known = {"radius": 1e-2, "hardness": 1e9, "hurst": 0.8, "rolloff": 3e-5}
    for name, law in LAWS.items():
        [made] = rc.loading_laws(
            rough(), 1e9, name, **{need: known[need] for need in known if need in law.needs}
        )
        yield name, made


def flowed(flow):
    return rc.loading_loop(rough(), 1e9, forces=[1e-5, 1e-4], hardness=2e7, flow=flow)


def test_the_file_is_bibtex():
    """Entries are counted without the reader: braces are balanced and each opens a line."""
    text = re.sub(r"^%.*\n", "", BIB, flags=re.MULTILINE)
    assert text.count("{") == text.count("}")
    assert re.findall(r"^@\w+\{(\w+),$", text, re.MULTILINE) == [each.key for each in references()]
    for entry in re.split(r"^(?=@)", text, flags=re.MULTILINE)[1:]:
        depth = np.cumsum([(sign == "{") - (sign == "}") for sign in entry.rstrip()])
        assert depth[-1] == 0, entry
        assert (depth[entry.index("{") : -1] > 0).all(), entry


def test_entries_have_the_fields_of_their_kind():
    assert len({each.key for each in references()}) == len(references())
    assert [each.key for each in references() if NEEDED[each.kind] - each.fields.keys()] == []
    dois = [each.fields["doi"] for each in references() if "doi" in each.fields]
    assert len(set(dois)) == len(dois)
    assert all(re.fullmatch(r"10\.\d{4,5}/\S+", doi) for doi in dois)


def test_keywords_name_what_exists():
    homes = {path.stem for path in SOURCE.rglob("*.py")} | {
        path.name for path in SOURCE.iterdir() if path.is_dir()
    }
    asked = {word for each in references() for word in each.keywords - {""}}
    assert asked - homes - set(THEORIES) - STATES == set()


def test_the_program_and_the_thesis_are_those_of_the_citation_file():
    cff = (HOME / "CITATION.cff").read_text(encoding="utf-8")
    program, thesis = references()[:2]
    assert f'title: "{program.fields["title"]}"' in cff
    assert f"name: {program.fields['author'].strip('{}')}" in cff
    assert f"version: {program.fields['note'].removeprefix('version ')}" in cff
    family, given = thesis.fields["author"].split(", ")
    said = (family, given, thesis.fields["title"], thesis.fields["school"], thesis.fields["year"])
    assert [value for value in said if value not in cff] == []


def test_journals_are_where_docstrings_say():
    """A docstring that names the journal, volume and page of an entry names its year too."""
    texts = "\n".join(path.read_text(encoding="utf-8") for path in SOURCE.rglob("*.py"))
    texts = re.sub(r"\s+", " ", texts)
    found = 0
    for each in references():
        if each.kind == "article":
            place = (
                f"{each.fields['journal']} {each.fields['volume']}, {each.fields['pages'].partition('-')[0]}"
            )
            for year in re.findall(rf"{re.escape(place)}[,]? \(?(\d{{4}})", texts):
                found += 1
                assert year == each.fields["year"], each.key
    assert found > 30


def test_an_elastic_press_and_a_loop_under_a_hardness():
    assert keys(PRESSED) == keys(CURVE) == METHOD | {"Love1929"}
    assert keys(flowed("removed")) == METHOD | {"Love1929", "Almqvist2007"}
    assert keys(flowed("raised")) == METHOD | {"Love1929", "Almqvist2007", "Pullen1972"}
    plastic = rc.loading_curve(rough(), 1e9, forces=[1e-5, 1e-4], hardness=2e7)
    assert keys(plastic) == METHOD | {"Love1929", "Almqvist2007"}
    small = rc.press(rough(), 1e9, force=1e-5, hardness=rc.NixGao(hardness=2e7, radius=1e-6))
    assert keys(small) == METHOD | {"Love1929", "Almqvist2007", "Nix1998"}


def test_bodies():
    assert keys(rc.press(WAVE, 1e9, pressure=1e5)) == METHOD | {"Westergaard1939"}
    line = rc.Grid(32, 1e-6)
    profile = rc.Surface(-(line.coordinates[0] ** 2) / 2e-4, line)
    for body, paper in ((rc.line, "Johnson1985"), (rc.foundation, "Popov2015")):
        answer = rc.press(profile, 1e9, force=1.0, operator=body(line, 1e9))
        assert keys(answer) == METHOD | {paper}
    curve = rc.loading_curve(profile, 1e9, forces=[1.0, 2.0], operator=rc.line(line, 1e9))
    assert keys(curve) == METHOD | {"Johnson1985"}
    ring = rc.RadialGrid.uniform(16, 1e-6)
    assert (
        keys(rc.press(rc.RadialProfile(-(ring.coordinates[0] ** 2) / 2e-4, ring), 1e9, force=1e-3)) == METHOD
    )
    coarse = rc.half_space(FREE, 1e9, method="multilevel")
    assert keys(rc.press(BALL, 1e9, force=1e-3, operator=coarse)) == METHOD | {"Love1929", "Brandt1990"}


def test_surfaces_that_stick():
    sticks = {law: rc.Adhesion(1e-2, 2e-7, law) for law in ("exponential", "dugdale")}
    state = rc.adhesive_state(WAVE, 1e9, sticks["dugdale"], depth=1e-9)
    assert keys(state) == STICKING | {"Westergaard1939", "Maugis1992"}
    curve = rc.adhesive_curve(WAVE, 1e9, sticks["exponential"], depths=[1e-9, 2e-9])
    assert keys(curve) == STICKING | {"Westergaard1939"}
    torn = {"Love1929", "Johnson1971", "Pohrt2015"}
    assert keys(rc.detachment_curve(PRESSED, 1e-3)) == METHOD | torn


def test_surfaces_that_slide():
    slid = rc.slide(PRESSED, SOLID, friction=0.3, force=1e-5)
    assert keys(slid) == METHOD | SLIDING | {"Love1929"}
    curve = rc.slide_curve(PRESSED, SOLID, friction=0.3, forces=[1e-5, 2e-5])
    assert keys(curve) == SLIDING | {"roughcontact", "Pohrt2013"}


def test_laws_of_shear():
    curve = rc.loading_curve(WAVE, SOLID, pressures=[1e4, 2e4, 4e4])
    law = rc.shear_law(curve, SOLID, friction=0.3)
    theory = {"Ciavarella1998", "Jaeger1998"}
    assert keys(law) == {"roughcontact", "Mindlin1949", "Delbourgo1985"} | theory
    assert keys(law.fitted.elements(3e4)) == {"roughcontact", "Iwan1966"}
    assert keys(law.history([3e4], [1e3])) == {"roughcontact"} | theory


def test_bodies_in_time():
    rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    in_time = METHOD | {"Lee1960"}
    history = {"times": [0, 1], "pressures": [1e3, 1e3], "steps": 2}
    *_, state = rc.viscoelastic_path(WAVE, rubber, **history)
    assert keys(state) == in_time | {"Westergaard1939"}
    assert keys(rc.viscoelastic_curve(WAVE, rubber, **history)) == in_time
    leaking = rc.viscoelastic_curve(WAVE, rubber, **history, measures=[rc.Transmissivity(axis=0)])
    assert keys(leaking) == in_time | {"Reynolds1886", "Patir1978"}
    elastic = rc.loading_curve(WAVE, 1e7, pressures=[1e2, 3e2, 1e3, 3e3])
    moved = rc.viscoelastic.transfer(elastic, rubber, [0, 1], forces=3e2 * WAVE.grid.area)
    assert keys(moved) == {"roughcontact", "Lee1960", "Ting1966"}
    slides = {"speed": 1e-5, "pressure": 1e3}
    anderson = in_time | {"Anderson1965", "Westergaard1939"}
    assert keys(rc.steady_sliding(WAVE, rubber, **slides)) == anderson
    speeds = rc.friction_curve(WAVE, rubber, speeds=[1e-5], pressure=1e3)
    assert keys(speeds) == anderson - {"Pohrt2013", "Westergaard1939"} | {"Persson2001"}


def test_what_crosses_the_gap():
    pressed, both = rc.press(WAVE, 1e9, pressure=1e5), (10.0, 10.0)
    air = rc.Gas("air", pressure=1e5, temperature=300, accommodation=(0.9, 0.9))
    periodic = METHOD | {"Westergaard1939"}
    assert keys(rc.gap_flow(pressed)) == periodic | {"Reynolds1886"}
    seal = {"drop": 1e4, "axis": 0, "seal_width": 1e-3, "circumference": 0.1}
    assert keys(rc.leak(pressed, rc.Liquid(1e-3), **seal)) == periodic | {"Reynolds1886"}
    joint = rc.joint_conductance(pressed, conductivities=both, gas=air)
    assert keys(joint) == periodic | {"Yovanovich2005"}
    parts = [rc.ConductanceParts(conductivities=both, gas=air)]
    curve = rc.loading_curve(WAVE, 1e9, pressures=[1e4, 1e5], measures=parts)
    assert keys(curve) == periodic | {"Yovanovich2005"}
    heard = JOB | {"bodies": {"materials": "steel,aluminium"}, "ultrasound": {"frequency": "1MHz"}}
    assert keys(from_plain(heard)) == METHOD | {"Love1929", "Westergaard1939", "Kendall1971"}


def test_what_was_measured(tmp_path):
    file = tmp_path / "joint.csv"
    file.write_text("pressure [MPa], stiffness [N/um/mm^2]\n15, 39\n30, 72\n65, 143\n", encoding="utf-8")
    source = {"file": str(file), "errors": "5%"}
    job = {"job": "infer", "source": source, "bodies": {"modulus": "115GPa"}}
    job |= {"joint": {"area": "2.5mm^2", "branch": "loading"}}
    table = rc.read_joint_table(file)
    data = rc.JointStiffness(table.pressures, table.values, 0.05)
    found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
    inferred = {"Sellentin2016", "Cornuet2012"}
    assert inferred <= keys(found)
    assert inferred <= keys(from_plain(job))
    assert "Hintermueller2002" not in keys(found)  # nothing was pressed
    before = rc.self_affine(rc.Grid((64, 64), 1e-6), 0.8, 1e-6, 1, short_cutoff=6e-6)
    assert "Padfield2012" in keys(rc.shift_between(before, before))


def test_theories_by_their_law_and_in_a_job_are_the_same():
    for name, law in laws():
        of_job = keys(
            from_plain(JOB | {"theories": {"theory": name, "radius": "1cm"}, "plastic": {"hardness": "1GPa"}})
        )
        of_law = keys(law)
        assert of_law <= of_job, name
        assert of_job - of_law <= METHOD | {"Love1929", "Westergaard1939", "Almqvist2007"}, name
        assert name.startswith("rough-square") or of_law > {"roughcontact"}, name
    assert keys(CURVE.compare(rc.theory.hertz.law(1e-4, 1e9))) == METHOD | {"Hertz1882"}


def test_surfaces_cite_how_they_were_made_read_and_prepared():
    made = rough()
    assert keys(BALL) == {"roughcontact"}
    assert keys(made) == {"roughcontact", "Pohrt2013"}
    assert keys(CURVE, made.filtered(short_cutoff=4e-6)) == METHOD | {"Love1929", "ISO16610"}
    grid = rc.Grid((17, 17), 1e-6)
    middles = rc.midpoint_surface(grid, 0.8, np.random.default_rng(1), rms=1e-7)
    assert keys(middles) == {"roughcontact", "Pohrt2013", "Saupe1988"}
    foreign = rc.Surface(made.heights, FREE, ["read from a.opd (OPD by SurfaceTopography, sha256 0)"])
    assert keys(foreign) == {"roughcontact", "Roettger2022"}


def test_a_job_cites_what_it_calls(tmp_path):
    job = JOB | {"preparation": {"short_cutoff": "5um"}, "errors": {"errors": True}}
    said = METHOD | {"Love1929", "Westergaard1939", "ISO16610", "Yastrebov2017"}
    assert keys(from_plain(job)) == said
    assert keys(from_plain(job), CURVE) == said - {"Westergaard1939"}
    job["source"] = {"file": "part.x3p", "periodic": True}
    (tmp_path / "job.toml").write_text(toml_of(job), encoding="utf-8")
    assert keys(tmp_path / "job.toml") == keys(str(tmp_path / "job.toml")) == said - {"Love1929"}
    conducting = JOB | {"conduction": {"resistivity": "17nohm*m"}, "contact": {"profile": "winkler"}}
    conducting["conduction"]["of"] = "total"
    assert keys(from_plain(conducting)) == METHOD | {"Popov2015", "Barber2003"}
    raised = JOB | {"plastic": {"hardness": "1GPa", "flow": "raised"}}
    assert keys(from_plain(raised)) >= {"Almqvist2007", "Pullen1972"}
    table = {"job": "theory", "source": {"sigma": "1um", "slope": "0.1"}, "pressures": {"pressures": "1MPa"}}
    table |= {"bodies": {"modulus": "1GPa"}, "theories": {"theory": "mikic"}}
    assert keys(from_plain(table)) == {"roughcontact", "Mikic1974"}
    sticks = {"work": "10mJ/m^2", "range": "20nm", "law": "dugdale"}
    sticks = JOB | {"job": "adhesion press", "load": {"depth": "1nm"}, "adhesion": sticks}
    assert keys(from_plain(sticks)) == STICKING | {"Love1929", "Westergaard1939", "Maugis1992"}
    bolt = {"bolt_force": "1kN", "head": "13mm", "hole": "9mm", "thickness": "1cm"}
    assert "Rotscher1927" in keys(from_plain(JOB | {"job": "joint", "pressure": bolt}))


def test_every_entry_is_cited_by_something():
    simple = bush_gibson_thomas.law(rc.surface_moments(rough()), 1e9, 1e-9, elliptic=False)
    cited = set().union(*(keys(law) for _, law in laws()), keys(simple), METHOD, STICKING, SLIDING)
    elsewhere = {  # in the tests above
        *("Love1929", "Westergaard1939", "Popov2015", "Brandt1990", "Almqvist2007", "Nix1998", "Maugis1992"),
        *("Johnson1971", "Pohrt2015", "Yastrebov2017", "Barber2003", "Saupe1988", "ISO16610", "Roettger2022"),
        *(
            "Lee1960",
            "Ting1966",
            "Anderson1965",
            "Reynolds1886",
            "Patir1978",
            "Yovanovich2005",
            "Kendall1971",
            "Rotscher1927",
            "Jaeger1998",
            "Delbourgo1985",
            "Iwan1966",
            "Padfield2012",
            "Sellentin2016",
            "Cornuet2012",
        ),
    }
    assert {each.key for each in references()} == cited | elsewhere


def test_text_and_bibtex():
    found = rc.citations(PRESSED)
    lines = str(found).splitlines()
    assert lines[0].endswith(f"elastic contact of rough surfaces, version {rc.__version__}")
    assert "M. Hintermüller, K. Ito and K. Kunisch, The primal-dual active set" in str(found)
    assert lines[-1].startswith("A. E. H. Love, The stress produced in a semi-infinite solid")
    assert lines[-1].endswith("Phil. Trans. R. Soc. A 228, 377 (1929), doi:10.1098/rsta.1929.0009")
    assert "{" not in str(found)
    assert "keywords" not in found.bibtex
    assert re.findall(r"^@\w+\{(\w+),$", found.bibtex, re.MULTILINE) == [
        each.key for each in found.references
    ]
    saupe = next(each for each in references() if each.key == "Saupe1988")
    assert "in H.-O. Peitgen and D. Saupe (eds.), The Science of Fractal Images, Springer (1988)" in str(
        saupe
    )


def test_strangers_have_no_references():
    with pytest.raises(InputError, match="no references for 'ndarray'"):
        rc.citations(np.ones(3))
