"""One surface under one pressure in each program, by the call that its users write: the tables of docs/coming-from.

    python benchmarks/coming_from.py            # a program that is not installed is not shown

A row is one call. "theirs" is the number of the answer that is closest to an indentation depth, "depth" what the
formula of the program's page makes of it. The judge of the other comparisons gives the residual.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from suite.certificate import Judge
from suite.programs import limit_threads, load

limit_threads(1)
import roughcontact as rc  # noqa: E402  # reads the number of threads once

Array = npt.NDArray[np.float64]

N, SPACING = 128, 1e-6
YOUNG, POISSON, PRESSURE = 210e9, 0.3, 1e9
MODULUS = YOUNG / (1 - POISSON**2)
LENGTH = N * SPACING
TIGHT = 1e-12  # of the range of heights: what ContactMechanics may leave open in its second row


class Row(NamedTuple):
    """What a call returned."""

    setting: str
    pressure: Array  # [Pa]
    theirs: float  # [m]
    depth: float  # [m]
    gap: float  # mean [m]


def surface(periodic: bool) -> rc.Surface:
    """Return the heights of all pages, as a map of a joint or as a lone square."""
    made = rc.self_affine(
        rc.Grid((N, N), SPACING, periodic=True), hurst=0.8, rms=2e-7, rng=1, long_cutoff=4e-5
    )
    return rc.Surface(made.heights, rc.Grid((N, N), SPACING, periodic=periodic))


def roughcontact(heights: Array, periodic: bool) -> list[Row]:
    """Ours, with nothing set."""
    solution = rc.press(surface(periodic), rc.Solid(YOUNG, POISSON), pressure=PRESSURE)
    return [Row("default", solution.pressure, solution.depth, solution.depth, solution.mean_gap)]


def tamaas(heights: Array, periodic: bool) -> list[Row]:
    """Tamaas at tolerance 1e-8; the depth from the operator applied to the traction."""
    import tamaas as tm

    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [LENGTH, LENGTH], [N, N])
    model.E, model.nu = YOUNG, POISSON
    solver = tm.PolonskyKeerRey(model, heights, 1e-8)
    if not periodic:
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver.setIntegralOperator("dcfft")
    solver.solve(PRESSURE)
    traction, gap = np.array(model.traction), np.array(model["gap"])
    displacement = float(np.mean(model.displacement))
    absolute = np.zeros((N, N))
    if periodic:
        model.solveNeumann()
        absolute[:] = model.displacement
    else:
        model.operators["dcfft"](model.traction, absolute)
    depth = (absolute - heights)[traction > 0].mean() + heights.max()
    return [Row("tolerance 1e-8", traction, displacement, float(depth), float(gap.mean()))]


def contactmechanics(heights: Array, periodic: bool) -> list[Row]:
    """ContactMechanics by its pipeline, then by its solver with a tighter tolerance."""
    from suite import peer_contactmechanics
    from suite.cases import Problem
    from SurfaceTopography import Topography

    fields: list[tuple[Any, ...]] = []
    topography = Topography(heights, (LENGTH, LENGTH), periodic=periodic)
    *_, offset, gap, converged = topography.contact_mechanics(
        substrate="periodic" if periodic else "nonperiodic",
        pressures=[PRESSURE / MODULUS],
        results_callback=lambda *answer: fields.append(answer),
    )
    depth = heights.max() - (heights.mean() + gap[0] if periodic else -offset[0])
    setting = f"default, {'converged' if converged[0] else 'not converged'}"
    row = Row(setting, fields[0][2] * MODULUS, float(offset[0]), float(depth), float(gap[0]))
    problem = Problem(heights, (SPACING, SPACING), periodic, PRESSURE * LENGTH**2, MODULUS)
    answer = peer_contactmechanics.normal(problem, TIGHT)
    tight = f"pentol {TIGHT:.0e} of the range"
    return [row, Row(tight, answer["pressure"], np.nan, answer.get("own_depth", np.nan), np.nan)]


def aspher(heights: Array, periodic: bool) -> list[Row]:
    """ASPHER at its default tolerance, with the exact operator."""
    import aspher

    backend = "periodic" if periodic else "fft"
    result = aspher.solve_nested(
        grid_size=N,
        gap=-heights.ravel(),
        p_nominal=PRESSURE,
        domain_size=LENGTH,
        E_star=MODULUS,
        backend=backend,
    )
    pressure = np.reshape(result.pressure, (N, N))
    gap = float(np.mean(result.gap))
    depth = result.approach + heights.max()
    return [Row(f"{backend}, default tolerance", pressure, result.approach, depth, gap)]


CALLS: dict[str, Callable[[Array, bool], list[Row]]] = {
    each.__name__: each for each in (roughcontact, tamaas, contactmechanics, aspher)
}


def main() -> int:
    """Print a table for the periodic map and one for the free square."""
    programs = {name: load(name) for name in CALLS}
    for name, found in programs.items():
        if isinstance(found, str):
            print(f"{name}: not shown ({found})")
    for periodic in (True, False):
        heights = np.array(surface(periodic).heights)
        judge = Judge((N, N), (SPACING, SPACING), periodic, MODULUS)
        print(f"\n{'periodic' if periodic else 'free'}: max h = {heights.max() * 1e9:.3f} nm\n")
        print(
            "| program | call | A/A0 | largest pressure | theirs | depth | mean gap | residual | difference |"
        )
        print("|---|---|---|---|---|---|---|---|---|")
        reference: Array | None = None
        for name, found in programs.items():
            for row in [] if isinstance(found, str) else CALLS[name](heights.copy(), periodic):
                reference = row.pressure if reference is None else reference
                print(line(name, found.version, row, heights, judge, reference))
    return 0


def line(name: str, version: str, row: Row, heights: Array, judge: Judge, reference: Array) -> str:
    """Return a row of the table: GPa and nm; the difference is that of the pressure, over the largest of ours."""
    verdict = judge.certify(heights, row.pressure, PRESSURE * LENGTH**2)
    difference = np.abs(row.pressure - reference).max() / reference.max()
    lengths = " | ".join(
        "" if np.isnan(each) else f"{each * 1e9:.3f}" for each in (row.theirs, row.depth, row.gap)
    )
    return (
        f"| {name} {version} | {row.setting} | {np.mean(row.pressure > 0):.4%} | "
        f"{row.pressure.max() / 1e9:.4f} | {lengths} | {verdict.error:.0e} | {difference:.0e} |"
    )


if __name__ == "__main__":
    sys.exit(main())
