"""Names that are imported when they are first asked for."""

import compileall
import inspect
import os
import pydoc
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import xarray
from matplotlib.axes import Axes

import roughcontact as rc
from roughcontact.late import LateMethod, late_names

SCRIPT = """
import sys
import roughcontact as rc

assert rc.__file__.startswith(sys.argv[1]), rc.__file__
for package in (rc, rc.theory, rc.mdr):
    for name in sys.argv[2].split(",") if package is rc else ("hertz",) if package is rc.theory else ("indenter",):
        getattr(package, name)
print(rc.theory.hertz.point(radius=1.0, modulus=1.0, force=1.0).depth)
"""


@pytest.mark.parametrize("package", [rc, rc.theory, rc.mdr, rc.viscoelastic, rc.plot])
def test_each_name_is_there_once(package):
    names = list(late_names(package.__spec__))
    assert len(names) == len(set(names))
    assert set(names) <= set(package.__all__) == set(dir(package))
    assert all(getattr(package, name) is getattr(package, name) for name in names)


@pytest.mark.parametrize("package", [rc, rc.plot])
def test_no_module_takes_the_name_of_a_function(package):
    """A package holds its modules by their names once they are imported."""
    files = {path.stem for path in Path(package.__file__).parent.iterdir()}
    taken = files & set(late_names(package.__spec__))
    assert all(inspect.ismodule(getattr(package, name)) for name in taken)


def test_a_misspelt_name_is_refused_with_similar_ones():
    with pytest.raises(
        AttributeError, match=r"module 'roughcontact\.theory' has no attribute 'hurtz'; did you mean hertz\?$"
    ):
        _ = rc.theory.hurtz
    with pytest.raises(AttributeError, match=r"no attribute 'lodaing_curve'; did you mean loading_curve or "):
        _ = rc.lodaing_curve


def test_a_name_like_no_other_is_refused_with_those_that_there_are():
    with pytest.raises(
        AttributeError, match=r"has no attribute 'zzz'; it has law, laws, adhesive_asperities"
    ):
        _ = rc.theory.zzz


def test_help_of_the_package_begins_with_the_ways_in():
    named = set(re.findall(r"(?<!`)`(\w+)`(?!`)", rc.__doc__))
    assert {"read", "press", "loading_curve", "theory", "handbook"} <= named <= set(rc.__all__)
    shown = pydoc.plain(pydoc.render_doc(rc)).partition("PACKAGE CONTENTS")[0]
    assert "`loading_curve`" in shown
    assert len(shown.splitlines()) < 25  # the first screen


def test_without_texts_all_is_imported_at_once(tmp_path):
    """As in bundles of programs, which hold compiled modules alone."""
    target = tmp_path / "roughcontact"
    shutil.copytree(Path(rc.__file__).parent, target, ignore=shutil.ignore_patterns("__pycache__", "cli"))
    assert compileall.compile_dir(target, quiet=1, legacy=True)
    for text in target.rglob("*.py"):
        text.unlink()
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "ROUGHCONTACT_CPU": "off"}
    script = [sys.executable, "-c", SCRIPT, str(tmp_path), ",".join(late_names(rc.__spec__))]
    found = subprocess.run(script, capture_output=True, text=True, env=environment)
    assert found.returncode == 0, found.stderr
    assert float(found.stdout) == pytest.approx((9 / 16) ** (1 / 3), rel=1e-12)


BALL = rc.shapes.paraboloid(rc.Grid((16, 16), 1e-6), radius=1e-4)
LATE = [
    (kind, name)
    for kind in (
        *(rc.Surface, rc.Solution, rc.Curve, rc.Loop, rc.InterfaceTable, rc.TangentialSolution, rc.SlipCurve),
        *(rc.AdhesiveState, rc.AdhesiveCurve, rc.DetachmentState, rc.DetachmentCurve),
    )
    for name, each in vars(kind).items()
    if isinstance(each, LateMethod)
]


@pytest.mark.parametrize(("kind", "name"), LATE, ids=lambda each: getattr(each, "__name__", each))
def test_a_late_method_is_its_function_to_whoever_looks_it_up(kind, name):
    late, found = vars(kind)[name], getattr(kind, name)
    assert found is vars(sys.modules[late.module])[late.name]
    assert inspect.isfunction(found)


def test_surfaces_and_answers_have_the_methods_that_users_call():
    by_kind = {kind.__name__: {name for each, name in LATE if each is kind} for kind, _ in LATE}
    assert {"plot", "_repr_html_", "to_dataset", "from_dataarray", "filtered"} <= by_kind["Surface"]
    tables = {"to_dataset", "to_record"}
    assert by_kind["Curve"] == {"compare", "plot", "_repr_html_", "to_csv", "to_dataframe"} | tables
    assert by_kind["Loop"] == {"plot", "_repr_html_", "to_csv"} | tables
    histograms = {"pressure_histogram", "gap_histogram"}
    assert by_kind["Solution"] == {"plot", "_repr_html_"} | tables | histograms
    assert by_kind["SlipCurve"] == {"to_csv"} | tables
    assert by_kind["TangentialSolution"] == tables
    assert by_kind["InterfaceTable"] == {"to_csv", "to_dataset"}


def test_signature_and_help_of_a_method_are_those_of_the_function():
    curve = rc.loading_curve(BALL, 1e9, forces=[1e-4, 1e-3])
    assert str(inspect.signature(curve.plot)) == (
        "(ax: 'Axes | None' = None, *, quantity: 'str' = 'stiffness', law: 'PowerLaw | None' = None, "
        "theories: 'Sequence[Law]' = ()) -> 'Axes'"
    )
    assert "Draw a quantity against load" in pydoc.plain(pydoc.render_doc(rc.Curve))
    assert "plot(" in pydoc.plain(pydoc.render_doc(rc.Surface))
    assert inspect.get_annotations(rc.Curve.plot, eval_str=True)["return"] is Axes
    assert inspect.signature(rc.Surface.plot).return_annotation == "Axes"
    for kind in (rc.Surface, rc.Solution, rc.Curve, rc.Loop, rc.SlipCurve):
        assert inspect.signature(kind.to_dataset).return_annotation == "xarray.Dataset"
    assert curve.plot.__self__ is curve
    array = xarray.DataArray(
        [0.0, 1.0, 0.5], {"x": ("x", [0.0, 1.0, 2.0], {"units": "um"})}, attrs={"units": "nm"}
    )
    assert BALL.from_dataarray(array).grid.shape == rc.Surface.from_dataarray(array).grid.shape == (3,)


def test_a_late_method_is_called_as_its_function_is():
    late = LateMethod("roughcontact.surface.preparation.orientation", "flipped")
    assert late(BALL, "x").provenance[-1] == BALL.flipped("x").provenance[-1]
