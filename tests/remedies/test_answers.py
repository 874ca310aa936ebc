"""What is refused of adhesion, friction and answers: the message is followed, and the numbers are there."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from followed import LINE, MODULUS, PERIODIC, PLANE, PROFILE, ROUGH, follow, heights, row
from roughcontact.contact.press import solve
from roughcontact.evaluation.interface_calculix import calculix_text
from roughcontact.theory.law import LoadingLaw

STEEL = rc.Solid(205e9, 0.29)
PAIR = (STEEL, STEEL)
HALF = rc.Solid(0.75 * MODULUS, 0.5)  # whose E* is the modulus
FINE = heights(rc.Grid((64, 64), 1e-6))
FAR = rc.Adhesion(1e-3, 1e-7)
WAVE = 1e-7 * np.cos(2 * np.pi * np.arange(84) / 84)
EGGS = rc.Surface(WAVE[:, None] + WAVE, rc.Grid((84, 84), 1e-6, periodic=True))
WATER = rc.Liquid(1e-3)
FULL = PERIODIC.heights.max() - PERIODIC.heights.mean()
RISING, HIGH = np.geomspace(1e-5, 1e-3, 6), np.geomspace(1, 10, 5)


def stuck(surface=ROUGH, adhesion=FAR, **named):
    return rc.adhesive_state(surface, MODULUS, adhesion, **named)


def path(surface=ROUGH, adhesion=FAR, **named):
    return list(rc.adhesive_path(surface, MODULUS, adhesion, **named))


def flowed():
    return rc.press(ROUGH, MODULUS, force=1e-4, hardness=2e7)


def detached(solution=None, work=1e-3, **named):
    return list(rc.detachment_path(solution or rc.press(ROUGH, MODULUS, depth=2e-8), work, **named))


def pressed(force=1e-4, **named):
    return rc.press(ROUGH, PAIR, **({"force": force} | named))


def slid(solution=None, bodies=PAIR, *, friction=0.3, **named):
    return rc.slide(solution or pressed(), bodies, friction=friction, **named)


def line(**named):
    return rc.press(PROFILE, STEEL, force=1e2, operator=rc.line(LINE, STEEL), **named)


def curve(surface=FINE, **named):
    return rc.loading_curve(surface, MODULUS, **named)


def leaking(flown, fluid=WATER):
    return rc.leak_rates(flown, fluid, drop=1.0, seal_width=1e-3, circumference=0.1)


def law(closing=1.0):
    """Return the law of an interface whose closings are a part of those of a curve."""
    table = rc.interface_table(curve(FINE))
    return replace(table, gap=table.gap * closing, stiffness=table.stiffness / closing)


def springs():
    return curve(PROFILE, forces=[1.0, 2.0], operator=rc.foundation(LINE, MODULUS))


def elements(cells):
    """Shape functions of four by four elements with this number of cells along each."""
    places = (np.arange(4 * cells) + 0.5) / cells
    line = np.array([np.interp(places, np.arange(5), unit) for unit in np.eye(5)]).T
    return np.kron(line, line)


ADHESION = [
    row(
        lambda: rc.Adhesion(0.05, -1.0),
        "range of the attraction [m] must be positive",
        lambda: rc.Adhesion(0.05, 1e-9),
    ),
    row(
        lambda: rc.Adhesion(0.0, 1e-9), "leave the adhesion out", lambda: rc.press(ROUGH, MODULUS, force=1e-4)
    ),
    row(
        lambda: rc.Adhesion(0.05, 2e-9, law="lennard-jones"),
        "must be one of 'exponential', 'dugdale', not 'lennard-jones'",
        lambda: rc.Adhesion(0.05, 2e-9, law="exponential"),
        lambda: rc.Adhesion(0.05, 2e-9, law="dugdale"),
    ),
    row(
        lambda: stuck(adhesion=0.05, force=1e-6),
        "adhesion must be an Adhesion, such as rc.Adhesion(work=0.05, range=2e-9), not 0.05",
        lambda: stuck(adhesion=rc.Adhesion(0.05, 2e-9, allow_unresolved=True), force=1e-6),
    ),
    row(
        lambda: stuck(adhesion=rc.Adhesion(0.05, 2e-9), force=1e-9),
        "cells of at most 1.69e-08 m or a range of at least 1.54e-08 m, use detachment_path, which needs no range, "
        "or give the adhesion allow_unresolved=True",
        lambda: stuck(heights(rc.Grid((16, 16), 1.69e-8)), rc.Adhesion(0.05, 2e-9), force=1e-9),
        lambda: stuck(adhesion=rc.Adhesion(0.05, 1.54e-8), force=1e-9),
        lambda: detached(work=0.05, depths=[0.0]),
        lambda: stuck(adhesion=rc.Adhesion(0.05, 2e-9, allow_unresolved=True), force=1e-9),
    ),
    row(
        lambda: stuck(mean_gap=1e-9),
        "here the body is not periodic: give depths or forces",
        lambda: stuck(depth=1e-9),
        lambda: stuck(force=1e-9),
    ),
    row(
        lambda: stuck(PERIODIC, mean_gap=-1e-9),
        "is full contact or beyond it: give mean gaps above 0",
        lambda: stuck(PERIODIC, mean_gap=0.9 * FULL),
    ),
    row(
        lambda: stuck(PERIODIC, depth=2 * FULL),
        "there a periodic surface is in full contact; give a smaller depth",
        lambda: stuck(PERIODIC, depth=0.1 * FULL),
    ),
    row(
        lambda: stuck(),
        "give exactly one of depth, force, pressure and mean_gap: none is given",
        lambda: stuck(force=1e-9),
    ),
    row(
        lambda: detached(depths=[3e-8, 0.0]),
        "press to that depth, or begin with 2e-08 or less",
        lambda: detached(rc.press(ROUGH, MODULUS, depth=3e-8), depths=[3e-8, 0.0]),
        lambda: detached(depths=[2e-8, 0.0]),
    ),
    row(
        lambda: detached(depths=[1e-8, 0.0, 5e-9]),
        "leave it out, or give adhesive_path an Adhesion with a range, with which surfaces come together again",
        lambda: detached(depths=[1e-8, 0.0]),
        lambda: path(depths=[1e-8, 0.0, 5e-9]),
    ),
    row(
        lambda: detached(depths=[1e-8], forces=[1e-9]),
        "give exactly one of depths, forces and pressures, not depths and forces",
        lambda: detached(depths=[1e-8]),
        lambda: detached(forces=[1e-9]),
    ),
    row(
        lambda: detached(rc.press(ROUGH, MODULUS, depth=0.0)),
        "press to a force or a depth above zero",
        lambda: detached(rc.press(ROUGH, MODULUS, force=1e-6)),
        lambda: detached(rc.press(ROUGH, MODULUS, depth=1e-9)),
    ),
    row(
        lambda: detached(flowed()),
        "give solution.flattened, the elastic contact after flow, or press without a hardness",
        lambda: detached(flowed().flattened),
        lambda: detached(),
    ),
    row(
        lambda: detached(work=0.0),
        "the work of adhesion is zero everywhere: give a number above zero",
        lambda: detached(work=1e-6),
    ),
    row(
        lambda: detached(work=np.ones(3)),
        "give one number, or one for each cell",
        lambda: detached(work=1e-3),
        lambda: detached(work=np.full(ROUGH.grid.shape, 1e-3)),
    ),
    row(
        lambda: detached(rc.press(EGGS, MODULUS, depth=1.995e-7)),
        "are too many (at most 6000): press by less, or average cells (surface.averaged)",
        lambda: detached(rc.press(EGGS, MODULUS, depth=5e-8), depths=[5e-8]),
        lambda: detached(rc.press(EGGS.averaged(3), MODULUS, depth=1.8e-7), depths=[1.8e-7]),
    ),
    row(
        lambda: path(forces=[-1e-9, 1e-9]),
        "begin with 0 or more, and let the tension follow (adhesive_path, adhesive_loop)",
        lambda: path(forces=[0.0, -1e-9]),
        lambda: rc.adhesive_loop(ROUGH, MODULUS, FAR, depth=1e-9),
    ),
    row(
        lambda: path(depths=[np.nan]),
        "the depths must be finite (given: nan)",
        lambda: path(depths=[1e-9]),
    ),
    row(
        lambda: rc.adhesive_loop(ROUGH, MODULUS, FAR, depth=-1.0),
        "the depth must be above -1e-06 m, ten ranges of the attraction apart",
        lambda: rc.adhesive_loop(ROUGH, MODULUS, FAR, depth=-9e-7),
    ),
    row(
        lambda: stuck(PROFILE, depth=1e-9, operator=rc.foundation(LINE, MODULUS)),
        "press a half-space, a line or rings",
        lambda: stuck(ROUGH, depth=1e-9),
        lambda: stuck(PROFILE, depth=1e-9, operator=rc.line(LINE, MODULUS)),
        lambda: stuck(rc.RadialProfile(np.zeros(4), rc.RadialGrid.uniform(4, 1e-6)), depth=1e-9),
    ),
]

FRICTION = [
    row(
        lambda: slid(bodies=1e11, force=1e-6),
        "E* does not determine how bodies shear",
        lambda: slid(bodies=PAIR, force=1e-6),
        lambda: slid(rc.press(ROUGH, STEEL, force=1e-4), STEEL, force=1e-6),
    ),
    row(
        lambda: slid(bodies=(STEEL, rc.Solid(70e9, 0.33)), force=1e-6),
        "use the same bodies for both",
        lambda: slid(bodies=PAIR, force=1e-6),
    ),
    row(
        lambda: slid(force=1e-6, friction=-1.0),
        "must be positive and finite, not -1.0",
        lambda: slid(force=1e-6),
    ),
    row(
        lambda: slid(),
        "give exactly one of force and displacement",
        lambda: slid(force=1e-6),
        lambda: slid(displacement=1e-12),
    ),
    row(
        lambda: slid(force=1.0),
        "friction holds at most mu P = 3e-05 N: under 1 N the bodies slide away; pull less, or press harder",
        lambda: slid(force=2.9e-5),
        lambda: slid(pressed(10.0), force=1.0),
    ),
    row(
        lambda: slid(force=(1e-6, 1e-6, 1e-6)),
        "a tangential load is one finite number, or two (x, y)",
        lambda: slid(force=1e-6),
        lambda: slid(force=(1e-6, 1e-6)),
    ),
    row(
        lambda: slid(force=(1e-6, 1e-6), along=(1, 0)),
        "does not: omit `along`",
        lambda: slid(force=(1e-6, 1e-6)),
    ),
    row(
        lambda: slid(pressed(None, depth=0.0), force=1e-6),
        "the bodies do not touch: there is no contact to load; press them first",
        lambda: slid(pressed(), force=1e-6),
    ),
    row(
        lambda: slid(line(), STEEL, force=1e-6),
        "not for a line: press a map of heights",
        lambda: slid(force=1e-6),
    ),
    row(
        lambda: rc.slide_path(pressed(), PAIR, friction=0.3, forces=[]),
        "a path needs at least one load, in a row",
        lambda: rc.slide_path(pressed(), PAIR, friction=0.3, forces=[1e-6]),
    ),
    row(
        lambda: rc.load_cycle(1.0, steps=0),
        "whole numbers, steps >= 1 and cycles >= 0",
        lambda: rc.load_cycle(1.0, steps=1, cycles=0),
    ),
    row(
        lambda: rc.reduced_shear_modulus(MODULUS),
        "a Solid (young_modulus, poisson_ratio) is needed, not 1000000000.0: give for example rc.Solid(210e9, 0.3)",
        lambda: rc.reduced_shear_modulus(STEEL),
        lambda: rc.reduced_shear_modulus(rc.Solid(210e9, 0.3)),
    ),
]

ANSWERS = [
    row(
        lambda: curve(forces=HIGH).fit(),
        "leave the loads out, so that suitable ones are chosen, or use a finer grid, or another window of forces",
        lambda: curve(forces=rc.load_range(FINE, MODULUS).forces).fit(),
        lambda: curve(forces=HIGH).fit((1.0, 10.0)),
    ),
    row(
        lambda: curve(ROUGH).fit(),
        "resolved points in the range of forces that is fitted, not 0: leave",
        lambda: curve(FINE).fit(),
    ),
    row(
        lambda: curve(forces=RISING).fit((1.0, 0.1)),
        "a window goes from a force to a larger one",
        lambda: curve(forces=RISING).fit((1e-5, 1e-3)),
    ),
    row(
        lambda: curve(forces=RISING).compare("GW"),
        "not 'GW': give rc.loading_laws(surface, modulus, 'GW')[0], or your own LoadingLaw",
        lambda: curve(forces=RISING).compare(rc.loading_laws(FINE, MODULUS, "GW")[0]),
        lambda: curve(forces=RISING).compare(
            LoadingLaw("own", "notes", {"depth": lambda force: force / 1e5})
        ),
    ),
    row(
        lambda: curve(forces=RISING).compare(rc.loading_laws(FINE, 2 * MODULUS, "gw")[0]),
        "make it by loading_laws from the surface that was pressed, or compare with other_surface=True",
        lambda: curve(forces=RISING).compare(rc.loading_laws(FINE, MODULUS, "gw")[0]),
        lambda: curve(forces=RISING).compare(rc.loading_laws(FINE, 2 * MODULUS, "gw")[0], other_surface=True),
    ),
    row(
        lambda: curve(forces=RISING).plot(quantity="weight"),
        "quantity must be one of stiffness, contact_area, depth",
        *(
            lambda name=name: curve(forces=RISING).plot(quantity=name)
            for name in ("stiffness", "contact_area", "depth")
        ),
    ),
    row(
        lambda: rc.conductance(curve(forces=RISING)),
        "give the resistivities [ohm m] or the conductivities [W/(m K)] of both bodies",
        lambda: rc.conductance(curve(forces=RISING), resistivities=(1.7e-8, 1.7e-8)),
        lambda: rc.conductance(curve(forces=RISING), conductivities=(50.0, 50.0)),
    ),
    row(
        lambda: rc.conductance(curve(forces=RISING), resistivities=1.7e-8),
        "give the numbers of both bodies, such as (1.7e-8, 1.7e-8)",
        lambda: rc.conductance(curve(forces=RISING), resistivities=(1.7e-8, 1.7e-8)),
    ),
    row(
        lambda: rc.plot.conductance_curve(curve(forces=RISING)),
        "no parts of a conductance: compute it with measures=[rc.ConductanceParts(conductivities=(50, 160))]",
        lambda: rc.plot.conductance_curve(
            curve(forces=RISING, measures=[rc.ConductanceParts(conductivities=(50, 160))])
        ),
    ),
    row(
        lambda: rc.ConductanceParts(
            conductivities=(50, 160),
            gas=rc.Gas("air", pressure=1e5, accommodation=(1, 1)),
            emissivities=(1, 1),
            temperature=300,
        ),
        "the gas has a temperature already: leave temperature out",
        lambda: rc.ConductanceParts(
            conductivities=(50, 160),
            gas=rc.Gas("air", pressure=1e5, accommodation=(1, 1)),
            emissivities=(1, 1),
        ),
    ),
    row(
        lambda: rc.conductance(ROUGH, resistivities=(1e-8, 1e-8)),
        "conductance takes a Curve, a Solution or a Dataset, not Surface: press the surface first",
        lambda: rc.conductance(rc.press(ROUGH, MODULUS, force=1e-4), resistivities=(1e-8, 1e-8)),
    ),
    row(
        lambda: rc.conductance(line(), resistivities=(1e-8, 1e-8)),
        "depends on the size of the bodies: press a map of heights",
        lambda: rc.conductance(rc.press(ROUGH, MODULUS, force=1e-4), resistivities=(1e-8, 1e-8)),
    ),
    row(
        lambda: rc.conductance(springs(), resistivities=(1e-8, 1e-8)),
        "a Winkler foundation has only a total conductance: use of='total'",
        lambda: rc.conductance(springs(), resistivities=(1e-8, 1e-8), of="total"),
    ),
    row(
        lambda: rc.reflection(ROUGH, ("steel", "aluminium"), 5e6),
        "reflection takes a Curve, a Solution or the dataset of a curve, not Surface: press the surface first",
        lambda: rc.reflection(rc.press(ROUGH, MODULUS, force=1e-4), ("steel", "aluminium"), 5e6),
    ),
    *(
        row(
            lambda profile=profile: rc.reflection(profile(), ("steel", "aluminium"), 5e6),
            "a profile has no reflection of ultrasound: press a map of heights",
            lambda: rc.reflection(rc.press(ROUGH, MODULUS, force=1e-4), ("steel", "aluminium"), 5e6),
        )
        for profile in (line, springs)
    ),
    row(
        lambda: rc.reflection(pressed(), "steel", 5e6),
        "a reflection needs two elastic bodies: give a pair, such as ('steel', 'aluminium')",
        lambda: rc.reflection(pressed(), ("steel", "aluminium"), 5e6),
    ),
    row(
        lambda: rc.reflection(pressed(), ("steel", rc.Solid(70e9, 0.33)), 5e6),
        "give the densities of both bodies, such as (7850.0, 2700.0)",
        lambda: rc.reflection(pressed(), ("steel", rc.Solid(70e9, 0.33)), 5e6, densities=(7850.0, 2700.0)),
    ),
    row(
        lambda: rc.reflection(
            curve(forces=RISING, hardness=1e9).to_dataset().drop_vars("unloading_interfacial_stiffness"),
            *(("steel", "steel"), 5e6),
        ),
        "compute the curve again, with the stiffness of unloading",
        lambda: rc.reflection(curve(forces=RISING, hardness=1e9).to_dataset(), ("steel", "steel"), 5e6),
    ),
    row(
        lambda: rc.contact_flux(pressed()),
        "give exactly one of resistivities and conductivities: none is given",
        lambda: rc.contact_flux(pressed(), resistivities=(1e-8, 1e-8)),
        lambda: rc.contact_flux(pressed(), conductivities=(50.0, 50.0)),
    ),
    row(
        lambda: rc.contact_flux(line(), resistivities=(1e-8, 1e-8)),
        "depends on the size of the bodies: press a map of heights",
        lambda: rc.contact_flux(pressed(), resistivities=(1e-8, 1e-8)),
    ),
    row(
        lambda: rc.contact_flux(
            rc.press(PROFILE, MODULUS, force=1.0, operator=rc.foundation(LINE, MODULUS)),
            resistivities=(1e-8, 1e-8),
        ),
        "the flux through springs is not that of their stiffness: press a map of heights",
        lambda: rc.contact_flux(pressed(), resistivities=(1e-8, 1e-8)),
    ),
    row(
        lambda: rc.contact_flux(pressed(), resistivities=(1e-8, 1e-8), drop=-1.0),
        "the drop [V or K] must be positive and finite, not -1.0",
        lambda: rc.contact_flux(pressed(), resistivities=(1e-8, 1e-8), drop=1.0),
    ),
    row(
        lambda: rc.contact_flux(rc.press(PERIODIC, MODULUS, pressure=MODULUS), resistivities=(1e-8, 1e-8)),
        "the whole period is in contact: the interface has no resistance; press less hard",
        lambda: rc.contact_flux(rc.press(PERIODIC, MODULUS, depth=FULL / 2), resistivities=(1e-8, 1e-8)),
    ),
    row(
        lambda: rc.contact_flux(
            rc.press(heights(rc.Grid((16, 16), 1e-6, (True, False))), MODULUS, force=1e-5),
            resistivities=(1e-8, 1e-8),
        ),
        "depends on the size of the bodies: use of='interface'",
        lambda: rc.contact_flux(
            rc.press(heights(rc.Grid((16, 16), 1e-6, (True, False))), MODULUS, force=1e-5),
            resistivities=(1e-8, 1e-8),
            of="interface",
        ),
    ),
    row(
        lambda: rc.contact_flux(pressed(), resistivities=(1e-8, 1e-8)).plot(field="current"),
        "field must be 'share', 'density' or 'resistance', not 'current'",
        lambda: rc.contact_flux(pressed(), resistivities=(1e-8, 1e-8)).plot(field="density"),
    ),
    row(
        lambda: leaking(curve(forces=RISING)),
        "give measures=[rc.Transmissivity(axis=0)] to loading_curve",
        lambda: leaking(curve(forces=RISING, measures=[rc.Transmissivity(axis=0)])),
    ),
    row(
        lambda: leaking(curve(forces=RISING, measures=[rc.Transmissivity(axis=0)]), rc.Gas("air")),
        "take rc.Liquid, or rc.leak at each load for a gas",
        lambda: leaking(curve(forces=RISING, measures=[rc.Transmissivity(axis=0)])),
        lambda: rc.leak(pressed(), rc.Gas("air"), upstream=1.01e7, downstream=1.009e7, axis=0),
    ),
    row(
        lambda: curve(forces=RISING).plot(quantity="hydraulic_gap"),
        "give measures=[rc.Transmissivity(axis=0)] to loading_curve",
        lambda: curve(forces=RISING, measures=[rc.Transmissivity(axis=0)]).plot(quantity="hydraulic_gap"),
    ),
    row(
        lambda: rc.interface_table(curve(ROUGH)),
        "the curve has 0: leave the loads out, so that suitable ones are chosen, or use a finer grid",
        lambda: rc.interface_table(curve(FINE)),
    ),
    row(
        lambda: rc.interface_table(curve(PROFILE, forces=[1.0, 2.0], operator=rc.line(LINE, MODULUS))),
        "not of a line: press a map of heights",
        lambda: rc.interface_table(curve(FINE)),
    ),
    row(
        lambda: rc.interface_table(curve(FINE), friction=0.3),
        "how they shear: give `bodies` too, such as ('steel', 'aluminium')",
        lambda: rc.interface_table(curve(FINE), friction=0.3, bodies=HALF),
    ),
    row(
        lambda: rc.interface_table(curve(FINE), bodies=("steel", "aluminium")),
        "give the bodies of the curve",
        lambda: rc.interface_table(curve(FINE), bodies=HALF),
    ),
    row(
        lambda: calculix_text(law(1e-6)),
        "write the table in millimetres: units='mm', or `table` calculix-mm",
        lambda: calculix_text(law(1e-6), units="mm"),
    ),
    row(
        lambda: rc.write(law(), "law.inp", dialect="moose"),
        "choose abaqus or calculix",
        lambda: rc.write(law(), "law.inp", dialect="abaqus"),
        lambda: rc.write(law(), "law.inp", dialect="calculix"),
    ),
    row(
        lambda: rc.write(law(), "law.table", dialect="calculix"),
        "law.table is not written in the dialect 'calculix': omit dialect",
        lambda: rc.write(law(), "law.table"),
    ),
    row(
        lambda: rc.write(FINE, "map.npz", dialect="calculix"),
        "only the table of an interface has dialects: omit dialect",
        lambda: rc.write(FINE, "map.npz"),
    ),
    row(
        lambda: rc.error_budget(curve(forces=RISING)),
        "give the Solution that press returned, or several of one size and load",
        lambda: rc.error_budget(rc.press(ROUGH, MODULUS, force=1e-4)),
        lambda: rc.error_budget([rc.press(heights(seed=k), MODULUS, force=1e-4) for k in (1, 2)]),
    ),
    row(
        lambda: rc.error_budget(rc.press(ROUGH, MODULUS, force=1e-4), short_cutoff=1.0),
        "give the shortest wave that the instrument records, or take a larger map",
        lambda: rc.error_budget(rc.press(FINE, MODULUS, force=1e-4), short_cutoff=5e-6),
    ),
    row(
        lambda: rc.error_budget(rc.press(ROUGH, MODULUS, force=1e-4), noise=1e-9),
        "give one, such as noise=rc.Noise(rms=3e-9)",
        lambda: rc.error_budget(rc.press(ROUGH, MODULUS, force=1e-4), noise=rc.Noise(rms=3e-9)),
    ),
    row(
        lambda: rc.error_budget(rc.press(ROUGH, MODULUS, depth=1e-8), noise=rc.Noise(1e-9)),
        "prescribe the force or the pressure",
        lambda: rc.error_budget(rc.press(ROUGH, MODULUS, force=1e-4), noise=rc.Noise(1e-9)),
        lambda: rc.error_budget(rc.press(ROUGH, MODULUS, pressure=1e4), noise=rc.Noise(1e-9)),
    ),
    row(
        lambda: rc.Noise(1e-9, 1.0).draw(ROUGH.grid, 1),
        "remove longer errors from the map as a form: levelled('quadratic')",
        lambda: ROUGH.levelled("quadratic"),
    ),
    row(
        lambda: rc.Noise.from_repeats([ROUGH]),
        "give several maps of one place",
        lambda: rc.Noise.from_repeats([ROUGH, ROUGH]),
    ),
    row(
        lambda: rc.below(line(), [1e-6], STEEL),
        "not of a line: press a map of heights",
        lambda: rc.below(pressed(), [1e-6], STEEL),
    ),
    row(
        lambda: rc.below(pressed(), [-1e-6], STEEL),
        "counts from the surface into the body: at least 0 and finite",
        lambda: rc.below(pressed(), [0.0], STEEL),
    ),
    row(
        lambda: rc.largest_von_mises(pressed(None, depth=0.0), STEEL),
        "there is no stress below it; press harder",
        lambda: rc.largest_von_mises(pressed(), STEEL),
    ),
    row(
        lambda: rc.displacement_below(pressed(), [1e-6], MODULUS),
        "displacements need an elastic Solid(young_modulus, poisson_ratio)",
        lambda: rc.displacement_below(pressed(), [1e-6], STEEL),
    ),
    row(
        lambda: rc.prescribed_displacement(
            np.zeros((16, 16), bool), 1e-9, operator=rc.half_space(PLANE, MODULUS)
        ),
        "the region holds no cell: nothing can be displaced",
        lambda: rc.prescribed_displacement(np.eye(16) > 0, 1e-9, operator=rc.half_space(PLANE, MODULUS)),
    ),
    row(
        lambda: rc.prescribed_displacement(np.eye(16) > 0, 1e-9, operator=MODULUS),
        "an operator is wanted, such as half_space(grid, modulus)",
        lambda: rc.prescribed_displacement(np.eye(16) > 0, 1e-9, operator=rc.half_space(PLANE, MODULUS)),
    ),
    row(
        lambda: rc.nodal_flexibility(MODULUS, np.eye(256)),
        "must be an operator, such as half_space(grid, modulus)",
        lambda: rc.nodal_flexibility(rc.half_space(PLANE, MODULUS), np.eye(256)),
    ),
    row(
        lambda: rc.nodal_flexibility(rc.half_space(PERIODIC.grid, MODULUS), np.eye(256)),
        "the matrix would have no inverse; use half_space on a free grid",
        lambda: rc.nodal_flexibility(rc.half_space(PLANE, MODULUS), np.eye(256)),
    ),
    row(
        lambda: rc.nodal_flexibility(rc.half_space(PLANE, MODULUS), np.eye(25)),
        "must have the shape (256, nodes), not (25, 25): give each cell a row",
        lambda: rc.nodal_flexibility(rc.half_space(PLANE, MODULUS), np.eye(256, 25)),
    ),
    row(
        lambda: rc.nodal_flexibility(rc.half_space(rc.Grid((4, 4), 1e-6), MODULUS), elements(cells=1)),
        "some displacements of nodes move no cell; use smaller cells, at least two along each side of an element",
        lambda: rc.nodal_flexibility(rc.half_space(rc.Grid((8, 8), 5e-7), MODULUS), elements(cells=2)),
    ),
    row(
        lambda: rc.citations(1e-4),
        "there are no references for 'float', which is not of this package: give a result",
        lambda: rc.citations(pressed()),
    ),
    row(
        lambda: rc.prescribed_displacement(
            np.ones((16, 16), bool), 1e-9, operator=rc.half_space(PERIODIC.grid, MODULUS)
        ),
        "no pressure moves their mean; leave a cell free",
        lambda: rc.prescribed_displacement(
            np.arange(256).reshape(16, 16) > 0, 1e-9, operator=rc.half_space(PERIODIC.grid, MODULUS)
        ),
    ),
]


def differentiated(solution=None, **named):
    return rc.sensitivity(solution or pressed(), **named)


def hard(**named):
    return pressed(hardness=6e7, **named)


def first_state():
    return next(rc.detachment_path(rc.press(ROUGH, MODULUS, depth=2e-8), 1e-3, depths=[1e-8]))


def unloaded():
    """Return the last load, after flow under a larger one."""
    return list(rc.loading_path(ROUGH, MODULUS, forces=[2e-4, 1e-4], hardness=6e7))[-1]


def full():
    return differentiated(rc.press(PERIODIC, MODULUS, pressure=2e8))


DISC = rc.shapes.flat_disc(PLANE, radius=5e-6)
DERIVATIVES = [
    row(
        lambda: differentiated(stuck(force=1e-6)),
        "an AdhesiveState depends on the states before it, so it has no derivative with respect to the heights: give "
        "the Solution of rc.press, which is without adhesion",
        lambda: differentiated(rc.press(ROUGH, MODULUS, force=1e-6)),
    ),
    row(
        lambda: differentiated(first_state()),
        "give the Solution from which the detachment began",
        lambda: differentiated(rc.press(ROUGH, MODULUS, depth=2e-8)),
    ),
    row(
        lambda: differentiated(slid(force=1e-6)),
        "a TangentialSolution depends on the states before it, so it has no derivative with respect to the heights: "
        "give the Solution that rc.slide was given",
        lambda: differentiated(pressed()),
    ),
    row(
        lambda: differentiated(curve(ROUGH, forces=[1e-5, 1e-4])),
        "give each solution of rc.loading_path, or take rc.differentiable_curve",
        lambda: [differentiated(each) for each in rc.loading_path(ROUGH, MODULUS, forces=[1e-5, 1e-4])],
        lambda: rc.differentiable_curve(PLANE, MODULUS, forces=[1e-5, 1e-4]).linearise(ROUGH.heights),
    ),
    row(
        lambda: differentiated(1.0),
        "a float has no derivatives: give a Solution, as rc.press and rc.loading_path return it",
        lambda: differentiated(pressed()),
        lambda: differentiated(next(rc.loading_path(ROUGH, MODULUS, forces=[1e-4]))),
    ),
    row(
        lambda: differentiated(unloaded()),
        "press its present heights without a hardness: rc.press(solution.problem.surface, ...)",
        lambda: differentiated(rc.press(unloaded().problem.surface, MODULUS, force=1e-4)),
    ),
    row(
        lambda: differentiated(pressed(hardness=rc.NixGao(6e7, 1e-6))),
        "a hardness that depends on the size of spots changes in steps with the heights: give the hardness as a number",
        lambda: differentiated(hard()),
    ),
    row(
        lambda: differentiated(
            list(rc.loading_path(ROUGH, MODULUS, forces=[1e-4, 2e-4], hardness=6e7, flow="raised"))[-1]
        ),
        "a surface that rises with flow depends on the loads before: give loading_path flow='removed'",
        lambda: differentiated(
            list(rc.loading_path(ROUGH, MODULUS, forces=[1e-4, 2e-4], hardness=6e7, flow="removed"))[-1]
        ),
    ),
    row(
        lambda: differentiated(rc.press(ROUGH, MODULUS, depth=0.0)),
        "without contact there is nothing to differentiate: press deeper",
        lambda: differentiated(rc.press(ROUGH, MODULUS, depth=1e-9)),
    ),
    row(
        lambda: differentiated(pressed(1e-4, hardness=2e7)),
        "so no force grows with the depth: press under a greater hardness",
        lambda: differentiated(pressed(1e-4, hardness=1e9)),
    ),
    row(
        lambda: differentiated(reference="top"),
        "must be 'first touch' or 'level', not 'top'",
        lambda: differentiated(reference="first touch"),
        lambda: differentiated(reference="level"),
    ),
    row(
        lambda: differentiated(rc.press(DISC, MODULUS, force=1e-4)).depth_at_force,
        "take it from a level: sensitivity(solution, reference='level')",
        lambda: differentiated(rc.press(DISC, MODULUS, force=1e-4), reference="level").depth_at_force,
    ),
    row(
        lambda: full().force_at_depth,
        "take the derivatives at a given force",
        lambda: (full().depth_at_force, full().mean_gap_at_force, full().energy_at_force),
    ),
    row(
        lambda: differentiated(hard()).energy_at_force,
        "it depends on how the surface has flowed; take the derivative of force or depth",
        lambda: differentiated(hard()).force_at_depth,
        lambda: differentiated(hard()).depth_at_force,
    ),
    row(
        lambda: differentiated(hard()).to_modulus(),
        "take the difference of two loads at two moduli",
        lambda: [rc.press(ROUGH, modulus, force=1e-4, hardness=6e7).depth for modulus in (1e9, 1.01e9)],
    ),
    row(
        lambda: differentiated().to_hardness(),
        "the load has no hardness: press with hardness=",
        lambda: differentiated(hard()).to_hardness(),
    ),
    row(
        lambda: differentiated(rc.press(PERIODIC, MODULUS, force=1e-4)).to_tilt(),
        "cannot be tilted: give the change of its heights to along",
        lambda: differentiated(rc.press(PERIODIC, MODULUS, force=1e-4)).along(
            np.tile(PERIODIC.grid.coordinates[0][:, None], 16)
        ),
    ),
    row(
        lambda: differentiated().secant_stiffness(pressed(2e-4)),
        "other is a Solution: give sensitivity(solution) of the other load",
        lambda: differentiated().secant_stiffness(differentiated(pressed(2e-4))),
    ),
    row(
        lambda: differentiated().secant_stiffness(differentiated()),
        "has the same depth as this load: give another load",
        lambda: differentiated().secant_stiffness(differentiated(pressed(2e-4))),
    ),
    row(
        lambda: differentiated().secant_stiffness(full()),
        "is a load on another grid: give a load of the same surface",
        lambda: differentiated().secant_stiffness(differentiated(pressed(2e-4))),
    ),
    row(
        lambda: rc.sensitivity(solved(math.nan)).to_modulus(),
        "the problem does not state a reduced modulus: give modulus= to ContactProblem",
        lambda: rc.sensitivity(solved(MODULUS)).to_modulus(),
    ),
]


def solved(modulus):
    """Return the solution of a problem that was put together by hand."""
    separation = ROUGH.heights.max() - ROUGH.heights
    operator = rc.half_space(PLANE, MODULUS)
    return solve(rc.ContactProblem(separation, operator, rc.Force(1e-4), modulus=modulus))


@pytest.mark.parametrize("refusal", DERIVATIVES)
def test_derivatives(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", ADHESION)
def test_surfaces_that_stick(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", FRICTION)
def test_surfaces_that_slide(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", ANSWERS)
def test_answers(refusal, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # remedies write files
    follow(refusal)
