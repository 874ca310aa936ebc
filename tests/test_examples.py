"""Every script in examples/ runs, and one number of each is what it must be."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).parent.parent / "examples"


def read(path):
    return np.genfromtxt(path, delimiter=",", names=True, dtype=None, encoding="utf-8")


def check_demo(stdout, folder):
    """The law that is printed is the straight line through the points that are written."""
    law = re.search(r"\^(\S+), (\d+) resolved loads", stdout.split("fractal:")[1])
    table = read(folder / "fractal_curve.csv")
    fitted = np.flatnonzero(table["resolved"])[: int(law[2])]
    slope = np.polyfit(np.log(table["force"][fitted]), np.log(table["stiffness"][fitted]), 1)[0]
    assert float(law[1]) == pytest.approx(slope, abs=5.01e-4)  # three digits are printed
    for name in ("landscape", "fractal"):
        points = read(folder / f"{name}_curve.csv")
        assert points["residual"].max() <= 1e-8
    assert "Every one of 62 answers is certified to 1e-08" in stdout


# Script -> its arguments, where FOLDER is an empty folder, and the check of its number.
CHECKS = {"demo.py": (["--out", "FOLDER"], check_demo)}


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


def test_the_demo_takes_a_file_of_the_user(tmp_path):
    np.save(tmp_path / "part.npy", np.random.default_rng(1).random((24, 32)))
    words = [sys.executable, str(EXAMPLES / "demo.py"), "--file", "part.npy", "--out", "out"]
    refused = subprocess.run(words, capture_output=True, encoding="utf-8", cwd=tmp_path, check=False)
    assert refused.returncode == 1
    assert refused.stderr.startswith("Error: part.npy: it states no unit")
    answer = subprocess.run(
        [*words, "--unit", "nm", "--size", "1um"],
        capture_output=True,
        encoding="utf-8",
        cwd=tmp_path,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    assert "surface: 24 x 32 cells" in answer.stdout
    assert (tmp_path / "out" / "surface_curve.png").is_file()
