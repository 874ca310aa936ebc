"""The flow through a gap, and a leak, as labelled data and as plain records."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.fluid.gap_flow import GapFlow
from roughcontact.fluid.leak import Leak
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.flow_columns import CONSTRICTION, FLOW_MAPS, FLOW_NAMES, GAP_FLOW, LEAK, PRESSED
from roughcontact.labels.labelled import Variables, centres, dataset_of, record_of, variable, variables_of

if TYPE_CHECKING:
    import xarray

__all__ = ["flow_dataset", "flow_record"]

_SURFACE = Geometry.SURFACE


def flow_dataset(found: GapFlow | Leak) -> xarray.Dataset:
    """Return the maps of gap, pressure and flux, and the numbers of the flow; of a leak, also those of the leak.

    Maps lie along ``y, x``; pressure and flux also along ``direction``, that of the mean drop on a periodic map.

    Parameters
    ----------
    found : GapFlow or Leak
        Of a map, not of rings.

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
    flow = found.flow if isinstance(found, Leak) else found
    fields = [(flow.pressure(each), *flow.flux(each)) for each in range(len(flow.transmissivity))]
    dimensions = ("direction", *_SURFACE.axes)
    maps = {
        column.name: variable(column.name, dimensions, np.stack(values))
        for column, values in zip(FLOW_MAPS, zip(*fields, strict=True), strict=True)
    }
    maps["gap"] = variable("gap", _SURFACE.axes, flow.gap)
    coordinates = centres(flow.solution.problem.grid, _SURFACE)
    dataset = dataset_of(maps | _numbers(found), coordinates, "flow through the gap of a contact", _SURFACE)
    return dataset.assign_attrs(notes="\n".join(found.notes))


def flow_record(found: GapFlow | Leak) -> dict[str, Any]:
    """Return the numbers of a flow or a leak as plain values, for JSON; units stand once, under ``"units"``.

    Parameters
    ----------
    found : GapFlow or Leak

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
    >>> leak = rc.leak(solution, rc.Liquid(1e-3), drop=1e5, axis=0, seal_width=1e-3, circumference=0.1)
    >>> leak.to_record()["constriction_cells"], leak.to_record()["units"]["leak_rate"]
    (28, 'm3 s-1')
    """
    return record_of(_numbers(found), _SURFACE, notes=list(found.notes))


def _numbers(found: GapFlow | Leak) -> Variables:
    flow = found.flow if isinstance(found, Leak) else found
    numbers = variables_of(flow.solution, {(): PRESSED}, _SURFACE)
    numbers |= variables_of(flow, GAP_FLOW, _SURFACE, FLOW_NAMES)
    if isinstance(found, Leak):
        numbers |= variables_of(found, {(): LEAK}, _SURFACE, FLOW_NAMES)
    if found.constriction is not None:
        numbers |= variables_of(found, CONSTRICTION, _SURFACE, FLOW_NAMES)
    return numbers
