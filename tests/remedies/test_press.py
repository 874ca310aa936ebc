"""What is refused of bodies, loads and curves: the message is followed, and then it is pressed."""

import numpy as np
import pytest

import roughcontact as rc
from followed import LINE, MODULUS, PERIODIC, PLANE, PROFILE, ROUGH, follow, row

FORCE = 1e-4
RISING = np.geomspace(1e-5, 1e-3, 6)
STEEL, RIGID = rc.Solid(205e9, 0.29), rc.Solid(np.inf, 0.0)
FULL = PERIODIC.heights.max() - PERIODIC.heights.mean()
FLAT = rc.Surface(np.zeros((16, 16)), PLANE)
FREE_LINE = rc.line(LINE, MODULUS)
WIDE = rc.self_affine(rc.Grid((16, 24), 1e-6), hurst=0.8, rms=1e-8, rng=1)
TWO_AXES = rc.Grid((16, 16), 1e-6, periodic=(True, False))


def press(surface=ROUGH, modulus=MODULUS, **named):
    return rc.press(surface, modulus, **({"force": FORCE} | named))


def curve(surface=ROUGH, **named):
    return rc.loading_curve(surface, MODULUS, **named)


def loop(**named):
    return rc.loading_loop(ROUGH, MODULUS, **({"hardness": 1e8} | named))


def square_laws(surface, **given):
    return rc.loading_laws(surface, MODULUS, "rough-square-interior", hurst=0.8, **given)


def stretched(cells, spacing):
    """Return a grid whose lengths have more digits than a message would print."""
    return rc.Grid(cells, spacing, periodic=(True, False) if isinstance(cells, tuple) else False)


LOADS = [
    row(
        lambda: press(force=0.0), "force must be positive and finite [N], not 0.0", lambda: press(force=1e-6)
    ),
    row(lambda: press(force="10N"), "force must be one number in SI units, not '10N'", press),
    row(lambda: press(force=np.nan), "force must be a number, not nan", press),
    row(lambda: press(force=[1e-4, 2e-4]), "force must be one number in SI units, not an array", press),
    row(lambda: press(force=None), "give exactly one of force, depth and pressure: none is given", press),
    row(lambda: press(depth=1e-8), "depth and pressure, not force and depth", press, lambda: at(depth=1e-8)),
    row(lambda: at(pressure=-1.0), "pressure must be positive and finite [Pa]", lambda: at(pressure=1.0)),
    row(
        lambda: at(depth=-1e-9), "depth counts from first touch: at least 0 and finite", lambda: at(depth=0.0)
    ),
    row(
        lambda: at(PERIODIC, depth=2 * FULL),
        "in full contact and its stiffness infinite; give a smaller depth, or a force",
        lambda: at(PERIODIC, depth=0.9 * FULL),
        lambda: press(PERIODIC),
    ),
    row(
        lambda: press(tolerance=1.0),
        "tolerance must lie between 1e-14 and 1e-2",
        lambda: press(tolerance=1e-3),
    ),
    row(
        lambda: press(ROUGH.heights),
        "surface must be a Surface, such as rc.Surface(heights, spacing), or a RadialProfile",
        lambda: press(rc.Surface(ROUGH.heights, PLANE)),
        lambda: press(rc.RadialProfile(np.zeros(4), rc.RadialGrid.uniform(4, 1e-6))),
    ),
    row(
        lambda: press(hardness=0.0),
        "the hardness must be positive [Pa], not 0.0",
        lambda: press(hardness=1e9),
    ),
    row(
        lambda: press(hardness=1e3),
        "the most that all measured cells can carry at this hardness: press by less, or give a greater",
        lambda: press(hardness=1e3, force=2e-7),
        lambda: press(hardness=1e9),
    ),
    row(
        lambda: press(hardness=np.ones((3, 3))),
        "a hardness is one number [Pa], or one for each cell of the grid (16, 16)",
        lambda: press(hardness=1e9),
        lambda: press(hardness=np.full((16, 16), 1e9)),
    ),
    row(
        lambda: press(hardness=lambda radii: -radii),
        "by the size of spots must be positive and finite [Pa] for each of the radii [m]",
        lambda: press(hardness=lambda radii: 1e9 + radii),
    ),
    row(
        lambda: press(solver=rc.ActiveSet),
        "a solver is wanted, such as ActiveSet() or PolonskyKeer()",
        lambda: press(solver=rc.ActiveSet()),
        lambda: press(solver=rc.PolonskyKeer()),
    ),
]


def at(surface=ROUGH, **named):
    return press(surface, force=None, **named)


BODIES = [
    row(lambda: press(modulus=0), "reduced modulus must be positive and finite [Pa], not 0.0", press),
    row(lambda: press(modulus="1GPa"), "reduced modulus must be one number in SI units, not '1GPa'", press),
    row(
        lambda: press(modulus=(STEEL, STEEL, STEEL)),
        "not 3: give one Solid, or a pair",
        lambda: press(modulus=STEEL),
        lambda: press(modulus=(STEEL, STEEL)),
    ),
    row(
        lambda: press(modulus=(RIGID, RIGID)),
        "two rigid bodies have no reduced modulus: give one of them a finite young_modulus",
        lambda: press(modulus=(STEEL, RIGID)),
    ),
    row(
        lambda: press(modulus=(1e9, 2e9)),
        "a Solid (young_modulus, poisson_ratio) is needed, not 1000000000.0: give for example rc.Solid(210e9, 0.3), "
        "or use names: rc.reduced_modulus('steel', 'aluminium')",
        lambda: press(modulus=(rc.Solid(1e9, 0.3), rc.Solid(210e9, 0.3))),
        lambda: press(modulus=rc.reduced_modulus("steel", "aluminium")),
    ),
    row(
        lambda: press(modulus=("steel", "cheese")),
        "there is no material named 'cheese'; there are steel",
        lambda: press(modulus=("steel", "aluminium")),
        lambda: press(modulus=rc.handbook("steel")),
    ),
    row(
        lambda: press(modulus=("steel", "alu")),
        "did you mean aluminium? Otherwise give the numbers of the material",
        lambda: press(modulus=("steel", "aluminium")),
        lambda: press(modulus=("steel", rc.Solid(70e9, 0.33))),
    ),
    row(
        lambda: press(hardness="cheese"),
        "there is no material named 'cheese'; there are steel",
        lambda: press(hardness="steel"),
        lambda: press(hardness=rc.handbook("gold")),
    ),
    row(lambda: rc.Solid(0, 0.3), "young_modulus must be positive [Pa], not 0", lambda: rc.Solid(1e9, 0.3)),
    row(
        lambda: rc.Solid(1e9, 0.7),
        "must be above -1 and at most 0.5, not 0.7",
        lambda: rc.Solid(1e9, 0.5),
    ),
    row(
        lambda: rc.handbook("oak"),
        "there are steel, stainless-steel, aluminium, titanium, copper, silver, gold, nickel, tungsten: give the",
        *(lambda name=name: rc.handbook(name) for name in ("steel", "gold", "tungsten")),
        lambda: rc.Solid(1e10, 0.3),
    ),
    row(
        lambda: press(PROFILE),
        "a line must name its own operator: operator=line(grid, modulus), or foundation(grid, modulus)",
        lambda: press(PROFILE, operator=rc.line(PROFILE.grid, MODULUS)),
        lambda: press(PROFILE, operator=rc.foundation(PROFILE.grid, MODULUS)),
    ),
    row(
        lambda: press(operator=FREE_LINE),
        "periodic=(False, False)): make the operator on that of the surface",
        lambda: press(operator=rc.half_space(ROUGH.grid, MODULUS)),
    ),
    row(
        lambda: press(PROFILE, modulus=2e9, operator=FREE_LINE),
        "modulus of 1e+09 Pa, and 2e+09 Pa is asked for: give both the same",
        lambda: press(PROFILE, operator=FREE_LINE),
    ),
    row(
        lambda: press(operator=rc.half_space),
        "an operator is wanted, such as half_space(grid, modulus)",
        lambda: press(operator=rc.half_space(PLANE, MODULUS)),
    ),
    row(
        lambda: rc.line(PLANE, MODULUS),
        "a line contact needs a grid of one axis: use Grid(n, spacing)",
        lambda: rc.line(rc.Grid(16, 1e-6), MODULUS),
    ),
    row(
        lambda: rc.line(stretched(27, 1.23456789e-6), MODULUS, reference_length=1e-9),
        "at least that of the grid, 3.333333303e-05 m",
        lambda: rc.line(stretched(27, 1.23456789e-6), MODULUS, reference_length=3.333333303e-05),
    ),
    row(
        lambda: rc.line(rc.Grid(8, 1e-6, periodic=True), MODULUS, reference_length=1.0),
        "its mean displacement is zero; leave it out",
        lambda: rc.line(rc.Grid(8, 1e-6, periodic=True), MODULUS),
    ),
    row(
        lambda: rc.singly_periodic(PLANE, MODULUS),
        "periodic along one of them: use Grid((ny, nx), spacing, periodic=(True, False))",
        lambda: rc.singly_periodic(TWO_AXES, MODULUS),
    ),
    row(
        lambda: rc.singly_periodic(stretched((15, 17), 1.23456789e-6), MODULUS, reference_length=1e-9),
        "at least the longest distance on the grid, 2.293938766e-05 m",
        lambda: rc.singly_periodic(
            stretched((15, 17), 1.23456789e-6), MODULUS, reference_length=2.293938766e-05
        ),
    ),
    row(
        lambda: rc.layer(PLANE, 1e9, thickness=1e-6, base="bonded"),
        "by its Poisson's ratio too: give Solid(young_modulus, poisson_ratio) for it",
        lambda: rc.layer(PLANE, STEEL, thickness=1e-6, base="bonded"),
    ),
    row(
        lambda: rc.layer(PLANE, STEEL, thickness=1e-6, base="glued"),
        "base must be 'rigid-frictionless', 'bonded' or a Solid",
        *(
            lambda base=base: rc.layer(PLANE, STEEL, thickness=1e-6, base=base)
            for base in ("rigid-frictionless", "bonded", STEEL)
        ),
    ),
    row(
        lambda: rc.half_space(rc.Grid((8, 8), 1e-6, periodic=True), MODULUS, method="multilevel"),
        "the method 'multilevel' is for free grids; a periodic one is summed by 'fft'",
        lambda: rc.half_space(rc.Grid((8, 8), 1e-6), MODULUS, method="multilevel"),
        lambda: rc.half_space(rc.Grid((8, 8), 1e-6, periodic=True), MODULUS, method="fft"),
    ),
    row(
        lambda: rc.half_space(PLANE, MODULUS, method="fast"),
        "method must be one of 'fft', 'moving-grid', 'multilevel', or 'dense' on a plane",
        *(
            lambda method=method: rc.half_space(PLANE, MODULUS, method=method)
            for method in ("fft", "moving-grid", "multilevel", "dense")
        ),
    ),
    row(
        lambda: rc.ring(PLANE, MODULUS),
        "rings need a RadialGrid, not Grid",
        lambda: rc.ring(rc.RadialGrid.uniform(4, 1e-6), MODULUS),
    ),
    row(
        lambda: rc.foundation(PLANE, MODULUS),
        "carries a line: give a grid of one axis, Grid(n, spacing)",
        lambda: rc.foundation(rc.Grid(16, 1e-6), MODULUS),
    ),
    row(
        lambda: rc.contact_stiffness(np.ones((6, 6), bool), PLANE, MODULUS),
        "a region of shape (6, 6) does not fit the grid of shape (16, 16)",
        lambda: rc.contact_stiffness(np.ones((16, 16), bool), PLANE, MODULUS),
    ),
    row(
        lambda: rc.contact_stiffness(2 * np.ones((16, 16)), PLANE, MODULUS),
        "truth values, such as pressure > 0, or only by ones and zeros",
        lambda: rc.contact_stiffness(press().pressure > 0, PLANE, MODULUS),
        lambda: rc.contact_stiffness(np.eye(16), PLANE, MODULUS),
    ),
    row(
        lambda: rc.memory_needed(ROUGH.heights),
        "a surface or its grid is wanted, not a ndarray",
        lambda: rc.memory_needed(ROUGH),
        lambda: rc.memory_needed(PLANE),
    ),
]

CURVES = [
    row(
        lambda: curve(forces=[]),
        "forces must hold at least one number in one row",
        lambda: curve(forces=[1e-4]),
    ),
    row(
        lambda: curve(forces=np.ones((2, 2))),
        "one number in one row, not shape (2, 2)",
        lambda: curve(forces=[1e-4]),
    ),
    row(
        lambda: curve(forces="1,2"),
        "must be a number or an array of numbers",
        lambda: curve(forces=[1e-5, 1e-4]),
    ),
    row(
        lambda: curve(forces=[1e-4, np.nan]),
        "the forces must be finite (given: nan)",
        lambda: curve(forces=[1e-4, 2e-4]),
    ),
    row(
        lambda: curve(forces=[2e-4, 1e-4]),
        "the forces must increase strictly, but 0.0001 follows 0.0002 at place 1: only under a hardness and in",
        lambda: curve(forces=[1e-4, 2e-4]),
        lambda: curve(forces=[2e-4, 1e-4], hardness=1e9),
        lambda: rc.adhesive_path(ROUGH, MODULUS, rc.Adhesion(1e-3, 7e-8), forces=[2e-4, 1e-4]),
    ),
    row(
        lambda: curve(forces=RISING, depths=[1e-9]),
        "give exactly one of forces, depths and pressures, not forces and depths",
        lambda: curve(forces=RISING),
        lambda: curve(depths=[1e-9]),
    ),
    row(
        lambda: curve(FLAT),
        "a flat surface has no scale of forces: name the forces, depths or pressures",
        lambda: curve(FLAT, forces=RISING),
        lambda: curve(FLAT, depths=[1e-9, 2e-9]),
        lambda: curve(FLAT, pressures=[1.0, 2.0]),
    ),
    row(
        lambda: curve(depths=[1e-9], hardness=1e9, flow="raised"),
        "cannot be prescribed if the surface rises as it flows: give forces or pressures",
        lambda: curve(forces=[1e-5], hardness=1e9, flow="raised"),
        lambda: curve(pressures=[1.0], hardness=1e9, flow="raised"),
    ),
    row(
        lambda: curve(forces=RISING, hardness=1e9, flow="up"),
        "flow must be 'removed' or 'raised', not 'up'",
        lambda: curve(forces=RISING, hardness=1e9, flow="removed"),
        lambda: curve(forces=RISING, hardness=1e9, flow="raised"),
    ),
    row(
        lambda: loop(hardness=None),
        "a loop needs a hardness: without one nothing flows",
        lambda: loop(forces=RISING),
    ),
    row(
        lambda: loop(forces=RISING[::-1]),
        "but 0.000398107 follows 0.001 at place 1: a loop goes down them and up again by itself",
        lambda: loop(forces=RISING),
    ),
    row(lambda: loop(forces=[]), "must hold at least one number in one row", lambda: loop(forces=RISING)),
    row(
        lambda: loop(forces=RISING, pressures=RISING),
        "give exactly one of forces and pressures, not forces and pressures",
        lambda: loop(forces=RISING),
        lambda: loop(pressures=[1e3, 1e4]),
    ),
    row(
        lambda: rc.loading_laws(ROUGH, MODULUS, ["greenwood"]),
        "there is no law named 'greenwood'; there are persson, finite-size, gw",
        *(
            lambda name=name: rc.loading_laws(ROUGH, MODULUS, [name])
            for name in ("persson", "finite-size", "gw")
        ),
    ),
    row(
        lambda: rc.loading_laws(PROFILE, MODULUS, ["gw"]),
        "these theories are for surfaces: give a surface on a grid of two axes",
        lambda: rc.loading_laws(ROUGH, MODULUS, ["gw"]),
    ),
    row(
        lambda: square_laws(PERIODIC),
        "those of a free square, and this map is periodic: use persson",
        lambda: rc.loading_laws(PERIODIC, MODULUS, "persson"),
    ),
    row(
        lambda: square_laws(WIDE),
        "those of a square, and this map is 24 µm by 16 µm: crop it to a square",
        lambda: square_laws(WIDE.cropped(slice(None), slice(16))),
    ),
    row(
        lambda: square_laws(ROUGH, rolloff=4e-6),
        "this map has a roll-off at 4 µm, with a side of 16 µm: use finite-size or persson",
        lambda: rc.loading_laws(ROUGH, MODULUS, ["finite-size", "persson"], rolloff=4e-6),
    ),
    row(
        lambda: rc.theory.rough_square.exponent(0.8, cut="middle"),
        "there is no cut 'middle'; there are interior, period, patch",
        *(
            lambda cut=cut: rc.theory.rough_square.exponent(0.8, cut=cut)
            for cut in ("interior", "period", "patch")
        ),
    ),
    row(
        lambda: rc.theory.rough_square.stiffness(0.1, 0.8, 1e-6, 1e-3, 1e11, cut="interior"),
        "(given: 0.001); compute the surface, or use pohrt_popov",
        lambda: rc.theory.pohrt_popov.stiffness(0.1, 0.8, 1e-6, 1e-3, 1e11),
    ),
    row(
        lambda: rc.loading_laws(PERIODIC, MODULUS, ["cgp"]),
        "unlike a periodic surface: use gw",
        lambda: rc.loading_laws(PERIODIC, MODULUS, ["gw"]),
    ),
]


@pytest.mark.parametrize("refusal", LOADS)
def test_loads(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", BODIES)
def test_bodies(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", CURVES)
def test_curves(refusal):
    follow(refusal)
