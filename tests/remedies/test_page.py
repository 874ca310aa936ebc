"""What the page refuses is shown when its message is followed."""

import re

import numpy as np
import pytest

import roughcontact as rc
from followed import heights, row
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.page_worker import perform
from roughcontact.page.stopping import Stopping

MADE = {"kind": "self-affine", "hurst": "0.8", "rms": "0.1um", "size": "32um", "points": "32"}
JOBS = {"look": "surface", "bodies": "curve", "press": "press", "curve": "curve", "export": "press"}


@pytest.fixture
def files(tmp_path):
    """Return files as the server keeps them."""
    surface = heights(rc.Grid((48, 48), 1e-6), seed=2)
    rc.write(surface, tmp_path / "part.npz")
    rc.write(heights(rc.Grid(64, 1e-6), seed=2), tmp_path / "line.npz")
    np.save(tmp_path / "bare.npy", 1e9 * surface.heights)
    return {path.name: {"path": str(path), "name": path.name} for path in tmp_path.iterdir()}


def asked(asks, source, more=None, **parts):
    """Return what asks a worker, which knows the files, to do a job."""

    def ask(files):
        sent, recipe = [], {"job": JOBS[asks], "source": source} | parts
        given = {"number": 1, "job": asks, "recipe": recipe, "files": files, "more": more or {}}
        perform(given, SessionCache(), lambda header, data=b"": sent.append(header), Stopping())
        return sent[-1]

    return ask


def request(asks, changed=None, **parts):
    return asked(asks, MADE | (changed or {}), **parts)


def of_file(name, preparation=None, **stated):
    return asked("look", {"kind": "file", "file": name, **stated}, preparation=preparation or {})


def of_line(name, profile):
    """Look at a profile: the page then asks with the bodies, of which this is one."""
    source = {"kind": "file", "file": name}
    return asked("look", source, job="curve", bodies=PRESSED["bodies"], contact={"profile": profile})


def prepared(**steps):
    return of_file("part.npz", steps)


def bodies(hardness=None, **given):
    return request("bodies", bodies=given, plastic={} if hardness is None else {"hardness": hardness})


def press(text, control="force", source=None, **plastic):
    return request("press", source, load={control: text}, bodies={"modulus": "1GPa"}, plastic=plastic)


def curve(job="curve", **parts):
    return request("curve", job=job, **({"bodies": {"modulus": "1GPa"}, "preparation": {}} | parts))


def exported(job="press", kind="csv", **parts):
    return request("export", job=job, more={"kind": kind}, **parts)


LOOP = {"job": "adhesion loop", "turn": {"depth": "20nm", "points": "2"}}
ADHESION = {"work": "10mJ/m^2", "range": "200nm"}
PRESSED = {"bodies": {"modulus": "1GPa"}, "load": {"force": "1mN"}}

SHEET = [
    row(request("look", {"hurst": "some"}), "such as 0.8", request("look", {"hurst": "0.8"})),
    row(request("look", {"hurst": "5"}), "must lie between -1 and 3", request("look", {"hurst": "0.8"})),
    row(request("look", {"rms": "much"}), "write a length such as 5um", request("look", {"rms": "5um"})),
    row(
        request("look", {"points": "5000"}),
        "A surface on the page has at most 4096 points a side",
        request("look", {"points": "64"}),
    ),
    row(request("look", {"points": "many"}), "Write 512 or 512x256", request("look", {"points": "32x16"})),
    row(request("look", {"seed": "-1"}), "a whole number from 0 up", request("look", {"seed": "2"})),
    row(asked("look", {"kind": "self-affine"}), "Hurst is missing; give hurst", request("look")),
]

FILES = [
    row(
        of_file("bare.npy"),
        "Fill in Unit (of the heights) and Size (the width of the map).",
        of_file("bare.npy", unit="nm", size="48um"),
    ),
    row(
        of_file("bare.npy", unit="nm"),
        "Fill in Size (the width of the map).",
        of_file("bare.npy", unit="nm", size="48um"),
    ),
    row(
        of_file("bare.npy", unit="nm", size="48um x"),
        "Write '1 x 2mm' or '1mm x 2mm'",
        *(of_file("bare.npy", unit="nm", size=size) for size in ("1 x 2mm", "1mm x 2mm")),
    ),
    row(
        of_file("bare.npy", unit="nm", size="0um"),
        "must be positive",
        of_file("bare.npy", unit="nm", size="5um"),
    ),
    row(
        of_file("part.npz", channel="colour"),
        "only 'heights' (48 x 48, no unit). Fill in Channel.",
        of_file("part.npz", channel="heights"),
    ),
    row(
        of_file("line.npz"),
        "It is a profile of 64 heights. Choose line or winkler as Profile.",
        *(of_line("line.npz", profile) for profile in ("line", "winkler")),
    ),
    row(
        of_line("part.npz", "line"),
        "It is a map of 48 x 48 heights, not a profile. Choose \u2013 as Profile.",
        of_file("part.npz"),
    ),
    row(of_file("gone.npz"), "The server no longer has this file. Drop it again", of_file("part.npz")),
]

PREPARED = [
    row(prepared(crop="20:20,0:48"), "20:20 holds no cell; end above 20", prepared(crop="20:40,0:48")),
    row(prepared(crop="some"), "Write rows,columns such as 0:40,5:45", prepared(crop="0:40,5:45")),
    row(prepared(short_cutoff="1 m"), "such as 1e-5 m", prepared(short_cutoff="1e-5 m")),
    row(prepared(long_cutoff="1nm"), "give at least 4e-06 m", prepared(long_cutoff="4e-06 m")),
    row(
        prepared(short_cutoff="20um", long_cutoff="10um"),
        "must be below the long one",
        prepared(short_cutoff="10um", long_cutoff="20um"),
    ),
    row(prepared(downsample="40"), "give at most 24", prepared(downsample="24")),
    row(
        prepared(level="tilt"),
        "none, mean, plane, quadratic",
        *(prepared(level=level) for level in ("none", "mean", "plane", "quadratic")),
    ),
    row(prepared(mask=["circle=3"]), "above=3um, below=-3um", prepared(mask=["above=3um", "below=-3um"])),
    row(prepared(alias=True), "Give downsample too", prepared(alias=True, downsample="2")),
    row(prepared(window="hann", share="0.2"), "Give window tukey", prepared(window="tukey", share="0.2")),
    row(prepared(tip="1m"), "with its unit, such as 2um", prepared(tip="2um")),
]

BODIES = [
    row(bodies(), "Add one, such as modulus 110GPa", bodies(modulus="110GPa")),
    row(bodies(young="210 GPa"), "Give poisson, such as 0.3", bodies(young="210 GPa", poisson="0.3")),
    row(
        bodies(young="1GPa", poisson="0.7"),
        "Give a number such as 0.3",
        bodies(young="1GPa", poisson="0.3"),
    ),
    row(bodies(modulus="100"), "Write 100GPa or, for a value in Pa, 100Pa", bodies(modulus="100GPa")),
    row(bodies(modulus="-1GPa"), "must be positive", bodies(modulus="1GPa")),
    row(
        bodies(modulus="1GPa", hardness="butter"),
        "there are steel, stainless-steel, aluminium",
        bodies(modulus="1GPa", hardness="steel"),
    ),
    row(
        bodies(materials="rigid,rigid"),
        "Name a material, such as steel,rigid",
        bodies(materials="steel,rigid"),
    ),
]

LOADS = [
    row(press("0N"), "must be positive", press("1mN")),
    row(press("1,5N"), "write the decimal point as '.'", press("1.5N")),
    row(press("-1nm", "depth"), "Give 0 or more", press("0nm", "depth")),
    row(press("1mN", "weight"), "There are force, pressure, depth", press("1mN")),
    row(
        press("1m", "depth", {"periodic": True}),
        "give a smaller depth, or a force",
        press("100nm", "depth", {"periodic": True}),
        press("1mN", "force", {"periodic": True}),
    ),
    row(
        press("1N", hardness="1kPa"),
        "exceeds 1.024 µN",
        press("1.02uN", hardness="1kPa"),
        press("1N", hardness="10GPa"),
    ),
    row(
        press("1mN", after="2mN"),
        "give hardness, or both bodies as materials",
        press("1mN", after="2mN", hardness="2GPa"),
    ),
    row(
        curve(loads={"forces": "2mN:1mN:2"}),
        "Write one such as 1mN:1N:100",
        curve(loads={"forces": "1mN:2mN:2"}),
    ),
    row(
        curve(loads={"forces": "1mN:2mN:1"}),
        "Give another count",
        curve(loads={"forces": "1mN:2mN:2"}),
    ),
    row(
        curve(plastic={"loop": True}, loads={"forces": "1mN:2mN:2"}),
        "give hardness, or both bodies as materials",
        curve(plastic={"loop": True, "hardness": "2GPa"}, loads={"forces": "1mN:2mN:2"}),
    ),
    row(curve(**LOOP, adhesion={"range": "200nm"}), "Give work", curve(**LOOP, adhesion=ADHESION)),
    row(
        exported(kind="docx", **PRESSED),
        "as csv, nc, png, svg, zip, not as 'docx'. Choose one of them",
        *(exported(kind=kind, **PRESSED) for kind in ("csv", "nc", "png", "svg", "zip")),
    ),
    row(
        exported("surface"),
        "Press the surface, or start the curve",
        exported(**PRESSED),
        exported("curve", bodies={"modulus": "1GPa"}, loads={"forces": "1mN:2mN:2"}),
    ),
]


@pytest.mark.parametrize("refusal", [*SHEET, *FILES, *PREPARED, *BODIES, *LOADS])
def test_page(refusal, files):
    end = refusal.wrong(files)
    assert end["how"] == "refused", end
    said = end["message"].casefold()
    assert all(part in said for part in re.split(r"[:;] ", refusal.words.casefold())), said
    for mended in refusal.right:
        assert mended(files) == {"type": "end", "how": "done"}
