"""How far the errors of `rc.error_budget` can be trusted: the numbers of docs/concepts/errors.md.

The area that counting cells adds to spheres; what is claimed for single spheres, against Hertz; what is claimed against
what the same surface gives on four times as many cells; what bandwidth does to each number; and the joint of
benchmarks/joint.py with its errors.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product

import numpy as np
from joint import ALUMINIUM, CELL, CELLS, STEEL, joint

import roughcontact as rc
from roughcontact.evaluation.error_budget import ErrorBudget
from roughcontact.evaluation.perimeter import OVERHANG, corrected_area, edge_count
from roughcontact.labels.engineering_units import scale
from roughcontact.validation import Array

MODULUS = rc.reduced_modulus(STEEL, ALUMINIUM)
NAMES = {
    "interfacial_stiffness": "K",
    "stiffness": "k",
    "mean_gap": "mean gap",
    "elastic_energy": "energy",
    "contact_area": "A",
    "corrected_contact_area": "A corrected",
    "depth": "depth",
}
OF_SPHERE = ("stiffness", "interfacial_stiffness", "contact_area", "corrected_contact_area")
UNIT = 1e12  # N/um/mm^2 in Pa/m
COARSE, FINE, SEEDS = 128, 512, 8
CUTOFF = 8  # coarse cells of the shortest wave, where there is one


def value(solution: rc.Solution, name: str) -> float:
    """Return a number of a contact by its name."""
    return corrected_area(solution) if name == "corrected_contact_area" else float(getattr(solution, name))


def spheres() -> None:
    """Print by how much the counted area of spheres is too large, for each edge of the perimeter."""
    print(
        "| grid | radius [cells] | A too large by [cells an edge] | A [%] | A corrected [%] |\n|---|---|---|---|---|"
    )
    for periodic in (False, True):
        for radius in (4, 8, 16):
            rng, side, found = np.random.default_rng(0), 8 * radius, []
            for _ in range(100):
                a, middle = radius * rng.uniform(0.8, 1.2), side / 2 + rng.uniform(-0.5, 0.5, 2)
                grid = rc.Grid((side, side), 1.0, periodic=periodic)
                y, x = (c - m for c, m in zip(grid.coordinates, middle, strict=True))
                surface = rc.Surface(-(y[:, None] ** 2 + x**2) / 2000, grid)
                solution = rc.press(surface, 1.0, force=4 / 3 * a**3 / 1000)
                areas = (solution.contact_area, corrected_area(solution))
                found.append(
                    (*(area - math.pi * a**2 for area in areas), edge_count(solution), math.pi * a**2)
                )
            counted, corrected, edges, true = np.transpose(found)
            each = counted / edges.mean()
            error = each.std(ddof=1) / math.sqrt(each.size)
            share = [100 * part.sum() / true.sum() for part in (counted, corrected)]
            kind = "periodic" if periodic else "free"
            print(
                f"| {kind} | {radius} | {each.mean():.3f} ± {error:.3f} | {share[0]:+.1f} | {share[1]:+.1f} |"
            )
    print(f"\nthe constant of the correction: {OVERHANG:.3f}\n", flush=True)


def single(n: int, count: int, place: float | None = None) -> tuple[Array, Array]:
    """Return how far single spheres on n x n cells are from Hertz, and the claimed errors: relative to the numbers.

    Parameters
    ----------
    n : int
        Cells along each side.
    count : int
        Spheres. The radius of contact is 0.1 to 0.35 of a side.
    place : float, optional
        Place of their centre from the middle of the map along both axes, in cells. By default it lies anywhere between
        the cells.

    Returns
    -------
    tuple of array
        Shape (count, len(OF_SPHERE)): the distance from the true number, and the claimed error.
    """
    rng, missed, claimed = np.random.default_rng(n), [], []
    for _ in range(count):
        grid, curvature = rc.Grid((n, n), 1.0), 1e-3 / n
        a, middle = n * rng.uniform(0.1, 0.35), n / 2 + rng.uniform(-0.5, 0.5, 2)
        if place is not None:
            middle = np.full(2, n / 2 + place)
        y, x = (c - m for c, m in zip(grid.coordinates, middle, strict=True))
        surface = rc.Surface(-(y[:, None] ** 2 + x**2) * curvature / 2, grid)
        budget = rc.error_budget(rc.press(surface, 1.0, force=4 / 3 * a**3 * curvature))
        # The stiffness of the free body alone, 1/(1/k - 1/K), is that of the grid at hand for both.
        k, whole = (budget[name].value for name in ("stiffness", "interfacial_stiffness"))
        true = {"stiffness": 2 * a, "interfacial_stiffness": 1 / (1 / (2 * a) - 1 / k + 1 / whole)}
        area = math.pi * a**2
        true |= {"contact_area": area, "corrected_contact_area": area}
        missed.append([true[name] / budget[name].value - 1 for name in OF_SPHERE])
        claimed.append([budget[name].relative_error for name in OF_SPHERE])
    return np.array(missed), np.array(claimed)


def single_spheres() -> None:
    """Print the true and the claimed errors of single spheres, and in how many the true one is within."""
    print(
        f"| axis | cells | {' | '.join(NAMES[name] for name in OF_SPHERE)} |\n|{'---|' * (2 + len(OF_SPHERE))}"
    )
    places = {"anywhere": None, "corner of a cell": 0.0, "centre of a cell": 0.5}
    for (words, place), n in product(places.items(), (32, 64, 128)):
        missed, claimed = single(n, 100, place)
        shares = 100 * np.mean(np.abs(missed) <= claimed, axis=0)
        rms = [100 * np.sqrt(np.mean(each**2, axis=0)) for each in (missed, claimed)]
        cells = [
            f"{real:.1f} of {told:.1f}, {share:.0f} %" for real, told, share in zip(*rms, shares, strict=True)
        ]
        print(f"| {words} | {n} | {' | '.join(cells)} |", flush=True)
    print()


def pairs(
    hurst: float, cutoff: float | None, periodic: bool, area: float
) -> Iterator[tuple[rc.Solution, rc.Solution]]:
    """Yield the same surfaces on coarse and on fine cells, at a pressure that brings about so much into contact."""
    side, pressure = 1e-3, 0.0
    for seed in range(SEEDS):
        found = []
        for n in (COARSE, FINE):
            grid = rc.Grid((n, n), side / n, periodic=periodic)
            rng = np.random.default_rng(seed)
            surface = rc.self_affine(
                grid,
                hurst,
                1e-6,
                rng,
                rolloff=side / 4,
                short_cutoff=cutoff,
                rms_band=(side, 2.5 * side / COARSE),
            )
            if n == COARSE:  # A/A0 = 2 p/(E* h') of the coarse map
                slopes = np.gradient(surface.heights, *grid.spacing)
                pressure = area / 2 * MODULUS * math.sqrt(sum(np.mean(each**2) for each in slopes))
            found.append(rc.press(surface if periodic else surface.levelled(), MODULUS, pressure=pressure))
        yield found[0], found[1]


def of_biases(budget: ErrorBudget, name: str) -> float:
    """Return the relative error of a number from its biases; what other maps give is in benchmarks/other_maps.py."""
    number = budget[name]
    pairs = zip(number.parts, budget.sources, strict=True)
    return math.hypot(*(part for part, source in pairs if source.kind == "bias")) / abs(number.value)


def claims() -> None:
    """Print how far numbers are from those on four times as many cells, and which errors were claimed."""
    print(f"| surface | load | {' | '.join(NAMES.values())} |\n|{'---|' * (2 + len(NAMES))}")
    within, count = dict.fromkeys(NAMES, 0), 0
    for cutoff in (CUTOFF * 1e-3 / COARSE, None):
        for periodic in (True, False):
            for hurst in (0.8, 0.3):
                for area in (0.02, 0.1):
                    missed, claimed = [], []
                    for coarse, fine in pairs(hurst, cutoff, periodic, area):
                        budget = rc.error_budget(coarse)
                        missed.append([value(fine, name) / budget[name].value - 1 for name in NAMES])
                        claimed.append([of_biases(budget, name) for name in NAMES])
                    inside = np.abs(missed) <= claimed
                    if cutoff is not None:
                        count += SEEDS
                        for name, hits in zip(NAMES, inside.sum(axis=0), strict=True):
                            within[name] += int(hits)
                    rms = [100 * np.sqrt(np.mean(np.square(each), axis=0)) for each in (missed, claimed)]
                    cells = [
                        f"{real:.1f}, none given" if math.isnan(told) else f"{real:.1f} of {told:.1f}"
                        for real, told in zip(*rms, strict=True)
                    ]
                    below = "rough below" if cutoff is None else "smooth below"
                    kind = f"H = {hurst:g}, {'periodic' if periodic else 'free'}, {below}"
                    print(f"| {kind} | {area:g} | {' | '.join(cells)} |", flush=True)
    shares = [f"{name} {100 * within[key] / count:.0f} %" for key, name in NAMES.items()]
    print(f"\nwithin the claimed error, of {count} smooth ones: {', '.join(shares)}\n")


def bandwidth() -> None:
    """Print the numbers of one surface as its shortest wave is halved again and again, the long ones kept."""
    grid = rc.Grid((CELLS, CELLS), CELL, periodic=True)
    print("| shortest wave [µm] | rms slope | A/A0 [%] | mean gap [µm] | K/A0 [N/µm/mm²] | depth [µm] |")
    print("|---|---|---|---|---|---|")
    for shortest in (64e-6, 32e-6, 16e-6, 8e-6, 4.01e-6):
        waves = {"rolloff": 128e-6, "short_cutoff": shortest, "rms_band": (CELLS * CELL, 64e-6)}
        surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(0), **waves)
        slope = rc.surface_moments(surface).rms_slope
        solution = rc.press(surface, MODULUS, pressure=10e6)
        print(
            f"| {shortest * 1e6:.0f} | {slope:.3f} | {100 * solution.contact_fraction:.2f} | "
            f"{solution.mean_gap * 1e6:.2f} | {solution.stiffness / grid.area / UNIT:.1f} | "
            f"{solution.depth * 1e6:.2f} |",
            flush=True,
        )
    print()


def told(pressed: rc.Solution | list[rc.Solution]) -> None:
    """Print the errors of a joint as a table."""
    budget = rc.error_budget(pressed)
    names = ["interfacial_stiffness_per_area", "contact_fraction", "corrected_contact_fraction", "mean_gap"]

    def in_unit(name: str, value: float) -> tuple[float, str]:
        if "fraction" in name:
            return 100.0, "%"
        suits = scale(value, budget[name].unit)
        return suits.factor, suits.unit

    header, rows = budget.table(names, in_unit)
    print(f"| {' | '.join(header)} |\n|{'---|' * len(header)}")
    for row in rows:
        print(f"| {' | '.join(row)} |")
    print(flush=True)


def worked() -> None:
    """Print the joint with its errors at 10 MPa: as a periodic map, and as nine free patches of half its side."""
    surface = joint()
    told(rc.press(surface, MODULUS, pressure=10e6))
    side, rng = CELLS // 2, np.random.default_rng(CELLS // 2)
    patches = []
    for _ in range(9):
        heights = np.roll(surface.heights, rng.integers(0, CELLS, 2), (0, 1))[:side, :side]
        patch = rc.Surface(heights, rc.Grid((side, side), CELL)).levelled("plane")
        patches.append(rc.press(patch, MODULUS, pressure=10e6))
    told(patches)


if __name__ == "__main__":
    spheres()
    single_spheres()
    claims()
    bandwidth()
    worked()
