"""What the page refuses is shown when its message is followed."""

import re

import numpy as np
import pytest

import roughcontact as rc
from followed import heights, row
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.page_worker import perform
from roughcontact.page.stopping import Stopping

MADE = {"kind": "made", "hurst": "0.8", "rms": "0.1um", "size": "32um", "points": 32}


@pytest.fixture
def files(tmp_path):
    """Return files as the server keeps them."""
    surface = heights(rc.Grid((48, 48), 1e-6), seed=2)
    rc.write(surface, tmp_path / "part.npz")
    np.save(tmp_path / "bare.npy", 1e9 * surface.heights)
    return {path.name: {"path": str(path), "name": path.name} for path in tmp_path.iterdir()}


def asked(job, source, more=None, **parts):
    """Return what asks a worker, which knows the files, to do a job."""

    def ask(files):
        sent, recipe = [], {"source": source} | parts
        given = {"number": 1, "job": job, "recipe": recipe, "files": files, "more": more or {}}
        perform(given, SessionCache(), lambda header, data=b"": sent.append(header), Stopping())
        return sent[-1]

    return ask


def request(job, changed=None, **parts):
    return asked(job, MADE | (changed or {}), **parts)


def of_file(name, preparation=None, **stated):
    return asked("look", {"kind": "file", "file": name, **stated}, preparation=preparation or {})


def prepared(**steps):
    return of_file("part.npz", steps)


def bodies(**given):
    return request("bodies", bodies=given)


def press(text, control="force", source=None, **given):
    return request(
        "press", source, load={"control": control, "text": text}, bodies={"modulus": "1GPa"} | given
    )


def curve(**loads):
    return request("curve", loads=loads)


SHEET = [
    row(request("look", {"hurst": "some"}), "write a number such as 0.8", request("look", {"hurst": "0.8"})),
    row(request("look", {"hurst": "5"}), "must lie between -1 and 3", request("look", {"hurst": "2"})),
    row(request("look", {"rms": "much"}), "write a length such as 5um", request("look", {"rms": "5um"})),
    row(
        request("look", {"points": 1}),
        "A surface has 3 to 4096 points a side",
        request("look", {"points": 3}),
    ),
    row(
        request("look", {"seed": -1}),
        "The seed must be a whole number from 0 up",
        request("look", {"seed": 0}),
    ),
    row(
        request("look", {"points": "many"}),
        "wrong at source.MadeSource.points: Input should be a valid integer",
        request("look", {"points": 8}),
    ),
]

FILES = [
    row(
        of_file("bare.npy"),
        "Give the unit of the heights and the width of the map.",
        of_file("bare.npy", unit="nm", width="48um"),
    ),
    row(
        of_file("bare.npy", unit="nm"),
        "Give the width of the map.",
        of_file("bare.npy", unit="nm", width="48um"),
    ),
    row(
        of_file("bare.npy", unit="nm", height="48um"),
        "its width is not: give both",
        of_file("bare.npy", unit="nm", height="48um", width="48um"),
    ),
    row(
        of_file("bare.npy", unit="nm", width="48"),
        "has no unit: write a length such as 5um",
        of_file("bare.npy", unit="nm", width="5um"),
    ),
    row(
        of_file("bare.npy", unit="nm", width="0um"),
        "is not positive: write a length above zero, such as 500um",
        of_file("bare.npy", unit="nm", width="500um"),
    ),
    row(
        of_file("part.npz", channel="colour"),
        "only 'heights' (48 x 48, no unit). Give the channel.",
        of_file("part.npz", channel="heights"),
    ),
    row(of_file("gone.npz"), "The server has no such file any more: drop it again", of_file("part.npz")),
]

PREPARED = [
    row(prepared(crop=[20, 20, 0, 48]), "Nothing is left of (48, 48) cells", prepared(crop=[20, 40, 0, 48])),
    row(prepared(short_cutoff="10"), "has no unit: write a length such as 5um", prepared(short_cutoff="5um")),
    row(prepared(short_cutoff="1 m"), "give a shorter one, such as 10um", prepared(short_cutoff="10um")),
    row(prepared(long_cutoff="1nm"), "give at least 4e-06 m", prepared(long_cutoff="4e-06 m")),
    row(
        prepared(short_cutoff="20um", long_cutoff="10um"),
        "The short cut-off 2e-05 m must be below the long cut-off 1e-05 m",
        prepared(short_cutoff="10um", long_cutoff="20um"),
    ),
    row(prepared(downsample=40), "give at most 24", prepared(downsample=24)),
    row(
        prepared(level="tilt"),
        "Input should be 'none', 'mean', 'plane' or 'quadratic'",
        *(prepared(level=level) for level in ("none", "mean", "plane", "quadratic")),
    ),
]

BODIES = [
    row(
        bodies(),
        "Young's modulus is missing; give that of the body, such as 210 GPa",
        bodies(young="210 GPa", poisson="0.3"),
    ),
    row(
        bodies(young="210 GPa"),
        "Poisson's ratio is missing; give that of the body, such as 0.3",
        bodies(young="210 GPa", poisson="0.3"),
    ),
    row(
        bodies(young="1GPa", poisson="0.7"),
        "above -1 and at most at 0.5",
        bodies(young="1GPa", poisson="0.5"),
    ),
    row(bodies(modulus="100"), "has no unit: write a modulus such as 100GPa", bodies(modulus="100GPa")),
    row(bodies(modulus="1N"), "write a modulus such as 100GPa", bodies(modulus="100GPa")),
    row(bodies(modulus="-1GPa"), "write a modulus above zero, such as 100GPa", bodies(modulus="100GPa")),
    row(
        bodies(modulus="1GPa", hardness="2"),
        "write a hardness such as 2GPa",
        bodies(modulus="1GPa", hardness="2GPa"),
    ),
    row(
        bodies(modulus="1GPa", hardness="butter"),
        "there are steel, stainless-steel, aluminium",
        bodies(modulus="1GPa", hardness="steel"),
    ),
    row(
        bodies(materials=["rigid", "rigid"]),
        "give one of them a finite Young's modulus",
        bodies(materials=["steel", "rigid"]),
    ),
]

LOADS = [
    row(press("0N"), "The force must be positive and finite", press("1mN")),
    row(
        press("1,5N"),
        "write the decimal point as '.'; write a force such as 10N",
        press("1.5N"),
        press("10N"),
    ),
    row(press("-1nm", "depth"), "at least 0 and finite", press("0nm", "depth")),
    row(press("1mN", "weight"), "Input should be 'force', 'pressure' or 'depth'", press("1mN")),
    row(
        press("1m", "depth", {"periodic": True}),
        "give a smaller depth, or a force",
        press("100nm", "depth", {"periodic": True}),
        press("1mN", "force", {"periodic": True}),
    ),
    row(
        press("1N", hardness="1kPa"),
        "gives 1.024e-06; press by less, or give a greater hardness",
        press("1.02uN", hardness="1kPa"),
        press("1N", hardness="10GPa"),
    ),
    row(
        curve(start="1mN"),
        "Give both ends of the loads, or neither",
        curve(start="1mN", end="2mN", count=2),
        curve(),
    ),
    row(
        curve(start="2mN", end="1mN"),
        "The loads rise from above zero",
        curve(start="1mN", end="2mN", count=2),
    ),
    row(
        curve(start="1mN", end="2mN", count=1), "has 2 to 1000 loads", curve(start="1mN", end="2mN", count=2)
    ),
    row(
        request("export", more={"kind": "docx"}),
        "Files are exported as csv, nc, png, svg, zip",
        *(
            request("export", more={"kind": kind, "of": "load"}, load={"control": "force", "text": "1mN"})
            for kind in ("csv", "nc", "png", "svg", "zip")
        ),
    ),
    row(
        request("export", more={"kind": "csv"}),
        "nothing to export yet: press the surface, or start the curve",
        request("export", more={"kind": "csv", "of": "load"}, load={"control": "force", "text": "1mN"}),
        request(
            "export", more={"kind": "csv", "of": "curve"}, loads={"start": "1mN", "end": "2mN", "count": 2}
        ),
    ),
]


@pytest.mark.parametrize("refusal", [*SHEET, *FILES, *PREPARED, *BODIES, *LOADS])
def test_page(refusal, files):
    end = refusal.wrong(files)
    assert end["how"] == "refused", end
    said = f"{end['message']} {end.get('remedy', '')}".casefold()
    assert all(part in said for part in re.split(r"[:;] ", refusal.words.casefold())), said
    for mended in refusal.right:
        assert mended(files) == {"type": "end", "how": "done"}
