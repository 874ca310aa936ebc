"""The same on processes of MPI; skipped where there is no mpi4py, or no mpiexec."""

from pathlib import Path

import numpy as np
import pytest

import roughcontact as rc
from slabs.launched import LAUNCHER, launch

pytest.importorskip("mpi4py", reason="mpi4py is not installed: the extra 'mpi'")
pytestmark = pytest.mark.skipif(LAUNCHER is None, reason="there is no mpiexec")
SCRIPT = Path(__file__).parent / "pressed.py"


def run(processes, *arguments):
    return launch(processes, "-m", "mpi4py", SCRIPT, *arguments)


@pytest.fixture(scope="module")
def surface():
    grid = rc.Grid((128, 128), 1e-6, periodic=True)
    return rc.self_affine(grid, hurst=0.8, rms=1e-7, rolloff=3.2e-5, rng=np.random.default_rng(1))


@pytest.fixture(scope="module")
def heights(surface, tmp_path_factory):
    path = tmp_path_factory.mktemp("heights") / "heights.npy"
    np.save(path, surface.heights)
    return path


@pytest.fixture(scope="module")
def here(surface):
    return rc.press(surface, 1e9, pressure=1e6, tolerance=1e-12)


@pytest.mark.parametrize("processes", [2, 3, 4])
def test_the_pressure_is_that_of_one_process(processes, heights, here, tmp_path):
    """As in `test_slabs.test_press`: to some ten times the tolerance."""
    done = run(processes, heights, tmp_path / "answers.npz")
    assert done.returncode == 0, done.stderr
    answers = np.load(tmp_path / "answers.npz")
    np.testing.assert_allclose(answers["pressure"], here.pressure, rtol=0, atol=1e-10 * here.pressure.max())
    numbers = answers["numbers"]
    np.testing.assert_array_equal(numbers, np.broadcast_to(numbers[0], numbers.shape))
    depth, force, stiffness, residual = numbers[0]
    assert residual <= 1e-12
    assert (depth, force) == pytest.approx((here.depth, here.force), rel=1e-10)
    assert stiffness == pytest.approx(here.stiffness, rel=1e-9)


@pytest.mark.parametrize("fault", ["killed", "failed"])
def test_a_process_that_ends_ends_all(fault, heights, tmp_path):
    """The others wait for it in an exchange: `run` would raise if they went on waiting."""
    done = run(2, heights, tmp_path / "answers.npz", fault)
    assert done.returncode != 0
    assert not (tmp_path / "answers.npz").exists()
    if fault == "failed":
        assert "this process has failed" in done.stderr
