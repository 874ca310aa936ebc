"""Contact that sticks, here and in Adhesion and Tamaas, from heights to a state, on a periodic rough surface.

    python benchmarks/adhesion_peers.py [--size 256] [--irwin 2] [--seed 0] [--limit 600]

Each program runs in a process of its own and starts from nothing. Adhesion is given an offset, and minimises over the
gap by SciPy's L-BFGS-B; the mean gap of its answer is given to Tamaas (Polonsky, Keer and Rey's algorithm on the gap)
and, as a depth, to `roughcontact.press`. Seconds are those of the solver, imports left out. What each one ends with is
measured alike: the largest violation of the conditions of equilibrium by an exact product, relative to the largest
traction, cells in contact, and how far its gaps are from ours, relative to the range. A program that takes longer than
the limit is ended.

Tamaas is under the AGPL: never a dependency, only measured. See README.md for how the programs are installed.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import numpy.typing as npt

Field = npt.NDArray[np.float64]
CLOSED = 1e-9  # of the range: gaps that rounding leaves in contact
PROGRAMS = ("adhesion", "tamaas", "roughcontact")


def problem(size: int, irwin: float, seed: int) -> tuple[Field, float, float, float]:
    """Return heights on cells of size 1, work and range of the adhesion on E* = 1, and a depth."""
    sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
    from sticking import rough, sticky

    heights = np.array(rough(size, periodic=True, slope=0.08, seed=seed).heights)
    adhesion = sticky(irwin)
    return heights, float(adhesion.work), adhesion.range, 0.3 * float(heights.max() - heights.mean())


def by_adhesion(
    heights: Field, work: float, reach: float, depth: float, _: float
) -> tuple[Field, float, str]:
    """Minimise over the gap at the offset whose rigid penetration is the depth."""
    import scipy.optimize
    from Adhesion.Interactions import Exponential
    from Adhesion.System import BoundedSmoothContactSystem, make_system
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from SurfaceTopography import Topography

    sizes = tuple(float(n) for n in heights.shape)
    system = make_system(
        interaction=Exponential(work, reach),
        surface=Topography(heights, sizes, periodic=True),
        substrate=PeriodicFFTElasticHalfSpace(heights.shape, 1.0, sizes),
        system_class=BoundedSmoothContactSystem,
    )
    offset = depth - float(heights.max())
    start = time.perf_counter()
    answer = scipy.optimize.minimize(
        system.primal_objective(offset, gradient=True),
        np.maximum(-heights - offset, 0.0).ravel(),
        jac=True,
        method="L-BFGS-B",
        bounds=scipy.optimize.Bounds(0.0, np.inf),
        options={"gtol": 1e-8 * work / reach, "ftol": 0.0, "maxcor": 20, "maxiter": 20_000, "maxfun": 40_000},
    )
    seconds = time.perf_counter() - start
    return answer.x.reshape(heights.shape), seconds, f"{answer.nfev} evaluations; {answer.message}"


def by_tamaas(heights: Field, work: float, reach: float, _: float, mean: float) -> tuple[Field, float, str]:
    """Solve for a mean gap."""
    import tamaas

    tamaas.set_log_level(tamaas.LogLevel.error)
    tamaas.initialize(1)
    model = tamaas.ModelFactory.createModel(
        tamaas.model_type.basic_2d, [float(n) for n in heights.shape], list(heights.shape)
    )
    model.E, model.nu = 1.0, 0.0
    kind = tamaas.PolonskyKeerRey.gap
    solver = tamaas.PolonskyKeerRey(model, heights.copy(), 1e-12, kind, kind)
    law = tamaas.ExponentialAdhesionFunctional(heights)
    law.parameters = {"rho": reach, "surface_energy": work}
    solver.addFunctionalTerm(law)
    solver.max_iter = 100_000
    start = time.perf_counter()
    error = solver.solve(mean)
    seconds = time.perf_counter() - start
    return np.array(model["gap"]).reshape(heights.shape), seconds, f"its error {error:.1e}"


def by_us(heights: Field, work: float, reach: float, _: float, mean: float) -> tuple[Field, float, str]:
    """Press to the depth of a mean gap."""
    import roughcontact as rc

    sticky, few = rc.Adhesion(work, reach), rc.Grid((8, 8), 1.0, True)
    rc.adhesive_state(rc.Surface(np.zeros((8, 8)), few), 1.0, sticky, depth=-reach)  # imports what is used
    surface = rc.Surface(heights, rc.Grid(heights.shape, 1.0, True))
    start = time.perf_counter()
    state = rc.adhesive_state(surface, 1.0, sticky, depth=float(heights.max() - heights.mean()) - mean)
    seconds = time.perf_counter() - start
    return state.gap, seconds, f"{state.products} products; {state.status.value}"


def violation(heights: Field, gap: Field, work: float, reach: float) -> float:
    """Return the largest violation of equilibrium relative to the largest traction."""
    from roughcontact import Grid
    from roughcontact.adhesion.elastic_form import elastic_form
    from roughcontact.adhesion.exponential_law import ExponentialLaw
    from roughcontact.adhesion.gap_energy import GapEnergy
    from roughcontact.halfspace.operators.build import body_on

    form = elastic_form(body_on(Grid(heights.shape, 1.0, True), 1.0, None))
    gap = np.where(gap <= CLOSED * reach, 0.0, gap)
    displacement = gap + heights
    displacement -= displacement.mean()
    energy = GapEnergy(form, ExponentialLaw(work, reach), displacement - gap)
    point = energy.at(displacement)
    return energy.residual(point) / energy.scale(point)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--irwin", type=float, default=2.0, help="Irwin's length in cells")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--limit", type=float, default=600.0, help="seconds after which a program is ended")
    parser.add_argument("--program", choices=PROGRAMS, help=argparse.SUPPRESS)
    parser.add_argument("--mean", type=float, default=0.0, help=argparse.SUPPRESS)
    parser.add_argument("--out", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    given = problem(options.size, options.irwin, options.seed)
    if options.program:
        solve = {"adhesion": by_adhesion, "tamaas": by_tamaas, "roughcontact": by_us}[options.program]
        gap, seconds, said = solve(*given, options.mean)
        np.save(options.out / f"{options.program}.npy", gap)
        (options.out / f"{options.program}.json").write_text(json.dumps([seconds, said]))
        return 0
    with tempfile.TemporaryDirectory() as folder:
        return _compare(options, given, Path(folder))


def _compare(options: argparse.Namespace, given: tuple[Field, float, float, float], folder: Path) -> int:
    heights, work, reach, _ = given
    gaps: dict[str, Field] = {}
    lines: dict[str, tuple[float, str]] = {}
    mean = 0.0
    for program in PROGRAMS:
        call = [sys.executable, __file__, "--size", str(options.size), "--irwin", str(options.irwin)]
        call += [
            "--seed",
            str(options.seed),
            "--program",
            program,
            "--mean",
            repr(mean),
            "--out",
            str(folder),
        ]
        try:
            subprocess.run(call, check=True, timeout=options.limit)
        except subprocess.TimeoutExpired:
            print(f"  {program:13} not within {options.limit:g} s")
            if program != "tamaas":  # the others begin with Adhesion's mean gap, and are compared with ours
                return 1
            continue
        gaps[program] = np.load(folder / f"{program}.npy")
        lines[program] = tuple(json.loads((folder / f"{program}.json").read_text()))
        if program == "adhesion":
            mean = float(gaps[program].mean())
    ours = gaps["roughcontact"]
    print(f"{options.size}^2 cells, Irwin's length {options.irwin:g} cells, seed {options.seed}")
    for program, (seconds, said) in lines.items():
        gap = gaps[program]
        print(
            f"  {program:13} {seconds:8.2f} s  residual {violation(heights, gap, work, reach):.1e}  "
            f"contact {np.count_nonzero(gap <= CLOSED * reach)} cells  gaps from ours "
            f"{np.abs(gap - ours).max() / reach:.1e}  ({said})"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
