"""The main numbers of results, line by line and in suitable units, for a screen and a notebook."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.fluid.fluids import Gas
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.column import Column, names_of, shown_in
from roughcontact.labels.contact_columns import CERTIFICATES, POINTS, STATE, STATE_NAMES, UNLOADED
from roughcontact.labels.engineering_units import Scale, pretty, scale, written
from roughcontact.labels.flow_columns import CONSTRICTION, GAP_FLOW, LEAK, PRESSED
from roughcontact.labels.labelled import values_of
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.solver.control import Status
from roughcontact.surface.height_range import height_range

if TYPE_CHECKING:
    import xarray

    from roughcontact.contact.curve import Curve
    from roughcontact.contact.loop import Loop
    from roughcontact.contact.solution import Solution
    from roughcontact.fluid.leak import Leak
    from roughcontact.grid import AnyGrid
    from roughcontact.statistics.power_law import PowerLaw
    from roughcontact.surface.surface import Surface

__all__ = [
    *("AREAL_COLUMNS", "CURVE_COLUMNS", "bend_words", "closed_gap", "column_facts", "curve_facts"),
    *("leak_facts", "load_table", "loop_facts", "quantity", "rate_words", "size_of", "solution_facts"),
    "stiffness_facts",
    *("surface_facts", "surface_record"),
]

_SUITS: Mapping[str, Scale] = MappingProxyType({})  # choose units by the numbers
_ROUNDING = 1e-12  # of the depth: a gap is a difference of lengths of that size
CURVE_COLUMNS = names_of(shown_in("patch", (*POINTS, *UNLOADED, *CERTIFICATES)))
AREAL_COLUMNS = names_of(shown_in("joint", (*POINTS, *UNLOADED, *CERTIFICATES)))
"""The columns of a table of loads; those of unloading exist only in a loop."""


_RATES = (
    *(("volume", 1.0, "m³/s"), ("volume", 6e7, "ml/min")),
    *(("throughput", 1.0, "Pa m³/s"), ("throughput", 10.0, "mbar l/s"), ("mass", 1e6, "mg/s")),
)
_LEAK_COLUMNS = (
    *PRESSED,
    *(each for table in (GAP_FLOW, CONSTRICTION, {(): LEAK}) for of in table.values() for each in of),
)


def quantity(name: str, value: float, geometry: Geometry = Geometry.SURFACE) -> str:
    """Return a quantity of the table of variables with a suitable unit."""
    return written(value, unit_of(name, geometry), digits=4)


def size_of(grid: AnyGrid) -> str:
    """Return the cells and the side lengths of a grid in words."""
    cells = " x ".join(str(n) for n in grid.shape)
    lengths = " x ".join(quantity("lengths", length) for length in grid.lengths)
    return f"{cells} cells, {lengths}, {'periodic' if all(grid.periodic) else 'free'}"


def column_facts(
    answer: Any,
    columns: Sequence[Column],
    geometry: Geometry,
    names: Mapping[str, str],
    units: Mapping[str, Scale] = _SUITS,
) -> list[tuple[str, str]]:
    """Return columns of a result line by line: the label, and the value in its unit or a suitable one."""
    facts = []
    for column, value in values_of(answer, columns, names).items():
        if column.name == "mean_gap":
            value = float(closed_gap(value, answer.depth))
        if column.digits == "d":
            text = str(int(value))
        elif unit := units.get(column.name):
            text = f"{value * unit.factor:.4g} {unit.unit}"
        else:
            text = written(value, column.unit_on(geometry), digits=4)
        facts.append((column.label, text))
    return facts


def solution_facts(solution: Solution, units: Mapping[str, Scale] = _SUITS) -> list[tuple[str, str]]:
    """Return the main numbers of one loaded state, line by line, in units by the names of quantities."""
    problem = solution.problem
    met = "met" if solution.status.converged else "MISSED"
    flowed = solution.flow is not None and solution.flow.volume > 0
    single = problem.geometry is Geometry.SURFACE and solution.spot_count == 1
    radius = quantity("lengths", math.sqrt(solution.contact_area / math.pi)) if single else ""
    return [
        ("surface", size_of(problem.grid)),
        *column_facts(solution, shown_in("facts", STATE[()]), problem.geometry, STATE_NAMES, units),
        *([("radius of a circle of the contact area", radius)] if single else ()),
        *(_flow_facts(solution, units) if flowed else ()),
        ("certificate", f"{solution.residual:.1e} (tolerance {problem.tolerance:.0e}: {met})"),
    ]


def _flow_facts(solution: Solution, units: Mapping[str, Scale]) -> list[tuple[str, str]]:
    """Return the main numbers of the flow of a state."""
    flow, flattened, kind = solution.flow, solution.flattened, solution.problem.geometry
    assert flow is not None
    most = float(solution.problem.measure.xp.max(flow.depth))
    part = solution.problem.measure.total(solution.plastic) / (solution.contact_area or 1.0)
    words = f"{quantity('flow_volume', flow.volume, kind)}, up to {quantity('flow_depth', most)} deep"
    facts = [
        ("volume of flow", words),
        ("residual depth", quantity("residual_depth", flattened.problem.first_touch)),
    ]
    if solution.problem.flow is not None:  # unloaded: nothing flows
        return facts
    return [
        *stiffness_facts(flattened, "on unloading", units),
        ("plastic part of the contact", f"{part:.2%}"),
        *facts,
    ]


def stiffness_facts(
    solution: Solution, words: str, units: Mapping[str, Scale] = _SUITS
) -> list[tuple[str, str]]:
    """Return the stiffnesses of a state, line by line, with `words` after their names."""
    columns = [each for each in POINTS if "stiffness" in each.name]
    facts = column_facts(solution, columns, solution.problem.geometry, STATE_NAMES, units)
    return [(f"{label} {words}", value) for label, value in facts]


def leak_facts(leak: Leak) -> list[tuple[str, str]]:
    """Return the contact, the flow and the leak rate, line by line; numbers that are not finite are left out."""
    record, solution, windings = leak.to_record(), leak.flow.solution, leak.flow.windings.tolist()
    path = f"along {' and '.join(map(str, windings))} periods (y, x)" if windings else "from side to side"
    met = "met" if solution.status.converged else "MISSED"
    numbers = [
        (column.label, ", ".join(written(each, column.unit, 4) for each in np.ravel(record[column.name])))
        for column in shown_in("facts", _LEAK_COLUMNS)
        if record.get(column.name) is not None
    ]
    return [
        ("surface", size_of(solution.problem.grid)),
        ("certificate", f"{solution.residual:.1e} (tolerance {solution.problem.tolerance:.0e}: {met})"),
        ("an open path leads", path if leak.flow.percolates else "nowhere"),
        *numbers,
        ("fluid", _fluid_words(leak)),
        ("seal", _seal_words(leak)),
        ("leak rate", rate_words(leak)),
    ]


def _fluid_words(leak: Leak) -> str:
    """Return the fluid and the pressures on both sides in words, so that a wrong unit is seen."""
    fluid, up, down = leak.fluid, written(leak.upstream, "Pa", 4), written(leak.downstream, "Pa", 4)
    if isinstance(fluid, Gas):
        return f"{fluid.name} at {fluid.temperature:g} K, {up} to {down} absolute"
    pressures = f"{up} to {down}" if leak.downstream > 0 else f"drop {up}"
    return f"viscosity {written(fluid.viscosity, 'Pa s', 4)}, {pressures}"


def _seal_words(leak: Leak) -> str:
    """Return the size of the seal in words."""
    if leak.seal_width is None or leak.circumference is None:
        return "the map, from side to side"
    along, across = (written(length, "m", 4) for length in (leak.seal_width, leak.circumference))
    return f"{along} along the flow, {across} across it"


def rate_words(leak: Leak) -> str:
    """Return the leak rate in the units in use: volume of a liquid, throughput of a gas, mass."""
    of_gas = isinstance(leak.fluid, Gas)  # the volume of a gas depends on the pressure
    values = [
        (getattr(leak, name), factor, unit)
        for name, factor, unit in _RATES
        if not (of_gas and name == "volume")
    ]
    return ", ".join(f"{value * factor:.4g} {unit}" for value, factor, unit in values if math.isfinite(value))


def loop_facts(loop: Loop) -> list[tuple[str, str]]:
    """Return the main numbers of a loop of loads, line by line."""
    kind, loading, unloading = loop.loading.geometry, loop.loading, loop.unloading
    dissipated, work = loop.dissipated_work, loop.work
    gap, flattened = float(loading.mean_gap[-1]), float(unloading.mean_gap[0])
    facts = [
        (
            "loads",
            f"{len(loading)} up to {quantity('force', float(loading.force[-1]), kind)}, down and up again",
        ),
        ("largest depth", quantity("depth", float(loading.depth[-1]))),
        ("residual depth", quantity("residual_depth", loop.residual_depth)),
        ("stiffness on first loading", quantity("stiffness", float(loading.stiffness[-1]), kind)),
        ("stiffness on unloading", quantity("stiffness", float(unloading.stiffness[0]), kind)),
        (
            "mean gap at the largest load",
            f"{quantity('mean_gap', gap)} on first loading, where cells that flow have a negative gap; "
            f"{quantity('mean_gap', flattened)} on unloading, where it is zero",
        ),
        ("volume of flow", quantity("flow_volume", loop.flow.volume, kind)),
        ("work of first loading", quantity("work", work, kind)),
        ("dissipated work", f"{quantity('dissipated_work', dissipated, kind)} ({dissipated / work:.2%})"),
    ]
    if loading.flow is not None:
        part = loading.flow.plastic_area[-1] / loading.contact_area[-1]
        facts.append(("plastic part of the contact", f"{part:.2%} at the largest load"))
    return facts


def curve_facts(curve: Curve, law: PowerLaw | None) -> list[tuple[str, str]]:
    """Return the numbers of a curve as a whole, line by line: its power law, if it has one, and its limits."""
    kind = curve.geometry
    full = quantity("full_contact_stiffness", curve.full_contact_stiffness, kind)
    facts = [
        ("full-contact stiffness", f"{full}, every measured cell in contact"),
        ("largest certificate", f"{curve.residual.max():.1e}"),
        *_open_paths(curve),
    ]
    if law is None:
        return facts
    stiff, light = ("k/E*", "(F/(E* h))") if kind is Geometry.LINE else ("k/(E* L)", "(F/(E* L h))")
    text = f"{stiff} = {law.prefactor:.4g} {light}^{law.exponent:.4f}"
    return [("power law", text), ("fitted to", f"{law.rule}; scatter {law.scatter:.2g}"), *facts]


def _open_paths(curve: Curve) -> list[tuple[str, str]]:
    """Return between which loads the open cells cease to percolate, if their flow was measured."""
    if "percolates" not in curve.measured:
        return []
    order = np.argsort(curve.nominal_pressure, kind="stable")
    opened = curve.measured["percolates"][order] > 0
    loads = [
        f"{quantity('nominal_pressure', float(curve.nominal_pressure[k]))} (A/A0 {curve.contact_fraction[k]:.3g})"
        for k in order
    ]
    last = int(np.flatnonzero(opened).max(initial=-1))
    if last < 0:
        words = f"at no load, not even at {loads[0]}"
    elif last == len(loads) - 1:
        words = f"up to the largest load, {loads[last]}"
    else:
        words = f"closes between {loads[last]} and {loads[last + 1]}: the open cells cease to percolate"
    return [("open path", words)]


def bend_words(law: PowerLaw) -> str:
    """Return a remark on a law whose exponent changes over its window."""
    low, high = law.ends
    return (
        f"no single power law: its exponent goes from {low:.2f} to {high:.2f} over the window "
        f"(a change of {law.bend:+.2f} +- {law.bend_error:.2f}); quote local exponents with their windows"
    )


def load_table(dataset: xarray.Dataset, names: Sequence[str]) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the columns that a curve has, a row for each load, with units and remarks."""
    header, columns = [], []
    geometry = Geometry(dataset.attrs.get("geometry", "surface"))
    for name in filter(dataset.__contains__, names):
        values, known = dataset[name].to_numpy(), unit_of(name, geometry)
        if name == "mean_gap":
            values = closed_gap(values, dataset["depth"].to_numpy())
        if values.dtype.kind in "OUTb":
            header.append(VARIABLES[name].label)
            columns.append([{True: "yes", False: "no"}.get(value, str(value)) for value in values])
            continue
        plain = known in ("", "1")
        chosen = _scale(values, dataset[name].attrs.get("units", ""), known)
        column = VARIABLES[name]
        header.append(column.label if plain else f"{column.label} [{chosen.unit or pretty(known)}]")
        columns.append([format(value if plain else value * chosen.factor, column.digits) for value in values])
    if {"resolved", "status"} <= dataset.keys():
        header.append("")
        points = zip(dataset["resolved"].to_numpy(), dataset["status"].to_numpy(), strict=True)
        columns.append([_remark(*point) for point in points])
    return header, [list(row) for row in zip(*columns, strict=True)]


def surface_record(surface: Surface) -> dict[str, Any]:
    """Return the main numbers of a surface, as plain values."""
    grid = surface.grid
    lowest, highest = height_range(surface.heights)
    return {
        "shape": list(grid.shape),
        "spacing": list(grid.spacing),
        "lengths": list(grid.lengths),
        "periodic": list(grid.periodic),
        "missing": surface.missing,
        "rms": surface.rms,
        "rms_levelled": surface.levelled("plane").rms,
        "lowest": lowest,
        "highest": highest,
        "provenance": list(surface.provenance),
        "units": dict.fromkeys(("spacing", "lengths", "rms", "rms_levelled", "lowest", "highest"), "m"),
    }


def surface_facts(surface: Surface, record: dict[str, Any]) -> list[tuple[str, str]]:
    """Return the main numbers of a surface, line by line."""
    cell = " x ".join(quantity("spacing", step) for step in surface.grid.spacing)
    missing = f"{surface.missing} ({surface.missing / surface.grid.size:.2%})" if surface.missing else "none"
    trend = "plane" if surface.grid.ndim == 2 else "slope"
    rms = f"{quantity('rms', surface.rms)}; {quantity('rms', record['rms_levelled'])} about its {trend}"
    return [
        ("size", size_of(surface.grid)),
        ("cell", cell),
        ("missing points", missing),
        ("rms height", rms),
        ("heights", f"{quantity('heights', record['lowest'])} to {quantity('heights', record['highest'])}"),
        *(("history", line) for line in record["provenance"]),
    ]


def _scale(values: Any, unit: str, known: str) -> Scale:
    """Return the unit chosen by the user for a column, or a suitable one."""
    if unit != known:
        return Scale(1.0, unit)
    return scale(float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values))), unit)


def closed_gap(gap: Any, depth: Any) -> Any:
    """Return mean gaps, with 0 for values within rounding of the depth."""
    return np.where(np.abs(gap) <= _ROUNDING * np.abs(depth), 0.0, gap)


def _remark(resolved: bool, status: str) -> str:
    if not Status(status).converged:
        return f"MISSED: {status}"
    return "" if resolved else "not resolved"
