"""A package that is missing or broken is named, with the command that mends it."""

import io
import re
import sys
from importlib.metadata import PackageNotFoundError

import numpy as np
import pytest
import scipy.io

import roughcontact as rc
from roughcontact.files.installed import Requirement, broken_package, lacking, requirements

PIP = re.escape(sys.executable) + r" -m pip install "


def caught(source, **space):
    """Return the error that code of a module raises."""
    try:
        exec(source, {"__name__": "roughcontact.planted"} | space)
    except Exception as error:
        return error
    raise AssertionError(source)


@pytest.mark.parametrize(
    ("module", "requirement"),
    [
        ("h5py", "h5py>=3.11"),
        ("array_api_compat", "array-api-compat>=1.9"),  # as its module is called
        ("SurfaceTopography", r"(?i:SurfaceTopography)(>=1.27,<2|<2,>=1.27)"),  # of an extra
        ("PIL", "roughcontact"),  # what another package requires: pip looks for all that is lacking
    ],
)
def test_the_command_installs_what_the_module_belongs_to(monkeypatch, module, requirement):
    monkeypatch.setitem(sys.modules, module, None)
    words = f"the package {module} is not installed: run: {PIP}"
    assert re.fullmatch(f'{words}"{requirement}"', str(broken_package(caught(f"import {module}"))))
    problem, remedy = lacking("json", module)
    assert problem.startswith(f"the package {module}, which cannot be imported (")
    assert re.fullmatch(f'run: {PIP}"{requirement}"', remedy)
    assert lacking("json") is None


def test_without_what_it_requires_the_command_installs_the_whole(monkeypatch):
    """As where the package is run from its source."""

    def requires(name):
        raise PackageNotFoundError(name)

    monkeypatch.setattr("importlib.metadata.requires", requires)
    monkeypatch.setitem(sys.modules, "h5py", None)
    assert str(broken_package(caught("import h5py"))).endswith('install "roughcontact"')


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (ImportError("libopenblas.so: no such file\nread this page", name="scipy.linalg._fblas"), "scipy"),
        (ImportError("Error importing numpy"), "numpy"),  # numpy's own has no name
    ],
)
def test_a_package_that_does_not_load_is_installed_anew(error, words):
    told = str(broken_package(caught("raise error", __name__="numpy", error=error)))
    assert told.startswith(f"the package {words} cannot be loaded ({str(error).partition(chr(10))[0]})")
    assert f'pip install --force-reinstall "{words}>=' in told


def test_what_is_not_about_a_package_of_others():
    assert broken_package(caught("from numpy import no_such_name")) is None  # a mistake of ours
    assert broken_package(caught("import roughcontact.no_such_module")) is None
    assert broken_package(caught("import json.no_such_module")) is None  # of Python itself
    assert broken_package(caught("int('x')")) is None
    assert broken_package(ImportError("raised by nobody")) is None
    told = str(broken_package(caught("import numpy.no_such_module")))
    assert told.startswith(
        "the package numpy cannot be loaded (No module named 'numpy.no_such_module'): run: "
    )


def test_netcdf_without_h5py_is_one_sentence(tmp_path, monkeypatch):
    heights = np.random.default_rng(1).normal(0.0, 1e-7, (24, 24))
    surface = rc.Surface(heights, rc.Grid((24, 24), 1e-6))
    rc.write(surface, tmp_path / "rough.nc")
    monkeypatch.setitem(sys.modules, "h5py", None)
    words = rf'the package h5py, which cannot be imported \(.*\)[:;] run: {PIP}"h5py>=3.11"$'
    with pytest.raises(rc.ReadError, match=words):
        rc.read(tmp_path / "rough.nc")
    with pytest.raises(rc.WriteError, match=words):
        rc.write(surface, tmp_path / "again.nc")
    assert not (tmp_path / "again.nc").exists()
    rc.write(surface, tmp_path / "again.npz")
    # The classic form takes no HDF5.
    stream = io.BytesIO()
    with scipy.io.netcdf_file(stream, "w") as file:
        for name, count in (("y", 24), ("x", 24)):
            file.createDimension(name, count)
            axis = file.createVariable(name, "d", (name,))
            axis[:], axis.units = np.arange(count) * 1e-6, "m"
        variable = file.createVariable("heights", "d", ("y", "x"))
        variable[:], variable.units = heights, "m"
        file.flush()
        (tmp_path / "classic.nc").write_bytes(stream.getvalue())
    assert rc.read(tmp_path / "classic.nc").grid.shape == (24, 24)


def test_the_metadata_of_the_installation_are_read_whole(monkeypatch):
    lines = [
        "numpy>=2.0",
        "h5py>=3.11; python_version < '3.15'",
        "gone>=1; python_version < '3.1'",
        "surfacetopography<2,>=1.27; extra == 'formats'",
        "no-such-package>=7; python_version < '3.99' and extra == 'page'",
    ]
    monkeypatch.setattr("importlib.metadata.requires", lambda name: lines)
    found = {each.name: each for each in requirements()}
    late = {"h5py"} if sys.version_info < (3, 15) else set()
    assert found.keys() - late == {"numpy", "surfacetopography", "no-such-package"}
    assert (found["numpy"].version, found["numpy"].problem) == (np.__version__, None)
    assert (found["surfacetopography"].least, found["surfacetopography"].extra) == ("1.27", "formats")
    assert (found["no-such-package"].version, found["no-such-package"].extra) == (None, "page")


def test_a_package_that_is_missing_or_old_is_a_problem():
    assert Requirement("numpy", "2.0", "", "2.0").problem is None
    assert Requirement("numpy", "2.9", "", "2.10.0rc1").problem is None
    old = Requirement("numpy", "2.0", "", "1.26.4").problem
    assert re.fullmatch(rf'the package numpy 1\.26\.4 is older than 2\.0; run: {PIP}"numpy>=2\.0"', old)
    gone = Requirement("pint", "0.24.4", "", None).problem
    assert re.fullmatch(rf'the package pint is not installed; run: {PIP}"pint>=0\.24\.4"', gone)
