"""Every script in examples/ runs, and one number of each is what it must be."""

import io
import re
import runpy
import subprocess
import sys
import warnings
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray

import roughcontact as rc
from tables import read_table

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parent.parent / "examples"


def read(path):
    return read_table(path)


def check_demo(stdout, folder):
    """The law that is printed is the straight line through the points that are written; tables are in N and MPa."""
    law = re.search(
        r"\^(\S+), scatter \S+, through (\d+) of (\d+) resolved loads", stdout.split("fractal:")[1]
    )
    table = read(folder / "fractal_curve.csv")
    assert int(law[3]) == np.count_nonzero(table["resolved"]) > int(law[2])
    fitted = np.flatnonzero(table["resolved"])[: int(law[2])]
    slope = np.polyfit(np.log(table["force"][fitted]), np.log(table["stiffness"][fitted]), 1)[0]
    assert float(law[1]) == pytest.approx(slope, abs=5.01e-4)  # three digits are printed
    for name in ("flange", "ground", "fractal"):
        points = read(folder / f"{name}_curve.csv")
        assert points["residual"].max() <= 1e-8
        first = stdout.split(f"{name}:")[1].split("resolved\n", 1)[1].split()[:3]
        # Four digits are printed.
        expected = points["force"][0], points["nominal_pressure"][0] / 1e6
        np.testing.assert_allclose([float(word) for word in first[:2]], expected, rtol=5.1e-4)
        per_area = points["interfacial_stiffness_per_area"][0] / 1e12
        assert float(first[2]) == pytest.approx(per_area, rel=5.1e-4)
    assert re.search(r"press by 10 MPa: K/A0 = 99 N/um/mm\^2, the whole joint 594 kN/um", stdout)
    verdict = re.search(
        r"Every one of 75 answers is certified to 1e-08; (\d+) of 72 loads are resolved", stdout
    )
    assert int(verdict[1]) == stdout.count("  yes\n") > 0
    assert stdout.index("flange:") < stdout.index("ground:") < stdout.index("fractal:")
    assert "resolved: stiffer than twenty single cells" in stdout
    with xarray.open_dataset(folder / "flange_pressure.nc") as dataset:
        assert "demo.py --out" in dataset.attrs["history"]
        assert len(dataset.attrs["input_sha256"]) == 64
        assert dataset.attrs["input_surface"].endswith("\ntilt removed by a least-squares plane")
        bodies = [rc.handbook(name).solid for name in ("steel", "aluminium")]
        assert dataset.attrs["input_reduced_modulus_in_Pa"] == pytest.approx(rc.reduced_modulus(*bodies))


def check_partial_slip(stdout, _):
    """Friction takes what Jaeger's rule says, which Poisson's ratio makes an approximation: the second has none.

    Trapezia between twenty forces miss 0.4 % of the difference that the rule is, those between forty 0.1 %.
    """
    found = re.findall(r"takes (\S+) J in a cycle, by Jaeger's rule (\S+) J", stdout)
    (_, (loss, expected)) = found
    assert float(loss) == pytest.approx(float(expected), rel=0.01)


def check_contact_challenge(stdout, folder):
    """The slope of the waves that fit, from rms slope 1 of the whole; the range that Irwin's length asks for."""
    low, bend, high = (2 * np.pi / wave for wave in (1e-4, 20e-6, 1e-7))
    flat = bend**-3.6 * (bend**4 - low**4) / 4
    scale = 1 / (2 * np.pi * (flat + (high**0.4 - bend**0.4) / 0.4))  # of C2D = scale q^-3.6
    step = 2 * np.pi / 2.5e-7
    q = step * np.hypot(*np.meshgrid(np.arange(-24, 24), np.arange(-24, 24)))
    kept = (q > 0) & (q <= high)
    slope = np.sqrt(np.sum(scale * q[kept] ** -1.6) * step**2)
    # Three digits are printed, of waves of which those of nearly one length stand together (Waves.of_heights).
    assert float(re.search(r"rms slope (\S+)", stdout)[1]) == pytest.approx(slope, abs=5e-4, rel=1e-3)
    gap = np.sqrt(1.501 * 2.5e-7 / 48 * np.pi * 0.05 / 25e6) * 1e9
    assert float(re.search(r"range (\S+) nm", stdout)[1]) == pytest.approx(gap, abs=5.1e-3)
    plain, *areas = (float(word) for word in re.findall(r"contact (\S+),", stdout))
    assert len(areas) == 5
    assert areas[2] > plain, "the attraction adds contact"
    assert max(float(word) for word in re.findall(r"residual (\S+);", stdout)) <= 1e-8
    challenge = [
        sys.executable,
        str(EXAMPLES / "contact_challenge.py"),
        "--file",
        "own.npz",
        "--range",
        "1e-7",
    ]
    surface = rc.self_affine(rc.Grid((16, 16), 1e-7), 0.8, rms=1e-8, rng=np.random.default_rng(1))
    rc.write(surface, folder / "own.npz")
    answer = subprocess.run(challenge, capture_output=True, encoding="utf-8", cwd=folder, check=False)
    assert answer.returncode == 0, answer.stderr
    assert answer.stdout.startswith("16 x 16 cells, 1.6 x 1.6 um")
    assert "range 100.00 nm" in answer.stdout


# Script -> its arguments, where FOLDER is an empty folder, and the check of its number.
CHECKS = {
    "contact_challenge.py": (["--side", "2.5e-7", "--cells", "48"], check_contact_challenge),
    "demo.py": (["--out", "FOLDER"], check_demo),
    "partial_slip.py": ([], check_partial_slip),
}


def test_every_example_is_checked():
    assert {path.name for path in EXAMPLES.glob("*.py")} == set(CHECKS)


@pytest.mark.parametrize("name", CHECKS)
def test_example(name, tmp_path):
    arguments, check = CHECKS[name]
    words = [str(tmp_path) if word == "FOLDER" else word for word in arguments]
    answer = subprocess.run(
        [sys.executable, str(EXAMPLES / name), *words],
        capture_output=True,
        encoding="utf-8",
        cwd=tmp_path,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    check(answer.stdout, tmp_path)


@pytest.fixture
def demo(undrawn, tmp_path, monkeypatch):
    """Run the demo in this process and in an empty folder; `test_example` starts it as its users do."""
    monkeypatch.chdir(tmp_path)

    def run(*words):
        monkeypatch.setattr(sys, "argv", ["demo.py", *words])
        status, out, err = 0, io.StringIO(), io.StringIO()
        with warnings.catch_warnings(), redirect_stdout(out), redirect_stderr(err):
            try:
                runpy.run_path(str(EXAMPLES / "demo.py"), run_name="__main__")
            except SystemExit as end:  # whose text Python prints, with status 1
                status = 1
                err.write(f"{end.code}\n")
        return SimpleNamespace(returncode=status, stdout=out.getvalue(), stderr=err.getvalue())

    return run


def test_the_demo_takes_a_file_of_the_user(demo, tmp_path):
    np.save(tmp_path / "part.npy", np.random.default_rng(1).random((24, 48)))
    words = ("--file", "part.npy", "--out", "out")
    refused = demo(*words)
    assert refused.returncode == 1
    assert refused.stderr.startswith("Error: part.npy: it states no unit")
    assert refused.stderr.endswith('with make: ARGS="--unit nm --size 10um"\n')
    unknown = demo(*words, "--unit", "second", "--size", "1um")
    assert unknown.stderr.startswith("Error: unit 'second'")
    assert not (tmp_path / "out").exists()
    answer = demo(*words, "--unit", "nm", "--size", "1um")
    assert answer.returncode == 0, answer.stderr
    assert "surface: 24 x 48 cells" in answer.stdout
    assert answer.stdout.startswith("Pressed with the reduced modulus E* = 57.47 GPa of steel")
    assert (tmp_path / "out" / "part" / "surface_curve.png").is_file()
    # White noise is no surface: a note, and no lines of code.
    assert answer.stderr.startswith("Note: part.npy: ")
    assert answer.stderr.count("\n") == answer.stderr.count("Note: ")


def test_the_demo_takes_bodies_by_name(demo, tmp_path):
    np.save(tmp_path / "part.npy", np.random.default_rng(1).random((8, 8)))
    words = ("--file", "part.npy", "--out", "out", "--unit", "nm", "--size", "1um", "--materials")
    answer = demo(*words, "steel,copper")
    assert "of steel (AISI 1045, cold drawn) on copper (" in answer.stdout
    for names, complaint in (
        ("steel", "name both bodies"),
        ("steel,cheese", "there is no material named 'cheese'"),
    ):
        refused = demo(*words, names)
        assert refused.returncode == 1
        assert refused.stderr.splitlines()[-1].startswith(f"Error: --materials: {complaint}")


@pytest.mark.parametrize("slope", [0.0, 0.1])
def test_the_demo_says_that_a_file_is_flat(demo, tmp_path, slope):
    np.save(tmp_path / "flat.npy", slope * np.arange(24.0) + np.full((24, 24), 3.3))
    answer = demo("--file", "flat.npy", "--unit", "nm", "--size", "1um")
    assert answer.returncode == 1
    assert answer.stderr.startswith("Error: flat.npy is flat")
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_the_demo_ends_quietly_on_ctrl_c(tmp_path):
    """The signal comes while the first surface is printed, however fast the machine is."""
    script = (
        "import builtins, runpy, signal, sys\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "shown = builtins.print\n"
        "def print(*words, **options):\n"
        "    shown(*words, **options)\n"
        "    if any('flange:' in str(each) for each in words):\n"
        "        signal.raise_signal(signal.SIGINT)\n"
        "builtins.print = print\n"
        "sys.argv = ['demo.py', '--out', 'out']\n"
        f"runpy.run_path({str(EXAMPLES / 'demo.py')!r}, run_name='__main__')"
    )
    ended = subprocess.run(
        [sys.executable, "-c", script],
        cwd=tmp_path,
        capture_output=True,
        encoding="utf-8",
        timeout=60,
        check=False,
    )
    assert (ended.returncode, ended.stderr) == (130, "Interrupted: no file was left half-written.\n")
    assert not list(tmp_path.rglob("*.part"))
