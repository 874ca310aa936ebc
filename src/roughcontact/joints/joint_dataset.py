"""A whole joint as labelled data, and as plain values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.joints.whole_joint import Joint
from roughcontact.labels.column import CELLS
from roughcontact.labels.joint_columns import JOINT, JOINT_NAMES
from roughcontact.labels.labelled import centres, dataset_of, record_of, variables_of

if TYPE_CHECKING:
    import xarray

__all__ = ["joint_dataset", "joint_record"]

_KIND = Geometry.SURFACE
_NUMBERS = {along: columns for along, columns in JOINT.items() if along != (CELLS,)}


def joint_dataset(joint: Joint) -> xarray.Dataset:
    """Return the numbers of a joint, and the maps of pressure and stiffness per area along ``y, x``.

    Vectors lie along ``component`` (x, then y), the matrix of tilting also along ``direction``.

    Parameters
    ----------
    joint : Joint

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.examples.surface("ground")
    >>> law = rc.normal_law(rc.loading_curve(surface, 1e11, pressures=[1e7, 3e7, 1e8]))
    >>> joint = rc.joint(law, rc.PressureField(np.full((2, 3), 5e7), 1e-3))
    >>> joint.to_dataset()["tilting_stiffness"].attrs["units"]
    'N m rad-1'
    """
    axes = centres(joint.field.grid, _KIND)
    for name in ("component", "direction"):
        axes[name] = (name,), ["x", "y"], {"long_name": f"{name} in the face"}
    data = variables_of(joint, JOINT, _KIND, JOINT_NAMES)
    return dataset_of(data, axes, "stiffness of a joint", _KIND).assign_attrs(notes="\n".join(joint.notes))


def joint_record(joint: Joint) -> dict[str, Any]:
    """Return the numbers of a joint as plain values, for JSON; units stand once, under ``"units"``.

    Parameters
    ----------
    joint : Joint

    Returns
    -------
    dict
        Numbers, texts and lists of them; values that are not finite become None.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.examples.surface("ground")
    >>> law = rc.normal_law(rc.loading_curve(surface, 1e11, pressures=[1e7, 3e7, 1e8]))
    >>> joint = rc.joint(law, rc.PressureField(np.full((2, 3), 5e7), 1e-3))
    >>> joint.to_record()["force"]
    300.0
    """
    numbers = variables_of(joint, _NUMBERS, _KIND, JOINT_NAMES)
    return record_of(numbers, _KIND, notes=list(joint.notes))
