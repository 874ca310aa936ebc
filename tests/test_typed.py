"""What editors and type checkers know of the public names."""

import importlib.util
import os
import re
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

import roughcontact as rc
import roughcontact_thesis
from public_names import public_names
from roughcontact.theory.laws import GivenValues, LawInputs

# What has no type: tables of pandas, views of mpl_toolkits, options of Dask's cluster, entries of a study's file, and
# what a figure of the thesis draws, each its own.
UNTYPED = {
    "roughcontact.ContactFlux.to_dataframe",
    "roughcontact.Curve.to_dataframe",
    "roughcontact.plot.surface_view",
    "roughcontact.study.Range.values",
    "roughcontact_thesis.SimpleFigure.case",
}
WRONG = (
    "roughcontact.Curv",
    "roughcontact.theory.hurtz",
    "roughcontact.theory.spheres_and_punches.hertz.pint",
    "roughcontact.mdr.x",
)


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_the_types_of_all_public_names_are_known(tmp_path):
    """As mypy reveals them in a script of a user, in which it also sees a misspelt name."""
    packages = (rc, roughcontact_thesis)
    paths = [name.path for package in packages for name in public_names(package)]
    lines = [
        "import roughcontact, roughcontact_thesis",
        *(f"reveal_type({path})" for path in [*paths, *WRONG]),
    ]
    script = tmp_path / "script.py"
    script.write_text("\n".join(lines), encoding="utf-8")
    home = Path(__file__).parents[1]
    # As `make lint` does it, whose cache has all modules of the packages then.
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--platform",
        "linux",
        "--cache-dir",
        ".mypy_cache/linux",
        str(script),
    ]
    places = [os.path.relpath(Path(package.__file__).parents[1], home) for package in packages]
    environment = os.environ | {"MYPYPATH": os.pathsep.join(places)}
    answer = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=home).stdout
    revealed = {
        paths[int(line) - 2]: what
        for line, what in re.findall(r':(\d+): note: Revealed type is "(.*)"$', answer, re.MULTILINE)
        if int(line) - 2 < len(paths)
    }
    assert revealed.keys() == set(paths)
    # A whole type that is Any; parts of NumPy's own types are.
    unknown = {path for path, what in revealed.items() if re.search(r"(^|-> |: |\| )Any( \||$|,|\))", what)}
    assert unknown == UNTYPED
    assert "quantity: str =" in revealed["roughcontact.Curve.plot"]
    assert revealed["roughcontact.Curve.plot"].endswith("-> matplotlib.axes._axes.Axes")
    assert revealed["roughcontact.Surface.filtered"].endswith("-> roughcontact.surface.surface.Surface")
    assert revealed["roughcontact.Loop.to_dataset"].endswith("-> xarray.core.dataset.Dataset")
    refused = re.findall(r":(\d+): error: .*\[attr-defined\]$", answer, re.MULTILINE)
    assert [int(line) - 2 - len(paths) for line in refused] == [*range(len(WRONG))]


def test_keywords_of_theories_are_the_fields_of_what_they_become():
    assert ["modulus", *GivenValues.__annotations__] == [field.name for field in fields(LawInputs)]
