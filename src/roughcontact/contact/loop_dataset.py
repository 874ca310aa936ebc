"""A loop of loads as labelled data, and as a plain record."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.contact.dataset import curve_dataset, curve_record
from roughcontact.contact.loop import Loop
from roughcontact.labels.contact_columns import FLOW, LOOP, UNLOADED
from roughcontact.labels.labelled import (
    Variables,
    attributes_of,
    centres,
    dataset_of,
    record_of,
    variable,
    variables_of,
)

if TYPE_CHECKING:
    import xarray


__all__ = ["loop_dataset", "loop_record", "unloaded"]

_NAMES = {
    "heights": "surface.heights",
    "flattened_heights": "flattened.heights",
    **{f"flow_{name}": f"flow.{name}" for name in ("depth", "rise", "volume", "energy")},
}


def loop_dataset(loop: Loop) -> xarray.Dataset:
    """Return the three branches one after the other along ``load``, and the maps of the surface before and after.

    Parameters
    ----------
    loop : Loop

    Returns
    -------
    xarray.Dataset
        Variables with units and long names; ``branch`` names the branch of each load.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> loop = rc.loading_loop(ball, 1e11, hardness=2e9, forces=[0.05, 0.1, 0.2])
    >>> loop.to_dataset()["branch"].to_numpy()[[0, 3, 6]].tolist()
    ['loading', 'unloading', 'reloading']
    """
    import xarray

    kind, grid = loop.loading.geometry, loop.surface.grid
    # Values between two loads are dropped because branches meet; scales and titles are those of first loading.
    branches = [curve_dataset(curve).drop_dims("interval") for curve in loop.curves.values()]
    along = [name for name, values in branches[0].items() if values.dims == ("load",)]
    loads = xarray.concat([each[along] for each in branches], "load")
    others = branches[0].drop_vars(along)
    words = np.repeat(list(loop.curves), [len(curve) for curve in loop.curves.values()])
    data = variables_of(loop, LOOP, kind, _NAMES)
    whole = dataset_of(
        data, centres(grid, kind), "first loading, unloading and reloading of a rough surface", kind
    )
    joined = xarray.merge([whole, others, loads], combine_attrs="override")
    return joined.assign(branch=variable("branch", ("load",), words))


def loop_record(loop: Loop) -> dict[str, Any]:
    """Return the numbers as plain values, for JSON: a record of each branch, and the numbers of the loop.

    Parameters
    ----------
    loop : Loop

    Returns
    -------
    dict
        Numbers, texts and lists of them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> loop = rc.loading_loop(ball, 1e11, hardness=2e9, forces=[0.05, 0.1, 0.2])
    >>> f"{loop.to_record()['residual_depth'] * 1e9:.0f} nm"
    '78 nm'
    """
    kind = loop.loading.geometry
    data = variables_of(loop, {(): (*LOOP[()], *FLOW[1:3])}, kind, _NAMES)
    return record_of(data, kind) | {name: curve_record(curve) for name, curve in loop.curves.items()}


def unloaded(loop: Loop) -> Variables:
    """Return the points of unloading in the order of first loading, each under the load of its row."""
    return {
        column.name: (
            ("load",),
            getattr(loop.unloading, column.name.removeprefix("unloaded_"))[::-1],
            attributes_of(column, loop.loading.geometry),
        )
        for column in UNLOADED
    }
