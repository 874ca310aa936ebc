"""The tests elsewhere: on other Pythons, with the oldest dependencies, with the kernels of other processors.

nox -s tests      on each Python
nox -s lowest     with the lower bound of each dependency in pyproject.toml
nox -s kernels    the numerical tests with each BLAS kernel and machine code for each processor
nox -t pairs      some of these, in which each kernel and each processor occurs

What follows ``--`` goes to pytest; for the kernels it stands in place of the numerical tests (``-- tests``: all tests).
What cannot run here is listed as skipped, with the reason.
"""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import nox
from packaging.requirements import Requirement

nox.options.reuse_existing_virtualenvs = True
nox.options.sessions = ["kernels"]

PYTHONS = ("3.11", "3.12", "3.13", "3.14")
BLAS = ("Haswell", "SkylakeX", "Zen", "Nehalem")
CPU = ("off", "x86-64", "haswell", "native")  # what machine code is made for
PAIRS = {("Haswell", "off"), ("SkylakeX", "haswell"), ("Zen", "native"), ("Nehalem", "x86-64")}
NUMERICAL = [
    *(f"tests/{room}" for room in ("contact", "friction", "halfspace", "kernels", "mdr", "solver")),
    *(f"tests/{room}" for room in ("statistics", "surface", "theory")),
    "reproduction/tests/thesis",
]
# A process a core, so one thread for the linear algebra of each.
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
# Uses machine code, the BLAS of NumPy and that of SciPy; tells whether there is machine code, and the kernels of BLAS.
PROBE = """
import json, sys, numpy, scipy.linalg, threadpoolctl
import roughcontact as rc
from roughcontact.kernels import loader
try:
    has_code = loader.is_available()
except ValueError as error:  # this machine lacks what that processor has
    print(json.dumps([str(error), None, None]))
    sys.exit()
for dtype in numpy.float32, numpy.float64:
    matrix = numpy.eye(200, dtype=dtype) + 0.001
    scipy.linalg.cholesky(matrix @ matrix)
grid = rc.Grid((32, 32), (1.0, 1.0), periodic=True)
surface = rc.self_affine(grid, hurst=0.8, rms=1.0, rng=numpy.random.default_rng(1))
rc.press(surface, 1.0, pressure=0.1)
blas = [library for library in threadpoolctl.threadpool_info() if library["user_api"] == "blas"]
print(json.dumps([None, has_code, sorted({library.get("architecture", "unknown") for library in blas})]))
"""


@nox.session(python=PYTHONS)
def tests(session: nox.Session) -> None:
    """Run the tests on each Python."""
    install(session)
    pytest(session, *session.posargs)


@nox.session(python=PYTHONS[0])
def lowest(session: nox.Session) -> None:
    """Run the tests with the lower bound of each dependency."""
    project = nox.project.load_toml("pyproject.toml")["project"]
    required = [project["dependencies"], *project["optional-dependencies"].values()]
    bounds = Path(session.create_tmp(), "bounds.txt")
    bounds.write_text("\n".join(lower_bound(Requirement(text)) for texts in required for text in texts))
    install(session, "--constraint", str(bounds))
    # An old release may use what newer ones of its own dependencies deprecate.
    pytest(session, "-W", "ignore::DeprecationWarning", *session.posargs)


@nox.session(python=False)
@nox.parametrize(
    ("blas", "cpu"),
    [
        nox.param(blas, cpu, id=f"{blas}-{cpu}", tags=["pairs"] if (blas, cpu) in PAIRS else [])
        for blas in BLAS
        for cpu in CPU
    ],
)
def kernels(session: nox.Session, blas: str, cpu: str) -> None:
    """Run the numerical tests with a BLAS kernel and machine code for a processor, in the environment of nox."""
    env = {"OPENBLAS_CORETYPE": blas, "ROUGHCONTACT_CPU": cpu}
    probe = subprocess.run(
        [sys.executable, "-c", PROBE], env=os.environ | ONE_THREAD | env, capture_output=True, text=True
    )
    if probe.returncode < 0:
        session.skip(f"this machine cannot run it: {signal.Signals(-probe.returncode).name}")
    if probe.returncode > 0:
        session.error(probe.stderr)
    obstacle, has_code, found = json.loads(probe.stdout)
    if obstacle:
        session.skip(obstacle)
    if found != [blas]:
        session.skip(f"BLAS chose {' and '.join(found) or 'kernels without a name'} in its place")
    if has_code != (cpu != "off"):
        session.error("machine code is on" if has_code else "there is no machine code")
    pytest(session, *(session.posargs or NUMERICAL), env=env)


def install(session: nox.Session, *options: str) -> None:
    """Install what the tests need into the environment of the session, from wheels."""
    session.install(
        "--only-binary=:all:", *options, "--editable", ".[formats,page,test]", "--editable", "./reproduction"
    )


def lower_bound(requirement: Requirement) -> str:
    """Return the requirement at its lower bound."""
    (bound,) = (part.version for part in requirement.specifier if part.operator == ">=")
    return f"{requirement.name}=={bound}"


def pytest(session: nox.Session, *arguments: str, env: dict[str, str] | None = None) -> None:
    """Run pytest with a process for each core."""
    python = sys.executable if session.python is False else "python"
    session.run(python, "-m", "pytest", "-n", "auto", *arguments, env=ONE_THREAD | (env or {}), external=True)
