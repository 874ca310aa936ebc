"""A package that the command lacks is named, with what installs it, before any work."""

import re
import subprocess
import sys

import pytest

import roughcontact as rc
from roughcontact.cli.exits import BAD_INPUT

PIP = re.escape(sys.executable) + r" -m pip install "


@pytest.mark.parametrize("package", ["typer", "numpy", "psutil"])
def test_the_command_names_a_package_that_is_missing(rough, package):
    script = f"import sys; sys.modules[{package!r}] = None; from roughcontact.cli.main import run; run()"
    words = ["press", str(rough), "--force", "1mN", "--modulus", "1GPa"]
    answer = subprocess.run(
        [sys.executable, "-c", script, *words], capture_output=True, encoding="utf-8", check=False
    )
    assert (answer.returncode, answer.stdout) == (BAD_INPUT, "")
    pattern = rf'Error: the package {package} is not installed: run: {PIP}"{package}>=[\d.]+"\n'
    assert re.fullmatch(pattern, answer.stderr)


@pytest.mark.parametrize("verb", ["press", "curve", "conductance"])
def test_the_command_refuses_netcdf_without_h5py_before_any_work(invoke, rough, tmp_path, monkeypatch, verb):
    (tmp_path / "curve.nc").touch()
    words = {
        "press": (rough, "--force", "1mN", "--modulus", "1GPa", "--out", tmp_path / "out"),
        "curve": (rough, "--forces", "1mN,2mN", "--modulus", "1GPa", "--out", tmp_path / "out"),
        "conductance": (tmp_path / "curve.nc", "--resistivity", "17nohm*m"),
    }[verb]
    monkeypatch.setattr(rc, "press", None)  # whose call would be a mistake of ours
    monkeypatch.setitem(sys.modules, "h5py", None)
    answer = invoke(verb, *words)
    assert answer.exit_code == BAD_INPUT
    words = rf'the package h5py, which cannot be imported \(.*\)[:;] run: {PIP}"h5py>=3.11"\n'
    assert re.fullmatch(f"Error: .*{words}", answer.stderr)
    assert not (tmp_path / "out").exists()
