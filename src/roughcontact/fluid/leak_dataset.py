"""The flow through a gap, and a leak, as labelled data and as plain records."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.fluid.constriction import Constriction
from roughcontact.fluid.gap_flow import GapFlow
from roughcontact.fluid.leak import Leak
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.flow_columns import (
    CONSTRICTION,
    CONSTRICTION_NAMES,
    FLOW_MAPS,
    GAP_FLOW,
    LEAK,
    LEAK_NAMES,
    PRESSED,
)
from roughcontact.labels.labelled import Variables, centres, dataset_of, record_of, variable, variables_of

if TYPE_CHECKING:
    import xarray

__all__ = ["flow_dataset", "leak_dataset", "leak_record"]

_SURFACE = Geometry.SURFACE


def flow_dataset(flow: GapFlow) -> xarray.Dataset:
    """Return the maps of gap, pressure and flux, and the numbers of the flow.

    Maps lie along ``y, x``; pressure and flux also along ``direction``, that of the mean drop on a periodic map.

    Parameters
    ----------
    flow : GapFlow

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> flow = rc.gap_flow(rc.press(surface, 1e9, pressure=2e6))
    >>> flow.to_dataset()["flux_x"].dims
    ('direction', 'y', 'x')
    """
    along = range(len(flow.transmissivity))
    fields = [(flow.pressure(each), *flow.flux(each)) for each in along]
    dimensions = ("direction", *_SURFACE.axes)
    maps = {
        column.name: variable(column.name, dimensions, np.stack(values))
        for column, values in zip(FLOW_MAPS, zip(*fields, strict=True), strict=True)
    }
    maps["gap"] = variable("gap", _SURFACE.axes, flow.gap)
    coordinates = centres(flow.solution.problem.grid, _SURFACE)
    dataset = dataset_of(
        maps | _of_flow(flow, flow.constriction), coordinates, "flow through the gap of a contact", _SURFACE
    )
    return dataset.assign_attrs(notes="\n".join(flow.notes))


def leak_dataset(leak: Leak) -> xarray.Dataset:
    """Return the numbers of a leak and of its contact, and the maps of its flow.

    Parameters
    ----------
    leak : Leak

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> solution = rc.press(surface, 1e9, pressure=2e6)
    >>> leak = rc.leak(solution, rc.Liquid(1e-3), drop=1e5, seal_width=1e-3, circumference=0.1)
    >>> leak.to_dataset()["leak_rate"].attrs["units"]
    'm3 s-1'
    """
    return flow_dataset(leak.flow).assign(_of_leak(leak)).assign_attrs(notes="\n".join(leak.notes))


def leak_record(leak: Leak) -> dict[str, Any]:
    """Return the numbers of a leak as plain values, for JSON; units stand once, under ``"units"``.

    Parameters
    ----------
    leak : Leak

    Returns
    -------
    dict
        Numbers, texts and lists of them; values that are not finite become None.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> solution = rc.press(surface, 1e9, pressure=2e6)
    >>> leak = rc.leak(solution, rc.Liquid(1e-3), drop=1e5, seal_width=1e-3, circumference=0.1)
    >>> leak.to_record()["constriction_cells"], leak.to_record()["units"]["leak_rate"]
    (28, 'm3 s-1')
    """
    return record_of(_of_leak(leak), _SURFACE, notes=list(leak.notes))


def _of_flow(flow: GapFlow, place: Constriction | None) -> Variables:
    found = variables_of(flow, GAP_FLOW, _SURFACE, LEAK_NAMES)
    if place is not None:
        found |= variables_of(place, CONSTRICTION, _SURFACE, CONSTRICTION_NAMES)
    return found


def _of_leak(leak: Leak) -> Variables:
    pressed = variables_of(leak.flow.solution, {(): PRESSED}, _SURFACE)
    return pressed | variables_of(leak, LEAK, _SURFACE, LEAK_NAMES) | _of_flow(leak.flow, leak.constriction)
