"""The program on processes of MPI: one answer and one set of files; skipped where there is no mpi4py, or no mpiexec."""

import json
import time
from pathlib import Path

import numpy as np
import pytest
import xarray
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from slabs.launched import LAUNCHER, launch

pytest.importorskip("mpi4py", reason="mpi4py is not installed: the extra 'mpi'")
pytestmark = pytest.mark.skipif(LAUNCHER is None, reason="there is no mpiexec")
PROGRAM = Path(__file__).parent / "program.py"
LOAD = ("--modulus", "1GPa", "--tolerance", "1e-12", "--json")


def run(processes, *arguments, fault="none"):
    return launch(processes, PROGRAM, fault, *arguments)


def of_one_process(*arguments):
    answer = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert answer.exit_code == 0, answer.stderr
    return json.loads(answer.stdout)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    grid = rc.Grid((96, 64), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rolloff=1.6e-5, rng=np.random.default_rng(1))
    path = tmp_path_factory.mktemp("made") / "made.npz"
    rc.write(surface, path)
    return path


def alike(found, wanted):
    """Numbers to ten digits, the tolerance magnified as in `test_slabs.test_press`; those of the certificate apart."""
    assert found.keys() == wanted.keys()
    for name in found.keys() - {"residual", "stiffness_residual", "steps", "file", "provenance"}:
        if not isinstance(wanted[name], dict) and np.asarray(wanted[name]).dtype.kind in "fi":
            assert found[name] == pytest.approx(wanted[name], rel=1e-9), name
        else:
            assert found[name] == wanted[name], name


def test_press(made, tmp_path):
    load = ("press", made, "--pressure", "1MPa", *LOAD, "--level", "none")
    wanted = of_one_process(*load, "--out", tmp_path / "one")
    done = run(3, *load, "--out", tmp_path / "three")
    assert done.returncode == 0, done.stderr
    alike(json.loads(done.stdout), wanted)
    assert done.stderr.count("Note: ") == 1
    names = {"one": set(), "three": set()}
    for place, found in names.items():
        found |= {path.name for path in (tmp_path / place).iterdir()}
    assert names["three"] == names["one"] == {"press.json", "pressure.nc", "pressure.png"}
    one, three = (xarray.load_dataset(tmp_path / place / "pressure.nc") for place in names)
    np.testing.assert_allclose(three.pressure, one.pressure, rtol=0, atol=1e-10 * one.pressure.max())
    np.testing.assert_array_equal(three.spot_label, one.spot_label)
    for name in ("input_sha256", "input_surface", "input_control"):
        assert three.attrs[name] == one.attrs[name], name


def test_curve(made, tmp_path):
    loads = ("curve", made, "--pressures", "0.5MPa,1MPa,2MPa", *LOAD)
    wanted = of_one_process(*loads)
    done = run(2, *loads, "--out", tmp_path / "two")
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("its mean height is removed") == 1
    found = json.loads(done.stdout)
    names = ("force", "depth", "stiffness", "contact_area", "spots", "converged", "surface")
    alike({name: found[name] for name in names}, {name: wanted[name] for name in names})
    assert {path.name for path in (tmp_path / "two").iterdir()} == {
        *("curve.csv", "curve.json", "curve.nc", "curve.png")
    }


def test_surface_make(tmp_path):
    """Of one process and of four: heights to 1e-14 of their rms height, as in `test_slabs`."""
    recipe = ("--hurst", "0.8", "--rms", "1um", "--size", "1mm", "--points", "64x48", "--periodic", "--json")
    wanted = of_one_process("surface", "make", tmp_path / "one.npy", *recipe)
    done = run(4, "surface", "make", tmp_path / "four.npy", *recipe)
    assert done.returncode == 0, done.stderr
    alike(json.loads(done.stdout), wanted)
    one, four = (np.load(tmp_path / f"{name}.npy") for name in ("one", "four"))
    np.testing.assert_allclose(four, one, rtol=0, atol=1e-14 * one.std())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("press", "FILE", "--free", "--pressure", "1MPa", *LOAD), "press periodic surfaces only"),
        (("surface", "info", "FILE", "--json"), "run 'surface info' without a launcher"),
    ],
    ids=["free", "another command"],
)
def test_what_several_cannot_do_is_refused_once(made, arguments, words):
    done = run(2, *(made if each == "FILE" else each for each in arguments))
    assert done.returncode == 2
    assert done.stderr.count("Error: ") == 1
    error = json.loads(done.stdout)["error"]
    assert words in f"{error['message']} {error['remedy']}"


@pytest.mark.parametrize("fault", ["killed", "failed"])
def test_a_process_that_ends_ends_all_and_leaves_no_file(made, tmp_path, fault):
    """Others wait for it in an exchange; some seconds pass until it is sure that they do not come."""
    start = time.monotonic()
    done = run(2, "press", made, "--pressure", "1MPa", *LOAD, "--out", tmp_path / "out", fault=fault)
    assert done.returncode != 0
    assert time.monotonic() - start < 60  # not the wait for ever that a lost process means
    said = done.stderr + done.stdout  # launchers differ in where they speak
    assert said
    assert "{" not in done.stdout
    if fault == "failed":
        assert "the memory does not suffice" in said
        assert "process 1 of 2 only" in said
    assert not list(tmp_path.rglob("press*"))
